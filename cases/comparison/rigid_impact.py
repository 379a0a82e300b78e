"""A rigid mass that strikes an exact beam: what theory says of a ball, bounces and all.

The beam's modes q_k and the mass's height y move by

    M_b (q_k'' + omega_k^2 q_k) = -phi_k(x) F,    m y'' = F,    F = k max(0, w - y),    w = sum_k phi_k(x) q_k

with the mode shapes phi_k of comparison.exact_beam and a contact that only pushes, without friction. No energy is lost:
what the mass does not get back stays in the beam's modes. The spring k stands for what gives way at the place of contact.
How deep the beam is bent hardly depends on it, nor on the number of modes, as long as the first blow is short against the
first period; how the impulse is split into blows does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from comparison.exact_beam import Array, Beam


@dataclass(frozen=True)
class RigidImpact:
    """Over time in s: the free end's (or mid-span's) deflection in m, the mass's velocity in m/s (upwards positive), and the
    impulse on the beam so far in N s/m (downwards negative). Velocity and impulse are those half a step later."""

    times: Array
    deflection: Array
    velocity: Array
    impulse: Array


def rigid_impact(beam: Beam, mass: float, speed: float, place: float, end: float, modes: int = 24,
                 stiffness: float | None = None, step: float | None = None) -> RigidImpact:
    """A mass (kg/m) that meets the beam at rest with `speed` (m/s, downwards) at `place` (m from the clamp) at time 0, until
    `end` (s). `stiffness` is k in N/m per metre of depth, the beam's E/(1 - nu^2) unless given: about what a ball's
    indentation of an elastic half-plane amounts to. Leap-frog, by default ten steps to a radian of the fastest motion."""
    omega = beam.angular_frequencies(modes)
    shape = beam.shapes(modes, np.array([place]))[:, 0]
    probe = beam.shapes(modes, np.array([beam.length if beam.is_cantilever else 0.5 * beam.length]))[:, 0]
    k = beam.youngs_modulus / (1 - beam.poisson_ratio**2) if stiffness is None else stiffness
    if step is None:
        fastest = np.sqrt(omega[-1] ** 2 + k * (1 / mass + shape @ shape / beam.mass))
        step = 1 / (10 * float(fastest))
    count = int(np.ceil(end / step))
    push, restore = shape * step / beam.mass, omega**2 * step

    q, rate = np.zeros(modes), np.zeros(modes)
    height, velocity, impulse = 0.0, -speed, 0.0
    deflections, velocities, impulses = np.zeros(count + 1), np.full(count + 1, -speed), np.zeros(count + 1)
    for row in range(1, count + 1):
        # Velocities are half a step behind; at rest and out of contact the first half kick is nothing.
        height += step * velocity
        q += step * rate
        overlap = float(shape @ q) - height
        force = k * overlap if overlap > 0.0 else 0.0
        velocity += step * force / mass
        rate -= restore * q + push * force
        impulse -= step * force
        deflections[row], velocities[row], impulses[row] = probe @ q, velocity, impulse
    return RigidImpact(step * np.arange(count + 1), deflections, velocities, impulses)
