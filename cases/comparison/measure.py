"""Measures and draws the finished runs of studies into a Comparison."""

from __future__ import annotations

import math
import os
import platform
import traceback
from collections.abc import Collection, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
from comparison.ledger_figures import draw_ledgers
from comparison.ledgers import Ledger, ledger_of
from comparison.model import Comparison, Row, RunRecord, StudyReport, cpu_seconds_of
from comparison.runner import RECORD, Job, is_finished, jobs_of, read_json
from comparison.study import UNITS, Expected, Results, Study, StudyError
from sphdrop_reader import ResultError

# Numbers that every study has beside those of its plot.py: the worst of its runs.
LEDGER_QUANTITIES = {
    "largest_unaccounted_energy": ("unaccounted", "energy that the ledger does not account for"),
    "largest_energy_rise": ("rise", "rise of the energy but for what named causes put in"),
    "largest_momentum_mismatch": ("momentum_mismatch", "drop's change of momentum + impulse on the solid, of m U0"),
    "largest_angular_momentum_mismatch": ("angular_mismatch", "the same of angular momentum, of m U0 D0"),
}


def processor_name() -> str:
    """Of this machine, as its kernel calls it."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def build(studies: Sequence[Study], level: str, results: Path, figures: Path, command: str) -> Comparison:
    """Measures and draws all that is there; pictures go into FIGURES/STUDY. Studies without runs at the level are left out."""
    reports = [build_study(study, level, results, figures / study.name) for study in studies if study.variants(level)]
    return Comparison(level, reports, command, datetime.now().astimezone(), processor_name(), os.cpu_count() or 1)


def build_study(study: Study, level: str, results: Path, figures: Path) -> StudyReport:
    """Whatever a study's plot.py does wrong becomes one of the report's problems."""
    jobs = jobs_of([study], level, results)
    finished = {job.variant.name: job.results for job in jobs if is_finished(job, None)}
    runs = study.results(level, finished)
    report = StudyReport(study)
    ledgers: dict[str, Ledger] = {}
    for job in jobs:
        name, twin = job.variant.name, job.variant.twin
        if name in finished:
            try:
                ledgers[name] = ledger_of(runs.modern[twin] if twin else runs[name])
            except (ResultError, KeyError) as error:
                report.problems.append(f"the ledger of {name}: {error}")
        report.runs.append(record_of(job, name in finished, ledgers.get(name)))

    try:
        expected = study.expected(level)
    except StudyError as error:
        expected = []
        report.problems.append(str(error))
    figures.mkdir(parents=True, exist_ok=True)
    for path in figures.glob("*.png"):
        path.unlink()
    measured: dict[str, float] = {}
    modern: dict[str, float] = {}
    if finished:
        measured, modern = _measure_and_draw(report, runs, figures)
        try:
            report.ledgers = draw_ledgers(runs, figures)
        except (ResultError, KeyError) as error:
            report.problems.append(f"the ledgers' figures: {error}")
        plt.close("all")
    lacks = Lacks(any(run.state != "done" and not run.job.variant.twin for run in report.runs),
                  any(run.state != "done" and bool(run.job.variant.twin) for run in report.runs))
    modern_names = {job.variant.name for job in jobs if job.variant.twin}
    report.rows = [*rows_of(expected, measured, lacks.runs, modern, lacks.modern),
                   *ledger_rows(ledgers, expected, level, lacks.runs, modern_names, lacks.modern), *cost_rows(report.done, level)]
    return report


class Lacks(NamedTuple):
    """Whether some runs of the paper's scheme, and some in mode modern, are not there."""

    runs: bool
    modern: bool


def _measure_and_draw(report: StudyReport, runs: Results, figures: Path) -> tuple[dict[str, float], dict[str, float]]:
    """By the study's plot.py, whose code may raise anything; the other studies are told of all the same. What is measured of
    the paper's scheme, and of mode modern."""
    measured: tuple[dict[str, float], dict[str, float]] = {}, {}
    try:
        module = report.study.module()
    except Exception as error:
        report.problems.append(_where(error))
        return measured
    for found, those in zip(measured, (runs, runs.modern)):
        try:
            found |= {name: float(value) for name, value in module.measure(those).items()} if those else {}
        except Exception as error:
            report.problems.append(f"measure: {_where(error)}")
    try:
        report.drawings = list(module.draw(runs, figures))
    except Exception as error:
        report.problems.append(f"draw: {_where(error)}")
    return measured


