"""Disks that return errors or lose what is written: what is lost is told, what was good stays good, no rank hangs, and
going on from there ends as if nothing had happened.
"""

from __future__ import annotations

import signal
import time
import unittest

from disk_test import DiskTest  # also finds the modules in tests/support
from running_program import AT_ONCE, DONE, NO_OUTPUT, checkpoints, preloaded, results, state_hash, tell

# Bytes that reach the disk before it fails: the file has its outline and lacks its values.
AFTER = 20_000


def failing(file: str, mode: str, after: int = 0) -> tuple[str, ...]:
    return AT_ONCE + preloaded("SPHDROP_FAILING_DISK", FAILING_FILE=file, FAILING_MODE=mode, FAILING_RANK=0,
                               FAILING_AFTER=after)


class Failing(DiskTest):
    def test_a_periodic_checkpoint_that_fails_is_told_and_the_run_goes_on(self) -> None:
        for mode, ranks in (("transient", 1), ("transient", 3), ("silent", 2), ("lost", 3)):
            with self.subTest(mode=mode, ranks=ranks):
                self.setUp()
                first, second = self.names[:2]
                options = failing(f"{second}.part", mode, AFTER)
                start = time.monotonic()
                result = self.run_here(ranks=ranks, options=options)
                tell(f"{mode} failure at a checkpoint, {ranks} ranks", "warns and goes on to the same bytes",
                     result.returncode, start)
                self.assertEqual(state_hash(result), self.whole_hash)
                self.assert_tells(0, result.stderr, f"warning: the checkpoint out/{second} could not be written",
                                  f"; the run goes on, its last checkpoint is out/{first}", expected=DONE)
                self.assert_same_results(results(self.output), self.whole)

    def test_a_failing_disk_does_not_cost_the_checkpoints_before(self) -> None:
        """Where not even HDF5 can close a file any more, all that is left is to end all ranks at once."""
        checkpoint, snapshot = f"{self.names[3]}.part", "snapshot_000002.vtkhdf.part"
        for file, after in ((checkpoint, 0), (checkpoint, AFTER), (checkpoint, 2 * AFTER), (snapshot, 0),
                            (snapshot, 2 * AFTER)):
            with self.subTest(file=file, after=after):
                self.setUp()
                start = time.monotonic()
                result = self.run_here(ranks=3, code=None, options=failing(file, "error", after))
                tell(f"errors for good after {after} bytes of {file.removesuffix('.part')}",
                     "warns and goes on" if result.returncode == DONE else
                     "tells it and ends; goes on from a checkpoint to the same bytes", result.returncode, start)
                may_go_on = file == checkpoint and "stopping." not in result.stderr
                self.assert_tells(result.returncode, result.stderr, expected=DONE if may_go_on else NO_OUTPUT)
                self.assertIn(f"out/{file.removesuffix('.part')}", result.stderr)
                self.assertEqual((self.output / file).exists(), "stopping." in result.stderr)
                self.assertFalse(not may_go_on and (self.output / file.removesuffix(".part")).exists())
                self.assertGreaterEqual(len(checkpoints(self.output)), 1)
                self.assert_goes_on_to_the_same_end()

    def test_the_checkpoint_at_the_end(self) -> None:
        last = self.names[-1]
        options = failing(f"{last}.part", "transient", AFTER)
        result = self.run_here("--set", "checkpoint.interval=7e-6", ranks=2, options=options)
        self.assert_tells(0, result.stderr, f"warning: the checkpoint out/{last} could not be written", expected=DONE)
        self.assertEqual(state_hash(result), self.whole_hash)
        self.assertFalse((self.output / last).exists())
        self.assert_goes_on_to_the_same_end("--set", "checkpoint.interval=7e-6")
        self.assertTrue((self.output / last).exists())

    def test_the_checkpoint_of_a_run_that_is_asked_to_stop(self) -> None:
        options = AT_ONCE + preloaded(
            "SPHDROP_FAILING_DISK SPHDROP_INTERRUPTED_CALLS", FAILING_FILE=".h5.part", FAILING_MODE="transient", FAILING_RANK=0,
            FAILING_AFTER=0, INTERRUPT_CALL="rename", INTERRUPT_FILE="snapshot_000001.vtkhdf.part", INTERRUPT_NUMBER=0,
            INTERRUPT_RANK=0, INTERRUPT_SIGNAL=int(signal.SIGUSR1))
        result = self.run_here("--set", "checkpoint.interval=0", ranks=3, code=NO_OUTPUT, options=options)
        self.assert_tells(result.returncode, result.stderr, "sphdrop: the checkpoint ", "could not be written")
        self.assertEqual(checkpoints(self.output), [])

    def test_the_history_and_the_snapshots(self) -> None:
        for file, mode, words in (
            ("history.csv", "error", "sphdrop: rows of the history are lost: out/history.csv: write: Input/output error"),
            ("snapshot_000003.vtkhdf.part", "transient",
             "sphdrop: the snapshot out/snapshot_000003.vtkhdf could not be written"),
            ("snapshots.vtkhdf.series.part", "transient", "snapshots.vtkhdf.series.part: write: Input/output error"),
        ):
            with self.subTest(file=file):
                self.setUp()
                # The history fails once it is under way.
                after = 4000 if file == "history.csv" else 0
                result = self.run_here(ranks=3, code=NO_OUTPUT, options=failing(file, mode, after))
                self.assert_tells(result.returncode, result.stderr, words)
                if checkpoints(self.output):
                    self.assert_goes_on_to_the_same_end()
                else:
                    self.assertEqual(state_hash(self.run_here("--restart", "auto", ranks=2)), self.whole_hash)

    def test_the_record_of_the_run(self) -> None:
        result = self.run_here(ranks=3, code=NO_OUTPUT, options=failing("run.json.part", "transient", after=1000))
        self.assert_tells(result.returncode, result.stderr, "run.json.part: write: Input/output error")
        self.assertEqual(state_hash(self.run_here("--restart", "auto", ranks=2)), self.whole_hash)


if __name__ == "__main__":
    unittest.main()
