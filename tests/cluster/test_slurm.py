"""The job scripts under a real Slurm: requeued until finished, swept, scaled, with the results of an uninterrupted run.

SPHDROP_LONG_TESTS=1 adds a run longer than Slurm's shortest time limit, a minute.
"""

from __future__ import annotations

import csv
import json
import os
import re
import subprocess
import time
import unittest
from collections.abc import Callable
from pathlib import Path

import sandbox
from private_slurm import TOOLS, PrivateSlurm, SlurmError
from sandbox import FOLDER, call

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["SPHDROP_PROGRAM"]
MPIEXEC = os.environ["SPHDROP_MPIEXEC"]
QUICKSTART = ROOT / "cases" / "quickstart" / "case.cfg"
COARSE = ("--set", "resolution.spacing=6.25e-5")
SHORT = ("--until", "6e-4")

slurm: PrivateSlurm


def setUpModule() -> None:
    global slurm
    try:
        slurm = PrivateSlurm(FOLDER / "slurm")
    except (SlurmError, RuntimeError) as error:
        raise unittest.SkipTest(str(error)) from error


def state_hash(folder: Path) -> str:
    return str(json.loads((folder / "run.json").read_text(encoding="utf-8"))["state_hash"])


def simulate(folder: Path, *arguments: str, case: Path = QUICKSTART) -> None:
    """A run outside Slurm, from beginning to end."""
    call("timeout", "-k", "5", "300", MPIEXEC, "-n", "2", PROGRAM, case, "--quiet", "--output", folder, *arguments, timeout=320)


def wait_until(reached: Callable[[], bool], timeout: float, explain: Callable[[], str]) -> None:
    end = time.monotonic() + timeout
    while not reached():
        if time.monotonic() > end:
            raise AssertionError(f"not after {timeout} s:\n{explain()}")
        time.sleep(0.02)


def wait_for_file(path: Path) -> None:
    wait_until(path.exists, 60, lambda: f"{path} is missing:\n{slurm.logs()}")


def submit(log: Path, *arguments: str | Path, **environment: str) -> str:
    variables = {**os.environ, "SPHDROP_PROGRAM": PROGRAM, **environment}
    return slurm.submit(f"--output={log}", *arguments, cwd=ROOT, env=variables)


class SlurmTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = FOLDER / self.id().rpartition(".")[2]
        self.folder.mkdir()

    def submit(self, *arguments: str | Path, **environment: str) -> str:
        return submit(self.folder / "log", *arguments, **environment)

    def log(self) -> str:
        return (self.folder / "log").read_text(encoding="utf-8")

    def expect_same_results(self, uninterrupted: Path, results: Path) -> None:
        self.assertEqual(state_hash(uninterrupted), state_hash(results), self.log())
        names = sorted(path.name for path in uninterrupted.iterdir() if path.suffix in (".csv", ".vtkhdf", ".series"))
        self.assertGreater(len(names), 5)
        for name in names:
            self.assertEqual((uninterrupted / name).read_bytes(), (results / name).read_bytes(), name)


