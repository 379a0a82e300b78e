"""Snapshots as pictures: the drop coloured by its speed, the solid by a stress, particles at their true size."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Colormap, LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray
from sphdrop_reader import Snapshot

Array = NDArray[np.float64]
MILLI = 1e3
WATER = LinearSegmentedColormap.from_list("water", ["#0b2f6b", "#1763a8", "#2f9fd0", "#7fd6de", "#e4f7d4"])


def masks(snapshot: Snapshot) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which particles are the drop's (liquid, or a rigid ball) and which the solid's; without a column that says so all are
    the drop's."""
    if "material" in snapshot:
        return snapshot.fluid, snapshot.solid
    return np.ones(snapshot.particle_count, dtype=bool), np.zeros(snapshot.particle_count, dtype=bool)


def diameters(snapshot: Snapshot) -> Array:
    """Of discs with the particles' true areas, mm."""
    if "mass" in snapshot and "density" in snapshot:
        return np.sqrt(4 / np.pi * snapshot["mass"] / snapshot["density"]) * MILLI
    box = np.ptp(snapshot["position"], axis=0) * MILLI if snapshot.particle_count else np.ones(2)
    return np.full(snapshot.particle_count, np.sqrt(box[0] * box[1] / max(1, snapshot.particle_count)))


def speed(snapshot: Snapshot) -> Array:
    """m/s"""
    return np.hypot(*snapshot["velocity"].T) if "velocity" in snapshot else np.zeros(snapshot.particle_count)


def stress_xx(snapshot: Snapshot) -> Array:
    """MPa"""
    return snapshot["stress_xx"] / 1e6 if "stress_xx" in snapshot else np.zeros(snapshot.particle_count)


def von_mises(snapshot: Snapshot) -> Array:
    """Of the stresses in the plane, MPa."""
    if not all(f"stress_{ab}" in snapshot for ab in ("xx", "yy", "xy")):
        return np.zeros(snapshot.particle_count)
    xx, yy, xy = (snapshot[f"stress_{ab}"] for ab in ("xx", "yy", "xy"))
    return np.sqrt(xx**2 - xx * yy + yy**2 + 3 * xy**2) / 1e6


@dataclass(frozen=True)
class Colouring:
    """How one material is coloured in all frames alike."""

    values: Callable[[Snapshot], Array]
    label: str
    colours: Colormap
    scale: Normalize

    def bar(self, figure: Figure, axes: Axes, orientation: str) -> None:
        """Fills `axes` with the colour bar."""
        bar = figure.colorbar(ScalarMappable(self.scale, self.colours), cax=axes, orientation=orientation)
        bar.set_label(self.label)
        bar.outline.set_linewidth(0.4)
        axes.tick_params(length=2, labelsize=7.5, width=0.4)


def limit(snapshots: Sequence[Snapshot], values: Callable[[Snapshot], Array], material: int) -> float:
    """What all but the wildest particles stay below, rounded up to two digits."""
    chosen = [np.abs(values(snapshot)[masks(snapshot)[material]]) for snapshot in snapshots]
    chosen = [array[np.isfinite(array)] for array in chosen if array.size]
    top = max((float(np.percentile(array, 99.5)) for array in chosen if array.size), default=0.0)
    if top <= 0:
        return 1.0
    step = 10.0 ** (np.floor(np.log10(top)) - 1)
    return float(np.ceil(top / step - 1e-9) * step)


def colourings(snapshots: Sequence[Snapshot], stress: str) -> tuple[Colouring, Colouring]:
    liquid = Colouring(speed, "speed of the drop  (m/s)", WATER, Normalize(0, limit(snapshots, speed, 0)))
    if stress == "von_mises":
        solid = Colouring(von_mises, "von Mises stress in the plane  (MPa)", matplotlib.colormaps["magma"],
                          Normalize(0, limit(snapshots, von_mises, 1)))
    else:
        top = limit(snapshots, stress_xx, 1)
        solid = Colouring(stress_xx, r"stress $\sigma_{xx}$  (MPa)", matplotlib.colormaps["coolwarm"], Normalize(-top, top))
    return liquid, solid


def draw_particles(axes: Axes, snapshot: Snapshot, liquid: Colouring, solid: Colouring) -> None:
    """Discs at the particles' true size; particles that are held fixed are grey."""
    position, size = snapshot["position"] * MILLI, diameters(snapshot)
    fixed = snapshot["is_fixed"] != 0 if "is_fixed" in snapshot else np.zeros(snapshot.particle_count, dtype=bool)
    is_liquid, is_solid = masks(snapshot)
    for chosen, colouring in ((is_solid & ~fixed, solid), (is_solid & fixed, None), (is_liquid, liquid)):
        if not np.any(chosen):
            continue
        discs = EllipseCollection(size[chosen], size[chosen], 0, units="xy", offsets=position[chosen],
                                  offset_transform=axes.transData, linewidths=0)
        if colouring is None:
            discs.set_facecolor("#6b7480")
        else:
            discs.set_array(colouring.values(snapshot)[chosen])
            discs.set(cmap=colouring.colours, norm=colouring.scale)
        discs.set_rasterized(True)
        axes.add_collection(discs)
    axes.set_aspect("equal")
    axes.grid(False)


