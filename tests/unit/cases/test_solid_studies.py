"""The studies of the rigid ball, the oscillating plate and Turek's beam: where runs are missing, their expected.csv, and how
blows and swings are told from a history."""

from __future__ import annotations

import math
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

CASES = Path(__file__).resolve().parents[3] / "cases"
sys.path[:0] = [str(CASES), str(CASES.parent / "io")]
from comparison.study import Results, Study  # noqa: E402

STUDIES = ("rigid_ball", "elastic_plate", "turek_beam")


def history(**columns: object) -> SimpleNamespace:
    """What a plot.py reads of a run."""
    return SimpleNamespace(history={name: np.asarray(values, dtype=float) for name, values in columns.items()})


class Studies(unittest.TestCase):
    def test_without_runs_there_is_nothing_to_say(self) -> None:
        for name in STUDIES:
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                module = Study(CASES / name).module()
                self.assertEqual(module.measure(Results({}, "paper")), {})
                self.assertEqual(module.draw(Results({}, "paper"), Path(folder)), [])

    def test_each_run_is_expected_to_give_something(self) -> None:
        for name in STUDIES:
            study = Study(CASES / name)
            for level in ("paper", "quick", "short"):
                with self.subTest(name, level=level):
                    self.assertTrue(study.variants(level))
                    quantities = [row.quantity for row in study.expected(level)]
                    for variant in study.variants(level):
                        name = variant.twin or variant.name
                        self.assertTrue(any(quantity.endswith("_" + name) for quantity in quantities), variant.name)


class Ball(unittest.TestCase):
    def test_blows_are_what_rows_of_growing_impulse_are_between_rows_of_none(self) -> None:
        module = Study(CASES / "rigid_ball").module()
        run = history(time=[0, 1, 2, 3, 4, 5, 6], contact_impulse_y=[0, 0, -2, -3, -3, -3, -7])
        found = [(blow.start, blow.end, blow.impulse) for blow in module.blows(run)]
        self.assertEqual(found, [(1.0, 3.0, 3.0), (5.0, 6.0, 4.0)])

    def test_no_contact_is_no_blow(self) -> None:
        module = Study(CASES / "rigid_ball").module()
        self.assertEqual(module.blows(history(time=[0, 1, 2], contact_impulse_y=[0, 0, 0])), [])


class Plate(unittest.TestCase):
    def setUp(self) -> None:
        self.module = Study(CASES / "elastic_plate").module()
        times = np.linspace(0, 1.0, 1001)
        self.run_of = lambda end: history(time=times[times <= end], deflection=self.swing(times[times <= end]))

    @staticmethod
    def swing(times: np.ndarray) -> np.ndarray:
        return 0.02 * np.exp(-0.5 * times) * np.sin(2 * math.pi * times / 0.3)

    def test_periods_begin_with_the_start(self) -> None:
        found = self.module.periods(self.run_of(0.7))
        np.testing.assert_allclose(found, [0.3] * 3, rtol=1e-4)
        self.assertEqual(len(self.module.periods(self.run_of(0.29))), 0)

    def test_swings_up_and_down(self) -> None:
        up, down = self.module.first_swings(self.run_of(0.7))
        phase = math.atan2(2 * math.pi / 0.3, 0.5)
        for value, angle in ((up, phase), (down, phase + math.pi)):
            self.assertAlmostEqual(value, abs(float(self.swing(np.array([angle * 0.3 / (2 * math.pi)]))[0])), delta=1e-8)
        self.assertTrue(math.isnan(self.module.first_swings(self.run_of(0.2))[1]))


class Turek(unittest.TestCase):
    def test_extremes_of_a_swing_that_is_let_go(self) -> None:
        module = Study(CASES / "turek_beam").module()
        times = np.linspace(0, 3, 3001)
        y = -0.06 * (1 - np.exp(-0.1 * times) * np.cos(2 * math.pi * times))
        low, high = module.first_extremes(times, y)
        self.assertAlmostEqual(low, -0.06 * (1 + math.exp(-0.05)), delta=2e-5)
        self.assertAlmostEqual(high, -0.06 * (1 - math.exp(-0.1)), delta=2e-5)
        self.assertTrue(math.isnan(module.first_extremes(times[:900], y[:900])[0]))


if __name__ == "__main__":
    unittest.main()