def _where(error: Exception) -> str:
    """The error and the line of plot.py, or of what it called, that raised it."""
    frame = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} ({Path(frame.filename).name}, line {frame.lineno})"


def rows_of(expected: Sequence[Expected], measured: Mapping[str, float], lacks_runs: bool,
            modern: Mapping[str, float] | None = None, lacks_modern: bool = False) -> list[Row]:
    """First what is expected, then what was measured besides, in SI units."""
    modern = modern or {}
    rows = [Row(row, row.from_si(measured.get(row.quantity, math.nan)), lacks_runs=lacks_runs,
                modern=row.from_si(modern.get(row.quantity, math.nan)), lacks_modern=lacks_modern)
            for row in expected if row.quantity not in LEDGER_QUANTITIES]
    known = {row.quantity for row in expected}
    rows += [Row(_unexpected(name), measured.get(name, math.nan), is_expected=False, modern=modern.get(name, math.nan))
             for name in {**measured, **modern} if name not in known]
    return rows


def ledger_rows(ledgers: Mapping[str, Ledger], expected: Sequence[Expected], level: str, lacks_runs: bool,
                modern_names: Collection[str] = (), lacks_modern: bool = False) -> list[Row]:
    """The worst of the runs for each number of a ledger; checked where expected.csv has it, once all runs are there."""
    rows = []
    known = {row.quantity: row for row in expected}
    for quantity, (attribute, meaning) in LEDGER_QUANTITIES.items():
        values = {name: getattr(ledger, attribute) for name, ledger in ledgers.items()}
        values = {name: value for name, value in values.items() if math.isfinite(value)}
        groups = [[name for name in values if (name in modern_names) == is_modern] for is_modern in (False, True)]
        worst = [max(names, key=values.__getitem__, default="") for names in groups]
        measured, modern = (values.get(name, math.nan) for name in worst)
        if quantity in known:
            row = known[quantity]
            rows.append(Row(row, math.nan if lacks_runs else row.from_si(measured), lacks_runs=lacks_runs,
                            modern=math.nan if lacks_modern else row.from_si(modern), lacks_modern=lacks_modern))
        elif any(worst):
            where = " and ".join(name for name in worst if name)
            row = Expected(level, quantity, "%", 0.0, *[math.nan] * 5, description=f"{meaning}; in {where}")
            rows.append(Row(row, measured / UNITS["%"], is_expected=False, modern=modern / UNITS["%"]))
    return rows


def cost_rows(done: Sequence[RunRecord], level: str) -> list[Row]:
    """What the runs that were made in both ways have cost; nothing if there are none."""
    by_name = {run.job.variant.name: run for run in done}
    pairs = [(by_name[run.job.variant.twin], run) for run in done if run.job.variant.twin in by_name]
    if not pairs:
        return []
    seconds, modern = (cpu_seconds_of(runs) for runs in zip(*pairs))
    row = Expected(level, "cpu_time_of_pairs", "s", *[math.nan] * 6, description=f"CPU time of the {len(pairs)} runs that were made both ways")
    return [Row(row, seconds, is_expected=False, modern=modern)]


def _unexpected(quantity: str) -> Expected:
    return Expected("", quantity, "SI", *[math.nan] * 6, description="not in expected.csv")


def record_of(job: Job, is_done: bool, ledger: Ledger | None) -> RunRecord:
    """From run.json and comparison.json."""
    run, record = read_json(job.results / "run.json"), read_json(job.results / RECORD)
    if not is_done:
        if record.get("error"):
            return RunRecord(job, "failed", record["error"])
        if run.get("status") == "completed":
            return RunRecord(job, "other settings")
        return RunRecord(job, "unfinished" if record else "not run")
    details = run.get("details", {})
    wall = run.get("wall_time_seconds", math.nan)
    return RunRecord(job, "done", "", details.get("particles", 0), details.get("steps", 0), details.get("simulated_time", math.nan),
                     wall, record.get("cpu_seconds", wall * run.get("ranks", 1)), run.get("state_hash", ""),
                     run.get("git_commit", ""), ledger)