def region(snapshots: Sequence[Snapshot], longest: float) -> tuple[float, float, float, float]:
    """x and y limits in mm that hold all frames; of a scene more than `longest` times as long as high, the part about the drop."""
    everything = np.concatenate([snapshot["position"] for snapshot in snapshots]) * MILLI
    liquid = np.concatenate([snapshot["position"][masks(snapshot)[0]] for snapshot in snapshots]) * MILLI
    low, high = everything.min(axis=0), everything.max(axis=0)
    margin = 0.06 * (high[1] - low[1]) + max(float(diameters(snapshot).max()) for snapshot in snapshots)
    spare = longest * (high[1] - low[1]) - (np.ptp(liquid[:, 0]) if liquid.size else 0.0)
    if liquid.size and high[0] - low[0] > longest * (high[1] - low[1]):
        low[0], high[0] = max(low[0], liquid[:, 0].min() - spare / 2), min(high[0], liquid[:, 0].max() + spare / 2)
    return low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin


def choose_frames(snapshots: Sequence[Snapshot], frames: int, times: Sequence[float] | None) -> list[Snapshot]:
    """Those nearest to `times` in s, or evenly spaced ones, the first and the last among them; each once."""
    if not snapshots:
        return []
    available = np.array([snapshot.time for snapshot in snapshots])
    wanted = np.linspace(available[0], available[-1], min(frames, len(available))) if times is None else np.asarray(times)
    chosen = sorted({int(np.argmin(np.abs(available - time))) for time in wanted})
    return [snapshots[k] for k in chosen]


def draw_strip(snapshots: Sequence[Snapshot], stress: str) -> Figure:
    liquid, solid = colourings(snapshots, stress)
    left, right, bottom, top = region(snapshots, longest=6.0)
    ratio = (top - bottom) / (right - left)
    columns = min(len(snapshots), 4 if ratio > 0.5 else 2)
    rows = -(-len(snapshots) // columns)
    width = 7.6
    frame_height = width / columns * ratio + 0.22
    figure = plt.figure(figsize=(width, frame_height * rows + 0.9), layout="constrained")
    # Every frame takes two columns of the grid, so that two colour bars share the last row whatever the frames' number.
    grid = figure.add_gridspec(rows + 1, 2 * columns, height_ratios=[frame_height] * rows + [0.1])
    first: Axes | None = None
    for number, snapshot in enumerate(snapshots):
        row, column = divmod(number, columns)
        axes = figure.add_subplot(grid[row, 2 * column:2 * column + 2], sharex=first, sharey=first)
        first = first or axes
        draw_particles(axes, snapshot, liquid, solid)
        axes.set(xlim=(left, right), ylim=(bottom, top))
        axes.set_title(f"{snapshot.time * MILLI:.2f} ms", loc="left", pad=2)
        for spine in axes.spines.values():
            spine.set(visible=True, linewidth=0.4, color="#9aa3ad")
        is_lowest = number + columns >= len(snapshots)
        axes.tick_params(length=2, labelsize=7.5, width=0.4, labelbottom=is_lowest, labelleft=column == 0)
        axes.set_xlabel("$x$  (mm)" if is_lowest else "")
        axes.set_ylabel("$y$  (mm)" if column == 0 else "")
    bars = [colouring for material, colouring in enumerate((liquid, solid))
            if any(np.any(masks(snapshot)[material]) for snapshot in snapshots)]
    for number, colouring in enumerate(bars):
        colouring.bar(figure, figure.add_subplot(grid[rows, number * columns:(number + 1) * columns]), "horizontal")
    return figure


def most_spread(snapshots: Sequence[Snapshot]) -> Snapshot:
    """Where the liquid is widest; without liquid the last."""
    widths = [np.ptp(s["position"][masks(s)[0], 0]) if np.any(masks(s)[0]) else 0.0 for s in snapshots]
    return snapshots[int(np.argmax(widths))] if max(widths) > 0 else snapshots[-1]


def draw_picture(snapshot: Snapshot, stress: str) -> Figure:
    liquid, solid = colourings([snapshot], stress)
    left, right, bottom, top = region([snapshot], longest=7.0)
    bars = [colouring for material, colouring in enumerate((liquid, solid)) if np.any(masks(snapshot)[material])]
    height = 9.0 * (top - bottom) / (right - left)
    figure = plt.figure(figsize=(9.2, height + 1.1), layout="constrained")
    grid = figure.add_gridspec(2, max(1, len(bars)), height_ratios=[height, 0.12])
    axes = figure.add_subplot(grid[0, :])
    draw_particles(axes, snapshot, liquid, solid)
    axes.set(xlim=(left, right), ylim=(bottom, top))
    axes.set_axis_off()
    axes.set_title(f"{snapshot.case_name},  $t$ = {snapshot.time * MILLI:.2f} ms", loc="left")
    axes.plot([right - 1, right], [top, top], color="#333a44", lw=2, solid_capstyle="butt", clip_on=False)
    axes.annotate("1 mm", (right - 0.5, top), xytext=(0, 4), textcoords="offset points", ha="center")
    for number, colouring in enumerate(bars):
        colouring.bar(figure, figure.add_subplot(grid[1, number]), "horizontal")
    return figure
