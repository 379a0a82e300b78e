"""A run over two hosts: the same bits as on one; and what becomes of it when one of them is cut off."""

from __future__ import annotations

import json
import os
import time
import unittest
from pathlib import Path

import sandbox
from sandbox import FOLDER, call
from two_hosts import NAMES, TwoHosts

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["SPHDROP_PROGRAM"]
MPIEXEC = os.environ["SPHDROP_MPIEXEC"]
CASE = (ROOT / "cases" / "quickstart" / "case.cfg", "--set", "resolution.spacing=6.25e-5", "--until", "2e-4", "--quiet")
CHECKPOINTS = ("--set", "checkpoint.interval=1e-5")
# Keepalive's 9 s, and what mpirun and the daemon on the lost host take to end their ranks.
SECONDS_TO_END = 30.0

hosts: TwoHosts


def setUpModule() -> None:
    global hosts
    if os.environ.get("SPHDROP_LONG_TESTS") != "1":
        raise unittest.SkipTest("depends on how busy the machine is: set SPHDROP_LONG_TESTS=1 to run it")
    try:
        hosts = TwoHosts()
    except RuntimeError as error:
        raise unittest.SkipTest(str(error)) from error


def record(folder: Path) -> dict[str, object]:
    return dict(json.loads((folder / "run.json").read_text(encoding="utf-8")))


def on_one_host(folder: Path, *arguments: str) -> None:
    call("timeout", "-k", "5", "120", MPIEXEC, "-n", "2", PROGRAM, *CASE, "--output", folder, *arguments, timeout=140)


def running_ranks() -> list[int]:
    """Processes of the program, on any host; the sandbox has no others."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            if (entry / "exe").readlink() == Path(PROGRAM).resolve():
                found.append(int(entry.name))
        except OSError:
            continue
    return found


class Hosts(unittest.TestCase):
    alone = FOLDER / "alone"

    @classmethod
    def setUpClass(cls) -> None:
        on_one_host(cls.alone)

    def test_two_give_the_same_bits_as_one(self) -> None:
        results = FOLDER / "both"
        run = hosts.mpirun(2, PROGRAM, *CASE, "--output", results)
        said, _ = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 0, said)
        self.assertEqual(record(results)["ranks_by_host"], dict.fromkeys(NAMES, 2))
        self.assertEqual(record(results)["state_hash"], record(self.alone)["state_hash"])
        for name in ("history.csv", "snapshot_000002.vtkhdf"):
            self.assertEqual((results / name).read_bytes(), (self.alone / name).read_bytes(), name)

    def cut_off(self, name: str) -> None:
        results = FOLDER / f"without_{name}"
        run = hosts.mpirun(2, PROGRAM, *CASE, *CHECKPOINTS, "--output", results)
        end = time.monotonic() + 60
        while len(list(results.glob("checkpoint_*.h5"))) < 2:
            self.assertLess(time.monotonic(), end, "no checkpoints")
            time.sleep(0.01)
        hosts.cut_off(name)
        self.addCleanup(hosts.reconnect, name)
        start = time.monotonic()
        said, _ = run.communicate(timeout=120)
        seconds = time.monotonic() - start
        while running_ranks() and time.monotonic() - start < 120:
            time.sleep(0.1)
        seconds_of_ranks = time.monotonic() - start
        print(f"{name} cut off: mpirun ended with {run.returncode} after {seconds:.1f} s, the last rank after {seconds_of_ranks:.1f} s")
        self.assertNotEqual(run.returncode, 0, said)
        self.assertLess(max(seconds, seconds_of_ranks), SECONDS_TO_END, said)
        self.assertEqual(record(results)["status"], "running", "it was finished before the cut")
        on_one_host(results, *CHECKPOINTS, "--restart", "latest")
        self.assertIn("restarted_from", str(record(results)["details"]))
        self.assertEqual(record(results)["state_hash"], record(self.alone)["state_hash"])
        self.assertEqual((results / "history.csv").read_bytes(), (self.alone / "history.csv").read_bytes())

    def test_the_second_host_is_cut_off(self) -> None:
        self.cut_off("right")

    def test_the_first_host_is_cut_off(self) -> None:
        self.cut_off("left")


if __name__ == "__main__":
    sandbox.run_tests_inside(())
