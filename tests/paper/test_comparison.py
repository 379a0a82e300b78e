"""The comparison at its short level, with the program that was built: every recorded value is met, and the report is whole."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

CASES = Path(__file__).resolve().parents[2] / "cases"
sys.path.insert(0, str(CASES))
from comparison.study import all_studies  # noqa: E402


class ShortComparison(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        """Afresh: results that are there may be of a program from before a change."""
        cls.results = Path(os.environ["SPHDROP_COMPARISON"])
        shutil.rmtree(cls.results, ignore_errors=True)
        cls.done = subprocess.run(
            [sys.executable, "-B", str(CASES / "compare.py"), "--level", "short", "--ranks", "2",
             "--program", os.environ["SPHDROP_PROGRAM"], "--results", str(cls.results)],
            stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        cls.report = cls.results / "short" / "report"

    def test_every_check_passes(self) -> None:
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)
        self.assertNotIn("Traceback", self.done.stderr)

    def test_every_study_has_its_row_and_its_pictures(self) -> None:
        studies = [study for study in all_studies() if study.variants("short")]
        self.assertGreaterEqual(len(studies), 8)
        page, text = ((self.report / name).read_text(encoding="utf-8") for name in ("report.html", "report.md"))
        for study in studies:
            count = len(study.variants("short"))
            with self.subTest(study=study.name):
                self.assertIn(f"| **{study.name}**: {count} of {count} runs", text)
                self.assertIn(f'<section id="{study.name}">', page)
                self.assertTrue(any(row.tolerance >= 0 for row in study.expected("short")), "nothing is checked at this level")
                for row in study.expected("short"):
                    self.assertIn(f"| {row.quantity} |", text)
                    self.assertIn("<td>" + row.quantity.replace("_", "_<wbr>") + "</td>", page)
                self.assertTrue((self.report / "figures" / study.name / "ledger.png").exists())


    def test_runs_in_mode_modern_are_checked_beside_their_twins(self) -> None:
        text = (self.report / "report.md").read_text(encoding="utf-8")
        names = [f"{study.name}/{variant.twin}" for study in all_studies() for variant in study.variants("short") if variant.twin]
        self.assertEqual(names, ["cantilever/L8_U0.8", "free_vibration/rows4"])
        for study, run in (name.split("/") for name in names):
            (found,) = (each for each in all_studies() if each.name == study)
            rows = [row for row in found.expected("short") if row.quantity.endswith(run)]
            self.assertTrue(rows and all(row.modern_tolerance >= 0 for row in rows), study)
            self.assertIn(f"| {run}_modern |", text)
        self.assertIn("of these 1 in mode modern", text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
