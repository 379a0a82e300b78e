"""sphdrop-sweep: its tables, the runs it makes, and what it tells of them."""

from __future__ import annotations

import contextlib
import csv
import io
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[3]
COMMAND = ROOT / "cases" / "sphdrop-sweep"
sys.path.insert(0, str(ROOT / "cases"))
from sweep import command as sweep_command  # noqa: E402
from sweep import figures, table as sweep  # noqa: E402
from toy_study import CASE as TOY_CASE, write_program  # noqa: E402

CASE = """[fluid]
density = 1000
viscosity = 0.001
[surface_tension]
coefficient = 0.072
[solid]
kind = "{kind}"
length = 8e-3
thickness = 0.25e-3
density = 1000
youngs_modulus = 3e8
poisson_ratio = 0.3
[drop]
shape = "round"
diameter = 1e-3
velocity = [0, -0.8]
"""


def command(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    output, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        try:
            code = sweep_command.main([str(argument) for argument in arguments])
        except SystemExit as end:
            code = int(str(end.code))
    return subprocess.CompletedProcess([], code, output.getvalue(), errors.getvalue())


class TableTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def table(self, text: str) -> Path:
        path = self.folder / "table.csv"
        path.write_text(text, encoding="utf-8")
        return path


class SweepTable(TableTest):
    def test_rows_are_settings(self) -> None:
        table = self.table('# a comment\n\ndrop.velocity, solid.length\n"[0.0, -0.5]", 8e-3\n"[0.0, -1.0]",12e-3\n')
        self.assertEqual(command("count", table).stdout, "2\n")
        self.assertEqual(command("settings", table, "1").stdout, "--set=drop.velocity=[0.0, -1.0]\n--set=solid.length=12e-3\n")
        self.assertEqual(command("folder", table, "1").stdout, "run_001\n")

    def test_the_shipped_one_names_parameters(self) -> None:
        rows = sweep.read_table(ROOT / "jobs" / "sweep_table.csv")
        self.assertEqual(len({(row["drop.velocity"], row["solid.length"]) for row in rows}), 12)
        parameters = (ROOT / "cases" / "README.md").read_text(encoding="utf-8")
        for name in rows[0]:
            self.assertIn(f"`{name}`", parameters)

    def test_mistakes_are_told(self) -> None:
        for text, words in (
            ("a.b\n", "needs a header that names parameters, and a row"),
            ("a.b,a.b\n1,2\n", "names a parameter twice"),
            ("a.b,c.d\n1,2\n[0, 1],2\n", "run 1 has 3 values for 2 parameters"),
            ("a.b,c.d\n1,\n", "run 0 has no value of c.d"),
        ):
            with self.subTest(text=text):
                done = command("count", self.table(text))
                self.assertEqual(done.returncode, 2)
                self.assertIn(words, done.stderr)
        self.assertIn("cannot be read", command("count", self.folder / "nowhere").stderr)
        self.assertEqual(command("cuont").returncode, 2)

    def test_a_grid_is_every_combination(self) -> None:
        done = command("table", "solid.length=8 mm; 12 mm", "drop.velocity=[0, -0.5];[0, -1]")
        rows = sweep.read_table(self.table(done.stdout))
        self.assertEqual(rows, [{"solid.length": length, "drop.velocity": velocity} for length in ("8 mm", "12 mm")
                                for velocity in ("[0, -0.5]", "[0, -1]")])
        for wrong in ("a.b", "a.b=1;;2", "=1"):
            self.assertIn("is not of the form", command("table", wrong).stderr)
        self.assertIn("there twice", command("table", "a.b=1", "a.b=2").stderr)

    def test_job_scripts_need_no_libraries(self) -> None:
        words = [sys.executable, "-S", "-B", str(COMMAND), "count", str(self.table("a.b\n1\n"))]
        self.assertEqual(subprocess.run(words, capture_output=True, text=True, check=True).stdout, "1\n")


class CollectedSweep(TableTest):
    def make_run(self, number: int, kind: str = "cantilever", status: str = "completed") -> None:
        """A run of 1 ms whose drop is widest, 2 mm, at 0.41 ms, whose beam is deepest, 0.3 mm, at 0.22 ms, and whose drop
        touches from 0.1 to 0.7 ms, comes at 0.8 m/s and leaves at 0.2 m/s."""
        folder = self.folder / "results" / sweep.folder_of(number)
        folder.mkdir(parents=True)
        details = {"particles": 10, "steps": 20}
        (folder / "run.json").write_text(json.dumps({"status": status, "state_hash": f"{number:016x}", "ranks": 2, "details": details}))
        (folder / "case.cfg").write_text(CASE.replace("{kind}", kind))
        with (folder / "history.csv").open("w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream)
            writer.writerow(["time [s]", "drop_width [m]", "deflection [m]", "contact_count [1]", "contact_impulse_y [N s/m]",
                             "drop_velocity_y [m/s]"])
            for row in range(51):
                time = row * 2e-5
                touches = 5 <= row <= 35
                impulse = min(max(row - 4, 0), 31)
                writer.writerow([time, 2e-3 - 1e3 * (time - 4.1e-4) ** 2, -3e-4 + 1e3 * (time - 2.2e-4) ** 2, int(touches), impulse,
                                 -0.8 if row < 5 else 0.2])

    def collected(self, *expected_lines: str, code: int) -> list[dict[str, str]]:
        done = command("collect", self.table("solid.length,drop.velocity\n8e-3,\"[0, -1]\"\n9e-3,\"[0, -2]\"\n"),
                       self.folder / "results")
        self.assertEqual(done.returncode, code, done.stderr)
        for line in expected_lines:
            self.assertIn(line, done.stdout)
        with (self.folder / "results" / "sweep.csv").open(encoding="utf-8", newline="") as stream:
            return list(csv.DictReader(stream))

    def test_finished_runs(self) -> None:
        self.make_run(0)
        self.make_run(1, kind="rigid_wall")
        beam, wall = self.collected("2 of 2 runs finished", code=0)
        self.assertEqual((beam["run"], beam["solid.length"], beam["drop.velocity"]), ("run_000", "8e-3", "[0, -1]"))
        self.assertEqual((wall["state_hash"], wall["particles"], wall["steps"], wall["ranks"]), (f"{1:016x}", "10", "20", "2"))
        for row in (beam, wall):
            self.assertAlmostEqual(float(row["contact_time [s]"]), 6e-4)
            self.assertAlmostEqual(float(row["largest_width [m]"]), 2e-3)
            self.assertAlmostEqual(float(row["largest_width_time [s]"]), 4.1e-4)
            self.assertAlmostEqual(float(row["restitution [1]"]), 0.25)
            self.assertAlmostEqual(float(row["spreading_ratio [1]"]), 2.0)
            self.assertAlmostEqual(float(row["weber_number [1]"]), 1000 * 0.64 * 1e-3 / 0.072)
        self.assertAlmostEqual(float(beam["largest_deflection [m]"]), 3e-4)
        self.assertAlmostEqual(float(beam["largest_deflection_time [s]"]), 2.2e-4)
        self.assertAlmostEqual(float(beam["relative_deflection [1]"]), 3e-4 / 8e-3)
        self.assertAlmostEqual(float(beam["deflection_theory [m]"]), 0.243e-3, delta=1e-6)  # Eq. 46
        self.assertTrue(math.isnan(float(wall["largest_deflection [m]"])))
        self.assertTrue(math.isnan(float(wall["deflection_theory [m]"])))

    def test_missing_and_unfinished_runs_are_told(self) -> None:
        (self.folder / "results").mkdir()
        self.make_run(0, status="interrupted: SIGUSR1 came")
        first, second = self.collected("0 of 2 runs finished", "run_000: interrupted", "run_001: missing", code=1)
        self.assertEqual((first["status"], first["contact_time [s]"]), ("interrupted: SIGUSR1 came", ""))
        self.assertEqual((second["status"], second["state_hash"]), ("missing", ""))


class LocalRuns(TableTest):
    def setUp(self) -> None:
        super().setUp()
        self.case = self.folder / "case.cfg"
        self.case.write_text(TOY_CASE)
        self.program = write_program(self.folder / "program")
        self.log = self.folder / "log"

    def run_sweep(self, text: str, **environment: str) -> tuple[subprocess.CompletedProcess[str], list[str]]:
        """What the command said, and the runs that the program was asked for."""
        with mock.patch.dict(os.environ, {"TOY_LOG": str(self.log), **environment}), \
                mock.patch.object(sweep_command, "collect_and_draw", lambda table, folder: 0):
            done = command("run", self.table(text), self.case, self.folder / "results", "--program", self.program)
        made = self.log.read_text().splitlines() if self.log.exists() else []
        self.log.unlink(missing_ok=True)
        return done, made

    def test_runs_are_made_once_and_taken_up(self) -> None:
        table = 'drop.velocity,time.end\n"[0, -0.5]",1e-3\n"[0, -1]",1e-3\n'
        done, made = self.run_sweep(table, TOY_STOPS="run_001")
        self.assertEqual((done.returncode, made), (1, ["run_000", "run_001"]))
        self.assertIn("sweep/run_001: FAILED", done.stdout)
        done, made = self.run_sweep(table)
        self.assertEqual((done.returncode, made), (0, ["run_001 resumed"]), done.stdout + done.stderr)
        done, made = self.run_sweep(table)
        self.assertEqual((done.returncode, made), (0, []))
        _, made = self.run_sweep(table.replace("-0.5", "-0.6"))
        self.assertEqual(made, ["run_000"])

    def test_a_row_that_makes_no_case_stops_all_before_they_begin(self) -> None:
        done, made = self.run_sweep("bad,time.end\n1,1e-3\n2,1e-3\n")
        self.assertEqual((done.returncode, made), (2, []))
        self.assertIn("run_000: toy: bad is not a known key\nrun_001: ", done.stderr)


class Figures(unittest.TestCase):
    def test_runs_are_grouped_by_what_is_not_on_the_axes(self) -> None:
        table = [{"drop.velocity": velocity, "solid.length": length, "solid.kind": "cantilever"} for length in ("8 mm", "12 mm")
                 for velocity in ("[0,-0.5]", "[0,-1]")]
        rows = [{"impact_speed [m/s]": 0.5 * (1 + k % 2), "largest_deflection [m]": 1e-4 * (k + 1), "deflection_theory [m]": 1e-4,
                 "weber_number [1]": math.nan} for k in range(4)]
        series = figures.series_of(table, [{**a, **b} for a, b in zip(table, rows)])
        self.assertEqual({name: len(found) for name, found in series.items()}, {"solid.length = 8 mm": 2, "solid.length = 12 mm": 2})
        with tempfile.TemporaryDirectory() as folder:
            written = figures.draw_all(table, [{**a, **b} for a, b in zip(table, rows)], Path(folder))
            self.assertEqual([path.name for path in written], ["deflection.png"])


if __name__ == "__main__":
    unittest.main()
