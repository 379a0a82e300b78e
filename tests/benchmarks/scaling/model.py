#!/usr/bin/python3
"""How a drop's step scales with particles and ranks: a model of what sphdrop computes and exchanges.

    /usr/bin/python3 tests/benchmarks/scaling/model.py tables         the tables of SCALING.md
    /usr/bin/python3 tests/benchmarks/scaling/model.py page           writes them there
    /usr/bin/python3 tests/benchmarks/scaling/model.py figure FILE    its figure
    /usr/bin/python3 tests/benchmarks/scaling/model.py fit            the perimeter of a rank's part, from traffic.csv

Lengths are in particle spacings, times in s. What traffic.csv counts is exact; costs.csv says where each cost comes from.
The network's latency and bandwidth are assumed, not measured.
"""

from __future__ import annotations

import csv
import math
import re
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parent
PAGE = FOLDER.parent / "SCALING.md"

LIST_REACH = 2.7  # 2h + skin with h = 1.2 d, skin = 0.3 d
BAND = 2.6  # rows of liquid that surface points act on, along the curve: 2h + 0.2 d
LOOSENESS = 0.4  # of the distances by which ranks know who needs a particle of the band: a skin and a little
PERIMETER = 4.96  # of a part, over the square root of its particles: fit(); a square's is 4
LONGEST_BORDER = 1.35  # of a part, over the square root of all particles: of few parts, which are cut straight; a diameter's is 1.13
COLUMN_BYTES = 8
HALO_COLUMNS = 5  # position, velocity, density
BAND_COLUMNS = 2  # position
REDUCED_BYTES = 120
CONTRIBUTION_BYTES = 24  # what a rank says of a cell
CELLS_OF_A_RANK = 64  # parallel.cells_per_process: a rank has so many at least, and less than four times as many
ARC_BYTES = 96
TWICE = 10  # nodes of a rank's piece that others work on too: 8 to 10 of 4 and of 8 ranks, which test_surface_share.cpp bounds


@dataclass(frozen=True)
class Costs:
    """Of the program, by costs.csv."""

    particle: float
    imbalance: float
    curve_point: float
    detection_particle: float
    detection_arc: float
    joined_arc: float
    list_particle: float
    list_cell: float
    partition_cell: float
    steps_between_detections: float
    steps_between_redistributions: float
    redistributions_between_partitions: float
    packed_row: float
    set_up_particle: float
    walked_particle: float
    particle_bytes: float
    set_up_bytes: float
    cell_bytes: float


@dataclass(frozen=True)
class Network:
    """A message of n bytes takes latency + n / bandwidth."""

    latency: float = 1.5e-6  # s
    bandwidth: float = 12e9  # B/s, a rank's share

    def message(self, count: float, size: float) -> float:
        return count * self.latency + size / self.bandwidth

    def reduction(self, ranks: int) -> float:
        """Up and down a binary tree."""
        return 2 * math.ceil(math.log2(ranks)) * self.latency if ranks > 1 else 0.0

    def gather_to_all(self, ranks: int, size: float) -> float:
        """Every rank ends up with `size` bytes."""
        return self.reduction(ranks) + size / self.bandwidth if ranks > 1 else 0.0


@dataclass(frozen=True)
class Design:
    """What is done on one rank, or on every rank for all; False as the program is, True if it were mended."""

    shared_arcs: bool = False  # each rank joins the arcs about its own
    shared_cells: bool = False  # a rank knows the cells about its own; parts are cut from a space-filling curve
    shared_walk: bool = False  # a rank goes through its own particles only as they are set up


@dataclass(frozen=True)
class Traffic:
    """Of a rank in a step: messages sent and received, and their bytes; mean over the ranks, and where the surface is."""

    messages: float
    size: float
    surface_messages: float
    surface_size: float
    halo_rows: float  # received, mean
    band_rows: float  # received, at the surface


@dataclass(frozen=True)
class StepTime:
    """Of a step, s, on the rank that the others wait for."""

    particles: float
    surface: float
    halo: float
    reduction: float
    detection: float
    joining: float
    redistribution: float
    partition: float

    @property
    def total(self) -> float:
        return sum(getattr(self, field.name) for field in fields(self))


