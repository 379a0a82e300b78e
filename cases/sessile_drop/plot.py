#!/usr/bin/python3
"""Drops that wet a solid: the angle at rest against the one asked for, impacts that stick and that do not.

    /usr/bin/python3 cases/sessile_drop/plot.py results/comparison/paper/sessile_drop [--output DIR]
"""

from __future__ import annotations

import math
import sys
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison import quantities  # noqa: E402
from comparison.beam_frequency import fit_damped_sinusoid  # noqa: E402
from comparison.drop_figures import save  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from figures import LINES, STYLE  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from figure_particles import Colouring, WATER, choose_frames, colourings, draw_particles, speed  # noqa: E402
from matplotlib.colors import Normalize  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from numpy.typing import NDArray  # noqa: E402
from sphdrop_reader import Run, Snapshot  # noqa: E402

MILLI = 1e3
NEAR_WALL = 2.0   # spacings: what is lower is not of the cap, as adhesion reaches so far
IMPACT_TIMES = (0.0, 1.0e-3, 2.0e-3, 3.5e-3, 5.0e-3)  # s
BEAM_TIMES = (0.0, 1.5e-3, 3.5e-3, 5.5e-3, 16e-3)      # s


def parameters(run: Run) -> Mapping[str, Any]:
    return tomllib.loads(run.case_text)


def contact_angle(run: Run) -> float:
    """The one asked for, rad."""
    return math.radians(parameters(run)["surface_tension"]["contact_angle"])


def segment_area(angle: float) -> float:
    """Area of a cap of radius 1."""
    return angle - math.sin(angle) * math.cos(angle)


def cap_radius(angle: float, area: float) -> float:
    """Of a cap of that area in m2, m."""
    return math.sqrt(area / segment_area(angle))


def boundary_particles(position: NDArray[np.float64], radius: float) -> NDArray[np.intp]:
    """Those whose circle of this radius the circles of the others do not wholly cover, as the program finds them."""
    found = []
    for k, here in enumerate(position):
        apart = position - here
        distance = np.hypot(*apart.T)
        near = (distance < 2 * radius) & (distance > 0)
        middle = np.arctan2(apart[near, 1], apart[near, 0])
        half = np.arccos(distance[near] / (2 * radius))
        start = (middle - half) % (2 * math.pi)
        order = np.argsort(start)
        start, end = start[order], (start + 2 * half)[order]
        # How far round the covers so far reach; at first, what those that go past the whole turn cover of its beginning.
        reach = np.maximum.accumulate(np.append(max(0.0, float(np.max(end, initial=0.0)) - 2 * math.pi), end))
        if np.all(start <= reach[:-1]) and reach[-1] >= 2 * math.pi:
            continue
        found.append(k)
    return np.array(found, dtype=np.intp)


@dataclass(frozen=True)
class Cap:
    """The circle through a drop's surface, in m, and the angle at which it meets the wall, rad."""

    centre: tuple[float, float]
    radius: float
    angle: float
    scatter: float  # standard deviation of the surface about the circle, m


def fitted_cap(snapshot: Snapshot, spacing: float, support: float) -> Cap:
    """Through the boundary particles, each half a spacing below the surface, that are higher than NEAR_WALL above a wall
    whose surface is at y = 0."""
    position = snapshot["position"][snapshot.fluid]
    points = position[boundary_particles(position, support)]
    points = points[points[:, 1] > NEAR_WALL * spacing]
    x, y, c = np.linalg.lstsq(np.column_stack((2 * points, np.ones(len(points)))), (points**2).sum(axis=1), rcond=None)[0]
    to_particles = math.sqrt(c + x * x + y * y)
    radius = to_particles + 0.5 * spacing
    scatter = float((np.hypot(*(points - (x, y)).T) - to_particles).std())
    return Cap((float(x), float(y)), radius, math.acos(max(-1.0, min(1.0, -y / radius))), scatter)


def cap_of(run: Run, snapshot: Snapshot) -> Cap:
    resolution = parameters(run)["resolution"]
    return fitted_cap(snapshot, resolution["spacing"], 2 * resolution["smoothing_ratio"] * resolution["spacing"])


def liquid_area(run: Run) -> float:
    """m2"""
    snapshot = run.snapshots[-1]
    return float(snapshot["mass"][snapshot.fluid].sum()) / parameters(run)["fluid"]["density"]


