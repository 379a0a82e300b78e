"""What a run was and what came out of it, as lines of a table."""

from __future__ import annotations

import math
import tomllib
from typing import Any

import numpy as np
from sphdrop_reader import ResultError, Run

MILLI = 1e3


def number(value: float, unit: str = "", digits: int = 4) -> str:
    """With `digits` significant digits; a dash for what is not there."""
    if not math.isfinite(value):
        return "–"
    return f"{value:.{digits}g} {unit}".strip()


def case_of(run: Run) -> dict[str, Any]:
    """The case as it was run; empty if it was not kept."""
    try:
        return tomllib.loads(run.case_text)
    except (ResultError, tomllib.TOMLDecodeError):
        return {}


def title_of(run: Run) -> str:
    """The run's name; its folder's where the case is not there."""
    return str(case_of(run).get("name", run.directory.name))


def bodies_of(case: dict[str, Any], section: str) -> list[dict[str, Any]]:
    """The drops or solids of a case, one or several."""
    found = case.get(section, {})
    return found if isinstance(found, list) else [found]


def set_up(run: Run) -> list[tuple[str, str]]:
    """What was asked for, and the numbers that decide what happens."""
    case = case_of(run)
    lines = []
    for drop in bodies_of(case, "drop"):
        lines += set_up_of_drop(drop, case)
    for solid in bodies_of(case, "solid"):
        if solid.get("kind", "none") in ("cantilever", "fixed_fixed_beam"):
            lines.append(("beam", f"{solid['kind'].replace('_', ' ')}, L = {number(solid['length'] * MILLI, 'mm')}, "
                                  f"H = {number(solid['thickness'] * MILLI, 'mm')}, E = {number(solid['youngs_modulus'] / 1e6, 'MPa')}"))
        elif solid.get("kind", "none") == "polygon":
            lines.append(("solid", f"polygon of {len(solid['polygon'])} corners, {number(solid['length'] * MILLI, 'mm')} long, "
                                   f"E = {number(solid['youngs_modulus'] / 1e6, 'MPa')}"))
        elif solid.get("kind", "none") != "none":
            lines.append(("solid", solid["kind"].replace("_", " ")))
    if "resolution" in case:
        lines.append(("spacing", number(case["resolution"]["spacing"] * MILLI, "mm")))
    return lines


def set_up_of_drop(drop: dict[str, Any], case: dict[str, Any]) -> list[tuple[str, str]]:
    fluid, lines = case.get("fluid", {}), []
    diameter = float(drop.get("diameter", 0))
    if drop.get("shape", "none") != "none" and diameter > 0:
        speed = math.hypot(*drop.get("velocity", [0, 0]))
        lines.append(("drop", f"{drop['shape']}, D0 = {number(diameter * MILLI, 'mm')}, U0 = {number(speed, 'm/s')}"))
        density, tension = float(fluid.get("density", 0)), float(case.get("surface_tension", {}).get("coefficient", 0))
        if tension > 0 and drop.get("material") != "rigid":
            # The paper's numbers: We with the drop's diameter.
            lines.append(("Weber number", number(density * speed**2 * diameter / tension, digits=3)))
        if float(fluid.get("viscosity", 0)) > 0 and speed > 0 and drop.get("material") != "rigid":
            # The artificial viscosity, several times water's, is not in it.
            by = "" if fluid.get("viscosity_form") == "physical" else " by fluid.viscosity"
            lines.append(("Reynolds number", number(density * speed * diameter / fluid["viscosity"], digits=3) + by))
    return lines


def outcome(run: Run) -> list[tuple[str, str]]:
    """What is measured of the history; only what the run has."""
    from comparison import beam_quantities, quantities

    try:
        history = run.history
    except ResultError:
        return []
    if "time" not in history or len(history["time"]) == 0:
        return []
    lines = [("simulated time", number(float(history["time"][-1]) * MILLI, "ms"))]

    def extreme(label: str, values: np.ndarray, sign: float) -> None:
        if np.any(np.nan_to_num(values)):
            time, value = quantities.highest_point(history["time"], sign * values)
            lines.append((label, f"{number(value * MILLI, 'mm')} at {number(time * MILLI, 'ms')}"))

    if "drop_width" in history and np.any(np.nan_to_num(history["drop_width"])):
        extreme("largest width D_max", history["drop_width"], 1)
        first = history["drop_width"][0]
        if first > 0:
            lines.append(("D_max/D at the start", number(float(np.nanmax(history["drop_width"])) / first)))
    if "deflection" in history:
        extreme("largest deflection", history["deflection"], -1)
    if {"contact_count", "contact_impulse_y"} <= set(history) and quantities.contact_interval(run):
        time, first = quantities.contact_time(run), beam_quantities.contact_time(run)
        lines.append(("contact time", number(time * MILLI, "ms") if math.isfinite(time) else "still in contact"))
        if math.isfinite(first) and not math.isclose(first, time, rel_tol=0.01):
            lines.append(("first parts after", number(first * MILLI, "ms")))
        lines.append(("99 % of the impulse by", number(quantities.impulse_time(run) * MILLI, "ms")))
        if "drop_velocity_y" in history:
            lines.append(("restitution", number(quantities.restitution(run), digits=3)))
    return lines


def provenance(run: Run) -> list[tuple[str, str]]:
    """Which program made it, when, on what, at what cost."""
    try:
        info = run.info
    except ResultError:
        return []
    lines = [("status", str(info.get("status", "unknown")))]
    for key, label in (("version", "version"), ("git_commit", "commit"), ("start", "start"), ("end", "end"), ("ranks", "ranks"),
                       ("state_hash", "state hash")):
        if key in info:
            lines.append((label, str(info[key])))
    if "compiler" in info.get("build", {}):
        lines.append(("compiler", info["build"]["compiler"]))
    details = info.get("details", {})
    seconds, steps, particles = (float(value) for value in (info.get("wall_time_seconds", math.nan), details.get("steps", math.nan),
                                                              details.get("particles", math.nan)))
    if math.isfinite(seconds):
        lines.append(("wall time", number(seconds, "s")))
    if math.isfinite(steps) and math.isfinite(particles):
        lines.append(("steps and particles", f"{steps:.0f} steps of {particles:.0f} particles"))
    return lines
