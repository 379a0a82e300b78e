"""The tables of scaling: what is told of the results."""

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
