"""A run directory out of formulas: a drop of rings that flattens on a lattice beam which bends under it."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

import h5py
import numpy as np

SPACING = 5e-5  # m
DIAMETER = 1e-3  # m
LENGTH, THICKNESS = 6e-3, 2.5e-4  # m
END = 3e-3  # s


def drop(phase: float) -> dict[str, np.ndarray]:
    """Rings, stretched in x and squeezed in y as `phase` goes from 0 to 1."""
    points = [(0.0, 0.0)]
    for ring in range(1, int(DIAMETER / 2 / SPACING + 0.5)):
        angles = 2 * np.pi * np.arange(6 * ring) / (6 * ring)
        points += list(zip(ring * SPACING * np.cos(angles), ring * SPACING * np.sin(angles)))
    rest = np.array(points)
    stretch = 1 + 0.8 * np.sin(np.pi * phase)
    position = rest * [stretch, 1 / stretch] + [LENGTH - DIAMETER / 2, DIAMETER / 2 / stretch + 1.5 * SPACING + deflection(phase)]
    velocity = np.stack((rest[:, 0] * 2e3 * np.cos(np.pi * phase), -0.8 * np.cos(np.pi * phase) - rest[:, 1] * 8e2), axis=1)
    zero = np.zeros(len(rest))
    return {"position": position, "velocity": velocity, "pressure": zero + 130.0, "stress_xx": zero - 130.0,
            "stress_yy": zero - 130.0, "stress_xy": zero, "material": zero.astype(np.int64), "is_fixed": zero.astype(np.int64),
            "density": zero + 1000.0, "mass": zero + 1000.0 * SPACING**2}


def deflection(phase: float) -> float:
    """Of the tip, m."""
    return -3e-4 * np.sin(0.5 * np.pi * phase * 1.3)


def beam(phase: float) -> dict[str, np.ndarray]:
    columns, rows = round(LENGTH / SPACING) + 10, round(THICKNESS / SPACING)
    x, y = np.meshgrid((np.arange(columns) - 9.5) * SPACING, -(np.arange(rows) + 0.5) * SPACING, indexing="ij")
    x, y = x.ravel(), y.ravel()
    share = np.clip(x / LENGTH, 0, None)
    bend = deflection(phase) * share**2 * (3 - share) / 2
    sxx = -3e8 * (y + THICKNESS / 2) * 3 * deflection(phase) / LENGTH**2 * np.clip(1 - share, 0, 1)
    zero = np.zeros(len(x))
    return {"position": np.stack((x, y + bend), axis=1), "velocity": np.stack((zero, bend * 100), axis=1), "pressure": -sxx / 3,
            "stress_xx": sxx, "stress_yy": zero, "stress_xy": zero, "material": zero.astype(np.int64) + 1,
            "is_fixed": (x < 0).astype(np.int64), "density": zero + 1000.0, "mass": zero + 1000.0 * SPACING**2}


UNITS = {"velocity": "m/s", "pressure": "Pa", "stress_xx": "Pa", "stress_yy": "Pa", "stress_xy": "Pa", "density": "kg/m3",
         "mass": "kg/m"}


def write_snapshot(path: Path, number: int, time: float, particles: dict[str, np.ndarray]) -> None:
    """The layout of io/FORMAT.md, as far as the reader looks at it."""
    with h5py.File(path, "w") as file:
        file.attrs.update({"time": time, "step": number * 1000, "state_hash": np.bytes_(f"{number:016x}"),
                           "name": np.bytes_("synthetic"), "version": np.bytes_("0")})
        count = len(particles["position"])
        file["VTKHDF/NumberOfPoints"] = [count]
        file["VTKHDF/Points"] = np.column_stack((particles["position"], np.zeros(count)))
        data = file.create_group("VTKHDF/PointData")
        for name, values in particles.items():
            if name == "position":
                continue
            data[name] = np.column_stack((values, np.zeros(count))) if values.ndim == 2 else values
            data[name].attrs.update({"unit": np.bytes_(UNITS.get(name, "1")), "description": np.bytes_(name)})


def write_run(directory: Path, snapshots: int = 9, parts: Iterable[str] = ("drop", "beam"), leave_out: Iterable[str] = (),
              with_history: bool = True) -> None:
    directory.mkdir(parents=True, exist_ok=True)
    files = []
    for number in range(snapshots):
        phase = number / max(1, snapshots - 1)
        pieces = [{"drop": drop, "beam": beam}[part](phase) for part in parts]
        particles = {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0] if name not in leave_out}
        name = f"snapshot_{number:06}.vtkhdf"
        write_snapshot(directory / name, number, phase * END, particles)
        files.append({"name": name, "time": phase * END})
    (directory / "snapshots.vtkhdf.series").write_text(json.dumps({"file-series-version": "1.0", "files": files}))
    (directory / "run.json").write_text('{"status": "completed"}')
    (directory / "case.cfg").write_text('name = "synthetic"\n')
    if not with_history:
        return
    phase = np.linspace(0, 1, 200)
    push = np.where(phase < 0.85, np.sin(np.pi * np.clip(phase / 0.85, 0, 1)) ** 2, 0.0)
    impulse = np.cumsum(push) * END / 200
    columns = {"time [s]": phase * END, "drop_width [m]": DIAMETER * (1 + 0.8 * np.sin(np.pi * phase)),
               "deflection [m]": [deflection(p) for p in phase], "contact_force_x [N/m]": 0.03 * push * np.sin(9 * phase),
               "contact_force_y [N/m]": 0.7 * push, "contact_impulse_x [N s/m]": 0.02 * impulse,
               "contact_impulse_y [N s/m]": 0.7 * impulse, "kinetic_fluid [J/m]": 2.5e-4 * np.cos(np.pi * phase) ** 2,
               "kinetic_solid [J/m]": 2e-5 * np.sin(6 * phase) ** 2, "elastic [J/m]": 5e-5 * np.sin(2 * phase) ** 2,
               "surface [J/m]": 2.3e-4 + 8e-5 * np.sin(np.pi * phase), "dissipated_fluid [J/m]": 6e-5 * phase,
               "total [J/m]": 5e-4 + 1e-7 * phase}
    columns = {name: values for name, values in columns.items() if name.split()[0] not in leave_out}
    rows = [",".join(columns)] + [",".join(repr(float(value)) for value in row) for row in zip(*columns.values())]
    (directory / "history.csv").write_text("\n".join(rows) + "\n")
