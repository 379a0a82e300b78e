"""cases/comparison/stretched_beam.py: the tension of a beam that is held at both ends."""

from __future__ import annotations

import math
import sys
import unittest
from pathlib import Path

import numpy as np

CASES = Path(__file__).resolve().parents[3] / "cases"
sys.path[:0] = [str(CASES), str(CASES.parent / "io")]
from comparison import quantities  # noqa: E402
from comparison.exact_beam import Array, Beam  # noqa: E402
from comparison.stretched_beam import slope_products, stretched_motion  # noqa: E402

HELD = Beam(20e-3, 0.25e-3, 300e6, 0.3, 1000.0, False)
CANTILEVER = Beam(8e-3, 0.25e-3, 300e6, 0.3, 1000.0, True)


def push(beam: Beam, modes: int, size: float) -> tuple[Array, Array]:
    """Times, and modal impulses of an even force on the beam's middle for a third of its first period."""
    times = np.linspace(0, 2 * math.pi / float(beam.angular_frequencies(1)[0]), 301)
    impulses = np.where(times < times[-1] / 3, size, 0.0)
    impulses[0] = 0.0
    return times, (beam.shapes(modes, np.full(len(times), 0.5 * beam.length)) * impulses).T


class StretchedBeam(unittest.TestCase):
    def test_the_slopes_of_the_clamped_modes(self) -> None:
        """K_11 L = 12.3026: in closed form sigma b (sigma b - 2)."""
        products = slope_products(HELD, 3) * HELD.length
        root = float(HELD.roots(1)[0])
        ratio = (math.cosh(root) - math.cos(root)) / (math.sinh(root) - math.sin(root))
        self.assertAlmostEqual(products[0, 0], ratio * root * (ratio * root - 2), delta=1e-3)
        self.assertAlmostEqual(products[0, 0], 12.3026, delta=1e-3)
        self.assertAlmostEqual(products[0, 1], 0.0, delta=1e-9)  # one is even, the other odd

    def test_a_single_mode_is_duffings_oscillator(self) -> None:
        """q'' + w^2 q + g q^3 = 0 has 2 pi/(w T) = 1 + 3/8 e - 21/256 e^2, e = g A^2/w^2."""
        omega = float(HELD.angular_frequencies(1)[0])
        axial = HELD.youngs_modulus * HELD.thickness / (1 - HELD.poisson_ratio**2)
        cubic = axial * float(slope_products(HELD, 1)[0, 0]) ** 2 / (2 * HELD.length * HELD.mass)
        for amplitude in (2e-5, 5e-5):
            times = np.linspace(0, 10 * 2 * math.pi / omega, 4001)
            q = stretched_motion(HELD, times, np.zeros((len(times), 1)), np.array([amplitude]))[:, 0]
            measured = math.pi / omega / float(np.diff(quantities.zero_crossings(times, q)).mean())
            e = cubic * amplitude**2 / omega**2
            self.assertAlmostEqual(measured - 1, 3 / 8 * e - 21 / 256 * e**2, delta=0.02 * e)
            self.assertAlmostEqual(float(np.abs(q).max()), amplitude, delta=1e-3 * amplitude)

    def test_small_deflections_and_free_ends_do_not_stretch(self) -> None:
        for beam, size, tolerance in ((HELD, 1e-9, 1e-4), (CANTILEVER, 1e-3, 1e-9)):
            times, impulses = push(beam, 4, size)
            linear = beam.motion(times, np.where(times < times[-1] / 3, size, 0.0) * (times > 0), np.full(len(times), 0.5 * beam.length), 4)
            found = stretched_motion(beam, times, impulses)
            scale = float(np.abs(linear.amplitudes).max())
            np.testing.assert_allclose(found, linear.amplitudes, atol=tolerance * scale)

    def test_it_bends_less_than_without_stretching_and_more_so_the_deeper(self) -> None:
        shares = []
        for size in (2e-6, 4e-6):
            times, impulses = push(HELD, 6, size)
            middle = HELD.shapes(6, np.array([0.5 * HELD.length]))[:, 0]
            linear = HELD.motion(times, np.where(times < times[-1] / 3, size, 0.0) * (times > 0), np.full(len(times), 0.5 * HELD.length), 6)
            depth, bent = (float(np.abs(q @ middle).max()) for q in (stretched_motion(HELD, times, impulses), linear.amplitudes))
            self.assertGreater(bent / HELD.thickness, 0.05)
            shares.append(1 - depth / bent)
        self.assertGreater(shares[0], 0.005)
        self.assertAlmostEqual(shares[1] / shares[0], 4.0, delta=1.0)  # as the square of the deflection


if __name__ == "__main__":
    unittest.main()
