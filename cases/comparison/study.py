"""A case folder as a study: which runs it takes, what is expected of them, and how they are measured and drawn.

A study is a folder under cases/ with, beside its case.cfg,

    runs.toml      the runs at each level of resolution (below),
    expected.csv   a row for each level and quantity: theory, paper, goal, our own value and its tolerance,
    plot.py        measure(results) -> {quantity: value in SI units}, draw(results, folder) -> [Drawing, ...].

runs.toml, where --set arguments of the program stand in tables:

    [levels.paper]                     # as the paper resolved it; the other levels are quick and short
    set = {}
    [levels.short]
    set = {"resolution.spacing" = 6.25e-5, "time.end" = 1e-4}
    runs = ["U0_0.8"]                  # only these; without it, all that do not name their levels

    modern = ["U0_0.8"]                # these a second time in mode modern; without it, none

    [runs."U0_0.8"]
    set = {"drop.velocity" = [0, -0.8]}    # goes before what the level sets
    levels = ["paper", "quick"]            # only there; [] for a run that is made in mode modern alone

    [modern]
    set = {"time.sound_cfl" = 0.4}         # what runs in mode modern have besides

A run in mode modern is called U0_0.8_modern, and is measured and told of under the name of its twin U0_0.8: measure() is asked
twice, for the runs of the paper's scheme and for those in mode modern, and both values stand in one row. expected.csv records
the second in its columns modern and modern_tolerance, which a study without such runs leaves out. Where theory has another
value for mode modern, as a liquid of another viscosity swings otherwise, a column modern_theory says it.
"""

from __future__ import annotations

import csv
import importlib.util
import math
import sys
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

CASES = Path(__file__).resolve().parents[1]
for folder in (CASES, CASES.parent / "io"):
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))

from sphdrop_reader import Run  # noqa: E402

LEVELS = ("paper", "quick", "short")

# What a unit of expected.csv is in SI units.
UNITS = {
    "1": 1.0, "%": 1e-2, "s": 1.0, "ms": 1e-3, "us": 1e-6, "m": 1.0, "mm": 1e-3, "um": 1e-6, "m/s": 1.0, "rad/s": 1.0,
    "rad": 1.0, "deg": math.pi / 180, "Hz": 1.0, "Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "N s/m": 1.0, "J/m": 1.0, "1/m": 1.0,
}


EXPECTED_COLUMNS = ("level", "quantity", "unit", "theory", "paper", "goal", "goal_tolerance", "ours", "tolerance", "description")
MODERN_COLUMNS = ("modern", "modern_tolerance")
MODERN_THEORY = "modern_theory"
MODERN = "_modern"  # how the names of runs in mode modern end


class StudyError(Exception):
    """A case folder that is not as it should be; the text says which file and what."""


@dataclass(frozen=True)
class Variant:
    """One run of a study: its name and the parameters by which it differs from the folder's case.cfg."""

    name: str
    settings: Mapping[str, Any]
    twin: str = ""  # of a run in mode modern: the run that it repeats

    @property
    def arguments(self) -> list[str]:
        """The program's arguments."""
        return [f"--set={key}={toml_value(value)}" for key, value in self.settings.items()]


@dataclass(frozen=True)
class Expected:
    """A row of expected.csv, in the row's unit. NaN stands for an empty cell."""

    level: str
    quantity: str
    unit: str
    theory: float
    paper: float
    goal: float            # the number to meet
    goal_tolerance: float
    ours: float            # what this program gave when the row was written
    tolerance: float       # by which a run may differ from it
    description: str
    modern: float = math.nan            # what it gave in mode modern
    modern_tolerance: float = math.nan
    modern_theory: float = math.nan     # where it is not that of the paper's scheme

    def from_si(self, value: float) -> float:
        return value / UNITS[self.unit]


@dataclass(frozen=True)
class Drawing:
    """A picture that draw() made."""

    path: Path
    caption: str
    paper_figure: str = ""  # the figure of the paper that it redraws, "Fig. 14"


class Results(Mapping[str, Run]):
    """The finished runs of a study by name."""

    def __init__(self, runs: Mapping[str, Path], level: str, modern: Mapping[str, Path] | None = None) -> None:
        self._paths = dict(runs)
        self._opened: dict[str, Run] = {}
        self._modern = dict(modern or {})
        self.level = level

    @cached_property
    def modern(self) -> Results:
        """Those in mode modern by the names of their twins."""
        return Results(self._modern, self.level)

    def __getitem__(self, name: str) -> Run:
        if name not in self._opened:
            self._opened[name] = Run(self._paths[name])
        return self._opened[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._paths)

    def __len__(self) -> int:
        return len(self._paths)

    def matching(self, prefix: str) -> dict[str, Run]:
        """The runs whose names begin so, in the order of runs.toml."""
        return {name: self[name] for name in self if name.startswith(prefix)}


