"""The runs of a sweep on this machine, some at a time."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from comparison.cost import rate_of
from comparison.progress import Progress
from comparison.runner import Job, Runner, commit_of, is_finished, mpi_environment, read_json
from comparison.study import Variant
from sweep.table import SweepError, Table, folder_of, settings


@dataclass(frozen=True)
class Row(Variant):
    """A row of the table; its values go to the program as they are written."""

    @property
    def arguments(self) -> list[str]:
        return settings(self.settings)


@dataclass
class SweepCase:
    """The case of a sweep, as the runner wants it."""

    case_file: Path
    program: Path
    known: dict[str, dict[str, Any]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        return "sweep"

    @cached_property
    def text(self) -> str:
        try:
            return self.case_file.read_text(encoding="utf-8")
        except OSError as error:
            raise SweepError(f"{self.case_file} cannot be read: {error.strerror}") from error

    def parameters(self, variant: Variant) -> Mapping[str, Any]:
        """The case with the row's values, every parameter in SI units, as the program understands it. Raises SweepError in
        the program's words if the row makes no case."""
        if variant.name not in self.known:
            told = subprocess.run([self.program, self.case_file, *variant.arguments, "--print-case"], capture_output=True, text=True,
                                  check=False, env=mpi_environment())
            if told.returncode != 0:
                raise SweepError(f"{variant.name}: {told.stderr.strip() or 'the program failed'}")
            self.known[variant.name] = tomllib.loads(told.stdout)
        return self.known[variant.name]


def make_runs(table: Table, case_file: Path, results: Path, program: Path, ranks: int, parallel: int, any_version: bool) -> int:
    """Makes what is missing and takes up what was stopped. A row that makes no case stops it before any run; a run that fails
    is told and does not stop the others. The number of failures."""
    case = SweepCase(case_file, program.resolve())
    case.text  # noqa: B018  whether it can be read
    jobs = [Job(case, Row(folder_of(number), row), results / folder_of(number)) for number, row in enumerate(table)]
    mistakes = []
    for job in jobs:
        try:
            case.parameters(job.variant)
        except SweepError as error:
            mistakes.append(str(error))
    if mistakes:
        raise SweepError("nothing was run:\n" + "\n".join(mistakes))
    commit = None if any_version else commit_of(program)
    missing = [job for job in jobs if not is_finished(job, commit)]
    print(f"{len(jobs)} runs, {len(jobs) - len(missing)} there already", flush=True)
    with Progress(missing, rate_of((read_json(job.results / "run.json") for job in jobs), ranks), parallel, sys.stdout) as progress:
        outcomes = Runner(program, ranks, parallel, commit, watch=progress).run(missing)
    return sum(bool(outcome.error) for outcome in outcomes)
