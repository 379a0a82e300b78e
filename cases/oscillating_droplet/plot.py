#!/usr/bin/python3
"""The drop set swinging between two ellipses: its period and decay against theory (Figs 9, 10).

    /usr/bin/python3 cases/oscillating_droplet/plot.py results/comparison/paper/oscillating_droplet [--output DIR]
"""

from __future__ import annotations

import math
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison import quantities  # noqa: E402
from comparison.drop_figures import draw_drop_strip, save  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from figures import LINES, MODERN, STYLE  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from numpy.typing import NDArray  # noqa: E402
from sphdrop_reader import Run  # noqa: E402

Array = NDArray[np.float64]
MILLI = 1e3
PAPER_PERIOD = 3.23e-3  # s, at 0.8 m/s


def ideal_angular_frequency(radius: float, tension: float = 0.072, density: float = 1000.0, mode: int = 2) -> float:
    """Of a small swing without viscosity: omega^2 = n (n^2 - 1) sigma/(rho R^3) in two dimensions (Rayleigh), rad/s."""
    return math.sqrt(mode * (mode**2 - 1) * tension / (density * radius**3))


def bessel(order: int, z: complex) -> complex:
    """J_n by its power series; |z| up to some 25 keeps six digits."""
    term = (z / 2) ** order / math.factorial(order)
    total, k = term, 0
    while k < 200 and abs(term) > 1e-18 * abs(total) or k < abs(z):
        k += 1
        term *= -(z / 2) ** 2 / (k * (k + order))
        total += term
    return total


def viscous_swing(radius: float, viscosity: float, tension: float = 0.072, density: float = 1000.0,
                  mode: int = 2) -> tuple[float, float]:
    """Period in s and decay rate in 1/s of a small swing with a kinematic viscosity in m^2/s, exactly.

    Linear free-surface flow exp(i n theta - s t) with velocity grad(A r^n) + curl(B J_n(k r)), k^2 = s/nu: the tangential
    stress on r = R is zero, the normal one balances the tension; s is the root of their determinant.
    """
    n, nu = mode, viscosity

    def determinant(s: complex) -> complex:
        k = np.sqrt(s / nu + 0j)
        z = k * radius
        j = bessel(n, z)
        slope = k * (bessel(n - 1, z) - n / z * j)                      # d J_n(k r)/dr at R
        bend = -slope / radius + (n**2 / radius**2 - k**2) * j          # its second derivative, by Bessel's equation
        # Columns: of A (r^n) and of B (J_n), both scaled; u_r = phi' + i n psi/r, u_theta = i n phi/r - psi'.
        radial = n / radius, 1j * n * j / radius
        radial_slope = n * (n - 1) / radius**2, 1j * n * (slope / radius - j / radius**2)
        shear = (2j * n * (n - 1) / radius**2, -bend + slope / radius - n**2 * j / radius**2)
        pressure = density * s, 0.0
        normal = [p - 2 * density * nu * rs + tension * (n**2 - 1) / (radius**2 * s) * r
                  for p, rs, r in zip(pressure, radial_slope, radial)]
        return (normal[0] * shear[1] - normal[1] * shear[0]) / j

    omega = ideal_angular_frequency(radius, tension, density, mode)
    damping = 2 * n * (n - 1) * nu / radius**2
    before, now = damping + 1j * omega, 1.02 * damping + 0.99j * omega
    at_before, at_now = determinant(before), determinant(now)
    for _ in range(60):  # secant
        if at_now == at_before or abs(now - before) < 1e-12 * abs(now):
            break
        before, now, at_before = now, now - at_now * (now - before) / (at_now - at_before), at_now
        at_now = determinant(now)
    return 2 * math.pi / abs(now.imag), float(now.real)


def parameters(run: Run) -> Mapping[str, Any]:
    return tomllib.loads(run.case_text)


def radius_of(run: Run) -> float:
    return 0.5 * parameters(run)["drop"]["diameter"]


def effective_viscosity(run: Run) -> float:
    """In m^2/s: mu/rho of a physical viscosity; alpha c h/16 is what the artificial one on approaching pairs amounts to in
    two dimensions."""
    case = parameters(run)
    if is_physical(run):
        return case["fluid"]["viscosity"] / case["fluid"]["density"]
    smoothing_length = case["resolution"]["smoothing_ratio"] * case["resolution"]["spacing"]
    return case["fluid"]["artificial_viscosity_alpha"] * case["fluid"]["sound_speed"] * smoothing_length / 16


def swing(run: Run) -> Array:
    """mean(x^2 - y^2)/R^2 over time, which is a of a surface R (1 + a cos 2 theta) where a is small."""
    return run.history["drop_elongation"] / radius_of(run) ** 2


