"""What the energies and momenta of a run add up to, and what is left over.

Energies are per metre of depth (J/m). Every number of a Ledger is a share of what the run began with, so that runs of any
speed and size compare.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sphdrop_reader import ResultError, Run

Array = NDArray[np.float64]

# Stored or moving, given away, and put in from outside the equations of motion. Each with its name in a legend.
STORED = {"kinetic_fluid": "kinetic, drop", "kinetic_solid": "kinetic, solid", "elastic": "elastic",
          "compressive": "compressive", "surface": "surface", "adhesion": "adhesion", "contact": "contact", "gravity": "gravity",
          "gauge": "gauge pressure"}
DISSIPATED = {"dissipated_fluid": "dissipated, drop", "dissipated_solid": "dissipated, solid",
              "dissipated_contact": "dissipated, contact"}
INJECTED = {"density_correction": "density correction", "artificial_stress_work": "artificial stress",
            "reconnection": "curves detected anew", "gauge_adjustment": "gauge adjustment", "shifting_work": "shifting",
            "sharing_work": "sharing of tension"}


@dataclass(frozen=True)
class Ledger:
    """What does not add up in a run. NaN where a run has nothing of the kind."""

    energy_scale: float       # J/m: the kinetic energy at the start or, from rest, the largest change of one energy
    unaccounted: float        # largest |unaccounted energy| over the run / energy_scale
    rise: float               # largest rise of (total - what named causes put in) / energy_scale
    momentum_scale: float     # kg/s: m U0
    momentum_mismatch: float  # |drop's change + impulse on the solid - impulse of gravity| at the end / m U0
    angular_mismatch: float   # the same of angular momentum about the origin / (m U0 D0)


def column(run: Run, name: str) -> Array:
    """A column of the history; zeros where the run has none, or has no value."""
    history = run.history
    return np.nan_to_num(history[name]) if name in history else np.zeros_like(history["time"])


def energy_scale(run: Run) -> float:
    """The kinetic energy at the start or, if the run starts at rest, the largest change of any one energy (J/m)."""
    moving = column(run, "kinetic_fluid") + column(run, "kinetic_solid")
    if moving[0] > 0:
        return float(moving[0])
    return max(float(np.ptp(column(run, name))) for name in STORED)


def largest_rise(values: Array) -> float:
    """By how much the values get above the least of those before."""
    return float(np.max(values - np.minimum.accumulate(values)))


def drop_mass(case: Mapping[str, Any]) -> float:
    """kg per metre of depth, by the drop's shape; 0 if there is none."""
    drop = case["drop"]
    if drop["shape"] == "none":
        return 0.0
    density = drop["density"] if drop.get("material") == "rigid" else case["fluid"]["density"]
    return density * drop["diameter"] ** 2 * (math.pi / 4 if drop["shape"] == "round" else 1.0)


def momentum_residual(run: Run, case: Mapping[str, Any]) -> tuple[Array, Array]:
    """Over time, x and y (kg/s): the drop's change of momentum + the impulse on the solid - the impulse of gravity."""
    gravity = case["gravity"]["acceleration"]
    weight = drop_mass(case) * column(run, "time")
    x, y = (column(run, f"momentum_fluid_{axis}") for axis in "xy")
    return (x - x[0] + column(run, "contact_impulse_x") - gravity[0] * weight,
            y - y[0] + column(run, "contact_impulse_y") - gravity[1] * weight)


def angular_residual(run: Run, case: Mapping[str, Any]) -> Array:
    """The same of the angular momentum about the origin (kg m/s). Gravity's moment is summed by the trapezoidal rule."""
    gravity = case["gravity"]["acceleration"]
    moment = drop_mass(case) * (column(run, "drop_centre_x") * gravity[1] - column(run, "drop_centre_y") * gravity[0])
    steps = 0.5 * (moment[1:] + moment[:-1]) * np.diff(column(run, "time"))
    spin = column(run, "angular_momentum_fluid")
    return spin - spin[0] + column(run, "contact_angular_impulse") - np.concatenate([[0.0], np.cumsum(steps)])


def ledger_of(run: Run) -> Ledger:
    """The numbers of a run. Raises ResultError if it lacks its history or its case."""
    try:
        case = tomllib.loads(run.case_text)
    except tomllib.TOMLDecodeError as error:
        raise ResultError(f"{run.directory / 'case.cfg'}: {error}") from error
    scale = energy_scale(run)
    injected = sum((column(run, name) for name in INJECTED), np.zeros_like(column(run, "time")))

    momentum_scale = momentum = angular = math.nan
    mass = drop_mass(case)
    if mass > 0:
        moving = column(run, "kinetic_fluid")
        momentum_scale = math.sqrt(2 * mass * (moving[0] if moving[0] > 0 else moving.max()))
        x, y = momentum_residual(run, case)
        momentum = _share(math.hypot(x[-1], y[-1]), momentum_scale)
        angular = _share(abs(float(angular_residual(run, case)[-1])), momentum_scale * case["drop"]["diameter"])
    return Ledger(scale, _share(float(np.abs(run.history["unaccounted"]).max()), scale),
                  _share(largest_rise(run.history["total"] - injected), scale), momentum_scale, momentum, angular)


def _share(value: float, whole: float) -> float:
    return value / whole if whole > 0 else math.nan
