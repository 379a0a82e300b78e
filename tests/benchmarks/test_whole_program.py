"""The script that times whole runs: its arithmetic, and a short run of the program."""

from __future__ import annotations

import contextlib
import io
import os
import subprocess
import tomllib
import unittest
from pathlib import Path
from unittest import mock

import whole_program
from whole_program import Run, Timing


def timing(total: float, state_hash: str = "a") -> Timing:
    return Timing(1000, 50, total, {"update": 0.5 * total, "contact": 0.25 * total}, state_hash)


class Arithmetic(unittest.TestCase):
    def test_a_record_gives_the_time_of_its_own_steps(self) -> None:
        details = {"particles": 10, "steps": 300, "restarted_at_step": 100, "seconds in update": 2.0, "detections": 3}
        found = whole_program.timing_of({"details": details, "wall_time_seconds": 4.0, "state_hash": "b"})
        self.assertEqual(found, Timing(10, 200, 4.0, {"update": 2.0}, "b"))
        self.assertAlmostEqual(found.cost, 2e-3)

    def test_efficiency_of_pairs_and_of_the_best(self) -> None:
        alone, together = [timing(8.0), timing(10.0)], [timing(5.0), timing(5.0)]
        low, high, best = whole_program.efficiencies(alone, together, 2)
        self.assertAlmostEqual(low, 0.8)
        self.assertAlmostEqual(high, 1.0)
        self.assertAlmostEqual(best, 0.8)

    def test_the_best_repeat_makes_the_row(self) -> None:
        program = Path("p")
        (first, second) = whole_program.rows("beam", {(program, 1): [timing(2.0), timing(1.0)], (program, 2): [timing(1.0), timing(0.5)]}, ["update", "contact"])
        self.assertEqual(first, "| beam | 1 | 20000.00 | 20000.0 | - | 10000.00 | 5000.00 |")
        self.assertEqual(second, "| beam | 2 | 10000.00 | 10000.0 | 1.000 (1.000 to 1.000) | 5000.00 | 2500.00 |")


class Mistakes(unittest.TestCase):
    def test_a_run_that_is_not_there_is_named(self) -> None:
        text = io.StringIO()
        with contextlib.redirect_stderr(text), self.assertRaises(SystemExit):
            whole_program.main(["cantilever 9 mm"])
        self.assertIn("there is no run 'cantilever 9 mm'; there are: hypoelastic beam,", text.getvalue())

    def test_different_states_are_no_measurement(self) -> None:
        with mock.patch.object(whole_program, "start", side_effect=[timing(1.0, "a"), timing(1.0, "b")]):
            with self.assertRaisesRegex(whole_program.BenchmarkError, "differ in the state at the end: a, b"):
                whole_program.measure(Run("free_vibration", 1e-6), [Path("p")], [1, 2], 1)

    def test_a_program_that_fails_is_told(self) -> None:
        text = io.StringIO()
        with contextlib.redirect_stderr(text), contextlib.redirect_stdout(io.StringIO()), \
                mock.patch.dict(whole_program.RUNS, {"short": Run("no_such_case", 1e-6)}):
            self.assertEqual(whole_program.main(["short", "--program", os.environ["SPHDROP_PROGRAM"], "--ranks", "1"]), 1)
        self.assertRegex(text.getvalue(), r"whole_program\.py: .* ends with \d+:")


class TheProgram(unittest.TestCase):
    def test_knows_every_run(self) -> None:
        for name, run in whole_program.RUNS.items():
            with self.subTest(run=name):
                settings = [word for setting in run.settings for word in ("--set", setting)]
                command = [os.environ["SPHDROP_PROGRAM"], str(whole_program.ROOT / "cases" / run.case / "case.cfg"), *settings, "--print-case"]
                case = tomllib.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
                self.assertLess(run.begin, run.until)
                self.assertLessEqual(run.until, case["time"]["end"])

    def test_goes_on_from_a_checkpoint_to_the_same_state_on_both_numbers_of_ranks(self) -> None:
        text = io.StringIO()
        with contextlib.redirect_stdout(text), mock.patch.dict(whole_program.RUNS, {"short": Run("cantilever", 8e-7, 4e-7, ('mode="fast"',))}):
            self.assertEqual(whole_program.main(["short", "--program", os.environ["SPHDROP_PROGRAM"], "--repeats", "1"]), 0)
        head, line, one, two = text.getvalue().splitlines()
        self.assertIn("| efficiency | fluid sweep | solid sweep |", head)
        self.assertEqual(line.count("|"), head.count("|"))
        self.assertRegex(one, r"^\| short \| 1 \| \d+\.\d\d \| ")
        self.assertRegex(two, r"^\| short \| 2 \| \d+\.\d\d \| \d+\.\d \| \d\.\d{3} \(")


if __name__ == "__main__":
    unittest.main()
