#!/usr/bin/python3
"""The drop on a rigid surface: contact time, spreading, rebound, clumping, and what they depend on (Figs 3, 14, 15).

    /usr/bin/python3 cases/rigid_wall/plot.py results/comparison/paper/rigid_wall [--output DIR]
"""

from __future__ import annotations

import math
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparison import quantities  # noqa: E402
from comparison.drop_figures import draw_drop_strip, save  # noqa: E402
from comparison.convergence import Fit, fit_order  # noqa: E402
from comparison.standalone import standalone_main  # noqa: E402
from comparison.study import Drawing, Results  # noqa: E402
from figures import LINES, MODERN, STYLE  # noqa: E402

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from sphdrop_reader import Run, Snapshot  # noqa: E402

MILLI = 1e3
PAPER_CONTACT_TIME = 3.17e-3  # s, at every speed
CLUMP_TIME = 1.5e-3           # s: near the widest
CLUMP_LIMIT = 0.5             # spacings; the flow alone brings particles to 0.6 or 0.7
SHOWN_MODERN = ("U0.5", "U0.8", "U1.0")  # of which the width is drawn in mode modern, too
PREFIXES = {"U": "0.1", "alpha0.7_U": "0.7", "alpha1.0_U": "1.0"}  # runs over the speed: their alpha
CONVERGENCE = {  # runs over the spacing, of alpha as it is and of alpha such that the viscosity alpha c h/16 is one
    name: (f"{name}0.05", f"{name}0.0333", "U0.8", f"{name}0.0167") for name in ("spacing", "same_viscosity")
}
VARIATIONS = {
    "half_step": "half the time step", "lattice": "cut from a lattice", "curvature_form": "tension as Eqs 28-31",
    "stiffness_half": "half the contact stiffness", "stiffness_double": "twice the contact stiffness",
}


def parameter(run: Run, section: str, name: str) -> float:
    return tomllib.loads(run.case_text)[section][name]


def speed(run: Run) -> float:
    """U0, m/s"""
    return -tomllib.loads(run.case_text)["drop"]["velocity"][1]


def spread(run: Run) -> float:
    """D_max/D0"""
    return quantities.largest_width(run)[1] / parameter(run, "drop", "diameter")


def swelling(run: Run) -> float:
    """By what share of its area the drop has grown at the end."""
    cell = parameter(run, "resolution", "spacing")
    return quantities.covered_area(run.snapshots[-1], cell) / quantities.covered_area(run.snapshots[0], cell) - 1


QUANTITIES = {"contact_time": quantities.contact_time, "impulse_time": quantities.impulse_time, "spread": spread}


def convergence(results: Results, series: str) -> dict[str, tuple[list[float], list[float], Fit]]:
    """Of each of QUANTITIES: spacings in m, values, and their fit; empty unless all runs are there."""
    if any(name not in results for name in CONVERGENCE[series]):
        return {}
    runs = [results[name] for name in CONVERGENCE[series]]
    spacings = [parameter(run, "resolution", "spacing") for run in runs]
    values = {name: [quantity(run) for run in runs] for name, quantity in QUANTITIES.items()}
    return {name: (spacings, values[name], fit_order(spacings, values[name])) for name in QUANTITIES}


