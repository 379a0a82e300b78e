"""What the documents say is so: parameters, commands, options, links, and the shipped cases are valid."""

from __future__ import annotations

import json
import os
import re
import shlex
import unittest
from pathlib import Path

from parameter_reference import PAGE, parts_of, reference_of_program
from repository import ROOT, program_output, text_of, tracked_files

SHELL_FENCES = re.compile(r"^```(?:sh|bash|shell|console)[ \t]*\n(.*?)^```", flags=re.DOTALL | re.MULTILINE)
LINKS = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
PROGRAM = "build/release/src/sphdrop"
PRODUCTS = ("build/", "results/")


def documents() -> list[Path]:
    return [path for path in tracked_files() if path.suffix == ".md"]


def commands_of(document: Path) -> list[list[str]]:
    """The words of each command in the document's shell fences."""
    commands = []
    for fence in SHELL_FENCES.findall(text_of(document)):
        for line in fence.replace("\\\n", " ").splitlines():
            words = shlex.split(line.removeprefix("$ "), comments=True)
            if words:
                commands.append(words)
    return commands


def is_program(word: str) -> bool:
    return Path(word).name == "sphdrop"


def options_of(words: list[str]) -> list[str]:
    return [word.split("=")[0] for word in words if word.startswith("--") and word != "--"]


def known_parameters() -> set[str]:
    return {line.split()[0] for line in program_output("--list-parameters").splitlines()[1:] if not line.startswith(" ")}


def values_set(words: list[str]) -> list[str]:
    """The keys behind --set."""
    keys = []
    for word, following in zip(words, words[1:] + [""]):
        if word == "--set":
            keys.append(following.split("=")[0])
        elif word.startswith("--set="):
            keys.append(word.removeprefix("--set=").split("=")[0])
    return keys


class ParameterReference(unittest.TestCase):
    maxDiff = None

    def test_is_what_the_program_says(self) -> None:
        _, reference, _ = parts_of(PAGE.read_text(encoding="utf-8"))
        expected = reference_of_program(os.environ["SPHDROP_PRINT_PARAMETER_REFERENCE"])
        self.assertEqual(
            reference.strip().splitlines(),
            expected.strip().splitlines(),
            "write it anew: cmake --build --preset release --target update_parameter_reference",
        )


class Commands(unittest.TestCase):
    def test_readme_has_commands(self) -> None:
        self.assertTrue(commands_of(Path("README.md")))

    def test_files_exist(self) -> None:
        entries = {path.parts[0] for path in tracked_files()}
        for document in documents():
            for words in commands_of(document):
                for word in words:
                    if word.startswith("-") or word.split("/")[0] not in entries:
                        continue
                    with self.subTest(document=str(document), command=" ".join(words)):
                        self.assertTrue(list(ROOT.glob(word.rstrip("/"))), f"there is no {word}")

    def test_the_program_is_where_the_build_puts_it(self) -> None:
        for document in documents():
            for words in commands_of(document):
                for word in words:
                    if is_program(word) and "/" in word and not word.startswith("/"):
                        with self.subTest(document=str(document), command=" ".join(words)):
                            self.assertEqual(word.removeprefix("./"), PROGRAM)

    def test_options_of_the_program_exist(self) -> None:
        known = set(re.findall(r"--[a-z][a-z-]*", program_output("--help")))
        parameters = known_parameters()
        for document in documents():
            for words in commands_of(document):
                positions = [position for position, word in enumerate(words) if is_program(word)]
                # `cmake --target sphdrop` builds it.
                if not positions or (positions[0] > 0 and words[positions[0] - 1] == "--target"):
                    continue
                own = words[positions[0] + 1 :]
                with self.subTest(document=str(document), command=" ".join(words)):
                    self.assertLessEqual(set(options_of(own)), known)
                    self.assertLessEqual(set(values_set(own)), parameters)

    def test_options_of_scripts_exist(self) -> None:
        for document in documents():
            for words in commands_of(document):
                for position, word in enumerate(words):
                    script = Path(word)
                    if script.suffix not in (".sh", ".py") or not (ROOT / script).is_file():
                        continue
                    text = text_of(script)
                    for option in options_of(words[position + 1 :]):
                        with self.subTest(document=str(document), command=" ".join(words)):
                            self.assertRegex(text, re.escape(option) + r"(?![\w-])")

    def test_presets_exist(self) -> None:
        presets = json.loads(text_of(Path("CMakePresets.json")))
        names = {preset["name"] for kind in ("configurePresets", "testPresets") for preset in presets[kind]}
        for document in documents():
            for words in commands_of(document):
                for word, following in zip(words, words[1:] + [""]):
                    if word == "--preset":
                        with self.subTest(document=str(document), command=" ".join(words)):
                            self.assertIn(following, names)


class Links(unittest.TestCase):
    def test_linked_files_exist(self) -> None:
        for document in documents():
            for target in LINKS.findall(text_of(document)):
                if "://" in target or target.startswith("mailto:"):
                    continue
                with self.subTest(document=str(document), link=target):
                    self.assertTrue((ROOT / document.parent / target).exists())


class Cases(unittest.TestCase):
    def case_files(self) -> list[Path]:
        return [path for path in tracked_files() if path.parts[0] == "cases" and path.suffix == ".cfg"]

    def test_cases_are_accepted(self) -> None:
        self.assertTrue(self.case_files())
        for path in self.case_files():
            with self.subTest(case=str(path)):
                self.assertRegex(program_output("--check", str(ROOT / path)), r"particles +\d+")

    def test_comments_name_parameters_that_exist(self) -> None:
        parameters = known_parameters()
        for path in self.case_files():
            with self.subTest(case=str(path)):
                self.assertLessEqual(set(re.findall(r"--set ([\w.]+)=", text_of(path))), parameters)

    def test_cases_are_named_after_their_folder(self) -> None:
        for path in self.case_files():
            if path.name == "case.cfg":
                with self.subTest(case=str(path)):
                    self.assertIn(f'name = "{path.parent.name}"', text_of(path).splitlines())


if __name__ == "__main__":
    unittest.main()
