"""sphdrop as a library, as its users meet it: found in an installed tree that was moved, and the example's probe on it."""

from __future__ import annotations

import csv
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from repository import ROOT, build_folder, text_of

sys.path.insert(0, str(ROOT / "tests/support"))
from running_program import MPIEXEC, little_case, run, state_hash  # noqa: E402
from sphdrop_reader import Run  # noqa: E402

HEADER = Path("src/api/sphdrop.hpp")
CASE = little_case(end=41e-6, snapshot_interval=1e-5)


def told(*words: str | Path, code: int = 0) -> subprocess.CompletedProcess[str]:
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, timeout=120)
    if done.returncode != code:
        raise AssertionError(f"{words} ends with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done


class Library(unittest.TestCase):
    folder: Path
    tree: Path

    @classmethod
    def setUpClass(cls) -> None:
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.tree = cls.folder / "moved"
        told("cmake", "--install", build_folder(), "--prefix", cls.folder / "installed")
        (cls.folder / "installed").rename(cls.tree)
        cls.case = cls.folder / "little.cfg"
        cls.case.write_text(CASE, encoding="utf-8")
        told("cmake", "-G", "Ninja", "-S", cls.tree / "share/sphdrop/cases/probe", "-B", cls.folder / "build", f"-DCMAKE_PREFIX_PATH={cls.tree}",
             "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *cls.same_compiler())
        told("cmake", "--build", cls.folder / "build")

    @staticmethod
    def same_compiler() -> list[str]:
        cache = (build_folder() / "CMakeCache.txt").read_text(encoding="utf-8")
        found = dict(re.findall(r"^(CMAKE_(?:C|CXX)_COMPILER):\w+=(.*)$", cache, flags=re.MULTILINE))
        return [f"-D{name}={value}" for name, value in found.items()]

    def probe(self, output: str, *words: str, ranks: int = 1, code: int = 0) -> subprocess.CompletedProcess[str]:
        return told(MPIEXEC, "-n", str(ranks), self.folder / "build/probe", self.case, self.folder / output, *words, code=code)

    def test_the_probe_sees_what_the_program_computes(self) -> None:
        program = run(self.case, "--output", self.folder / "program")
        self.assertEqual(program.returncode, 0, program.stderr)
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                done = self.probe(f"probe{ranks}", ranks=ranks)
                self.assertEqual(state_hash(done), state_hash(program))
                for name in ("history.csv", "snapshot_000004.vtkhdf"):
                    self.assertEqual((self.folder / f"probe{ranks}" / name).read_bytes(), (self.folder / "program" / name).read_bytes(), name)
        found = (self.folder / "probe1/probe.csv").read_text(encoding="utf-8")
        self.assertEqual(found, (self.folder / "probe2/probe.csv").read_text(encoding="utf-8"))
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(found.splitlines())]
        snapshots = Run(self.folder / "program").snapshots
        self.assertEqual(len(rows), 5)
        for row, snapshot in zip(rows, snapshots):
            self.assertEqual(row["time"], snapshot.time)
            pressure = np.where(snapshot["material"] == 0, snapshot["pressure"], -np.inf)
            self.assertEqual(row["largest_pressure"], pressure.max())
            self.assertEqual([row["x"], row["y"]], snapshot["position"][pressure.argmax()].tolist())
        self.assertGreater(rows[-1]["largest_pressure"], 1e3, "the drop has not touched the beam")

    def test_mistakes_are_told_once_and_end_as_the_programs(self) -> None:
        done = self.probe("none", "solid.lenght=3e-3", ranks=2, code=2)
        self.assertEqual(done.stderr.count("did you mean"), 1, done.stderr)
        self.assertFalse((self.folder / "none").exists())

    def test_the_programs_options_are_the_librarys(self) -> None:
        commands = (self.folder / "build/compile_commands.json").read_text(encoding="utf-8")
        self.assertIn("-ffp-contract=off", commands)
        self.assertNotIn("-march", commands)

    def test_another_version_is_refused(self) -> None:
        project = self.folder / "newer"
        project.mkdir()
        (project / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(newer LANGUAGES C CXX)\nfind_package(sphdrop 0.2 REQUIRED)\n", encoding="utf-8")
        done = told("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.tree}", *self.same_compiler(), code=1)
        self.assertIn("0.1.0", done.stderr)

    def test_its_headers_show_nothing_of_what_is_inside(self) -> None:
        headers = [path.relative_to(self.tree) for path in (self.tree / "include").rglob("*") if path.is_file()]
        self.assertEqual(headers, [Path("include/sphdrop/sphdrop.hpp")])
        self.assertNotIn('#include "', text_of(HEADER))


if __name__ == "__main__":
    unittest.main()
