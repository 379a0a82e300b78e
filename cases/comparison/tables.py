"""The cells of the report's tables, the same in HTML and in Markdown."""

from __future__ import annotations

import math

from comparison.cost import in_words
from comparison.model import Comparison, Row, RunRecord, StudyReport, cpu_seconds_of

QUANTITY_HEADINGS = ("quantity", "unit", "theory", "paper", "goal", "ours (paper's scheme)", "ours (modern)", "error", "error (modern)",
                     "recorded", "recorded (modern)", "check", "goal met")
RUN_HEADINGS = ("run", "particles", "steps", "simulated (ms)", "wall (s)", "CPU (s)", "ns per particle and step",
                "unaccounted energy", "energy rise", "momentum mismatch", "angular mismatch", "state hash", "commit")
CHECK_WORDS = {"pass": "pass", "fail": "FAIL", "missing": "MISSING", "not run": "not run", "": ""}


def number(value: float, digits: int = 4) -> str:
    """With so many significant digits; nothing for NaN."""
    if math.isnan(value):
        return ""
    return f"{value:.{digits}g}"


def share(value: float) -> str:
    """As a percentage of two digits."""
    return "" if math.isnan(value) else f"{100 * value:.2g} %"


def with_tolerance(value: float, tolerance: float) -> str:
    return "" if math.isnan(value) else f"{number(value, 5)} ± {number(tolerance, 2)}"


def error_text(row: Row, is_modern: bool = False) -> str:
    """Against theory, or what else stands in brackets."""
    error = row.modern_error if is_modern else row.error
    if math.isnan(error):
        return ""
    name, _ = row.modern_reference if is_modern else row.reference
    return f"{100 * error:+.2g} %" + (f" ({name})" if name != "theory" else "")


def both(own: str, modern: str) -> str:
    """A state of the paper's scheme and one of mode modern in a cell."""
    if own == modern or not modern:
        return own
    return f"{own}; modern {modern}" if own else f"modern {modern}"


def worst_of(text: str) -> str:
    """The state by which a cell made by both() is coloured: the worse one of a check; none of two goals that differ."""
    states = [part.removeprefix("modern ") for part in text.split("; ")]
    for state in ("FAIL", "MISSING", "not run"):
        if state in states:
            return state
    return states[0] if len(states) == 1 else ""


def quantity_cells(row: Row) -> list[str]:
    """Those under QUANTITY_HEADINGS."""
    e = row.expected
    digits = 5 if row.is_expected or e.unit != "%" else 2
    return [e.quantity, e.unit, both(number(e.theory), number(e.modern_theory)), number(e.paper), with_tolerance(e.goal, e.goal_tolerance),
            number(row.measured, digits), number(row.modern, digits), error_text(row), error_text(row, is_modern=True),
            with_tolerance(e.ours, e.tolerance), with_tolerance(e.modern, e.modern_tolerance),
            both(CHECK_WORDS[row.check], CHECK_WORDS[row.modern_check]), both(row.goal_state, row.modern_goal_state)]


def study_line(report: StudyReport) -> str:
    """How many runs there are and what they cost."""
    text = f"{len(report.done)} of {len(report.runs)} runs, CPU time {in_words(report.cpu_seconds)}"
    if report.modern:
        text += f"; of these {len(report.modern)} in mode modern, {in_words(cpu_seconds_of(report.modern))}"
    return text


def run_cells(run: RunRecord) -> list[str]:
    """Those under RUN_HEADINGS."""
    if run.state != "done":
        return [run.job.variant.name, run.state, *[""] * (len(RUN_HEADINGS) - 2)]
    ledger = run.ledger
    shares = [ledger.unaccounted, ledger.rise, ledger.momentum_mismatch, ledger.angular_mismatch] if ledger else [math.nan] * 4
    return [run.job.variant.name, str(run.particles), str(run.steps), number(1e3 * run.simulated_time), f"{run.wall_seconds:.1f}",
            f"{run.cpu_seconds:.1f}", f"{run.nanoseconds:.0f}" if math.isfinite(run.nanoseconds) else "",
            *[share(value) for value in shares], run.state_hash, run.commit[:8] + ("+" if "+" in run.commit else "")]


def counts_line(comparison: Comparison) -> str:
    """Checks and goals in a sentence."""
    parts = [f"{comparison.count('pass')} checks pass, {comparison.count('fail')} fail"]
    for check, words in (("missing", "are missing"), ("not run", "wait for runs")):
        if comparison.count(check):
            parts.append(f"{comparison.count(check)} {words}")
    text = ", ".join(parts) + f"; {comparison.count_goals('met')} goals met, {comparison.count_goals('not met')} not met"
    met, missed = (comparison.count_modern_goals(state) for state in ("met", "not met"))
    return text + (f"; in mode modern {met} met, {missed} not met" if met + missed else "")


def runs_line(comparison: Comparison) -> str:
    done = [run for run in comparison.runs if run.state == "done"]
    return f"{len(done)} of {len(comparison.runs)} runs"


def commits_line(comparison: Comparison) -> str:
    """The commits of the program that the runs are of, with their numbers if there are several."""
    commits = comparison.commits
    if len(commits) == 1:
        return f"commit {next(iter(commits))}"
    return "commits " + ", ".join(f"{commit} ({count} runs)" for commit, count in commits.items()) if commits else "no runs"


def result_line(comparison: Comparison) -> str:
    """In a few words."""
    failures = comparison.count("fail") + comparison.count("missing")
    parts = [f"{failures} checks fail"] if failures else []
    if problems := sum(len(report.problems) for report in comparison.studies):
        parts.append(f"{problems} problems in measuring and drawing")
    if absent := sum(run.state != "done" for run in comparison.runs):
        parts.append(f"{absent} runs are not there")
    return "; ".join(parts) or ("all runs are there and all checks pass" if comparison.count("pass") else "all runs are there")


def summary(comparison: Comparison) -> list[tuple[str, str]]:
    """The report's head: what and its value."""
    done = [run for run in comparison.runs if run.state == "done"]
    wall = sum(run.wall_seconds for run in done if math.isfinite(run.wall_seconds))
    cpu = sum(report.cpu_seconds for report in comparison.studies)
    only = ", ".join(report.study.name for report in comparison.studies)
    return [
        ("result", result_line(comparison)),
        ("checks and goals", counts_line(comparison)),
        ("level", comparison.level),
        ("studies", only),
        ("runs", runs_line(comparison)),
        ("program", commits_line(comparison)),
        ("cost of the runs", f"{in_words(wall)} wall time, {in_words(cpu)} CPU time"),
        ("report made", comparison.date.strftime("%Y-%m-%d %H:%M %Z")),
        ("on", f"{comparison.processor}, {comparison.cores} cores"),
        ("command", comparison.command),
    ]


LEGEND = (
    "Paper: what the paper states. Ours: measured, once with the paper's scheme and once, of the runs that end with _modern, in "
    "mode modern. Check: the measured value against the one recorded when expected.csv was written. Goal: the number to meet, "
    "from theory or the paper. The error counts from theory where there is one, or else from what is in brackets. What the "
    "ledgers' rows give is the worst of a study's runs. CPU time is that of all ranks; cpu_time_of_pairs is that of the runs "
    "which were made both ways."
)