def read_costs(path: Path = FOLDER / "costs.csv") -> Costs:
    with path.open(encoding="utf-8", newline="") as stream:
        return Costs(**{row["name"]: float(row["value"]) for row in csv.DictReader(stream)})


def curve_points(particles: float) -> float:
    """Round a drop: its perimeter in spacings."""
    return 2 * math.sqrt(math.pi * particles)


def dealt_out_cells(particles: float, ranks: int) -> float:
    """As wide as the lists reach; wider, by powers of two, as long as there are CELLS_OF_A_RANK."""
    cells = particles / LIST_REACH**2
    while cells / 4 >= CELLS_OF_A_RANK * ranks:
        cells /= 4
    return cells


def parts_at_surface(ranks: int) -> float:
    """Ranks with a piece of the curve: the drop's perimeter over a part's width; of few ranks all."""
    return min(float(ranks), 2 * math.sqrt(math.pi * ranks))


def traffic(particles: float, ranks: int, perimeter: float = PERIMETER) -> Traffic:
    """What stands between two parts is sent both ways; the drop's own perimeter is nobody's neighbour. Where the border of
    two parts meets the surface, each sends the other its particles of the band that share a surface point with one of the
    other's."""
    if ranks == 1:
        return Traffic(0, 0, 0, 0, 0, 0)
    border = perimeter * math.sqrt(particles / ranks) - curve_points(particles) / ranks
    halo_rows = LIST_REACH * min(border, LONGEST_BORDER * math.sqrt(particles))
    band_rows = 2 * BAND * (2 * BAND + LOOSENESS)  # at both ends of its piece
    halo_size = 2 * COLUMN_BYTES * HALO_COLUMNS * halo_rows
    band_size = 2 * COLUMN_BYTES * BAND_COLUMNS * band_rows
    neighbours, beside = min(ranks - 1.0, 5.0), min(ranks - 1.0, 2.0)
    at_surface = parts_at_surface(ranks) / ranks
    return Traffic(
        messages=2 * neighbours + 2 * beside * at_surface,
        size=halo_size + band_size * at_surface,
        surface_messages=2 * neighbours + 2 * beside,
        surface_size=halo_size + band_size,
        halo_rows=halo_rows,
        band_rows=band_rows,
    )


def step_time(particles: float, ranks: int, costs: Costs, network: Network = Network(), design: Design = Design()) -> StepTime:
    """The surface's work is dealt out with the particles; what two ranks both work on, at the ends of their pieces, is not.
    Halo and band are under way during the sweep of what needs neither."""
    counted = traffic(particles, ranks)
    points, cells, own = curve_points(particles), dealt_out_cells(particles, ranks), particles / ranks
    uneven = 1 + (costs.imbalance if ranks > 1 else 0.0)
    sweep = costs.particle * own
    twice = TWICE if ranks > 1 else 0.0
    exchanged = network.message(counted.surface_messages / 2, counted.surface_size / 2)
    hidden = max(0.0, sweep - costs.particle * min(own, 2 * counted.halo_rows))
    table = costs.list_cell * cells
    cells_to_all = network.gather_to_all(ranks, CONTRIBUTION_BYTES * cells)
    cut = costs.partition_cell * cells if ranks > 1 else 0.0
    if design.shared_cells:
        table, cells_to_all, cut = table / ranks, network.reduction(ranks), cut / ranks
    joined = costs.joined_arc * points + network.gather_to_all(ranks, ARC_BYTES * points)
    if design.shared_arcs:
        joined = costs.joined_arc * points / parts_at_surface(ranks) + network.reduction(ranks)
    rebuilds = 1 / costs.steps_between_redistributions
    return StepTime(
        particles=sweep * uneven,
        surface=costs.curve_point * (points / ranks * uneven + twice),
        halo=max(0.0, exchanged - hidden) + 2 * costs.packed_row * (counted.halo_rows + counted.band_rows),
        reduction=network.reduction(ranks),
        detection=(costs.detection_particle * own + costs.detection_arc * points / parts_at_surface(ranks)) / costs.steps_between_detections,
        joining=joined / costs.steps_between_detections,
        redistribution=(costs.list_particle * own + table + cells_to_all) * rebuilds,
        partition=cut * rebuilds / costs.redistributions_between_partitions,
    )


