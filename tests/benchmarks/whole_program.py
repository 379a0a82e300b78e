#!/usr/bin/python3
"""What whole runs cost, with history and output on: time per particle and step, phases, and what several ranks gain.

    /usr/bin/python3 tests/benchmarks/whole_program.py [RUN...] [--program FILE]... [--ranks 1,2] [--repeats 3]

Without a RUN all of them (--list names them). Programs and numbers of ranks are run in turn, so that a machine whose speed
changes is unkind to all alike; the best of the repeats counts, and all pairs of repeats give the efficiencies. A run that
begins late goes on from a checkpoint, which the first program makes. Ranks are bound to cores: leave the others alone.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
MPIEXEC = os.environ.get("SPHDROP_MPIEXEC", "mpiexec")


@dataclass(frozen=True)
class Run:
    """A part of a case, s."""

    case: str
    until: float
    begin: float = 0.0
    settings: tuple[str, ...] = ()


TOTAL_LAGRANGIAN, MODERN, FAST = 'solid.formulation="total_lagrangian"', 'mode="modern"', 'mode="fast"'
RUNS = {
    "hypoelastic beam": Run("free_vibration", 1e-4),
    "total-Lagrangian beam": Run("free_vibration", 1e-4, settings=(TOTAL_LAGRANGIAN,)),
    "beam of cells": Run("free_vibration", 1e-4, settings=(MODERN,)),
    "cantilever 8 mm": Run("cantilever", 5e-4, 4e-4),
    "cantilever 20 mm": Run("cantilever", 4.6e-4, 4e-4, ("solid.length=0.02",)),
    "cantilever, modern": Run("cantilever", 5e-4, 4e-4, (MODERN,)),
    "cantilever, fast": Run("cantilever", 6e-3, settings=(FAST, "time.end=6e-3")),
}


class BenchmarkError(Exception):
    """A run that did not end as it should."""


@dataclass(frozen=True)
class Timing:
    """Of a run: wall time and its phases, s."""

    particles: int
    steps: int
    total: float
    phases: Mapping[str, float]
    state_hash: str

    @property
    def cost(self) -> float:
        """s a particle and step."""
        return self.total / (self.particles * self.steps)


def timing_of(record: Mapping[str, Any]) -> Timing:
    """From a finished run's run.json."""
    details = record["details"]
    phases = {name.removeprefix("seconds in "): seconds for name, seconds in details.items() if name.startswith("seconds in ")}
    steps = details["steps"] - details.get("restarted_at_step", 0)
    return Timing(details["particles"], steps, record["wall_time_seconds"], phases, record["state_hash"])


def efficiencies(alone: Sequence[Timing], together: Sequence[Timing], ranks: int) -> tuple[float, float, float]:
    """Lowest and highest of the pairs of repeats made in turn, and that of the best times."""
    pairs = [a.total / (ranks * b.total) for a, b in zip(alone, together, strict=True)]
    best = min(a.total for a in alone) / (ranks * min(b.total for b in together))
    return min(pairs), max(pairs), best


def start(program: Path, ranks: int, run: Run, folder: Path, *options: str) -> Timing:
    """Raises BenchmarkError if the program does not end well."""
    settings = [word for setting in run.settings for word in ("--set", setting)]
    command = [MPIEXEC, "-n", str(ranks), "--bind-to", "core", str(program), str(ROOT / "cases" / run.case / "case.cfg"), *settings,
               "--output", str(folder), "--quiet", *options]
    known = {name: value for name, value in os.environ.items() if name != "OMPI_MCA_mpi_yield_when_idle"}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=known)
    if done.returncode != 0:
        raise BenchmarkError(f"{' '.join(command)} ends with {done.returncode}:\n{done.stderr}")
    return timing_of(json.loads((folder / "run.json").read_text(encoding="utf-8")))


def measure(run: Run, programs: Sequence[Path], ranks: Sequence[int], repeats: int) -> dict[tuple[Path, int], list[Timing]]:
    """Raises BenchmarkError too if the programs do not agree on the state at the end."""
    timings: dict[tuple[Path, int], list[Timing]] = {(program, count): [] for program in programs for count in ranks}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        beginning = ["--fresh"]
        if run.begin > 0:
            start(programs[0], 1, run, folder / "before", "--fresh", "--until", f"{run.begin:g}")
            beginning = ["--restart", str(max((folder / "before").glob("checkpoint_*.h5")))]
        for _ in range(repeats):
            for number, ((program, count), found) in enumerate(timings.items()):
                found.append(start(program, count, run, folder / f"run{len(found)}_{number}", *beginning, "--until", f"{run.until:g}"))
    hashes = {timing.state_hash for found in timings.values() for timing in found}
    if len(hashes) > 1:
        raise BenchmarkError(f"the programs differ in the state at the end: {', '.join(sorted(hashes))}")
    return timings


def rows(name: str, timings: Mapping[tuple[Path, int], Sequence[Timing]], phases: Sequence[str]) -> list[str]:
    """Of the table: each program on each number of ranks, its phases in us a step."""
    programs = list(dict.fromkeys(program for program, _ in timings))
    lines = []
    for (program, ranks), found in timings.items():
        best = min(found, key=lambda timing: timing.total)
        gain = "-"
        if ranks > 1 and (program, 1) in timings:
            low, high, of_best = efficiencies(timings[program, 1], found, ranks)
            gain = f"{of_best:.3f} ({low:.3f} to {high:.3f})"
        label = name if len(programs) == 1 else f"{name}, {program}"
        costs = " | ".join(f"{1e6 * best.phases.get(phase, 0.0) / best.steps:.2f}" for phase in phases)
        lines.append(f"| {label} | {ranks} | {1e9 * best.cost:.2f} | {1e6 * best.total / best.steps:.1f} | {gain} | {costs} |")
    return lines


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="*", metavar="RUN", help="by name; all without")
    parser.add_argument("--list", action="store_true", help="name the runs")
    parser.add_argument("--program", type=Path, action="append", help="default: build/release/src/sphdrop")
    parser.add_argument("--ranks", default="1,2", help="numbers of ranks, default 1,2")
    parser.add_argument("--repeats", type=int, default=3)
    chosen = parser.parse_args(arguments)
    if chosen.list:
        print("\n".join(RUNS))
        return 0
    unknown = [name for name in chosen.runs if name not in RUNS]
    if unknown:
        parser.error(f"there is no run '{unknown[0]}'; there are: {', '.join(RUNS)}")
    if not all(word.isdigit() and int(word) > 0 for word in chosen.ranks.split(",")) or chosen.repeats < 1:
        parser.error("--ranks takes numbers from 1 on with commas between, --repeats one number from 1 on")
    programs = chosen.program or [ROOT / "build/release/src/sphdrop"]
    ranks = [int(word) for word in chosen.ranks.split(",")]
    phases: list[str] = []
    try:
        for name in chosen.runs or RUNS:
            timings = measure(RUNS[name], programs, ranks, chosen.repeats)
            if not phases:
                phases = list(next(iter(timings.values()))[0].phases)
                print("| run | ranks | ns a particle and step | us a step | efficiency | " + " | ".join(phases) + " |")
                print("|---" * (5 + len(phases)) + "|")
            print("\n".join(rows(name, timings, phases)), flush=True)
    except BenchmarkError as error:
        print(f"whole_program.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
