#!/usr/bin/python3
"""The cantilever by itself: frequency against beam theory, its order of convergence, energy lost (Eqs 43, 44).

    /usr/bin/python3 cases/free_vibration/plot.py results/comparison/paper/free_vibration [--output DIR]
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison.beam_figures import MILLI, Gallery, convergence_panels, history_lines  # noqa: E402
from comparison.beam_frequency import Ringing, fit_damped_sinusoid  # noqa: E402
from comparison.beam_quantities import case_of, rows_across, spacing_of, theory_of  # noqa: E402
from comparison.convergence import Fit, fit_order  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from figures import LINES, STYLE  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from sphdrop_reader import Run  # noqa: E402

ROWS = ("rows4", "rows6", "rows8", "rows10", "rows16")
LENGTHS = ("rows6", "L12_rows6", "L20_rows6")
# A variation and the run that it differs from.
VARIATIONS = {"half_step": "rows10", "eps0.2": "rows10"}


def ringing(run: Run) -> Ringing:
    """A damped sinusoid through the free end's deflection over the whole run."""
    return fit_damped_sinusoid(run.history["time"], run.history["deflection"], theory_of(run).angular_frequency)


def frequency_ratio(run: Run) -> float:
    """f/f0"""
    return ringing(run).angular_frequency / theory_of(run).angular_frequency


def energy_loss(run: Run) -> float:
    """Share of the beam's kinetic and elastic energy that is gone after one period of its own; NaN if it is not watched."""
    times, energy = run.history["time"], run.history["kinetic_solid"] + run.history["elastic"]
    period = ringing(run).period
    return 1 - float(np.interp(period, times, energy)) / energy[0] if period <= times[-1] else math.nan


def convergence(results: Results) -> tuple[list[float], list[float], Fit] | None:
    """Spacings in m, f/f0, and their fit; None with fewer than three resolutions."""
    runs = [results[name] for name in ROWS if name in results]
    if len(runs) < 3:
        return None
    spacings, ratios = [spacing_of(run) for run in runs], [frequency_ratio(run) for run in runs]
    return spacings, ratios, fit_order(spacings, ratios)


def measure(results: Results) -> dict[str, float]:
    """Shares as numbers, periods in s."""
    found: dict[str, float] = {}
    for name, run in results.items():
        found |= {f"frequency_ratio_{name}": frequency_ratio(run), f"period_{name}": ringing(run).period,
                  f"energy_loss_{name}": energy_loss(run)}
    for name, main in VARIATIONS.items():
        if name in results and main in results:
            found[f"frequency_change_{name}"] = frequency_ratio(results[name]) / frequency_ratio(results[main]) - 1
    fitted = convergence(results)
    if fitted is not None:
        found |= {"frequency_ratio_order": fitted[2].order, "frequency_ratio_limit": fitted[2].limit}
    return {name: value for name, value in found.items() if math.isfinite(value)}


def draw_histories(results: Results) -> Figure | None:
    runs = {name: results[name] for name in ROWS if name in results}
    if not runs:
        return None
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.1), layout="constrained")
    end = 0.0
    for (name, run), colour in zip(runs.items(), LINES):
        label = f"{rows_across(run)} rows"
        end = max(end, float(run.history["time"][-1]))
        history_lines(left, run, "deflection", MILLI, color=colour, label=label)
        energy = run.history["kinetic_solid"] + run.history["elastic"]
        right.plot(run.history["time"] * MILLI, energy / energy[0], color=colour, label=label)
    for name in list(results.modern)[:1]:
        run = results.modern[name]
        energy = run.history["kinetic_solid"] + run.history["elastic"]
        history_lines(left, run, "deflection", MILLI, color=LINES[6], lw=2.5, alpha=0.6, label=f"{rows_across(run)} rows, modern")
        right.plot(run.history["time"] * MILLI, energy / energy[0], color=LINES[6], lw=2.5, alpha=0.6, label=f"{rows_across(run)} rows, modern")
    run = next(iter(runs.values()))
    theory = theory_of(run).angular_frequency
    times = np.linspace(0, end, 400)
    amplitude = case_of(run)["solid"]["initial_tip_velocity"] / theory
    left.plot(times * MILLI, amplitude * np.sin(theory * times) * MILLI, color="#1c222b", lw=1, dashes=(4, 2), label="theory (43)")
    left.set(xlabel="time  (ms)", ylabel=r"$\delta$  (mm)", xlim=(0, None), ylim=(-1.25e3 * amplitude, 1.7e3 * amplitude))
    right.set(xlabel="time  (ms)", ylabel="energy / energy at the start", xlim=(0, None), ylim=(0, 1.03))
    left.legend(ncols=3, loc="upper center", fontsize=6.5)
    return figure


def draw_convergence(results: Results) -> Figure | None:
    fitted = convergence(results)
    modern = [results.modern[name] for name in ROWS if name in results.modern]
    drawn = {r"$f/f_0$": ([spacing_of(run) for run in modern], [frequency_ratio(run) for run in modern])} if modern else {}
    return None if fitted is None else convergence_panels({r"$f/f_0$": fitted}, drawn)


def draw_lengths(results: Results) -> Figure | None:
    runs = [results[name] for name in LENGTHS if name in results]
    if len(runs) < 2:
        return None
    figure, axes = plt.subplots(figsize=(4.2, 3.0), layout="constrained")
    lengths = np.array([case_of(run)["solid"]["length"] for run in runs]) * MILLI
    axes.plot(lengths, [ringing(run).period * MILLI for run in runs], "o", ms=5, color=LINES[0], label="sphdrop, 6 rows")
    modern = [results.modern[name] for name in LENGTHS if name in results.modern]
    if modern:
        axes.plot([case_of(run)["solid"]["length"] * MILLI for run in modern], [ringing(run).period * MILLI for run in modern], "D",
                  ms=6, mfc="none", color=LINES[2], label="in mode modern")
    fine = np.linspace(7, 21, 100)
    axes.plot(fine, theory_of(runs[0]).period * (fine / lengths[0]) ** 2 * MILLI, color="#1c222b", lw=1, dashes=(4, 2), label="Eq 44")
    for length, run in zip(lengths, runs):
        axes.annotate(f"$f/f_0$ = {frequency_ratio(run):.3f}", (length, ringing(run).period * MILLI), xytext=(-6, 6),
                      textcoords="offset points", ha="right", fontsize=7.5)
    axes.set(xlabel="$L$  (mm)", ylabel="period  (ms)", xlim=(4, 22), ylim=(0, None))
    axes.legend()
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    gallery = Gallery(folder)
    with plt.rc_context(STYLE):
        gallery.add("histories", draw_histories(results), "Deflection of the free end with theory's, and what is left of the energy. "
                    "Wide: mode modern, whose rows all give the same.")
        gallery.add("convergence", draw_convergence(results), "Frequency over theory's; red: the limit that the fit names.")
        gallery.add("lengths", draw_lengths(results), "The period over the length with Eq 44.")
    return gallery.drawings


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
