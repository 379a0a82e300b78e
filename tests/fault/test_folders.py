"""Folders that vanish, that are read-only or that belong to another run."""

from __future__ import annotations

import os
import signal
import time
import unittest

from disk_test import LONGEST_END, DiskTest, held  # also finds the modules in tests/support
from background_run import BackgroundRun, send
from running_program import DONE, MISTAKE, checkpoints, hashes_in, results, state_hash, tell


class Folders(DiskTest):
    def start(self, *arguments: str, ranks: int) -> BackgroundRun:
        return BackgroundRun("little.cfg", "--quiet", *arguments, ranks=ranks, directory=self.directory, options=held())

    def test_one_that_is_removed_while_the_run_writes_into_it(self) -> None:
        with self.start(ranks=3) as running:
            rank = running.held_rank()
            self.output.rename(self.directory / "gone")
            start = time.monotonic()
            send(rank, signal.SIGCONT)
            code = running.end()
            running.seconds_until_gone(LONGEST_END)
            tell("the folder vanishes", "warns at the next checkpoint, tells and ends at the next snapshot", code, start)
            self.assert_tells(code, running.text(1), "warning: the checkpoint out/checkpoint_",
                              "sphdrop: the snapshot out/snapshot_000001.vtkhdf could not be written: ")
        self.assertFalse(self.output.exists())
        # It comes back, and the run with it.
        (self.directory / "gone").rename(self.output)
        self.assert_goes_on_to_the_same_end()

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_one_without_permission(self) -> None:
        self.output.mkdir()
        self.output.chmod(0o555)
        result = self.run_here(ranks=3, code=MISTAKE)
        self.assert_tells(result.returncode, result.stderr, "you have no permission to write there", expected=MISTAKE)

    def test_one_into_which_another_run_writes(self) -> None:
        with self.start(ranks=2) as first:
            rank = first.held_rank()
            for ranks, arguments in ((1, ["--fresh"]), (3, ["--restart", "auto"])):
                start = time.monotonic()
                result = self.run_here(*arguments, ranks=ranks, code=MISTAKE)
                tell(f"a second run into the folder, {' '.join(arguments)}", "refused; the first is not disturbed",
                     result.returncode, start)
                self.assert_tells(result.returncode, result.stderr, f"another run is writing into out (process {rank} on ",
                                  expected=MISTAKE)
            send(rank, signal.SIGCONT)
            self.assertEqual(first.end(), DONE, first.text(1))
            self.assertEqual(hashes_in(first.text(0)), [self.whole_hash])
        self.assert_same_results(results(self.output), self.whole)

        # The lock goes with its holder, however it went.
        with self.start("--fresh", ranks=2) as second:
            send(second.held_rank(), signal.SIGKILL)
            second.end()
            second.seconds_until_gone(LONGEST_END)
        self.assertEqual(len(checkpoints(self.output)), 1)
        result = self.run_here("--restart", "auto", ranks=3)
        self.assertEqual(state_hash(result), self.whole_hash)
        self.assert_same_results(results(self.output), self.whole)


if __name__ == "__main__":
    unittest.main()
