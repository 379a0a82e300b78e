"""Snapshots and checkpoints on a disk that fails: whatever it does, no rank hangs and no file holds half of what its
name says.

usage: test_failing_disk.py MPIEXEC WRITE_EXAMPLE_RUN WRITE_EXAMPLE_CHECKPOINTS FAILING_DISK_LIBRARY
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MPIEXEC, WRITE_RUN, WRITE_CHECKPOINTS, LIBRARY = sys.argv[1:5] if len(sys.argv) >= 5 else ("", "", "", "")


def run_on(program: str, directory: Path, ranks: int, settings: dict[str, str]) -> subprocess.CompletedProcess[str]:
    exported = [word for name in settings for word in ("-x", name)]
    # Where a rank returns anything but 0, mpiexec would wait for two seconds; the ranks end together in any case.
    at_once = ("--mca", "odls_base_sigkill_timeout", "0")
    return subprocess.run([MPIEXEC, "-n", str(ranks), *at_once, *exported, program, str(directory)], text=True,
                          capture_output=True, timeout=60, env=os.environ | settings)


class Snapshots(unittest.TestCase):
    def check(self, ranks: int, failing_rank: int, after: int, mode: str) -> None:
        settings = {"LD_PRELOAD": LIBRARY, "FAILING_FILE": ".vtkhdf.part", "FAILING_RANK": str(failing_rank),
                    "FAILING_AFTER": str(after), "FAILING_MODE": mode}
        with self.subTest(**settings, ranks=ranks), tempfile.TemporaryDirectory() as folder:
            directory = Path(folder)
            result = run_on(WRITE_RUN, directory, ranks, settings)
            self.assertNotEqual(result.returncode, 0, "the failure went unnoticed")
            self.assertNotEqual(result.returncode, 124)
            self.assertFalse((directory / "snapshot_000000.vtkhdf").exists(), result.stderr)
            self.assertFalse((directory / "snapshots.vtkhdf.series").exists())
            aborted = "stopping." in result.stderr
            if not aborted:
                for rank in range(ranks):
                    self.assertIn(f"rank {rank}: the snapshot", result.stderr)
                self.assertFalse((directory / "snapshot_000000.vtkhdf.part").exists())
            if mode != "error":
                self.assertFalse(aborted, result.stderr)

    def test_a_healthy_disk_is_fine(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            settings = {"LD_PRELOAD": LIBRARY, "FAILING_FILE": ".vtkhdf.part", "FAILING_RANK": "0",
                        "FAILING_AFTER": str(10**9), "FAILING_MODE": "error"}
            result = run_on(WRITE_RUN, Path(folder), 2, settings)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertTrue((Path(folder) / "snapshot_000002.vtkhdf").exists())

    def test_errors_while_writing(self) -> None:
        for ranks, failing_rank in ((1, 0), (2, 0), (3, 0), (4, 0)):
            for after in (0, 50_000):
                self.check(ranks, failing_rank, after, "error")

    def test_errors_that_pass_leave_the_run_able_to_go_on(self) -> None:
        for ranks in (1, 2, 3):
            self.check(ranks, 0, 50_000, "transient")

    def test_writes_that_are_lost_silently(self) -> None:
        for ranks, failing_rank in ((1, 0), (2, 0), (4, 0)):
            for after in (0, 50_000):
                self.check(ranks, failing_rank, after, "silent")


class Checkpoints(unittest.TestCase):
    """The example writes those of the steps 100, 200 and 300 and keeps two; the disk fails at 200."""

    sound: dict[str, bytes]

    @classmethod
    def setUpClass(cls) -> None:
        cls.sound = {}
        for failing, kept in (("200", ("100", "300")), ("300", ("100", "200"))):
            with tempfile.TemporaryDirectory() as folder:
                settings = {"LD_PRELOAD": LIBRARY, "FAILING_FILE": f"{failing}.h5.part", "FAILING_RANK": "0",
                            "FAILING_AFTER": "0", "FAILING_MODE": "transient"}
                result = run_on(WRITE_CHECKPOINTS, Path(folder), 1, settings)
                if result.returncode == 0:
                    raise AssertionError("the failure went unnoticed")
                for step in kept:
                    path = Path(folder) / f"checkpoint_000000000{step}.h5"
                    cls.sound[path.name] = path.read_bytes()

    def check(self, ranks: int, after: int, mode: str) -> subprocess.CompletedProcess[str]:
        settings = {"LD_PRELOAD": LIBRARY, "FAILING_FILE": "200.h5.part", "FAILING_RANK": "0",
                    "FAILING_AFTER": str(after), "FAILING_MODE": mode}
        with self.subTest(**settings, ranks=ranks), tempfile.TemporaryDirectory() as folder:
            result = run_on(WRITE_CHECKPOINTS, Path(folder), ranks, settings)
            files = {path.name: path.read_bytes() for path in Path(folder).iterdir()}
            for name, content in files.items():
                if not name.endswith(".part"):
                    self.assertEqual(content, self.sound[name], name)
            if result.returncode == 0:
                self.assertEqual(sorted(files), ["checkpoint_000000000200.h5", "checkpoint_000000000300.h5"])
            elif "stopping." in result.stderr:
                self.assertEqual(mode, "error", result.stderr)
                self.assertIn("checkpoint_000000000100.h5", files)
                self.assertNotIn("checkpoint_000000000200.h5", files)
            else:
                self.assertEqual(sorted(files), ["checkpoint_000000000100.h5", "checkpoint_000000000300.h5"])
                texts = {line for line in result.stderr.splitlines() if "could not be written" in line}
                self.assertEqual(len(texts), ranks, "each rank tells it once")
                self.assertEqual(len({text.split(": ", 1)[1] for text in texts}), 1, "with one text")
        return result

    def test_errors_while_writing(self) -> None:
        for ranks, after in ((1, 0), (1, 50_000), (2, 50_000), (3, 0), (4, 50_000)):
            self.assertNotEqual(self.check(ranks, after, "error").returncode, 0)

    def test_errors_that_pass_leave_the_run_able_to_go_on(self) -> None:
        for ranks in (1, 2, 3):
            self.assertNotEqual(self.check(ranks, 50_000, "transient").returncode, 0)

    def test_writes_that_are_lost_silently(self) -> None:
        for ranks, after in ((1, 0), (2, 50_000), (4, 0)):
            self.assertNotEqual(self.check(ranks, after, "silent").returncode, 0)

    def test_a_single_lost_write_of_values_is_found_by_comparing(self) -> None:
        for ranks in (1, 2, 4):
            self.assertIn("does not hold what was written", self.check(ranks, 40_000, "lost").stderr)

    def test_failures_around_the_last_writes(self) -> None:
        # The structure is written in whole pages, so that some bytes are written twice.
        size = len(self.sound["checkpoint_000000000200.h5"])
        failed = [self.check(1, size + beyond, "silent").returncode != 0 for beyond in (*range(0, 13_000, 1300), size)]
        self.assertTrue(failed[0])
        self.assertFalse(failed[-1], "more than everything was written")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
