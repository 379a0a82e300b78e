"""Figures that the studies of beams share. Each returns None where there is nothing to draw."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from comparison.convergence import Fit
from comparison.stretched_beam import stretched_deflection
from comparison.study import Drawing
from figure_particles import choose_frames, draw_strip
from figures import LINES
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from modal_beam import beam_of, draw_check
from sphdrop_reader import Run

MILLI = 1e3
MICRO = 1e6
PAPER = {"linestyle": (0, (1, 1.5)), "linewidth": 1.2}  # what the paper states


class Gallery:
    """Saves the figures of a study one after the other."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.drawings: list[Drawing] = []

    def add(self, name: str, figure: Figure | None, caption: str, paper_figure: str = "") -> None:
        """Saves and closes a figure as NAME.png; nothing if it is None."""
        if figure is None:
            return
        path = self._folder / f"{name}.png"
        figure.savefig(path)
        plt.close(figure)
        self.drawings.append(Drawing(path, caption, paper_figure))


def strip(run: Run, times: Sequence[float]) -> Figure | None:
    """Frames at the times in s that the run reaches, the liquid coloured by speed and the beam by its bending stress."""
    reached = [time for time in times if time <= run.history["time"][-1] + 1e-5]
    frames = choose_frames(run.snapshots, len(reached), reached) if reached else []
    return draw_strip(frames, "xx") if frames else None


def history_lines(axes: Axes, run: Run, column: str, scale: float, **line: object) -> None:
    """A column of the history over the time in ms."""
    axes.plot(run.history["time"] * MILLI, run.history[column] * scale, **line)


def modal_checks(runs: Mapping[str, Run]) -> Figure | None:
    """Runs side by side: deflection with the exact beams', residuals below; titles are the mapping's keys."""
    if not runs:
        return None
    figure = plt.figure(figsize=(max(5.2, 2.6 * len(runs)), 4.4), layout="constrained")
    grid = figure.add_gridspec(3, len(runs), height_ratios=[0.12, 2, 1])
    axes = np.array([[figure.add_subplot(grid[row, column]) for column in range(len(runs))] for row in (1, 2)])
    for column, (title, run) in enumerate(runs.items()):
        draw_check(axes[0, column], axes[1, column], run)
        if not beam_of(run).is_cantilever:
            times, stretched = run.history["time"] * MILLI, stretched_deflection(run) * MILLI
            axes[0, column].plot(times, stretched, color=LINES[3], lw=1, label="Euler-Bernoulli with stretching")
            axes[1, column].plot(times, run.history["deflection"] * MILLI - stretched, color=LINES[3], lw=1)
        axes[0, column].set_title(title)
        if column > 0:
            axes[0, column].set_ylabel("")
            axes[1, column].set_ylabel("")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    above = figure.add_subplot(grid[0, :])
    above.set_axis_off()
    above.legend(handles, labels, loc="center", ncols=3)
    return figure


def convergence_panels(series: Mapping[str, tuple[Sequence[float], Sequence[float], Fit]],
                       modern: Mapping[str, tuple[Sequence[float], Sequence[float]]] | None = None) -> Figure | None:
    """A panel for each quantity: label -> spacings in m, values as they are to be drawn, and their fit with its limit; and
    spacings and values of mode modern."""
    if not series:
        return None
    columns = min(len(series), 3)
    rows = math.ceil(len(series) / columns)
    figure, axes = plt.subplots(rows, columns, figsize=(max(3.4, 2.65 * columns), 2.5 * rows), squeeze=False,
                                layout="constrained")
    for panel in axes.flat[len(series):]:
        panel.set_axis_off()
    for panel, (label, (spacings, values, fit)) in zip(axes.flat, series.items()):
        spacing = np.asarray(spacings) * MICRO
        panel.plot(spacing, values, "o", color=LINES[0], ms=4)
        if math.isfinite(fit.order):
            fine = np.linspace(0, spacing.max(), 200)
            panel.plot(fine, fit(fine / MICRO), color=LINES[0], lw=1)
            panel.plot(0, fit.limit, "o", color=LINES[1], ms=4, clip_on=False, zorder=5)
            panel.set_title(f"order {fit.order:.2f}, limit {fit.limit:.4g}")
        else:
            panel.plot(spacing, values, color=LINES[0], lw=1, dashes=(3, 2))
            panel.set_title(textwrap.fill(fit.text, 36), fontsize=7)
        if modern and label in modern:
            panel.plot(np.asarray(modern[label][0]) * MICRO, modern[label][1], "D", color=LINES[2], mfc="none", ms=4,
                       label="mode modern")
            panel.legend()
        panel.set(xlabel=r"spacing $d$  ($\mathrm{\mu}$m)", ylabel=label, xlim=(0, None))
    return figure


def change_bars(changes: Mapping[str, Mapping[str, float]]) -> Figure | None:
    """variation -> quantity -> relative change: horizontal bars in per cent, a panel for each quantity."""
    quantities = list(dict.fromkeys(name for values in changes.values() for name in values))
    if not quantities:
        return None
    figure, axes = plt.subplots(1, len(quantities), figsize=(7.6, 0.9 + 0.3 * len(changes)), squeeze=False, sharey=True,
                                layout="constrained")
    place = np.arange(len(changes))[::-1]
    for panel, quantity in zip(axes[0], quantities):
        values = np.array([100 * values.get(quantity, math.nan) for values in changes.values()])
        panel.barh(place, values, height=0.6, color=LINES[0])
        widest = np.nanmax(np.abs(values), initial=0.5)
        for y, value in zip(place, values):
            if math.isfinite(value):
                panel.annotate(f"{value:+.1f}", (value, y), xytext=(3 if value >= 0 else -3, 0), textcoords="offset points",
                               ha="left" if value >= 0 else "right", va="center", fontsize=7)
        panel.axvline(0.0, color="#5b6470", linewidth=0.6)
        panel.set(xlim=(-1.8 * widest, 1.8 * widest), xlabel="change  (%)", title=quantity)
        panel.grid(axis="y", visible=False)
    axes[0, 0].set_yticks(place, list(changes))
    return figure