class Study:
    """A case folder. Raises StudyError where its files are missing or contradict each other."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._table = self._read_runs()

    @property
    def name(self) -> str:
        return self.folder.name

    @property
    def case_file(self) -> Path:
        return self.folder / "case.cfg"

    def _read_runs(self) -> dict[str, Any]:
        path = self.folder / "runs.toml"
        try:
            table = tomllib.loads(path.read_text(encoding="utf-8"))
        except (OSError, tomllib.TOMLDecodeError) as error:
            raise StudyError(f"{path}: {error}") from error
        for section in set(table) - {"levels", "runs", "modern"}:
            raise StudyError(f"{path}: [{section}] is none of [levels.*], [runs.*] and [modern]")
        for key in set(table.get("modern", {})) - {"set"}:
            raise StudyError(f"{path}: [modern] has an unknown key '{key}'")
        for level in set(table.get("levels", {})) - set(LEVELS):
            raise StudyError(f"{path}: there is no level '{level}'; there are {', '.join(LEVELS)}")
        for kind, allowed in (("levels", {"set", "runs", "modern"}), ("runs", {"set", "levels"})):
            for name, entry in table.get(kind, {}).items():
                for key in set(entry) - allowed:
                    raise StudyError(f"{path}: [{kind}.{name}] has an unknown key '{key}'")
        for name, level in table.get("levels", {}).items():
            for run in {*level.get("runs", []), *level.get("modern", [])} - set(table.get("runs", {})):
                raise StudyError(f"{path}: [levels.{name}] names the run '{run}', which there is not")
        for run in table.get("runs", {}):
            if run.endswith(MODERN):
                raise StudyError(f"{path}: [runs.{run}]: names that end with {MODERN} are those of runs in mode modern")
        return table

    def variants(self, level: str) -> list[Variant]:
        """The runs of a level, in the order of runs.toml, and then those in mode modern; none if the study leaves the level out."""
        if level not in self._table.get("levels", {}):
            return []
        entry = self._table["levels"][level]
        found = []
        for name, run in self._table.get("runs", {}).items():
            if "runs" in entry:
                wanted = name in entry["runs"]
            else:
                wanted = level in run.get("levels", LEVELS)
            if wanted:
                found.append(Variant(name, {**run.get("set", {}), **entry.get("set", {})}))
        modern = {**entry.get("set", {}), "mode": "modern", **self._table.get("modern", {}).get("set", {})}
        found += [Variant(name + MODERN, {**run.get("set", {}), **modern}, twin=name)
                  for name, run in self._table.get("runs", {}).items() if name in entry.get("modern", [])]
        return found

    def results(self, level: str, folders: Mapping[str, Path]) -> Results:
        """Of finished runs by their own names."""
        there = [variant for variant in self.variants(level) if variant.name in folders]
        return Results({variant.name: folders[variant.name] for variant in there if not variant.twin}, level,
                       {variant.twin: folders[variant.name] for variant in there if variant.twin})

    def parameters(self, variant: Variant) -> dict[str, Any]:
        """case.cfg's table with the variant's settings in it; what neither says is not there."""
        try:
            table = tomllib.loads(self.case_file.read_text(encoding="utf-8"))
        except (OSError, tomllib.TOMLDecodeError) as error:
            raise StudyError(f"{self.case_file}: {error}") from error
        for key, value in variant.settings.items():
            *sections, name = key.split(".")
            section = table
            for part in sections:
                section = section.setdefault(part, {})
            section[name] = value
        return table

    def expected(self, level: str) -> list[Expected]:
        """The rows of expected.csv for a level."""
        path = self.folder / "expected.csv"
        try:
            with path.open(newline="", encoding="utf-8") as stream:
                reader = csv.DictReader(stream)
                rows = list(reader)
        except OSError as error:
            raise StudyError(f"{path}: cannot be read: {error.strerror}") from error
        if absent := set(EXPECTED_COLUMNS) - set(reader.fieldnames or []):
            raise StudyError(f"{path}: has no column {', '.join(sorted(absent))}; they are {','.join(EXPECTED_COLUMNS)}")
        found: list[Expected] = []
        for number, row in enumerate(rows, start=2):
            expected = _expected_row(row, f"{path}: line {number}")
            if expected.level != level:
                continue
            if any(other.quantity == expected.quantity for other in found):
                raise StudyError(f"{path}: line {number}: '{expected.quantity}' is there twice at level {level}")
            found.append(expected)
        return found

    def module(self) -> ModuleType:
        """The study's plot.py."""
        path = self.folder / "plot.py"
        spec = importlib.util.spec_from_file_location(f"sphdrop_study_{self.name}", path)
        if spec is None or spec.loader is None or not path.is_file():
            raise StudyError(f"{path}: is missing")
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        spec.loader.exec_module(module)
        return module


def _expected_row(row: Mapping[str, str | None], place: str) -> Expected:
    if None in row or None in row.values():  # what csv makes of too many and too few cells
        raise StudyError(f"{place}: does not have {sum(key is not None for key in row)} cells; text with a comma goes in quotes")
    if row["unit"] not in UNITS:
        raise StudyError(f"{place}: there is no unit '{row['unit']}'; there are {', '.join(UNITS)}")
    if row["level"] not in LEVELS:
        raise StudyError(f"{place}: there is no level '{row['level']}'; there are {', '.join(LEVELS)}")
    if not row["quantity"]:
        raise StudyError(f"{place}: names no quantity")
    numbers = {}
    for key in ("theory", "paper", "goal", "goal_tolerance", "ours", "tolerance", *MODERN_COLUMNS, MODERN_THEORY):
        try:
            numbers[key] = float(row[key]) if (row.get(key) or "").strip() else math.nan
        except ValueError:
            raise StudyError(f"{place}: {key} is '{row[key]}', not a number") from None
    for value, tolerance in (("ours", "tolerance"), ("modern", "modern_tolerance"), ("goal", "goal_tolerance")):
        if not math.isnan(numbers[value]) and not numbers[tolerance] >= 0:
            raise StudyError(f"{place}: {value} needs its {tolerance}, a number not below 0")
    return Expected(row["level"], row["quantity"], row["unit"], **numbers, description=row["description"])


def toml_value(value: Any) -> str:
    """A value of runs.toml as --set takes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ",".join(toml_value(item) for item in value) + "]"
    return value if isinstance(value, str) else repr(value)


def all_studies(cases: Path = CASES) -> list[Study]:
    """Every folder under cases/ that has a runs.toml, in alphabetical order."""
    return [Study(path.parent) for path in sorted(cases.glob("*/runs.toml"))]
