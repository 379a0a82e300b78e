#!/usr/bin/python3
"""A rigid ball and a drop on the same cantilever: deflection, how the impulse is given, rebound (Fig. 24).

    /usr/bin/python3 cases/rigid_ball/plot.py results/comparison/paper/rigid_ball [--output DIR]
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison import quantities  # noqa: E402
from comparison.beam_figures import MILLI, Gallery, change_bars, history_lines, modal_checks, strip  # noqa: E402
from comparison.beam_quantities import case_of, deepest_deflection, lowest_point, rows_across, theory_of  # noqa: E402
from comparison.ledgers import drop_mass  # noqa: E402
from comparison.rigid_impact import RigidImpact, rigid_impact  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from comparison.timoshenko import TimoshenkoBeam  # noqa: E402
from figures import LINES, STYLE  # noqa: E402
from modal_beam import beam_of, modal_deflection  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from sphdrop_reader import Run  # noqa: E402

MICRO = 1e6
WORDS = {"ball": "rigid ball", "drop": "drop"}
THEORY = "#5b6470"


@dataclass(frozen=True)
class Blow:
    """An unbroken contact, as exact as the history's interval: s, s, N s/m (positive: on the beam, downwards)."""

    start: float
    end: float
    impulse: float


def blows(run: Run) -> list[Blow]:
    """The times in which the impulse grows from each row of the history to the next."""
    times, impulse = run.history["time"], -run.history["contact_impulse_y"]
    grows = np.concatenate([[False], np.diff(impulse) != 0, [False]])
    edges = np.flatnonzero(np.diff(grows.astype(int)))
    return [Blow(float(times[a]), float(times[b]), float(impulse[b] - impulse[a])) for a, b in zip(edges[::2], edges[1::2])]


def impact_momentum(run: Run) -> float:
    """m U0, N s/m"""
    case = case_of(run)
    return drop_mass(case) * -float(case["drop"]["velocity"][1])


@lru_cache(maxsize=4)
def elastic_impact(run: Run) -> RigidImpact:
    """The run's ball on the exact Timoshenko beam, without losses."""
    case = case_of(run)
    return rigid_impact(beam_of(run, TimoshenkoBeam), drop_mass(case), -float(case["drop"]["velocity"][1]),
                        float(case["drop"]["centre_x"]), float(case["time"]["end"]))


def rebound(run: Run) -> float:
    """Velocity of the ball's or drop's centre upwards after the last contact, m/s; NaN if it has not left."""
    return float(run.history["drop_velocity_y"][-1]) if quantities.has_left(run) else math.nan


def spin_change(run: Run) -> float:
    """Spin that the ball has gained over that of a ball rolling at U0."""
    case = case_of(run)
    rolling = -float(case["drop"]["velocity"][1]) / (0.5 * float(case["drop"]["diameter"]))
    return float(run.history["drop_spin"][-1] - run.history["drop_spin"][0]) / rolling


def energy_shares(run: Run) -> dict[str, float]:
    """At the run's end, over the energy of the start: in the ball or drop, in the beam, dissipated in the beam."""
    history = run.history
    start = history["kinetic_fluid"][0]
    return {"energy_kept": history["kinetic_fluid"][-1] / start,
            "energy_in_beam": (history["kinetic_solid"][-1] + history["elastic"][-1]) / start,
            "energy_dissipated_in_beam": history["dissipated_solid"][-1] / start}


def basic(run: Run) -> dict[str, float]:
    """What ball and drop, and variations of the ball, are told by: m, s, s, s, m/s, 1."""
    time, depth = deepest_deflection(run)
    return {"largest_deflection": depth, "deepest_at": time,
            "contact_time": quantities.contact_time(run), "impulse_time": quantities.impulse_time(run),
            "rebound_velocity": rebound(run), "restitution": quantities.restitution(run)}


def of_ball(run: Run) -> dict[str, float]:
    """What only a ball has: its first blow's impulse over m U0 and over all that it gives, blows, spin gained."""
    given = [blow.impulse for blow in blows(run)]
    found = {"spin_gained": spin_change(run)}
    if given:
        found["first_blow"] = given[0] / impact_momentum(run)
    if quantities.has_left(run):
        found |= {"first_blow_of_all": given[0] / sum(given), "blow_count": float(len(given))}
    return found


def measure(results: Results) -> dict[str, float]:
    """SI units; shares as numbers."""
    found: dict[str, float] = {}
    for name, run in results.items():
        found |= {f"{quantity}_{name}": value for quantity, value in basic(run).items()}
        if name != "drop":
            found |= {f"{quantity}_{name}": value for quantity, value in of_ball(run).items()}
        if name not in WORDS:
            continue
        if quantities.has_left(run):
            found |= {f"{quantity}_{name}": value for quantity, value in energy_shares(run).items()}
        exact_time, exact = lowest_point(run.history["time"], modal_deflection(run, theory=TimoshenkoBeam))
        found |= {f"exact_beam_deflection_{name}": -exact, f"exact_beam_deepest_at_{name}": exact_time}
    if "ball" in results:
        impact = elastic_impact(results["ball"])
        found["elastic_impact_deflection_ball"] = -float(impact.deflection.min())
        if quantities.has_left(results["ball"]):
            found["elastic_impact_rebound_ball"] = float(impact.velocity[-1])
    if {"ball", "drop"} <= set(results):
        found["deflection_ball_over_drop"] = found["largest_deflection_ball"] / found["largest_deflection_drop"]
    return {name: value for name, value in found.items() if math.isfinite(value)}


