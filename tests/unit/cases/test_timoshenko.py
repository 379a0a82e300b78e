"""The exact Timoshenko beam of cases/comparison/timoshenko.py against an independent solution and closed ones."""

from __future__ import annotations

import math
import sys
import unittest
from pathlib import Path

import numpy as np
from numpy.polynomial import legendre

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "cases"))
from comparison.exact_beam import Array, Beam  # noqa: E402
from comparison.timoshenko import TimoshenkoBeam  # noqa: E402


def timoshenko(length: float, is_cantilever: bool = True) -> TimoshenkoBeam:
    return TimoshenkoBeam(length, 0.25e-3, 300e6, 0.3, 1000.0, is_cantilever)


def euler_bernoulli(length: float, is_cantilever: bool = True) -> Beam:
    return Beam(length, 0.25e-3, 300e6, 0.3, 1000.0, is_cantilever)


def ritz_frequencies(beam: TimoshenkoBeam, count: int, degree: int = 30) -> Array:
    """Independent of the determinant: Rayleigh-Ritz with polynomials (1 + x) P_k, times (1 - x) if both ends are clamped,
    for the deflection and for the rotation, on the beam mapped to [-1, 1]."""
    x, weights = legendre.leggauss(2 * degree + 10)
    bound = [1.0, 1.0] if beam.is_cantilever else [1.0, 0.0, -1.0]
    functions = [np.polynomial.Polynomial(bound) * np.polynomial.Polynomial(legendre.leg2poly(np.eye(degree)[k])) for k in range(degree)]
    values = np.array([f(x) for f in functions])
    slopes = np.array([f.deriv()(x) for f in functions]) * 2 / beam.length
    w = weights * beam.length / 2
    product = lambda a, b: (a * w) @ b.T  # noqa: E731
    s, d = beam.shear_stiffness, beam.bending_stiffness
    stiffness = np.block([[s * product(slopes, slopes), -s * product(slopes, values)],
                          [-s * product(values, slopes), d * product(slopes, slopes) + s * product(values, values)]])
    zero = np.zeros((degree, degree))
    mass = np.block([[beam.mass_per_length * product(values, values), zero],
                     [zero, beam.rotary_inertia * product(values, values)]])
    factor = np.linalg.inv(np.linalg.cholesky(mass))
    return np.sqrt(np.linalg.eigvalsh(factor @ stiffness @ factor.T)[:count])


class Frequencies(unittest.TestCase):
    def test_they_are_those_of_rayleigh_and_ritz(self) -> None:
        for is_cantilever in (True, False):
            for length in (1.5e-3, 8e-3):
                beam = timoshenko(length, is_cantilever)
                np.testing.assert_allclose(beam.angular_frequencies(5), ritz_frequencies(beam, 5, 22), rtol=1e-7)

    def test_a_slender_beam_is_euler_bernoullis(self) -> None:
        for is_cantilever in (True, False):
            errors = []
            for length in (0.1, 0.2):
                exact, simple = (b(length, is_cantilever).angular_frequencies(3) for b in (timoshenko, euler_bernoulli))
                self.assertTrue(np.all(exact < simple))
                errors.append(1 - exact / simple)
            self.assertLess(errors[1].max(), 1e-4)
            # What shear and rotary inertia change goes as (H/L)^2.
            np.testing.assert_allclose(errors[0] / errors[1], 4.0, rtol=0.02)

    def test_asking_beyond_the_cut_off_is_an_error(self) -> None:
        beam = timoshenko(1e-3)
        self.assertLess(beam.angular_frequencies(3)[-1], beam.cut_off)
        with self.assertRaisesRegex(ValueError, "cut-off"):
            beam.angular_frequencies(50)