def periods_and_amplitudes(run: Run) -> tuple[Array, Array]:
    """Each period in s from zero crossing to second next, and the mean of |a|'s two peaks in it."""
    times, values = run.history["time"], swing(run)
    crossings = quantities.zero_crossings(times, values)
    peaks = np.array([np.abs(values[(times >= a) & (times <= b)]).max() for a, b in zip(crossings[:-1], crossings[1:])])
    return crossings[2:] - crossings[:-2], 0.5 * (peaks[1:] + peaks[:-1])


def measure(results: Results) -> dict[str, float]:
    """Periods and decay times in s."""
    found: dict[str, float] = {}
    for name, run in results.items():
        times, values = run.history["time"], swing(run)
        crossings = quantities.zero_crossings(times, values)
        if len(crossings) >= 3:
            # An even number of half periods: a swing about a mean that is not quite zero does not show.
            count = (len(crossings) - 1) // 2 * 2
            found[f"period_{name}"] = float(2 * (crossings[count] - crossings[0]) / count)
        if len(crossings) >= 4:
            found[f"period_from_start_{name}"] = float(crossings[3] / 2)
        rate = quantities.decay_rate(times, values)
        if math.isfinite(rate):
            found[f"decay_time_{name}"] = 1 / rate
    return found


def is_physical(run: Run) -> bool:
    """Whether the liquid has a viscosity of its own instead of the artificial one."""
    return parameters(run)["fluid"].get("viscosity_form", "artificial") == "physical"


def label(run: Run) -> str:
    case = parameters(run)
    text = f"{run.snapshots[0].particle_count} particles, $V_0$ = {case['drop']['oscillation_velocity']:g} m/s"
    return text + (f", $\\mu$ = {case['fluid']['viscosity']:g} Pa s" if is_physical(run) else "")


def draw_shapes(run: Run) -> Figure:
    """At the starts, quarters, halves and three quarters of the first two periods."""
    times = run.history["time"]
    crossings = quantities.zero_crossings(times, swing(run))
    stops = np.concatenate([[0.0], crossings[:4]])
    between = [0.5 * (a + b) for a, b in zip(stops[:-1], stops[1:])]
    chosen = sorted([*stops[:4], *between])
    return draw_drop_strip(run, chosen)


def draw_quarter_centres(results: Results, speed: str) -> Figure | None:
    runs = {name: run for name, run in results.items() if name.endswith(f"_V{speed}")}
    if not runs:
        return None
    figure, grid = plt.subplots(2, 1, figsize=(6.4, 4.2), sharex=True, layout="constrained")
    for axes, column in zip(grid, ("quarter_centre_x", "quarter_centre_y")):
        for run, colour in zip(runs.values(), LINES):
            axes.plot(run.history["time"] * MILLI, run.history[column] * MILLI, color=colour, lw=1.1, label=label(run))
        axes.axhline(4 * radius_of(run) / (3 * math.pi) * MILLI, color="#333a44", dashes=(6, 3), lw=0.8)
        axes.set_ylabel(f"${column[-1]}$  (mm)")
        axes.margins(x=0.01)
    for number in range(1, 4):
        grid[1].axvline(number * PAPER_PERIOD * MILLI, color=LINES[4], lw=0.9)
    grid[1].annotate("multiples of the paper's period, 3.23 ms", (PAPER_PERIOD * MILLI, 1), xycoords=("data", "axes fraction"),
                     xytext=(4, -9), textcoords="offset points", fontsize=7.5, color="#8a6410")
    grid[0].legend(loc="lower right", bbox_to_anchor=(1, 0.99), ncols=3, borderaxespad=0, columnspacing=1.0, handlelength=1.2)
    grid[1].set_xlabel("time  (ms)")
    return figure


def draw_viscous(results: Results) -> Figure | None:
    """The swing with a physical viscosity over the exact theory's, which starts at the first extremum."""
    runs = [run for run in results.values() if is_physical(run)]
    runs += [run for run in results.modern.values() if parameters(run)["drop"]["oscillation_velocity"] <= 0.05]
    if not runs:
        return None
    figure, grid = plt.subplots(len(runs), 1, figsize=(6.4, 1.6 * len(runs)), sharex=True, layout="constrained", squeeze=False)
    for axes, run, colour in zip(grid[:, 0], runs, LINES):
        times, values = run.history["time"], swing(run)
        period, rate = viscous_swing(radius_of(run), effective_viscosity(run))
        early = times < period / 2
        peak = int(np.argmax(np.abs(values) * early))
        since = times[peak:] - times[peak]
        omega = 2 * math.pi / period
        exact = values[peak] * np.exp(-rate * since) * (np.cos(omega * since) + rate / omega * np.sin(omega * since))
        axes.plot(times * MILLI, values * 100, color=colour, lw=1.1, label=label(run))
        axes.plot(times[peak:] * MILLI, exact * 100, color="#333a44", lw=0.8, dashes=(4, 2), label="exact theory")
        axes.set_ylabel("elongation  (%)")
        axes.margins(x=0.01)
        axes.legend(loc="lower right", bbox_to_anchor=(1, 0.97), ncols=2, borderaxespad=0)
    grid[-1, 0].set_xlabel("time  (ms)")
    return figure


