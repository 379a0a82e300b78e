"""A run that stops at any step and goes on, on another number of ranks each time, leaves the same bytes as one that
never stopped: every shipped case, and what no shipped case has.

SPHDROP_RESTARTS=all in the environment makes five stops of each case instead of two.
"""

from __future__ import annotations

import csv
import os
import random
import re
import shutil
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from running_program import ROOT, hashes_in, results, run  # noqa: E402

STOPS = 5 if os.environ.get("SPHDROP_RESTARTS") == "all" else 2
STEPS = 300
RANKS = (1, 3, 2)


@dataclass(frozen=True)
class Variant:
    name: str
    case: Path
    settings: tuple[str, ...] = ()


def case_file(name: str) -> Path:
    return ROOT / "cases" / name / "case.cfg"


def variants() -> list[Variant]:
    found = [Variant(path.parent.name, path) for path in sorted((ROOT / "cases").glob("*/case.cfg"))]
    quickstart, wall = case_file("quickstart"), case_file("rigid_wall")
    coarse = "resolution.spacing=6.25e-5"
    return [
        *found,
        Variant("curvature form", quickstart, (coarse, "surface_tension.form='curvature'")),
        Variant("no surface tension", quickstart, (coarse, "surface_tension.form='none'")),
        Variant("rigid drop on a wall", wall, ("resolution.spacing=5e-5", "drop.material='rigid'", "drop.initial_spin=300.0",
                                                  "drop.velocity=[0.1, -1.0]", "drop.gap=1e-7")),
        Variant("no drop", quickstart,
                (coarse, "drop.shape='none'", "drop.velocity=[0.0, 0.0]", "solid.initial_tip_velocity=0.1")),
        Variant("no solid", quickstart, (coarse, "solid.kind='none'", "drop.oscillation_velocity=0.5")),
        Variant("gravity and damping", quickstart,
                (coarse, "gravity.acceleration=[0.5, -9.81]", "solid.damping_rate=20.0", "time.step=2.5e-8")),
    ]


class RestartEquality(unittest.TestCase):
    def setUp(self) -> None:
        self.directory = Path(tempfile.mkdtemp(prefix="sphdrop-"))
        self.addCleanup(shutil.rmtree, self.directory)

    def settings(self, variant: Variant) -> list[str]:
        """With a drop that touches within the few steps."""
        all_of_them = list(variant.settings)
        falls = re.search(r"^velocity = \[.*-", variant.case.read_text(encoding="utf-8"), flags=re.MULTILINE)
        if falls and not any(setting.startswith(("drop.velocity", "solid.kind")) for setting in variant.settings):
            all_of_them += ["drop.velocity=[0.3, -3.0]", "drop.gap=1e-7"]
        return [word for setting in all_of_them for word in ("--set", setting)]

    def launch(self, variant: Variant, *arguments: str, ranks: int, directory: Path) -> str:
        directory.mkdir(exist_ok=True)
        result = run(variant.case, *arguments, *self.settings(variant), ranks=ranks, directory=directory)
        self.assertEqual(result.returncode, 0, f"{variant.name} {arguments}:\n{result.stdout}{result.stderr}")
        return result.stdout

    def compare(self, number: int, variant: Variant) -> int:
        """Stopped and not stopped. Returns how many particles touched at most."""
        place = self.directory / str(number)
        place.mkdir()
        found = re.search(r"^time step +([-+.e\d]+) ns", self.launch(variant, "--check", ranks=1, directory=place),
                          flags=re.MULTILINE)
        assert found is not None
        duration = 1e-9 * float(found.group(1)) * STEPS
        common = ["--output", "out", "--quiet", "--set", f"time.end={duration:.6e}",
                  "--set", f"output.snapshot_interval={duration / 5:.6e}",
                  "--set", f"output.history_interval={duration / 40:.6e}"]
        # It writes checkpoints on its way, which must not matter, and the other does not.
        whole = self.launch(variant, *common, "--set", f"checkpoint.interval={duration / 3:.6e}", ranks=1,
                            directory=place / "whole")

        generator = random.Random(number)
        stops = sorted(generator.uniform(0.02, 0.98) * duration for _ in range(STOPS))
        parts: list[str] = []
        for leg in range(STOPS + 1):
            arguments = [*common, "--restart", "latest"] if leg > 0 else list(common)
            if leg < STOPS:
                arguments += ["--until", f"{stops[leg]:.17g}"]
            parts = hashes_in(self.launch(variant, *arguments, ranks=RANKS[leg % len(RANKS)], directory=place / "parts"))
        self.assertEqual(len(parts), 1)
        self.assertEqual(parts, hashes_in(whole), f"{variant.name} stopped at {stops}")

        expected, stopped = results(place / "whole" / "out"), results(place / "parts" / "out")
        # Which checkpoints are left depends on when they were written; case.cfg has their interval.
        names = {name for name in expected if not name.startswith("checkpoint_") and name != "case.cfg"}
        self.assertEqual(names, {name for name in stopped if not name.startswith("checkpoint_") and name != "case.cfg"})
        self.assertIn("snapshot_000005.vtkhdf", names)
        for name in sorted(names):
            self.assertTrue(expected[name] == stopped[name], f"{variant.name}: {name} is another, stopped at {stops}")

        rows = list(csv.DictReader(expected["history.csv"].decode().splitlines()))
        self.assertGreater(float(rows[-1]["step [1]"]), STEPS / 2)
        return max(int(float(row["contact_count [1]"])) for row in rows)

    def test_stopping_leaves_no_trace(self) -> None:
        all_variants = variants()
        with ThreadPoolExecutor(max_workers=2) as pool:
            futures = [pool.submit(self.compare, *entry) for entry in enumerate(all_variants)]
        touched = []
        for variant, future in zip(all_variants, futures, strict=True):
            with self.subTest(case=variant.name):
                if future.result() > 0:
                    touched.append(variant.name)
        self.assertGreaterEqual(len(touched), 6, f"the drop touched in {touched} only")

    def test_stopping_when_a_snapshot_is_due_and_after_the_first_step(self) -> None:
        variant = Variant("quickstart", case_file("quickstart"), ("resolution.spacing=6.25e-5",))
        common = ["--output", "out", "--quiet", "--set", "time.end=6e-6", "--set", "output.snapshot_interval=2e-6"]
        whole = self.launch(variant, *common, ranks=2, directory=self.directory / "whole")
        stopped = ""
        for leg, until in enumerate(("1e-30", "2e-6", "4e-6", "4.0000001e-6", "6e-6", "6e-6")):
            going_on = [] if leg == 0 else ["--restart", "latest"]
            stopped = self.launch(variant, *common, *going_on, "--until", until, ranks=RANKS[leg % 3],
                                  directory=self.directory / "parts")
        self.assertEqual(hashes_in(stopped), hashes_in(whole))
        expected, found = (results(self.directory / name / "out") for name in ("whole", "parts"))
        for name in [name for name in expected if not name.startswith("checkpoint_")]:
            self.assertTrue(expected[name] == found[name], f"{name} is another")
        # Even the last checkpoint, by two ranks in one go and by three after five stops.
        last = max(name for name in expected if name.startswith("checkpoint_"))
        self.assertTrue(expected[last] == found[last], f"{last} is another")


if __name__ == "__main__":
    unittest.main()
