"""Signals and the wall time stop the program in good order, whenever they come; what goes on from there ends as if it
had never stopped. Prints a table of what was sent, and how long it took.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from running_program import (  # noqa: E402
    AT_ONCE,
    CASE,
    DONE,
    INTERRUPTED,
    ProgramTest,
    checkpoints,
    hashes_in,
    results,
    run,
    send,
)

INTERRUPTED_CALLS = os.environ["SPHDROP_INTERRUPTED_CALLS"]
# mpiexec that gets SIGTERM or SIGINT waits so many seconds (1 unless told), sends SIGTERM to the ranks, waits as long again
# and kills them. It returns 1 then, whatever they return.
PATIENT = ("--mca", "odls_base_sigkill_timeout", "2")
LONGEST_END = 10.0  # s
# Checkpoints nearly all the time, so that the run is not over before.
SLOWED = ("--set", "checkpoint.wall_interval=0.001")


def preload(**settings: str | int) -> tuple[str, ...]:
    """Options of mpiexec that make the ranks use interrupted_calls.cpp."""
    words = {"LD_PRELOAD": INTERRUPTED_CALLS, "INTERRUPT_NUMBER": 0, **settings}
    return tuple(word for name, value in words.items() for word in ("-x", f"{name}={value}"))


class InterruptionTest(ProgramTest):
    case_text = (CASE.replace("end = 40e-6", "end = 400e-6").replace("snapshot_interval = 8e-6", "snapshot_interval = 80e-6")
                 .replace("interval = 4e-6", "interval = 50e-6"))
    whole_hash: str
    whole: dict[str, bytes]
    table: list[str]

    @classmethod
    def setUpClass(cls) -> None:
        maker = cls("setUp")
        cls.addClassCleanup(maker.doCleanups)
        maker.setUp()
        [cls.whole_hash] = hashes_in(maker.run_here(ranks=1).stdout)
        cls.whole = results(maker.output)
        cls.table = []

    @classmethod
    def tearDownClass(cls) -> None:
        print("\n".join(["", *cls.table]), flush=True)

    def is_under_way(self) -> bool:
        return bool(checkpoints(self.output))

    def assert_stopped_well(self, why: str, error_text: str) -> None:
        self.assertEqual(error_text.count(f"sphdrop: {why}: stopped at step "), 1, error_text)
        record = json.loads((self.output / "run.json").read_text(encoding="utf-8"))
        self.assertEqual(record["status"], f"interrupted: {why}")
        self.assertIn(checkpoints(self.output)[-1].name, error_text)

    def assert_goes_on_to_the_same_end(self, ranks: int) -> None:
        result = self.run_here("--restart", "latest", ranks=ranks)
        self.assertNotIn("warning", result.stderr)
        self.assertEqual(hashes_in(result.stdout), [self.whole_hash])
        self.assert_same_end()

    def assert_same_end(self) -> None:
        """All results but the last checkpoint but one, which may be that of the interruption."""
        found, expected = results(self.output), dict(self.whole)
        for files in (found, expected):
            for name in sorted(name for name in files if name.startswith("checkpoint_"))[:-1]:
                del files[name]
        self.assert_same_results(found, expected)


class Signals(InterruptionTest):
    def stop(self, number: signal.Signals, target: str) -> None:
        ends_mpiexec = target == "mpiexec" and number in (signal.SIGTERM, signal.SIGINT)
        with self.start_here(*(SLOWED if ends_mpiexec else ()), ranks=3, options=PATIENT if ends_mpiexec else ()) as running:
            rank = running.rank(2)
            running.wait_for(self.is_under_way, "a checkpoint")
            start = time.monotonic()
            send(rank if target == "rank 2" else running.process.pid, number)
            code = running.end(30)
            running.seconds_until_gone(LONGEST_END)
            took = time.monotonic() - start
            text = running.text(1)
        [step] = [word for line in text.splitlines() if ": stopped at step " in line
                  for word in line.split("stopped at step ")[1].split(",")[:1]]
        self.table.append(f"{number.name:8} to {target:8} mpiexec returned {code:3}, gone after {took:5.2f} s, step {step}")
        self.assert_stopped_well(f"{(signal.SIGTERM if ends_mpiexec else number).name} came", text)
        self.assertLess(took, LONGEST_END)
        self.assertEqual(code, 1 if ends_mpiexec else INTERRUPTED, text)
        self.assert_goes_on_to_the_same_end(ranks=2)

    def test_each_to_one_rank(self) -> None:
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGUSR2):
            with self.subTest(signal=number.name):
                self.setUp()
                self.stop(number, "rank 2")

    def test_each_to_mpiexec(self) -> None:
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGUSR2):
            with self.subTest(signal=number.name):
                self.setUp()
                self.stop(number, "mpiexec")

    def test_two_in_a_row(self) -> None:
        with self.start_here(ranks=3, options=AT_ONCE) as running:
            first, second = running.rank(1), running.rank(2)
            running.wait_for(self.is_under_way, "a checkpoint")
            send(first, signal.SIGUSR1)
            time.sleep(0.003)
            send(second, signal.SIGTERM)
            send(second, signal.SIGUSR2)
            self.assertEqual(running.end(30), INTERRUPTED, running.text(1))
            running.seconds_until_gone(LONGEST_END)
            self.assertEqual(running.text(1).count("stopped at step"), 1)
        self.assert_goes_on_to_the_same_end(ranks=1)

    def test_one_that_comes_at_a_bad_moment_is_not_lost(self) -> None:
        """While MPI starts, inside METIS, while a snapshot, a checkpoint or the history is written."""
        moments = (
            (signal.SIGTERM, {"INTERRUPT_CALL": "MPI_Init", "INTERRUPT_RANK": 1}),
            (signal.SIGTERM, {"INTERRUPT_CALL": "partition", "INTERRUPT_RANK": 0}),
            (signal.SIGUSR1, {"INTERRUPT_CALL": "write", "INTERRUPT_FILE": "snapshot_000001.vtkhdf.part"}),
            (signal.SIGTERM, {"INTERRUPT_CALL": "write", "INTERRUPT_FILE": ".h5.part", "INTERRUPT_NUMBER": 7}),
            (signal.SIGUSR2, {"INTERRUPT_CALL": "rename", "INTERRUPT_FILE": ".h5.part", "INTERRUPT_NUMBER": 1}),
            (signal.SIGINT, {"INTERRUPT_CALL": "fsync", "INTERRUPT_FILE": "history.csv"}),
        )
        for number, moment in moments:
            with self.subTest(**moment):
                self.setUp()
                options = AT_ONCE + preload(INTERRUPT_SIGNAL=int(number), **{"INTERRUPT_RANK": 0, **moment})
                result = self.run_here(ranks=3, code=INTERRUPTED, options=options)
                self.assert_stopped_well(f"{number.name} came", result.stderr)
                where = " ".join(str(value) for name, value in moment.items() if name != "INTERRUPT_RANK")
                [step] = [line.split("stopped at step ")[1].split(",")[0] for line in result.stderr.splitlines()
                          if ": stopped at step " in line]
                self.table.append(f"{number.name:8} during {where}: mpiexec returned {result.returncode}, step {step}")
                self.assert_goes_on_to_the_same_end(ranks=2)

    def test_a_rank_that_sleeps_for_a_while_delays_the_run_only(self) -> None:
        with self.start_here(ranks=3) as running:
            rank = running.rank(1)
            running.wait_for(self.is_under_way, "a checkpoint")
            send(rank, signal.SIGSTOP)
            time.sleep(2)
            self.assertIsNone(running.process.poll())
            send(rank, signal.SIGCONT)
            self.assertEqual(running.end(60), DONE, running.text(1))
            self.assertEqual(hashes_in(running.text(0)), [self.whole_hash])
        self.assert_same_results(results(self.output), self.whole)


class WallTime(InterruptionTest):
    # Until it knows how long a checkpoint takes, the program keeps five seconds free at the end: there are none on the way.
    case_text = (InterruptionTest.case_text.replace("end = 400e-6", "end = 1200e-6")
                 .replace("interval = 50e-6", "interval = 0.0"))

    def test_a_chain_of_short_jobs_comes_to_the_same_end(self) -> None:
        self.run_here("--output", "whole", ranks=3)
        record = json.loads((self.directory / "whole" / "run.json").read_text(encoding="utf-8"))
        # Five seconds and some to start, and a third of the run.
        limit = 5.3 + record["wall_time_seconds"] / 3
        codes = []
        for leg in range(60):
            start = time.monotonic()
            result = run("little.cfg", "--quiet", "--restart", "auto", "--max-walltime",
                         f"{limit:.3f}" if leg else f"0:00:{limit:.3f}",
                         ranks=(3, 2)[leg % 2], directory=self.directory, options=AT_ONCE)
            took = time.monotonic() - start
            self.assertLess(took, limit)
            codes.append(result.returncode)
            if result.returncode == DONE:
                break
            self.assertEqual(result.returncode, INTERRUPTED, result.stderr)
            self.assert_stopped_well("the wall time runs out", result.stderr)
        self.assertIn(INTERRUPTED, codes)
        self.assertEqual(hashes_in(result.stdout), [self.whole_hash])
        self.assert_same_end()
        self.table.append(f"--max-walltime {limit:.2f}: {len(codes)} jobs, returned {codes}")

    def test_a_clock_that_jumps_does_not_matter(self) -> None:
        for jump in (-86400, 86400):
            with self.subTest(jump=jump):
                self.setUp()
                options = preload(CLOCK_JUMP=jump, INTERRUPT_CALL="fsync", INTERRUPT_FILE="history_columns.json.part",
                                  INTERRUPT_RANK=0)
                result = self.run_here("--max-walltime", "60", ranks=2, options=options)
                self.assertEqual(hashes_in(result.stdout), [self.whole_hash])
                self.assert_same_results(results(self.output), self.whole)
                record = json.loads((self.output / "run.json").read_text(encoding="utf-8"))
                self.assertLess(0, record["wall_time_seconds"])
                self.assertLess(record["wall_time_seconds"], 60)
                days = [record[name][:10] for name in ("start", "end")]
                self.assertEqual(days, sorted(days, reverse=jump < 0))
                self.assertNotEqual(*days, "the clock did not jump")
                start = time.monotonic()
                stopped = self.run_here("--fresh", "--max-walltime", "5.2", ranks=2, options=AT_ONCE + options, code=None)
                self.assertIn(stopped.returncode, (DONE, INTERRUPTED))
                self.assertLess(time.monotonic() - start, 5.2)


if __name__ == "__main__":
    unittest.main()
