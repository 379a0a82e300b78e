"""What is installed: that it can be moved, finds its parts, and that its manual page and completion say what the program says."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from repository import ROOT, build_folder

PACKAGING = ROOT / "jobs" / "packaging"


def told(*words: str | Path, **environment: str) -> str:
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True, env={**os.environ, **environment}).stdout


class InstalledTree(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        installed, cls.tree = Path(folder.name) / "installed", Path(folder.name) / "moved"
        told("cmake", "--install", build_folder(), "--prefix", installed)
        installed.rename(cls.tree)
        cls.parameters = [line.split()[0] for line in told(cls.tree / "bin/sphdrop", "--list-parameters").splitlines()[1:]
                          if not line.startswith(" ")]

    def test_the_program_runs_and_the_scripts_find_it(self) -> None:
        folder = self.tree / "run"
        program = self.tree / "bin" / "sphdrop"
        told(program, self.tree / "share/sphdrop/cases/quickstart/case.cfg", "--set", "resolution.spacing=62.5 um", "--until", "2e-6",
             "--output", folder, "--quiet")
        told(self.tree / "bin/sphdrop-view", folder, "--only", "page")
        self.assertIn("<h1>quickstart</h1>", (folder / "report.html").read_text())
        code = "import sys; sys.path.insert(0, sys.argv[1]); import program; print(program.default_program())"
        found = told("python3", "-B", "-c", code, self.tree / "share/sphdrop/cases")
        self.assertEqual(Path(found.strip()).resolve(), program.resolve())

    def test_nothing_stays_behind(self) -> None:
        for path in self.tree.rglob("*"):
            self.assertTrue(path.exists(), f"{path} leads nowhere")
            self.assertNotIn("__pycache__", path.parts)

    def test_the_manual_page_has_every_option_and_parameter(self) -> None:
        page = (self.tree / "share/man/man1/sphdrop.1").read_text().replace("\\-", "-")
        self.assertGreater(len(self.parameters), 40)
        for name in (*self.parameters, "--restart", "--print-case", "--max-walltime", "SPHDROP_ARCH", "x86-64-v3"):
            self.assertIn(name, page)
        if shutil.which("man"):
            warned = subprocess.run(["man", "-l", "--warnings", "-P", "cat", self.tree / "share/man/man1/sphdrop.1"], capture_output=True,
                                    text=True, check=True, env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "80"})
            self.assertEqual(warned.stderr, "")

    def completed(self, *words: str) -> list[str]:
        script = ('source "$1"; shift; compopt() { :; }; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _sphdrop; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        return told("bash", "-c", script, "bash", self.tree / "share/bash-completion/completions/sphdrop", self.tree / "bin/sphdrop",
                    *words).split()

    def test_completion(self) -> None:
        self.assertEqual(self.completed("--set", "solid.len"), ["solid.length="])
        self.assertEqual(set(self.completed("--set", "")), {f"{name}=" for name in self.parameters})
        self.assertEqual(self.completed("--rest"), ["--restart"])
        self.assertEqual(self.completed("--restart", "la"), ["latest"])


class DebianPackage(unittest.TestCase):
    def test_has_the_program_and_says_what_it_needs(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            told("cpack", "--config", build_folder() / "CPackConfig.cmake", "-B", folder)
            (package,) = Path(folder).glob("sphdrop_*.deb")
            contents, needed = told("dpkg-deb", "--contents", package), told("dpkg-deb", "--field", package, "Depends")
        for path in ("usr/bin/sphdrop\n", "usr/bin/sphdrop-view ", "usr/share/man/man1/sphdrop.1", "usr/include/sphdrop"):
            self.assertIn(f" ./{path}", contents)
        for name in ("libc6", "libfmt9", "libhdf5-openmpi-103", "libmetis5", "libopenmpi3", "openmpi-bin"):
            self.assertIn(name, needed)


class Recipes(unittest.TestCase):
    def test_they_name_what_the_build_needs(self) -> None:
        recipe = (PACKAGING / "spack/package.py").read_text()
        compile(recipe, "package.py", "exec")
        for line in (ROOT / "CMakeLists.txt").read_text().splitlines():
            if line.startswith("find_package(") and "REQUIRED" in line:
                name = line.removeprefix("find_package(").split()[0].rstrip(")").lower().rstrip("3")
                self.assertIn(f'depends_on("{name}', recipe)
        definition = (PACKAGING / "sphdrop.def").read_text()
        self.assertIn("jobs/install_packages.sh\n", definition)
        self.assertIn("cmake --preset package\n", definition)


if __name__ == "__main__":
    unittest.main()