def draw_deflections(results: Results) -> Figure | None:
    runs = {name: results[name] for name in WORDS if name in results}
    if not runs:
        return None
    figure, axes = plt.subplots(figsize=(6.0, 3.4), layout="constrained")
    for (name, run), colour in zip(runs.items(), (LINES[1], LINES[0])):
        history_lines(axes, run, "deflection", MILLI, color=colour, label=WORDS[name])
        last = quantities.contact_interval(run)
        if last is not None and quantities.has_left(run):
            axes.plot(last[1] * MILLI, np.interp(last[1], run.history["time"], run.history["deflection"]) * MILLI, "o", ms=4,
                      color=colour)
    run = next(iter(runs.values()))
    if "ball" in runs:
        impact = elastic_impact(runs["ball"])
        axes.plot(impact.times[::50] * MILLI, impact.deflection[::50] * MILLI, color=THEORY, lw=1, dashes=(4, 2),
                  label="rigid mass on the exact beam")
    axes.axhline(-theory_of(run).largest_deflection * MILLI, color=THEORY, lw=1, dashes=(1, 1.5), label="Eq 46")
    axes.set(xlabel="time  (ms)", ylabel=r"$\delta$  (mm)", xlim=(0, run.history["time"][-1] * MILLI))
    axes.legend(title="dot: last contact", title_fontsize=7.5, ncols=2)
    return figure


def draw_impulse(results: Results) -> Figure | None:
    """Impulse and contact force over time."""
    runs = {name: results[name] for name in WORDS if name in results}
    if not runs:
        return None
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.1), layout="constrained")
    for (name, run), colour in zip(runs.items(), (LINES[1], LINES[0])):
        momentum, times = impact_momentum(run), run.history["time"]
        left.plot(times * MILLI, -run.history["contact_impulse_y"] / momentum, color=colour, label=WORDS[name])
        # The mean force over a window that blows and chatter are shorter than.
        window = 2e-5
        bins = np.arange(0.0, times[-1] + window, window)
        force = np.diff(np.interp(bins, times, -run.history["contact_impulse_y"])) / window
        right.stairs(force, bins * MILLI, color=colour, label=WORDS[name], lw=1)
    if "ball" in runs:
        impact = elastic_impact(runs["ball"])
        left.plot(impact.times[::50] * MILLI, -impact.impulse[::50] / impact_momentum(runs["ball"]), color=THEORY, lw=1,
                  dashes=(4, 2), label="rigid mass on the exact beam")
    left.set(xlabel="time  (ms)", ylabel="impulse / $m U_0$", xlim=(0, 4), ylim=(0, None))
    right.set(xlabel="time  (ms)", ylabel=r"contact force, mean over 20 $\mathrm{\mu}$s  (N/m)", xlim=(0, 4))
    right.set_yscale("symlog", linthresh=0.3, linscale=0.4)  # from one blow to the drop's pressure it is a hundredfold
    right.set_ylim(0, 100)
    left.legend(loc="lower right")
    return figure


def changes(results: Results) -> dict[str, dict[str, float]]:
    """variation -> quantity -> relative change against the ball at the same resolution."""
    main = results.get("ball_rows6") or results.get("ball")
    if main is None:
        return {}
    words = {"largest_deflection": r"$\delta_\mathrm{max}$", "deepest_at": "deepest at", "first_blow": "first blow",
             "impulse_time": "99 % of the impulse", "rebound_velocity": "rebound"}
    compared = {"half_step_rows6": "half the time step", "spin_rows6": "spin of 1600 rad/s", "ball_rows4": "4 rows",
                "ball": "10 rows"}
    told = {name: basic(run) | of_ball(run) for name, run in results.items() if name != "drop"}
    reference = next(told[name] for name in told if results[name] is main)
    return {label: {word: told[name].get(key, math.nan) / reference[key] - 1 for key, word in words.items()
                    if key in reference}
            for name, label in compared.items() if name in results and results[name] is not main}


def draw(results: Results, folder: Path) -> list[Drawing]:
    gallery = Gallery(folder)
    with plt.rc_context(STYLE):
        gallery.add("deflections", draw_deflections(results), "Deflection of the free end under a rigid ball and under a drop of "
                    "the same size, mass and speed, and under a rigid mass that strikes the exact beam without losses.", "Fig. 24")
        gallery.add("impulse", draw_impulse(results), "The impulse on the beam and the contact force. The ball gives it in blows "
                    "of some 10 us, the drop while it spreads and recoils.")
        if "ball" in results:
            gallery.add("strip_ball", strip(results["ball"], [t / MILLI for t in (0.0, 0.1, 0.3, 0.7, 1.1, 1.6, 2.2, 3.2)]),
                        "The ball on the cantilever: its speed, and the beam's stress along it.", "Fig. 24")
        checks = {WORDS[name]: results[name] for name in WORDS if name in results}
        gallery.add("modal_check", modal_checks(checks), "The exact beams under each run's recorded contact force: what differs "
                    "is the particles' beam, not the coupling.")
        main = results.get("ball_rows6") or results.get("ball")
        if main is not None:
            gallery.add("variations", change_bars(changes(results)), "What resolution, time step and spin change against the "
                        f"ball on {rows_across(main)} rows.")
    return gallery.drawings


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
