"""A run that stops at any step and goes on, on another number of ranks each time, leaves the same bytes as one that
never stopped: every shipped case, and what no shipped case has.

With SPHDROP_LONG_TESTS=1 in the environment every case runs with both forms of surface tension, is stopped five times
instead of twice, and has its row in a table.
"""

from __future__ import annotations

import csv
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
from running_program import (  # noqa: E402
    LONG,
    ROOT,
    case_files,
    checkpoints,
    results,
    run,
    state_hash,
    step_of,
    time_of_steps,
)

RANKS = (1, 3, 2)
QUICKSTART = ROOT / "cases" / "quickstart" / "case.cfg"
WALL = ROOT / "cases" / "rigid_wall" / "case.cfg"
COARSE = "resolution.spacing=6.25e-5"


@dataclass(frozen=True)
class Variant:
    name: str
    case: Path
    settings: tuple[str, ...] = ()

    def arguments(self) -> list[str | Path]:
        """With a drop that touches within the few steps."""
        settings = list(self.settings)
        falls = re.search(r"^velocity = \[.*-", self.case.read_text(encoding="utf-8"), flags=re.MULTILINE)
        if falls and not any(setting.startswith(("drop.velocity", "solid.kind")) for setting in settings):
            settings += ["drop.velocity=[0.3, -3.0]", "drop.gap=1e-7"]
        return [self.case, *(word for setting in settings for word in ("--set", setting))]


@dataclass(frozen=True)
class Outcome:
    steps: int
    stops: tuple[int, ...]  # the steps at which it stopped
    touching: int  # particles, at most
    differences: tuple[str, ...]

    def row(self, name: str) -> str:
        stops = ", ".join(map(str, self.stops))
        return f"| {name} | {self.steps} | {stops} | {', '.join(self.differences) or 'yes'} |"


def launch(variant: Variant, *arguments: str, ranks: int, directory: Path) -> str:
    """The state's hash at the end."""
    directory.mkdir(parents=True, exist_ok=True)
    result = run(*variant.arguments(), "--output", "out", "--quiet", *arguments, ranks=ranks, directory=directory)
    if result.returncode != 0:
        raise AssertionError(f"{variant.name} {arguments}:\n{result.stdout}{result.stderr}")
    return state_hash(result)


def differences(whole: Path, stopped: Path) -> list[str]:
    """The files that differ. Which checkpoints are left depends on when they were written; case.cfg has their interval."""
    expected, found = (
        {name: content for name, content in results(place / "out").items()
         if not name.startswith("checkpoint_") and name != "case.cfg"} for place in (whole, stopped))
    return sorted(name for name in set(expected) | set(found) if expected.get(name) != found.get(name))


def compare(place: Path, variant: Variant, steps: int, stop_count: int, seed: int) -> Outcome:
    """Stopped at random, and not stopped."""
    whole, parts = place / "whole", place / "parts"
    duration = time_of_steps(steps, *variant.arguments())
    common = ["--set", f"time.end={duration:.6e}", "--set", f"output.snapshot_interval={duration / 5:.6e}",
              "--set", f"output.history_interval={duration / 40:.6e}"]
    # It writes checkpoints on its way, which must not matter, and the other does not.
    expected = launch(variant, *common, "--set", f"checkpoint.interval={duration / 3:.6e}", ranks=1, directory=whole)
    generator = random.Random(seed)
    stops = []
    for leg, end in enumerate([*sorted(generator.uniform(0.02, 0.98) * duration for _ in range(stop_count)), duration]):
        going_on = ["--restart", "latest"] if leg > 0 else []
        found = launch(variant, *common, *going_on, "--until", f"{end:.17g}", ranks=RANKS[leg % len(RANKS)], directory=parts)
        stops.append(step_of(checkpoints(parts / "out")[-1]))
    different = differences(whole, parts)
    if found != expected:
        different.insert(0, f"hash {found}, not {expected}")
    rows = list(csv.DictReader((whole / "out" / "history.csv").read_text(encoding="utf-8").splitlines()))
    if not (whole / "out" / "snapshot_000005.vtkhdf").exists() or stops[-1] < steps / 2:
        raise AssertionError(f"{variant.name}: too short to tell anything")
    return Outcome(stops[-1], tuple(stops[:-1]), max(int(float(row["contact_count [1]"])) for row in rows), tuple(different))


