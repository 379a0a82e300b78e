"""The exact beam under a run's recorded contact force: the check that separates the coupling from the solid.

    python3 cases/modal_beam.py RUN [--output FILE.png] [--modes N]

The modes of the clamped-free or clamped-clamped beam, in plane strain, after Euler-Bernoulli and after Timoshenko (shear
and rotary inertia), are driven by the impulses that the run's history recorded, at the place where they acted (angular
over vertical impulse). Drawn beside them is the run's own deflection. What differs is the particles' beam; what all
share is the coupling.
"""

from __future__ import annotations

import argparse
import sys
import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "io"))
from comparison.exact_beam import Array, Beam  # noqa: E402
from comparison.timoshenko import TimoshenkoBeam  # noqa: E402
from figures import LINES, STYLE  # noqa: E402
from sphdrop_reader import ResultError, Run  # noqa: E402

MODES = 12


def beam_of(run: Run, theory: type[Beam] = Beam) -> Beam:
    """The run's beam. Raises ResultError if its solid is none."""
    solid = tomllib.loads(run.case_text)["solid"]
    if isinstance(solid, list):
        raise ResultError(f"{run.directory}: the case has {len(solid)} solids; a modal beam is one straight beam by itself")
    if solid["kind"] not in ("cantilever", "fixed_fixed_beam"):
        raise ResultError(f"{run.directory}: solid.kind is {solid['kind']}: there is no beam to compare with")
    names = ("length", "thickness", "youngs_modulus", "poisson_ratio", "density")
    return theory(**{name: float(solid[name]) for name in names}, is_cantilever=solid["kind"] == "cantilever")


def recorded_impulses(run: Run, length: float) -> tuple[Array, Array, Array]:
    """Times, vertical impulses between them, and where these acted (clipped to the beam)."""
    times = run.history["time"]
    impulses = np.diff(run.history["contact_impulse_y"], prepend=0.0)
    moments = np.diff(run.history["contact_angular_impulse"], prepend=0.0)
    scale = np.abs(impulses).max(initial=0.0)
    acts = np.abs(impulses) > 1e-9 * scale if scale > 0 else np.zeros(len(times), dtype=bool)
    places = np.where(acts, moments / np.where(acts, impulses, 1.0), length)
    return times, impulses, np.clip(places, 0.0, length)


def modal_deflection(run: Run, modes: int = MODES, theory: type[Beam] = Beam) -> Array:
    """What the run's deflection would be for the exact beam under the run's contact force, m, at the history's times."""
    beam = beam_of(run, theory)
    times, impulses, places = recorded_impulses(run, beam.length)
    probe = beam.length if beam.is_cantilever else 0.5 * beam.length
    return beam.respond(times, impulses, places, probe, modes)


def draw_check(deflections: Axes, residuals: Axes, run: Run, modes: int = MODES) -> None:
    """The run's deflection with those of the exact beams, and below how far it is from them; mm over ms."""
    times, own = 1e3 * run.history["time"], 1e3 * run.history["deflection"]
    deflections.plot(times, own, color=LINES[0], label="sphdrop")
    for number, (theory, name) in enumerate(((Beam, "Euler-Bernoulli"), (TimoshenkoBeam, "Timoshenko"))):
        exact = 1e3 * modal_deflection(run, modes, theory)
        # Where the two theories agree, the dashes of one show the other between them.
        line = {"color": LINES[1 + number], "dashes": (4, 2) if number == 0 else (1, 1.5)}
        deflections.plot(times, exact, **line, label=name)
        residuals.plot(times, own - exact, **line, label=f"sphdrop - {name}")
    deflections.set_ylabel("deflection  (mm)")
    residuals.set(xlabel="time  (ms)", ylabel="residual  (mm)")
    residuals.axhline(0.0, color="#5b6470", linewidth=0.6)


def main() -> int:
    parser = argparse.ArgumentParser(description="The exact beam under a run's recorded contact force.")
    parser.add_argument("run", type=Path, help="folder of the run")
    parser.add_argument("--output", type=Path, help="picture (default: modal_beam.png in the run's folder)")
    parser.add_argument("--modes", type=int, default=MODES, help=f"modes of the beam (default: {MODES})")
    arguments = parser.parse_args()
    try:
        run = Run(arguments.run)
        own = run.history["deflection"]
        exact = {"Euler-Bernoulli": modal_deflection(run, arguments.modes),
                 "Timoshenko": modal_deflection(run, arguments.modes, TimoshenkoBeam)}
        with plt.rc_context(STYLE):
            figure, axes = plt.subplots(2, 1, figsize=(6.4, 4.6), sharex=True, layout="constrained", height_ratios=[2, 1])
            draw_check(*axes, run, arguments.modes)
            axes[0].legend(title="exact: under the same contact force")
            output = arguments.output or arguments.run / "modal_beam.png"
            figure.savefig(output)
    except (ResultError, ValueError) as error:
        print(f"modal_beam.py: {error}", file=sys.stderr)
        return 2
    times = run.history["time"]
    for name, values in (("sphdrop", own), *exact.items()):
        deepest = int(np.argmin(values))
        print(f"{name:<15} deepest {-1e3 * values[deepest]:.4f} mm at {1e3 * times[deepest]:.3f} ms")
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