class Requeueing(SlurmTest):
    uninterrupted = FOLDER / "uninterrupted"
    warned_log = FOLDER / "warned_log"
    warned: str

    @classmethod
    def setUpClass(cls) -> None:
        # Looked at by a later test. The warning is due from the start; Slurm gives it when it next looks at the limits, twice a
        # minute. Meanwhile the other jobs run.
        cls.warned = submit(cls.warned_log, "--ntasks=1", "--time=1", "--signal=B:USR1@60", "jobs/requeue.sbatch", QUICKSTART,
                            FOLDER / "warned", *COARSE, "--set", "time.end=0.1")
        simulate(cls.uninterrupted, *COARSE, *SHORT)

    def under_way(self, launcher: str, results: Path) -> str:
        """A job that has written its second snapshot. Where Slurm's own PMIx has not started, which it does not always on a
        busy machine, nothing of the job has: it is submitted anew."""
        for attempt in range(3):
            number = self.submit("--ntasks=2", "jobs/requeue.sbatch", QUICKSTART, results, *COARSE, *SHORT,
                                 SPHDROP_LAUNCHER=launcher)
            second = results / "snapshot_000001.vtkhdf"
            wait_until(lambda: second.exists() or slurm.job(number)["JobState"] in ("COMPLETED", "FAILED"), 60, slurm.logs)
            if second.exists():
                return number
            self.assertIn("pmixp_libpmix_init() failed", slurm.logs())
            self.assertFalse(results.exists())
            print(f"Slurm's PMIx has not started (attempt {attempt + 1})")
        raise AssertionError(slurm.logs())

    def requeued(self, launcher: str) -> None:
        results = self.folder / "results"
        number = self.under_way(launcher, results)
        slurm.warn(number)
        job = slurm.wait_for_end(number, 90)
        self.assertEqual((job["JobState"], job["ExitCode"]), ("COMPLETED", "0:0"), self.log())
        self.assertEqual(job["Restarts"], "1", self.log())
        self.assertIn("start number 1 on node, from the beginning", self.log())
        self.assertIn("start number 2 on node, from " + str(results / "checkpoint_"), self.log())
        self.expect_same_results(self.uninterrupted, results)

    def test_under_mpirun(self) -> None:
        self.requeued("mpirun")

    def test_under_srun(self) -> None:
        kinds = subprocess.run(["srun", "--mpi=list"], capture_output=True, text=True, check=False)
        if "pmix" not in kinds.stdout + kinds.stderr:
            self.skipTest("this Slurm has no PMIx")
        self.requeued("srun --mpi=pmix --kill-on-bad-exit=1")

    def test_a_cancelled_job_stays_cancelled(self) -> None:
        results = self.folder / "results"
        number = self.submit("--ntasks=2", "jobs/requeue.sbatch", QUICKSTART, results, *COARSE, *SHORT)
        wait_for_file(results / "snapshot_000001.vtkhdf")
        call("scancel", number)
        self.assertEqual(slurm.wait_for_end(number, 30)["JobState"], "CANCELLED")
        wait_until(lambda: "not requeued" in self.log(), 30, self.log)
        self.assertEqual(len(list(results.glob("checkpoint_*.h5"))), 1, self.log())
        time.sleep(1)
        self.assertEqual(slurm.job(number)["JobState"], "CANCELLED")
        # Submitting the same again goes on.
        again = self.submit("--ntasks=2", "jobs/requeue.sbatch", QUICKSTART, results, *COARSE, *SHORT)
        self.assertEqual(slurm.wait_for_end(again, 60)["JobState"], "COMPLETED")
        self.expect_same_results(self.uninterrupted, results)

    def test_a_mistake_is_not_repeated(self) -> None:
        number = self.submit("--ntasks=2", "jobs/requeue.sbatch", QUICKSTART, self.folder / "results", "--set", "drop.size=1")
        job = slurm.wait_for_end(number, 30)
        self.assertEqual((job["JobState"], job["ExitCode"], job["Restarts"]), ("FAILED", "2:0", "0"), self.log())
        self.assertIn("drop.size", self.log())

    def test_was_warned_by_slurm_before_the_time_limit(self) -> None:
        def log() -> str:
            return self.warned_log.read_text(encoding="utf-8")

        wait_until(lambda: int(slurm.job(self.warned)["Restarts"]) >= 1, 75, log)
        call("scancel", self.warned)
        self.assertIn("SIGUSR1 came, stopping the run", log())
        self.assertIn("sphdrop: SIGUSR1 came: stopped at step", log())

    @unittest.skipUnless(os.environ.get("SPHDROP_LONG_TESTS"), "takes minutes; SPHDROP_LONG_TESTS=1 runs it")
    def test_a_run_longer_than_the_time_limit(self) -> None:
        long = ("--set", "time.end=0.025", "--set", "output.snapshot_interval=1e-3", *COARSE)
        simulate(self.folder / "uninterrupted", *long)
        results = self.folder / "results"
        number = self.submit("--ntasks=2", "--time=1", "--signal=B:USR1@10", "jobs/requeue.sbatch", QUICKSTART, results, *long)
        job = slurm.wait_for_end(number, 600)
        self.assertEqual(job["JobState"], "COMPLETED", self.log())
        self.assertGreaterEqual(int(job["Restarts"]), 1, self.log())
        self.expect_same_results(self.folder / "uninterrupted", results)


