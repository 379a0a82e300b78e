#!/usr/bin/python3
"""The structure of Turek and Hron's benchmark by itself: at rest under its weight (CSM1, CSM2) and let go (CSM3).

    /usr/bin/python3 cases/turek_beam/plot.py results/comparison/paper/turek_beam [--output DIR]
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison.beam_figures import Gallery, convergence_panels  # noqa: E402
from comparison.beam_frequency import Ringing, fit_damped_sinusoid  # noqa: E402
from comparison.beam_quantities import case_of, largest_gap_of_run, spacing_of, theory_of  # noqa: E402
from comparison.convergence import Fit, fit_order  # noqa: E402
from comparison.exact_beam import Array  # noqa: E402
from comparison.quantities import highest_point  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from figure_particles import colourings, draw_particles  # noqa: E402
from figures import LINES, MODERN, STYLE  # noqa: E402
from modal_beam import beam_of  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.cm import ScalarMappable  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from sphdrop_reader import Run  # noqa: E402

MILLI = 1e3
THEORY = "#1c222b"
ROWS = ("csm2_rows4", "csm2_rows6", "csm2")
COLUMNS = {"x": "tip_displacement_x", "y": "deflection"}


@dataclass(frozen=True)
class Reference:
    """Turek and Hron's displacements of the middle of the end, m, as mean and amplitude (0 at rest)."""

    x: tuple[float, float]
    y: tuple[float, float]


REFERENCES = {"csm1": Reference((-7.187e-3, 0.0), (-66.10e-3, 0.0)), "csm2": Reference((-0.4690e-3, 0.0), (-16.97e-3, 0.0)),
              "csm3": Reference((-14.305e-3, 14.305e-3), (-63.607e-3, 65.160e-3))}
REFERENCE_FREQUENCY = 1.0995  # Hz, of CSM3


def reference_of(name: str) -> Reference:
    """By a run's name, which begins with the benchmark's."""
    return REFERENCES[name.split("_")[0]]


def is_let_go(run: Run) -> bool:
    return float(case_of(run)["solid"]["damping_rate"]) == 0.0


def restlessness(run: Run) -> float:
    """By how much the end has moved over the last tenth of the run, over its displacement."""
    times, y = run.history["time"], run.history["deflection"]
    return float(np.ptp(y[times >= 0.9 * times[-1]]) / abs(y[-1]))


def ringing(run: Run) -> Ringing:
    """A damped sinusoid through the end's deflection over the whole run."""
    return fit_damped_sinusoid(run.history["time"], run.history["deflection"], theory_of(run).angular_frequency)


def first_extremes(times: Array, y: Array) -> tuple[float, float]:
    """The lowest place of values that start at 0 downwards, and the highest between that and the next such place; NaN, NaN
    if the values do not come so far."""
    middle = 0.5 * float(y.min())
    below = y < middle
    falls, rises = np.flatnonzero(~below[:-1] & below[1:]), np.flatnonzero(below[:-1] & ~below[1:])
    if len(falls) < 2 or len(rises) < 1:
        return math.nan, math.nan
    first = slice(falls[0], rises[0] + 2)
    second = slice(rises[0], falls[1] + 2)
    return -highest_point(times[first], -y[first])[1], highest_point(times[second], y[second])[1]


def swing(run: Run, axis: str) -> tuple[float, float]:
    """Mean and amplitude in m of the first full swing: of its lowest place and the highest that follows."""
    low, high = first_extremes(run.history["time"], run.history[COLUMNS[axis]])
    return 0.5 * (high + low), 0.5 * (high - low)


def convergence(results: Results) -> tuple[list[float], list[float], Fit] | None:
    """Spacings in m, CSM2's deflection over the reference, and their fit; None with fewer than three resolutions."""
    runs = [results[name] for name in ROWS if name in results]
    if len(runs) < 3:
        return None
    reference = REFERENCES["csm2"].y[0]
    spacings, ratios = [spacing_of(run) for run in runs], [run.history["deflection"][-1] / reference for run in runs]
    return spacings, ratios, fit_order(spacings, ratios)


