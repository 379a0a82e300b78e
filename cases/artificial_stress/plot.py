#!/usr/bin/python3
"""A soft beam bent hard with three coefficients of the artificial stress: gaps at the clamp, and a zigzag (Fig. 4).

    /usr/bin/python3 cases/artificial_stress/plot.py results/comparison/paper/artificial_stress [--output DIR]
"""

from __future__ import annotations

import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison.drop_figures import save  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from figures import LINES, STYLE  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from numpy.typing import NDArray  # noqa: E402
from sphdrop_reader import Run, Snapshot  # noqa: E402

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
MILLI = 1e3
PICTURE_TIME = 6e-3  # s: the beam without artificial stress is cracked most
CLAMP_REGION = 2e-3  # m: so far from the clamp's edge at x = 0, gaps and zigzag are counted


@dataclass(frozen=True)
class Lattice:
    """The beam's free particles as they lay at the start, on a square lattice of `spacing` in m."""

    spacing: float
    start: Array        # [N, 2], m
    pairs: Integers     # [P, 2]: nearest neighbours of the lattice
    triples: Integers   # [T, 3]: three in a line, the middle one second


def lattice_of(start: Array, spacing: float) -> Lattice:
    """Of positions [N, 2] in m that lie on a square lattice."""
    cells = np.rint((start - start.min(axis=0)) / spacing).astype(int)
    where = {(int(x), int(y)): k for k, (x, y) in enumerate(cells)}
    pairs, triples = [], []
    for (x, y), k in where.items():
        for dx, dy in ((1, 0), (0, 1)):
            before, after = where.get((x - dx, y - dy)), where.get((x + dx, y + dy))
            if after is not None:
                pairs.append((k, after))
                if before is not None:
                    triples.append((before, k, after))
    return Lattice(spacing, start, np.array(pairs).reshape(-1, 2), np.array(triples).reshape(-1, 3))


def gaps(lattice: Lattice, position: Array) -> Array:
    """Distance over spacing of the pairs that were neighbours at the start."""
    first, second = lattice.pairs.T
    return np.hypot(*(position[first] - position[second]).T) / lattice.spacing


def is_near(lattice: Lattice, groups: Integers) -> NDArray[np.bool_]:
    """Which pairs or triples lay in CLAMP_REGION at the start."""
    return lattice.start[groups, 0].max(axis=1) < CLAMP_REGION


def largest_gap(lattice: Lattice, position: Array) -> float:
    """In CLAMP_REGION."""
    return float(gaps(lattice, position)[is_near(lattice, lattice.pairs)].max())


def zigzag(lattice: Lattice, position: Array) -> float:
    """In CLAMP_REGION: root mean square of half the distance of a particle from the middle of its two neighbours, over the
    spacing: a where particles are displaced by +a, -a, +a ...; a smooth bending gives next to nothing."""
    before, middle, after = lattice.triples[is_near(lattice, lattice.triples)].T
    apart = 0.5 * (position[middle] - 0.5 * (position[before] + position[after]))
    return float(np.sqrt((apart**2).sum(axis=1).mean())) / lattice.spacing


def beam(snapshot: Snapshot) -> NDArray[np.bool_]:
    return snapshot.solid & (snapshot["is_fixed"] == 0)


def prepare(run: Run) -> Lattice:
    first = run.snapshots[0]
    return lattice_of(first["position"][beam(first)], tomllib.loads(run.case_text)["resolution"]["spacing"])


def measure(results: Results) -> dict[str, float]:
    """Gaps and zigzag in spacings; energies as shares of the drop's kinetic energy at the start."""
    found = {}
    for name, run in results.items():
        lattice, history = prepare(run), run.history
        positions = [snapshot["position"][beam(snapshot)] for snapshot in run.snapshots]
        shown = run.snapshots.at(PICTURE_TIME)
        found[f"largest_gap_{name}"] = max(largest_gap(lattice, position) for position in positions)
        found[f"zigzag_{name}"] = zigzag(lattice, shown["position"][beam(shown)])
        found[f"artificial_stress_work_{name}"] = float(history["artificial_stress_work"][-1] / history["kinetic_fluid"][0])
        found[f"elastic_energy_{name}"] = float(history["elastic"][-1] / history["kinetic_fluid"][0])
        found[f"end_deflection_{name}"] = float(-history["deflection"][-1])
    return found


