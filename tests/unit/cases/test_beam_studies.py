"""The studies of beams where runs are missing, their expected.csv, and cases/comparison/record.py."""

from __future__ import annotations

import sys
import tempfile
import unittest
from pathlib import Path

CASES = Path(__file__).resolve().parents[3] / "cases"
sys.path[:0] = [str(CASES), str(CASES.parent / "io")]
from comparison.record import record  # noqa: E402
from comparison.study import Results, Study  # noqa: E402

STUDIES = ("cantilever", "fixed_fixed_beam", "soft_cantilever", "free_vibration")


class Studies(unittest.TestCase):
    def test_without_runs_there_is_nothing_to_say(self) -> None:
        for name in STUDIES:
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                module = Study(CASES / name).module()
                self.assertEqual(module.measure(Results({}, "paper")), {})
                self.assertEqual(module.draw(Results({}, "paper"), Path(folder)), [])

    def test_each_level_with_runs_expects_something_of_each_only_once(self) -> None:
        for name in STUDIES:
            study = Study(CASES / name)
            for level in ("paper", "quick", "short"):
                with self.subTest(name, level=level):
                    quantities = [row.quantity for row in study.expected(level)]
                    self.assertEqual(len(quantities), len(set(quantities)))
                    for variant in study.variants(level):
                        name = variant.twin or variant.name
                        self.assertTrue(any(quantity.endswith(name) for quantity in quantities), variant.name)


class Record(unittest.TestCase):
    TEXT = ("level,quantity,unit,theory,paper,goal,goal_tolerance,ours,tolerance,description\n"
            'paper,depth,mm,0.24,,,,,,"free end, deepest"\n'
            "paper,time,ms,,1.3,,,1.5,0.2,when\n"
            "quick,depth,mm,0.24,,,,0.3,0.003,free end\n")

    def recorded(self, only_empty: bool) -> tuple[int, str]:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "expected.csv"
            path.write_text(self.TEXT, encoding="utf-8")
            count = record(path, "paper", {"depth": 3.388e-4, "time": 1.4e-3, "unknown": 1.0}, only_empty)
            return count, path.read_text(encoding="utf-8")

    def test_fills_in_units_and_keeps_the_rest(self) -> None:
        count, text = self.recorded(only_empty=False)
        self.assertEqual(count, 2)
        self.assertEqual(text, self.TEXT.replace(',,,,,,"free', ',,,,0.3388,0.0017,"free').replace("1.5,0.2", "1.4,0.2"))

    def test_mode_modern_has_columns_of_its_own(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "expected.csv"
            path.write_text(self.TEXT, encoding="utf-8")
            self.assertEqual(record(path, "paper", {}, mode="modern"), 0)
            self.assertEqual(path.read_text(encoding="utf-8"), self.TEXT, "nothing measured, nothing changed")
            self.assertEqual(record(path, "paper", {"depth": 2.52e-4, "time": 1.2e-3}, mode="modern"), 2)
            lines = path.read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines[0].split(",")[-5:], ["ours", "tolerance", "modern", "modern_tolerance", "description"])
        self.assertEqual(lines[1], 'paper,depth,mm,0.24,,,,,,0.252,0.0013,"free end, deepest"')
        self.assertEqual(lines[2], "paper,time,ms,,1.3,,,1.5,0.2,1.2,0.2,when", "the tolerance of the paper's scheme")

    def test_can_leave_what_is_there(self) -> None:
        count, text = self.recorded(only_empty=True)
        self.assertEqual(count, 1)
        self.assertIn("1.5,0.2", text)


if __name__ == "__main__":
    unittest.main()
