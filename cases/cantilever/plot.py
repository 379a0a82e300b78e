#!/usr/bin/python3
"""The drop on the free end of a cantilever: deflection, period, spreading, leaving, and what they depend on (Figs 16, 17, 19-21).

    /usr/bin/python3 cases/cantilever/plot.py results/comparison/paper/cantilever [--output DIR]
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison import quantities  # noqa: E402
from comparison.beam_figures import (  # noqa: E402
    MILLI, PAPER, Gallery, change_bars, convergence_panels, history_lines, modal_checks, strip)
from comparison.beam_frequency import first_mode  # noqa: E402
from comparison.beam_quantities import (  # noqa: E402
    contact_time, deepest_deflection, deviation_from_line, deviation_from_proportion, impulse_time, largest_gap_of_run, leaving_time, lowest_point,
    rows_across, spacing_of, theory_of)
from comparison.convergence import Fit, fit_order  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from comparison.timoshenko import TimoshenkoBeam  # noqa: E402
from figures import LINES, MODERN, STYLE  # noqa: E402
from modal_beam import beam_of, modal_deflection  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from sphdrop_reader import Run  # noqa: E402

LENGTHS, SPEEDS, MAIN = (8, 12, 15, 20), (0.5, 0.6, 0.7, 0.8, 1.0), "L8_U0.8"
CONVERGENCE = ("rows4", "rows6", "rows8", MAIN, "rows16")
VARIATIONS = {
    "half_step": "half the time step", "eps0": r"no artificial stress", "alpha1.0": r"liquid's $\alpha$ = 1",
    "drop_at_tip": "drop's centre at the tip", "drop_one_diameter_in": r"drop's centre at $L - D_0$",
    "stiffness_half": "half the contact stiffness", "stiffness_double": "twice the contact stiffness",
}
# What the paper states: times in ms and what they are of.
PAPER_DEEPEST = {8: 1.3, 20: 4.8}
PAPER_WIDEST = {8: 1.44, 20: 1.4}


def basic(run: Run) -> dict[str, float]:
    """What convergence and variations are told by: m, s, s, 1."""
    return {"largest_deflection": deepest_deflection(run)[1], "contact_time": contact_time(run),
            "impulse_time": impulse_time(run), "spread": quantities.largest_width(run)[1] / 1e-3}


def of_length(results: Results, length: int) -> dict[float, Run]:
    """The runs over the speed."""
    names = {speed: f"L{length}_U{speed:.1f}" for speed in SPEEDS}
    return {speed: results[name] for speed, name in names.items() if name in results}


def convergence(results: Results) -> dict[str, tuple[list[float], list[float], Fit]]:
    """quantity -> spacings in m, values in SI units, fit."""
    runs = [results[name] for name in CONVERGENCE if name in results]
    if len(runs) < 3:
        return {}
    spacings, values = [spacing_of(run) for run in runs], [basic(run) | {"period": first_mode(run).period} for run in runs]
    return {name: (spacings, [value[name] for value in values], fit_order(spacings, [value[name] for value in values]))
            for name in values[0]}


def changes(results: Results) -> dict[str, dict[str, float]]:
    """variation -> quantity -> relative change against the main run."""
    if MAIN not in results:
        return {}
    main = basic(results[MAIN])
    return {name: {quantity: value / main[quantity] - 1 for quantity, value in basic(results[name]).items()}
            for name in VARIATIONS if name in results}


def measure(results: Results) -> dict[str, float]:
    """Lengths in m, times in s; spread D_max/D0 and shares as numbers."""
    found: dict[str, float] = {}
    for length in LENGTHS:
        runs = of_length(results, length)
        periods = []
        for speed, run in runs.items():
            name = f"L{length}_U{speed:.1f}"
            time, depth = deepest_deflection(run)
            ringing = first_mode(run)
            periods.append(ringing.period)
            found |= {f"largest_deflection_{name}": depth, f"period_{name}": ringing.period}
            if speed != 0.8:
                continue
            exact = lowest_point(run.history["time"], modal_deflection(run, theory=TimoshenkoBeam))[1]
            found |= {f"deflection_over_exact_{name}": depth / -exact, f"deepest_at_{name}": time, f"widest_at_{name}": quantities.largest_width(run)[0],
                      f"impulse_time_{name}": impulse_time(run), f"spread_{name}": basic(run)["spread"],
                      f"leaves_at_{name}": leaving_time(run),
                      f"exact_beam_deflection_{name}": -exact, f"largest_gap_{name}": largest_gap_of_run(run)}
        if len(runs) >= 3:
            depths = [deepest_deflection(run)[1] for run in runs.values()]
            found[f"deviation_from_proportion_L{length}"] = deviation_from_proportion(list(runs), depths)
            found[f"deviation_from_line_L{length}"] = deviation_from_line(list(runs), depths)
            found[f"period_scatter_L{length}"] = float(np.max(np.abs(np.array(periods) / np.mean(periods) - 1)))
    for name in ("rows4", "rows6", "rows8", "rows16"):
        if name in results:
            found |= {f"{quantity}_{name}": value for quantity, value in basic(results[name]).items()}
    for name, (_, _, fit) in convergence(results).items():
        found |= {f"{name}_order": fit.order, f"{name}_limit": fit.limit}
    for name, values in changes(results).items():
        found |= {f"{quantity}_change_{name}": value for quantity, value in values.items()}
    return {name: value for name, value in found.items() if math.isfinite(value)}


def draw_lengths(results: Results) -> Figure | None:
    lengths = [length for length in LENGTHS if f"L{length}_U0.8" in {**results, **results.modern}]
    if not lengths:
        return None
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.1), layout="constrained")
    for length, colour in zip(lengths, LINES):
        for axes, column in ((left, "deflection"), (right, "drop_width")):
            axes.plot([], [], color=colour, label=f"$L$ = {length} mm")
            for those, style in ((results, {}), (results.modern, MODERN)):
                if f"L{length}_U0.8" in those:
                    run = those[f"L{length}_U0.8"]
                    history_lines(axes, run, column, MILLI, color=colour, **style)
        depth = theory_of(run).largest_deflection * MILLI
        left.axhline(-depth, xmin=0.97, color=colour, lw=2, solid_capstyle="butt")
        for axes, paper in ((left, PAPER_DEEPEST), (right, PAPER_WIDEST)):
            if length in paper:
                axes.axvline(paper[length], color=colour, **PAPER)
    if results.modern:
        left.plot([], [], color="#5b6470", **MODERN, label="mode modern")
    left.plot([], [], color="#5b6470", lw=2, label="Eq 46, at the right")
    left.plot([], [], color="#5b6470", **PAPER, label="deepest in the paper")
    right.plot([], [], color="#5b6470", **PAPER, label="widest in the paper")
    left.set(xlabel="time  (ms)", ylabel=r"$\delta$  (mm)", xlim=(0, None))
    right.set(xlabel="time  (ms)", ylabel="$D$  (mm)", xlim=(0, 4))
    for axes in (left, right):
        axes.legend(loc="lower left", bbox_to_anchor=(-0.05, 1.0), ncols=3, fontsize=6.5, columnspacing=1.0, handlelength=1.6)
    return figure


def draw_speeds(results: Results) -> Figure | None:
    lengths = [length for length in LENGTHS if of_length(results, length) or of_length(results.modern, length)]
    if not lengths:
        return None
    columns = min(2, len(lengths))
    rows = math.ceil(len(lengths) / columns)
    figure, axes = plt.subplots(rows, columns, figsize=(7.6, 2.7 * rows), squeeze=False, layout="constrained")
    for panel in axes.flat[len(lengths):]:
        panel.set_axis_off()
    for panel, length in zip(axes.flat, lengths):
        for speed, run in of_length(results, length).items():
            history_lines(panel, run, "deflection", MILLI, color=LINES[SPEEDS.index(speed)])
        for speed, run in of_length(results.modern, length).items():
            history_lines(panel, run, "deflection", MILLI, color=LINES[SPEEDS.index(speed)], **MODERN)
        panel.set(title=f"$L$ = {length} mm", xlabel="time  (ms)", ylabel=r"$\delta$  (mm)", xlim=(0, None))
    for speed, colour in zip(SPEEDS, LINES):
        panel.plot([], [], color=colour, label=f"{speed:.1f} m/s")
    panel.legend(title="$U_0$", loc="lower left", title_fontsize=7.5)
    return figure


def draw_theory(results: Results) -> Figure | None:
    """Largest deflection over the speed, period over the length, frequency over the speed."""
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(7.8, 3.0), layout="constrained")
    for length, colour in zip(LENGTHS, LINES):
        runs, modern = of_length(results, length), of_length(results.modern, length)
        if not runs and not modern:
            continue
        first = theory_of(next(iter({**modern, **runs}.values())))
        speeds = np.array(list(runs))
        left.plot(speeds, [deepest_deflection(run)[1] * MILLI for run in runs.values()], "o", ms=4, color=colour,
                  label=f"{length} mm")
        slope = first.largest_deflection / next(iter({**modern, **runs}))
        left.plot([0, 1.05], [0, slope * 1.05 * MILLI], color=colour, lw=1, dashes=(4, 2))
        periods = [first_mode(run).period for run in runs.values()]
        middle.plot([length] * len(periods), np.array(periods) * MILLI, "o", ms=4, color=colour, mfc="none")
        theory = first.period
        right.plot(speeds, theory / np.array(periods), "o-", ms=4, color=colour, label=f"{length} mm")
        modern_periods = np.array([first_mode(run).period for run in modern.values()])
        left.plot(list(modern), [deepest_deflection(run)[1] * MILLI for run in modern.values()], "D", ms=4, mfc="none", color=colour)
        middle.plot([length] * len(modern), modern_periods * MILLI, "D", ms=4, mfc="none", color=colour)
        right.plot(list(modern), theory / modern_periods, "D", ms=4, mfc="none", color=colour, **MODERN)
    if not left.lines:
        plt.close(figure)
        return None
    beam = beam_of(next(iter([*results.values(), *results.modern.values()])))
    lengths = np.linspace(6, 21, 100) / MILLI
    period = 2 * math.pi / beam.angular_frequencies(1)[0]
    middle.plot(lengths * MILLI, period * (lengths / beam.length) ** 2 * MILLI, color="#5b6470", lw=1, dashes=(4, 2),
                label="Eq 44")
    left.plot([], [], color="#5b6470", lw=1, dashes=(4, 2), label="Eq 46")
    if results.modern:
        left.plot([], [], "D", ms=4, mfc="none", color="#5b6470", label="mode modern")
    left.set(xlabel="$U_0$  (m/s)", ylabel=r"$\delta_\mathrm{max}$  (mm)", xlim=(0, 1.08), ylim=(0, None))
    middle.set(xlabel="$L$  (mm)", ylabel="period of the first mode  (ms)", ylim=(0, None))
    right.set(xlabel="$U_0$  (m/s)", ylabel=r"frequency / theory ($\tau_0/\tau$)", xlim=(0.45, 1.05), ylim=(0.7, 1.05))
    right.axhline(1.0, color="#5b6470", lw=1, dashes=(4, 2))
    for axes in (left, middle, right):
        axes.legend()
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    gallery = Gallery(folder)
    with plt.rc_context(STYLE):
        times = {8: (0.2, 0.6, 1.0, 1.4, 1.8, 2.4, 3.0, 3.6), 20: (0.2, 0.8, 1.4, 2.0, 2.6, 3.2, 4.0, 4.8)}
        for length, figure in ((8, "Fig. 16"), (20, "Fig. 17")):
            if f"L{length}_U0.8" in results:
                gallery.add(f"strip_L{length}", strip(results[f"L{length}_U0.8"], [t / MILLI for t in times[length]]),
                            f"L = {length} mm, U0 = 0.8 m/s: the liquid's speed and the beam's stress along it.", figure)
        gallery.add("lengths", draw_lengths(results), "Deflection of the free end and width of the drop for the lengths, U0 = 0.8 "
                    "m/s. Dashed: mode modern. Dotted: when the paper has the beam deepest and the drop widest.", "Figs 19-21")
        gallery.add("speeds", draw_speeds(results), "Deflection of the free end for the speeds; dashed: mode modern.",
                    "Figs 19-21")
        gallery.add("theory", draw_theory(results), "Largest deflection over the speed with Eq 46; period of the first mode over "
                    "the length with Eq 44; frequency over the speed.", "Figs 19-21")
        checks = {f"$L$ = {length} mm": results[f"L{length}_U0.8"] for length in LENGTHS if f"L{length}_U0.8" in results}
        modern_checks = {f"$L$ = {length} mm, mode modern": results.modern[f"L{length}_U0.8"] for length in LENGTHS
                         if f"L{length}_U0.8" in results.modern}
        gallery.add("modal_check", modal_checks(checks), "The exact beams under each run's recorded contact force: what differs is "
                    "the particles' beam, not the coupling.")
        gallery.add("modal_check_modern", modal_checks(modern_checks), "The same of the runs in mode modern.")
        labels = {"largest_deflection": (r"$\delta_\mathrm{max}$  (mm)", MILLI), "contact_time": ("contact time  (ms)", MILLI),
                  "impulse_time": ("99 % of the impulse  (ms)", MILLI), "spread": (r"$D_\mathrm{max}/D_0$", 1.0),
                  "period": ("period of the first mode  (ms)", MILLI)}
        series, modern_series = {}, {}
        modern = [results.modern[name] for name in CONVERGENCE if name in results.modern]
        modern_values = [basic(run) | {"period": first_mode(run).period} for run in modern]
        for name, (spacings, values, _) in convergence(results).items():
            label, scale = labels[name]
            drawn = [value * scale for value in values]
            series[label] = (spacings, drawn, fit_order(spacings, drawn))
            if modern:
                modern_series[label] = ([spacing_of(run) for run in modern], [found[name] * scale for found in modern_values])
        rows = ", ".join(str(rows_across(results[name])) for name in CONVERGENCE if name in results)
        gallery.add("convergence", convergence_panels(series, modern_series), f"{rows} rows across the beam, L = 8 mm, U0 = 0.8 m/s. Red: the "
                    "limit that the fit names.")
        words = {"largest_deflection": r"$\delta_\mathrm{max}$", "contact_time": "contact time",
                 "impulse_time": "99 % of the impulse", "spread": r"$D_\mathrm{max}$"}
        bars = {VARIATIONS[name]: {words[key]: value for key, value in values.items()} for name, values in changes(results).items()}
        gallery.add("variations", change_bars(bars), "What a variation changes against L = 8 mm, U0 = 0.8 m/s.")
    return gallery.drawings


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
