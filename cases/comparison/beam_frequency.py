"""At which frequency a particles' beam swings, and how fast that dies out.

Two ways. A free vibration is a damped sinusoid, fitted by least squares to the deflection (fit_damped_sinusoid). After an
impact a long beam is watched for less than half a period and its higher modes are strong, so that a sinusoid through the
tip's deflection says little; there the amplitude of the first mode, by projection of the snapshots' displacements and
velocities on the exact mode shape, is compared with a damped oscillator that the run's recorded impulses drive from rest
(first_mode): frequency and damping are the only unknowns, and the drop's mass, as it acts through these impulses alone,
does not enter.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from comparison.beam_quantities import BeamSections
from comparison.exact_beam import Array
from modal_beam import beam_of, recorded_impulses
from sphdrop_reader import Run


@dataclass(frozen=True)
class Ringing:
    """Of exp(-decay t) cos(angular_frequency t + phase); residual: root mean square of what the fit leaves over that of
    the data."""

    angular_frequency: float  # rad/s
    decay: float              # 1/s
    residual: float

    @property
    def period(self) -> float:
        """s"""
        return 2 * math.pi / self.angular_frequency

    @property
    def energy_loss_per_period(self) -> float:
        """Share of the energy, which goes as the amplitude's square."""
        return 1 - math.exp(-2 * self.decay * self.period)


def _minimise(misfit: Callable[[Array, Array], Array], about: float) -> Ringing:
    """The least misfit(omega [n], decay [n]) with omega from 0.4 to 1.6 of `about` and decay from -0.05 to 0.3 of it: a
    grid that closes in on its best point."""
    omega, omega_half = about, 0.6 * about
    decay, decay_half = 0.125 * about, 0.175 * about
    points = 25  # wide enough at first for the misfit's several hollows in omega
    while omega_half > 1e-9 * about:
        trial = np.meshgrid(omega + omega_half * np.linspace(-1, 1, points), decay + decay_half * np.linspace(-1, 1, 9))
        trial_omega, trial_decay = (axis.ravel() for axis in trial)
        values = misfit(trial_omega, trial_decay)
        best = int(np.argmin(values))
        omega, decay = float(trial_omega[best]), float(trial_decay[best])
        omega_half, decay_half = omega_half * 0.4, decay_half * 0.5
        points = 9
    return Ringing(omega, decay, float(values[best]))


def fit_damped_sinusoid(times: Array, values: Array, about: float, rows: int = 600) -> Ringing:
    """Least squares over frequency and decay; amplitude and phase follow for each pair. `about`: the frequency expected,
    rad/s. A swing about another place than 0 is fitted with an offset once 1.5 periods of `about` are watched; over a
    shorter time the offset and the frequency could not be told apart. At most `rows` rows, evenly chosen, are used."""
    chosen = np.unique(np.linspace(0, len(times) - 1, min(rows, len(times))).astype(int))
    t, y = times[chosen] - times[chosen[0]], values[chosen]
    offset = [np.ones_like(t)] if t[-1] * about > 1.5 * 2 * math.pi else []
    size = math.sqrt(np.mean(y**2))

    def misfit(omega: Array, decay: Array) -> Array:
        found = []
        for w, g in zip(omega, decay):
            swing = np.exp(-g * t)
            basis = np.stack([swing * np.cos(w * t), swing * np.sin(w * t), *offset], axis=1)
            q, _ = np.linalg.qr(basis)
            found.append(math.sqrt(np.mean((y - q @ (q.T @ y)) ** 2)) / size)
        return np.array(found)

    return _minimise(misfit, about)


def first_mode_amplitude(run: Run) -> tuple[Array, Array, Array]:
    """Times of the snapshots, the first mode's amplitude q (m) in the mean vertical displacements of the beam's sections,
    and its rate (m/s). The mode is Euler-Bernoulli's, with a mean square of 1, and sections weigh alike."""
    sections = BeamSections(run)
    shape = beam_of(run).shapes(1, sections.places)[0]
    weights = shape / (shape @ shape)
    q = np.array([weights @ sections.displacement(snapshot)[:, 1] for snapshot in run.snapshots])
    v = np.array([weights @ sections.velocity(snapshot)[:, 1] for snapshot in run.snapshots])
    return run.snapshots.times, q, v


def driven_oscillator(times: Array, modal_impulse: Array, mass: float, omega: Array, decay: Array) -> tuple[Array, Array]:
    """q and its rate [time, trial] of oscillators of damped frequencies omega and decays [trial], from rest, under an
    impulse so far [time] (N s/m) that grows evenly between the times; exact."""
    q, v = np.zeros((len(times), len(omega))), np.zeros((len(times), len(omega)))
    stiffness = mass * (omega**2 + decay**2)
    for k in range(1, len(times)):
        dt = times[k] - times[k - 1]
        static = (modal_impulse[k] - modal_impulse[k - 1]) / dt / stiffness
        c, s = np.cos(omega * dt), np.sin(omega * dt)
        fading = np.exp(-decay * dt)
        away, slope = q[k - 1] - static, (v[k - 1] + decay * (q[k - 1] - static)) / omega
        q[k] = static + fading * (away * c + slope * s)
        v[k] = fading * ((slope * omega - decay * away) * c - (away * omega + decay * slope) * s)
    return q, v


def fit_driven_oscillator(times: Array, q: Array, v: Array, impulse_times: Array, modal_impulse: Array, mass: float,
                          about: float, substeps: int = 10) -> Ringing:
    """The oscillator that, driven by the impulse (recorded so far at impulse_times), comes nearest to q and v / about at
    the times; see first_mode(). `substeps` parts of each interval see an even force."""
    steps = [np.linspace(a, b, substeps, endpoint=False) for a, b in zip(times[:-1], times[1:])]
    fine = np.concatenate([*steps, times[-1:]])
    impulse = np.interp(fine, impulse_times, modal_impulse)
    size = math.sqrt(np.mean(q**2) + np.mean((v / about) ** 2))

    def misfit(omega: Array, decay: Array) -> Array:
        trial_q, trial_v = (part[::substeps] for part in driven_oscillator(fine, impulse, mass, omega, decay))
        error = np.mean((trial_q - q[:, None]) ** 2 + ((trial_v - v[:, None]) / about) ** 2, axis=0)
        return np.sqrt(error) / size

    return _minimise(misfit, about)


@lru_cache(maxsize=None)
def first_mode(run: Run) -> Ringing:
    """Frequency and decay of the beam's first mode from the whole run, drop and all; see the head of this file. The
    run's snapshots must be close enough: 20 of them in a period are plenty."""
    beam = beam_of(run)
    times, q, v = first_mode_amplitude(run)
    impulse_times, impulses, places = recorded_impulses(run, beam.length)
    modal_impulse = np.cumsum(impulses * beam.shapes(1, places)[0])
    about = float(beam.angular_frequencies(1)[0])
    return fit_driven_oscillator(times, q, v, impulse_times, modal_impulse, beam.mass, about)