def compare_all(place: Path, variants: list[Variant], steps: int, stop_count: int) -> list[Outcome]:
    with ThreadPoolExecutor(max_workers=2) as pool:
        futures = [pool.submit(compare, place / str(number), variant, steps, stop_count, number)
                   for number, variant in enumerate(variants)]
        return [future.result() for future in futures]


def what_no_case_has() -> list[Variant]:
    return [
        Variant("curvature form", QUICKSTART, (COARSE, "surface_tension.form='curvature'")),
        Variant("no surface tension", QUICKSTART, (COARSE, "surface_tension.form='none'")),
        Variant("rigid drop on a wall", WALL, ("resolution.spacing=5e-5", "drop.material='rigid'", "drop.initial_spin=300.0",
                                               "drop.velocity=[0.1, -1.0]", "drop.gap=1e-7")),
        Variant("no drop", QUICKSTART,
                (COARSE, "drop.shape='none'", "drop.velocity=[0.0, 0.0]", "solid.initial_tip_velocity=0.1")),
        Variant("no solid", QUICKSTART, (COARSE, "solid.kind='none'", "drop.oscillation_velocity=0.5")),
        Variant("gravity and damping", QUICKSTART,
                (COARSE, "gravity.acceleration=[0.5, -9.81]", "solid.damping_rate=20.0", "time.step=2.5e-8")),
        Variant("modern beam", QUICKSTART, (COARSE, "mode='modern'")),
        Variant("fast beam", QUICKSTART, (COARSE, "mode='fast'")),
        Variant("modern drop on a wall", WALL, ("resolution.spacing=5e-5", "mode='modern'")),
        Variant("total-Lagrangian beam", QUICKSTART, (COARSE, "solid.formulation='total_lagrangian'")),
        Variant("wetted beam", QUICKSTART, (COARSE, "surface_tension.contact_angle=60.0", "contact.wall_drag=1.0")),
    ]


class RestartEquality(unittest.TestCase):
    def setUp(self) -> None:
        self.directory = Path(tempfile.mkdtemp(prefix="sphdrop-"))
        self.addCleanup(shutil.rmtree, self.directory)

    def test_stopping_leaves_no_trace(self) -> None:
        if LONG:
            variants = [Variant(f"{path.parent.name} | {form}", path, (f"surface_tension.form='{form}'",))
                        for path in case_files() for form in ("conservative", "curvature")]
            variants += [Variant(f"{variant.name} | -", variant.case, variant.settings) for variant in what_no_case_has()]
            outcomes = compare_all(self.directory, variants, steps=500, stop_count=5)
            print("| case | form | steps | stopped after step | equal |\n|---|---|---|---|---|")
            for variant, outcome in zip(variants, outcomes, strict=True):
                print(outcome.row(variant.name), flush=True)
        else:
            variants = [*(Variant(path.parent.name, path) for path in case_files()), *what_no_case_has()]
            outcomes = compare_all(self.directory, variants, steps=200, stop_count=2)
        for variant, outcome in zip(variants, outcomes, strict=True):
            with self.subTest(case=variant.name):
                self.assertEqual(outcome.differences, (), f"stopped at {outcome.stops}")
        touched = [variant.name for variant, outcome in zip(variants, outcomes, strict=True) if outcome.touching > 0]
        self.assertGreaterEqual(len(touched), 6, f"the drop touched in {touched} only")

    def test_stopping_when_a_snapshot_is_due_and_after_the_first_step(self) -> None:
        variant = Variant("quickstart", QUICKSTART, (COARSE,))
        common = ["--set", "time.end=6e-6", "--set", "output.snapshot_interval=2e-6"]
        whole, parts = self.directory / "whole", self.directory / "parts"
        expected = launch(variant, *common, ranks=2, directory=whole)
        for leg, until in enumerate(("1e-30", "2e-6", "4e-6", "4.0000001e-6", "6e-6", "6e-6")):
            going_on = [] if leg == 0 else ["--restart", "latest"]
            found = launch(variant, *common, *going_on, "--until", until, ranks=RANKS[leg % 3], directory=parts)
        self.assertEqual(found, expected)
        self.assertEqual(differences(whole, parts), [])
        # Even the last checkpoint, by two ranks in one go and by three after five stops.
        last = checkpoints(whole / "out")[-1].name
        self.assertTrue((whole / "out" / last).read_bytes() == (parts / "out" / last).read_bytes(), f"{last} is another")


if __name__ == "__main__":
    unittest.main()
