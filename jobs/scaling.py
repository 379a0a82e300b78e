#!/usr/bin/python3
"""Strong and weak scaling: what the jobs run, and the table of what they took.

    /usr/bin/python3 jobs/scaling.py weak CASE RANKS   arguments of sphdrop, one a line, for RANKS times the particles of a
                                                       run, given its effective case (FOLDER/case.cfg)
    /usr/bin/python3 jobs/scaling.py table FOLDER      prints the table of the runs in FOLDER and writes FOLDER/scaling.csv

A run's cost is the wall time of its steps (run.json's phases but output), without start and end, over particles and steps;
of runs on as many ranks the fastest counts. The efficiency is ranks times cost on the fewest ranks over the same on so many:
1 if a rank's second does as much on many ranks as on few. That holds for strong scaling (the same case on more ranks) and for
weak (as many times the particles on as many ranks).
"""

from __future__ import annotations

import csv
import json
import math
import sys
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

COLUMNS = ("ranks", "hosts", "particles", "steps", "wall_time [s]", "stepping_time [s]", "per_particle_and_step [ns]",
           "speed_up", "efficiency")


class ScalingError(Exception):
    """A case that cannot be scaled, or runs that give no table."""


def weak_settings(case: Mapping[str, Any], ranks: int) -> dict[str, float]:
    """Parameters with which drop and beam, scaled alike in all directions at the same spacing and so the same time step,
    have `ranks` times the particles. The beam's rows stay even, its length makes up for it."""
    solid, drop, spacing = case["solid"], case["drop"], case["resolution"]["spacing"]
    if solid["kind"] not in ("cantilever", "fixed_fixed_beam"):
        raise ScalingError("weak scaling takes a case with a beam")
    rows, columns = round(solid["thickness"] / spacing), round(solid["length"] / spacing)
    scale = math.sqrt(ranks)
    wider = max(2, 2 * round(rows * scale / 2))
    settings = {"solid.thickness": wider * spacing, "solid.length": round(columns * rows * ranks / wider) * spacing}
    if drop["shape"] != "none":
        settings["drop.diameter"] = drop["diameter"] * scale
    return settings


@dataclass(frozen=True)
class Timing:
    """What one run took; times in s."""

    ranks: int
    hosts: int
    particles: int
    steps: int
    wall_time: float
    stepping_time: float

    @property
    def cost(self) -> float:
        """Wall time for a particle and a step, s."""
        return self.stepping_time / (self.particles * self.steps)


def timing_of(record: Mapping[str, Any]) -> Timing:
    """From a finished run's run.json."""
    details = record["details"]
    phases = {name: seconds for name, seconds in details.items() if name.startswith("seconds in ")}
    stepping = sum(phases.values()) - phases.get("seconds in output", 0.0)
    return Timing(record["ranks"], len(record["ranks_by_host"]), details["particles"], details["steps"],
                  record["wall_time_seconds"], stepping)


def timings_in(folder: Path) -> list[Timing]:
    """The fastest run on each number of ranks, ascending. Raises ScalingError if there is none, or one did not finish."""
    best: dict[int, Timing] = {}
    for path in sorted(folder.glob("*/run.json")):
        record = json.loads(path.read_text(encoding="utf-8"))
        if record["status"] != "completed" or "restarted_from" in record["details"]:
            raise ScalingError(f"{path.parent} is no run from beginning to end: {record['status']}")
        timing = timing_of(record)
        if timing.ranks not in best or timing.cost < best[timing.ranks].cost:
            best[timing.ranks] = timing
    if not best:
        raise ScalingError(f"there are no runs in {folder}")
    return [best[ranks] for ranks in sorted(best)]


def table_of(timings: Sequence[Timing]) -> list[dict[str, float]]:
    """COLUMNS of each. The speed-up is in particles and steps a second, against the fewest ranks."""
    first = timings[0]
    rows = []
    for timing in timings:
        speed_up = first.cost / timing.cost
        rows.append(dict(zip(COLUMNS, (
            timing.ranks, timing.hosts, timing.particles, timing.steps, round(timing.wall_time, 3),
            round(timing.stepping_time, 3), round(timing.cost * 1e9, 3), round(speed_up, 3),
            round(speed_up * first.ranks / timing.ranks, 3),
        ))))
    return rows


def write_table(folder: Path) -> None:
    rows = table_of(timings_in(folder))
    with (folder / "scaling.csv").open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    for line in (list(COLUMNS), *([str(value) for value in row.values()] for row in rows)):
        print("  ".join(cell.rjust(len(column)) for cell, column in zip(line, COLUMNS)))


def main(arguments: Sequence[str]) -> int:
    try:
        match arguments:
            case ["--help" | "-h"]:
                print(__doc__)
            case ["weak", case_file, ranks] if ranks.isdigit() and int(ranks) > 0:
                case = tomllib.loads(Path(case_file).read_text(encoding="utf-8"))
                for key, value in weak_settings(case, int(ranks)).items():
                    print(f"--set={key}={value:.17g}")
            case ["table", folder]:
                write_table(Path(folder))
            case _:
                print(__doc__, file=sys.stderr)
                return 2
    except (ScalingError, OSError, ValueError) as error:
        print(f"scaling.py: {error}", file=sys.stderr)
        return 2
    except KeyError as error:
        print(f"scaling.py: there is no {error}: not an effective case or not a finished run", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
