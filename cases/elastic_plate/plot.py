#!/usr/bin/python3
"""Gray's oscillating plate: period and swing against theory and other codes, rows across it, the artificial stress.

    /usr/bin/python3 cases/elastic_plate/plot.py results/comparison/paper/elastic_plate [--output DIR]
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison import quantities  # noqa: E402
from comparison.beam_figures import Gallery, convergence_panels  # noqa: E402
from comparison.beam_quantities import case_of, gaps, rows_across, spacing_of, theory_of  # noqa: E402
from comparison.convergence import Fit, fit_order  # noqa: E402
from comparison.exact_beam import Array  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from figure_particles import colourings, draw_particles  # noqa: E402
from figures import LINES, STYLE  # noqa: E402
from modal_beam import beam_of  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.cm import ScalarMappable  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from sphdrop_reader import Run, Snapshot  # noqa: E402

MILLI = 1e3
ROWS = ("rows6", "rows10", "rows20")
STRESSES = ("rows10", "rows10_eps0.1", "rows10_eps0")
VARIATIONS = {"rows10_half_step": "rows10"}  # and the run that it differs from
OTHER_CODES = 0.28  # s: the period that other SPH codes have, about
THEORY = "#1c222b"


def periods(run: Run) -> Array:
    """From each passage through rest to the second next, the start as the first, s."""
    crossings = np.concatenate([[0.0], quantities.zero_crossings(run.history["time"], run.history["deflection"])])
    return crossings[2:] - crossings[:-2]


def first_swings(run: Run) -> tuple[float, float]:
    """The highest place in the first half period and the lowest in the second, m, the latter as a positive number; NaN
    where the run is too short."""
    times, deflection = run.history["time"], run.history["deflection"]
    crossings = np.concatenate([[0.0], quantities.zero_crossings(times, deflection)])
    found = []
    for start, end in zip(crossings[:2], crossings[1:3]):
        rows = (times >= start) & (times <= end)
        found.append(quantities.highest_point(times[rows], np.abs(deflection[rows]))[1])
    up, down, *_ = [*found, math.nan, math.nan]
    return up, down


def energy_loss(run: Run) -> float:
    """Share of the plate's kinetic and elastic energy that is gone after its first period; NaN if it is not watched."""
    found = periods(run)
    energy = run.history["kinetic_solid"] + run.history["elastic"]
    return 1 - float(np.interp(found[0], run.history["time"], energy)) / energy[0] if found.size else math.nan


def clamp_gap(run: Run, snapshot: Snapshot) -> float:
    """The largest stretch of neighbouring particles' distance within two thicknesses of the clamp: far above 1 a crack."""
    where, stretch = gaps(run, snapshot)
    return float(stretch[where[:, 0] < 2 * beam_of(run).thickness].max())


def mean_period(run: Run) -> float:
    """s"""
    found = periods(run)
    return float(found.mean()) if found.size else math.nan


def convergence(results: Results) -> tuple[list[float], list[float], Fit] | None:
    """Spacings in m, tau0/tau, and their fit; None with fewer than three resolutions."""
    runs = [results[name] for name in ROWS if name in results]
    if len(runs) < 3:
        return None
    spacings, ratios = [spacing_of(run) for run in runs], [theory_of(run).period / mean_period(run) for run in runs]
    return spacings, ratios, fit_order(spacings, ratios)


def theoretical_swing(run: Run) -> float:
    """Initial velocity of the tip over the angular frequency, m."""
    return float(case_of(run)["solid"]["initial_tip_velocity"]) / theory_of(run).angular_frequency


def measure(results: Results) -> dict[str, float]:
    """Lengths in m, times in s, shares as numbers."""
    found: dict[str, float] = {}
    for name, run in results.items():
        up, down = first_swings(run)
        period = mean_period(run)
        found |= {f"period_{name}": period, f"frequency_ratio_{name}": theory_of(run).period / period, f"swing_up_{name}": up,
                  f"swing_down_{name}": down, f"energy_loss_{name}": energy_loss(run),
                  f"clamp_gap_{name}": max(clamp_gap(run, snapshot) for snapshot in run.snapshots)}
    for name, main in VARIATIONS.items():
        if name in results and main in results:
            found[f"period_change_{name}"] = mean_period(results[name]) / mean_period(results[main]) - 1
    fitted = convergence(results)
    if fitted is not None:
        found |= {"frequency_ratio_order": fitted[2].order, "frequency_ratio_limit": fitted[2].limit}
    return {name: value for name, value in found.items() if math.isfinite(value)}


