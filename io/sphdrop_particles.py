"""Files of a drop's particles, which a case names in drop.particles_file (FORMAT.md).

    from sphdrop_particles import write_particles

    write_particles("peanut.csv", position)                                # [N, 2], m
    drop = Run("results/a").snapshots.at(2e-3)
    write_particles("drop.csv", drop["position"][drop.fluid], drop["velocity"][drop.fluid])
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike


def write_particles(path: str | Path, position: ArrayLike, velocity: ArrayLike | None = None, mass: ArrayLike | None = None,
                    comment: str = "") -> None:
    """Positions [N, 2] in m, velocities [N, 2] in m/s and masses [N] in kg per metre of depth as text, to the last bit."""
    columns = {"x [m],y [m]": np.asarray(position, dtype=np.float64)}
    if velocity is not None:
        columns["vx [m/s],vy [m/s]"] = np.asarray(velocity, dtype=np.float64)
    count = len(columns["x [m],y [m]"])
    for name, values in columns.items():
        if values.shape != (count, 2):
            raise ValueError(f"{name}: an array of shape [{count}, 2] is wanted, not {list(values.shape)}")
    if mass is not None:
        columns["mass [kg/m]"] = np.asarray(mass, dtype=np.float64).reshape(-1, 1)
        if len(columns["mass [kg/m]"]) != count:
            raise ValueError(f"{len(columns['mass [kg/m]'])} masses are given for {count} particles")
    table = np.concatenate(list(columns.values()), axis=1)
    if not np.isfinite(table).all():
        raise ValueError(f"row {int(np.flatnonzero(~np.isfinite(table).all(axis=1))[0])} has a value that is not a finite number")
    lines = [f"# {line}" for line in comment.splitlines()] + [",".join(columns)]
    lines += [",".join(map(repr, row)) for row in table.tolist()]
    Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")
