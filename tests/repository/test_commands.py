"""Every command that a document shows is run here, is run by a test that is named, or says why not (commands.py)."""

from __future__ import annotations

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from commands import NOT_RUN, QUICKSTART, RUN, TESTED
from repository import ROOT, build_folder, program_output, text_of
from test_documentation import SHELL_FENCES, documents


def shown_commands() -> list[tuple[str, str]]:
    """(document, command): one a line, without what a comment says."""
    found = []
    for document in documents():
        for fence in SHELL_FENCES.findall(text_of(document)):
            for line in fence.replace("\\\n", " ").splitlines():
                command = " ".join(line.split(" # ")[0].split())
                if command:
                    found.append((str(document), command))
    return found


def tests() -> dict[str, str]:
    """CTest's tests and their command lines."""
    shown = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build_folder(), capture_output=True, text=True, check=True)
    return {test["name"]: " ".join(test.get("command", [])) for test in json.loads(shown.stdout)["tests"]}


class Commands(unittest.TestCase):
    def test_each_has_its_place(self) -> None:
        for document, command in shown_commands():
            with self.subTest(document=document, command=command):
                places = [place for place in (RUN, TESTED, NOT_RUN) if command in place]
                self.assertEqual(len(places), 1, "put it into one table of tests/repository/commands.py")

    def test_none_is_left_of_those_no_longer_shown(self) -> None:
        self.assertEqual({*RUN, *TESTED, *NOT_RUN} - {command for _, command in shown_commands()}, set())

    def test_those_that_others_test_are_tested(self) -> None:
        known = tests()
        for command, (test, word) in TESTED.items():
            with self.subTest(command=command):
                self.assertTrue(test in known, f"there is no test {test}")
                scripts = [Path(part) for part in known[test].split() if part.endswith(".py")]
                self.assertEqual(len(scripts), 1)
                text = scripts[0].read_text(encoding="utf-8")
                # What several tests of a folder share may hold it.
                shared = [path.read_text(encoding="utf-8") for path in scripts[0].parent.glob("*.py") if f"import {path.stem}" in text
                          or f"from {path.stem} import" in text]
                self.assertTrue(any(word in part for part in (text, *shared)), f"{scripts[0].name} does not speak of {word!r}")

    def test_reasons_are_given(self) -> None:
        for command, reason in NOT_RUN.items():
            with self.subTest(command=command):
                self.assertGreater(len(reason.split()), 2)


class Running(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name) / "tree"
        self.tree.mkdir()
        for entry in ROOT.iterdir():
            if entry.name not in ("build", "results", ".git"):
                (self.tree / entry.name).symlink_to(entry)
        program = self.tree / "build/release/src/sphdrop"
        program.parent.mkdir(parents=True)
        program.symlink_to(os.environ["SPHDROP_PROGRAM"])
        case, _, results, *words = QUICKSTART
        program_output(str(ROOT / case), "--output", str(self.tree / results), *words)
        # The case that README.md shows.
        (case,) = re.findall(r"^```toml\n(name = \"my_drop\".*?)^```", text_of(Path("README.md")), flags=re.DOTALL | re.MULTILINE)
        (self.tree / "my_drop.cfg").write_text(case, encoding="utf-8")
        launcher = self.tree.parent / "bin/mpirun"
        launcher.parent.mkdir()
        launcher.write_text(f'#!/bin/sh\nexec "{os.environ["SPHDROP_MPIEXEC"]}" "$@"\n', encoding="utf-8")
        launcher.chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{launcher.parent}:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}

    def test_those_that_take_a_moment_do_what_they_say(self) -> None:
        for command, added in RUN.items():
            with self.subTest(command=command):
                done = subprocess.run(["bash", "-c", f"{command} {added}"], cwd=self.tree, env=self.environment, capture_output=True,
                                      text=True, check=False, timeout=100, stdin=subprocess.DEVNULL)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertNotIn("error", done.stderr.lower())
        for product in ("results/my_drop/history.csv", "results/cantilever/history.csv", "results/cantilever/report.html", "table.csv"):
            self.assertTrue((self.tree / product).is_file(), product)


if __name__ == "__main__":
    unittest.main()
