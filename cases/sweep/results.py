"""What came of the runs of a sweep: sweep.csv."""

from __future__ import annotations

import csv
import json
import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from comparison import beam_quantities, quantities
from comparison.ledgers import drop_mass
from comparison.study import Run
from sweep.table import Table, folder_of

# Of a finished run, beside its parameters, in the order of the columns; the numbers of a case first.
NUMBERS = ("weber_number [1]", "reynolds_number [1]", "impact_speed [m/s]", "beam_period [s]", "deflection_theory [m]")
MEASURED = (
    "contact_time [s]", "impulse_time [s]", "largest_width [m]", "largest_width_time [s]", "spreading_ratio [1]",
    "largest_deflection [m]", "largest_deflection_time [s]", "relative_deflection [1]", "restitution [1]",
)
RECORDED = ("status", "state_hash", "particles", "steps", "ranks")


def numbers_of(run: Run) -> dict[str, float]:
    """NUMBERS of a run: what theory says before it runs (Eqs 44 and 46 for a beam); NaN where it says nothing."""
    whole = beam_quantities.case_of(run)
    case = with_first_bodies(whole)
    drop, fluid = case.get("drop", {}), case.get("fluid", {})
    found = dict.fromkeys(NUMBERS, math.nan)
    if drop.get("shape", "none") != "none" and "velocity" in drop:
        speed, density, size = math.hypot(*drop["velocity"]), float(fluid["density"]), float(drop["diameter"])
        found["impact_speed [m/s]"] = speed
        if drop.get("material") != "rigid":
            found["weber_number [1]"] = density * speed**2 * size / float(case["surface_tension"]["coefficient"])
            found["reynolds_number [1]"] = density * speed * size / fluid["viscosity"] if fluid["viscosity"] > 0 else math.inf
    if whole["solid"] == case["solid"] and bends(case) and "length" in case["solid"]:
        theory = beam_quantities.theory_of(run)
        found["beam_period [s]"], found["deflection_theory [m]"] = theory.period, theory.largest_deflection
    return found


def with_first_bodies(case: dict[str, Any]) -> dict[str, Any]:
    """The case as if of several drops or solids there were the first alone, which the history's own columns are about."""
    return {section: values[0] if isinstance(values, list) else values for section, values in case.items()}


def bends(case: dict[str, Any]) -> bool:
    return case["solid"]["kind"] in ("cantilever", "fixed_fixed_beam")


def measured(run: Run) -> dict[str, float]:
    """MEASURED of a finished run; NaN where it has none, as the contact time of a drop that has not left."""
    case = with_first_bodies(beam_quantities.case_of(run))
    is_beam, has_drop = bends(case) or case["solid"]["kind"] == "polygon", case["drop"]["shape"] != "none"
    touches = has_drop and case["solid"]["kind"] != "none"
    contact_time: Callable[[Any], float] = beam_quantities.contact_time if is_beam else quantities.contact_time
    impulse_time: Callable[[Any], float] = beam_quantities.impulse_time if is_beam else quantities.impulse_time
    nothing = (math.nan, math.nan)
    width_time, width = quantities.largest_width(run) if has_drop else nothing
    deepest_time, deepest = beam_quantities.deepest_deflection(run) if is_beam else nothing
    size, length = case["drop"].get("diameter", math.nan), case["solid"].get("length", math.nan)
    return dict(zip(MEASURED, (
        contact_time(run) if touches else math.nan, impulse_time(run) if touches else math.nan, width, width_time, width / size,
        deepest, deepest_time, deepest / length if is_beam else math.nan, quantities.restitution(run) if touches else math.nan,
    )))


def outcome(folder: Path) -> dict[str, Any]:
    """All columns of a run; what it has not is left out."""
    try:
        record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {"status": "missing"}
    except (OSError, ValueError) as error:
        return {"status": f"run.json cannot be read: {error}"}
    columns = {name: {**record, **record.get("details", {})}.get(name, "") for name in RECORDED}
    if columns["status"] != "completed":
        return columns
    run = Run(folder)
    return {**columns, **numbers_of(run), **measured(run)}


def collect(table: Table, results: Path) -> list[dict[str, Any]]:
    """Writes sweep.csv, says what is missing, and returns the rows."""
    rows = [{"run": folder_of(number), **parameters, **outcome(results / folder_of(number))}
            for number, parameters in enumerate(table)]
    target = results / "sweep.csv"
    aside = results / "sweep.csv.part"
    with aside.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, ["run", *table[0], *RECORDED, *NUMBERS, *MEASURED], restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    os.replace(aside, target)
    unfinished = [row for row in rows if row["status"] != "completed"]
    print(f"{target}: {len(rows) - len(unfinished)} of {len(rows)} runs finished")
    for row in unfinished:
        print(f"  {row['run']}: {row['status']}")
    return rows
