"""The scripts in jobs and tests: they parse, explain themselves and fail clearly; the quick start repeats nothing."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from repository import ROOT, text_of, tracked_files

# Stands in for mpiexec: leaves the files of a run that ended as $RUN_STATUS says.
LAUNCHER = """#!/bin/bash
echo simulated >> "$LOG"
while [[ $1 != --output ]]; do shift; done
mkdir -p "$2"
for file in case.cfg history.csv snapshots.vtkhdf.series; do date +%N > "$2/$file"; done
printf '{\\n  "status": "%s"\\n}\\n' "${RUN_STATUS:-completed}" > "$2/run.json"
"""
SUDO = 'while [[ $1 == -* ]]; do shift; done; "$@"'
FIGURES = """import pathlib, sys
for name in ("picture.png", "strip.png", "history.png"):
    pathlib.Path(sys.argv[1], name).write_text("drawn")
"""


def scripts() -> list[Path]:
    return [path for path in tracked_files() if text_of_start(path).startswith("#!") and "bash" in text_of_start(path)]


def text_of_start(path: Path) -> str:
    with (ROOT / path).open("rb") as file:
        return file.readline(100).decode("utf-8", errors="replace")


def run(*command: str | Path, environment: dict[str, str] | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [str(word) for word in command],
        env=environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


class Scripts(unittest.TestCase):
    def test_parse_and_can_be_executed(self) -> None:
        self.assertGreaterEqual(len(scripts()), 4)
        for path in scripts():
            with self.subTest(script=str(path)):
                self.assertEqual(run("bash", "-n", ROOT / path).returncode, 0)
                self.assertTrue(os.access(ROOT / path, os.X_OK))

    def test_explain_themselves_and_refuse_unknown_options(self) -> None:
        for path in (path for path in scripts() if path.suffix == ".sh" and "--help" in text_of(path)):
            with self.subTest(script=str(path)):
                helped = run(ROOT / path, "--help")
                self.assertEqual(helped.returncode, 0)
                self.assertIn(f"Usage: {path}", helped.stdout)
                refused = run(ROOT / path, "--no-such-option")
                self.assertNotEqual(refused.returncode, 0)
                self.assertIn("--no-such-option", refused.stderr)


class InstallPackages(unittest.TestCase):
    script = ROOT / "jobs" / "install_packages.sh"

    def outcome(self, installed: str, **tools: str) -> subprocess.CompletedProcess[str]:
        """Runs it where dpkg-query says `installed` of every package and the other tools are given scripts."""
        with tempfile.TemporaryDirectory() as folder:
            tools = {"dpkg_query": f"echo {installed}", "apt_get": "echo apt-get $@", **tools}
            for name, text in tools.items():
                tool = Path(folder, name.replace("_", "-"))
                tool.write_text(f"#!/bin/bash\n{text}\n", encoding="utf-8")
                tool.chmod(0o755)
            for name in ("env", "cat"):
                Path(folder, name).symlink_to(str(shutil.which(name)))
            return run("/bin/bash", self.script, environment={"PATH": folder})

    def test_does_nothing_where_all_is_there(self) -> None:
        done = self.outcome("installed", apt_get="exit 1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("are installed", done.stdout)

    def test_says_so_where_installing_fails(self) -> None:
        done = self.outcome("not-installed", apt_get="exit 100", sudo=SUDO)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("apt-get could not install: g++", done.stderr)

    def test_notices_packages_that_are_still_missing(self) -> None:
        done = self.outcome("not-installed", sudo=SUDO)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"apt-get .*install --no-install-recommends g\+\+ cmake")
        self.assertIn("still not installed: g++", done.stderr)

    def test_names_the_packages_where_there_is_no_apt(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            done = run("/bin/bash", self.script, environment={"PATH": folder})
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("this is no Debian system", done.stderr)
        self.assertIn("libhdf5-openmpi-dev", done.stderr)


class QuickStart(unittest.TestCase):
    """In a tree of stand-ins: what the script itself decides."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name).resolve() / "tree"
        self.log = self.tree / "log"
        self.write("jobs/quickstart.sh", text_of(Path("jobs/quickstart.sh")))
        self.write("cases/quickstart/case.cfg", "a case")
        self.write("cases/figures.py", FIGURES)
        self.write("bin/cmake", '#!/bin/bash\nexit "${CMAKE_CODE:-0}"\n')
        self.write("bin/mpiexec", LAUNCHER)
        self.write("build/release/build.ninja", "")
        self.write("build/release/src/sphdrop", "a program")
        self.write(
            "build/release/CMakeCache.txt",
            f"MPIEXEC_EXECUTABLE:FILEPATH={self.tree}/bin/mpiexec\nCMAKE_HOME_DIRECTORY:INTERNAL={self.tree}\n",
        )

    def write(self, name: str, text: str) -> None:
        path = self.tree / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)

    def start(self, *options: str, **environment: str) -> subprocess.CompletedProcess[str]:
        environment = {"PATH": f"{self.tree}/bin:{os.environ['PATH']}", "LOG": str(self.log), **environment}
        return run("bash", self.tree / "jobs/quickstart.sh", "--no-install", *options, environment=environment)

    def simulations(self) -> int:
        return len(self.log.read_text(encoding="utf-8").splitlines()) if self.log.exists() else 0

    def test_says_where_the_results_are(self) -> None:
        done = self.start()
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in (f"{self.tree}/results/quickstart", "history.csv", "snapshots.vtkhdf.series", "picture.png"):
            self.assertIn(name, done.stdout)

    def test_simulates_again_only_when_there_is_reason(self) -> None:
        self.start()
        self.start()
        self.assertEqual(self.simulations(), 1, "finished results were not recognised")
        self.start("--again")
        self.assertEqual(self.simulations(), 2)
        for number, changed in enumerate(
            ("cases/quickstart/case.cfg", "build/release/src/sphdrop", "results/quickstart/history.csv"), start=3
        ):
            self.write(changed, "something else")
            self.start()
            self.assertEqual(self.simulations(), number, changed)
        (self.tree / "results/quickstart/run.json").unlink()
        self.start()
        self.assertEqual(self.simulations(), 6)

    def test_failures_are_told(self) -> None:
        for environment, words in (
            ({"CMAKE_CODE": "3"}, 'failed at "Building sphdrop" (exit code 3)'),
            ({"RUN_STATUS": "stopped: too fast"}, 'failed at "Simulating'),
        ):
            with self.subTest(**environment):
                done = self.start(**environment)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(words, done.stderr)
                self.assertNotIn("Done", done.stdout)
        (self.tree / "cases/figures.py").write_text("raise SystemExit(1)", encoding="utf-8")
        done = self.start()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn('failed at "Drawing', done.stderr)


if __name__ == "__main__":
    unittest.main()
