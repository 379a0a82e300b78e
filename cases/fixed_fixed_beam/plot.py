#!/usr/bin/python3
"""The drop on the middle of a beam clamped at both ends: rebound, its shape and time against the rigid wall's (Figs 12-14).

    /usr/bin/python3 cases/fixed_fixed_beam/plot.py results/comparison/paper/fixed_fixed_beam [--output DIR]

Contact times are set beside those of the study rigid_wall where its results stand beside this one's.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison import quantities  # noqa: E402
from comparison.beam_figures import MILLI, PAPER, Gallery, history_lines, modal_checks, strip  # noqa: E402
from comparison.beam_frequency import first_mode  # noqa: E402
from comparison.beam_quantities import (  # noqa: E402
    case_of, contact_episodes, contact_time, deepest_deflection, history_at, impulse_time, leaving_time,
    lowest_point)
from comparison.standalone import finished_runs, standalone_main  # noqa: E402
from comparison.stretched_beam import stretched_deflection  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from comparison.timoshenko import TimoshenkoBeam  # noqa: E402
from figures import LINES, MODERN, STYLE  # noqa: E402
from modal_beam import modal_deflection  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from figure_particles import colourings, draw_particles  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from sphdrop_reader import Run  # noqa: E402

NAMES = {"U0.5": 0.5, "U0.8": 0.8, "U1.0": 1.0}  # runs: their speeds, m/s
PAPER_FIGURES = {"U0.5": "Fig. 12", "U0.8": "Fig. 13", "U1.0": "Fig. 14"}
PAPER_RIGID = 3.17e-3                             # s, contact time on the rigid wall at every speed
PAPER_CONTACT = {1.0: 0.8 * PAPER_RIGID}          # s


def rigid_run(run: Run) -> Run | None:
    """The same drop on the rigid wall, if that study's results stand beside this one's."""
    name = run.directory.name
    found = finished_runs(run.directory.parent.parent / "rigid_wall", [name])
    return Run(found[name]) if name in found else None


def shape_at_leaving(run: Run) -> float:
    """Width over height of the drop when it leaves."""
    return history_at(run, "drop_width", leaving_time(run)) / history_at(run, "drop_height", leaving_time(run))


def widest(run: Run) -> tuple[float, float]:
    """When, s, and how wide over D0 the drop is at its widest; NaN while it still spreads."""
    time, width = quantities.largest_width(run)
    spreads = time >= run.history["time"][-1]
    return (math.nan, math.nan) if spreads else (time, width / case_of(run)["drop"]["diameter"])


def measure(results: Results) -> dict[str, float]:
    """Lengths in m, times in s; spread D_max/D0, shape and shares as numbers."""
    found: dict[str, float] = {}
    for name, run in results.items():
        deepest_at, depth = deepest_deflection(run)
        exact_at, exact = lowest_point(run.history["time"], modal_deflection(run, theory=TimoshenkoBeam))
        stretched = lowest_point(run.history["time"], stretched_deflection(run))[1]
        widest_at, spread = widest(run)
        has_left = math.isfinite(leaving_time(run))
        found |= {
            f"leaves_at_{name}": leaving_time(run), f"contact_time_{name}": contact_time(run),
            f"impulse_time_{name}": impulse_time(run), f"shape_at_leaving_{name}": shape_at_leaving(run),
            f"largest_deflection_{name}": depth, f"deepest_at_{name}": deepest_at, f"exact_beam_deflection_{name}": -exact,
            f"exact_beam_deepest_at_{name}": exact_at, f"stretched_beam_deflection_{name}": -stretched,
            f"deflection_over_stretched_{name}": depth / -stretched, f"period_{name}": first_mode(run).period, f"widest_at_{name}": widest_at,
            f"spread_{name}": spread, f"rebound_speed_{name}": history_at(run, "drop_velocity_y", leaving_time(run)),
            f"touches_again_{name}": len(contact_episodes(run)) - 1.0 if has_left else math.nan}
        rigid = rigid_run(run)
        if rigid is not None:
            found[f"contact_over_rigid_{name}"] = contact_time(run) / quantities.contact_time(rigid)
            found[f"impulse_time_over_rigid_{name}"] = impulse_time(run) / quantities.impulse_time(rigid)
    return {name: value for name, value in found.items() if math.isfinite(value)}


def draw_shapes(runs: dict[str, Run]) -> Figure | None:
    """Each drop at the snapshot nearest to its leaving."""
    runs = {name: run for name, run in runs.items() if math.isfinite(leaving_time(run))}
    if not runs:
        return None
    frames = [run.snapshots.at(leaving_time(run)) for run in runs.values()]
    liquid, solid = colourings(frames, "xx")
    figure = plt.figure(figsize=(7.6, 3.1), layout="constrained")
    grid = figure.add_gridspec(2, 2 * len(runs), height_ratios=[2.2, 0.1])
    top = max(float(frame["position"][frame.fluid, 1].max()) for frame in frames) * MILLI + 0.1
    for number, ((name, run), frame) in enumerate(zip(runs.items(), frames)):
        axes = figure.add_subplot(grid[0, 2 * number:2 * number + 2])
        draw_particles(axes, frame, liquid, solid)
        middle = 0.5 * case_of(run)["solid"]["length"] * MILLI
        axes.set(xlim=(middle - 1.3, middle + 1.3), ylim=(-0.25, max(top, 1.2)), xlabel="$x$  (mm)")
        axes.set_title(f"$U_0$ = {NAMES[name]:.1f} m/s, leaves at {leaving_time(run) * MILLI:.2f} ms\n"
                       f"width / height = {shape_at_leaving(run):.2f}", loc="left")
    figure.axes[0].set_ylabel("$y$  (mm)")
    for number, colouring in enumerate((liquid, solid)):
        colouring.bar(figure, figure.add_subplot(grid[1, number * len(runs):(number + 1) * len(runs)]), "horizontal")
    return figure


def draw_contact_times(runs: dict[str, Run], modern: dict[str, Run]) -> Figure | None:
    if not runs:
        return None
    figure, axes = plt.subplots(figsize=(5.2, 3.2), layout="constrained")
    rigid = {NAMES[name]: found for name, run in runs.items() if (found := rigid_run(run)) is not None}
    # On the wall the film's middle lifts for a moment: only the last touch ends its contact.
    for label, chosen, colour, time, given, until in (
            ("beam", {NAMES[name]: run for name, run in runs.items()}, LINES[0], contact_time, impulse_time, "until the drop parts"),
            ("rigid wall", rigid, LINES[5], quantities.contact_time, quantities.impulse_time, "until its last touch")):
        if not chosen:
            continue
        axes.plot(list(chosen), [time(run) * MILLI for run in chosen.values()], "o-", ms=4, color=colour, label=f"{label}: {until}")
        axes.plot(list(chosen), [given(run) * MILLI for run in chosen.values()], "o:", ms=4, mfc="none",
                  color=colour, label=f"{label}: 99 % of the impulse")
    if modern:
        axes.plot([NAMES[name] for name in modern], [contact_time(run) * MILLI for run in modern.values()], "D", ms=5, mfc="none",
                  color=LINES[2], **MODERN, label="beam, mode modern: until the drop parts")
    axes.axhline(PAPER_RIGID * MILLI, color="#1c222b", **PAPER, label="paper: rigid wall, 3.17 ms")
    axes.plot(list(PAPER_CONTACT), [time * MILLI for time in PAPER_CONTACT.values()], "*", ms=9, color="#1c222b",
              label="paper: beam, about 0.8 of it")
    axes.set(xlabel="$U_0$  (m/s)", ylabel="contact time  (ms)", xlim=(0.45, 1.05), ylim=(1.5, None))
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def draw_histories(results: Results, runs: dict[str, Run]) -> Figure | None:
    if not runs:
        return None
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.0), layout="constrained")
    for (name, run), colour in zip(runs.items(), LINES):
        label = f"{NAMES[name]:.1f} m/s"
        history_lines(left, run, "deflection", MILLI, color=colour, label=label)
        history_lines(right, run, "drop_width", MILLI, color=colour, label=label)
        if name in results.modern:
            for axes, column in ((left, "deflection"), (right, "drop_width")):
                history_lines(axes, results.modern[name], column, MILLI, color=colour, **MODERN)
        if math.isfinite(leaving_time(run)):
            for axes, column in ((left, "deflection"), (right, "drop_width")):
                axes.plot(leaving_time(run) * MILLI, history_at(run, column, leaving_time(run)) * MILLI, "o", ms=4, color=colour)
    if "U1.0_eps0" in results:
        for axes, column in ((left, "deflection"), (right, "drop_width")):
            history_lines(axes, results["U1.0_eps0"], column, MILLI, color="#5b6470", lw=1, dashes=(3, 2),
                          label=r"1.0 m/s, $\varepsilon$ = 0")
    if results.modern:
        right.plot([], [], color="#5b6470", **MODERN, label="mode modern")
    left.set(xlabel="time  (ms)", ylabel="deflection of mid-span  (mm)", xlim=(0, None))
    right.set(xlabel="time  (ms)", ylabel="$D$  (mm)", xlim=(0, None))
    right.legend(title="dot: leaves", title_fontsize=7.5)
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    gallery = Gallery(folder)
    runs, modern = ({name: those[name] for name in NAMES if name in those} for those in (results, results.modern))
    with plt.rc_context(STYLE):
        for name, run in runs.items():
            end = leaving_time(run)
            times = np.array([0.12, 0.3, 0.5, 0.7, 0.85, 0.93, 1.0, 1.12]) * (end if math.isfinite(end) else 2.5e-3)
            gallery.add(f"strip_{name}", strip(run, times), f"U0 = {NAMES[name]:.1f} m/s, from the impact to the rebound.",
                        PAPER_FIGURES[name])
        gallery.add("shapes", draw_shapes(runs), "The drop as it leaves: well above 1 wide over high is a pancake, near or below 1 "
                    "a pear.", "Figs 12-14")
        gallery.add("contact_times", draw_contact_times(runs, modern), "Contact time over the speed, on the beam and on the rigid wall.")
        gallery.add("histories", draw_histories(results, runs), "Deflection of mid-span and width of the drop. Dashed and long: mode "
                    "modern.")
        checks = {f"$U_0$ = {NAMES[name]:.1f} m/s": run for name, run in runs.items()}
        gallery.add("modal_check", modal_checks(checks), "The exact beams under each run's recorded contact force: without "
                    "and with the stretching that holding both ends takes.")
        checks = {f"$U_0$ = {NAMES[name]:.1f} m/s, mode modern": run for name, run in modern.items()}
        gallery.add("modal_check_modern", modal_checks(checks), "The same of the runs in mode modern.")
    return gallery.drawings


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
