#!/usr/bin/python3
"""Draws the results of a run: history.png, strip.png (like Figs 16, 17) and picture.png.

    python3 cases/figures.py RUN [--output DIR] [--frames 8 | --times 0.2 0.8 1.4] [--stress xx|von_mises]

Whatever the run does not have (a drop, a solid, a column, a history) is left out.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "io"))

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Colormap, LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray
from sphdrop_reader import History, ResultError, Run, Snapshot

Array = NDArray[np.float64]
MILLI = 1e3
WATER = LinearSegmentedColormap.from_list("water", ["#0b2f6b", "#1763a8", "#2f9fd0", "#7fd6de", "#e4f7d4"])
LINES = ["#1763a8", "#c8442f", "#2f8f5b", "#8a5fb0", "#d69a1e", "#5b6470", "#1ca3a3", "#a8326f"]
STYLE = {
    "font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "legend.fontsize": 7.5, "legend.frameon": False,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "#e3e6ea", "lines.linewidth": 1.3,
    "axes.axisbelow": True, "axes.prop_cycle": matplotlib.cycler(color=LINES), "savefig.dpi": 200,
}


# ---------------------------------------------------------------------------------------------------- history
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
    Panel("contact impulse  (N s/m)", {"contact_impulse_y": "$y$", "contact_impulse_x": "$x$"}),
    Panel("energy  (mJ/m)", {"kinetic_fluid": "kinetic, liquid", "kinetic_solid": "kinetic, solid", "elastic": "elastic",
                             "contact": "contact", "compressive": "compressive",
                             "dissipated_fluid": "dissipated, liquid", "dissipated_solid": "dissipated, solid"}, MILLI),
    Panel("energy since the start  (mJ/m)", {"surface": "surface", "total": "total", "gravity_work": "work of gravity",
                                             "density_correction_energy": "density correction"}, MILLI, "start"),
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
        axes.legend(ncols=2, loc="best")


def draw_history(history: History) -> Figure | None:
    """None if none of the panels has anything to show."""
    panels = [panel for panel in PANELS if any(name in history and np.any(np.nan_to_num(history[name])) for name in panel.curves)]
    if not panels or "time" not in history or len(history["time"]) < 2:
        return None
    columns = 2 if len(panels) > 1 else 1
    rows = -(-len(panels) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(3.6 * columns, 2.2 * rows), sharex=True, squeeze=False,
                                layout="constrained")
    for axes, panel in zip(grid.flat, panels):
        draw_panel(axes, panel, history)
    for axes in grid.flat[len(panels):]:
        axes.remove()
    for axes in grid.flat[max(0, len(panels) - columns):len(panels)]:
        axes.set_xlabel("time  (ms)")
        axes.tick_params(labelbottom=True)
    return figure


# ---------------------------------------------------------------------------------------------------- particles
def masks(snapshot: Snapshot) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which particles are liquid and which solid; without a column that says so all are liquid."""
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

    def bar(self, figure: Figure, axes: Any, **options: Any) -> None:
        bar = figure.colorbar(ScalarMappable(self.scale, self.colours), ax=axes, **options)
        bar.set_label(self.label)
        bar.outline.set_linewidth(0.4)


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
    liquid = Colouring(speed, "speed of the liquid  (m/s)", WATER, Normalize(0, limit(snapshots, speed, 0)))
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


def region(snapshots: Sequence[Snapshot]) -> tuple[float, float, float, float]:
    """x and y limits in mm that hold all frames; of a long thin scene the part around the drop."""
    everything = np.concatenate([snapshot["position"] for snapshot in snapshots]) * MILLI
    liquid = np.concatenate([snapshot["position"][masks(snapshot)[0]] for snapshot in snapshots]) * MILLI
    low, high = everything.min(axis=0), everything.max(axis=0)
    if liquid.size and high[0] - low[0] > 4.5 * (high[1] - low[1]):
        reach = 1.5 * (high[1] - low[1])
        low[0], high[0] = max(low[0], liquid[:, 0].min() - reach), min(high[0], liquid[:, 0].max() + reach)
    margin = 0.04 * max(high - low) + 1e-3
    return low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin


