"""Every shipped case gives the same bits on any number of ranks, as the program runs it."""

from __future__ import annotations

import csv
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = os.environ["SPHDROP_PROGRAM"]
MPIEXEC = os.environ["SPHDROP_MPIEXEC"]

# Long enough for the drop of most cases to touch: the gap of 0.1 spacings takes 3 us at 0.8 m/s, in steps of 6 ns.
STEPS = 700
RANKS = (1, 2, 3)


def case_files() -> list[Path]:
    return sorted((ROOT / "cases").glob("*/case.cfg"))


def run(*arguments: str | Path, ranks: int = 1) -> str:
    """What the program prints on standard output."""
    command = ["timeout", "-k", "5", "60", MPIEXEC, "-n", str(ranks), PROGRAM, *map(str, arguments)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(command)} ended with {result.returncode}:\n{result.stdout}{result.stderr}")
    return result.stdout


def time_of_steps(case: Path, steps: int) -> float:
    """How far so many steps go, s: by --check, which tells the step in ns."""
    found = re.search(r"^time step +([-+.e\d]+) ns", run("--check", case), flags=re.MULTILINE)
    if found is None:
        raise AssertionError(f"--check {case} does not tell the time step")
    return 1e-9 * float(found.group(1)) * steps


class Cases(unittest.TestCase):
    def setUp(self) -> None:
        self.directory = Path(tempfile.mkdtemp(prefix="sphdrop-"))
        self.addCleanup(shutil.rmtree, self.directory)

    def outcome(self, case: Path, until: float, ranks: int) -> tuple[str, bytes, int]:
        """The state's hash, the history and the number of steps."""
        output = self.directory / case.parent.name / str(ranks)
        found = re.findall(
            r"^state hash ([0-9a-f]{16})$",
            run(case, "--until", f"{until:.6e}", "--output", output, "--quiet", ranks=ranks),
            flags=re.MULTILINE,
        )
        self.assertEqual(len(found), 1)
        history = output / "history.csv"
        rows = list(csv.reader(history.read_text(encoding="utf-8").splitlines()))
        steps = rows[-1][[name.split()[0] for name in rows[0]].index("step")]
        return found[0], history.read_bytes(), int(float(steps))

    def test_every_case_gives_the_same_bits_on_one_two_and_three_ranks(self) -> None:
        hashes = {}
        for case in case_files():
            with self.subTest(case=case.parent.name):
                until = time_of_steps(case, STEPS)
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
