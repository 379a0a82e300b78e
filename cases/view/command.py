"""The command line of sphdrop-view."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from figure_particles import choose_frames, most_spread
from figures import STYLE, draw_all
from sphdrop_reader import ResultError, Run, Snapshot
from view.animation import AnimationError, default_format, write_animation
from view.facts import outcome, title_of
from view.follow import follow
from view.frames import film, film_times, picture_bytes, scene_of, snapshots_with_particles
from view.page import Film, page
from view.side_by_side import draw_histories, draw_rows

KINDS = ("figures", "animation", "page")
FILM_RESOLUTION = 110  # dots per inch
EPILOG = """examples:
  sphdrop-view results/cantilever                     all of it, into the run's folder
  sphdrop-view results/a results/b --output compared  side by side
  sphdrop-view results/cantilever --only animation --format gif
  sphdrop-view results/cantilever --follow            while it runs
"""


class UsageError(Exception):
    """A wish that cannot be met; the text says why and what to do."""


def names_of(runs: Sequence[Run]) -> list[str]:
    """The runs' names; where two are the same, their folders' too."""
    titles = [title_of(run) for run in runs]
    folders = [run.directory.resolve().name for run in runs]
    return [title if titles.count(title) == 1 else folder if folders.count(folder) == 1 else str(run.directory)
            for title, folder, run in zip(titles, folders, runs)]


def make_film(names: Sequence[str], snapshots: Sequence[Sequence[Snapshot]], options: argparse.Namespace) -> Film:
    times = film_times(snapshots, options.film_frames)
    scene = scene_of(names, snapshots, options.stress)
    pictures = []
    for number, (_, figure) in enumerate(film(scene, snapshots, times), start=1):
        pictures.append(picture_bytes(figure, FILM_RESOLUTION))
        if sys.stderr.isatty():
            print(f"\rframe {number} of {len(times)}", end="", file=sys.stderr, flush=True)
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr)
    widest = most_spread(snapshots[0]).time
    return Film(times, pictures, options.rate, int(np.argmin(np.abs(np.array(times) - widest))))


def compare_figures(names: Sequence[str], runs: Sequence[Run], snapshots: Sequence[Sequence[Snapshot]],
                    options: argparse.Namespace) -> list[Path]:
    written = []
    figures = {"histories.png": draw_histories(names, runs)}
    if all(snapshots):
        times = [snapshot.time for snapshot in choose_frames(max(snapshots, key=len), min(options.frames, 6), options.times)]
        figures["strips.png"] = draw_rows(scene_of(names, snapshots, options.stress), snapshots, times)
    for name, figure in figures.items():
        if figure is not None:
            figure.savefig(options.output / name)
            plt.close(figure)
            written.append(options.output / name)
    return written


def show(runs: Sequence[Run], options: argparse.Namespace) -> list[Path]:
    """Draws what is asked for; returns the files written."""
    names, written = names_of(runs), []
    snapshots = [snapshots_with_particles(run) for run in runs]
    options.output.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE):
        if "figures" in options.only:
            written += (draw_all(runs[0], options.output, options.frames, options.times, options.stress) if len(runs) == 1
                        else compare_figures(names, runs, snapshots, options))
        has_film = all(snapshots) and ({"animation", "page"} & set(options.only))
        picture_film = make_film(names, snapshots, options) if has_film else None
    if "animation" in options.only:
        if picture_film is None and options.only == ["animation"]:
            raise UsageError("there are no snapshots to make an animation of")
        if picture_film is not None and len(picture_film.frames) > 1:
            path = options.output / f"animation.{options.format}"
            write_animation(picture_film.frames, path, options.rate)
            written.append(path)
    if "page" in options.only:
        path = options.output / "report.html"
        path.write_text(page(names, runs, picture_film), encoding="utf-8")
        written.append(path)
    return written


def parser() -> argparse.ArgumentParser:
    made = argparse.ArgumentParser(
        prog="sphdrop-view", formatter_class=argparse.RawDescriptionHelpFormatter, epilog=EPILOG,
        description="Shows runs: figures, an animation, and a page for the browser that needs nothing beside it (report.html).")
    made.add_argument("runs", type=Path, nargs="+", metavar="RUN", help="folder of a run's results; several are shown side by side")
    made.add_argument("--output", type=Path, help="folder for what is made (default: the run's; of several: compared)")
    made.add_argument("--only", nargs="+", choices=KINDS, default=list(KINDS), help="make only these")
    made.add_argument("--format", choices=("mp4", "gif"), default=None, help="of the animation (default: mp4 where ffmpeg is installed)")
    made.add_argument("--film-frames", type=int, default=60, metavar="N", help="most frames of the film (default: 60)")
    made.add_argument("--rate", type=float, default=12.0, metavar="FPS", help="frames a second (default: 12)")
    made.add_argument("--frames", type=int, default=8, metavar="N", help="frames of the strip, evenly spaced (default: 8)")
    made.add_argument("--times", type=float, nargs="+", metavar="MS", help="times of the strip's frames in ms, instead")
    made.add_argument("--stress", choices=("xx", "von_mises"), default="xx", help="colours the solid (default: xx)")
    made.add_argument("--follow", type=float, nargs="?", const=2.0, default=None, metavar="SECONDS",
                      help="watch a run that goes on: a line and a new history.png at most every SECONDS (default: 2)")
    return made


def main(arguments: Sequence[str] | None = None) -> int:
    command = parser()
    options = command.parse_args(arguments)
    if options.frames < 1 or options.film_frames < 1:
        command.error("--frames and --film-frames must be at least 1")
    if not options.rate > 0 or (options.follow is not None and not options.follow > 0):
        command.error("--rate and --follow must be above 0")
    if options.follow is not None and len(options.runs) != 1:
        command.error("--follow watches one run")
    options.times = None if options.times is None else [time / 1e3 for time in options.times]
    options.output = options.output or (options.runs[0] if len(options.runs) == 1 else Path("compared"))
    options.format = options.format or default_format()
    try:
        if options.follow is not None:
            with suppress(KeyboardInterrupt), plt.rc_context(STYLE):
                follow(options.runs[0], options.output, options.follow)
            return 0
        runs = [Run(path) for path in options.runs]
        written = show(runs, options)
    except (ResultError, UsageError, AnimationError, OSError) as error:
        print(f"sphdrop-view: {error}", file=sys.stderr)
        return 1
    for path in written:
        print(path)
    if len(runs) == 1:
        for label, value in outcome(runs[0]):
            print(f"  {label}: {value}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
