"""Disks that others fill up while the run is under way, or on which nothing can be written from the start."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import time
import unittest
from pathlib import Path

from disk_test import LONGEST_END, DiskTest, held  # also finds the modules in tests/support
from background_run import BackgroundRun, send
from running_program import DONE, MISTAKE, WARNING, hashes_in, results, tell


@unittest.skipUnless(os.geteuid() == 0, "only root may mount a small disk")
class Full(DiskTest):
    def mount(self, size: str, *options: str) -> None:
        self.output.mkdir(exist_ok=True)
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", ",".join([f"size={size}", *options]), "tmpfs", self.output],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            self.skipTest(f"a small disk cannot be mounted: {done.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", "-l", self.output], check=False)

    @property
    def filler(self) -> Path:
        return self.output / "of_somebody_else"

    def fill(self, leave: int = 0) -> None:
        with self.filler.open("wb", buffering=0) as file:
            try:
                while True:
                    file.write(bytes(65536))
            except OSError:
                pass
            if leave > 0:
                file.truncate(max(0, self.filler.stat().st_size - leave))

    def run_into_full_disk(self, what: str, *arguments: str, leave: int) -> None:
        """Fills the disk, but for some bytes, after the first checkpoint."""
        self.mount("8m")
        with BackgroundRun("little.cfg", "--quiet", *arguments, ranks=3, directory=self.directory, options=held()) as running:
            rank = running.held_rank()
            self.fill(leave)
            start = time.monotonic()
            send(rank, signal.SIGCONT)
            self.code = running.end()
            running.seconds_until_gone(LONGEST_END)
            self.text = running.text(1)
        tell(f"disk full at {what}", "tells it and ends; with room again it goes on to the same bytes", self.code, start)
        self.filler.unlink()

    def test_checkpoints(self) -> None:
        """Three of them find no place; then there is room again."""
        self.mount("8m")
        arguments = ("little.cfg", "--quiet", "--set", "output.snapshot_interval=0")
        with BackgroundRun(*arguments, ranks=3, directory=self.directory, options=held("1,4")) as running:
            rank = running.held_rank()
            self.fill(leave=100_000)
            start = time.monotonic()
            send(rank, signal.SIGCONT)
            running.wait_for(lambda: running.text(1).count("No space left on device") == 3, "three warnings")
            self.assertEqual(running.held_rank(), rank)
            self.filler.unlink()
            send(rank, signal.SIGCONT)
            self.assertEqual(running.end(), DONE, running.text(1))
            tell("disk full at a checkpoint", "warns, goes on, writes the next ones when there is room again", DONE, start)
            [found_hash] = hashes_in(running.text(0))
            text = running.text(1)
        self.assertEqual(found_hash, self.whole_hash)
        first, *others = self.names
        for name in others[:3]:
            self.assertRegex(text, rf"warning: the checkpoint out/{name} could not be written: .*No space left on device")
        self.assertEqual(text.count(f"; the run goes on, its last checkpoint is out/{first}"), 3)
        self.assertEqual(len(re.findall(WARNING, text)), 3)
        found = results(self.output)
        self.run_here("--set", "output.snapshot_interval=0", "--output", "again")
        expected = results(self.directory / "again")
        del found["case.cfg"], expected["case.cfg"]
        self.assert_same_results(found, expected)

    def test_a_snapshot(self) -> None:
        self.run_into_full_disk("a snapshot", "--set", "checkpoint.interval=7e-6", leave=100_000)
        self.assert_tells(self.code, self.text, "sphdrop: the snapshot out/snapshot_00000")
        self.assertIn("No space left on device", self.text)
        self.assert_goes_on_to_the_same_end()

    def test_the_history(self) -> None:
        finely = ("--set", "output.snapshot_interval=0", "--set", "output.history_interval=1e-7")
        self.run_into_full_disk("a row of the history", *finely, leave=0)
        self.assert_tells(self.code, self.text,
                          "sphdrop: rows of the history are lost: out/history.csv: write: No space left on device")
        self.assert_goes_on_to_the_same_end(*finely)

    def test_a_full_disk_at_the_start(self) -> None:
        self.mount("1m")
        self.fill()
        start = time.monotonic()
        result = self.run_here(ranks=2, code=MISTAKE)
        tell("disk full at the start", "refused", result.returncode, start)
        self.assert_tells(result.returncode, result.stderr, "the disk is full; make room", expected=MISTAKE)

    def test_a_disk_that_is_read_only(self) -> None:
        self.mount("1m", "ro")
        start = time.monotonic()
        result = self.run_here(ranks=2, code=MISTAKE)
        tell("disk mounted read-only", "refused", result.returncode, start)
        self.assert_tells(result.returncode, result.stderr, "the file system is mounted read-only", expected=MISTAKE)


if __name__ == "__main__":
    unittest.main()
