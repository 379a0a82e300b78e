#!/usr/bin/python3
"""Drops of two, three and four lobes, given as particles: period and decay of their swing against theory.

    /usr/bin/python3 cases/lobed_droplet/plot.py results/comparison/paper/lobed_droplet [--output DIR]
"""

from __future__ import annotations

import math
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison.drop_figures import save  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from figures import LINES, STYLE  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from figure_particles import choose_frames, colourings, draw_particles  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from numpy.typing import NDArray  # noqa: E402
from sphdrop_reader import Run, Snapshot  # noqa: E402

MILLI = 1e3
Array = NDArray[np.float64]


def parameters(run: Run) -> Mapping[str, Any]:
    return tomllib.loads(run.case_text)


def mode_of(name: str) -> int:
    """n of a run "mode3"."""
    return int(name.removeprefix("mode"))


def radius_of(run: Run) -> float:
    """R in m of the circle with the drop's area."""
    return parameters(run)["drop"]["diameter"] / 2


def ideal_period(run: Run, mode: int) -> float:
    """Of a small swing without viscosity, s: omega^2 = n (n^2 - 1) sigma/(rho R^3)."""
    case = parameters(run)
    sigma, density = case["surface_tension"]["coefficient"], case["fluid"]["density"]
    return 2 * math.pi / math.sqrt(mode * (mode**2 - 1) * sigma / (density * radius_of(run) ** 3))


def ideal_decay_time(run: Run, mode: int) -> float:
    """In which a small swing falls to 1/e where the viscosity is small, s: R^2/(2 n (n - 1) nu), by what the potential flow
    dissipates (Lamb, Hydrodynamics, Art. 355, in two dimensions)."""
    fluid = parameters(run)["fluid"]
    return radius_of(run) ** 2 * fluid["density"] / (2 * mode * (mode - 1) * fluid["viscosity"])


def amplitude(snapshot: Snapshot, mode: int, radius: float) -> float:
    """a of the outline R(1 + a cos n theta), by the mean of r^n cos n theta over the liquid, which is a R^n for a small one."""
    liquid = snapshot.fluid
    mass = snapshot["mass"][liquid]
    place = snapshot["position"][liquid] @ np.array([1, 1j])
    place -= (mass * place).sum() / mass.sum()
    return float((mass * (place / radius) ** mode).real.sum() / mass.sum())


def swing(run: Run, mode: int) -> tuple[Array, Array]:
    """Times in s and amplitudes."""
    snapshots = list(run.snapshots)
    return (np.array([snapshot.time for snapshot in snapshots]),
            np.array([amplitude(snapshot, mode, radius_of(run)) for snapshot in snapshots]))


def zero_crossings(times: Array, values: Array) -> Array:
    change = np.flatnonzero(values[:-1] * values[1:] < 0)
    share = values[change] / (values[change] - values[change + 1])
    return times[change] + share * (times[change + 1] - times[change])


def period(times: Array, values: Array) -> float:
    """s; the mean time between a zero crossing and the next but one. Those between are no use: the swing is not about zero,
    by the square of its size."""
    crossings = zero_crossings(times, values)
    return float((crossings[2:] - crossings[:-2]).mean())


def extrema(times: Array, values: Array) -> tuple[Array, Array]:
    """The start and all that follow, each from the parabola through three values."""
    slope = np.diff(values)
    middle = np.flatnonzero(slope[:-1] * slope[1:] < 0) + 1
    before, after = values[middle - 1] - values[middle], values[middle + 1] - values[middle]
    shift = 0.5 * (before - after) / (before + after)  # in intervals
    heights = values[middle] - 0.25 * (before - after) * shift
    return (np.concatenate([[times[0]], times[middle] + shift * (times[1] - times[0])]), np.concatenate([[values[0]], heights]))


def decay_time(times: Array, values: Array) -> float:
    """s; from the first and the last way between two extrema, wherever the middle of the swing is."""
    when, heights = extrema(times, values)
    ways, middles = np.abs(np.diff(heights)), 0.5 * (when[1:] + when[:-1])
    return float((middles[-1] - middles[0]) / math.log(ways[0] / ways[-1]))


def area_change(run: Run) -> float:
    """The largest difference of the area, sum of m/rho, from that at the start, over it."""
    areas = [float((snapshot["mass"] / snapshot["density"])[snapshot.fluid].sum()) for snapshot in run.snapshots]
    return max(abs(area / areas[0] - 1) for area in areas)


def measure(results: Results) -> dict[str, float]:
    """Periods and decay times in s, their share of theory's, the change of area."""
    found = {}
    for name, run in results.items():
        mode = mode_of(name)
        times, values = swing(run, mode)
        found[f"period_{name}"] = period(times, values)
        found[f"decay_time_{name}"] = decay_time(times, values)
        found[f"area_change_{name}"] = area_change(run)
    return found


def draw_shapes(results: Results) -> Figure:
    """A row for each mode, over its first period."""
    shares = (0.0, 0.25, 0.5, 0.75, 1.0)
    figure, grid = plt.subplots(len(results), len(shares), figsize=(7.6, 1.62 * len(results) + 0.4), sharex=True, sharey=True,
                                squeeze=False, layout="constrained")
    for row, (name, run) in zip(grid, results.items()):
        times = [share * ideal_period(run, mode_of(name)) for share in shares]
        frames = choose_frames(run.snapshots, len(times), times)
        liquid, solid = colourings(frames, "xx")
        for axes, frame in zip(row, frames):
            draw_particles(axes, frame, liquid, solid)
            axes.add_patch(plt.Circle((0, 0), radius_of(run) * MILLI, fill=False, color=LINES[1], lw=0.7, ls=(0, (5, 3))))
            axes.set(xlim=(-0.6, 0.6), ylim=(-0.6, 0.6), xticks=(-0.5, 0, 0.5), yticks=(-0.5, 0, 0.5))
            axes.set_title(f"{frame.time * MILLI:.2f} ms", loc="left", pad=2)
            axes.tick_params(length=2, labelsize=7)
        row[0].set_ylabel(f"$n$ = {mode_of(name)}\n$y$  (mm)", fontsize=7.5)
    for axes in grid[-1]:
        axes.set_xlabel("$x$  (mm)", fontsize=7.5)
    return figure


def draw_swings(results: Results) -> Figure:
    """Amplitudes over time in periods of theory, and theory's."""
    figure, axes = plt.subplots(figsize=(6.4, 2.8), layout="constrained")
    for (name, run), colour in zip(results.items(), LINES):
        mode = mode_of(name)
        times, values = swing(run, mode)
        whole = ideal_period(run, mode)
        exact = np.exp(-times / ideal_decay_time(run, mode)) * np.cos(2 * math.pi * times / whole)
        axes.plot(times / whole, values / values[0], color=colour, lw=1.2, label=f"$n$ = {mode}")
        axes.plot(times / whole, exact, color=colour, lw=0.8, dashes=(4, 2))
    axes.set(xlabel="time over theory's period", ylabel="$a/a_0$")
    axes.margins(x=0.01)
    axes.legend(loc="lower right", bbox_to_anchor=(1, 0.99), ncols=3, borderaxespad=0)
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    if not results:
        return []
    pictures = (
        ("shapes.png", draw_shapes, "The first period; dashed: the circle of the drop's area. Brighter is faster."),
        ("swings.png", draw_swings, "The amplitude of each mode; dashed: theory of a small swing with little viscosity."),
    )
    with plt.rc_context(STYLE):
        return save([(name, draw_one(results), caption, "") for name, draw_one, caption in pictures], folder)


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
