"""How long runs will take: particles times steps, at the rate at which runs went before."""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

# Wall time in seconds for a particle and a step on one rank, until runs have shown it.
USUAL_RATE = 7e-8
CELL_SHARE = 0.1  # of a particle's cost: that of one of a beam of cells


def particle_steps(case: Mapping[str, Any]) -> float:
    """About how many particles times steps a case takes, from its parameters; what is not given has its default. A beam of
    cells counts less, as it costs less."""
    drop, solid, time, fluid = (case.get(name, {}) for name in ("drop", "solid", "time", "fluid"))
    spacing = case["resolution"]["spacing"]
    smoothing = case["resolution"].get("smoothing_ratio", 1.2) * spacing
    diameter, shape, kind = drop.get("diameter", 1e-3), drop.get("shape", "round"), solid.get("kind", "none")

    area = {"none": 0.0, "square": 1.0}.get(shape, math.pi / 4) * diameter**2
    is_modern = case.get("mode") == "modern"
    sound_speed = liquid_sound = fluid.get("sound_speed", 50.0) if shape != "none" else 0.0
    if kind == "rigid_wall":
        area += 3 * spacing * solid.get("length", 8 * diameter)
    elif kind != "none":
        area += solid["length"] * solid.get("thickness", 0.25e-3) * (CELL_SHARE if is_modern else 1.0)
        bulk_modulus = solid.get("youngs_modulus", 300e6) / (3 * (1 - 2 * solid.get("poisson_ratio", 0.3)))
        sound_speed = max(sound_speed, math.sqrt(bulk_modulus / solid.get("density", 1000.0)))
    cfl = min(0.4, 0.2 * sound_speed / liquid_sound if liquid_sound else 0.4) if is_modern else 0.1
    step = time.get("step", 0.0) or time.get("sound_cfl", cfl) * smoothing / sound_speed
    return area / spacing**2 * time["end"] / step


def rate_of(runs: Iterable[Mapping[str, Any]], ranks: int) -> float:
    """Wall time in s for a particle and a step on so many ranks: the median of finished runs (their run.json)."""
    rates = []
    for run in runs:
        details = run.get("details", {})
        work = details.get("particles", 0) * details.get("steps", 0)
        if run.get("status") == "completed" and work > 0:
            rates.append(run["wall_time_seconds"] * run.get("ranks", 1) / work)
    return (statistics.median(rates) if rates else USUAL_RATE) / ranks


def reached_time(history: Path) -> float:
    """The simulated time in s that a run has reached: the last full row of its history.csv; 0 without one."""
    try:
        with history.open("rb") as stream:
            stream.seek(0, 2)
            stream.seek(max(0, stream.tell() - 8192))
            lines = stream.read().decode("utf-8", errors="replace").split("\n")[:-1]
        return float(lines[-1].split(",")[0])
    except (OSError, ValueError, IndexError):
        return 0.0


def in_words(seconds: float) -> str:
    """A duration as a person says it: 45 s, 12 min, 3 h 20 min."""
    if seconds < 99.5:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 100 else f"{minutes // 60} h {minutes % 60:02d} min"
