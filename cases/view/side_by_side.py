"""Several runs in one figure: their histories over each other, their snapshots in rows."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib.pyplot as plt
from figure_particles import draw_particles
from matplotlib.figure import Figure
from sphdrop_reader import Run, Snapshot
from view.curves import panels_of
from view.frames import Scene, nearest

MILLI = 1e3


def draw_histories(names: Sequence[str], runs: Sequence[Run]) -> Figure | None:
    """A panel for each quantity that the runs share or that one has; None if there is none."""
    data = panels_of(names, runs)
    if not data["panels"]:
        return None
    columns = min(2, len(data["panels"]))
    rows = -(-len(data["panels"]) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(3.8 * columns, 2.2 * rows), squeeze=False, layout="constrained")
    for axes, panel in zip(grid.flat, data["panels"]):
        for curve in panel["curves"]:
            # A gap of the history (None) parts the line.
            values = [float("nan") if value is None else value for value in curve["values"]]
            axes.plot(data["times"][curve["run"]], values, label=curve["legend"], color=f"C{curve['run']}")
        axes.set_xlabel("time  (ms)")
        axes.set_title(panel["label"], loc="left")
        axes.margins(x=0.01)
    for axes in grid.flat[len(data["panels"]):]:
        axes.remove()
    grid.flat[0].legend()
    return figure


def draw_rows(scene: Scene, runs: Sequence[Sequence[Snapshot]], times: Sequence[float]) -> Figure:
    """A row for each run, a column for each time."""
    left, right, bottom, top = scene.bounds
    ratio = (top - bottom) / (right - left)
    width = max(9.0, 2.2 * len(times))
    height = width / len(times) * ratio + 0.25
    figure, grid = plt.subplots(len(runs), len(times), figsize=(width, height * len(runs) + 0.5), squeeze=False, sharex=True,
                                sharey=True, layout="constrained")
    for row, (name, snapshots) in enumerate(zip(scene.names, runs)):
        for column, time in enumerate(times):
            axes, snapshot = grid[row][column], nearest(snapshots, time)
            draw_particles(axes, snapshot, scene.liquid, scene.solid)
            axes.set(xlim=(left, right), ylim=(bottom, top), xticks=[], yticks=[])
            axes.set_title(f"{snapshot.time * MILLI:.2f} ms", loc="left", pad=2)
            for spine in axes.spines.values():
                spine.set(visible=True, linewidth=0.4, color="#9aa3ad")
        grid[row][0].set_ylabel(name)
    return figure
