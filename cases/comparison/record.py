#!/usr/bin/python3
"""Writes what finished runs measure into expected.csv, after a change of the method that is meant: the runs of the paper's
scheme into the column `ours`, those in mode modern into the column `modern`.

    /usr/bin/python3 cases/comparison/record.py [STUDY ...] [--level paper] [--results results/comparison] [--only-empty]
                                                [--mode both]

Every other cell stays as it is; an empty tolerance becomes that of the paper's scheme in the same row or, where there is none,
a two hundredth of the value. Look at the difference before you
keep it: from then on it is what runs are checked against.
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Mapping
from pathlib import Path

CASES = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(CASES))
from comparison.standalone import finished_runs  # noqa: E402
from comparison.study import LEVELS, MODERN_COLUMNS, UNITS, Study, StudyError, all_studies  # noqa: E402

SHARE = 0.005  # of the value, where a row names no tolerance


MODES = {"paper": ("ours", "tolerance"), "modern": MODERN_COLUMNS}


def record(path: Path, level: str, measured: Mapping[str, float], only_empty: bool = False, mode: str = "paper") -> int:
    """Rewrites a file's rows of a level from values in SI units that a mode's runs gave; returns how many rows changed."""
    with path.open(newline="", encoding="utf-8") as stream:
        reader = csv.DictReader(stream)
        names, rows = list(reader.fieldnames or []), list(reader)
    column, tolerance = MODES[mode]
    if measured and column not in names:
        names[names.index("description"):names.index("description")] = [column, tolerance]
        for row in rows:
            row |= {column: "", tolerance: ""}
    changed = 0
    for row in rows:
        if row["level"] != level or row["quantity"] not in measured or (only_empty and row[column].strip()):
            continue
        value = measured[row["quantity"]] / UNITS[row["unit"]]
        before = dict(row)
        row[column] = f"{value:.6g}"
        row[tolerance] = row[tolerance].strip() or (mode == "modern" and row["tolerance"].strip()) or f"{SHARE * abs(value):.2g}"
        changed += row != before
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, names, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return changed


def main() -> int:
    parser = argparse.ArgumentParser(description="Writes measured values into expected.csv.")
    parser.add_argument("studies", nargs="*", metavar="STUDY", help="default: all that have an expected.csv")
    parser.add_argument("--level", choices=LEVELS, default="paper")
    parser.add_argument("--results", type=Path, default=CASES.parent / "results" / "comparison")
    parser.add_argument("--mode", choices=[*MODES, "both"], default="both", help="whose runs' values (default: both)")
    parser.add_argument("--only-empty", action="store_true", help="leave rows that have a value")
    chosen = parser.parse_args()
    try:
        studies = [Study(CASES / name) for name in chosen.studies] or all_studies()
        for study in studies:
            expected = study.folder / "expected.csv"
            names = [variant.name for variant in study.variants(chosen.level)]
            runs = finished_runs(chosen.results / chosen.level / study.name, names)
            if not runs or not expected.is_file():
                continue
            results = study.results(chosen.level, runs)
            for mode, those in (("paper", results), ("modern", results.modern)):
                if those and chosen.mode in (mode, "both"):
                    count = record(expected, chosen.level, study.module().measure(those), chosen.only_empty, mode)
                    print(f"{study.name}: {len(those)} runs of mode {mode}, {count} rows written")
    except StudyError as error:
        print(f"record.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
