"""Runs the variants of studies, one after the other or some at a time, and takes up where an earlier attempt stopped.

A run's results stand in RESULTS/LEVEL/STUDY/VARIANT; comparison.json there says of which case file and settings they are.
A run is taken as it is if it is completed, of the same case and settings, and from the same commit of the program. One that
was stopped goes on from its last checkpoint if that is of this commit.
"""

from __future__ import annotations

import contextlib
import hashlib
import itertools
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import tomllib
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from comparison.study import Study, Variant

RECORD = "comparison.json"


class Cases(Protocol):
    """What makes runs: a study, or a sweep."""

    @property
    def name(self) -> str: ...

    @property
    def case_file(self) -> Path: ...

    def parameters(self, variant: Variant) -> Mapping[str, Any]:
        """The case with the variant's settings."""


@dataclass(frozen=True)
class Job:
    """A run to make, and where its results go."""

    study: Cases
    variant: Variant
    results: Path

    @property
    def title(self) -> str:
        return f"{self.study.name}/{self.variant.name}"

    def fingerprint(self) -> str:
        """Of the case with its settings; comments and layout of the files do not count."""
        case = tomllib.loads(self.study.case_file.read_text(encoding="utf-8"))
        text = json.dumps([case, dict(self.variant.settings)], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True)
class Outcome:
    job: Job
    error: str = ""      # empty: the results are there
    was_there: bool = False
    seconds: float = 0.0  # wall time of the run


class Watcher(Protocol):
    """Is told of runs; calls come one at a time, from any thread."""

    def started(self, job: Job) -> None: ...

    def ended(self, outcome: Outcome) -> None: ...


class Teller:
    """A line when a run begins and when it ends."""

    def __init__(self, total: int, say: Callable[[str], None] = print) -> None:
        self._total, self._say, self._done = total, say, 0

    def started(self, job: Job) -> None:
        self._say(f"[{self._done}/{self._total}] {job.title}: runs")

    def ended(self, outcome: Outcome) -> None:
        self._done += 1
        text = "is there already" if outcome.was_there else outcome.error or f"done in {outcome.seconds:.0f} s"
        self._say(f"[{self._done}/{self._total}] {outcome.job.title}: {text}")


def jobs_of(studies: Sequence[Study], level: str, results: Path, names: Sequence[str] = ()) -> list[Job]:
    """Every run of the studies at a level; `names` keeps those whose study/variant begins with one of them."""
    jobs = [Job(study, variant, results / level / study.name / variant.name)
            for study in studies for variant in study.variants(level)]
    return [job for job in jobs if not names or any(job.title.startswith(name) for name in names)]


def read_json(path: Path) -> dict[str, Any]:
    """A file's table; empty if there is none that can be read."""
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return table if isinstance(table, dict) else {}


def is_finished(job: Job, commit: str | None) -> bool:
    """Whether the results are complete and of this case; of this commit too, unless it is None."""
    run, record = read_json(job.results / "run.json"), read_json(job.results / RECORD)
    return (run.get("status") == "completed" and record.get("fingerprint") == job.fingerprint()
            and (commit is None or run.get("git_commit") == commit))


def can_go_on(job: Job, commit: str | None) -> bool:
    """Whether there are checkpoints of this case from this commit of the program, which must be known and without changes."""
    run, record = read_json(job.results / "run.json"), read_json(job.results / RECORD)
    return (commit is not None and not commit.endswith("+changes") and run.get("git_commit") == commit
            and record.get("fingerprint") == job.fingerprint() and any(job.results.glob("checkpoint_*.h5")))


def commit_of(program: Path) -> str | None:
    """The commit that the program was built from, as its --version tells it ("+changes" behind it if there were any);
    None if it does not say."""
    text = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    found = re.search(r"\b[0-9a-f]{40}(\+changes)?", text)
    return found[0] if found else None


def last_words(log: str) -> str:
    """The end of what the program itself said; what mpirun adds to a failure stands between lines of dashes."""
    lines = [line.strip() for line in log.splitlines() if line.strip()]
    own = list(itertools.takewhile(lambda line: set(line) != {"-"} or len(line) < 20, lines))
    return " / ".join((own or lines)[-3:]) or "nothing was said"


def mpi_environment() -> dict[str, str]:
    """The environment for mpirun: ranks may share cores, and a root user is not asked twice."""
    environment = dict(os.environ)
    environment.setdefault("OMPI_MCA_rmaps_base_oversubscribe", "1")
    environment.setdefault("OMPI_MCA_hwloc_base_binding_policy", "none")
    # Where cores are scarce, a rank that waits would keep the core from the one it waits for.
    environment.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")
    if os.geteuid() == 0:
        environment.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
        environment.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
    return environment