def draw_histories(results: Results) -> Figure | None:
    """The tip over time: left for the rows, right for the artificial stress."""
    groups = [[name for name in names if name in results] for names in (ROWS, STRESSES)]
    if not any(groups):
        return None
    figure, axes = plt.subplots(1, 2, figsize=(7.6, 3.1), sharey=True, layout="constrained")
    for panel, names in zip(axes, groups):
        for name, colour in zip(names, LINES):
            run = results[name]
            stress = case_of(run)["solid"]["artificial_stress_coefficient"]
            label = f"{rows_across(run)} rows" if panel is axes[0] else rf"10 rows, $\varepsilon$ = {stress:g}"
            panel.plot(run.history["time"], run.history["deflection"] * MILLI, color=colour, label=label)
    for panel, name in zip(axes, ("rows6", "rows10")):
        if name in results.modern:
            run = results.modern[name]
            panel.plot(run.history["time"], run.history["deflection"] * MILLI, color=LINES[3], lw=2.5, alpha=0.6,
                       label=f"{rows_across(run)} rows, mode modern")
    run = results[next(name for names in groups for name in names)]
    times, omega = np.linspace(0, run.history["time"][-1], 600), theory_of(run).angular_frequency
    for panel in axes:
        panel.plot(times, theoretical_swing(run) * MILLI * np.sin(omega * times), color=THEORY, lw=1, dashes=(4, 2),
                   label="Eqs 43, 44")
        panel.axvline(OTHER_CODES, ymax=0.76, color=LINES[5], lw=1, dashes=(1, 1.5), label="period of other SPH codes")
        panel.set(xlabel="time  (s)", xlim=(0, None), ylim=(-32, 47))
        panel.legend(loc="upper right", ncols=2, fontsize=7)
    axes[0].set_ylabel("tip  (mm)")
    return figure


def draw_clamps(results: Results) -> Figure | None:
    """The plate when its particles near the clamp have parted most, and its part at the clamp."""
    runs = {name: results[name] for name in ("rows10", "rows10_eps0") if name in results}
    if not runs:
        return None
    figure, axes = plt.subplots(len(runs), 2, figsize=(7.8, 0.8 + 1.55 * len(runs)), squeeze=False, layout="constrained",
                                width_ratios=[1.7, 1])
    for row, run in zip(axes, runs.values()):
        frame = max(run.snapshots, key=lambda snapshot: clamp_gap(run, snapshot))
        liquid, solid = colourings([frame], "xx")
        for panel in row:
            draw_particles(panel, frame, liquid, solid)
            panel.tick_params(length=2, labelsize=7.5)
        stress = case_of(run)["solid"]["artificial_stress_coefficient"]
        row[0].autoscale_view()
        row[0].set_title(rf"$\varepsilon$ = {stress:g}, {frame.time:.2f} s", loc="left")
        row[0].set_ylabel("$y$  (mm)")
        row[1].set(xlim=(-12, 48), ylim=(-8, 28))
        row[1].set_title(f"gaps at the clamp up to {clamp_gap(run, frame):.2f} $d$", loc="left")
        bar = figure.colorbar(ScalarMappable(solid.scale, solid.colours), ax=row[1], label=solid.label, shrink=0.9)
        bar.ax.tick_params(labelsize=7.5)
    for panel in axes[-1]:
        panel.set_xlabel("$x$  (mm)")
    return figure


def draw_convergence(results: Results) -> Figure | None:
    fitted = convergence(results)
    if fitted is None:
        return None
    modern = [results.modern[name] for name in ROWS if name in results.modern]
    ratios = [theory_of(run).period / mean_period(run) for run in modern]
    figure = convergence_panels({"$f/f_0$": fitted}, {"$f/f_0$": ([spacing_of(run) for run in modern], ratios)} if modern else {})
    if figure is not None:
        figure.axes[0].set_xticks([0, 1000, 2000, 3000])
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    gallery = Gallery(folder)
    with plt.rc_context(STYLE):
        gallery.add("histories", draw_histories(results), "The plate's tip for 6, 10 and 20 rows across it, and with less "
                    "artificial stress. Dotted: where the first period of other SPH codes ends.")
        gallery.add("clamps", draw_clamps(results), "The plate when its particles near the clamp have parted most, and that "
                    "place. Without artificial stress it cracks there.")
        gallery.add("convergence", draw_convergence(results), "Frequency over theory's; red: the limit that the fit names.")
    return gallery.drawings


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
