"""What the tests of disks and folders share: a run that was left alone, to compare with."""

from __future__ import annotations

import signal
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from running_program import (  # noqa: E402
    AT_ONCE,
    NO_OUTPUT,
    WARNING,
    ComparedTest,
    checkpoints,
    interrupted,
    results,
    state_hash,
)

LONGEST_END = 30.0  # s, from the fault until the last process is gone


def held(number: int | str = 1) -> tuple[str, ...]:
    """mpiexec's options with which rank 0 waits, stopped, before it writes the checkpoints of these numbers."""
    return AT_ONCE + interrupted("fsync", "history.csv", by=signal.SIGSTOP, number=number)


class DiskTest(ComparedTest):
    names: list[str]  # of all checkpoints that the run writes on its way

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.undisturbed.run_here("--output", "all", "--set", "checkpoint.keep=1000")
        cls.names = [path.name for path in checkpoints(cls.undisturbed.directory / "all")]

    def assert_goes_on_to_the_same_end(self, *arguments: str) -> None:
        result = self.run_here("--restart", "latest", *arguments, ranks=2)
        self.assertEqual(state_hash(result), self.whole_hash)
        self.assertNotRegex(result.stderr, WARNING)
        if not arguments:
            self.assert_same_results(results(self.output), self.whole)

    def assert_tells(self, code: int | None, stderr: str, *parts: str, expected: int = NO_OUTPUT) -> None:
        self.assertEqual(code, expected, stderr)
        for part in parts:
            self.assertEqual(stderr.count(part), 1, f"{part!r} is not said once in:\n{stderr}")
        self.assertNotIn("internal error", stderr)
