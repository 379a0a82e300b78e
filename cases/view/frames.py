"""Snapshots of one or several runs as equal frames of a film."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from figure_particles import Colouring, colourings, draw_particles, masks, region
from matplotlib.figure import Figure
from numpy.typing import NDArray
from sphdrop_reader import Run, Snapshot

MILLI = 1e3
FRAME_WIDTH = 7.6  # inch


@dataclass(frozen=True)
class Scene:
    """What all frames share: the region shown in mm, the colours, the names of the runs."""

    names: tuple[str, ...]
    bounds: tuple[float, float, float, float]
    liquid: Colouring
    solid: Colouring
    has: tuple[bool, bool]


def snapshots_with_particles(run: Run) -> list[Snapshot]:
    return [snapshot for snapshot in run.snapshots if snapshot.particle_count > 0]


def film_times(runs: Sequence[Sequence[Snapshot]], most: int) -> list[float]:
    """The times of the run with the most snapshots, at most `most` of them, evenly chosen, the first and last among them."""
    longest = max(runs, key=len)
    times = [snapshot.time for snapshot in longest]
    chosen = np.unique(np.rint(np.linspace(0, len(times) - 1, min(most, len(times)))).astype(int))
    return [times[k] for k in chosen]


def nearest(snapshots: Sequence[Snapshot], time: float) -> Snapshot:
    return snapshots[int(np.argmin([abs(snapshot.time - time) for snapshot in snapshots]))]


def scene_of(names: Sequence[str], runs: Sequence[Sequence[Snapshot]], stress: str) -> Scene:
    """Colours and region from at most eight snapshots a run, which is enough to know them, and quick."""
    some = [snapshot for run in runs for snapshot in (run[k] for k in np.unique(np.linspace(0, len(run) - 1, 8).astype(int)))]
    liquid, solid = colourings(some, stress)
    # What is held fixed is drawn grey: a rigid wall alone has no stress to show.
    has = (any(np.any(masks(snapshot)[0]) for snapshot in some), any(np.any(moving_solid(snapshot)) for snapshot in some))
    return Scene(tuple(names), region(some, longest=6.0), liquid, solid, has)


def moving_solid(snapshot: Snapshot) -> NDArray[np.bool_]:
    solid = masks(snapshot)[1]
    return solid & (snapshot["is_fixed"] == 0) if "is_fixed" in snapshot else solid


def draw_frame(scene: Scene, snapshots: Sequence[Snapshot]) -> Figure:
    """One frame: a picture for each run, one above the other, at the snapshots given."""
    left, right, bottom, top = scene.bounds
    height = min(FRAME_WIDTH * (top - bottom) / (right - left), 4.5)
    bars = [colouring for colouring, is_there in zip((scene.liquid, scene.solid), scene.has) if is_there]
    figure = plt.figure(figsize=(FRAME_WIDTH, (height + 0.3) * len(snapshots) + 0.75), layout="constrained")
    grid = figure.add_gridspec(len(snapshots) + 1, max(1, len(bars)), height_ratios=[height] * len(snapshots) + [0.1])
    for number, (name, snapshot) in enumerate(zip(scene.names, snapshots)):
        axes = figure.add_subplot(grid[number, :])
        draw_particles(axes, snapshot, scene.liquid, scene.solid)
        axes.set(xlim=(left, right), ylim=(bottom, top))
        axes.tick_params(length=2, labelsize=7.5, width=0.4, labelbottom=number == len(snapshots) - 1)
        axes.set_ylabel("$y$  (mm)")
        if number == len(snapshots) - 1:
            axes.set_xlabel("$x$  (mm)")
        # A run that has ended keeps its last picture: say of which instant it is.
        axes.set_title(f"{name},  $t$ = {snapshot.time * MILLI:.2f} ms", loc="left", pad=2)
    for number, colouring in enumerate(bars):
        colouring.bar(figure, figure.add_subplot(grid[len(snapshots), number]), "horizontal")
    return figure


def film(scene: Scene, runs: Sequence[Sequence[Snapshot]], times: Sequence[float]) -> Iterator[tuple[float, Figure]]:
    """Time and figure of every frame; each figure is closed when the next is asked for."""
    for time in times:
        figure = draw_frame(scene, [nearest(snapshots, time) for snapshots in runs])
        yield time, figure
        plt.close(figure)


def picture_bytes(figure: Figure, dots_per_inch: int) -> bytes:
    """As JPEG, whose files are a third of PNG's for thousands of discs."""
    stream = io.BytesIO()
    figure.savefig(stream, format="jpg", dpi=dots_per_inch, pil_kwargs={"quality": 82})
    return stream.getvalue()
