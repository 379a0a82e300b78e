#!/usr/bin/python3
"""The drop on a soft cantilever: how far it bends, how the drop rolls off, mid-span against tip (Figs 22, 23).

    /usr/bin/python3 cases/soft_cantilever/plot.py results/comparison/paper/soft_cantilever [--output DIR]
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison.beam_figures import MILLI, Gallery, history_lines, strip  # noqa: E402
from comparison.beam_frequency import first_mode  # noqa: E402
from comparison.beam_quantities import (  # noqa: E402
    case_of, deepest_deflection, history_at, impulse_time, largest_gap, largest_gap_of_run, largest_row_strain, leaving_time,
    lowest_point, section_displacement, theory_of)
from comparison.exact_beam import Array  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from comparison.timoshenko import TimoshenkoBeam  # noqa: E402
from figures import LINES, MODERN, STYLE  # noqa: E402
from modal_beam import modal_deflection  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from figure_particles import colourings, draw_particles  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from sphdrop_reader import Run  # noqa: E402

SAMPLE = 2e-4  # s: the rates of mid-span and tip are differences over this time, that of the snapshots
PAPER_CHI = 0.29
BLOW = "blow"  # how the names of runs begin that ask whether the beam bears it


def label_of(run: Run) -> str:
    """Speed and artificial stress."""
    case = case_of(run)
    return (f"$U_0$ = {-case['drop']['velocity'][1]:.1f} m/s, "
            rf"$\varepsilon$ = {case['solid']['artificial_stress_coefficient']:g}")


def is_modern(run: Run) -> bool:
    return case_of(run).get("mode") == "modern"


def length_of(run: Run) -> float:
    """L, m"""
    return float(case_of(run)["solid"]["length"])


def middle_deflection(run: Run) -> tuple[Array, Array]:
    """Times in s and vertical displacement of mid-span in m: of the history, or else of the snapshots."""
    if "middle_deflection" in run.history:
        return run.history["time"], run.history["middle_deflection"]
    times, displacement = section_displacement(run, 0.5 * length_of(run))
    return times, displacement[:, 1]


def tip_place(run: Run) -> tuple[Array, Array]:
    """Times in s and x of the free end in m."""
    if "tip_displacement_x" in run.history:
        return run.history["time"], length_of(run) + run.history["tip_displacement_x"]
    times, displacement = section_displacement(run, length_of(run))
    return times, length_of(run) + displacement[:, 0]


def rates(run: Run) -> tuple[Array, Array, Array]:
    """Times in s from the drop's leaving on, and the mean vertical velocities of mid-span and tip in m/s over SAMPLE."""
    start, end = leaving_time(run), run.history["time"][-1]
    if not math.isfinite(start) or end - start < 3 * SAMPLE:
        return np.empty(0), np.empty(0), np.empty(0)
    times = SAMPLE * np.arange(math.ceil(start / SAMPLE), math.floor(end / SAMPLE + 1e-6) + 1)
    middle = np.interp(times, *middle_deflection(run))
    tip = np.interp(times, run.history["time"], run.history["deflection"])
    return 0.5 * (times[1:] + times[:-1]), np.diff(middle) / SAMPLE, np.diff(tip) / SAMPLE


def beyond_tip(run: Run) -> tuple[Array, Array]:
    """Times in s and how far the drop's mass centre lies beyond the free end, in x, m."""
    times = run.history["time"]
    return times, run.history["drop_centre_x"] - np.interp(times, *tip_place(run))


def passes_tip_at(run: Run) -> float:
    """When the drop's mass centre comes to lie beyond the free end, s; NaN if it does not."""
    times, beyond = beyond_tip(run)
    rows = np.flatnonzero((beyond[1:] > 0) & (beyond[:-1] <= 0))
    if rows.size == 0:
        return math.nan
    k = rows[0]
    return float(times[k] - beyond[k] * (times[k + 1] - times[k]) / (beyond[k + 1] - beyond[k]))


