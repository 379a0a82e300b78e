"""The table of a sweep: a CSV file whose header names parameters; each row is a run. Lines that begin with # are comments."""

from __future__ import annotations

import csv
import itertools
from collections.abc import Mapping, Sequence
from pathlib import Path


class SweepError(Exception):
    """A table that is not as it should be, or a run that it does not have; the text says which and why."""


Table = Sequence[Mapping[str, str]]


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


def grid(axes: Sequence[str]) -> list[dict[str, str]]:
    """Every combination of "parameter=value;value;...", the last parameter varying fastest."""
    columns: dict[str, list[str]] = {}
    for axis in axes:
        name, equals, values = axis.partition("=")
        found = [value.strip() for value in values.split(";")]
        if not equals or not name.strip() or "" in found:
            raise SweepError(f"'{axis}' is not of the form parameter=value;value;...")
        if name.strip() in columns:
            raise SweepError(f"{name.strip()} is there twice")
        columns[name.strip()] = found
    return [dict(zip(columns, row)) for row in itertools.product(*columns.values())]


def folder_of(number: int) -> str:
    return f"run_{number:03d}"


def row_of(table: Table, number: str) -> int:
    if not number.isascii() or not number.isdigit() or int(number) >= len(table):
        raise SweepError(f"there is no run {number}; there are 0 to {len(table) - 1}")
    return int(number)


def settings(row: Mapping[str, str]) -> list[str]:
    """A row as arguments of sphdrop."""
    return [f"--set={key}={value}" for key, value in row.items()]
