"""What --restart takes up and what it refuses: the latest, a file, whichever there is; changed cases."""

from __future__ import annotations

import json
import shutil
import unittest

from restart_test import RestartTest  # also finds the modules in tests/support
from running_program import checkpoints, little_case, results, state_hash, step_of


class Choices(RestartTest):
    def test_latest_is_taken_up(self) -> None:
        newest = checkpoints(self.output)[-1]
        result = self.assert_goes_on("--restart", "latest")
        self.assertEqual(result.stderr, "")
        details = json.loads((self.output / "run.json").read_text(encoding="utf-8"))["details"]
        self.assertEqual(details["restarted_from"], newest.name)
        self.assertEqual(details["restarted_at_step"], step_of(newest))
        self.assert_same_results(results(self.output), self.whole)

    def test_auto_takes_up_the_latest_or_begins(self) -> None:
        self.assert_goes_on("--restart", "auto")
        self.assert_same_results(results(self.output), self.whole)
        shutil.rmtree(self.output)
        result = self.assert_goes_on("--restart", "auto", ranks=3)
        self.assert_said_once(result, "warning: step")  # of the liquid's Mach number, as in any run from the beginning
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assert_same_results(results(self.output), self.whole)

    def test_a_file_is_taken_up_and_what_came_later_is_forgotten(self) -> None:
        oldest = checkpoints(self.output)[0]
        self.assert_goes_on("--restart", f"out/{oldest.name}")
        self.assert_same_results(results(self.output), self.whole)

    def test_a_file_is_taken_up_in_another_folder(self) -> None:
        newest = checkpoints(self.output)[-1]
        self.assert_goes_on("--restart", str(newest), "--output", "elsewhere")
        rows = (self.directory / "elsewhere" / "history.csv").read_bytes().splitlines()
        all_rows = self.whole["history.csv"].splitlines()
        self.assertEqual(rows[0], all_rows[0])
        self.assertEqual(rows[1:], all_rows[-len(rows) + 1 :])
        self.assertGreater(len(rows), 15)

    def test_a_finished_run_changes_nothing_when_taken_up(self) -> None:
        self.assert_goes_on("--restart", "latest")
        self.assert_goes_on("--restart", "latest", ranks=3)
        self.assert_same_results(results(self.output), self.whole)

    def test_a_finished_run_can_be_prolonged(self) -> None:
        expected = state_hash(self.run_here("--set", "time.end=48e-6", "--fresh"))
        long = results(self.output)
        shutil.rmtree(self.output)
        shutil.copytree(self.template, self.output)
        self.assert_goes_on("--restart", "latest")
        result = self.run_here("--restart", "latest", "--set", "time.end=48e-6", ranks=3)
        self.assertEqual(state_hash(result), expected)
        self.assert_said_once(result, "note: time.end was 4e-05, is now 4.8e-05")
        found = results(self.output)
        # The finished run's last step has a checkpoint of its own.
        for files in (found, long):
            for name in [name for name in files if name.startswith("checkpoint_")][:-1]:
                del files[name]
        self.assert_same_results(found, long)

    def test_unfinished_checkpoints_are_not_lost_by_oversight(self) -> None:
        newest = checkpoints(self.output)[-1].name
        self.assert_refused(saying=(newest, "--restart latest", "--fresh"))
        result = self.assert_goes_on("--fresh", ranks=3)
        self.assert_said_once(result, "note: replacing")
        self.assert_same_results(results(self.output), self.whole)
        # Those of a finished run are results like others.
        self.assert_goes_on()

    def test_nothing_to_go_on_from(self) -> None:
        for path in checkpoints(self.output):
            path.unlink()
        self.assert_refused("--restart", "latest", saying=("there is no checkpoint in 'out'",))
        self.assert_refused("--restart", "none.h5", saying=("cannot go on: none.h5 is not there",))
        self.assert_refused("--restart", "auto", "--fresh", saying=("--restart and --fresh contradict each other",))
        self.assert_goes_on("--restart", "auto")


class Changes(RestartTest):
    def test_what_may_change_is_named_and_does_not_change_the_state(self) -> None:
        changes = {
            "output.history_interval": ("1e-06", "3e-06"), "output.snapshot_interval": ("8e-06", "1.5e-05"),
            "checkpoint.interval": ("4e-06", "7e-06"), "checkpoint.keep": ("2", "3"),
            "checkpoint.wall_interval": ("600", "0.05"), "parallel.skin": ("0.3", "0.5"),
            "parallel.repartition_interval": ("0", "50"), "parallel.imbalance_threshold": ("1.1", "1.02"),
            "parallel.cells_per_process": ("64", "4"),
            "safety.speed_limit": ("50", "60"), "safety.domain_margin": (None, "0.005"),
        }
        words = [word for key, (_, value) in changes.items() for word in ("--set", f"{key}={value}")]
        for ranks in (1, 3):
            with self.subTest(ranks=ranks):
                shutil.rmtree(self.output)
                shutil.copytree(self.template, self.output)
                result = self.assert_goes_on("--restart", "latest", *words, ranks=ranks)
                for key, (before, after) in changes.items():
                    self.assert_said_once(result, f"note: {key} was ")
                    if before is not None:
                        self.assert_said_once(result, f"note: {key} was {before}, is now {after}\n")
                self.assertEqual(result.stderr.count("note:"), len(changes))

    def test_an_earlier_end_is_reached_at_once(self) -> None:
        result = self.run_here("--restart", "latest", "--set", "time.end=19e-6")
        self.assert_said_once(result, "note: time.end was 4e-05, is now 1.9e-05")
        rows = (self.output / "history.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(float(rows[-1].split(",")[1]), step_of(checkpoints(self.template)[-1]))

    def test_what_must_not_change_is_refused_by_name(self) -> None:
        for key, before, after in (
            ("fluid.viscosity", "0.001", "0.002"), ("drop.velocity", "[0.2, -3]", "[0.2, -2]"),
            ("solid.youngs_modulus", "3e+08", "2e+08"), ("resolution.spacing", "6.25e-05", "4.1666666666666667e-05"),
            ("surface_tension.form", "conservative", "none"), ("time.sound_cfl", "0.2", "0.1"),
            ("gravity.acceleration", "[0, 0]", "[0, -9.81]"), ("solid.kind", "cantilever", "fixed_fixed_beam"),
        ):
            value = f"'{after}'" if after[0].isalpha() else after
            with self.subTest(key=key):
                self.assert_refused("--restart", "latest", "--set", f"{key}={value}",
                                    saying=("sphdrop: cannot go on: ", f"{key} was ", "may change on a restart"))
        newest = checkpoints(self.output)[-1].name
        self.assert_refused("--restart", f"out/{newest}", "--set", "fluid.viscosity=2e-3", "--set", "checkpoint.keep=9",
                            saying=(newest, "fluid.viscosity was 0.001, is now 0.002 ("))

    def test_a_case_file_that_was_edited_is_noticed(self) -> None:
        (self.directory / "little.cfg").write_text(little_case().replace("diameter = 0.6e-3", "diameter = 0.7e-3"), encoding="utf-8")
        for choice in ("latest", "auto"):
            self.assert_refused("--restart", choice, saying=("drop.diameter was 0.0006, is now 0.0007",), ranks=(2,))


if __name__ == "__main__":
    unittest.main()
