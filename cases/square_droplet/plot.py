#!/usr/bin/python3
"""The square drop that becomes round: its pressure, curvature and radius against Laplace's law (Figs 7, 8).

    /usr/bin/python3 cases/square_droplet/plot.py results/comparison/paper/square_droplet [--output DIR]
"""

from __future__ import annotations

import math
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison import quantities  # noqa: E402
from comparison.drop_figures import save  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from figures import LINES, MODERN, STYLE  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from figure_particles import choose_frames, colourings, draw_particles  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from numpy.typing import NDArray  # noqa: E402
from sphdrop_reader import Run, Snapshot  # noqa: E402

MILLI = 1e3
TIMES = (0.0, 0.2e-3, 0.6e-3, 1.2e-3, math.inf)  # s, of the frames; the last is the run's last


def parameters(run: Run) -> Mapping[str, Any]:
    return tomllib.loads(run.case_text)


def circle_radius(run: Run) -> float:
    """R in m of the circle with the square's area."""
    return parameters(run)["drop"]["diameter"] / math.sqrt(math.pi)


def laplace_pressure(run: Run) -> float:
    """sigma/R, Pa"""
    return parameters(run)["surface_tension"]["coefficient"] / circle_radius(run)


def at_rest(run: Run, column: str) -> NDArray[np.float64]:
    """The last quarter of a history."""
    times = run.history["time"]
    return run.history[column][times >= 0.75 * times[-1]]


def inertial_radius(snapshot: Snapshot) -> float:
    """Of the disc that has the liquid's mean square distance from its centre, which is half the radius' square, m."""
    liquid = snapshot.fluid
    position, mass = snapshot["position"][liquid], snapshot["mass"][liquid, np.newaxis]
    apart = position - (mass * position).sum(axis=0) / mass.sum()
    return math.sqrt(2 * float((mass * apart**2).sum() / mass.sum()))


def outline(snapshot: Snapshot, sectors: int = 36) -> NDArray[np.float64]:
    """Radii in m of the surface in equal sectors about the centre: the outermost particle of each and half a spacing."""
    position = snapshot["position"][snapshot.fluid]
    apart = position - position.mean(axis=0)
    sector = np.floor((np.arctan2(apart[:, 1], apart[:, 0]) / (2 * math.pi) + 0.5) * sectors).astype(int) % sectors
    radii = np.zeros(sectors)
    np.maximum.at(radii, sector, np.hypot(*apart.T))
    return radii + 0.5 * quantities.spacing(snapshot)


def measure(results: Results) -> dict[str, float]:
    """Pressure in Pa, radius in m, curvature and its scatter times R, roundness as a share of R."""
    found = {}
    for name, run in results.items():
        radius, surface = circle_radius(run), outline(run.snapshots[-1])
        found[f"pressure_{name}"] = float(at_rest(run, "mean_pressure").mean())
        found[f"pressure_error_{name}"] = abs(found[f"pressure_{name}"] / laplace_pressure(run) - 1)
        found[f"curvature_{name}"] = float(at_rest(run, "mean_curvature").mean()) * radius
        found[f"curvature_scatter_{name}"] = float(at_rest(run, "curvature_scatter").mean()) * radius
        found[f"radius_{name}"] = inertial_radius(run.snapshots[-1])
        found[f"out_of_round_{name}"] = float(surface.std()) / radius
    return found


def label(run: Run) -> str:
    case = parameters(run)
    side = round(case["drop"]["diameter"] / case["resolution"]["spacing"])
    return f"{side} x {side} particles"