def speed_up(particles: float, ranks: int, costs: Costs, network: Network = Network(), design: Design = Design()) -> float:
    alone = step_time(particles, 1, costs, network, design).total
    return alone / step_time(particles, ranks, costs, network, design).total


def efficiency(particles: float, ranks: int, costs: Costs, network: Network = Network(), design: Design = Design()) -> float:
    """Strong: of the same particles on so many ranks."""
    return speed_up(particles, ranks, costs, network, design) / ranks


def weak_efficiency(own: float, ranks: int, costs: Costs, network: Network = Network(), design: Design = Design()) -> float:
    """Of `own` particles a rank, against a rank alone with as many."""
    alone = step_time(own, 1, costs, network, design).total
    return alone / step_time(own * ranks, ranks, costs, network, design).total


def useful_ranks(particles: float, costs: Costs, network: Network = Network(), design: Design = Design(), least: float = 0.5) -> int:
    """The most ranks, a power of two, that still are used by `least`."""
    ranks = 1
    while ranks < 2**24 and efficiency(particles, 2 * ranks, costs, network, design) >= least:
        ranks *= 2
    return ranks


def memory(particles: float, ranks: int, costs: Costs, design: Design = Design()) -> tuple[float, float]:
    """Bytes on a rank: while the drop is set up, and in a step."""
    own = particles / ranks
    cells = dealt_out_cells(particles, ranks) / (ranks if design.shared_cells else 1)
    in_a_step = costs.particle_bytes * (own + traffic(particles, ranks).halo_rows) + costs.cell_bytes * cells
    return (costs.set_up_bytes + costs.particle_bytes) * own, in_a_step


def set_up_time(particles: float, ranks: int, costs: Costs, design: Design = Design()) -> float:
    """Making the initial state, s."""
    return costs.set_up_particle * particles / ranks + (0.0 if design.shared_walk else costs.walked_particle * particles)


def fit_perimeter(counted: Iterable[tuple[float, int, float]]) -> float:
    """The perimeter with which traffic() comes nearest to counted (particles, ranks, mean bytes), in the least squares of
    relative errors; of so many ranks that parts are not cut straight."""
    slopes, rests = [], []
    for particles, ranks, size in counted:
        if ranks <= 8:
            continue
        few, more = traffic(particles, ranks, 3.0).size, traffic(particles, ranks, 4.0).size
        slopes.append((more - few) / size)
        rests.append(1 - few / size)
    solution = np.linalg.lstsq(np.array(slopes)[:, None], np.array(rests), rcond=None)[0]
    return 3.0 + float(solution[0])


def counted_traffic(path: Path = FOLDER / "traffic.csv", case: str = "oscillating_droplet") -> list[dict[str, float]]:
    with path.open(encoding="utf-8", newline="") as stream:
        return [{key: float(value) for key, value in row.items() if key != "case"} for row in csv.DictReader(stream) if row["case"] == case]


def counted_of_many(least: float = 250) -> list[tuple[float, int, float]]:
    """Where a part is wider than the halo about it."""
    return [(row["particles"], int(row["ranks"]), row["bytes"]) for row in counted_traffic() if row["particles"] / row["ranks"] > least]


def si(value: float) -> str:
    if value == 0:
        return "0"
    for limit, unit in ((1, ""), (1e-3, "m"), (1e-6, "u")):
        if value >= limit:
            return f"{value / limit:.3g} {unit}s"
    return f"{value / 1e-9:.3g} ns"


MENDED = {
    "as it is": Design(),
    "cells shared": Design(shared_cells=True, shared_walk=True),
    "cells and arcs shared": Design(True, True, True),
}


