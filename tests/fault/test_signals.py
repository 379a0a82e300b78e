"""Signals and the wall time stop the program in good order, whenever they come; what goes on from there ends as if it
had never stopped. Prints rows for the tables in README.md.
"""

from __future__ import annotations

import json
import re
import signal
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from background_run import BackgroundRun, is_pending, send  # noqa: E402
from running_program import (  # noqa: E402
    AT_ONCE,
    DONE,
    INTERRUPTED,
    LONG,
    WARNING,
    ComparedTest,
    checkpoints,
    hashes_in,
    interrupted,
    little_case,
    preloaded,
    results,
    run,
    state_hash,
    tell,
)

# mpiexec that gets SIGTERM or SIGINT waits so many seconds (1 unless told), sends SIGTERM to the ranks, waits as long again
# and kills them. It returns 1 then, whatever they return. Before all that it wakes ranks that are stopped.
PATIENT = ("--mca", "odls_base_sigkill_timeout", "5")
LONGEST_END = 30.0  # s
# Rank 0 waits, stopped, before it writes the second checkpoint.
HELD = interrupted("fsync", "history.csv", by=signal.SIGSTOP, number=1)
# Once it is woken, it waits for another signal, so that the run is not over before.
HELD_ON = interrupted("fsync", "history.csv", by=signal.SIGSTOP, number=1, wait=60)
STOPPING = (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGUSR2)


class InterruptionTest(ComparedTest):
    case_text = little_case(end=400e-6, snapshot_interval=80e-6, checkpoint_interval=50e-6) if LONG else little_case(
        end=80e-6, snapshot_interval=16e-6, checkpoint_interval=10e-6)

    def start(self, options: tuple[str, ...]) -> BackgroundRun:
        return BackgroundRun("little.cfg", "--quiet", ranks=3, directory=self.directory, options=options)

    def assert_stopped_well(self, why: str, error_text: str) -> int:
        """Returns the step at which it stopped."""
        found = re.findall(rf"^sphdrop: {why}: stopped at step (\d+), ", error_text, flags=re.MULTILINE)
        self.assertEqual(len(found), 1, error_text)
        record = json.loads((self.output / "run.json").read_text(encoding="utf-8"))
        self.assertEqual(record["status"], f"interrupted: {why}")
        self.assertIn(checkpoints(self.output)[-1].name, error_text)
        return int(found[0])

    def assert_goes_on_to_the_same_end(self, ranks: int) -> None:
        result = self.run_here("--restart", "latest", ranks=ranks)
        self.assertNotRegex(result.stderr, WARNING)
        self.assertEqual(state_hash(result), self.whole_hash)
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
        self.setUp()
        ends_mpiexec = target == "mpiexec" and number in (signal.SIGTERM, signal.SIGINT)
        with self.start(options=PATIENT + HELD_ON if ends_mpiexec else AT_ONCE + HELD) as running:
            rank, held = running.rank(2), running.held_rank()
            start = time.monotonic()
            send(rank if target == "rank 2" else running.process.pid, number)
            if not ends_mpiexec:
                if target == "mpiexec":
                    running.wait_for(lambda: is_pending(held, number), "the signal, passed on")
                send(held, signal.SIGCONT)
            code = running.end()
            running.seconds_until_gone(LONGEST_END)
            text = running.text(1)
        step = self.assert_stopped_well(f"{(signal.SIGTERM if ends_mpiexec else number).name} came", text)
        tell(f"{number.name} to {target}", f"stops after step {step} with a checkpoint", code, start)
        self.assertEqual(code, 1 if ends_mpiexec else INTERRUPTED, text)
        self.assert_goes_on_to_the_same_end(ranks=2)

    def test_each_to_one_rank(self) -> None:
        for number in STOPPING:
            with self.subTest(signal=number.name):
                self.stop(number, "rank 2")

    def test_each_to_mpiexec(self) -> None:
        # SIGINT takes long and reaches the ranks as SIGTERM does.
        for number in STOPPING if LONG else [number for number in STOPPING if number != signal.SIGINT]:
            with self.subTest(signal=number.name):
                self.stop(number, "mpiexec")

    def test_several_in_a_row(self) -> None:
        with self.start(options=AT_ONCE + HELD) as running:
            first, second, held = running.rank(1), running.rank(2), running.held_rank()
            send(first, signal.SIGUSR1)
            send(second, signal.SIGTERM)
            send(second, signal.SIGUSR2)
            send(held, signal.SIGINT)
            send(held, signal.SIGCONT)
            self.assertEqual(running.end(), INTERRUPTED, running.text(1))
            running.seconds_until_gone(LONGEST_END)
            self.assertEqual(running.text(1).count("stopped at step"), 1)
        self.assert_goes_on_to_the_same_end(ranks=1)

    def test_one_that_comes_at_a_bad_moment_is_not_lost(self) -> None:
        """While MPI starts, inside METIS, while a snapshot, a checkpoint or the history is written."""
        for number, rank, call, file, count in (
            (signal.SIGTERM, 1, "MPI_Init", "", 0),
            (signal.SIGTERM, 0, "partition", "", 0),
            (signal.SIGUSR1, 0, "write", "snapshot_000001.vtkhdf.part", 0),
            (signal.SIGTERM, 0, "write", ".h5.part", 7),
            (signal.SIGUSR2, 0, "rename", ".h5.part", 1),
            (signal.SIGINT, 0, "fsync", "history.csv", 0),
        ):
            with self.subTest(signal=number.name, call=call, file=file):
                self.setUp()
                start = time.monotonic()
                result = self.run_here(ranks=3, code=INTERRUPTED,
                                       options=AT_ONCE + interrupted(call, file, by=number, number=count, rank=rank))
                step = self.assert_stopped_well(f"{number.name} came", result.stderr)
                tell(f"{number.name} to rank {rank} in {call} {file}".rstrip(), f"stops after step {step} with a checkpoint",
                     result.returncode, start)
                self.assert_goes_on_to_the_same_end(ranks=2)

    def test_a_rank_that_sleeps_for_a_while_delays_the_run_only(self) -> None:
        with self.start(options=HELD) as running:
            rank = running.held_rank()
            time.sleep(10 if LONG else 1)
            self.assertIsNone(running.process.poll())
            start = time.monotonic()
            send(rank, signal.SIGCONT)
            self.assertEqual(running.end(), DONE, running.text(1))
            tell("SIGSTOP and SIGCONT to a rank", "waits for it, the same bytes", DONE, start)
            self.assertEqual(hashes_in(running.text(0)), [self.whole_hash])
        self.assert_same_results(results(self.output), self.whole)