def measure(results: Results) -> dict[str, float]:
    """Lengths in m, times in s, speeds in m/s; shares as numbers."""
    found: dict[str, float] = {}
    for name, run in results.items():
        deepest_at, depth = deepest_deflection(run)
        leaves, gap = leaving_time(run), largest_gap_of_run(run)
        found |= {f"largest_deflection_{name}": depth, f"largest_gap_{name}": gap,
                  f"gap_over_strain_{name}": (gap - 1) / largest_row_strain(run)}
        if name.startswith(BLOW):  # no swing of a beam that holds together
            found[f"relative_deflection_{name}"] = depth / length_of(run)
            continue
        found |= {f"deepest_at_{name}": deepest_at, f"leaves_at_{name}": leaves, f"impulse_time_{name}": impulse_time(run),
                  f"frequency_ratio_{name}": theory_of(run).period / first_mode(run).period}
        if name.startswith("free_end"):
            exact = lowest_point(run.history["time"], modal_deflection(run, theory=TimoshenkoBeam))[1]
            found |= {f"relative_deflection_{name}": depth / length_of(run), f"deflection_over_exact_{name}": depth / -exact,
                      f"centre_beyond_tip_at_leaving_{name}": float(np.interp(leaves, *beyond_tip(run))),
                      f"drop_velocity_x_at_leaving_{name}": history_at(run, "drop_velocity_x", leaves),
                      f"passes_tip_at_{name}": passes_tip_at(run)}
        else:
            times, middle = middle_deflection(run)
            found |= {f"middle_deflection_{name}": -float(middle.min()),
                      f"tip_rises_by_{name}": float(run.history["deflection"].max())}
            _, middle_rate, tip_rate = rates(run)
            if middle_rate.size:
                found[f"rate_correlation_{name}"] = float(np.corrcoef(middle_rate, tip_rate)[0, 1])
                found[f"opposite_share_{name}"] = float(np.mean(middle_rate * tip_rate < 0))
    return {name: value for name, value in found.items() if math.isfinite(value)}


def draw_free_end(results: Results) -> Figure | None:
    runs = results.matching("free_end")
    if not runs:
        return None
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.1), layout="constrained")
    for run, colour in zip(runs.values(), LINES):
        label = label_of(run)
        left.plot(run.history["time"] * MILLI, -run.history["deflection"] / length_of(run), color=colour, label=label)
        times, beyond = beyond_tip(run)
        right.plot(times * MILLI, beyond * MILLI, color=colour, label=label)
        leaves = leaving_time(run)
        if math.isfinite(leaves):
            left.plot(leaves * MILLI, -history_at(run, "deflection", leaves) / length_of(run), "o", ms=4, color=colour)
            right.plot(leaves * MILLI, np.interp(leaves, times, beyond) * MILLI, "o", ms=4, color=colour)
    for name, colour in zip(runs, LINES):
        if name in results.modern:
            run = results.modern[name]
            times, beyond = beyond_tip(run)
            left.plot(run.history["time"] * MILLI, -run.history["deflection"] / length_of(run), color=colour, **MODERN)
            right.plot(times * MILLI, beyond * MILLI, color=colour, **MODERN)
    if results.modern.matching("free_end"):
        right.plot([], [], color="#5b6470", **MODERN, label="mode modern")
        right.legend()
    for theory in sorted({round(theory_of(run).relative_deflection, 9) for run in runs.values()}):
        left.axhline(theory, color="#5b6470", lw=1, dashes=(4, 2), label=rf"Eqs 46, 47: $\chi$ = {theory:.3f}")
    left.axhline(PAPER_CHI, color="#1c222b", lw=1, dashes=(1, 1.5), label=rf"paper: $\chi$ about {PAPER_CHI}")
    left.set(xlabel="time  (ms)", ylabel=r"$-\delta / L$", xlim=(0, None))
    right.axhline(0.0, color="#5b6470", lw=0.6)
    right.set(xlabel="time  (ms)", ylabel="drop's centre beyond the tip  (mm)", xlim=(0, None))
    left.legend(title="dot: the drop leaves", title_fontsize=7.5, fontsize=6.5)
    return figure