def label(run: Run) -> str:
    if tomllib.loads(run.case_text).get("mode") == "modern":
        return "mode modern"
    return rf"$\epsilon$ = {tomllib.loads(run.case_text)['solid']['artificial_stress_coefficient']:g}"


def draw_clamp(axes: Axes, run: Run, lattice: Lattice, snapshot: Snapshot) -> EllipseCollection:
    """The clamped end's particles, the beam's coloured by the widest of their gaps."""
    position = snapshot["position"][beam(snapshot)]
    widest = np.ones(len(position))
    for end in lattice.pairs.T:
        np.maximum.at(widest, end, gaps(lattice, position))
    size = 0.8 * lattice.spacing * MILLI
    fixed = snapshot["position"][snapshot.solid & (snapshot["is_fixed"] != 0)] * MILLI
    axes.add_collection(EllipseCollection(size, size, 0, units="xy", offsets=fixed, offset_transform=axes.transData, linewidths=0,
                                          facecolor="#6b7480"))
    dots = EllipseCollection(size, size, 0, units="xy", offsets=position * MILLI, offset_transform=axes.transData, linewidths=0,
                             cmap="turbo", array=widest, clim=(1.0, 1.4))
    axes.add_collection(dots)
    axes.set(xlim=(-0.3, 1.3), ylim=(-0.15, 0.36), aspect="equal", ylabel="$y$  (mm)")
    axes.set_title(f"{label(run)},  $t$ = {snapshot.time * MILLI:.1f} ms: gaps to {largest_gap(lattice, position):.2f} $d$",
                   loc="left")
    axes.grid(False)
    return dots


def shown_runs(results: Results) -> list[Run]:
    """The coefficients, and then mode modern, whose beam has no artificial stress."""
    return [*results.values(), *results.modern.values()]


def draw_clamps(results: Results) -> Figure:
    runs = shown_runs(results)
    figure, grid = plt.subplots(len(runs), 1, figsize=(7.2, 2.15 * len(runs) + 0.3), sharex=True, squeeze=False,
                                layout="constrained")
    for axes, run in zip(grid[:, 0], runs):
        dots = draw_clamp(axes, run, prepare(run), run.snapshots.at(PICTURE_TIME))
    grid[-1, 0].set_xlabel("$x$  (mm)")
    figure.colorbar(dots, ax=grid, shrink=0.5, label="widest gap to a neighbour / spacing")
    return figure


def draw_growth(results: Results) -> Figure:
    figure, (gap, bent, work) = plt.subplots(1, 3, figsize=(7.6, 2.7), layout="constrained")
    for run, colour in zip(shown_runs(results), LINES):
        lattice = prepare(run)
        positions = [snapshot["position"][beam(snapshot)] for snapshot in run.snapshots]
        times = run.snapshots.times * MILLI
        gap.plot(times, [largest_gap(lattice, position) for position in positions], color=colour, label=label(run))
        bent.plot(times, [zigzag(lattice, position) for position in positions], color=colour)
        history = run.history
        work.plot(history["time"] * MILLI, history["artificial_stress_work"] / history["kinetic_fluid"][0], color=colour)
    gap.set(ylabel="largest gap at the clamp / $d$")
    bent.set(ylabel="zigzag at the clamp / $d$")
    work.set(ylabel="work of the artificial stress /\nthe drop's kinetic energy")
    for axes in (gap, bent, work):
        axes.set_xlabel("time  (ms)")
    gap.legend()
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    if not results:
        return []
    pictures = (
        ("clamp.png", draw_clamps,
         "The clamped end with different coefficients of the artificial stress and in mode modern; the clamp's particles are grey.",
         "Fig. 4"),
        ("growth.png", draw_growth, "Gaps and zigzag over time, and the energy that the artificial stress puts in.", ""),
    )
    with plt.rc_context(STYLE):
        return save([(name, draw_one(results), caption, paper) for name, draw_one, caption, paper in pictures], folder)


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