def measure(results: Results) -> dict[str, float]:
    """Lengths in m, frequency in Hz, shares as numbers."""
    found: dict[str, float] = {}
    for name, run in results.items():
        found[f"largest_gap_{name}"] = largest_gap_of_run(run)
        if is_let_go(run):
            fitted = ringing(run)
            frequency = fitted.angular_frequency / (2 * math.pi)
            found |= {f"frequency_{name}": frequency, f"frequency_ratio_{name}": frequency / REFERENCE_FREQUENCY,
                      f"energy_loss_{name}": fitted.energy_loss_per_period}
            for axis in COLUMNS:
                mean, amplitude = swing(run, axis)
                found |= {f"mean_{axis}_{name}": mean, f"amplitude_{axis}_{name}": amplitude}
        else:
            found |= {f"end_{axis}_{name}": float(run.history[column][-1]) for axis, column in COLUMNS.items()}
            found[f"deflection_ratio_{name}"] = found[f"end_y_{name}"] / reference_of(name).y[0]
            found[f"restlessness_{name}"] = restlessness(run)
    fit = convergence(results)
    if fit is not None:
        found |= {"deflection_ratio_order": fit[2].order, "deflection_ratio_limit": fit[2].limit}
    return {name: value for name, value in found.items() if math.isfinite(value)}


def draw_histories(results: Results) -> Figure | None:
    """A column for each benchmark: y above, x below, with Turek and Hron's values."""
    names = [name for name in REFERENCES if name in results]
    if not names:
        return None
    figure, axes = plt.subplots(2, len(names), figsize=(max(4.0, 2.6 * len(names)), 4.6), squeeze=False, sharex="col",
                                layout="constrained")
    for column, name in enumerate(names):
        run = results[name]
        for row, axis in enumerate("yx"):
            panel = axes[row, column]
            panel.plot(run.history["time"], run.history[COLUMNS[axis]] * MILLI, color=LINES[row], label="sphdrop")
            if name in results.modern:
                run_modern = results.modern[name]
                panel.plot(run_modern.history["time"], run_modern.history[COLUMNS[axis]] * MILLI, color=LINES[2 + row], **MODERN,
                           label="mode modern")
            mean, amplitude = getattr(reference_of(name), axis)
            for number, value in enumerate(sorted({mean - amplitude, mean, mean + amplitude})):
                panel.axhline(value * MILLI, color=THEORY, lw=1, dashes=(4, 2) if value == mean else (1, 1.5),
                              label="Turek and Hron" if number == 0 else None)
        axes[0, column].set_title(name.upper())
        axes[1, column].set(xlabel="time  (s)", xlim=(0, None))
    axes[0, 0].set_ylabel("the end's $y$ displacement  (mm)")
    axes[1, 0].set_ylabel("the end's $x$ displacement  (mm)")
    axes[0, 0].legend()
    return figure


def draw_at_rest(results: Results) -> Figure | None:
    """CSM1 and CSM2 at the end of the run, with where Turek and Hron have the middle of the end."""
    names = [name for name in ("csm1", "csm2") if name in results]
    if not names:
        return None
    figure, axes = plt.subplots(len(names), 1, figsize=(7.2, 0.4 + 2.0 * len(names)), squeeze=False, sharex=True,
                                layout="constrained")
    for panel, name in zip(axes[:, 0], names):
        run = results[name]
        frame, beam = run.snapshots[-1], beam_of(run)
        liquid, solid = colourings([frame], "xx")
        draw_particles(panel, frame, liquid, solid)
        panel.autoscale_view()
        reference = reference_of(name)
        panel.plot((beam.length + reference.x[0]) * MILLI, (0.5 * beam.thickness + reference.y[0]) * MILLI, "x",
                   color=THEORY, ms=8, mew=1.6, label="middle of the end after Turek and Hron")
        panel.set_title(f"{name.upper()}, {frame.time:.1f} s", loc="left")
        panel.set_ylabel("$y$  (mm)")
        figure.colorbar(ScalarMappable(solid.scale, solid.colours), ax=panel, label=solid.label, shrink=0.9)
    axes[-1, 0].set_xlabel("$x$  (mm)")
    axes[0, 0].legend(loc="lower left")
    return figure


def draw_convergence(results: Results) -> Figure | None:
    fitted = convergence(results)
    if fitted is None:
        return None
    label = r"CSM2: $u_y$ / reference"
    modern = [results.modern[name] for name in ROWS if name in results.modern]
    ratios = [run.history["deflection"][-1] / REFERENCES["csm2"].y[0] for run in modern]
    figure = convergence_panels({label: fitted}, {label: ([spacing_of(run) for run in modern], ratios)} if modern else {})
    if figure is not None:
        figure.axes[0].set_xticks([0, 2000, 4000])
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    gallery = Gallery(folder)
    with plt.rc_context(STYLE):
        gallery.add("histories", draw_histories(results), "Displacements of the beam's end: CSM1 and CSM2 nearly critically "
                    "damped, CSM3 undamped. Dashed: the reference at rest or its mean; dotted: its extremes.")
        gallery.add("at_rest", draw_at_rest(results), "The beam at rest under its own weight.")
        gallery.add("convergence", draw_convergence(results), "Deflection of CSM2 over the reference, 4, 6 and 10 rows.")
    return gallery.drawings


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
