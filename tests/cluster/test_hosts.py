"""A run over two hosts: the same bits as on one; and what becomes of it when one of them is cut off."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import time
import unittest
from pathlib import Path

import sandbox
from sandbox import FOLDER, call
from two_hosts import NAMES, TwoHosts

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["SPHDROP_PROGRAM"]
MPIEXEC = os.environ["SPHDROP_MPIEXEC"]
# Some 700 steps to 2e-5 s. Each takes several messages by TCP, and where other programs want the processors too, a rank that
# waits for one may wait for their time slice: hundredths of a second a step.
CASE = (ROOT / "cases" / "quickstart" / "case.cfg", "--quiet", "--set", "resolution.spacing=6.25e-5",
        "--set", "output.snapshot_interval=1e-5", "--set", "output.history_interval=1e-6")
SHORT = ("--until", "2e-5")
LONGER = ("--until", "1e-4", "--set", "checkpoint.interval=5e-6")
LONGEST = 400.0  # s
# Keepalive's 9 s, and what mpirun and the daemon on the lost host take to end their ranks.
SECONDS_TO_START = 30
SECONDS_TO_END = 30.0

hosts: TwoHosts


def setUpModule() -> None:
    global hosts
    try:
        hosts = TwoHosts()
    except RuntimeError as error:
        raise unittest.SkipTest(str(error)) from error


def record(folder: Path) -> dict[str, object]:
    return dict(json.loads((folder / "run.json").read_text(encoding="utf-8")))


def on_one_host(folder: Path, *arguments: str) -> None:
    """By one rank, which waits for nobody."""
    call(MPIEXEC, "-n", "1", PROGRAM, *CASE, "--output", folder, *arguments, timeout=LONGEST)


def progress(folder: Path) -> str:
    """The last row of the history."""
    history = folder / "history.csv"
    return history.read_text(encoding="utf-8").splitlines()[-1][:60] if history.exists() else "no history yet"


def end_of(run: subprocess.Popen[str], folder: Path) -> str:
    """What a run says until it ends."""
    try:
        return run.communicate(timeout=LONGEST)[0]
    except subprocess.TimeoutExpired:
        before = progress(folder)
        time.sleep(10)
        after = progress(folder)
        run.kill()
        raise AssertionError(f"not ended after {LONGEST} s; in ten seconds more it went from\n{before}\nto\n{after}") from None


def running(program: Path) -> list[int]:
    """Processes of a program, on any host; the sandbox has no others."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            if (entry / "exe").readlink() == program.resolve():
                found.append(int(entry.name))
        except OSError:
            continue
    return found


def started(results: Path, *arguments: str) -> subprocess.Popen[str]:
    """A run on both hosts whose ranks are there. Open MPI's daemon on the second host sometimes ends at once and in silence,
    and mpirun waits for it for ever: then it is started again, up to four times."""
    for attempt in range(5):
        run = hosts.mpirun(2, PROGRAM, *CASE, *arguments, "--output", results)
        end = time.monotonic() + SECONDS_TO_START
        while run.poll() is None and not (results / "run.json").exists() and time.monotonic() < end:
            time.sleep(0.05)
        if run.poll() is not None or (results / "run.json").exists():
            return run
        print(f"attempt {attempt + 1}: no rank after {SECONDS_TO_START} s: mpirun is started again", flush=True)
        run.kill()
        run.communicate()
        if running(Path(PROGRAM)):
            raise AssertionError("ranks without results: the program hangs, not its start")
    raise AssertionError("mpirun starts no ranks")


class Hosts(unittest.TestCase):
    def test_both_give_the_same_bits_as_one(self) -> None:
        alone, both = FOLDER / "alone", FOLDER / "both"
        on_one_host(alone, *SHORT)
        run = started(both, *SHORT)
        said = end_of(run, both)
        self.assertEqual(run.returncode, 0, said)
        self.assertEqual(record(both)["ranks_by_host"], dict.fromkeys(NAMES, 2))
        self.assertEqual(record(both)["state_hash"], record(alone)["state_hash"])
        for name in ("history.csv", "snapshot_000002.vtkhdf"):
            self.assertEqual((both / name).read_bytes(), (alone / name).read_bytes(), name)

    def cut_off(self, name: str) -> None:
        alone, results = FOLDER / f"with_{name}", FOLDER / f"without_{name}"
        on_one_host(alone, *LONGER)
        run = started(results, *LONGER)
        end = time.monotonic() + LONGEST
        while len(list(results.glob("checkpoint_*.h5"))) < 2:
            self.assertLess(time.monotonic(), end, f"no checkpoints; {progress(results)}")
            self.assertIsNone(run.poll(), "it has ended")
            time.sleep(0.01)
        hosts.cut_off(name)
        self.addCleanup(hosts.reconnect, name)
        start = time.monotonic()
        said = end_of(run, results)
        seconds = time.monotonic() - start
        while running(Path(PROGRAM)) and time.monotonic() - start < LONGEST:
            time.sleep(0.1)
        seconds_of_ranks = time.monotonic() - start
        print(f"{name} cut off: mpirun ended with {run.returncode} after {seconds:.1f} s, "
              f"the last rank after {seconds_of_ranks:.1f} s")
        self.assertNotEqual(run.returncode, 0, said)
        self.assertLess(max(seconds, seconds_of_ranks), SECONDS_TO_END, said)
        self.assertEqual(record(results)["status"], "running", "it was finished before the cut")
        daemon = Path(shutil.which("orted") or "orted")
        while running(daemon):  # their ends are not timed, but the next run is to find nothing of them
            self.assertLess(time.monotonic() - start, LONGEST, "the daemon of the host that was cut off does not end")
            time.sleep(0.1)
        on_one_host(results, *LONGER, "--restart", "latest")
        self.assertIn("restarted_from", str(record(results)["details"]))
        self.assertEqual(record(results)["state_hash"], record(alone)["state_hash"])
        self.assertEqual((results / "history.csv").read_bytes(), (alone / "history.csv").read_bytes())

    def test_the_second_host_is_cut_off(self) -> None:
        self.cut_off("right")

    def test_the_first_host_is_cut_off(self) -> None:
        self.cut_off("left")


if __name__ == "__main__":
    sandbox.run_tests_inside(())
