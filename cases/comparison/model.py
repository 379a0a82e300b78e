"""What a report tells: each study's quantities beside theory, paper and goal, its pictures, its runs and their ledgers."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from datetime import datetime

from comparison.ledgers import Ledger
from comparison.runner import Job
from comparison.study import Drawing, Expected, Study


@dataclass(frozen=True)
class Row:
    """A quantity of a study; numbers are in the unit of `expected`, NaN where there is none."""

    expected: Expected
    measured: float             # of the paper's scheme
    is_expected: bool = True    # it stands in expected.csv
    lacks_runs: bool = False    # not measured, but runs of the study are not there
    modern: float = math.nan    # the same of the runs in mode modern
    lacks_modern: bool = False  # some of those are not there

    @property
    def check(self) -> str:
        """Against what was recorded: pass, fail, missing (a failure, too), not run, or nothing."""
        e = self.expected
        if self.is_expected and math.isnan(self.measured) and not self.lacks_runs and math.isnan(e.ours) and not math.isnan(e.modern):
            return ""  # only mode modern has it
        return self._check(self.measured, e.ours, e.tolerance, self.lacks_runs)

    @property
    def modern_check(self) -> str:
        """The same of mode modern; nothing where nothing was recorded of it."""
        e = self.expected
        return "" if math.isnan(e.modern) else self._check(self.modern, e.modern, e.modern_tolerance, self.lacks_modern)

    def _check(self, measured: float, recorded: float, tolerance: float, lacks_runs: bool) -> str:
        if not self.is_expected:
            return ""
        if math.isnan(measured):
            return "not run" if lacks_runs else "missing"
        if math.isnan(recorded):
            return ""
        return "pass" if abs(measured - recorded) <= tolerance else "fail"

    @property
    def goal_state(self) -> str:
        """met, not met, or nothing where there is no goal or no value."""
        return self._goal_state(self.measured)

    @property
    def modern_goal_state(self) -> str:
        """Only of goals that theory sets: others are of what the paper's scheme or codes like it give."""
        e = self.expected
        is_theory = math.isnan(e.modern_theory) and abs(e.goal - e.theory) <= e.goal_tolerance
        return self._goal_state(self.modern) if is_theory else ""

    def _goal_state(self, measured: float) -> str:
        if math.isnan(self.expected.goal) or math.isnan(measured):
            return ""
        return "met" if abs(measured - self.expected.goal) <= self.expected.goal_tolerance else "not met"

    @property
    def reference(self) -> tuple[str, float]:
        """What the error is counted from: theory, or else the paper, or else the goal."""
        for name in ("theory", "paper", "goal"):
            value = getattr(self.expected, name)
            if not math.isnan(value):
                return name, value
        return "", math.nan

    @property
    def error(self) -> float:
        """Relative to the reference; NaN without one, or where it is zero."""
        return _relative_error(self.measured, self.reference[1])

    @property
    def modern_reference(self) -> tuple[str, float]:
        """The same of mode modern, which meets no goal that is not theory's."""
        if not math.isnan(self.expected.modern_theory):
            return "theory", self.expected.modern_theory
        return self.reference if self.reference[0] != "goal" else ("", math.nan)

    @property
    def modern_error(self) -> float:
        return _relative_error(self.modern, self.modern_reference[1])


def _relative_error(measured: float, value: float) -> float:
    return (measured - value) / abs(value) if value != 0 else math.nan


@dataclass(frozen=True)
class RunRecord:
    """A run of a study and what it cost."""

    job: Job
    state: str                  # done, failed, unfinished, other settings, not run
    error: str = ""
    particles: int = 0
    steps: int = 0
    simulated_time: float = math.nan  # s
    wall_seconds: float = math.nan
    cpu_seconds: float = math.nan     # of all ranks
    state_hash: str = ""
    commit: str = ""
    ledger: Ledger | None = None

    @property
    def nanoseconds(self) -> float:
        """CPU time in ns for a particle and a step."""
        work = self.particles * self.steps
        return 1e9 * self.cpu_seconds / work if work else math.nan


def cpu_seconds_of(runs: Iterable[RunRecord]) -> float:
    """Of all that say it."""
    return sum(run.cpu_seconds for run in runs if math.isfinite(run.cpu_seconds))


@dataclass
class StudyReport:
    study: Study
    rows: list[Row] = field(default_factory=list)
    drawings: list[Drawing] = field(default_factory=list)
    ledgers: list[Drawing] = field(default_factory=list)
    runs: list[RunRecord] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)  # what kept measuring or drawing from being whole

    @property
    def done(self) -> list[RunRecord]:
        return [run for run in self.runs if run.state == "done"]

    @property
    def cpu_seconds(self) -> float:
        return cpu_seconds_of(self.done)

    @property
    def modern(self) -> list[RunRecord]:
        """The finished runs in mode modern."""
        return [run for run in self.done if run.job.variant.twin]


@dataclass
class Comparison:
    level: str
    studies: list[StudyReport]
    command: str
    date: datetime
    processor: str
    cores: int

    @property
    def rows(self) -> list[Row]:
        return [row for study in self.studies for row in study.rows]

    @property
    def runs(self) -> list[RunRecord]:
        return [run for study in self.studies for run in study.runs]

    @property
    def commits(self) -> dict[str, int]:
        """How many runs there are of each commit."""
        counts: dict[str, int] = {}
        for run in self.runs:
            if run.state == "done":
                counts[run.commit] = counts.get(run.commit, 0) + 1
        return counts

    def count(self, check: str) -> int:
        """Of both the paper's scheme and mode modern."""
        return sum((row.check == check) + (row.modern_check == check) for row in self.rows)

    def count_goals(self, state: str) -> int:
        return sum(row.goal_state == state for row in self.rows)

    def count_modern_goals(self, state: str) -> int:
        return sum(row.modern_goal_state == state for row in self.rows)

    @property
    def passes(self) -> bool:
        """Whether no check fails and nothing kept a study from being measured and drawn."""
        return not (self.count("fail") or self.count("missing") or any(study.problems for study in self.studies))