def draw_periods(results: Results) -> Figure | None:
    runs = [run for run in results.values() if not is_physical(run)]
    if not runs:
        return None
    figure, axes = plt.subplots(figsize=(7.6, 3.2), layout="constrained")
    for run, colour in zip(runs, LINES):
        periods, amplitudes = periods_and_amplitudes(run)
        axes.plot(amplitudes, periods * MILLI, "o-", ms=3.5, lw=0.8, color=colour, label=label(run))
    for name, colour in zip([name for name in results if not is_physical(results[name])], LINES):
        if name in results.modern:
            periods, amplitudes = periods_and_amplitudes(results.modern[name])
            axes.plot(amplitudes, periods * MILLI, "D", ms=3.5, mfc="none", color=colour, **MODERN)
    if results.modern:
        axes.plot([], [], "D", ms=3.5, mfc="none", color="#5b6470", **MODERN, label="mode modern")
    radius = radius_of(run)
    ideal = 2 * math.pi / ideal_angular_frequency(radius)
    viscous = viscous_swing(radius, effective_viscosity(run))[0]
    axes.axhline(ideal * MILLI, color="#333a44", dashes=(6, 3), lw=0.9, label="theory, small swing, no viscosity")
    axes.axhline(viscous * MILLI, color="#333a44", dashes=(2, 2), lw=0.9,
                 label=f"theory with $\\alpha c h/16$ of {run.snapshots[0].particle_count} particles")
    axes.axhline(PAPER_PERIOD * MILLI, color=LINES[4], lw=0.9, label="paper, $V_0$ = 0.8 m/s")
    axes.set(xlabel="amplitude $a$ of $R(1 + a\\cos 2\\theta)$", ylabel="period  (ms)", xlim=(0, None))
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def draw_decay(results: Results) -> Figure | None:
    runs = {name: run for name, run in results.items() if not is_physical(run)}
    chosen = [run for name, run in runs.items() if "1264" in name or len(runs) <= 2]
    if not chosen:
        return None
    figure, axes = plt.subplots(figsize=(6.4, 3.0), layout="constrained")
    for run in chosen:
        values = swing(run)
        axes.plot(run.history["time"] * MILLI, values / np.abs(values).max(), lw=1.1, label=label(run))
        start = run.history["time"][int(np.argmax(np.abs(values)))]
        rate = viscous_swing(radius_of(run), effective_viscosity(run))[1]
        times = np.linspace(start, run.history["time"][-1], 200)
    for sign in (-1, 1):
        axes.plot(times * MILLI, sign * np.exp(-rate * (times - start)), color="#333a44", lw=0.7, dashes=(4, 2))
    axes.set(xlabel="time  (ms)", ylabel="elongation / its largest", ylim=(-1.1, 1.1))
    axes.margins(x=0.01)
    axes.legend(loc="lower right", bbox_to_anchor=(1, 0.99), ncols=3, borderaxespad=0, columnspacing=1.0, handlelength=1.2)
    return figure


def draw(results: Results, folder: Path) -> list[Drawing]:
    made: list[tuple[str, Figure | None, str, str]] = []
    with plt.rc_context(STYLE):
        shown = next((results[name] for name in ("particles1264_V0.8", "particles484_V0.8", *results) if name in results), None)
        if shown is None:
            return []
        made.append(("shapes.png", draw_shapes(shown), f"The first two periods; {label(shown)}.".replace("$", ""), "Fig. 9"))
        made.append(("quarter_centre.png", draw_quarter_centres(results, "0.8"),
                     "The mass centre of the upper right quarter at V0 = 0.8 m/s; dashed: of a circle's quarter.", "Fig. 10"))
        made.append(("period.png", draw_periods(results), "Each period over its amplitude: it falls as the swing dies out. "
                     "Diamonds: mode modern.", ""))
        made.append(("decay.png", draw_decay(results),
                     "Decay; dashed: exact theory of a small swing with the viscosity alpha c h/16.", ""))
        made.append(("viscous.png", draw_viscous(results),
                     "A small swing with a physical viscosity; dashed: exact theory of the viscous drop.", ""))
        return save(made, folder)


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
