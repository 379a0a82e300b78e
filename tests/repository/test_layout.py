"""How the tree is kept: what lies where, sizes, headers, and that no file is forgotten by the build."""

from __future__ import annotations

import json
import os
import re
import subprocess
import unittest
from pathlib import Path

from repository import ROOT, build_folder, text_of, tracked_files

TOP_LEVEL = {"CMakeLists.txt", "CMakePresets.json", "README.md", "src", "decomposition", "io", "cases", "tests", "jobs"}
DATA_SUFFIXES = {".csv", ".svg", ".png", ".pdf"}
MOST_LINES = 450
MOST_BYTES = 1 << 20
# A table that a program writes into a page is data, like a .csv file.
WRITTEN_TABLE = re.compile(r"^<!-- \w+: written by .*? -->$.*?^<!-- end of \w+ -->$", flags=re.DOTALL | re.MULTILINE)

# Put together from pieces, so that this file does not contain them.
UNFINISHED = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b")
MAKING = re.compile(r"#\d+ of\b|\b(?:issue|pull request|ticket|PR) #\d+|(?i:\bchat" r"gpt\b|\bcl" r"aude\b|\blanguage model)")
OWN_PATHS = re.compile(r"(?<![\w.$}])/(?:wor" r"k|home|root|Users|tmp/build)\b[-\w]*/?")


def is_text(path: Path) -> bool:
    return b"\0" not in (ROOT / path).read_bytes()


def compiled_files() -> set[Path]:
    commands = json.loads((build_folder() / "compile_commands.json").read_text(encoding="utf-8"))
    return {Path(command["directory"], command["file"]).resolve() for command in commands}


def commands_of_tests() -> list[str]:
    shown = subprocess.run(
        ["ctest", "--show-only=json-v1"], cwd=build_folder(), capture_output=True, text=True, check=True
    )
    return [" ".join(test.get("command", [])) for test in json.loads(shown.stdout)["tests"]]


class Layout(unittest.TestCase):
    def test_top_level_holds_only_what_belongs_there(self) -> None:
        entries = {path.parts[0] for path in tracked_files()}
        self.assertEqual({entry for entry in entries if not entry.startswith(".")} - TOP_LEVEL, set())

    def test_files_are_short(self) -> None:
        for path in tracked_files():
            if path.suffix not in DATA_SUFFIXES and is_text(path):
                with self.subTest(file=str(path)):
                    text = text_of(path)
                    if path.suffix == ".md":
                        text = WRITTEN_TABLE.sub("", text)
                    self.assertLess(len(text.splitlines()), MOST_LINES)

    def test_files_are_small(self) -> None:
        for path in tracked_files():
            with self.subTest(file=str(path)):
                self.assertLessEqual((ROOT / path).stat().st_size, MOST_BYTES)

    def test_headers_are_included_once(self) -> None:
        headers = [path for path in tracked_files() if path.suffix == ".hpp"]
        self.assertTrue(headers)
        for path in headers:
            with self.subTest(file=str(path)):
                self.assertIn("#pragma once", text_of(path).splitlines())

    def test_files_are_finished_and_speak_of_the_project_alone(self) -> None:
        for path in tracked_files():
            if not is_text(path):
                continue
            for number, line in enumerate(text_of(path).splitlines(), start=1):
                # The first line of a script names its interpreter.
                if number == 1 and line.startswith("#!"):
                    continue
                for pattern in (UNFINISHED, MAKING, OWN_PATHS):
                    found = pattern.search(line)
                    self.assertIsNone(found, f"{path}:{number}: {line.strip()}")


class Registration(unittest.TestCase):
    def test_every_source_file_is_compiled(self) -> None:
        compiled = compiled_files()
        sources = [path for path in tracked_files() if path.suffix == ".cpp"]
        self.assertTrue(sources)
        for path in sources:
            if path.parts[:2] == ("tests", "benchmarks") and os.environ["SPHDROP_BENCHMARKS"] != "ON":
                continue
            with self.subTest(file=str(path)):
                self.assertTrue((ROOT / path).resolve() in compiled, f"no CMakeLists.txt names {path}")

    def test_every_python_test_is_run(self) -> None:
        commands = commands_of_tests()
        scripts = [path for path in tracked_files() if path.parts[0] == "tests" and path.match("test_*.py")]
        self.assertTrue(scripts)
        for path in scripts:
            with self.subTest(file=str(path)):
                self.assertTrue(
                    any(str(ROOT / path) in command for command in commands), "no CMakeLists.txt makes it a test"
                )


if __name__ == "__main__":
    unittest.main()
