"""Disks that fail or fill, folders that are read-only, vanish or belong to another run: what is lost is told, what was
good stays good, no rank hangs, and going on from there ends as if nothing had happened.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import unittest
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from running_program import (  # noqa: E402
    AT_ONCE,
    CASE,
    DONE,
    MISTAKE,
    NO_OUTPUT,
    ProgramTest,
    Running,
    checkpoints,
    hashes_in,
    results,
    send,
)

LONGEST_END = 10.0  # s
# Bytes that reach the disk before it fails: the file has its outline and lacks its values.
AFTER = 20_000


def failing(file: str, mode: str, after: int = 0) -> tuple[str, ...]:
    settings = {"LD_PRELOAD": os.environ["SPHDROP_FAILING_DISK"], "FAILING_FILE": file, "FAILING_MODE": mode,
                "FAILING_RANK": 0, "FAILING_AFTER": after}
    return AT_ONCE + tuple(word for name, value in settings.items() for word in ("-x", f"{name}={value}"))


class DiskTest(ProgramTest):
    whole_hash: str
    whole: dict[str, bytes]
    names: list[str]  # of all checkpoints that the run writes on its way

    @classmethod
    def setUpClass(cls) -> None:
        maker = ProgramTest()
        cls.addClassCleanup(maker.doCleanups)
        maker.setUp()
        [cls.whole_hash] = hashes_in(maker.run_here().stdout)
        cls.whole = results(maker.output)
        maker.run_here("--output", "all", "--set", "checkpoint.keep=1000")
        cls.names = [path.name for path in checkpoints(maker.directory / "all")]

    def assert_goes_on_to_the_same_end(self, *arguments: str) -> None:
        result = self.run_here("--restart", "latest", *arguments, ranks=2)
        self.assertEqual(hashes_in(result.stdout), [self.whole_hash])
        self.assertNotIn("warning", result.stderr)
        if not arguments:
            self.assert_same_results(results(self.output), self.whole)

    def assert_tells(self, code: int | None, stderr: str, *parts: str, expected: int = NO_OUTPUT) -> None:
        self.assertEqual(code, expected, stderr)
        for part in parts:
            self.assertEqual(stderr.count(part), 1, f"{part!r} is not said once in:\n{stderr}")
        self.assertNotIn("internal error", stderr)


class Failing(DiskTest):
    def test_a_periodic_checkpoint_that_fails_is_told_and_the_run_goes_on(self) -> None:
        for mode, ranks in (("transient", 1), ("transient", 3), ("silent", 2), ("lost", 3)):
            with self.subTest(mode=mode, ranks=ranks):
                self.setUp()
                first, second = self.names[:2]
                options = failing(f"{second}.part", mode, AFTER)
                result = self.run_here(ranks=ranks, options=options)
                self.assertEqual(hashes_in(result.stdout), [self.whole_hash])
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
                result = self.run_here(ranks=3, code=None, options=failing(file, "error", after))
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
        self.assertEqual(hashes_in(result.stdout), [self.whole_hash])
        self.assertFalse((self.output / last).exists())
        self.assert_goes_on_to_the_same_end("--set", "checkpoint.interval=7e-6")
        self.assertTrue((self.output / last).exists())

    def test_the_checkpoint_of_a_run_that_is_asked_to_stop(self) -> None:
        self.case_text = CASE.replace("end = 40e-6", "end = 400e-6")
        self.setUp()
        with self.start_here("--set", "checkpoint.interval=0", ranks=3, options=failing(".h5.part", "transient")) as running:
            rank = running.rank(1)
            running.wait_for((self.output / "snapshot_000001.vtkhdf").exists, "a snapshot")
            send(rank, signal.SIGUSR1)
            self.assert_tells(running.end(30), running.text(1), "sphdrop: the checkpoint ", "could not be written")
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
                    self.assertEqual(hashes_in(self.run_here("--restart", "auto", ranks=2).stdout), [self.whole_hash])

    def test_the_record_of_the_run(self) -> None:
        result = self.run_here(ranks=3, code=NO_OUTPUT, options=failing("run.json.part", "transient", after=1000))
        self.assert_tells(result.returncode, result.stderr, "run.json.part: write: Input/output error")
        self.assertEqual(hashes_in(self.run_here("--restart", "auto", ranks=2).stdout), [self.whole_hash])


@unittest.skipUnless(os.geteuid() == 0, "only root may mount a small disk")
class Full(DiskTest):
    """The disk is filled up by others while the run is under way."""

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

    def run_into_full_disk(self, *arguments: str, leave: int, until: Callable[[Running], object]) -> tuple[int, str]:
        """Fills the disk at the first checkpoint, but for some bytes. `until` ends the wait for what is to happen then."""
        self.mount("8m")
        with self.start_here(*arguments, ranks=3, options=AT_ONCE) as running:
            running.wait_for(lambda: checkpoints(self.output), "a checkpoint")
            self.fill(leave)
            until(running)
            code = running.end(30)
            running.seconds_until_gone(LONGEST_END)
            return code, running.text(1)

    LONG = ("--set", "time.end=400e-6", "--set", "output.history_interval=2e-7")

    def test_a_checkpoint(self) -> None:
        def make_room(running: Running) -> None:
            running.wait_for(lambda: "No space left on device" in running.text(1), "a warning")
            self.filler.unlink()

        code, text = self.run_into_full_disk(*self.LONG, "--set", "output.snapshot_interval=0", leave=100_000, until=make_room)
        self.assertEqual(code, DONE, text)
        self.assertRegex(text, r"warning: the checkpoint out/checkpoint_\d+.h5 could not be written: .*No space left on device")
        self.assertIn("; the run goes on, its last checkpoint is out/checkpoint_", text)
        found = results(self.output)
        shutil.rmtree(self.directory / "again", ignore_errors=True)
        self.run_here(*self.LONG, "--set", "output.snapshot_interval=0", "--output", "again", ranks=1)
        expected = results(self.directory / "again")
        for name in expected:
            if name != "case.cfg":
                self.assertTrue(found[name] == expected[name], name)

    def test_a_snapshot(self) -> None:
        code, text = self.run_into_full_disk("--set", "checkpoint.interval=8e-6", leave=100_000, until=lambda running: None)
        self.assert_tells(code, text, "sphdrop: the snapshot out/snapshot_00000")
        self.assertIn("No space left on device", text)
        self.filler.unlink()
        self.assert_goes_on_to_the_same_end()

    def test_the_history(self) -> None:
        code, text = self.run_into_full_disk(*self.LONG, "--set", "output.snapshot_interval=0", "--set",
                                             "checkpoint.interval=3e-5", leave=0, until=lambda running: None)
        self.assert_tells(code, text, "sphdrop: rows of the history are lost: out/history.csv: write: No space left on device")
        self.filler.unlink()
        self.assert_goes_on_to_the_same_end("--set", "time.end=40e-6", "--set", "output.history_interval=2e-7")

    def test_a_full_disk_at_the_start(self) -> None:
        self.mount("1m")
        self.fill()
        result = self.run_here(ranks=3, code=MISTAKE)
        self.assert_tells(result.returncode, result.stderr, "the disk is full; make room", expected=MISTAKE)

    def test_a_disk_that_is_read_only(self) -> None:
        self.mount("1m", "ro")
        result = self.run_here(ranks=3, code=MISTAKE)
        self.assert_tells(result.returncode, result.stderr, "the file system is mounted read-only", expected=MISTAKE)


class Folders(DiskTest):
    # Between the first checkpoint and what is written next there is time enough.
    case_text = (CASE.replace("end = 40e-6", "end = 400e-6").replace("snapshot_interval = 8e-6", "snapshot_interval = 100e-6")
                 .replace("interval = 4e-6", "interval = 40e-6"))

    def test_one_that_is_removed_while_the_run_writes_into_it(self) -> None:
        with self.start_here(ranks=3, options=AT_ONCE) as running:
            running.wait_for(lambda: checkpoints(self.output), "a checkpoint")
            self.output.rename(self.directory / "gone")
            code = running.end(30)
            running.seconds_until_gone(LONGEST_END)
            self.assertEqual(code, NO_OUTPUT, running.text(1))
            self.assertRegex(running.text(1), r"sphdrop: the snapshot out/snapshot_\d+.vtkhdf could not be written: ")
        self.assertFalse(self.output.exists())
        # It comes back, and the run with it.
        (self.directory / "gone").rename(self.output)
        self.run_here("--restart", "latest", ranks=2)

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_one_without_permission(self) -> None:
        self.output.mkdir()
        self.output.chmod(0o555)
        result = self.run_here(ranks=3, code=MISTAKE)
        self.assert_tells(result.returncode, result.stderr, "you have no permission to write there", expected=MISTAKE)

    def test_one_into_which_another_run_writes(self) -> None:
        with self.start_here(ranks=2) as first:
            rank = first.rank(0)
            first.wait_for(lambda: checkpoints(self.output), "a checkpoint")
            send(rank, signal.SIGSTOP)
            for ranks, arguments in ((1, ["--fresh"]), (3, ["--restart", "auto"])):
                result = self.run_here(*arguments, ranks=ranks, code=MISTAKE)
                self.assert_tells(result.returncode, result.stderr, f"another run is writing into out (process {rank} on ",
                                  expected=MISTAKE)
            send(rank, signal.SIGCONT)
            self.assertEqual(first.end(60), DONE, first.text(1))
            [expected] = hashes_in(first.text(0))
        whole = results(self.output)

        # The lock goes with its holder, however it went.
        with self.start_here("--fresh", ranks=2) as second:
            rank = second.rank(0)
            second.wait_for(lambda: "000" in "".join(path.name for path in checkpoints(self.output)), "a checkpoint")
            send(rank, signal.SIGKILL)
            second.end(30)
            second.seconds_until_gone(LONGEST_END)
        result = self.run_here("--restart", "auto", ranks=3)
        self.assertEqual(hashes_in(result.stdout), [expected])
        self.assert_same_results(results(self.output), whole)


if __name__ == "__main__":
    unittest.main()
