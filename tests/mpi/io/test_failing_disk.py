"""Snapshots on a disk that fails: whatever it does, no rank hangs and the file's own name never holds half a snapshot.

usage: test_failing_disk.py MPIEXEC WRITE_EXAMPLE_RUN FAILING_DISK_LIBRARY
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MPIEXEC, PROGRAM, LIBRARY = sys.argv[1:4] if len(sys.argv) >= 4 else ("", "", "")


class FailingDisk(unittest.TestCase):
    def run_on(self, directory: Path, ranks: int, settings: dict[str, str]) -> subprocess.CompletedProcess[str]:
        exported = [word for name in settings for word in ("-x", name)]
        return subprocess.run([MPIEXEC, "-n", str(ranks), *exported, PROGRAM, str(directory)], text=True,
                              capture_output=True, timeout=60, env=os.environ | settings)

    def check(self, ranks: int, failing_rank: int, after: int, mode: str) -> None:
        settings = {"LD_PRELOAD": LIBRARY, "FAILING_RANK": str(failing_rank), "FAILING_AFTER": str(after),
                    "FAILING_MODE": mode}
        with self.subTest(**settings, ranks=ranks), tempfile.TemporaryDirectory() as folder:
            directory = Path(folder)
            result = self.run_on(directory, ranks, settings)
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
            settings = {"LD_PRELOAD": LIBRARY, "FAILING_RANK": "0", "FAILING_AFTER": str(10**9), "FAILING_MODE": "error"}
            result = self.run_on(Path(folder), 2, settings)
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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