class WallTime(InterruptionTest):
    # Until it knows how long a checkpoint takes, the program keeps five seconds free at the end: there are none on the way.
    case_text = little_case(end=1200e-6 if LONG else 240e-6, snapshot_interval=48e-6, checkpoint_interval=0)

    def record(self) -> dict[str, str | float]:
        return dict(json.loads((self.output / "run.json").read_text(encoding="utf-8")))

    def test_a_chain_of_short_jobs_comes_to_the_same_end(self) -> None:
        start = time.monotonic()
        self.run_here(ranks=3)
        in_all, within = time.monotonic() - start, float(self.record()["wall_time_seconds"])
        # Five seconds, some to start, and a third of the run.
        limit = 5 + (in_all - within) / 2 + within / 3
        self.setUp()
        codes = []
        for leg in range(60):
            result = run("little.cfg", "--quiet", "--restart", "auto", "--max-walltime",
                         f"{limit:.3f}" if leg else f"0:00:{limit:.3f}",
                         ranks=(3, 2)[leg % 2], directory=self.directory, options=AT_ONCE)
            self.assertLess(float(self.record()["wall_time_seconds"]), limit)
            codes.append(result.returncode)
            if result.returncode == DONE:
                break
            self.assertEqual(result.returncode, INTERRUPTED, result.stderr)
            self.assert_stopped_well("the wall time runs out", result.stderr)
        self.assertIn(INTERRUPTED, codes)
        self.assertEqual(state_hash(result), self.whole_hash)
        self.assert_same_end()
        tell(f"--max-walltime {limit:.1f}", f"{len(codes)} jobs, each in good time; they return {codes}",
             result.returncode, start)

    def test_a_clock_that_jumps_does_not_matter(self) -> None:
        for jump in (-86400, 86400):
            with self.subTest(jump=jump):
                self.setUp()
                start = time.monotonic()
                options = preloaded("SPHDROP_INTERRUPTED_CALLS", CLOCK_JUMP=jump, INTERRUPT_CALL="fsync", INTERRUPT_RANK=0,
                                    INTERRUPT_FILE="history_columns.json.part", INTERRUPT_NUMBER=0)
                result = self.run_here("--max-walltime", "100", ranks=2, options=options)
                tell(f"the clock jumps by {jump} s", "takes no notice, the same bytes", result.returncode, start)
                self.assertEqual(state_hash(result), self.whole_hash)
                self.assert_same_results(results(self.output), self.whole)
                record = self.record()
                self.assertLess(0, float(record["wall_time_seconds"]))
                self.assertLess(float(record["wall_time_seconds"]), 100)
                days = [str(record[name])[:10] for name in ("start", "end")]
                self.assertEqual(days, sorted(days, reverse=jump < 0))
                self.assertNotEqual(*days, "the clock did not jump")
                # The wall time runs out when it does by the other clock.
                stopped = self.run_here("--fresh", "--max-walltime", "5.01", ranks=2, options=AT_ONCE + options,
                                        code=INTERRUPTED)
                self.assert_stopped_well("the wall time runs out", stopped.stderr)
                self.assertLess(float(self.record()["wall_time_seconds"]), 5.01)


if __name__ == "__main__":
    unittest.main()