def measure(results: Results) -> dict[str, float]:
    """Times in s; spread D_max/D0, restitution, shares and changes as numbers."""
    found: dict[str, float] = {}
    for name, run in results.items():
        found[f"contact_time_{name}"] = quantities.contact_time(run)
        found[f"spread_{name}"] = spread(run)
        if "U" in name:
            found[f"impulse_time_{name}"] = quantities.impulse_time(run)
            found[f"restitution_{name}"] = quantities.restitution(run)
            found[f"swelling_{name}"] = swelling(run)
    if "U0.8" in results:
        found["widest_at_U0.8"] = quantities.largest_width(results["U0.8"])[0]
    for name, run in results.items():
        if "U2.0" in name:
            pieces = [quantities.fragments(snapshot) for snapshot in run.snapshots]
            found[f"pieces_at_most_{name}"] = float(max(pieces))
            found[f"pieces_at_end_{name}"] = float(pieces[-1])
    for name in ("alpha0_U0.8", "U0.8", "alpha0.7_U0.8", "alpha1.0_U0.8"):
        if name in results:
            found[f"clumped_share_{name}"] = quantities.clumped_share(results[name].snapshots.at(CLUMP_TIME), CLUMP_LIMIT)
    if "half_step" in results and "U0.8" in results:
        for name, quantity in QUANTITIES.items():
            found[f"{name}_change_half_step"] = abs(quantity(results["half_step"]) / quantity(results["U0.8"]) - 1)
    for series in CONVERGENCE:
        for name, (_, _, fit) in convergence(results, series).items():
            found[f"{name}_order_{series}"], found[f"{name}_limit_{series}"] = fit.order, fit.limit
    return {name: value for name, value in found.items() if math.isfinite(value)}


def draw_contact_times(results: Results) -> Figure | None:
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.4), layout="constrained")
    for (prefix, alpha), colour in zip(PREFIXES.items(), LINES):
        runs = sorted(results.matching(prefix).values(), key=speed)
        if not runs:
            continue
        slow = [run for run in runs if speed(run) <= 1.0]
        speeds = [speed(run) for run in slow]
        left.plot(speeds, [quantities.contact_time(run) * MILLI for run in slow], "o-", ms=4, color=colour,
                  label=rf"$\alpha$ = {alpha}, first to last contact")
        left.plot(speeds, [quantities.impulse_time(run) * MILLI for run in slow], "o:", ms=3, mfc="none", color=colour,
                  label=rf"$\alpha$ = {alpha}, 99 % of the impulse")
        right.plot(speeds, [quantities.restitution(run) for run in slow], "o-", ms=4, color=colour, label=rf"$\alpha$ = {alpha}")
    if not left.lines:
        plt.close(figure)
        return None
    modern = [run for run in sorted(results.modern.matching("U").values(), key=speed) if speed(run) <= 1.0]
    if modern:
        speeds, line = [speed(run) for run in modern], {"color": LINES[3], "ms": 4, "mfc": "none", **MODERN}
        left.plot(speeds, [quantities.contact_time(run) * MILLI for run in modern], "D", **line, label="mode modern, first to last contact")
        right.plot(speeds, [quantities.restitution(run) for run in modern], "D", **line, label="mode modern")
    left.axhline(PAPER_CONTACT_TIME * MILLI, color="#333a44", dashes=(6, 3), lw=1, label="paper, 3.17 ms")
    left.set(xlabel="$U_0$  (m/s)", ylabel="contact time  (ms)", ylim=(2, 6.2))
    left.legend(loc="upper left", fontsize=6.5)
    right.set(xlabel="$U_0$  (m/s)", ylabel="restitution", ylim=(0, 0.8))
    right.legend()
    return figure


def draw_widths(results: Results) -> Figure | None:
    runs = {name: run for name, run in results.matching("U").items() if speed(run) <= 1.0}
    if not runs:
        return None
    figure, axes = plt.subplots(figsize=(5.2, 3.2), layout="constrained")
    for (name, run), colour in zip(runs.items(), LINES):
        interval = quantities.contact_interval(run)
        if interval is None:
            continue
        diameter = parameter(run, "drop", "diameter")
        time = (run.history["time"] - interval[0]) * MILLI
        axes.plot(time, run.history["drop_width"] / diameter, color=colour, label=f"$U_0$ = {speed(run):.1f} m/s")
        twin = results.modern.get(name)
        touched = quantities.contact_interval(twin) if twin is not None and name in SHOWN_MODERN else None
        if twin is not None and touched is not None:
            axes.plot((twin.history["time"] - touched[0]) * MILLI, twin.history["drop_width"] / diameter, color=colour, **MODERN)
        leaves = (interval[1] - interval[0]) * MILLI
        axes.plot(leaves, np.interp(leaves, time, run.history["drop_width"]) / diameter, "o", ms=4, color=colour)
    axes.axvline(PAPER_CONTACT_TIME * MILLI, color="#333a44", dashes=(6, 3), lw=1)
    axes.annotate("paper's contact time", (PAPER_CONTACT_TIME * MILLI, 1), xycoords=("data", "axes fraction"), xytext=(3, -8),
                  textcoords="offset points", fontsize=7.5)
    if any(name in results.modern for name in SHOWN_MODERN):
        axes.plot([], [], color="#5b6470", **MODERN, label="mode modern")
    axes.set(xlabel="time since the first contact  (ms)", ylabel="$D/D_0$", xlim=(0, None))
    axes.legend(loc="upper right", bbox_to_anchor=(1, 0.93))
    return figure


