"""What a study's plot.py does when it is run by itself: it measures, compares with expected.csv and draws.

    /usr/bin/python3 cases/cantilever/plot.py results/comparison/paper/cantilever [--output DIR]
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from comparison.study import LEVELS, Drawing, Results, Study, StudyError
from sphdrop_reader import ResultError


def finished_runs(folder: Path, names: Sequence[str]) -> dict[str, Path]:
    """Those of the named runs under a folder whose run.json calls them completed."""
    found = {}
    for name in names:
        try:
            information = json.loads((folder / name / "run.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            continue
        if information.get("status") == "completed":
            found[name] = folder / name
    return found


def comparison_lines(study: Study, level: str, measured: Mapping[str, float],
                     modern: Mapping[str, float] | None = None) -> list[str]:
    """A line for each quantity: measured, recorded, theory, paper, goal and, where there is any, what mode modern gives and
    gave, in the unit of expected.csv."""
    modern = modern or {}
    try:
        expected = {row.quantity: row for row in study.expected(level)}
    except StudyError as error:
        expected = {}
        lines = [f"note: {error}"]
    else:
        lines = []
    width = max((len(name) for name in [*expected, *measured, *modern]), default=8)
    lines.append(f"{'quantity':{width}}  {'unit':>6} {'measured':>12} {'recorded':>12} {'theory':>12} {'paper':>12} {'goal':>12}"
                 + (f" {'modern':>12} {'recorded':>12}" if modern else ""))
    for name, row in expected.items():
        value = row.from_si(measured[name]) if name in measured else math.nan
        numbers = " ".join(f"{number:12.6g}" if math.isfinite(number) else f"{'-':>12}"
                           for number in (value, row.ours, row.theory, row.paper, row.goal,
                                          *((row.from_si(modern.get(name, math.nan)), row.modern) if modern else ())))
        lines.append(f"{name:{width}}  {row.unit:>6} {numbers}" + ("" if name in measured or name in modern else "   not measured"))
    for title, values in (("", measured), (" in mode modern", modern)):
        lines += [f"{name:{width}}  {'SI':>6} {value:12.6g}   not in expected.csv{title}"
                  for name, value in values.items() if name not in expected]
    return lines


def standalone_main(file: str | Path, measure: Callable[[Results], dict[str, float]],
                    draw: Callable[[Results, Path], list[Drawing]], arguments: Sequence[str] | None = None) -> int:
    """The command line of a plot.py; `file` is its __file__. Returns the exit code."""
    study_folder = Path(file).resolve().parent
    parser = argparse.ArgumentParser(description=f"Measures and draws the runs of {study_folder.name}.")
    parser.add_argument("results", type=Path, help="folder with a folder for each run: RESULTS/LEVEL/" + study_folder.name)
    parser.add_argument("--output", type=Path, help="folder for the figures (default: figures in that of the results)")
    parser.add_argument("--level", choices=LEVELS, help="the level of the runs (default: the folder's, or else paper)")
    chosen = parser.parse_args(arguments)
    folder: Path = chosen.results.resolve()
    if not folder.is_dir():
        parser.error(f"there is no folder {chosen.results}")
    level = chosen.level or (folder.parent.name if folder.parent.name in LEVELS else LEVELS[0])
    try:
        study = Study(study_folder)
        names = [variant.name for variant in study.variants(level)]
        runs = finished_runs(folder, names)
        if not runs:
            print(f"error: {chosen.results} holds no finished run of level {level}; there could be {', '.join(names) or 'none'}",
                  file=sys.stderr)
            return 1
        missing = [name for name in names if name not in runs]
        if missing:
            print(f"not there or not finished: {', '.join(missing)}")
        results = study.results(level, runs)
        for line in comparison_lines(study, level, measure(results), measure(results.modern) if results.modern else {}):
            print(line)
        output: Path = chosen.output or folder / "figures"
        output.mkdir(parents=True, exist_ok=True)
        for drawing in draw(results, output):
            print(drawing.path, drawing.paper_figure, sep="  ")
    except (StudyError, ResultError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0
