"""cases/comparison/rigid_impact.py against the collision of two masses, and against the modes' exact motion."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path

import numpy as np

CASES = Path(__file__).resolve().parents[3] / "cases"
sys.path[:0] = [str(CASES), str(CASES.parent / "io")]
from comparison.exact_beam import Beam  # noqa: E402
from comparison.rigid_impact import rigid_impact  # noqa: E402

BEAM = Beam(8e-3, 0.25e-3, 300e6, 0.3, 1000.0, is_cantilever=True)


class OneMode(unittest.TestCase):
    """With one mode and a hard spring the beam is a free mass M_b/phi^2 during the blow: an elastic collision."""

    MASS, SPEED, PLACE = 2e-4, 0.8, 8e-3

    def setUp(self) -> None:
        self.omega = BEAM.angular_frequencies(1)[0]
        self.shape = BEAM.shapes(1, np.array([self.PLACE]))[0, 0]
        # Until the beam comes back up the lighter mass, thrown off, is far away.
        self.impact = rigid_impact(BEAM, self.MASS, self.SPEED, self.PLACE, 0.7 * 2 * np.pi / self.omega, modes=1, stiffness=1e10)

    def test_the_mass_rebounds_as_off_a_free_mass(self) -> None:
        other = BEAM.mass / self.shape**2
        self.assertAlmostEqual(self.impact.velocity[-1], -self.SPEED * (self.MASS - other) / (self.MASS + other), delta=1e-3)

    def test_the_beam_swings_as_the_impulse_says(self) -> None:
        other = BEAM.mass / self.shape**2
        impulse = 2 * self.MASS * other / (self.MASS + other) * self.SPEED
        self.assertAlmostEqual(self.impact.impulse[-1] / -impulse, 1, delta=2e-3)
        self.assertAlmostEqual(self.impact.deflection.min() / -(impulse / other / self.omega), 1, delta=2e-3)
        deepest = self.impact.times[np.argmin(self.impact.deflection)]
        self.assertAlmostEqual(deepest / (0.5 * np.pi / self.omega), 1, delta=5e-3)


class ManyModes(unittest.TestCase):
    def test_momentum_and_the_exact_motion_under_the_same_impulse(self) -> None:
        mass, place = 7.85e-4, 7.5e-3
        impact = rigid_impact(BEAM, mass, 0.8, place, 6e-4, modes=8)
        given = mass * (impact.velocity + 0.8)
        self.assertLess(np.abs(given + impact.impulse).max(), 1e-12 * np.abs(impact.impulse).max())
        self.assertGreater(given[-1], 0.3 * mass * 0.8)
        impulses = np.diff(impact.impulse, prepend=0.0)
        exact = BEAM.respond(impact.times, impulses, np.full(len(impulses), place), BEAM.length, 8)
        self.assertLess(np.abs(exact - impact.deflection).max(), 0.01 * np.abs(exact).max())

    def test_a_mass_that_falls_faster_bends_the_beam_in_proportion(self) -> None:
        slow, fast = (rigid_impact(BEAM, 7.85e-4, speed, 7.5e-3, 4e-4, modes=4) for speed in (0.4, 0.8))
        np.testing.assert_allclose(fast.deflection, 2 * slow.deflection, rtol=1e-9, atol=1e-15)


if __name__ == "__main__":
    unittest.main()
