"""What the tests of --restart share: a run that has come half the way, to go on from."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from running_program import LONG, MISTAKE, ComparedTest, results, state_hash  # noqa: E402


class RestartTest(ComparedTest):
    """In each folder lies a run that has come to 20 us of 40 us, with two checkpoints."""

    template: Path

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.undisturbed.setUp()
        cls.undisturbed.run_here("--until", "20e-6")
        cls.mark_as_unfinished(cls.undisturbed.output)
        cls.template = cls.undisturbed.output

    @staticmethod
    def mark_as_unfinished(output: Path) -> None:
        record = json.loads((output / "run.json").read_text(encoding="utf-8"))
        record["status"] = "running"
        (output / "run.json").write_text(json.dumps(record, indent=2), encoding="utf-8")

    def setUp(self) -> None:
        super().setUp()
        shutil.copytree(self.template, self.output)

    def assert_refused(self, *arguments: str, saying: tuple[str, ...],
                       ranks: tuple[int, ...] = (1, 3) if LONG else (3,)) -> None:
        """With exit code 2, telling each part once, and leaving the results alone."""
        before = results(self.output)
        for count in ranks:
            result = self.run_here(*arguments, ranks=count, code=MISTAKE)
            self.assert_said_once(result, *saying)
            self.assertEqual(result.stdout, "")
            self.assert_same_results(results(self.output), before)

    def assert_goes_on(self, *arguments: str, ranks: int = 2) -> subprocess.CompletedProcess[str]:
        result = self.run_here(*arguments, ranks=ranks)
        self.assertEqual(state_hash(result), self.whole_hash, result.stderr)
        return result
