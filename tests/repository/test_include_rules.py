"""Dependencies run one way: decomposition <- io <- src <- tests, and inside src towards the simulation."""

from __future__ import annotations

import re
import unittest
from pathlib import Path

from repository import ROOT, code_of, text_of, tracked_files

# What a folder may include besides itself: folders, or single files of one.
ALLOWED: dict[str, set[str]] = {
    "decomposition": set(),
    "io": {"decomposition"},
    "config": set(),
    "particles": set(),
    "sph": {"particles"},
    "fluid": {"particles", "sph"},
    "solid": {"particles", "sph"},
    "contact": {"particles", "sph", "fluid", "solid"},
    "surface_tension": {"particles", "sph", "fluid", "solid"},
    "wetting": {"particles", "sph", "fluid", "solid", "contact", "surface_tension"},
    "rigid_body": {"particles"},
    "time_integration": {"particles", "sph"},
    "diagnostics": {"particles"},
    "setup": {"particles", "sph", "contact", "rigid_body", "config/case.hpp"},
}
ALLOWED["simulation"] = set(ALLOWED) - {"config"} | {"config/case.hpp"}
ALLOWED["run"] = set(ALLOWED) | {"config"}
ALLOWED["api"] = set(ALLOWED) | {"config"}
ALLOWED["main.cpp"] = set(ALLOWED) | {"config"}
ALLOWED["launcher.cpp"] = set()
PROGRAMS = {"main.cpp", "launcher.cpp"}

# Plain data, which is used without linking what reads it.
HEADERS_WITHOUT_LIBRARY = {"config/case.hpp"}

# Who may speak to a library that has a place of its own.
LIBRARY_HEADERS: dict[str, set[str]] = {
    "mpi.h": {"decomposition", "io", "simulation", "api", "main.cpp"},
    "hdf5.h": {"io"},
    "metis.h": {"decomposition", "io"},
    "toml.hpp": {"config"},
    "CLI/CLI.hpp": {"config"},
    "xxhash.h": {"io"},
}


def folder_of(path: Path) -> str:
    """src/fluid/x.hpp -> fluid; io/x.hpp -> io; src/main.cpp -> main.cpp."""
    return path.parts[1] if path.parts[0] == "src" else path.parts[0]


def program_files() -> list[Path]:
    return [
        path
        for path in tracked_files()
        if path.parts[0] in ("src", "decomposition", "io") and path.suffix in (".hpp", ".cpp")
    ]


def includes_of(path: Path) -> list[tuple[str, str]]:
    """(mark, name) of each include; the mark is " or <."""
    return re.findall(r"^[ \t]*#[ \t]*include[ \t]*([\"<])([^\">]+)[\">]", code_of(path), flags=re.MULTILINE)


def linked_libraries() -> dict[str, set[str]]:
    """Which of the folders' targets each of them names in its CMakeLists.txt."""
    linked: dict[str, set[str]] = {}
    for path in tracked_files():
        if path.name != "CMakeLists.txt" or path.parts[0] not in ("src", "decomposition", "io"):
            continue
        text = re.sub(r"#[^\n]*", "", text_of(path))
        for call in re.findall(r"(?:sphdrop_library|target_link_libraries)\s*\(([^)]*)\)", text):
            name, *words = call.split()
            if name.startswith("sphdrop_"):
                names = {word.removeprefix("sphdrop_") for word in words if word.startswith("sphdrop_")}
                linked.setdefault(name.removeprefix("sphdrop_"), set()).update(names - {"options"})
    return linked


class IncludeRules(unittest.TestCase):
    def test_every_folder_has_its_place(self) -> None:
        self.assertLessEqual({folder_of(path) for path in program_files()}, set(ALLOWED))

    def test_folders_include_only_what_stands_below_them(self) -> None:
        for path in program_files():
            here = folder_of(path)
            for mark, name in includes_of(path):
                there = name.split("/")[0]
                if mark == '"' and there != here:
                    with self.subTest(file=str(path), include=name):
                        self.assertTrue(
                            {there, name} & ALLOWED[here], f"{here} may include {sorted(ALLOWED[here])} only"
                        )

    def test_includes_name_a_file_from_the_root_or_from_src(self) -> None:
        for path in program_files():
            for mark, name in includes_of(path):
                if mark == '"':
                    with self.subTest(file=str(path), include=name):
                        self.assertTrue((ROOT / name).is_file() or (ROOT / "src" / name).is_file())

    def test_libraries_with_a_place_are_included_there_only(self) -> None:
        for path in program_files():
            for _, name in includes_of(path):
                if name in LIBRARY_HEADERS:
                    with self.subTest(file=str(path), include=name):
                        self.assertIn(folder_of(path), LIBRARY_HEADERS[name])

    def test_targets_link_only_what_stands_below_them(self) -> None:
        linked = linked_libraries()
        self.assertEqual(set(linked), set(ALLOWED) - PROGRAMS, "one target a folder")
        for here, names in linked.items():
            with self.subTest(target=here):
                self.assertLessEqual(names, ALLOWED[here])

    def test_targets_link_what_they_include(self) -> None:
        linked = linked_libraries()

        def reached(folder: str) -> set[str]:
            return linked[folder].union(*(reached(below) for below in linked[folder]))

        for path in program_files():
            here = folder_of(path)
            if here in PROGRAMS:
                continue
            for mark, name in includes_of(path):
                if mark == '"' and name not in HEADERS_WITHOUT_LIBRARY:
                    with self.subTest(file=str(path), include=name):
                        self.assertIn(name.split("/")[0], reached(here) | {here})


if __name__ == "__main__":
    unittest.main()
