"""Runs whose drop a file of particles gives: taken up with the file, without it, and refused with another one."""

from __future__ import annotations

import json
import shutil
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from restart_test import RestartTest  # also finds the modules in tests/support
from running_program import MISTAKE, checkpoints, little_case, results, state_hash

SPACING = 0.0625e-3  # m, of little_case()


def places() -> np.ndarray:
    """A drop that is cut off at the right; shape [N, 2], m."""
    steps = np.arange(-6, 6) + 0.5
    x, y = (SPACING * axis.ravel() for axis in np.meshgrid(steps, steps, indexing="ij"))
    return np.stack((x, y), axis=1)[(x**2 + y**2 < 0.35e-3**2) & (x < 0.2e-3)]


class GivenDrops(RestartTest):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = Path(tempfile.mkdtemp(prefix="sphdrop-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.file = cls.folder / "drop.csv"
        cls.text = "# cut off\nx,y\n" + "".join(f"{x!r},{y!r}\n" for x, y in places().tolist())
        cls.file.write_text(cls.text, encoding="utf-8")
        cls.case_text = little_case().replace("diameter = 0.6e-3", f'particles_file = "{cls.file}"')
        super().setUpClass()

    def setUp(self) -> None:
        super().setUp()
        self.file.write_text(self.text, encoding="utf-8")

    def test_it_goes_on_with_its_file(self) -> None:
        result = self.assert_goes_on("--restart", "latest", ranks=3)
        self.assertNotIn("note: ", result.stderr)
        self.assert_same_results(results(self.output), self.whole)
        self.assertEqual(self.whole["case_drop_1.csv"], self.text.encode())
        details = json.loads((self.output / "run.json").read_text(encoding="utf-8"))["details"]
        self.assertEqual(details["particles_file"], str(self.file))
        self.assertIn(f'particles_checksum = "{details["particles_checksum"]}"'.encode(), self.whole["case.cfg"])

    def test_it_goes_on_without_its_file(self) -> None:
        self.file.unlink()
        newest = checkpoints(self.output)[-1]
        for arguments, ranks in ((("latest",), 3), (("auto",), 1), ((f"out/{newest.name}",), 2)):
            shutil.rmtree(self.output)
            shutil.copytree(self.template, self.output)
            with self.subTest(arguments=arguments):
                result = self.assert_goes_on("--restart", *arguments, ranks=ranks)
                self.assert_said_once(result, f"note: {self.file} is not there; its copy ")
                self.assert_same_results(results(self.output), self.whole)

    def test_a_checkpoint_elsewhere_brings_its_copy(self) -> None:
        self.file.unlink()
        self.assert_goes_on("--restart", str(checkpoints(self.output)[-1]), "--output", "elsewhere")
        self.assertEqual((self.directory / "elsewhere/case_drop_1.csv").read_text(encoding="utf-8"), self.text)

    def test_another_file_is_refused(self) -> None:
        for text in (self.text + "# no particle more\n", self.text.replace("\n", "\r\n")):
            self.file.write_text(text, encoding="utf-8", newline="")
            self.assert_refused("--restart", "latest", saying=("is of another case: drop.particles_checksum was ",
                                                               "the drop's file holds something else"))

    def test_another_copy_is_refused_where_the_file_is_gone(self) -> None:
        self.file.unlink()
        (self.output / "case_drop_1.csv").write_text(self.text + "# no particle more\n", encoding="utf-8")
        self.assert_refused("--restart", "latest", saying=("is of another case: drop.particles_checksum was ",))

    def test_the_same_file_elsewhere_is_the_same(self) -> None:
        self.file.rename(self.directory / "moved.csv")
        result = self.assert_goes_on("--restart", "latest", "--set", "drop.particles_file=moved.csv")
        self.assertNotIn("note: ", result.stderr)
        self.assert_same_results(results(self.output), self.whole)

    def test_a_new_run_needs_its_file(self) -> None:
        self.file.unlink()
        self.assert_refused("--fresh", saying=("cannot be read: No such file or directory",))
        shutil.rmtree(self.output)
        for ranks in (1, 3):
            result = self.run_here("--restart", "auto", ranks=ranks, code=MISTAKE)
            self.assert_said_once(result, "cannot be read: No such file or directory")

    def test_the_results_repeat_themselves(self) -> None:
        self.assert_goes_on("--fresh")
        self.file.unlink()
        moved = self.directory / "moved"
        self.output.rename(moved)
        again = self.run_here(ranks=3, code=MISTAKE)
        self.assertIn("cannot be read", again.stderr)
        (self.directory / "little.cfg").unlink()
        shutil.copy(moved / "case.cfg", self.directory / "little.cfg")
        shutil.copy(moved / "case_drop_1.csv", self.directory)
        self.assertEqual(state_hash(self.run_here(ranks=3)), self.whole_hash)
        self.assert_same_results(results(self.output), self.whole)


class Formats(RestartTest):
    """Of the file: the same particles give the same bits."""

    def test_csv_hdf5_and_snapshots(self) -> None:
        positions = places()
        velocities = np.stack((positions[:, 1] * 300, positions[:, 0] * 300), axis=1)
        masses = np.full(len(positions), 1000 * SPACING**2)
        rows = zip(positions.tolist(), velocities.tolist(), masses.tolist())
        (self.directory / "drop.csv").write_text(
            "mass,vy,x,y,vx\n" + "".join(f"{m!r},{vy!r},{x!r},{y!r},{vx!r}\n" for (x, y), (vx, vy), m in rows), encoding="utf-8")
        with h5py.File(self.directory / "drop.h5", "w") as file:
            file["position"], file["velocity"], file["mass"] = positions, velocities, masses
        common = ("--fresh", "--set", "drop.placement=centre", "--set", "drop.centre_x=1.5 mm", "--set", "drop.centre_y=0.68 mm",
                  "--set", "drop.gap=auto", "--set", "drop.diameter=0.65 mm", "--set", "time.end=6e-6", "--set",
                  "output.snapshot_interval=0")
        hashes = [state_hash(self.run_here(*common, "--set", f"drop.particles_file={name}", "--output", name.replace(".", "_")))
                  for name in ("drop.csv", "drop.h5")]
        self.assertEqual(hashes[0], hashes[1])
        self.assertTrue((self.directory / "drop_h5/case_drop_1.h5").exists())
        # The first snapshot has the drop with its velocity, and in its place.
        self.run_here("--fresh", "--set", "drop.particles_file=drop_csv/snapshot_000000.vtkhdf", "--set", "drop.velocity=[0, 0]",
                      *common[1:3], "--set", "drop.centre_x=1.5 mm", "--set", "drop.centre_y=0.68 mm", *common[7:], "--output", "again")
        from sphdrop_reader import Run

        first, again = (Run(self.directory / name).snapshots[0] for name in ("drop_csv", "again"))
        self.assertEqual(np.count_nonzero(again.fluid), len(positions))
        np.testing.assert_allclose(again["position"][again.fluid], first["position"][first.fluid], rtol=0, atol=1e-15)
        np.testing.assert_array_equal(again["velocity"][again.fluid], first["velocity"][first.fluid])
        np.testing.assert_array_equal(again["mass"][again.fluid], first["mass"][first.fluid])


if __name__ == "__main__":
    unittest.main()