def leaving_time(run: Run) -> float:
    """From the first to the last instant with a base on the solid, s; NaN for a drop that is still there at the end."""
    times, touches = run.history["time"], np.nan_to_num(run.history["base_width"]) > 0
    if not touches.any() or times[-1] - times[touches][-1] <= quantities.GAP_LIMIT:
        return math.nan
    return float(times[touches][-1] - times[touches][0])


def last_push(run: Run) -> float:
    """From the first to the last instant with a particle in contact, s."""
    times = run.history["time"][run.history["contact_count"] > 0]
    return float(times[-1] - times[0]) if times.size else math.nan


def swing_period(run: Run, start: float) -> float:
    """The period of a cantilever's end from `start` (s) on, s."""
    times, deflection = run.history["time"], run.history["deflection"]
    chosen = times >= start
    return fit_damped_sinusoid(times[chosen], deflection[chosen], about=2 * math.pi / 3.2e-3).period


def bending_mode(share: NDArray[np.float64]) -> NDArray[np.float64]:
    """The first mode of a cantilever, 1 at its end, at these shares of its length."""
    b = 1.875104068711961
    s = (math.sinh(b) - math.sin(b)) / (math.cosh(b) + math.cos(b))

    def shape(z: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.cosh(z) - np.cos(z) - s * (np.sinh(z) - np.sin(z))

    return shape(b * share) / shape(np.array(b))


def added_mass_factor(run: Run, start: float) -> float:
    """By how much the mass of a drop that moves with the beam makes its period longer (Rayleigh), its particles where they
    are on average from `start` (s) on. The beam's own is a quarter of its mass in that mode."""
    case = parameters(run)
    solid = case["solid"]
    shares = []
    for snapshot in run.snapshots:
        if snapshot.time >= start:
            liquid = snapshot.fluid
            place = snapshot["position"][liquid, 0] / solid["length"]
            shares.append(float((snapshot["mass"][liquid] * bending_mode(place) ** 2).sum()))
    own = solid["density"] * solid["thickness"] * solid["length"] / 4
    return math.sqrt(1 + sum(shares) / len(shares) / own)


def measure(results: Results) -> dict[str, float]:
    """Angles in rad, widths in m, times in s; scatter of the surface in spacings, shares as numbers. A drop `leaves` when its
    base does; its particles have felt the contact's springs for the last time at `last_push`."""
    found: dict[str, float] = {}
    for name, run in results.matching("angle").items():
        cap, history = cap_of(run, run.snapshots[-1]), run.history
        found[name] = cap.angle
        found[f"error_{name}"] = abs(cap.angle - contact_angle(run))
        found[f"scatter_{name}"] = cap.scatter / parameters(run)["resolution"]["spacing"]
        found[f"unaccounted_{name}"] = float(np.abs(history["unaccounted"]).max() / history["surface"][0])
        if contact_angle(run) < math.pi:
            found[f"base_{name}"] = float(history["base_width"][-1])
    for name, run in results.items():
        if name.startswith(("impact", "beam")):
            found[f"leaves_{name}"] = leaving_time(run)
            found[f"stays_{name}"] = float(math.isnan(found[f"leaves_{name}"]))
            if found[f"stays_{name}"] == 0:
                found[f"last_push_{name}"] = last_push(run)
    if "beam30" in results and "beam160" in results:
        dry = swing_period(results["beam160"], 5e-3)
        wet = swing_period(results["beam30"], 5e-3)
        found |= {"period_dry": dry, "period_wet": wet, "period_ratio": wet / dry,
                  "period_ratio_of_added_mass": added_mass_factor(results["beam30"], 5e-3)}
    return {name: value for name, value in found.items() if math.isfinite(value)}


def draw_caps(results: Results) -> Figure | None:
    """Every angle's drop at rest with the cap of its area and angle."""
    runs = results.matching("angle")
    if not runs:
        return None
    columns = min(3, len(runs))
    rows = -(-len(runs) // columns)
    figure, grid = plt.subplots(rows, columns, sharex=True, sharey=True, figsize=(7.6, 1.35 * rows + 0.3), squeeze=False, layout="constrained")
    for axes, run in zip(grid.flat, runs.values()):
        last = run.snapshots[-1]
        liquid = Colouring(speed, "", WATER, Normalize(-0.5, 1.0))  # at rest: one blue
        draw_particles(axes, last, liquid, liquid)
        angle = contact_angle(run)
        radius = cap_radius(angle, liquid_area(run)) * MILLI
        turn = np.linspace(-angle, angle, 400)
        axes.plot(radius * np.sin(turn), radius * (np.cos(turn) - math.cos(angle)), color=LINES[1], lw=0.9)
        axes.set(xlim=(-1.6, 1.6), ylim=(-0.1, 1.1))
        measured = math.degrees(cap_of(run, last).angle)
        axes.set_title(f"{math.degrees(angle):.0f}°: measured {measured:.1f}°", loc="left", pad=2)
        axes.tick_params(length=2, labelsize=7)
    for axes in grid.flat[len(runs):]:
        axes.set_axis_off()
    for axes in grid[-1]:
        axes.set_xlabel("$x$  (mm)")
    for axes in grid[:, 0]:
        axes.set_ylabel("$y$  (mm)")
    return figure


def draw_pairs(results: Results, prefix: str, times: tuple[float, ...],
               window: tuple[tuple[float, float], tuple[float, float]]) -> Figure | None:
    """A row of frames for each run whose name begins so; `window`: lowest and highest x and y in mm."""
    runs = results.matching(prefix)
    if not runs:
        return None
    frames = {name: choose_frames(run.snapshots, len(times), [min(time, run.snapshots[-1].time) for time in times])
              for name, run in runs.items()}
    everything = [frame for row in frames.values() for frame in row]
    liquid, solid = colourings(everything, "xx")
    low, high = window
    figure, grid = plt.subplots(len(runs), len(times), squeeze=False, layout="constrained", sharex=True, sharey=True,
                                figsize=(7.6, len(runs) * (7.0 / len(times) * (high[1] - low[1]) / (high[0] - low[0]) + 0.3) + 0.4))
    for row, (name, run) in zip(grid, runs.items()):
        for axes, frame in zip(row, frames[name]):
            draw_particles(axes, frame, liquid, solid)
            axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
            axes.set_title(f"{math.degrees(contact_angle(run)):.0f}°, {frame.time * MILLI:.1f} ms", loc="left", pad=2)
            axes.tick_params(length=2, labelsize=7)
    for axes in grid[-1]:
        axes.set_xlabel("$x$  (mm)")
    for axes in grid[:, 0]:
        axes.set_ylabel("$y$  (mm)")
    return figure


def draw_histories(results: Results) -> Figure | None:
    """The base's width at rest against that of the cap, and how the beam's end swings with a drop on it and without."""
    caps, beams = results.matching("angle"), results.matching("beam")
    if not caps and not beams:
        return None
    figure, (bases, ends) = plt.subplots(1, 2, figsize=(7.6, 2.9), layout="constrained")
    for run, colour in zip(caps.values(), LINES):
        angle = contact_angle(run)
        if angle < math.pi:
            bases.plot(run.history["time"] * MILLI, run.history["base_width"] * MILLI, color=colour, lw=0.9,
                       label=f"{math.degrees(angle):.0f}°")
            bases.axhline(2 * cap_radius(angle, liquid_area(run)) * math.sin(angle) * MILLI, color=colour, lw=0.7,
                          dashes=(6, 3))
    bases.set(xlabel="time  (ms)", ylabel="width of the base  (mm)")
    if caps:
        bases.legend(ncols=2)
    for run, colour in zip(beams.values(), LINES):
        ends.plot(run.history["time"] * MILLI, run.history["deflection"] * MILLI, color=colour, lw=0.9,
                  label=f"{math.degrees(contact_angle(run)):.0f}°")
    ends.set(xlabel="time  (ms)", ylabel="deflection of the free end  (mm)")
    if beams:
        ends.legend()
    else:
        ends.set_axis_off()
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    if not results:
        return []
    with plt.rc_context(STYLE):
        return save([
            ("caps.png", draw_caps(results), "Drops at rest on a rigid wall with the cap of their area and the angle asked "
             "for.", ""),
            ("impacts.png", draw_pairs(results, "impact", IMPACT_TIMES, ((-1.5, -0.1), (1.5, 1.35))), "An impact at 0.3 m/s: at 60 degrees the drop stays, "
             "at 160 it leaves.", ""),
            ("beams.png", draw_pairs(results, "beam", BEAM_TIMES, ((3.4, -0.2), (8.2, 2.5))), "The same speed on a cantilever of 8 mm: at 30 degrees the "
             "drop stays on it, at 160 it leaves.", ""),
            ("histories.png", draw_histories(results), "Left: the width of the base, broken lines: of the cap. Right: the "
             "free end of the cantilever, which a drop that stays makes slower.", ""),
        ], folder)


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