# ---------------------------------------------------------------------------------------------------- figures
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
    left, right, bottom, top = region(snapshots)
    ratio = (top - bottom) / (right - left)
    columns = min(len(snapshots), 4 if ratio > 0.45 else 2 if ratio > 0.12 else 1)
    rows = -(-len(snapshots) // columns)
    width = 7.6
    figure, grid = plt.subplots(rows, columns, figsize=(width, (width / columns * ratio + 0.28) * rows + 1.0), sharex=True,
                                sharey=True, squeeze=False, layout="constrained")
    for axes, snapshot in zip(grid.flat, snapshots):
        draw_particles(axes, snapshot, liquid, solid)
        axes.set(xlim=(left, right), ylim=(bottom, top))
        axes.set_title(f"{snapshot.time * MILLI:.2f} ms", loc="left", pad=2)
        axes.tick_params(length=2, labelsize=7.5)
    for axes in grid.flat[len(snapshots):]:
        axes.remove()
    figure.supxlabel("$x$  (mm)", fontsize=9)
    figure.supylabel("$y$  (mm)", fontsize=9)
    options = {"location": "bottom", "aspect": 30, "shrink": 0.42 if columns > 1 else 0.8, "pad": 0.02}
    if any(np.any(masks(snapshot)[0]) for snapshot in snapshots):
        liquid.bar(figure, grid, **options, anchor=(0.02, 1.0))
    if any(np.any(masks(snapshot)[1]) for snapshot in snapshots):
        solid.bar(figure, grid, **options, anchor=(0.98, 1.0))
    return figure


def most_spread(snapshots: Sequence[Snapshot]) -> Snapshot:
    """Where the liquid is widest; without liquid the last."""
    widths = [np.ptp(s["position"][masks(s)[0], 0]) if np.any(masks(s)[0]) else 0.0 for s in snapshots]
    return snapshots[int(np.argmax(widths))] if max(widths) > 0 else snapshots[-1]


def draw_picture(snapshot: Snapshot, stress: str) -> Figure:
    liquid, solid = colourings([snapshot], stress)
    left, right, bottom, top = region([snapshot])
    figure, axes = plt.subplots(figsize=(8, max(2.2, 6.8 * (top - bottom) / (right - left) + 1.1)), layout="constrained")
    draw_particles(axes, snapshot, liquid, solid)
    axes.set(xlim=(left, right), ylim=(bottom, top))
    axes.set_axis_off()
    axes.set_title(f"{snapshot.case_name},  $t$ = {snapshot.time * MILLI:.2f} ms", loc="left")
    millimetre = 1.0 if right - left < 12 else 2.0
    axes.plot([right - millimetre, right], [bottom, bottom], color="#333a44", lw=2, solid_capstyle="butt")
    axes.annotate(f"{millimetre:.0f} mm", (right - millimetre / 2, bottom), xytext=(0, 4), textcoords="offset points", ha="center")
    options = {"location": "right", "shrink": 0.85, "aspect": 22, "pad": 0.01}
    if np.any(masks(snapshot)[0]):
        liquid.bar(figure, axes, **options)
    if np.any(masks(snapshot)[1]):
        solid.bar(figure, axes, **options)
    return figure


def draw_all(run: Run, output: Path, frames: int = 8, times: Sequence[float] | None = None, stress: str = "xx") -> list[Path]:
    """Draws what the run has the data for; returns the files written."""
    output.mkdir(parents=True, exist_ok=True)
    figures: dict[str, Figure | None] = {}
    with plt.rc_context(STYLE):
        if (run.directory / "history.csv").exists():
            figures["history.png"] = draw_history(run.history)
        snapshots = [snapshot for snapshot in run.snapshots if snapshot.particle_count > 0]
        if snapshots:
            figures["strip.png"] = draw_strip(choose_frames(snapshots, frames, times), stress)
            figures["picture.png"] = draw_picture(most_spread(snapshots), stress)
        written = []
        for name, figure in figures.items():
            if figure is not None:
                figure.savefig(output / name)
                plt.close(figure)
                written.append(output / name)
    return written


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", type=Path, help="directory of the results")
    parser.add_argument("--output", type=Path, help="directory for the figures (default: the run's)")
    parser.add_argument("--frames", type=int, default=8, help="frames in the strip, evenly spaced (default: 8)")
    parser.add_argument("--times", type=float, nargs="+", metavar="MS", help="times of the frames in ms, instead")
    parser.add_argument("--stress", choices=("xx", "von_mises"), default="xx", help="colours the solid (default: xx)")
    chosen = parser.parse_args(arguments)
    if chosen.frames < 1:
        parser.error("--frames must be at least 1")
    times = None if chosen.times is None else [time / MILLI for time in chosen.times]
    try:
        written = draw_all(Run(chosen.run), chosen.output or chosen.run, chosen.frames, times, chosen.stress)
    except (ResultError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    for path in written:
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