class Runner:
    """Makes runs on so many ranks each, so many at a time. `watch` is told when one begins and ends; without it, `say`
    gets a line each time."""

    def __init__(self, program: Path, ranks: int = 2, parallel: int = 1, commit: str | None = None,
                 say: Callable[[str], None] = print, watch: Watcher | None = None) -> None:
        self.program, self.ranks, self.parallel, self.commit, self.say = program, ranks, parallel, commit, say
        self._watch = watch
        self._lock = threading.Lock()
        self._processes: dict[int, subprocess.Popen[bytes]] = {}
        self._is_stopped = False
        self._commit_of_program: str | None = None

    def run(self, jobs: Sequence[Job]) -> list[Outcome]:
        """Makes what is missing. A failed run is told and does not stop the others.

        An interruption (KeyboardInterrupt) ends the present runs, which write a checkpoint and go on from it the next time;
        finished ones stay.
        """
        self._is_stopped = False
        with contextlib.suppress(OSError, subprocess.CalledProcessError):  # each run will tell
            self._commit_of_program = commit_of(self.program)
        watch = self._watch or Teller(len(jobs), self.say)
        pool = ThreadPoolExecutor(self.parallel)
        futures = [pool.submit(self._run_one, job, watch) for job in jobs]
        try:
            return [future.result() for future in futures]
        except BaseException:
            self._stop()
            raise
        finally:
            pool.shutdown(cancel_futures=True)

    def _stop(self) -> None:
        with self._lock:
            self._is_stopped = True
        for number in (signal.SIGTERM, signal.SIGKILL):
            with self._lock:
                for process in self._processes.values():
                    with contextlib.suppress(ProcessLookupError):
                        os.killpg(process.pid, number)
            end = time.monotonic() + 10.0
            while self._processes and time.monotonic() < end:
                time.sleep(0.05)

    def _run_one(self, job: Job, watch: Watcher) -> Outcome:
        outcome = Outcome(job, was_there=True)
        if not is_finished(job, self.commit):
            with self._lock:
                if self._is_stopped:
                    return Outcome(job, "not begun")
                watch.started(job)
            start = time.monotonic()
            try:
                error = self._make(job)
            except OSError as problem:
                error = f"cannot be run: {problem}"
            outcome = Outcome(job, error, seconds=time.monotonic() - start)
        with self._lock:
            if not self._is_stopped:
                watch.ended(outcome)
        return outcome

    def _make(self, job: Job) -> str:
        """Runs it; what went wrong, or nothing."""
        goes_on = can_go_on(job, self._commit_of_program)
        cpu_seconds = float(read_json(job.results / RECORD).get("cpu_seconds", 0.0)) if goes_on else 0.0
        if not goes_on:
            shutil.rmtree(job.results, ignore_errors=True)
        job.results.mkdir(parents=True, exist_ok=True)
        record: dict[str, Any] = {"fingerprint": job.fingerprint(), "settings": dict(job.variant.settings)}
        _write_record(job, record)
        log = job.results / "log.txt"
        code, record["cpu_seconds"] = self._execute(self._command(job) + (["--restart", "auto"] if goes_on else []), log)
        record["cpu_seconds"] += cpu_seconds
        error = ""
        if code != 0:
            error = f"ended with exit code {code}: {last_words(log.read_text(encoding='utf-8', errors='replace'))} ({log})"
        elif read_json(job.results / "run.json").get("status") != "completed":
            error = f"ended, but {job.results / 'run.json'} does not say that it is completed"
        if error and not self._is_stopped:
            record["error"] = error
        _write_record(job, record)
        return error

    def _command(self, job: Job) -> list[str]:
        launcher = ["mpirun", "-n", str(self.ranks)] if self.ranks > 1 else []
        return [*launcher, str(self.program.resolve()), str(job.study.case_file), *job.variant.arguments,
                "--output", str(job.results), "--quiet"]

    def _execute(self, command: Sequence[str], log: Path) -> tuple[int, float]:
        """The exit code and the CPU seconds of the command and all that it started."""
        with log.open("wb") as stream, self._lock:
            if self._is_stopped:
                return 1, 0.0
            # A group of its own: an interruption from the keyboard reaches this script alone, which then ends the run.
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=stream, stderr=subprocess.STDOUT,
                                       env=mpi_environment(), start_new_session=True)
            self._processes[process.pid] = process
        _, status, usage = os.wait4(process.pid, 0)
        with self._lock:
            process.returncode = os.waitstatus_to_exitcode(status)
            del self._processes[process.pid]
        return process.returncode, usage.ru_utime + usage.ru_stime


def _write_record(job: Job, record: dict[str, Any]) -> None:
    (job.results / RECORD).write_text(json.dumps(record, indent=1), encoding="utf-8")


if __name__ == "__main__":
    sys.exit("this is a module; the command is cases/compare.py")
