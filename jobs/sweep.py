#!/usr/bin/python3
"""The table of a sweep: which runs it takes, and what came of them.

    /usr/bin/python3 jobs/sweep.py count TABLE              how many runs
    /usr/bin/python3 jobs/sweep.py folder TABLE NUMBER      the name of a run's folder; the first run is 0
    /usr/bin/python3 jobs/sweep.py settings TABLE NUMBER    its arguments of sphdrop, one a line
    /usr/bin/python3 jobs/sweep.py collect TABLE FOLDER     writes FOLDER/sweep.csv; exit code 1 if a run is missing or did not finish

A table is CSV (jobs/sweep_table.csv): its header names parameters, each row is a run; lines that begin with # are comments.
"""

from __future__ import annotations

import csv
import json
import math
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

# What is told of a finished run beside its parameters, in the order of the columns.
MEASURED = (
    "contact_time [s]", "largest_width [m]", "largest_width_time [s]", "largest_deflection [m]",
    "largest_deflection_time [s]", "restitution [1]",
)
RECORDED = ("status", "state_hash", "particles", "steps", "ranks")


class SweepError(Exception):
    """A table that is not as it should be, or a run that it does not have."""


def read_table(path: Path) -> list[dict[str, str]]:
    """A row for each run: values by the names of the parameters, as they are written."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError) as error:
        raise SweepError(f"{path} cannot be read: {error}") from error
    cells = [[cell.strip() for cell in row] for row in csv.reader(line for line in lines if line.strip() and line[0] != "#")]
    if len(cells) < 2:
        raise SweepError(f"{path} needs a header that names parameters, and a row for each run")
    header, rows = cells[0], cells[1:]
    if len(set(header)) < len(header):
        raise SweepError(f"{path} names a parameter twice: {', '.join(header)}")
    for number, row in enumerate(rows):
        if len(row) != len(header):
            raise SweepError(f"{path}: run {number} has {len(row)} values for {len(header)} parameters; "
                             'a value with commas stands in quotes, "[0, -0.8]"')
        if "" in row:
            raise SweepError(f"{path}: run {number} has no value of {header[row.index('')]}")
    return [dict(zip(header, row)) for row in rows]


def folder_of(number: int) -> str:
    return f"run_{number:03d}"


def row_of(table: Sequence[Mapping[str, str]], number: str) -> int:
    if not number.isascii() or not number.isdigit() or int(number) >= len(table):
        raise SweepError(f"there is no run {number}; there are 0 to {len(table) - 1}")
    return int(number)


def measured(run: Path) -> dict[str, float]:
    """The quantities MEASURED of a finished run; NaN where it has none, as the contact time of a drop that has not left."""
    # Only here, for the rest needs no numpy and no h5py.
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cases"))
    from comparison import beam_quantities, quantities
    from comparison.study import Run

    results = Run(run)
    case = beam_quantities.case_of(results)
    bends = case["solid"]["kind"] in ("cantilever", "fixed_fixed_beam")
    has_drop = case["drop"]["shape"] != "none"
    contact_time: Callable[[Any], float] = beam_quantities.contact_time if bends else quantities.contact_time
    nothing = (math.nan, math.nan)
    width_time, width = quantities.largest_width(results) if has_drop else nothing
    deepest_time, deepest = beam_quantities.deepest_deflection(results) if bends else nothing
    touches = has_drop and case["solid"]["kind"] != "none"
    return dict(zip(MEASURED, (
        contact_time(results) if touches else math.nan, width, width_time, deepest, deepest_time,
        quantities.restitution(results) if touches else math.nan,
    )))


def outcome(run: Path) -> dict[str, Any]:
    """The columns RECORDED and MEASURED of a run; what it has not is left out."""
    try:
        record = json.loads((run / "run.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {"status": "missing"}
    except (OSError, ValueError) as error:
        return {"status": f"run.json cannot be read: {error}"}
    columns = {name: {**record, **record.get("details", {})}.get(name, "") for name in RECORDED}
    return {**columns, **measured(run)} if columns["status"] == "completed" else columns


def collect(table: Sequence[Mapping[str, str]], results: Path) -> int:
    """Writes sweep.csv and says what is missing."""
    rows = [{"run": folder_of(number), **parameters, **outcome(results / folder_of(number))}
            for number, parameters in enumerate(table)]
    target = results / "sweep.csv"
    aside = results / "sweep.csv.part"
    with aside.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, ["run", *table[0], *RECORDED, *MEASURED], restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    os.replace(aside, target)
    unfinished = [row for row in rows if row["status"] != "completed"]
    print(f"{target}: {len(rows) - len(unfinished)} of {len(rows)} runs finished")
    for row in unfinished:
        print(f"  {row['run']}: {row['status']}")
    return 1 if unfinished else 0


def main(arguments: Sequence[str]) -> int:
    command, *rest = arguments or [""]
    if command in ("--help", "-h"):
        print(__doc__)
        return 0
    if (command, len(rest)) not in (("count", 1), ("folder", 2), ("settings", 2), ("collect", 2)):
        print(__doc__, file=sys.stderr)
        return 2
    try:
        table = read_table(Path(rest[0]))
        if command == "count":
            print(len(table))
        elif command == "folder":
            print(folder_of(row_of(table, rest[1])))
        elif command == "settings":
            print("\n".join(f"--set={key}={value}" for key, value in table[row_of(table, rest[1])].items()))
        else:
            return collect(table, Path(rest[1]))
    except SweepError as error:
        print(f"sweep.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
