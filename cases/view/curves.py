"""The panels of curves over time that the page shows: of one run its watched quantities, of several each quantity compared."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from figure_history import PANELS, Panel
from sphdrop_reader import History, ResultError, Run

MOST_ROWS = 2000  # of a curve in the page: more than a screen has columns
COMPARED = ("contact_force_y", "contact_impulse_y", "kinetic_fluid", "elastic", "surface", "total")


def plain(label: str) -> str:
    """A label without TeX."""
    return re.sub(r"\s+", " ", label.replace("$", "").replace("D_0", "D₀").replace("\\", "")).strip()


def history_of(run: Run) -> History | None:
    """None where a run has no history yet, or not two rows of it."""
    try:
        history = run.history
    except ResultError:
        return None
    return history if "time" in history and len(history["time"]) > 1 else None


def chosen_rows(count: int) -> np.ndarray:
    """Evenly spaced rows, the last among them."""
    step = max(1, -(-count // MOST_ROWS))
    return np.unique(np.append(np.arange(0, count, step), count - 1))


def _rounded(values: np.ndarray) -> list[float | None]:
    return [float(f"{value:.6g}") if np.isfinite(value) else None for value in values]


def shown_values(panel: Panel, values: np.ndarray) -> np.ndarray:
    """In the unit of the panel's label."""
    scaled = values * panel.scale
    if panel.relative_to == "start":
        return scaled - scaled[0]
    positive = np.flatnonzero(values > 0)
    return scaled / scaled[positive[0]] if panel.relative_to == "first" and positive.size else scaled


def _curve(history: History, panel: Panel, column: str, legend: str, run: int) -> dict[str, Any] | None:
    if column not in history or not np.any(np.nan_to_num(history[column])):
        return None
    rows = chosen_rows(len(history["time"]))
    return {"legend": legend, "run": run, "values": _rounded(shown_values(panel, history[column])[rows])}


def panels_of(names: Sequence[str], runs: Sequence[Run]) -> dict[str, Any]:
    """What the page's script draws: for each run its times in ms, and panels of curves that point to their run."""
    histories = [history_of(run) for run in runs]
    times = [[] if history is None else _rounded(history["time"][chosen_rows(len(history["time"]))] * 1e3)
             for history in histories]
    panels = []
    for panel in PANELS:
        for columns in [panel.curves] if len(runs) == 1 else [{name: text} for name, text in panel.curves.items()
                                                              if name in COMPARED or not text]:
            curves = [_curve(history, panel, column, plain(legend) if len(runs) == 1 else names[number], number)
                      for number, history in enumerate(histories) if history is not None for column, legend in columns.items()]
            if found := [curve for curve in curves if curve is not None]:
                only = next(iter(columns.values())) if len(runs) > 1 else ""
                panels.append({"label": plain(f"{panel.label}: {only}" if only else panel.label), "curves": found})
    return {"times": times, "panels": panels}