class Sweeping(SlurmTest):
    speeds, lengths = ("[0.0, -0.5]", "[0.0, -1.0]"), ("6e-3", "8e-3")

    def test_an_array_makes_one_table(self) -> None:
        table, results = self.folder / "table.csv", self.folder / "results"
        rows = [f'"{speed}",{length},6.25e-5,6e-4' for length in self.lengths for speed in self.speeds]
        table.write_text("\n".join(["drop.velocity,solid.length,resolution.spacing,time.end", *rows, ""]), encoding="utf-8")
        said = call("jobs/sweep.sh", table, QUICKSTART, results, "--ntasks=1", cwd=ROOT,
                    env={**os.environ, "SPHDROP_PROGRAM": PROGRAM})
        array, collecting = re.findall(r"job (\d+)", said)
        # One of them has to be requeued, and the table has to wait for it.
        wait_for_file(results / "run_001" / "snapshot_000001.vtkhdf")
        slurm.warn(slurm.job(f"{array}_1")["JobId"])
        job = slurm.wait_for_end(collecting, 120)
        told = (results / f"collect_{collecting}.log").read_text(encoding="utf-8")
        self.assertEqual(job["JobState"], "COMPLETED", told)
        self.assertIn("4 of 4 runs finished", told)
        with (results / "sweep.csv").open(encoding="utf-8", newline="") as stream:
            collected = list(csv.DictReader(stream))
        expected = [("run_%03d" % number, speed, length)
                    for number, (length, speed) in enumerate((l, s) for l in self.lengths for s in self.speeds)]
        self.assertEqual([(row["run"], row["drop.velocity"], row["solid.length"]) for row in collected], expected)
        self.assertEqual(len({row["state_hash"] for row in collected}), 4)
        self.assertIn("restarted_from", (results / "run_001" / "run.json").read_text(encoding="utf-8"))
        simulate(self.folder / "alone", *COARSE, "--set", "time.end=6e-4", "--set", "drop.velocity=[0.0, -1.0]", "--set",
                 "solid.length=6e-3")
        self.assertEqual(collected[1]["state_hash"], state_hash(self.folder / "alone"))
        self.assertGreater(float(collected[1]["largest_width [m]"]), float(collected[0]["largest_width [m]"]))


class Scaling(SlurmTest):
    def table(self, kind: str) -> list[dict[str, str]]:
        results = self.folder / "results"
        number = self.submit("--ntasks=2", f"jobs/{kind}_scaling.sbatch", QUICKSTART, results, *COARSE, "--until", "2e-6")
        self.assertEqual(slurm.wait_for_end(number, 60)["JobState"], "COMPLETED", self.log())
        self.assertEqual(len(list(results.glob("ranks_*"))), 6)
        with (results / "scaling.csv").open(encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([row["ranks"] for row in rows], ["1", "2"])
        self.assertEqual(rows[0]["efficiency"], "1.0")
        self.assertGreater(float(rows[1]["efficiency"]), 0.0)
        return rows

    def test_strong(self) -> None:
        alone, both = self.table("strong")
        self.assertEqual((alone["particles"], alone["steps"]), (both["particles"], both["steps"]))

    def test_weak(self) -> None:
        alone, both = self.table("weak")
        self.assertEqual(alone["steps"], both["steps"])
        self.assertAlmostEqual(int(both["particles"]) / int(alone["particles"]), 2.0, delta=0.1)


if __name__ == "__main__":
    sandbox.run_tests_inside(TOOLS)
