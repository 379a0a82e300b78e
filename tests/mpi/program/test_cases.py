"""Every shipped case gives the same bits on any number of ranks, as the program runs it."""

from __future__ import annotations

import csv
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
from running_program import case_files, run, state_hash, time_of_steps  # noqa: E402

# Long enough for the drop of most cases to touch: the gap of 0.1 spacings takes 3 us at 0.8 m/s, in steps of 6 ns.
STEPS = 700
RANKS = (1, 2, 3)


class Cases(unittest.TestCase):
    def setUp(self) -> None:
        self.directory = Path(tempfile.mkdtemp(prefix="sphdrop-"))
        self.addCleanup(shutil.rmtree, self.directory)

    def outcome(self, case: Path, until: float, ranks: int) -> tuple[str, bytes, int]:
        """The state's hash, the history and the number of steps."""
        output = self.directory / case.parent.name / str(ranks)
        result = run(case, "--until", f"{until:.6e}", "--output", output, "--quiet", ranks=ranks)
        self.assertEqual(result.returncode, 0, result.stderr)
        history = output / "history.csv"
        rows = list(csv.reader(history.read_text(encoding="utf-8").splitlines()))
        steps = rows[-1][[name.split()[0] for name in rows[0]].index("step")]
        return state_hash(result), history.read_bytes(), int(float(steps))

    def test_every_case_gives_the_same_bits_on_one_two_and_three_ranks(self) -> None:
        hashes = {}
        for case in case_files():
            with self.subTest(case=case.parent.name):
                until = time_of_steps(STEPS, case)
                alone, history, steps = self.outcome(case, until, RANKS[0])
                self.assertGreater(steps, STEPS // 2)
                self.assertGreater(len(history.splitlines()), 2)
                hashes[case] = alone
                for ranks in RANKS[1:]:
                    together, history_together, _ = self.outcome(case, until, ranks)
                    self.assertEqual(alone, together, f"the state's hash on {ranks} ranks")
                    self.assertEqual(history, history_together, f"history.csv on {ranks} ranks")
        self.assertGreater(len(hashes), 5)
        self.assertEqual(len(set(hashes.values())), len(hashes), "different cases have different states")


if __name__ == "__main__":
    unittest.main()
