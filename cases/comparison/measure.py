"""Measures and draws the finished runs of studies into a Comparison."""

from __future__ import annotations

import math
import os
import platform
import traceback
from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path

import matplotlib.pyplot as plt
from comparison.ledger_figures import draw_ledgers
from comparison.ledgers import Ledger, ledger_of
from comparison.model import Comparison, Row, RunRecord, StudyReport
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
    runs = Results(finished, level)
    report = StudyReport(study)
    ledgers: dict[str, Ledger] = {}
    for name in finished:
        try:
            ledgers[name] = ledger_of(runs[name])
        except (ResultError, KeyError) as error:
            report.problems.append(f"the ledger of {name}: {error}")
    report.runs = [record_of(job, job.variant.name in finished, ledgers.get(job.variant.name)) for job in jobs]

    try:
        expected = study.expected(level)
    except StudyError as error:
        expected = []
        report.problems.append(str(error))
    figures.mkdir(parents=True, exist_ok=True)
    for path in figures.glob("*.png"):
        path.unlink()
    measured: dict[str, float] = {}
    if finished:
        measured = _measure_and_draw(report, runs, figures)
        try:
            report.ledgers = draw_ledgers(runs, figures)
        except (ResultError, KeyError) as error:
            report.problems.append(f"the ledgers' figures: {error}")
        plt.close("all")
    lacks_runs = len(finished) < len(jobs)
    report.rows = rows_of(expected, measured, lacks_runs) + ledger_rows(ledgers, expected, level, lacks_runs)
    return report


def _measure_and_draw(report: StudyReport, runs: Results, figures: Path) -> dict[str, float]:
    """By the study's plot.py, whose code may raise anything; the other studies are told of all the same."""
    measured: dict[str, float] = {}
    try:
        module = report.study.module()
    except Exception as error:
        report.problems.append(_where(error))
        return measured
    try:
        measured = {name: float(value) for name, value in module.measure(runs).items()}
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


def rows_of(expected: Sequence[Expected], measured: Mapping[str, float], lacks_runs: bool) -> list[Row]:
    """First what is expected, then what was measured besides, in SI units."""
    rows = [Row(row, row.from_si(measured.get(row.quantity, math.nan)), lacks_runs=lacks_runs)
            for row in expected if row.quantity not in LEDGER_QUANTITIES]
    known = {row.quantity for row in expected}
    rows += [Row(_unexpected(name), value, is_expected=False) for name, value in measured.items() if name not in known]
    return rows


def ledger_rows(ledgers: Mapping[str, Ledger], expected: Sequence[Expected], level: str, lacks_runs: bool) -> list[Row]:
    """The worst of the runs for each number of a ledger; checked where expected.csv has it, once all runs are there."""
    rows = []
    known = {row.quantity: row for row in expected}
    for quantity, (attribute, meaning) in LEDGER_QUANTITIES.items():
        values = {name: getattr(ledger, attribute) for name, ledger in ledgers.items()}
        values = {name: value for name, value in values.items() if math.isfinite(value)}
        worst = max(values, key=values.__getitem__, default="")
        measured = values.get(worst, math.nan)
        if quantity in known:
            value = math.nan if lacks_runs else known[quantity].from_si(measured)
            rows.append(Row(known[quantity], value, lacks_runs=lacks_runs))
        elif worst:
            row = Expected(level, quantity, "%", 0.0, *[math.nan] * 5, description=f"{meaning}; in {worst}")
            rows.append(Row(row, measured / UNITS["%"], is_expected=False))
    return rows


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
