"""The tables of a sweep and of scaling: what the jobs run, and what is told of the results."""

from __future__ import annotations

import csv
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "jobs"))
import scaling  # noqa: E402
import sweep  # noqa: E402

CASE = '[solid]\nkind = "{kind}"\n[drop]\nshape = "round"\n'


def command(script: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    words = [sys.executable, "-B", str(ROOT / "jobs" / script), *map(str, arguments)]
    return subprocess.run(words, capture_output=True, text=True, check=False)


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
        self.assertEqual(command("sweep.py", "count", table).stdout, "2\n")
        self.assertEqual(command("sweep.py", "settings", table, "1").stdout, "--set=drop.velocity=[0.0, -1.0]\n--set=solid.length=12e-3\n")
        self.assertEqual(command("sweep.py", "folder", table, "1").stdout, "run_001\n")

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
                done = command("sweep.py", "count", self.table(text))
                self.assertEqual(done.returncode, 2)
                self.assertIn(words, done.stderr)
        self.assertIn("cannot be read", command("sweep.py", "count", self.folder / "nowhere").stderr)
        self.assertEqual(command("sweep.py", "cuont").returncode, 2)


class CollectedSweep(TableTest):
    def make_run(self, number: int, kind: str = "cantilever", status: str = "completed") -> None:
        """A run of 1 ms whose drop is widest, 2 mm, at 0.41 ms, whose beam is deepest, 0.3 mm, at 0.22 ms, and whose drop
        touches from 0.1 to 0.7 ms, comes at 0.8 m/s and leaves at 0.2 m/s."""
        folder = self.folder / "results" / sweep.folder_of(number)
        folder.mkdir(parents=True)
        details = {"particles": 10, "steps": 20}
        (folder / "run.json").write_text(json.dumps({"status": status, "state_hash": f"{number:016x}", "ranks": 2, "details": details}))
        (folder / "case.cfg").write_text(CASE.format(kind=kind))
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
        done = command("sweep.py", "collect", self.table("solid.length,drop.velocity\n8e-3,\"[0, -1]\"\n9e-3,\"[0, -2]\"\n"),
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
        self.assertAlmostEqual(float(beam["largest_deflection [m]"]), 3e-4)
        self.assertAlmostEqual(float(beam["largest_deflection_time [s]"]), 2.2e-4)
        self.assertTrue(math.isnan(float(wall["largest_deflection [m]"])))

    def test_missing_and_unfinished_runs_are_told(self) -> None:
        (self.folder / "results").mkdir()
        self.make_run(0, status="interrupted: SIGUSR1 came")
        first, second = self.collected("0 of 2 runs finished", "run_000: interrupted", "run_001: missing", code=1)
        self.assertEqual((first["status"], first["contact_time [s]"]), ("interrupted: SIGUSR1 came", ""))
        self.assertEqual((second["status"], second["state_hash"]), ("missing", ""))


class ScalingTable(TableTest):
    def make_run(self, name: str, ranks: int, particles: int, seconds: float, status: str = "completed", **details: object) -> None:
        (self.folder / name).mkdir()
        phases = {"seconds in solid sweep": seconds / 4, "seconds in communication": seconds * 3 / 4, "seconds in output": 100.0}
        (self.folder / name / "run.json").write_text(json.dumps({
            "status": status, "ranks": ranks, "ranks_by_host": {"a": ranks}, "wall_time_seconds": seconds + 101,
            "details": {"particles": particles, "steps": 1000, **phases, **details},
        }))

    def test_strong_scaling(self) -> None:
        self.make_run("ranks_2_1", 2, 5000, 0.4)
        self.make_run("ranks_2_2", 2, 5000, 0.3)
        self.make_run("ranks_1_1", 1, 5000, 0.5)
        done = command("scaling.py", "table", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with (self.folder / "scaling.csv").open(encoding="utf-8", newline="") as stream:
            one, two = csv.DictReader(stream)
        self.assertEqual((one["ranks"], one["per_particle_and_step [ns]"], one["efficiency"]), ("1", "100.0", "1.0"))
        self.assertEqual((two["ranks"], two["per_particle_and_step [ns]"], two["speed_up"], two["efficiency"]), ("2", "60.0", "1.667", "0.833"))
        self.assertIn("0.833", done.stdout)

    def test_weak_scaling_takes_the_particles_that_there_were(self) -> None:
        self.make_run("one", 1, 5000, 0.5)
        self.make_run("four", 4, 20000, 0.5)
        self.assertEqual(scaling.table_of(scaling.timings_in(self.folder))[1]["efficiency"], 1.0)

    def test_unfinished_and_restarted_runs_give_no_table(self) -> None:
        self.make_run("one", 1, 5000, 0.5, status="running")
        done = command("scaling.py", "table", self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no run from beginning to end", done.stderr)
        self.make_run("two", 1, 5000, 0.5, restarted_at_step=7, restarted_from="checkpoint")
        (self.folder / "one" / "run.json").unlink()
        self.assertEqual(command("scaling.py", "table", self.folder).returncode, 2)

    def test_weak_settings_multiply_the_particles(self) -> None:
        case = {"resolution": {"spacing": 2.5e-5}, "solid": {"kind": "cantilever", "length": 8e-3, "thickness": 0.25e-3},
                "drop": {"shape": "round", "diameter": 1e-3}}
        for ranks in (2, 3, 4, 7, 64, 1000):
            settings = scaling.weak_settings(case, ranks)
            rows, columns = (settings[name] / 2.5e-5 for name in ("solid.thickness", "solid.length"))
            self.assertAlmostEqual(rows, 2 * round(rows / 2), places=9)
            self.assertAlmostEqual(rows * columns / (10 * 320 * ranks), 1, delta=0.01)
            self.assertAlmostEqual(settings["drop.diameter"] ** 2 / ranks, 1e-6)
        with self.assertRaises(scaling.ScalingError):
            scaling.weak_settings({**case, "solid": {"kind": "rigid_wall"}}, 2)


if __name__ == "__main__":
    unittest.main()