def draw_mid_span(results: Results) -> Figure | None:
    runs = list(results.matching("mid_span").values())
    if not runs:
        return None
    modern = list(results.modern.matching("mid_span").values())[:1]
    runs += modern
    figure, axes = plt.subplots(2, len(runs), figsize=(max(4.6, 2.9 * len(runs)), 4.6), squeeze=False, sharex="col",
                                layout="constrained", height_ratios=[1.5, 1])
    for column, run in enumerate(runs):
        above, below = axes[:, column]
        times, middle = middle_deflection(run)
        above.plot(times * MILLI, middle * MILLI, color=LINES[0], label="mid-span, under the drop")
        history_lines(above, run, "deflection", MILLI, color=LINES[1], label="tip")
        above.set_title(f"{label_of(run).split(',')[0]}, mode modern" if is_modern(run) else label_of(run))
        when, middle_rate, tip_rate = rates(run)
        if when.size:
            below.plot(when * MILLI, middle_rate, color=LINES[0])
            below.plot(when * MILLI, tip_rate, color=LINES[1])
            correlation = np.corrcoef(middle_rate, tip_rate)[0, 1]
            below.set_title(f"after the drop has left: correlation {correlation:+.2f}")
            for panel in (above, below):
                panel.axvline(leaving_time(run) * MILLI, color="#5b6470", lw=0.8, dashes=(4, 2))
        below.axhline(0.0, color="#5b6470", lw=0.6)
        below.set(xlabel="time  (ms)", xlim=(0, None))
    axes[0, 0].set_ylabel("displacement  (mm)")
    axes[1, 0].set_ylabel("velocity  (m/s)")
    axes[0, 0].legend()
    return figure


def draw_blow(results: Results) -> Figure | None:
    """The beam where its neighbours have parted most, in the paper's scheme and in mode modern."""
    runs = [*results.matching(BLOW).values(), *results.modern.matching(BLOW).values()]
    if not runs:
        return None
    figure, axes = plt.subplots(1, len(runs), figsize=(3.8 * len(runs), 3.6), squeeze=False, sharey=True, layout="constrained")
    for panel, run in zip(axes[0], runs):
        frame = max(run.snapshots, key=lambda snapshot: largest_gap(run, snapshot))
        liquid, solid = colourings([frame], "xx")
        draw_particles(panel, frame, liquid, solid)
        panel.set(xlim=(-0.6, 11.5), ylim=(-9.0, 2.0), xlabel="$x$  (mm)", aspect="equal")
        panel.set_title(f"{'mode modern' if is_modern(run) else label_of(run)}, {frame.time * MILLI:.1f} ms:\n"
                        f"gaps to {largest_gap(run, frame):.2f} $d$", loc="left")
    axes[0, 0].set_ylabel("$y$  (mm)")
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    gallery = Gallery(folder)
    with plt.rc_context(STYLE):
        if "free_end" in results:
            run = results["free_end"]
            leaves = leaving_time(run)
            end = leaves if math.isfinite(leaves) else run.history["time"][-1]
            times = np.array([0.1, 0.3, 0.5, 0.7, 0.85, 1.0, 1.3, 1.7]) * end
            gallery.add("strip_free_end", strip(run, times), "The drop on the free end: the beam gives way and the drop rolls off.",
                        "Fig. 22")
        if "free_end" in results.modern:
            run = results.modern["free_end"]
            leaves = leaving_time(run)
            end = leaves if math.isfinite(leaves) else run.history["time"][-1]
            gallery.add("strip_free_end_modern", strip(run, np.array([0.1, 0.3, 0.5, 0.7, 0.85, 1.0, 1.3, 1.7]) * end),
                        "The same in mode modern.", "Fig. 22")
        gallery.add("free_end", draw_free_end(results), "Deflection of the free end over the length, and how far the drop's mass "
                    "centre lies beyond the tip: positive when it leaves is a drop that rolled off.", "Fig. 22")
        if "mid_span" in results:
            gallery.add("strip_mid_span", strip(results["mid_span"], np.array([0.6, 1.2, 2.0, 3.0, 4.0, 5.5, 7.0, 9.0]) / MILLI),
                        "The drop on mid-span.", "Fig. 23")
        gallery.add("mid_span", draw_mid_span(results), "Mid-span and tip: the tip rises first and follows late, then the two move "
                    "against each other. Dashed: the drop leaves.", "Fig. 23")
        gallery.add("blow", draw_blow(results), "A drop of 4 m/s on the free end, four rows: the beam where neighbours have parted most.")
    return gallery.drawings


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
