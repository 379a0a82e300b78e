"""The watched quantities over time."""

from __future__ import annotations

from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from sphdrop_reader import History

MILLI = 1e3


@dataclass(frozen=True)
class Panel:
    """Curves over time that share an axis; `scale` turns SI into the unit of `label`."""

    label: str
    curves: dict[str, str]  # column: legend
    scale: float = 1.0
    relative_to: str = ""  # "first": divided by the first value above zero; "start": counted from the first value


PANELS = [
    Panel("drop width  $D/D_0$", {"drop_width": ""}, relative_to="first"),
    Panel("deflection  (mm)", {"deflection": ""}, MILLI),
    Panel("contact force  (N/m)", {"contact_force_y": "$y$", "contact_force_x": "$x$"}),
    Panel("contact impulse  (mN s/m)", {"contact_impulse_y": "$y$", "contact_impulse_x": "$x$"}, MILLI),
    Panel("energy  (mJ/m)", {"kinetic_fluid": "kinetic, drop", "kinetic_solid": "kinetic, solid", "elastic": "elastic",
                             "contact": "contact", "compressive": "compressive",
                             "dissipated_fluid": "dissipated, drop", "dissipated_solid": "dissipated, solid",
                             "dissipated_contact": "dissipated, contact"}, MILLI),
    Panel("energy since the start  (mJ/m)", {"surface": "surface", "adhesion": "adhesion", "total": "total", "gravity": "gravity",
                                             "density_correction": "density correction",
                                             "reconnection": "curves detected anew"}, MILLI, "start"),
]


def draw_panel(axes: Axes, panel: Panel, history: History) -> None:
    time = history["time"] * MILLI
    for name, legend in panel.curves.items():
        if name not in history or not np.any(np.nan_to_num(history[name])):
            continue
        values = history[name] * panel.scale
        if panel.relative_to == "first":
            values = values / values[np.flatnonzero(values > 0)[0]] if np.any(values > 0) else values
        elif panel.relative_to == "start":
            values = values - values[0]
        axes.plot(time, values, label=legend)
    axes.set_ylabel(panel.label)
    axes.margins(x=0.01)
    if any(panel.curves.values()):
        # Two columns: a third makes the axes of all panels narrow, and is cut off at the figure's edge.
        axes.legend(ncols=2, loc="lower left", bbox_to_anchor=(0, 0.99), borderaxespad=0, columnspacing=1.2, handlelength=1.4)


def draw_history(history: History) -> Figure | None:
    """None if none of the panels has anything to show."""
    panels = [panel for panel in PANELS if any(name in history and np.any(np.nan_to_num(history[name])) for name in panel.curves)]
    if not panels or "time" not in history or len(history["time"]) < 2:
        return None
    columns = 2 if len(panels) > 1 else 1
    rows = -(-len(panels) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(3.6 * columns, 2.5 * rows), sharex=True, squeeze=False,
                                layout="constrained")
    for axes, panel in zip(grid.flat, panels):
        draw_panel(axes, panel, history)
    for axes in grid.flat[len(panels):]:
        axes.remove()
    for axes in grid.flat[max(0, len(panels) - columns):len(panels)]:
        axes.set_xlabel("time  (ms)")
        axes.tick_params(labelbottom=True)
    return figure
