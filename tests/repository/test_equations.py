"""src/EQUATIONS.md: every equation of the paper has its row, and what the rows name exists.

A row is one of a Markdown table whose heading names the columns "Equation", "Function" and "Test" (others may follow).
The first column holds numbers and ranges: `7, 8, 15`, `36-39`. Names stand in backticks: files from the root or from
src, functions and types, tests as `Suite.Case`, `Suite` or a file's name.
"""

from __future__ import annotations

import re
import unittest
from functools import cache
from pathlib import Path
from typing import NamedTuple

from repository import ROOT, code_of, text_of, tracked_files

PAGE = Path("src/EQUATIONS.md")
EQUATIONS = set(range(1, 48))


class Row(NamedTuple):
    line: int
    equations: set[int]
    functions: list[str]  # the names in backticks of its column
    tests: list[str]


def numbers_in(cell: str) -> set[int]:
    numbers: set[int] = set()
    for first, last in re.findall(r"(\d+)(?:\s*[-–]\s*(\d+))?", cell):
        numbers.update(range(int(first), int(last or first) + 1))
    return numbers


def rows() -> list[Row]:
    found: list[Row] = []
    columns: dict[str, int] = {}
    for number, line in enumerate(text_of(PAGE).splitlines(), start=1):
        if not line.lstrip().startswith("|"):
            columns = {}
            continue
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]
        if not columns:
            for position, cell in enumerate(cells):
                for name in ("equation", "function", "test"):
                    if cell.lower().startswith(name):
                        columns.setdefault(name, position)
            if len(columns) < 3:
                columns = {"none": 0}
        elif "equation" in columns and not re.fullmatch(r"[\s|:-]+", line):
            names = [re.findall(r"`([^`]+)`", cells[columns[name]]) for name in ("function", "test")]
            found.append(Row(number, numbers_in(cells[columns["equation"]]), *names))
    return found


def is_file(name: str) -> bool:
    return any((ROOT / base / name).is_file() for base in ("", "src", "tests"))


@cache
def words_of_program() -> set[str]:
    words: set[str] = set()
    for path in tracked_files():
        if path.parts[0] in ("src", "decomposition", "io") and path.suffix in (".hpp", ".cpp"):
            words.update(re.findall(r"\w+", re.sub(r'"[^"\n]*"', "", code_of(path))))
    return words


@cache
def names_of_tests() -> set[str]:
    """Suite.Case, Suite, Python's test functions and classes, files and their stems, programs of the CMakeLists."""
    names: set[str] = set()
    for path in tracked_files():
        if path.parts[0] != "tests":
            continue
        text = text_of(path) if path.suffix in (".cpp", ".hpp", ".py", ".txt") else ""
        if path.suffix in (".cpp", ".py"):
            names.update((path.name, path.stem))
        for suite, case in re.findall(r"\b(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", text):
            names.update((suite, f"{suite}.{case}"))
        if path.suffix == ".py":
            names.update(re.findall(r"^\s*(?:def|class) (\w+)", text, flags=re.MULTILINE))
        if path.name == "CMakeLists.txt":
            names.update(re.findall(r"\b(?:sphdrop_test\(|NAME\s+)([\w.]+)", text))
    return names


class Equations(unittest.TestCase):
    def test_every_equation_has_its_row(self) -> None:
        named = set().union(*(row.equations for row in rows()))
        self.assertEqual(sorted(EQUATIONS - named), [], "without a row")
        self.assertEqual(sorted(named - EQUATIONS), [], "the paper has no such equation")

    def test_every_row_names_a_function_and_a_test(self) -> None:
        for row in rows():
            with self.subTest(line=row.line):
                self.assertTrue(row.functions, "no function in backticks")
                self.assertTrue(row.tests, "no test in backticks")

    def test_functions_exist(self) -> None:
        for row in rows():
            for name in row.functions:
                with self.subTest(line=row.line, name=name):
                    last = re.split(r"::|\.", name.split("(")[0])[-1]
                    exists = is_file(name) if "/" in name or name.endswith((".hpp", ".cpp")) else last in words_of_program()
                    self.assertTrue(exists, "not in the program")

    def test_tests_exist(self) -> None:
        for row in rows():
            for name in row.tests:
                with self.subTest(line=row.line, name=name):
                    self.assertTrue(is_file(name) if "/" in name else name in names_of_tests(), "not among the tests")


if __name__ == "__main__":
    unittest.main()
