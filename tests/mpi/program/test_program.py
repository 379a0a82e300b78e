"""The program as its users meet it: command line, exit codes, files, the same bytes from any number of ranks."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
import running_program  # noqa: E402
from running_program import MISTAKE, UNSAFE, little_case, run, state_hash  # noqa: E402
from sphdrop_reader import Checkpoint, Run  # noqa: E402

CASE = little_case(end=8e-6, snapshot_interval=4e-6)


class ProgramTest(running_program.ProgramTest):
    case_text = CASE


class Results(ProgramTest):
    def test_every_number_of_ranks_writes_the_same_bytes(self) -> None:
        hashes = set()
        for ranks in (1, 2, 3):
            result = run(self.case, "--output", self.directory / str(ranks), ranks=ranks)
            self.assertEqual(result.returncode, 0, result.stderr)
            hashes.add(state_hash(result))
        self.assertEqual(len(hashes), 1)
        files = sorted(path.name for path in (self.directory / "1").iterdir())
        self.assertEqual(
            [name for name in files if name.startswith("snapshot_")],
            ["snapshot_000000.vtkhdf", "snapshot_000001.vtkhdf", "snapshot_000002.vtkhdf"],
        )
        for name in set(files) - {"run.json", "run.lock", "case.cfg"}:
            alone = (self.directory / "1" / name).read_bytes()
            for ranks in ("2", "3"):
                self.assertEqual(alone, (self.directory / ranks / name).read_bytes(), f"{name} on {ranks} ranks")

    def test_the_hash_is_the_last_snapshots(self) -> None:
        result = run(self.case, "--output", self.directory / "out", ranks=2)
        results = Run(self.directory / "out")
        self.assertEqual(results.snapshots[-1].state_hash, state_hash(result))
        self.assertGreaterEqual(results.snapshots[-1].time, 8e-6)
        self.assertEqual(results.history["time"][0], 0.0)
        self.assertEqual(results.history["time"][-1], results.snapshots[-1].time)

    def test_the_effective_case_runs_to_the_same_bits(self) -> None:
        first = run(self.case, "--output", self.directory / "first", "--set", "drop.velocity=[0.1, -2.5]")
        effective = self.directory / "effective.cfg"
        shutil.copy(self.directory / "first" / "case.cfg", effective)
        second = run(effective, "--output", self.directory / "second")
        self.assertEqual(state_hash(first), state_hash(second))
        unchanged = run(self.case, "--output", self.directory / "third")
        self.assertNotEqual(state_hash(first), state_hash(unchanged))

    def test_until_stops_earlier_on_the_same_path(self) -> None:
        whole = run(self.case, "--output", self.directory / "whole")
        self.assertEqual(whole.returncode, 0)
        part = run(self.case, "--output", self.directory / "part", "--until", "4e-6")
        self.assertEqual(part.returncode, 0)
        rows = (self.directory / "part" / "history.csv").read_text().splitlines()
        all_rows = (self.directory / "whole" / "history.csv").read_text().splitlines()
        self.assertLess(len(rows), len(all_rows))
        self.assertEqual(rows, all_rows[: len(rows)])
        self.assertEqual(
            (self.directory / "part" / "snapshot_000001.vtkhdf").read_bytes(),
            (self.directory / "whole" / "snapshot_000001.vtkhdf").read_bytes(),
        )

    def test_results_of_an_earlier_run_are_replaced(self) -> None:
        run(self.case, "--output", self.directory / "out")
        result = run(self.case, "--output", self.directory / "out", "--until", "1e-6")
        self.assertIn("replacing", result.stderr)
        self.assertEqual(len(Run(self.directory / "out").snapshots), 2)
        self.assertFalse((self.directory / "out" / "snapshot_000002.vtkhdf").exists())

    def test_a_checkpoint_read_in_python_is_the_snapshot_of_the_same_step(self) -> None:
        run(self.case, "--output", self.directory / "out", ranks=3)
        results = Run(self.directory / "out")
        snapshot, checkpoint = results.snapshots[-1], Checkpoint(results.checkpoints[0])
        self.assertEqual((checkpoint.time, checkpoint.step), (snapshot.time, snapshot.step))
        self.assertEqual(checkpoint.case_name, "little")
        self.assertIn("diameter = ", checkpoint.case_text)
        self.assertEqual(checkpoint.numbers["clock"][:2].tolist(), [snapshot.time, snapshot.step])
        for name, mask in (("fluid", snapshot.fluid), ("solid", snapshot.solid)):
            table = checkpoint.tables[name]
            self.assertEqual(table.ids.tolist(), mask.nonzero()[0].tolist())
            for axis, column in enumerate(("position_x", "position_y")):
                self.assertEqual(table[column].tolist(), snapshot["position"][mask, axis].tolist())
            self.assertEqual(table["mass"].tolist(), snapshot["mass"][mask].tolist())
        self.assertNotEqual(checkpoint.state_hash, snapshot.state_hash, "FORMAT.md says that they differ")

    def test_the_summary_says_what_happened(self) -> None:
        result = run(self.case, "--output", self.directory / "out", ranks=2)
        for part in ("contact", "largest deflection", "momentum ledger", "energy ledger", "wall time", "2 ranks"):
            self.assertIn(part, result.stdout)


class MachNumber(ProgramTest):
    def test_is_watched_at_every_step_and_warned_of_once(self) -> None:
        found = []
        for ranks in (1, 3):
            result = run(self.case, "--output", self.directory / str(ranks), ranks=ranks)
            self.assertEqual(result.stderr.count("warning: step "), 1, result.stderr)
            self.assertIn("more than 0.1 of fluid.sound_speed = 50 m/s", result.stderr)
            details = json.loads((self.directory / str(ranks) / "run.json").read_text())["details"]
            found.append(details["largest_mach_number"])
            self.assertIn(f"largest Mach number       {found[-1]:.4f} at ", result.stdout)
        self.assertEqual(found[0], found[1])
        self.assertGreater(found[0], 0.1)
        # No row of the history, and no snapshot, need be at the fastest instant.
        fastest = max(np.hypot(*snapshot["velocity"][snapshot.fluid].T).max() for snapshot in Run(self.directory / "1").snapshots)
        self.assertGreater(found[0], 0.9 * fastest / 50)
        self.assertLess(found[0], 1.5 * fastest / 50)
        slow = run(self.case, "--output", self.directory / "slow", "--set", "fluid.sound_speed=150")
        self.assertNotIn("warning: step", slow.stderr)

    def test_goes_through_a_restart(self) -> None:
        whole, parts = self.directory / "whole", self.directory / "parts"
        run(self.case, "--output", whole)
        run(self.case, "--output", parts, "--until", "7.5e-6")
        again = run(self.case, "--output", parts, "--restart", "latest")
        self.assertNotIn("warning: step", again.stderr, "it has been said")
        details = [json.loads((folder / "run.json").read_text())["details"] for folder in (whole, parts)]
        self.assertEqual(details[0]["largest_mach_number"], details[1]["largest_mach_number"])


class Checking(ProgramTest):
    def test_check_reports_and_writes_nothing(self) -> None:
        before = sorted(self.directory.iterdir())
        result = run("--check", self.case, ranks=2, directory=self.directory)
        self.assertEqual(result.returncode, 0, result.stderr)
        for part in ("particles", "time step", "steps", "memory", "expected wall time", "partition", "Weber number"):
            self.assertIn(part, result.stdout)
        self.assertEqual(before, sorted(self.directory.iterdir()))

    def test_check_says_what_the_case_is(self) -> None:
        result = run("--check", self.case, "--set", "drop.velocity=[0, -1]", "--set", "gravity.acceleration=[0, -9.81]")
        for part in ("Weber number        8.333", "Reynolds number", "Bond number         0.04905", "spacings across     9.6 in the drop: coarse",
                     "sound speed         50 times the drop's\n", "on a rigid wall     D_max about 2.15 D0, 1.29 mm; its film has 3.5 spacings: it may",
                     "contact time        about 1.91 ms there", "rows across         4 in the beam; the paper's runs have 10",
                     "beam's first period 0.1725 ms in theory (Eqs 43, 44), 0.0902 of that contact time"):
            self.assertIn(part, result.stdout)
        self.assertIn("no estimate: it has been fitted for Weber numbers of 3 to 60", run("--check", self.case).stdout)
        self.assertIn("less than the 50 times it", run("--check", self.case).stdout)
        self.assertNotIn("sub-steps", run("--check", self.case).stdout)
        self.assertIn("sub-steps of solid  3 a step", run("--check", self.case, "--set", 'mode="fast"').stdout)

    def test_questions_are_answered_once(self) -> None:
        for option, part in (("--help", "--check"), ("--version", ", commit "), ("--list-parameters", "drop.diameter")):
            result = run(option, ranks=3)
            self.assertEqual(result.returncode, 0)
            self.assertEqual(result.stdout.count(part), run(option).stdout.count(part))
            self.assertGreater(result.stdout.count(part), 0)


class Mistakes(ProgramTest):
    def expect_refusal(self, result: subprocess.CompletedProcess[str], code: int, *parts: str) -> None:
        self.assertEqual(result.returncode, code, result.stderr)
        self.assert_said_once(result, *parts)

    def test_in_the_case(self) -> None:
        self.case.write_text(CASE.replace("diameter = 0.6e-3", "diametre = 0.6e-3"))
        for ranks in (1, 3):
            result = run(self.case, ranks=ranks)
            self.expect_refusal(result, MISTAKE, "little.cfg:9: ", "drop.diametre", "drop.diameter")

    def test_in_the_command_line(self) -> None:
        self.expect_refusal(run("--chekc", self.case, ranks=3), MISTAKE, "--chekc")
        self.expect_refusal(run(self.case, "--set", "drop.gap=-1", ranks=3), MISTAKE, "--set drop.gap=-1")

    def test_a_case_that_is_not_there(self) -> None:
        self.expect_refusal(run(self.directory / "nothing.cfg", ranks=3), MISTAKE, "nothing.cfg")

    def test_a_drop_in_the_beam(self) -> None:
        self.expect_refusal(run(self.case, "--set", "drop.centre_x=0.0", ranks=3), MISTAKE, "clamp")

    def test_results_that_have_no_place(self) -> None:
        blocked = self.directory / "file"
        blocked.write_text("not a folder")
        self.expect_refusal(run(self.case, "--output", blocked / "out", ranks=3), MISTAKE, "is a file; remove it")

    def test_results_that_would_replace_the_case(self) -> None:
        own = self.directory / "case.cfg"
        own.write_text(CASE)
        self.expect_refusal(run(own, "--output", self.directory, ranks=2), MISTAKE, "would replace the case file")
        self.assertEqual(own.read_text(), CASE)
        # An effective case may run again where it lies: it is replaced by itself.
        run(own, "--output", self.directory / "out")
        again = run(self.directory / "out" / "case.cfg")
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_a_state_that_is_not_sound(self) -> None:
        result = run(self.case, "--output", self.directory / "out", "--set", "safety.speed_limit=2", ranks=3)
        self.expect_refusal(result, UNSAFE, "safety.speed_limit, now 2 m/s", "Last good snapshot: ", "snapshot_000000.vtkhdf")
        self.assertIn("stopped", (self.directory / "out" / "run.json").read_text())


if __name__ == "__main__":
    unittest.main()
