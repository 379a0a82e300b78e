"""Starts the program as users do, stops it and compares what it leaves: for the tests of restarts and of faults."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from typing import IO

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "io"))

PROGRAM = os.environ["SPHDROP_PROGRAM"]
MPIEXEC = os.environ["SPHDROP_MPIEXEC"]

DONE, MISTAKE, UNSAFE, NO_OUTPUT, INTERRUPTED = 0, 2, 3, 4, 5

# A drop that touches the beam soon. The name of the results' folder is in every checkpoint, so it is the same always.
CASE = """
name = "little"
[resolution]
spacing = 0.0625e-3
[time]
end = 40e-6
sound_cfl = 0.2
[drop]
diameter = 0.6e-3
velocity = [0.2, -3.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
[output]
directory = "out"
snapshot_interval = 8e-6
history_interval = 1e-6
[checkpoint]
interval = 4e-6
"""

# Where a rank returns anything but 0, mpiexec ends two seconds after the last rank; with this it does not wait.
AT_ONCE = ("--mca", "odls_base_sigkill_timeout", "0")

# Of one run after another, not of the results.
PASSING = {"run.json", "run.lock"}


def command_line(*arguments: str | Path, ranks: int = 1, options: tuple[str, ...] = ()) -> list[str]:
    return [MPIEXEC, "-n", str(ranks), *options, PROGRAM, *map(str, arguments)]


def run(*arguments: str | Path, ranks: int = 1, directory: Path | None = None, options: tuple[str, ...] = (),
        seconds: float = 60) -> subprocess.CompletedProcess[str]:
    """The program's whole life; it ends with 124 or 137 if it takes longer."""
    command = ["timeout", "-k", "5", str(seconds), *command_line(*arguments, ranks=ranks, options=options)]
    return subprocess.run(command, capture_output=True, text=True, cwd=directory, check=False)


def hashes_in(output: str) -> list[str]:
    return re.findall(r"^state hash ([0-9a-f]{16})$", output, flags=re.MULTILINE)


def results(directory: Path) -> dict[str, bytes]:
    """Every file in a folder of results but those that say how the run came about."""
    return {path.name: path.read_bytes() for path in directory.iterdir() if path.name not in PASSING}


def checkpoints(directory: Path) -> list[Path]:
    """Oldest first."""
    return sorted(directory.glob("checkpoint_*.h5"))


def step_of(checkpoint: Path) -> int:
    return int(checkpoint.stem.removeprefix("checkpoint_"))


def environment_of(pid: int) -> dict[str, str]:
    """What a process was started with; empty if it is gone."""
    try:
        words = Path(f"/proc/{pid}/environ").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        return {}
    return dict(word.split("=", 1) for word in words if "=" in word)


def is_alive(pid: int) -> bool:
    """A process that has ended and is only not yet waited for counts as gone."""
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()[0] not in "ZX"
    except OSError:
        return False


class Running:
    """The program under mpiexec, in the background. Leaving the context ends whatever is left of it."""

    MARK = "SPHDROP_TEST_RUN"

    def __init__(self, *arguments: str | Path, ranks: int, directory: Path, options: tuple[str, ...] = ()) -> None:
        self._files: list[IO[str]] = [tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") for _ in range(2)]
        self.mark = f"{os.getpid()}.{time.monotonic_ns()}"
        self.hung = False  # mpiexec, in its own end
        self.process = subprocess.Popen(
            command_line(*arguments, ranks=ranks, options=options), cwd=directory, stdout=self._files[0],
            stderr=self._files[1], stdin=subprocess.DEVNULL, start_new_session=True,
            env=os.environ | {self.MARK: self.mark})

    def __enter__(self) -> Running:
        return self

    def __exit__(self, *_: object) -> None:
        for pid in self.processes():
            send(pid, signal.SIGKILL)
        self.process.wait()
        for file in self._files:
            file.close()

    def processes(self) -> list[int]:
        """mpiexec and all that came of it and lives."""
        pids = [int(path.name) for path in Path("/proc").iterdir() if path.name.isdigit()]
        return [pid for pid in pids if environment_of(pid).get(self.MARK) == self.mark and is_alive(pid)]

    def rank(self, number: int) -> int:
        """The process of a rank; waits until it has been started."""
        return self.wait_for(lambda: next((pid for pid in self.processes() if environment_of(pid).get(
            "OMPI_COMM_WORLD_RANK") == str(number)), None), f"rank {number}")

    def wait_for(self, condition, what: str, seconds: float = 30):  # type: ignore[no-untyped-def]
        """The condition's value once there is one."""
        limit = time.monotonic() + seconds
        while True:
            value = condition()
            if value:
                return value
            if self.process.poll() is not None:
                raise AssertionError(f"the run has ended with {self.process.returncode} before {what}:\n{self.text(1)}")
            if time.monotonic() > limit:
                raise AssertionError(f"{what} is not there after {seconds} s:\n{self.text(1)}")
            time.sleep(0.005)

    def text(self, stream: int) -> str:
        """Of standard output (0) or standard error (1) so far."""
        self._files[stream].seek(0)
        return self._files[stream].read()

    def end(self, seconds: float = 60) -> int:
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
                who = [environment_of(pid).get("OMPI_COMM_WORLD_RANK", "mpiexec") for pid in left]
                raise AssertionError(f"{', '.join(who)} left after {limit} s:\n{self.text(1)}")
            time.sleep(0.02)


def send(pid: int, number: int) -> None:
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


class ProgramTest(unittest.TestCase):
    """A folder with little.cfg for each test; results go to its folder out."""

    case_text = CASE

    def setUp(self) -> None:
        self.directory = self.folder()
        self.output = self.directory / "out"

    def folder(self) -> Path:
        directory = Path(tempfile.mkdtemp(prefix="sphdrop-"))
        self.addCleanup(shutil.rmtree, directory, ignore_errors=True)
        (directory / "little.cfg").write_text(self.case_text, encoding="utf-8")
        return directory

    def run_here(self, *arguments: str | Path, ranks: int = 1, code: int | None = DONE,
                 options: tuple[str, ...] = ()) -> subprocess.CompletedProcess[str]:
        if code == MISTAKE:
            options = (*options, *AT_ONCE)
        result = run("little.cfg", "--quiet", *arguments, ranks=ranks, directory=self.directory, options=options)
        if code is not None:
            self.assertEqual(result.returncode, code, f"{arguments}\n{result.stdout}\n{result.stderr}")
        return result

    def start_here(self, *arguments: str | Path, ranks: int, options: tuple[str, ...] = ()) -> Running:
        return Running("little.cfg", "--quiet", *arguments, ranks=ranks, directory=self.directory, options=options)

    def assert_said_once(self, result: subprocess.CompletedProcess[str], *parts: str) -> None:
        for part in parts:
            self.assertEqual(result.stderr.count(part), 1, f"{part!r} is not said once in:\n{result.stderr}")

    def assert_same_results(self, found: dict[str, bytes], expected: dict[str, bytes], what: str = "") -> None:
        self.assertEqual(sorted(found), sorted(expected), what)
        for name, content in expected.items():
            self.assertTrue(found[name] == content, f"{what}: {name} is another")
