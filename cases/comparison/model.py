"""What a report tells: each study's quantities beside theory, paper and goal, its pictures, its runs and their ledgers."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from datetime import datetime

from comparison.ledgers import Ledger
from comparison.runner import Job
from comparison.study import Drawing, Expected, Study


@dataclass(frozen=True)
class Row:
    """A quantity of a study; numbers are in the unit of `expected`, NaN where there is none."""

    expected: Expected
    measured: float
    is_expected: bool = True    # it stands in expected.csv
    lacks_runs: bool = False    # not measured, but runs of the study are not there

    @property
    def check(self) -> str:
        """Against what was recorded: pass, fail, missing (a failure, too), not run, or nothing."""
        if not self.is_expected:
            return ""
        if math.isnan(self.measured):
            return "not run" if self.lacks_runs else "missing"
        if math.isnan(self.expected.ours):
            return ""
        return "pass" if abs(self.measured - self.expected.ours) <= self.expected.tolerance else "fail"

    @property
    def goal_state(self) -> str:
        """met, not met, or nothing where there is no goal or no value."""
        if math.isnan(self.expected.goal) or math.isnan(self.measured):
            return ""
        return "met" if abs(self.measured - self.expected.goal) <= self.expected.goal_tolerance else "not met"

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
        value = self.reference[1]
        return (self.measured - value) / abs(value) if value != 0 else math.nan


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
        return sum(run.cpu_seconds for run in self.done if math.isfinite(run.cpu_seconds))


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
        return sum(row.check == check for row in self.rows)

    def count_goals(self, state: str) -> int:
        return sum(row.goal_state == state for row in self.rows)

    @property
    def passes(self) -> bool:
        """Whether no check fails and nothing kept a study from being measured and drawn."""
        return not (self.count("fail") or self.count("missing") or any(study.problems for study in self.studies))
