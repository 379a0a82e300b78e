#!/usr/bin/python3
"""Draws the results of a run: history.png, strip.png (like Figs 16, 17) and picture.png.

    python3 cases/figures.py RUN [--output DIR] [--frames 8 | --times 0.2 0.8 1.4] [--stress xx|von_mises]

Whatever the run does not have (a drop, a solid, a column, a history) is left out.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "io"))

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from figure_history import draw_history
from figure_particles import choose_frames, draw_picture, draw_strip, most_spread
from matplotlib.figure import Figure
from sphdrop_reader import ResultError, Run

MILLI = 1e3
LINES = ["#1763a8", "#c8442f", "#2f8f5b", "#8a5fb0", "#d69a1e", "#5b6470", "#1ca3a3", "#a8326f"]
MODERN = {"linestyle": (0, (5, 1.6)), "linewidth": 1.1}  # a run in mode modern, in the colour of its twin
STYLE = {
    "font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "legend.fontsize": 7.5, "legend.frameon": False,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "#e3e6ea", "lines.linewidth": 1.3,
    "axes.axisbelow": True, "axes.prop_cycle": matplotlib.cycler(color=LINES), "savefig.dpi": 200,
}


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