def draw_clumps(axes: Axes, snapshot: Snapshot, half: float) -> EllipseCollection:
    """The liquid's particles about the film's middle as dots, coloured by the distance to the nearest other; half: mm."""
    position = snapshot["position"][snapshot.fluid]
    spacing = quantities.spacing(snapshot)
    nearest = quantities.nearest_neighbour_distances(snapshot) / spacing
    dots = EllipseCollection(0.62 * spacing * MILLI, 0.62 * spacing * MILLI, 0, units="xy", offsets=position * MILLI,
                             offset_transform=axes.transData, linewidths=0, cmap="RdYlBu", array=nearest, clim=(0.3, 1.1))
    axes.add_collection(dots)
    axes.set(xlim=(-half, half), ylim=(-0.02, 0.47), aspect="equal", xlabel="$x$  (mm)", ylabel="$y$  (mm)")
    axes.grid(False)
    return dots


def draw_clumping(results: Results) -> Figure | None:
    chosen = {name: label for name, label in (("alpha0_U0.8", "0"), ("U0.8", "0.1")) if name in results}
    if len(chosen) < 2:
        return None
    figure, grid = plt.subplots(2, 1, figsize=(7.6, 5.4), sharex=True, layout="constrained")
    for axes, (name, label) in zip(grid, chosen.items()):
        snapshot = results[name].snapshots.at(CLUMP_TIME)
        dots = draw_clumps(axes, snapshot, half=0.6)
        share = 100 * quantities.clumped_share(snapshot, CLUMP_LIMIT)
        axes.set_title(rf"$\alpha$ = {label},  $t$ = {snapshot.time * MILLI:.1f} ms: {share:.0f} % of the particles have another "
                       f"nearer than {CLUMP_LIMIT} spacings", loc="left")
    grid[0].set_xlabel("")
    figure.colorbar(dots, ax=grid, shrink=0.6, label="distance to the nearest neighbour / mean spacing")
    return figure


def draw_convergence(results: Results) -> Figure | None:
    data = {series: convergence(results, series) for series in CONVERGENCE}
    if not any(data.values()):
        return None
    axis_labels = {"contact_time": ("contact time  (ms)", MILLI), "impulse_time": ("99 % of the impulse  (ms)", MILLI),
                   "spread": ("$D_{max}/D_0$", 1.0)}
    labels = {"spacing": r"$\alpha$ = 0.1", "same_viscosity": r"same $\alpha c h/16$"}
    figure, grid = plt.subplots(1, 3, figsize=(7.6, 3.0), layout="constrained")
    for axes, (name, (axis_label, scale)) in zip(grid, axis_labels.items()):
        for (series, fits), colour in zip(data.items(), LINES):
            if not fits:
                continue
            spacings, values, fit = fits[name]
            text = f"order {fit.order:.2f}, limit {fit.limit * scale:.3g}" if math.isfinite(fit.order) else "no order"
            axes.plot(np.array(spacings) * MILLI, np.array(values) * scale, "o", ms=4.5, color=colour,
                      label=f"{labels[series]}: {text}")
            if math.isfinite(fit.order):
                fine = np.linspace(0, max(spacings), 200)
                axes.plot(fine * MILLI, np.array([fit(d) for d in fine]) * scale, lw=0.9, color=colour)
        axes.set(xlabel="spacing  (mm)", ylabel=axis_label, xlim=(0, None))
        axes.legend(loc="lower left", bbox_to_anchor=(-0.1, 1.0), borderaxespad=0, handletextpad=0.2, fontsize=6.5)
    return figure


