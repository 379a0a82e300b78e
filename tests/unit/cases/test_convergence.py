"""Observed orders of convergence of values that follow a power law exactly."""

from __future__ import annotations

import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "cases"))
from comparison.convergence import fit_order, richardson  # noqa: E402

UNEVEN = [0.05, 0.0333, 0.025, 0.0167]


class PowerLaws(unittest.TestCase):
    def test_order_and_limit_are_found_from_uneven_spacings(self) -> None:
        for order in (0.5, 1.0, 1.7, 2.0, 3.0):
            for coefficient in (40.0, -0.3):
                values = [2.5 + coefficient * d**order for d in UNEVEN]
                for spacings, f in ((UNEVEN, values), (UNEVEN[1:], values[1:])):
                    with self.subTest(order=order, coefficient=coefficient, count=len(f)):
                        fit = fit_order(spacings, f)
                        self.assertAlmostEqual(fit.order, order, delta=1e-5)
                        self.assertAlmostEqual(fit.limit, 2.5, delta=1e-6)
                        self.assertAlmostEqual(fit.coefficient / coefficient, 1.0, delta=1e-4)
                        self.assertLess(fit.residual, 1e-7)
                        self.assertAlmostEqual(fit(0.01), 2.5 + coefficient * 0.01**order, delta=1e-6)
                        self.assertIn(f"order {order:.2f}", fit.text)

    def test_the_order_of_the_points_does_not_matter(self) -> None:
        values = {d: 1.0 + 3 * d**2 for d in UNEVEN}
        shuffled = [UNEVEN[k] for k in (2, 0, 3, 1)]
        self.assertAlmostEqual(fit_order(shuffled, [values[d] for d in shuffled]).order, 2.0, delta=1e-5)

    def test_three_points_are_met_exactly(self) -> None:
        spacings, values = [0.4, 0.25, 0.1], [1.9, 1.4, 1.1]
        fit = fit_order(spacings, values)
        for d, f in zip(spacings, values):
            self.assertAlmostEqual(float(fit(d)), f, delta=1e-12)
        self.assertEqual(fit.residual, 0.0)

    def test_richardson_takes_the_finest_three(self) -> None:
        values = [1.1] + [1.0 + 5 * d**1.5 for d in UNEVEN[1:]]
        self.assertAlmostEqual(richardson(UNEVEN, values).order, 1.5, delta=1e-9)
        self.assertGreater(abs(fit_order(UNEVEN, values).order - 1.5), 0.1)

    def test_least_squares_lie_between_scattered_points(self) -> None:
        spacings = [0.5, 0.4, 0.3, 0.2, 0.1]
        scatter = [1e-3, -1e-3, 1e-3, -1e-3, 1e-3]
        fit = fit_order(spacings, [4 + d**2 + e for d, e in zip(spacings, scatter)])
        self.assertAlmostEqual(fit.order, 2.0, delta=0.1)
        self.assertTrue(1e-4 < fit.residual < 1.1e-3, fit.residual)
        # No neighbouring order fits better with any limit and coefficient.
        for other in (0.97, 1.03):
            basis = [d ** (fit.order * other) for d in spacings]
            f = [4 + d**2 + e for d, e in zip(spacings, scatter)]
            mean_b, mean_f = sum(basis) / 5, sum(f) / 5
            slope = sum((b - mean_b) * (y - mean_f) for b, y in zip(basis, f)) / sum((b - mean_b) ** 2 for b in basis)
            residual = math.sqrt(sum((mean_f + slope * (b - mean_b) - y) ** 2 for b, y in zip(basis, f)) / 5)
            self.assertGreater(residual, fit.residual)


class NoOrder(unittest.TestCase):
    def test_values_that_go_up_and_down(self) -> None:
        fit = fit_order([0.4, 0.2, 0.1], [1.0, 1.2, 1.1])
        self.assertTrue(math.isnan(fit.order))
        self.assertTrue(math.isnan(fit.limit))
        self.assertIn("not monotone", fit.text)

    def test_differences_that_do_not_shrink(self) -> None:
        fit = fit_order([0.4, 0.2, 0.1], [1.0, 2.0, 3.5])
        self.assertTrue(math.isnan(fit.order))
        self.assertIn("do not shrink", fit.text)

    def test_constant_values_are_their_limit(self) -> None:
        fit = fit_order([0.4, 0.2, 0.1], [3.0, 3.0, 3.0])
        self.assertTrue(math.isnan(fit.order))
        self.assertEqual(fit.limit, 3.0)

    def test_too_few_values(self) -> None:
        self.assertIn("three spacings", fit_order([0.2, 0.1], [1.0, 2.0]).text)
        self.assertIn("not 2", fit_order([0.4, 0.2, 0.1], [1.0, math.nan, 2.0]).text)

    def test_mistakes_are_refused(self) -> None:
        for spacings, values in (([0.1, 0.2], [1.0]), ([0.1, 0.1, 0.2], [1.0, 2.0, 3.0]), ([-0.1, 0.2, 0.3], [1.0, 2.0, 3.0])):
            with self.assertRaises(ValueError):
                fit_order(spacings, values)


if __name__ == "__main__":
    unittest.main()
