"""The figures of a sweep: what contact, spreading and deflection make of the impact's speed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from figures import LINES, STYLE
from matplotlib.axes import Axes
from sweep.table import Table

MILLI = 1e3


@dataclass(frozen=True)
class Plot:
    name: str
    abscissa: str
    ordinate: str
    labels: tuple[str, str]
    scale: float
    theory: str = ""  # a column drawn as a line


PLOTS = (
    Plot("contact_time", "weber_number [1]", "contact_time [s]", ("Weber number", "contact time  (ms)"), MILLI),
    Plot("spreading", "weber_number [1]", "spreading_ratio [1]", ("Weber number", r"$D_{max}/D_0$"), 1.0),
    Plot("restitution", "weber_number [1]", "restitution [1]", ("Weber number", "restitution"), 1.0),
    Plot("deflection", "impact_speed [m/s]", "largest_deflection [m]", ("impact speed  (m/s)", "largest deflection  (mm)"), MILLI,
         "deflection_theory [m]"),
)
# They are on the axes already.
NOT_IN_LEGENDS = ("drop.velocity", "time.end")


def is_number(value: Any) -> bool:
    return isinstance(value, float) and math.isfinite(value)


def series_of(table: Table, rows: Sequence[dict[str, Any]]) -> dict[str, list[dict[str, Any]]]:
    """Finished runs by the parameters in which they differ beside their speed."""
    differ = [key for key in table[0] if key not in NOT_IN_LEGENDS and len({row[key] for row in table}) > 1]
    found: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        found.setdefault(", ".join(f"{key} = {row[key]}" for key in differ), []).append(row)
    return found


def draw(axes: Axes, plot: Plot, series: dict[str, list[dict[str, Any]]]) -> bool:
    """Whether there was anything to draw."""
    drawn = False
    for number, (legend, rows) in enumerate(series.items()):
        points = sorted((row[plot.abscissa], row[plot.ordinate], row.get(plot.theory, math.nan)) for row in rows
                        if is_number(row.get(plot.abscissa)) and is_number(row.get(plot.ordinate)))
        if not points:
            continue
        x, y, theory = np.array(points, dtype=float).T
        colour = LINES[number % len(LINES)]
        axes.plot(x, y * plot.scale, "o-" if len(x) > 1 else "o", color=colour, markersize=4, label=legend or None)
        if np.isfinite(theory).any():
            axes.plot(x, theory * plot.scale, "--", color=colour, linewidth=0.9, label="Eq. 46" if not drawn else None)
        drawn = True
    axes.set(xlabel=plot.labels[0], ylabel=plot.labels[1])
    axes.set_ylim(bottom=0)
    if axes.get_legend_handles_labels()[1]:
        axes.legend()
    return drawn


def draw_all(table: Table, rows: Sequence[dict[str, Any]], folder: Path) -> list[Path]:
    """A picture for each plot that has points; returns the files written."""
    written, series = [], series_of(table, rows)
    with plt.rc_context(STYLE):
        for plot in PLOTS:
            figure, axes = plt.subplots(figsize=(4.6, 3.2), layout="constrained")
            if draw(axes, plot, series):
                figure.savefig(folder / f"{plot.name}.png")
                written.append(folder / f"{plot.name}.png")
            plt.close(figure)
    return written