def draw_variations(results: Results) -> Figure | None:
    names = [name for name in VARIATIONS if name in results]
    if not names or "U0.8" not in results:
        return None
    figure, grid = plt.subplots(1, 3, figsize=(7.6, 0.32 * len(names) + 1.1), sharey=True, layout="constrained")
    for axes, label, quantity in zip(grid, ("contact time", "99 % of the impulse", "$D_{max}$"), QUANTITIES.values()):
        changes = [100 * (quantity(results[name]) / quantity(results["U0.8"]) - 1) for name in names]
        axes.barh(range(len(names)), changes, height=0.55)
        axes.axvline(0, color="#333a44", lw=0.8)
        axes.set(xlabel="change  (%)")
        axes.set_title(label, loc="left")
        axes.margins(x=0.15)
    grid[0].set_yticks(range(len(names)), [VARIATIONS[name] for name in names])
    grid[0].invert_yaxis()
    return figure


PICTURES = (
    ("clumping.png", draw_clumping,
     "The film's middle without and with the artificial viscosity: without it the particles clump.", "Fig. 3"),
    ("contact_time.png", draw_contact_times,
     "Contact time and restitution over the speed for three artificial viscosities, and the paper's contact time.", "Fig. 14"),
    ("width.png", draw_widths, "The drop's width; the dots are where it leaves.", "Fig. 15"),
    ("convergence.png", draw_convergence,
     "Contact time and spread over the particle spacing, U0 = 0.8 m/s. With alpha = 0.1 the viscosity alpha c h/16 falls "
     "with the spacing; with that viscosity kept it is the same liquid at every spacing.", ""),
    ("variations.png", draw_variations, "What else the contact time and the spread depend on, U0 = 0.8 m/s.", ""),
)
STRIPS = (
    ("rebound.png", "U0.8", "Impact, spreading and rebound at 0.8 m/s (We = 8.9).", [0.0, 0.3, 0.8, 1.5, 2.2, 3.0, 3.8, 4.6]),
    ("rebound_We55.png", "U2.0", "Impact at 2 m/s (We = 55.5), sound speed 150 m/s.",
     [0.3, 1.0, 2.0, 2.7, 4.0, 5.5, 7.0, 12.0]),
    ("rebound_We55_sound50.png", "U2.0_sound50", "Impact at 2 m/s (We = 55.5), sound speed 50 m/s: the film tears.",
     [0.3, 1.0, 2.0, 2.7, 4.0, 5.5, 7.0, 12.0]),
    ("rebound_We55_viscous.png", "alpha1.0_U2.0", "Impact at 2 m/s (We = 55.5) with alpha = 1.",
     [0.3, 1.0, 2.0, 2.7, 4.0, 5.5, 7.0, 12.0]),
)


def draw(results: Results, folder: Path) -> list[Drawing]:
    with plt.rc_context(STYLE):
        made = [(name, draw_one(results), caption, paper) for name, draw_one, caption, paper in PICTURES]
        if "U0.8" in results.modern:
            made.append(("rebound_modern.png", draw_drop_strip(results.modern["U0.8"], [time / MILLI for time in STRIPS[0][3]]),
                         "Impact, spreading and rebound at 0.8 m/s in mode modern.", ""))
        made += [(name, draw_drop_strip(results[run], [time / MILLI for time in times]), caption, "")
                 for name, run, caption, times in STRIPS if run in results]
        return save(made, folder)


if __name__ == "__main__":
    sys.exit(standalone_main(__file__, measure, draw))
