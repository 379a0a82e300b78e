"""Counts the instructions of every sweep and compares them with those recorded: a sweep that became slower by accident shows here.

    instruction_counts.py PROGRAM COMPILER [--record]

Valgrind counts what PROGRAM (sweep_instructions) executes; COMPILER is its compiler and version. The record is in instruction_counts.csv; counts of
another compiler cannot be compared and are not (exit code 77, which CTest takes for skipped). After a change that is meant to cost more, or a new
compiler, record anew: cmake --build BUILD --target record_instruction_counts. A count that grew by more than 3 % fails; one that fell by more is worth
recording, so that it is not lost again.
"""

from __future__ import annotations

import csv
import re
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

RECORD = Path(__file__).parent / "instruction_counts.csv"
LARGEST_GROWTH = 0.03
SKIPPED = 77

# What is counted, by the name of the function and of the body whose sweep it is: a function may serve several.
COUNTED = (
    "HypoelasticSweep::update_stress", "HypoelasticSweep::apply", "TotalLagrangianSweep::relist", "TotalLagrangianSweep::deform",
    "TotalLagrangianSweep::accelerate", "CellSweep::sweep", "CellSweep::accelerate", "FluidSweep::pack", "FluidSweep::apply",
    "moving_least_squares_densities", "ForceSharing::rebuild", "ForceSharing::share", "ContactSolver::rebuild", "ContactSolver::apply",
    "SlicedNeighbours::build", "OffsetNeighbours::build", "predict(FluidParticles", "predict(SolidParticles", "predict_velocity",
    "kick_and_drift(FluidParticles", "kick_and_drift(SolidParticles", "kick_and_drift_velocity",
)


def inclusive(text: str) -> tuple[Counter[str], Counter[str]]:
    """Of a file of callgrind's: by function the instructions it and all it calls executed when called by others, and its calls."""
    names: dict[str, str] = {}
    cost: Counter[str] = Counter()
    calls: Counter[str] = Counter()
    callee, caller = "", ""
    of_call = False
    for line in text.splitlines():
        if found := re.match(r"(c?)fn=\((\d+)\)(?: (.*))?$", line):
            if found[3]:
                names[found[2]] = found[3]
            if found[1]:
                callee = found[2]
            else:
                caller = found[2]
        elif line.startswith("calls="):
            of_call = callee != caller
            if of_call:
                calls[callee] += int(line[6:].split()[0])
            continue
        elif of_call and line[:1] in "0123456789+-*" and line:
            cost[callee] += int(line.split()[1])
            of_call = False
    return (Counter({names[key]: value for key, value in cost.items()}), Counter({names[key]: value for key, value in calls.items()}))


def counts(program: str) -> dict[str, int]:
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "callgrind.out"
        run = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={output}", program], capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"valgrind {program} ended with {run.returncode}:\n{run.stdout}{run.stderr}")
        cost, calls = inclusive(output.read_text(errors="replace"))
    result = {}
    for wanted in COUNTED:
        # Not the clones that the compiler has made of it, which it calls itself.
        pattern = re.compile(rf"(sphdrop::)?{re.escape(wanted).replace('predict', '(sphdrop::)?predict')}")
        matches = [name for name in cost if pattern.match(name.replace("sphdrop::", "")) and "[clone" not in name]
        if not matches:
            sys.exit(f"{program} no longer calls {wanted}: see COUNTED in {__file__}")
        result[wanted] = sum(cost[name] for name in matches) // sum(calls[name] for name in matches)
    return result


def main() -> int:
    program, compiler, *options = sys.argv[1:]
    if options not in ([], ["--record"]):
        sys.exit(__doc__)
    present = counts(program)
    if options:
        with RECORD.open("w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["function", "instructions a call", compiler])
            writer.writerows([name, count, ""] for name, count in present.items())
        print(f"recorded {len(present)} counts in {RECORD}")
        return 0
    with RECORD.open(newline="") as file:
        (_, _, recorded_compiler), *rows = csv.reader(file)
    recorded = {name: int(count) for name, count, _ in rows}
    failed = recorded.keys() != present.keys()
    for name, count in present.items():
        change = count / recorded.get(name, count) - 1
        remark = "" if abs(change) <= LARGEST_GROWTH else "  <- slower" if change > 0 else "  <- faster: record it"
        failed = failed or change > LARGEST_GROWTH
        print(f"{name:34} {count:9} {100 * change:+6.2f} %{remark}")
    if compiler != recorded_compiler:
        print(f"recorded with {recorded_compiler}, counted with {compiler}: not compared")
        return SKIPPED
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
