"""The exact beam of cases/modal_beam.py against closed solutions."""

from __future__ import annotations

import math
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "cases"))
from modal_beam import Beam  # noqa: E402


def beam(is_cantilever: bool = True, length: float = 8e-3) -> Beam:
    return Beam(length, 0.25e-3, 300e6, 0.3, 1000.0, is_cantilever)


class Modes(unittest.TestCase):
    def test_roots_are_the_tabulated_ones(self) -> None:
        np.testing.assert_allclose(beam().roots(4), [1.87510407, 4.69409113, 7.85475744, 10.99554073], rtol=1e-8)
        np.testing.assert_allclose(beam(False).roots(3), [4.73004074, 7.85320462, 10.99560784], rtol=1e-8)

    def test_first_periods_are_the_papers(self) -> None:
        periods = [2 * math.pi / beam(length=length).angular_frequencies(1)[0] for length in (8e-3, 12e-3, 15e-3, 20e-3)]
        np.testing.assert_allclose(periods, [2.76e-3, 6.20e-3, 9.69e-3, 17.2e-3], rtol=3e-3)
        self.assertAlmostEqual(2 * math.pi / beam(False, 20e-3).angular_frequencies(1)[0], 2.71e-3, delta=0.005e-3)

    def test_shapes_are_orthonormal_and_clamped(self) -> None:
        for is_cantilever in (True, False):
            x = np.linspace(0.0, 8e-3, 20001)
            shapes = beam(is_cantilever).shapes(6, x)
            weights = np.full(len(x), 1.0 / (len(x) - 1))
            weights[[0, -1]] *= 0.5
            np.testing.assert_allclose(shapes * weights @ shapes.T, np.eye(6), atol=2e-5)
            np.testing.assert_allclose(shapes[:, 0], 0.0, atol=1e-9)
            np.testing.assert_allclose(np.abs(shapes[:, -1]), 2.0 if is_cantilever else 0.0, atol=1e-5)


class Response(unittest.TestCase):
    def test_steady_force_at_the_tip_swings_about_the_static_deflection(self) -> None:
        b = beam()
        times = np.linspace(0.0, 20 * 2.76e-3, 40001)
        force = 0.1
        deflection = b.respond(times, np.full(len(times), force * times[1]), np.full(len(times), 8e-3), 8e-3, 20)
        static = force * 8e-3**3 / (3 * b.bending_stiffness)
        self.assertAlmostEqual(deflection.mean() / static, 1.0, delta=0.01)
        self.assertAlmostEqual(deflection.max() / static, 2.0, delta=0.05)

    def test_an_impulse_sets_the_first_mode_ringing(self) -> None:
        b = beam()
        omega = b.angular_frequencies(1)[0]
        times = np.linspace(0.0, 5e-3, 5001)
        impulses = np.zeros(len(times))
        impulses[1] = 1e-4
        deflection = b.respond(times, impulses, np.full(len(times), 8e-3), 8e-3, 1)
        # One mode of mass rho H L, shape 2 at the tip: q = 2 J sin(omega t)/(M omega), deflection 2 q.
        amplitude = 4 * 1e-4 / (b.mass_per_length * b.length * omega)
        np.testing.assert_allclose(deflection, amplitude * np.sin(omega * (times - 0.5 * times[1])), atol=2e-3 * amplitude)

    def test_finer_times_give_the_same(self) -> None:
        b = beam(False, 20e-3)
        pulse = lambda t: np.where(t < 1e-3, np.sin(np.pi * t / 1e-3), 0.0)  # noqa: E731
        deflections = []
        for count in (501, 4001):
            times = np.linspace(0.0, 4e-3, count)
            impulses = pulse(times - 0.5 * times[1]) * times[1]
            impulses[0] = 0.0
            deflections.append(b.respond(times, impulses, np.full(count, 10e-3), 10e-3, 12)[-1])
        self.assertAlmostEqual(deflections[0] / deflections[1], 1.0, delta=2e-3)


if __name__ == "__main__":
    unittest.main()