def draw_shapes(results: Results) -> Figure:
    """A row for each resolution, a column for each time."""
    figure, grid = plt.subplots(len(results), len(TIMES), figsize=(7.6, 1.62 * len(results) + 0.6), sharex=True, sharey=True,
                                squeeze=False, layout="constrained")
    for row, run in zip(grid, results.values()):
        times = [min(time, run.history["time"][-1]) for time in TIMES]
        frames = choose_frames(run.snapshots, len(times), times)
        liquid, solid = colourings(choose_frames(run.snapshots, 2, [0.2e-3, 0.6e-3]), "xx")
        radius = circle_radius(run) * MILLI
        for axes, frame in zip(row, frames):
            draw_particles(axes, frame, liquid, solid)
            axes.add_patch(plt.Circle((0, 0), radius, fill=False, color=LINES[1], lw=0.7, ls=(0, (5, 3))))
            axes.set(xlim=(-0.68, 0.68), ylim=(-0.68, 0.68), xticks=(-0.5, 0, 0.5), yticks=(-0.5, 0, 0.5))
            axes.set_title(f"{frame.time * MILLI:.1f} ms", loc="left", pad=2)
            axes.tick_params(length=2, labelsize=7)
        row[0].set_ylabel(label(run) + "\n$y$  (mm)", fontsize=7.5)
    for axes in grid[-1]:
        axes.set_xlabel("$x$  (mm)", fontsize=7.5)
    return figure


def pressure_profile(snapshot: Snapshot, radius: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Distances from the centre over the radius, and the mean pressure in Pa of rings about them."""
    position = snapshot["position"][snapshot.fluid]
    distance = np.hypot(*(position - position.mean(axis=0)).T) / radius
    bins = np.linspace(0, 1, 21)
    count = np.histogram(distance, bins)[0]
    sums = np.histogram(distance, bins, weights=snapshot["pressure"][snapshot.fluid])[0]
    has_any = count > 0
    return (0.5 * (bins[:-1] + bins[1:]))[has_any], sums[has_any] / count[has_any]


def draw_histories(results: Results) -> Figure:
    figure, (pressure, curvature, profile) = plt.subplots(1, 3, figsize=(7.6, 2.8), layout="constrained")
    for (name, run), colour in zip(results.items(), LINES):
        time, radius = run.history["time"] * MILLI, circle_radius(run)
        pressure.plot(time, run.history["mean_pressure"], lw=0.8, color=colour, label=label(run))
        curvature.plot(time, run.history["mean_curvature"] * radius, lw=0.8, color=colour)
        scatter = run.history["curvature_scatter"] * radius
        curvature.fill_between(time, 1 - scatter, 1 + scatter, color=colour, alpha=0.12, lw=0)
        profile.plot(*pressure_profile(run.snapshots[-1], radius), "o-", ms=2.5, color=colour)
        if name in results.modern:
            modern = results.modern[name]
            pressure.plot(modern.history["time"] * MILLI, modern.history["mean_pressure"], color=colour, zorder=5, **MODERN)
            profile.plot(*pressure_profile(modern.snapshots[-1], radius), "D", ms=3, mfc="none", color=colour, **MODERN)
    if results.modern:
        profile.plot([], [], "D", ms=3, mfc="none", color="#5b6470", **MODERN, label="mode modern")
        profile.legend(loc="lower left")
    theory = laplace_pressure(run)
    for axes, value in ((pressure, theory), (curvature, 1.0), (profile, theory)):
        axes.axhline(value, color="#333a44", dashes=(6, 3), lw=0.9)
    pressure.set(xlabel="time  (ms)", ylabel="mean pressure  (Pa)", ylim=(0.75 * theory, 1.25 * theory))
    pressure.annotate(rf"$\sigma/R$ = {theory:.1f} Pa", (0.97, theory), xycoords=("axes fraction", "data"), xytext=(0, -11),
                      textcoords="offset points", ha="right", fontsize=7.5)
    pressure.legend(loc="upper right")
    curvature.set(xlabel="time  (ms)", ylabel=r"curvature $\times R$, mean and scatter", ylim=(0, 2))
    profile.set(xlabel="$r/R$ at the end", ylabel="pressure  (Pa)", ylim=(0, 1.5 * theory), xlim=(0, 1))
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    if not results:
        return []
    pictures = (
        ("shapes.png", draw_shapes, "From the square to the circle of equal area (dashed); brighter is faster.", "Fig. 7"),
        ("laplace.png", draw_histories,
         "Mean pressure against sigma/R (dashed and long, diamonds: mode modern), the mean of the curvature and its standard deviation (shaded) against 1/R, and the "
         "pressure over the distance from the centre once the drop is at rest.", "Fig. 8"),
    )
    with plt.rc_context(STYLE):
        return save([(name, draw_one(results), caption, paper) for name, draw_one, caption, paper in pictures], folder)


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
