"""The ledgers of a study's runs drawn: one large for its main run, small ones for all."""

from __future__ import annotations

import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from comparison.ledgers import DISSIPATED, INJECTED, STORED, angular_residual, column, ledger_of, momentum_residual
from comparison.study import Drawing, Results
from figures import LINES, MILLI, STYLE
from matplotlib.axes import Axes
from sphdrop_reader import Run

# A term below this share of the largest is left out of the legend and the figure.
NEGLIGIBLE = 5e-3
COLOURS = {
    "kinetic_fluid": LINES[0], "kinetic_solid": LINES[6], "elastic": LINES[2], "compressive": LINES[3],
    "surface": LINES[4], "contact": LINES[7], "gravity": "#8c6d46", "dissipated_fluid": LINES[1], "dissipated_solid": "#e58a7b",
    "adhesion": "#c39bd3", "dissipated_contact": "#b5651d", "density_correction": "#4b5fd1", "artificial_stress_work": "#7a8f2f",
    "reconnection": LINES[5], "gauge": "#5a9e9b", "gauge_adjustment": "#9a6fb0", "shifting_work": "#b5b04a",
    "sharing_work": "#6b8e8e",
}


def _changes(run: Run) -> dict[str, np.ndarray]:
    """Each energy in mJ/m; surface and gravity from their value at the start, as only their changes mean anything."""
    terms = {name: column(run, name) * MILLI for name in [*STORED, *DISSIPATED, *INJECTED]}
    for name in ("surface", "adhesion", "gravity"):
        terms[name] = terms[name] - terms[name][0]
    largest = max(np.abs(values).max() for values in terms.values()) or 1.0
    return {name: values for name, values in terms.items() if np.abs(values).max() > NEGLIGIBLE * largest}


def draw_energies(axes: Axes, run: Run, is_small: bool = False) -> None:
    """Lines over time: what is stored and dissipated; broken lines: what named causes put in; black: their balance."""
    time = column(run, "time") * MILLI
    labels = {**STORED, **DISSIPATED, **INJECTED}
    width = 0.8 if is_small else 1.3
    for name, values in _changes(run).items():
        label = labels[name] + (", change" if name in ("surface", "adhesion", "gravity") else "")
        axes.plot(time, values, color=COLOURS[name], label=label, linewidth=width, linestyle="--" if name in INJECTED else "-")
    balance = (column(run, "total") + sum(column(run, name) for name in DISSIPATED)
               - sum(column(run, name) for name in INJECTED))
    start = sum(column(run, name)[0] for name in ("surface", "adhesion", "gravity"))
    axes.plot(time, (balance - start) * MILLI, color="black", linewidth=width, label="sum (stored + dissipated - put in)")
    axes.margins(x=0.01)


def draw_main(run: Run, name: str, path: Path) -> Drawing:
    """Energies, what of them is unaccounted for, and momenta of one run."""
    case = tomllib.loads(run.case_text)
    ledger = ledger_of(run)
    time = column(run, "time") * MILLI
    lower = [["left", "momentum"], ["spread", "angular"]] if ledger.momentum_scale > 0 else [["left", "spread"]]
    with plt.rc_context(STYLE):
        figure, grid = plt.subplot_mosaic([["energy", "energy"], *lower], figsize=(7.4, 3.4 + 2.2 * len(lower)),
                                          height_ratios=[1.6, *[1.0] * len(lower)], layout="constrained")
        draw_energies(grid["energy"], run)
        grid["energy"].set_ylabel("energy  (mJ/m)")
        grid["energy"].legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, borderaxespad=0.2)

        percent = 100 / ledger.energy_scale if ledger.energy_scale > 0 else 1.0
        grid["left"].plot(time, percent * run.history["unaccounted"], color="black")
        grid["left"].set(title="energy not accounted for", ylabel="% of the scale")
        free = column(run, "total") - sum(column(run, cause) for cause in INJECTED)
        grid["spread"].plot(time, percent * (free - free[0]), color=LINES[0])
        grid["spread"].set(title="change of (total - put in by named causes)", ylabel="% of the scale")
        if ledger.momentum_scale > 0:
            _draw_balance(grid["momentum"], run, ("momentum_fluid_y", "contact_impulse_y", "momentum_solid_y"),
                          momentum_residual(run, case)[1], ledger.momentum_scale)
            grid["momentum"].set(title="vertical momentum", ylabel="share of $m U_0$")
            _draw_balance(grid["angular"], run, ("angular_momentum_fluid", "contact_angular_impulse", "angular_momentum_solid"),
                          angular_residual(run, case), ledger.momentum_scale * case["drop"]["diameter"])
            grid["angular"].set(title="angular momentum about the origin", ylabel="share of $m U_0 D_0$")
        for axes in grid.values():
            axes.margins(x=0.01)
            axes.set_xlabel("time  (ms)")
        figure.savefig(path)
        plt.close(figure)
    return Drawing(path, f"{name}: ledgers of energy and momentum. The scale is {ledger.energy_scale * MILLI:.4g} mJ/m: the kinetic "
                         "energy at the start or, from rest, the largest change of one energy.")


def _draw_balance(axes: Axes, run: Run, columns: tuple[str, str, str], residual: np.ndarray, scale: float) -> None:
    """Drop, impulse on the solid, solid; the black line, which should be level, is the drop with what it gave away."""
    time = column(run, "time") * MILLI
    for name, label, colour in zip(columns, ("drop", "impulse on the solid", "solid"), LINES):
        if np.any(column(run, name)):
            axes.plot(time, column(run, name) / scale, color=colour, label=label)
    start = column(run, columns[0])[0]
    axes.plot(time, (start + residual) / scale, color="black", linewidth=0.9, label="drop + impulse")
    axes.legend(fontsize=6.5)


def draw_small(results: Results, path: Path, columns: int = 4) -> Drawing:
    """A small energy ledger for each run."""
    names = list(results)
    columns = min(columns, len(names))
    rows = -(-len(names) // columns)
    with plt.rc_context({**STYLE, "font.size": 7, "axes.titlesize": 7, "savefig.dpi": 150}):
        figure = plt.figure(figsize=(max(2.3 * columns, 5.0), 1.55 * rows + 0.8), layout="constrained")
        grid = figure.add_gridspec(rows + 1, columns, height_ratios=[0.45, *[1.0] * rows])
        labelled: dict[str, object] = {}
        for k, name in enumerate(names):
            axes = figure.add_subplot(grid[1 + k // columns, k % columns])
            draw_energies(axes, results[name], is_small=True)
            axes.set_title(name)
            for handle, label in zip(*axes.get_legend_handles_labels()):
                labelled.setdefault(label, handle)
        legend = figure.add_subplot(grid[0, :])
        legend.axis("off")
        legend.legend(list(labelled.values()), list(labelled), loc="center", ncols=3 if columns < 3 else 4, fontsize=6.5)
        figure.supxlabel("time  (ms)", fontsize=7)
        figure.supylabel("energy  (mJ/m)", fontsize=7)
        figure.savefig(path)
        plt.close(figure)
    return Drawing(path, "energy of every run, lines as above")


def draw_ledgers(results: Results, folder: Path) -> list[Drawing]:
    """The first run's ledger large; small ones for all if there are more."""
    if not results:
        return []
    main = next(iter(results))
    drawings = [draw_main(results[main], main, folder / "ledger.png")]
    if len(results) > 1:
        drawings.append(draw_small(results, folder / "ledgers.png"))
    return drawings
