"""The program in the background: to see how far it is, to stop it, to kill it and to see that nothing is left of it."""

from __future__ import annotations

import os
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import IO, TypeVar

from running_program import command_line

Value = TypeVar("Value")


def all_processes() -> set[int]:
    return {int(name) for name in os.listdir("/proc") if name.isdigit()}


def environment_of(pid: int) -> dict[str, str]:
    """What a process was started with; empty if it is gone."""
    try:
        words = Path(f"/proc/{pid}/environ").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        return {}
    return dict(word.split("=", 1) for word in words if "=" in word)


def rank_of(pid: int) -> str:
    """A rank's number; empty for mpiexec and for what is gone."""
    return environment_of(pid).get("OMPI_COMM_WORLD_RANK", "")


def state_of(pid: int) -> str:
    """As in proc(5): R, S, T (stopped)...; X for a process that is gone or that is only not yet waited for."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()[0]
    except OSError:
        return "X"
    return "X" if state == "Z" else state


def is_pending(pid: int, number: int) -> bool:
    """Whether a signal has come to a process that is stopped."""
    try:
        [mask] = [line.split()[1] for line in Path(f"/proc/{pid}/status").read_text(encoding="utf-8").splitlines()
                  if line.startswith("ShdPnd:")]
    except (OSError, ValueError):
        return False
    return bool(int(mask, 16) >> (number - 1) & 1)


def send(pid: int, number: int) -> None:
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


class BackgroundRun:
    """The program under mpiexec. Leaving the context ends whatever is left of it."""

    MARK = "SPHDROP_TEST_RUN"

    def __init__(self, *arguments: str | Path, ranks: int, directory: Path, options: tuple[str, ...] = ()) -> None:
        self._files: list[IO[str]] = [tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") for _ in range(2)]
        self.mark = f"{os.getpid()}.{time.monotonic_ns()}"
        self.hung = False  # mpiexec, in its own end
        self._others = all_processes()  # that do not belong to it, and never will
        self.process = subprocess.Popen(
            command_line(*arguments, ranks=ranks, options=options), cwd=directory, stdout=self._files[0],
            stderr=self._files[1], stdin=subprocess.DEVNULL, start_new_session=True,
            env=os.environ | {self.MARK: self.mark})

    def __enter__(self) -> BackgroundRun:
        return self

    def __exit__(self, *_: object) -> None:
        for pid in self.processes():
            send(pid, signal.SIGKILL)
        self.process.wait()
        for file in self._files:
            file.close()

    def processes(self) -> list[int]:
        """mpiexec and all that came of it and lives."""
        own = []
        for pid in all_processes() - self._others:
            environment = environment_of(pid)
            if environment.get(self.MARK) == self.mark:
                own.append(pid)
            elif environment:  # there is none for a moment while a process becomes another program
                self._others.add(pid)
        return sorted(pid for pid in own if state_of(pid) != "X")

    def rank(self, number: int) -> int:
        """The process of a rank; waits until it has been started."""
        return self.wait_for(lambda: next((pid for pid in self.processes() if rank_of(pid) == str(number)), None),
                             f"rank {number}")

    def held_rank(self, number: int = 0) -> int:
        """The process of a rank that stops itself (SIGSTOP) on its way; waits until it has."""
        pid = self.rank(number)
        self.wait_for(lambda: state_of(pid) == "T", f"rank {number}, stopped")
        return pid

    def wait_for(self, condition: Callable[[], Value | None], what: str, seconds: float = 60) -> Value:
        """The condition's value once there is one."""
        limit = time.monotonic() + seconds
        while not (value := condition()):
            if self.process.poll() is not None:
                raise AssertionError(f"the run has ended with {self.process.returncode} before {what}:\n{self.text(1)}")
            if time.monotonic() > limit:
                raise AssertionError(f"{what} is not there after {seconds} s:\n{self.text(1)}")
            time.sleep(0.01)
        return value

    def text(self, stream: int) -> str:
        """Of standard output (0) or standard error (1) so far."""
        self._files[stream].seek(0)
        return self._files[stream].read()

    def end(self, seconds: float = 120) -> int:
        """What mpiexec returns, negative if a signal ended it."""
        try:
            return self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"not ended after {seconds} s:\n{self.text(1)}") from None

    def seconds_until_gone(self, limit: float) -> float:
        """How long until no process of it is left. Fails after the limit.

        Of a rank that is killed while it introduces itself to mpiexec, PMIx 4.2 says UNREACHABLE and may then keep mpiexec
        in its own end for ever (a lock that no thread holds any more). With no rank left this one is forgiven and ended,
        and counted in `hung`.
        """
        start = time.monotonic()
        ranks_gone = 0.0
        while True:
            self.process.poll()
            left = self.processes()
            passed = time.monotonic() - start
            if not left:
                return passed
            if left != [self.process.pid]:
                ranks_gone = passed
            elif passed > limit and "PMIX ERROR: UNREACHABLE" in self.text(1):
                send(self.process.pid, signal.SIGKILL)
                self.hung = True
                return ranks_gone
            if passed > limit:
                who = [rank_of(pid) or "mpiexec" for pid in left]
                raise AssertionError(f"{', '.join(who)} left after {limit} s:\n{self.text(1)}")
            time.sleep(0.02)
