"""The exact beam with its stretching: what holding both ends adds where the deflection is not small against the thickness.

A beam that is clamped at both ends and bent by w must be longer by 1/2 int w'^2 dx; the tension that this takes,

    N = E H/(1 - nu^2) 1/(2 L) int_0^L w'^2 dx,

pulls it straight again (plane strain; axial waves cross the beam in a fiftieth of its first period, so that N is the same
all along it). In the modes of Beam, w = sum q_n phi_n,

    M_b (q_n'' + omega_n^2 q_n) + N sum_m K_nm q_m = f_n,    K_nm = int phi_n' phi_m' dx.

In the first mode N adds about 3/4 (w/H)^2 of the bending's stiffness (A. H. Nayfeh, D. T. Mook, "Nonlinear Oscillations",
1979, ch. 7). A cantilever's free end gives way, and nothing is added.
"""

from __future__ import annotations

import math

import numpy as np
from comparison.exact_beam import Array, Beam
from modal_beam import beam_of, recorded_impulses
from sphdrop_reader import Run

MODES = 8
STEPS_IN_PERIOD = 40  # of the highest mode


def slope_products(beam: Beam, count: int) -> Array:
    """K [mode, mode], 1/m."""
    x = np.linspace(0.0, beam.length, 4001)
    slopes = np.gradient(beam.shapes(count, x), x, axis=1, edge_order=2)
    weights = np.full(len(x), x[1] - x[0])
    weights[[0, -1]] *= 0.5
    return (slopes * weights) @ slopes.T


def stretched_motion(beam: Beam, times: Array, modal_impulses: Array, start: Array | None = None) -> Array:
    """Amplitudes [time, mode] in m from rest, or from amplitudes `start`, under impulses [time, mode] (N s/m) that act evenly
    over the intervals which end at the times. Bending is exact; the tension kicks before and after each step of it."""
    modes = modal_impulses.shape[1]
    omega = beam.angular_frequencies(modes)
    products = slope_products(beam, modes)
    axial = 0.0 if beam.is_cantilever else beam.youngs_modulus * beam.thickness / (1 - beam.poisson_ratio**2)
    q, v = np.zeros(modes) if start is None else np.array(start, dtype=float), np.zeros(modes)
    found = [q]
    for k in range(1, len(times)):
        interval = times[k] - times[k - 1]
        steps = max(1, math.ceil(interval * omega[-1] / (2 * math.pi) * STEPS_IN_PERIOD))
        dt = interval / steps
        static = modal_impulses[k] / interval / (beam.mass * omega**2)
        c, s = np.cos(omega * dt), np.sin(omega * dt)
        for _ in range(steps):
            v = v - 0.5 * dt * _tension_pull(q, products, axial, beam)
            away = q - static
            q, v = static + away * c + v / omega * s, v * c - away * omega * s
            v = v - 0.5 * dt * _tension_pull(q, products, axial, beam)
        found.append(q)
    return np.array(found)


def _tension_pull(q: Array, products: Array, axial: float, beam: Beam) -> Array:
    """N K q/M_b, m/s^2."""
    pull = products @ q
    return axial * 0.5 * float(q @ pull) / beam.length * pull / beam.mass


def stretched_deflection(run: Run, modes: int = MODES) -> Array:
    """What the run's deflection would be for that beam under the run's contact force, m, at the history's times."""
    beam = beam_of(run)
    times, impulses, places = recorded_impulses(run, beam.length)
    probe = beam.length if beam.is_cantilever else 0.5 * beam.length
    modal_impulses = (beam.shapes(modes, places) * impulses).T
    return stretched_motion(beam, times, modal_impulses) @ beam.shapes(modes, np.array([probe]))[:, 0]
