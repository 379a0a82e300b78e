"""What --restart takes up and what it refuses: the latest, a file, whichever there is; changed cases; damage."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from running_program import CASE, MISTAKE, ProgramTest, checkpoints, hashes_in, results, step_of  # noqa: E402
from sphdrop_reader import _HEAD_BYTES, _digest, _seal_of, _xxh3_library  # noqa: E402


def sealed(body: bytes, number: int) -> bytes:
    """A checkpoint of format `number` with sound checksums (io/FORMAT.md)."""
    library = _xxh3_library()
    assert library is not None
    step = 1 << 20
    checksum = _digest(library, b"".join(_digest(library, body[k : k + step]) for k in range(0, len(body), step))).hex()
    head = (f"sphdrop checkpoint {number}\n"
            f"Behind these {_HEAD_BYTES} bytes of text begins HDF5: h5dump and h5py read the file as it is.\n"
            f"bytes {_HEAD_BYTES + len(body)}\nblock_bytes {step}\nchecksum {checksum}\n").encode()
    return head + _seal_of(library, head) + body


class RestartTest(ProgramTest):
    """In each folder lies a run that has come to 20 us of 40 us, with two checkpoints."""

    template: Path
    whole_hash: str
    whole: dict[str, bytes]

    @classmethod
    def setUpClass(cls) -> None:
        cls.maker = ProgramTest()
        cls.addClassCleanup(cls.maker.doCleanups)
        cls.maker.setUp()
        [cls.whole_hash] = hashes_in(cls.maker.run_here().stdout)
        cls.whole = results(cls.maker.output)
        cls.maker.setUp()
        cls.maker.run_here("--until", "20e-6")
        cls.mark_as_unfinished(cls.maker.output)
        cls.template = cls.maker.output

    @staticmethod
    def mark_as_unfinished(output: Path) -> None:
        record = json.loads((output / "run.json").read_text(encoding="utf-8"))
        record["status"] = "running"
        (output / "run.json").write_text(json.dumps(record, indent=2), encoding="utf-8")

    def setUp(self) -> None:
        super().setUp()
        shutil.copytree(self.template, self.output)

    def assert_refused(self, *arguments: str, saying: tuple[str, ...], ranks: tuple[int, ...] = (1, 3)) -> None:
        """With exit code 2, telling each part once, and leaving the results alone."""
        before = results(self.output)
        for count in ranks:
            result = self.run_here(*arguments, ranks=count, code=MISTAKE)
            self.assert_said_once(result, *saying)
            self.assertEqual(result.stdout, "")
            self.assert_same_results(results(self.output), before)

    def assert_goes_on(self, *arguments: str, ranks: int = 2) -> subprocess.CompletedProcess[str]:
        result = self.run_here(*arguments, ranks=ranks)
        self.assertEqual(hashes_in(result.stdout), [self.whole_hash], result.stderr)
        return result


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
        self.assertEqual(result.stderr, "")
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
        [expected] = hashes_in(self.run_here("--set", "time.end=48e-6", "--fresh").stdout)
        long = results(self.output)
        shutil.rmtree(self.output)
        shutil.copytree(self.template, self.output)
        self.assert_goes_on("--restart", "latest")
        result = self.run_here("--restart", "latest", "--set", "time.end=48e-6", ranks=3)
        self.assertEqual(hashes_in(result.stdout), [expected])
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
                self.assert_refused("--restart", "latest", "--set", f"{key}={value}", ranks=(1, 3) if key < "g" else (2,),
                                    saying=("sphdrop: cannot go on: ", f"{key} was ", "may change on a restart"))
        newest = checkpoints(self.output)[-1].name
        self.assert_refused("--restart", f"out/{newest}", "--set", "fluid.viscosity=2e-3", "--set", "checkpoint.keep=9",
                            saying=(newest, "fluid.viscosity was 0.001, is now 0.002 ("))

    def test_a_case_file_that_was_edited_is_noticed(self) -> None:
        (self.directory / "little.cfg").write_text(CASE.replace("diameter = 0.6e-3", "diameter = 0.7e-3"), encoding="utf-8")
        for choice in ("latest", "auto"):
            self.assert_refused("--restart", choice, saying=("drop.diameter was 0.0006, is now 0.0007",), ranks=(2,))


class Damage(RestartTest):
    def damage(self, how: str, path: Path) -> None:
        content = bytearray(path.read_bytes())
        if how == "a flipped bit":
            content[len(content) // 2] ^= 16
        elif how == "cut short":
            del content[len(content) // 3 :]
        elif how == "empty":
            content.clear()
        elif how == "something else":
            content[:] = (self.output / "snapshot_000000.vtkhdf").read_bytes()
        elif how == "an older format":
            content[:] = sealed(bytes(content[_HEAD_BYTES:]), number=0)
        path.write_bytes(content)

    KINDS = {"a flipped bit": "is damaged: the checksum", "cut short": "is truncated", "empty": "is empty",
             "something else": "is no checkpoint of sphdrop", "an older format": "is of format 0, which is older than"}

    def test_latest_falls_back_to_the_one_before(self) -> None:
        newest = checkpoints(self.output)[-1]
        intact = newest.read_bytes()
        for number, (how, word) in enumerate(self.KINDS.items()):
            for choice in ("latest", "auto"):
                with self.subTest(how=how, choice=choice):
                    shutil.rmtree(self.output)
                    shutil.copytree(self.template, self.output)
                    newest.write_bytes(intact)
                    self.damage(how, newest)
                    result = self.assert_goes_on("--restart", choice, ranks=1 + number % 3)
                    self.assert_said_once(result, f"warning: passed over out/{newest.name} ")
                    self.assertIn(word, result.stderr)
                    self.assert_same_results(results(self.output), self.whole)

    def test_a_damaged_file_is_refused(self) -> None:
        newest = checkpoints(self.output)[-1]
        intact = newest.read_bytes()
        for how, word in self.KINDS.items():
            with self.subTest(how=how):
                newest.write_bytes(intact)
                self.damage(how, newest)
                self.assert_refused("--restart", f"out/{newest.name}", saying=(f"cannot go on: out/{newest.name} ",))
                self.assertIn(word, self.run_here("--restart", f"out/{newest.name}", code=MISTAKE).stderr)

    def test_without_any_sound_one_all_are_named(self) -> None:
        first, second = checkpoints(self.output)
        self.damage("cut short", first)
        self.damage("a flipped bit", second)
        for choice in ("latest", "auto"):
            self.assert_refused("--restart", choice, saying=("no checkpoint in 'out' can be used", first.name, second.name))
        self.assert_goes_on("--fresh")

    def test_one_with_fewer_quantities_than_this_program_has_is_refused(self) -> None:
        for path in checkpoints(self.output):
            body = path.with_suffix(".hdf5")
            body.write_bytes(path.read_bytes()[_HEAD_BYTES:])
            with h5py.File(body, "r+") as file:
                del file["run/contact"]
            path.write_bytes(sealed(body.read_bytes(), number=1))
            body.unlink()
        newest = checkpoints(self.output)[-1].name
        self.assert_refused("--restart", "latest", saying=(f"cannot go on: out/{newest} lacks /run/contact",))

    def test_a_checkpoint_without_permission(self) -> None:
        newest = checkpoints(self.output)[-1]
        newest.unlink()
        newest.mkdir()  # even root cannot read it as a file
        result = self.run_here("--restart", "latest", "--until", "21e-6", ranks=2)
        self.assert_said_once(result, f"warning: passed over out/{newest.name} ")


if __name__ == "__main__":
    unittest.main()
