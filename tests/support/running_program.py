"""Starts the program as users do and compares what it leaves: for the tests of the program, of restarts and of faults."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "io"))

PROGRAM = os.environ.get("SPHDROP_PROGRAM", str(ROOT / "build" / "release" / "src" / "sphdrop"))
MPIEXEC = os.environ.get("SPHDROP_MPIEXEC", "mpiexec")
LONG = os.environ.get("SPHDROP_LONG_TESTS") == "1"

DONE, MISTAKE, UNSAFE, NO_OUTPUT, INTERRUPTED = 0, 2, 3, 4, 5

# Where a rank returns anything but 0, mpiexec ends two seconds after the last rank; with this it does not wait.
AT_ONCE = ("--mca", "odls_base_sigkill_timeout", "0")

# Of one run after another, not of the results.
PASSING = {"run.json", "run.lock"}


def little_case(end: float = 40e-6, snapshot_interval: float = 8e-6, checkpoint_interval: float = 4e-6) -> str:
    """A drop that touches the beam soon, in steps of 30 ns."""
    return f"""
name = "little"
[resolution]
spacing = 0.0625e-3
[time]
end = {end:g}
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
snapshot_interval = {snapshot_interval:g}
history_interval = 1e-6
[checkpoint]
interval = {checkpoint_interval:g}
"""


def command_line(*arguments: str | Path | float, ranks: int = 1, options: tuple[str, ...] = ()) -> list[str]:
    return [MPIEXEC, "-n", str(ranks), *options, PROGRAM, *map(str, arguments)]


def run(*arguments: str | Path | float, ranks: int = 1, directory: Path | None = None, options: tuple[str, ...] = (),
        seconds: float = 120) -> subprocess.CompletedProcess[str]:
    """The program's whole life; it ends with 124 or 137 if it takes longer."""
    command = ["timeout", "-k", "5", str(seconds), *command_line(*arguments, ranks=ranks, options=options)]
    return subprocess.run(command, capture_output=True, text=True, cwd=directory, check=False)


def preloaded(libraries: str, **settings: str | int) -> tuple[str, ...]:
    """mpiexec's options that make the ranks use the libraries that environment variables name, with these settings."""
    words = {"LD_PRELOAD": ":".join(os.environ[library] for library in libraries.split()), **settings}
    return tuple(word for name, value in words.items() for word in ("-x", f"{name}={value}"))


def interrupted(call: str, file: str = "", *, by: int, number: int | str = 0, rank: int = 0, wait: int = 0) -> tuple[str, ...]:
    """mpiexec's options that make a rank send itself a signal, and then wait so many s at most for another that it handles
    (tests/fault/interrupted_calls.cpp)."""
    return preloaded("SPHDROP_INTERRUPTED_CALLS", INTERRUPT_CALL=call, INTERRUPT_FILE=file, INTERRUPT_SIGNAL=int(by),
                     INTERRUPT_NUMBER=number, INTERRUPT_RANK=rank, INTERRUPT_WAIT=wait)


# Of anything but the liquid's Mach number, which the cases here, short of time, heed little.
WARNING = r"warning: (?!step )"


def hashes_in(output: str) -> list[str]:
    return re.findall(r"^state hash ([0-9a-f]{16})$", output, flags=re.MULTILINE)


def state_hash(result: subprocess.CompletedProcess[str]) -> str:
    found = hashes_in(result.stdout)
    if len(found) != 1:
        raise AssertionError(f"no single hash in:\n{result.stdout}\n{result.stderr}")
    return found[0]


def case_files() -> list[Path]:
    return sorted((ROOT / "cases").glob("*/case.cfg"))


def time_of_steps(steps: int, *case: str | Path) -> float:
    """How far so many steps go, s: by --check, which tells the step in ns."""
    result = run("--check", *case)
    found = re.search(r"^time step +([-+.e\d]+) ns", result.stdout, flags=re.MULTILINE)
    if found is None:
        raise AssertionError(f"--check {case} does not tell the time step:\n{result.stdout}{result.stderr}")
    return 1e-9 * float(found.group(1)) * steps


def results(directory: Path) -> dict[str, bytes]:
    """Every file in a folder of results but those that say how the run came about."""
    return {path.name: path.read_bytes() for path in directory.iterdir() if path.name not in PASSING}


def checkpoints(directory: Path) -> list[Path]:
    """Oldest first."""
    return sorted(directory.glob("checkpoint_*.h5"))


def step_of(checkpoint: Path) -> int:
    return int(checkpoint.stem.removeprefix("checkpoint_"))


def tell(fault: str, outcome: str, code: int | None, start: float) -> None:
    """A row of the tables in tests/fault/README.md; `start` by time.monotonic()."""
    print(f"| {fault} | {outcome} | {code} | {time.monotonic() - start:.1f} |", flush=True)


class ProgramTest(unittest.TestCase):
    """A folder with little.cfg for each test; results go to its folder out."""

    case_text = little_case()

    def setUp(self) -> None:
        """A new folder; also within a test that wants another one."""
        self.directory = Path(tempfile.mkdtemp(prefix="sphdrop-"))
        self.addCleanup(shutil.rmtree, self.directory, ignore_errors=True)
        self.output = self.directory / "out"
        self.case = self.directory / "little.cfg"
        self.case.write_text(self.case_text, encoding="utf-8")

    def run_here(self, *arguments: str | Path, ranks: int = 1, code: int | None = DONE,
                 options: tuple[str, ...] = ()) -> subprocess.CompletedProcess[str]:
        if code == MISTAKE:
            options = (*options, *AT_ONCE)
        result = run("little.cfg", "--quiet", *arguments, ranks=ranks, directory=self.directory, options=options)
        if code is not None:
            self.assertEqual(result.returncode, code, f"{arguments}\n{result.stdout}\n{result.stderr}")
        return result

    def assert_said_once(self, result: subprocess.CompletedProcess[str], *parts: str) -> None:
        for part in parts:
            self.assertEqual(result.stderr.count(part), 1, f"{part!r} is not said once in:\n{result.stderr}")

    def assert_same_results(self, found: dict[str, bytes], expected: dict[str, bytes], what: str = "") -> None:
        self.assertEqual(sorted(found), sorted(expected), what)
        for name, content in expected.items():
            self.assertTrue(found[name] == content, f"{what}: {name} is another")


class ComparedTest(ProgramTest):
    """With what a run leaves that was left alone, to compare with."""

    undisturbed: ProgramTest  # its folder
    whole_hash: str
    whole: dict[str, bytes]

    @classmethod
    def setUpClass(cls) -> None:
        cls.undisturbed = ProgramTest()
        cls.undisturbed.case_text = cls.case_text
        cls.addClassCleanup(cls.undisturbed.doCleanups)
        cls.undisturbed.setUp()
        cls.whole_hash = state_hash(cls.undisturbed.run_here())
        cls.whole = results(cls.undisturbed.output)
