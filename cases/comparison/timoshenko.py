"""The exact Timoshenko beam: what shear and rotary inertia change of the Euler-Bernoulli beam.

    D psi'' + k G H (w' - psi) = rho I psi_tt,    k G H (w'' - psi') = rho H w_tt

with deflection w, rotation psi, I = H^3/12, D = E I/(1 - nu^2) (plane strain) and the shear correction k = 5/6: that of
the parabolic shear stress in a strip (Reissner), which plane strain leaves as it is. Frequencies are the zeros of the
determinant of the four conditions at the ends. Modes above the cut-off sqrt(k G H/(rho I)), where both waves along the
beam propagate, are left out: they are shorter than about 1.6 H, and no beam theory holds there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from comparison.exact_beam import Array, Beam

SHEAR_CORRECTION = 5 / 6


@dataclass(frozen=True)
class TimoshenkoBeam(Beam):
    """Clamped-free or clamped-clamped, as Beam. Asking for more modes than lie below the cut-off raises ValueError."""

    @property
    def shear_stiffness(self) -> float:
        """k G H, N per metre of depth."""
        return SHEAR_CORRECTION * self.youngs_modulus / (2 * (1 + self.poisson_ratio)) * self.thickness

    @property
    def rotary_inertia(self) -> float:
        """rho I, kg m per metre of depth."""
        return self.density * self.thickness**3 / 12

    @property
    def cut_off(self) -> float:
        """rad/s"""
        return math.sqrt(self.shear_stiffness / self.rotary_inertia)

    def _wave_numbers(self, omega: Array) -> tuple[Array, Array]:
        """alpha of the waves exp(+-alpha x) and beta of cos, sin (beta x), 1/m, below the cut-off."""
        d, s = self.bending_stiffness, self.shear_stiffness
        half = 0.5 * omega**2 * (self.mass_per_length / s + self.rotary_inertia / d)
        product = self.mass_per_length * omega**2 * (s - self.rotary_inertia * omega**2) / (d * s)
        root = np.sqrt(half**2 + product)
        # alpha^2 = root - half, without the difference of two nearly equal numbers close to the cut-off.
        return np.sqrt(product / (root + half)), np.sqrt(root + half)

    def _basis(self, omega: Array, x: Array) -> tuple[Array, Array, Array, Array]:
        """w, psi and their slopes w', psi' of the four waves, arrays [..., 4]; omega and x are broadcast. The waves are
        exp(-alpha x), exp(alpha (x - L)), cos(beta x) and sin(beta x)."""
        omega, x = np.broadcast_arrays(np.asarray(omega, dtype=float), np.asarray(x, dtype=float))
        alpha, beta = self._wave_numbers(omega)
        inertia = self.mass_per_length * omega**2 / self.shear_stiffness
        g_alpha, g_beta = (alpha**2 + inertia) / alpha, (beta**2 - inertia) / beta
        down, up = np.exp(-alpha * x), np.exp(alpha * (x - self.length))
        c, s = np.cos(beta * x), np.sin(beta * x)
        w = np.stack([down, up, c, s], axis=-1)
        psi = np.stack([-g_alpha * down, g_alpha * up, -g_beta * s, g_beta * c], axis=-1)
        w_slope = np.stack([-alpha * down, alpha * up, -beta * s, beta * c], axis=-1)
        psi_slope = np.stack([alpha * g_alpha * down, alpha * g_alpha * up, -beta * g_beta * c, -beta * g_beta * s], axis=-1)
        return w, psi, w_slope, psi_slope

    def _end_conditions(self, omega: Array) -> Array:
        """The matrices [..., condition, wave] whose determinant vanishes at a natural frequency; rows of like size."""
        w0, psi0, _, _ = self._basis(omega, 0.0)
        w, psi, w_slope, psi_slope = self._basis(omega, self.length)
        scale = 1 / self._wave_numbers(np.asarray(omega, dtype=float))[1][..., None]
        if self.is_cantilever:
            rows = [w0, psi0 * scale, psi_slope * scale**2, (w_slope - psi) * self.shear_stiffness
                    / self.bending_stiffness * scale**3]
        else:
            rows = [w0, psi0 * scale, w, psi * scale]
        return np.stack(rows, axis=-2)

    def angular_frequencies(self, count: int) -> Array:
        """The lowest ones, rad/s."""
        return _natural_frequencies(self, count).copy()

    def _waves_of_modes(self, count: int) -> tuple[Array, Array]:
        """Frequencies and each mode's amplitudes of the four waves [mode, wave], normalised as shapes() says."""
        omega = self.angular_frequencies(count)
        # The last right singular vector spans the matrix's null space.
        waves = np.linalg.svd(self._end_conditions(omega))[2][:, -1, :]
        x, weights = _quadrature(self.length, count)
        w, psi, _, _ = self._basis(omega[:, None], x[None, :])
        w, psi = (np.einsum("mxk,mk->mx", part, waves) for part in (w, psi))
        mass = (self.mass_per_length * w**2 + self.rotary_inertia * psi**2) @ weights
        sign = np.sign(w[:, -1])  # positive near the far end
        return omega, waves * (sign * np.sqrt(self.mass / mass))[:, None]

    def fields(self, count: int, x: Array) -> tuple[Array, Array, Array, Array]:
        """w, psi, w', psi' of the modes, each [mode, place]."""
        omega, waves = self._waves_of_modes(count)
        place = np.clip(np.asarray(x, dtype=float), 0.0, self.length)
        parts = self._basis(omega[:, None], place[None, :])
        w, psi, w_slope, psi_slope = (np.einsum("mxk,mk->mx", part, waves) for part in parts)
        return w, psi, w_slope, psi_slope

    def shapes(self, count: int, x: Array) -> Array:
        """Deflections w [mode, place], normalised so that every mode's mass, the integral of rho H w^2 + rho I psi^2,
        is the beam's."""
        return self.fields(count, x)[0]


def _quadrature(length: float, modes: int) -> tuple[Array, Array]:
    """Gauss-Legendre points and weights that integrate products of the modes to rounding."""
    points, weights = np.polynomial.legendre.leggauss(20 * modes + 60)
    return 0.5 * length * (points + 1), 0.5 * length * weights


@lru_cache(maxsize=64)
def _natural_frequencies(beam: TimoshenkoBeam, count: int) -> Array:
    def determinant(omega: Array) -> Array:
        return np.linalg.det(beam._end_conditions(omega))  # noqa: SLF001

    # In x = L (m omega^2/D)^(1/4) Euler-Bernoulli's roots lie pi apart, and shear moves them closer: steps of 0.02 part them.
    to_x = beam.length * (beam.mass_per_length / beam.bending_stiffness) ** 0.25
    grid = np.arange(0.5, to_x * math.sqrt(beam.cut_off * (1 - 1e-9)), 0.02)
    values = determinant((grid / to_x) ** 2)
    rows = np.flatnonzero(np.sign(values[:-1]) != np.sign(values[1:]))[:count]
    if len(rows) < count:
        raise ValueError(f"only {len(rows)} modes of the Timoshenko beam lie below its cut-off, not {count}")
    low, high = (grid[rows] / to_x) ** 2, (grid[rows + 1] / to_x) ** 2
    sign = np.sign(values[rows])
    for _ in range(80):
        middle = 0.5 * (low + high)
        is_before = np.sign(determinant(middle)) == sign
        low, high = np.where(is_before, middle, low), np.where(is_before, high, middle)
    return 0.5 * (low + high)
