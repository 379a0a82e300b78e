"""The exact Euler-Bernoulli beam, clamped-free or clamped-clamped, in plane strain, and its motion mode by mode.

A theory of the beam gives angular frequencies and mode shapes; what is common to all of them, the motion under given
impulses, stands here. Everything is per metre of depth and in SI units.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ModalMotion:
    """Amplitudes q [time, mode] in m and their rates v in m/s."""

    amplitudes: Array
    rates: Array


def modal_motion(omega: Array, modal_mass: float, times: Array, modal_impulses: Array) -> ModalMotion:
    """From rest at times[0], modes of angular frequencies omega [mode] and of equal mass (kg/m) under impulses
    [time, mode] (N s/m): that at times[k] acts over the interval that ends there, evenly; each mode is exact over it."""
    q, v = np.zeros((len(times), len(omega))), np.zeros((len(times), len(omega)))
    for k in range(1, len(times)):
        dt = times[k] - times[k - 1]
        static = modal_impulses[k] / dt / (modal_mass * omega**2)
        c, s = np.cos(omega * dt), np.sin(omega * dt)
        away = q[k - 1] - static
        q[k] = static + away * c + v[k - 1] / omega * s
        v[k] = -away * omega * s + v[k - 1] * c
    return ModalMotion(q, v)


@dataclass(frozen=True)
class Beam:
    """A beam of rectangular section; clamped at 0 and, unless a cantilever, at `length` too. Euler-Bernoulli."""

    length: float
    thickness: float
    youngs_modulus: float
    poisson_ratio: float
    density: float
    is_cantilever: bool

    @property
    def bending_stiffness(self) -> float:
        """E I / (1 - nu^2), N m^2 per metre of depth."""
        return self.youngs_modulus * self.thickness**3 / 12 / (1 - self.poisson_ratio**2)

    @property
    def mass_per_length(self) -> float:
        """kg/m per metre of depth."""
        return self.density * self.thickness

    @property
    def mass(self) -> float:
        """M_b, kg per metre of depth. Every mode has it, as the shapes are normalised."""
        return self.mass_per_length * self.length

    def roots(self, count: int) -> Array:
        """The first roots of 1 + cos x cosh x = 0 (cantilever) or 1 - cos x cosh x = 0, by bisection."""
        sign = 1.0 if self.is_cantilever else -1.0
        found = []
        for k in range(count):
            centre = (k + 0.5 + (0 if self.is_cantilever else 1)) * math.pi
            low, high = centre - 0.4, centre + 0.4
            # Divided by cosh x, so that large roots neither overflow nor lose their digits.
            value = lambda x: sign / math.cosh(x) + math.cos(x)  # noqa: E731
            for _ in range(200):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if value(low) * value(middle) > 0 else (low, middle)
            found.append(0.5 * (low + high))
        return np.array(found)

    def angular_frequencies(self, count: int) -> Array:
        """The lowest ones, rad/s."""
        return self.roots(count) ** 2 / self.length**2 * math.sqrt(self.bending_stiffness / self.mass_per_length)

    def shapes(self, count: int, x: Array) -> Array:
        """Mode shapes [mode, place], normalised so that the mean of their square over the length is 1."""
        rows = []
        for b in self.roots(count):
            xi = b * np.clip(np.asarray(x) / self.length, 0.0, 1.0)
            c, s = math.cos(b), math.sin(b)
            if self.is_cantilever:
                ratio = (math.sinh(b) - s) / (math.cosh(b) + c)
            else:
                ratio = (math.cosh(b) - c) / (math.sinh(b) - s)
            # cosh - ratio sinh, written without the difference of two huge numbers.
            hyperbolic = 0.5 * ((1 - ratio) * np.exp(xi) + (1 + ratio) * np.exp(-xi))
            rows.append(hyperbolic - np.cos(xi) + ratio * np.sin(xi))
        return np.array(rows)

    def motion(self, times: Array, impulses: Array, places: Array, modes: int) -> ModalMotion:
        """From rest; impulses[k] (N s/m) acts at places[k] (m) over the interval that ends at times[k], evenly."""
        modal_impulses = (self.shapes(modes, places) * impulses).T
        return modal_motion(self.angular_frequencies(modes), self.mass, times, modal_impulses)

    def respond(self, times: Array, impulses: Array, places: Array, probe: float, modes: int) -> Array:
        """Deflection in m at `probe` (m) at the given times; see motion()."""
        return self.motion(times, impulses, places, modes).amplitudes @ self.shapes(modes, np.array([probe]))[:, 0]