class Shapes(unittest.TestCase):
    def test_they_are_orthogonal_with_the_beams_mass_and_stiffness(self) -> None:
        points, weights = legendre.leggauss(300)
        for is_cantilever in (True, False):
            beam, modes = timoshenko(4e-3, is_cantilever), 8
            x, w = 0.5 * beam.length * (points + 1), 0.5 * beam.length * weights
            deflection, rotation, slope, bend = beam.fields(modes, x)
            mass = beam.mass_per_length * (deflection * w) @ deflection.T + beam.rotary_inertia * (rotation * w) @ rotation.T
            np.testing.assert_allclose(mass / beam.mass, np.eye(modes), atol=1e-9)
            shear = slope - rotation
            stiffness = beam.bending_stiffness * (bend * w) @ bend.T + beam.shear_stiffness * (shear * w) @ shear.T
            omega = beam.angular_frequencies(modes)
            np.testing.assert_allclose(stiffness / beam.mass / np.outer(omega, omega), np.eye(modes), atol=1e-9)

    def test_they_meet_the_conditions_at_the_ends(self) -> None:
        cantilever = timoshenko(4e-3)
        deflection, rotation, slope, bend = cantilever.fields(6, np.array([0.0, 4e-3]))
        np.testing.assert_allclose([deflection[:, 0], rotation[:, 0] * 4e-3], 0.0, atol=1e-9)
        np.testing.assert_allclose([(slope - rotation)[:, 1] * 4e-3, bend[:, 1] * (4e-3) ** 2], 0.0, atol=1e-6)
        deflection, rotation, _, _ = timoshenko(4e-3, False).fields(6, np.array([0.0, 4e-3]))
        np.testing.assert_allclose([deflection, rotation * 4e-3], 0.0, atol=1e-9)


class Response(unittest.TestCase):
    def static_deflection(self, beam: Beam, place: float, force: float, modes: int) -> float:
        """The modes' sum of force over stiffness."""
        shapes = beam.shapes(modes, np.array([place]))[:, 0]
        return float(np.sum(shapes**2 * force / (beam.mass * beam.angular_frequencies(modes) ** 2)))

    def test_static_deflection_bends_and_shears(self) -> None:
        force, length = 0.1, 2.5e-3
        for is_cantilever, place, bending, shearing in ((True, length, 1 / 3, 1.0), (False, length / 2, 1 / 192, 0.25)):
            beam = timoshenko(length, is_cantilever)
            expected_bending = bending * force * length**3 / beam.bending_stiffness
            expected_shearing = shearing * force * length / beam.shear_stiffness
            found = self.static_deflection(beam, place, force, 12)
            # Twelve modes leave out some 3 % of the shear, of which the sum over all modes converges as 1/n.
            self.assertAlmostEqual((found - expected_bending) / expected_shearing, 1.0, delta=0.06)
            # Euler-Bernoulli's beam lacks it.
            simple = self.static_deflection(euler_bernoulli(length, is_cantilever), place, force, 12)
            self.assertAlmostEqual(simple / expected_bending, 1.0, delta=5e-5 if is_cantilever else 5e-4)

    def test_a_steady_force_swings_about_the_static_deflection(self) -> None:
        beam = timoshenko(8e-3)
        period = 2 * math.pi / beam.angular_frequencies(1)[0]
        times = np.linspace(0.0, 50 * period, 20001)
        deflection = beam.respond(times, np.full(len(times), 0.1 * times[1]), np.full(len(times), 8e-3), 8e-3, 10)
        static = 0.1 * (8e-3**3 / (3 * beam.bending_stiffness) + 8e-3 / beam.shear_stiffness)
        self.assertAlmostEqual(deflection.mean() / static, 1.0, delta=2e-3)

    def test_the_force_does_the_energys_work(self) -> None:
        for kind in (timoshenko, euler_bernoulli):
            beam, modes = kind(8e-3), 10
            times = np.linspace(0.0, 6e-3, 3001)
            force = np.where(times < 2e-3, np.sin(math.pi * times / 2e-3) ** 2, 0.0)
            impulses = np.concatenate([[0.0], force[1:] * np.diff(times)])
            place = np.full(len(times), 7e-3)
            motion = beam.motion(times, impulses, place, modes)
            omega = beam.angular_frequencies(modes)
            energy = 0.5 * beam.mass * (motion.rates**2 + (omega * motion.amplitudes) ** 2).sum(axis=1)
            deflection = beam.respond(times, impulses, place, 7e-3, modes)
            work = np.concatenate([[0.0], np.cumsum(force[1:] * np.diff(deflection))])
            np.testing.assert_allclose(energy, work, atol=1e-10 * energy.max())
            self.assertGreater(energy[-1], 0.0)


if __name__ == "__main__":
    unittest.main()