def tables(costs: Costs) -> str:
    lines = ["Bytes that a rank sends and receives in a step, mean over the ranks:", "", "| particles | ranks | counted | model | ratio |", "|---|---|---|---|---|"]
    for row in counted_traffic():
        predicted = traffic(row["particles"], int(row["ranks"])).size
        lines.append(f"| {row['particles']:.0f} | {row['ranks']:.0f} | {row['bytes']:.0f} | {predicted:.0f} | {predicted / row['bytes']:.2f} |")
    lines += ["", "The most ranks (powers of two) that are used by half or more:", ""]
    lines += ["| particles | " + " | ".join(name for name in MENDED) + " |", "|---" * (1 + len(MENDED)) + "|"]
    for exponent in range(4, 10):
        ranks = [useful_ranks(10.0**exponent, costs, design=design) for design in MENDED.values()]
        lines.append(f"| 10^{exponent} | " + " | ".join(map(str, ranks)) + " |")
    names = [field.name for field in fields(StepTime)]
    lines += ["", "A step, as the program is:", ""]
    lines += ["| particles | ranks | " + " | ".join(names) + " | step | efficiency |", "|---" * (4 + len(names)) + "|"]
    for particles, ranks in ((1e6, 16), (1e6, 256), (1e8, 1024), (1e8, 10_000), (1e9, 10_000)):
        time = step_time(particles, ranks, costs)
        parts = " | ".join(si(getattr(time, name)) for name in names)
        lines.append(f"| {particles:.0e} | {ranks} | {parts} | {si(time.total)} | {efficiency(particles, ranks, costs):.2f} |")
    lines += ["", "Weak scaling, the efficiency of 10^5 particles a rank:", ""]
    lines += ["| ranks | particles | " + " | ".join(MENDED) + " |", "|---" * (2 + len(MENDED)) + "|"]
    for ranks in (1, 16, 256, 1024, 10_000):
        shares = " | ".join(f"{weak_efficiency(1e5, ranks, costs, design=design):.2f}" for design in MENDED.values())
        lines.append(f"| {ranks} | {1e5 * ranks:.0e} | {shares} |")
    lines += ["", "Memory of a rank:", ""]
    lines += ["| particles | ranks | set up | in a step | in a step, cells shared | time to set up |", "|---" * 6 + "|"]
    for particles, ranks in ((1e6, 16), (1e8, 1024), (1e9, 10_000)):
        sizes = (*memory(particles, ranks, costs), memory(particles, ranks, costs, Design(True, True, True))[1])
        lines.append(f"| {particles:.0e} | {ranks} | " + " | ".join(f"{size / 1e9:.3g} GB" for size in sizes) + f" | {si(set_up_time(particles, ranks, costs))} |")
    return "\n".join(lines)


def figure(costs: Costs, path: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    ranks = [2**k for k in range(15)]
    drawing, (strong, weak) = plt.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
    for exponent, colour in zip((4, 6, 8, 9), ("C0", "C1", "C2", "C3")):
        for design, style in ((Design(), "-"), (Design(True, True, True), ":")):
            label = f"$10^{exponent}$ particles" if style == "-" else None
            strong.loglog(ranks, [speed_up(10.0**exponent, p, costs, design=design) for p in ranks], style, color=colour, label=label)
    strong.loglog(ranks, ranks, color="grey", linewidth=0.7)
    strong.set(xlabel="ranks", ylabel="speed-up", ylim=(1, 2e4))
    strong.legend(fontsize=8)
    for (name, design), style in zip(MENDED.items(), ("-", "--", ":")):
        weak.semilogx(ranks, [weak_efficiency(1e5, p, costs, design=design) for p in ranks], style, color="C0", label=name)
    weak.set(xlabel="ranks, $10^5$ particles each", ylabel="efficiency", ylim=(0, 1.05))
    weak.legend(fontsize=8)
    drawing.savefig(path, dpi=110)


def page_with(text: str, written: str) -> str:
    """SCALING.md with the tables between its marks."""
    return re.sub(r"(?<=^<!-- tables: written by model.py page -->\n).*?(?=^<!-- end of tables -->$)", lambda _: f"\n{written}\n\n", text, flags=re.DOTALL | re.MULTILINE)


def main(arguments: Sequence[str]) -> int:
    match arguments:
        case ["tables"]:
            print(tables(read_costs()))
        case ["page"]:
            PAGE.write_text(page_with(PAGE.read_text(encoding="utf-8"), tables(read_costs())), encoding="utf-8")
        case ["figure", name]:
            figure(read_costs(), Path(name))
        case ["fit"]:
            print(f"{fit_perimeter(counted_of_many()):.3f}")
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
