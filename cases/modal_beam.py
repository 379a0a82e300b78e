"""The exact beam under a run's recorded contact force: the check that separates the coupling from the solid.

    python3 cases/modal_beam.py RUN [--output FILE.png] [--modes N]

Euler-Bernoulli modes of the clamped-free or clamped-clamped beam, in plane strain, are driven by the impulses that the
run's history recorded, at the place where they acted (angular over vertical impulse). Drawn beside it is the run's own
deflection. What differs between the two is the particles' beam; what both share is the coupling.
"""

from __future__ import annotations

import argparse
import math
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "io"))
from sphdrop_reader import ResultError, Run  # noqa: E402

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Beam:
    """A beam of rectangular section per metre of depth, SI units; clamped at 0 and, unless a cantilever, at `length`."""

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
        return self.density * self.thickness

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

    def respond(self, times: Array, impulses: Array, places: Array, probe: float, modes: int) -> Array:
        """Deflection at `probe` (m) at the given times, from rest; impulses[k] (N s/m) acts at places[k] over the
        interval that ends at times[k], evenly: each mode is integrated exactly over it."""
        omega = self.angular_frequencies(modes)
        modal_mass = self.mass_per_length * self.length
        at_probe = self.shapes(modes, np.array([probe]))[:, 0]
        at_places = self.shapes(modes, places)
        q, v = np.zeros(modes), np.zeros(modes)
        deflection = np.zeros(len(times))
        for k in range(1, len(times)):
            dt = times[k] - times[k - 1]
            static = at_places[:, k] * impulses[k] / dt / (modal_mass * omega**2)
            c, s = np.cos(omega * dt), np.sin(omega * dt)
            q, v = static + (q - static) * c + v / omega * s, -(q - static) * omega * s + v * c
            deflection[k] = at_probe @ q
        return deflection


def beam_of(run: Run) -> Beam:
    """The run's beam. Raises ResultError if its solid is none."""
    solid = tomllib.loads(run.case_text)["solid"]
    if solid["kind"] not in ("cantilever", "fixed_fixed_beam"):
        raise ResultError(f"{run.directory}: solid.kind is {solid['kind']}: there is no beam to compare with")
    names = ("length", "thickness", "youngs_modulus", "poisson_ratio", "density")
    return Beam(**{name: float(solid[name]) for name in names}, is_cantilever=solid["kind"] == "cantilever")


def recorded_impulses(run: Run, length: float) -> tuple[Array, Array, Array]:
    """Times, vertical impulses between them, and where these acted (clipped to the beam)."""
    times = run.history["time"]
    impulses = np.diff(run.history["contact_impulse_y"], prepend=0.0)
    moments = np.diff(run.history["contact_angular_impulse"], prepend=0.0)
    scale = np.abs(impulses).max(initial=0.0)
    acts = np.abs(impulses) > 1e-9 * scale if scale > 0 else np.zeros(len(times), dtype=bool)
    places = np.where(acts, moments / np.where(acts, impulses, 1.0), length)
    return times, impulses, np.clip(places, 0.0, length)


def modal_deflection(run: Run, modes: int = 12) -> Array:
    """What the run's deflection would be for the exact beam under the run's contact force, m, at the history's times."""
    beam = beam_of(run)
    times, impulses, places = recorded_impulses(run, beam.length)
    probe = beam.length if beam.is_cantilever else 0.5 * beam.length
    return beam.respond(times, impulses, places, probe, modes)


def main() -> int:
    parser = argparse.ArgumentParser(description="The exact beam under a run's recorded contact force.")
    parser.add_argument("run", type=Path, help="folder of the run")
    parser.add_argument("--output", type=Path, help="picture (default: modal_beam.png in the run's folder)")
    parser.add_argument("--modes", type=int, default=12, help="modes of the beam (default: 12)")
    arguments = parser.parse_args()
    try:
        run = Run(arguments.run)
        exact = modal_deflection(run, arguments.modes)
    except ResultError as error:
        print(f"modal_beam.py: {error}", file=sys.stderr)
        return 2

    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    times, own = run.history["time"], run.history["deflection"]
    figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
    axes.plot(1e3 * times, 1e3 * own, label="sphdrop", color="#1560a8")
    axes.plot(1e3 * times, 1e3 * exact, "--", label="exact beam, same contact force", color="#c33a22")
    axes.set(xlabel="time (ms)", ylabel="deflection (mm)")
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    output = arguments.output or arguments.run / "modal_beam.png"
    figure.savefig(output, dpi=150)
    for name, values in (("sphdrop", own), ("exact beam", exact)):
        deepest = int(np.argmin(values))
        print(f"{name:<11} deepest {-1e3 * values[deepest]:.4f} mm at {1e3 * times[deepest]:.3f} ms")
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
