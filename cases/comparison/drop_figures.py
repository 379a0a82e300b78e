"""What the drops' figures have in common: strips of frames, and saving."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from comparison.study import Drawing
from figure_particles import choose_frames, colourings, draw_particles
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from sphdrop_reader import Run

MILLI = 1e3


def draw_drop_strip(run: Run, times: Sequence[float]) -> Figure:
    """The liquid, coloured by its speed, at times in s; of a solid, what is near it."""
    frames = choose_frames(run.snapshots, len(times), times)
    liquid, solid = colourings(frames, "xx")
    low = MILLI * np.min([frame["position"][frame.fluid].min(axis=0) for frame in frames], axis=0) - (0.15, 0.1)
    high = MILLI * np.max([frame["position"][frame.fluid].max(axis=0) for frame in frames], axis=0) + (0.15, 0.1)
    width, height = high - low
    columns = 4 if width < 2.2 * height else 2
    rows = -(-len(frames) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(7.6, rows * (7.0 / columns * height / width + 0.25) + 1.0), sharex=True,
                                sharey=True, squeeze=False, layout="constrained")
    for axes, frame in zip(grid.flat, frames):
        draw_particles(axes, frame, liquid, solid)
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
        axes.set_title(f"{frame.time * MILLI:.1f} ms", loc="left", pad=2)
        axes.tick_params(length=2, labelsize=7.5)
    for axes in grid.flat[len(frames):]:
        axes.set_axis_off()
    for axes in grid[-1]:
        axes.set_xlabel("$x$  (mm)")
    for axes in grid[:, 0]:
        axes.set_ylabel("$y$  (mm)")
    figure.colorbar(ScalarMappable(liquid.scale, liquid.colours), ax=grid, location="bottom", label=liquid.label, shrink=0.5,
                    aspect=40)
    return figure


def save(made: Iterable[tuple[str, Figure | None, str, str]], folder: Path) -> list[Drawing]:
    """Writes figures of name, figure, caption and the paper's figure into a folder; what is None is left out."""
    drawings = []
    for name, figure, caption, paper_figure in made:
        if figure is not None:
            figure.savefig(folder / name)
            plt.close(figure)
            drawings.append(Drawing(folder / name, caption, paper_figure))
    return drawings
