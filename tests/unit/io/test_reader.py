"""What sphdrop_reader makes of results, whole ones and others."""

from __future__ import annotations

import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
import synthetic_run
from sphdrop_reader import ResultError, Run, Snapshot


class Reader(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.directory = Path(folder.name) / "run"

    def test_snapshots_in_the_order_of_the_index(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=5)
        run = Run(self.directory)
        np.testing.assert_allclose(run.snapshots.times, np.linspace(0, synthetic_run.END, 5), rtol=1e-15)
        self.assertEqual([snapshot.step for snapshot in run.snapshots], [0, 1000, 2000, 3000, 4000])
        self.assertEqual(run.snapshots.at(1.6e-3).step, 2000)
        self.assertEqual(run.snapshots[-1].step, 4000)
        self.assertEqual([snapshot.step for snapshot in run.snapshots[1:3]], [1000, 2000])
        self.assertRaises(IndexError, lambda: run.snapshots[5])

    def test_arrays_and_masks(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=1)
        snapshot = Run(self.directory).snapshots[0]
        drop, beam = synthetic_run.drop(0.0), synthetic_run.beam(0.0)
        np.testing.assert_array_equal(snapshot["position"][snapshot.fluid], drop["position"])
        np.testing.assert_array_equal(snapshot["position"][snapshot.solid], beam["position"])
        np.testing.assert_array_equal(snapshot["velocity"], np.concatenate((drop["velocity"], beam["velocity"])))
        self.assertEqual(snapshot["density"].shape, (snapshot.particle_count,))
        self.assertEqual(snapshot.unit("velocity"), "m/s")
        self.assertEqual(snapshot.unit("position"), "m")
        self.assertIn("pressure", snapshot)
        self.assertNotIn("temperature", snapshot)
        with self.assertRaisesRegex(ResultError, "no 'temperature'; there are density, is_fixed, mass"):
            snapshot["temperature"]
        with self.assertRaisesRegex(ResultError, "no 'temperature'"):
            snapshot.unit("temperature")

    def test_opening_a_run_reads_no_snapshot(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=3)
        (self.directory / "snapshot_000001.vtkhdf").write_text("broken")
        snapshots = Run(self.directory).snapshots
        self.assertEqual(len(snapshots), 3)
        self.assertEqual(snapshots[2].step, 2000)
        with self.assertRaisesRegex(ResultError, "snapshot_000001.vtkhdf: cannot be read as HDF5"):
            snapshots[1]

    def test_the_index_decides_over_left_over_files(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=3)
        (self.directory / "snapshot_000007.vtkhdf").write_bytes((self.directory / "snapshot_000002.vtkhdf").read_bytes())
        self.assertEqual(len(Run(self.directory).snapshots), 3)
        (self.directory / "snapshots.vtkhdf.series").unlink()
        self.assertEqual(len(Run(self.directory).snapshots), 4)

    def test_history(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=1)
        history = Run(self.directory).history
        self.assertEqual(history.unit("contact_impulse_y"), "N s/m")
        self.assertEqual(history["time"].shape, (200,))
        self.assertEqual(history["time"][-1], synthetic_run.END)
        with self.assertRaisesRegex(ResultError, "no 'torque'; there are time, drop_width"):
            history["torque"]

    def test_damaged_histories_are_explained(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=1)
        path = self.directory / "history.csv"
        for text, message in (("", "is empty"), ("time [s],b\n", "cell 'b' is not of the form"),
                              ("time [s],b [m]\n1,2\n3\n", "line 3 has 1 values, not 2"),
                              ("time [s]\nabc\n", "could not convert")):
            path.write_text(text)
            with self.assertRaisesRegex(ResultError, message):
                Run(self.directory).history
        path.write_text("time [s],b [m]\n")
        self.assertEqual(len(Run(self.directory).history["b"]), 0)
        path.unlink()
        with self.assertRaisesRegex(ResultError, "history.csv: cannot be read: No such file"):
            Run(self.directory).history

    def test_other_files(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=1)
        run = Run(self.directory)
        self.assertEqual(run.case_text, 'name = "synthetic"\n')
        self.assertEqual(run.info, {"status": "completed"})
        (self.directory / "run.json").write_text("{")
        with self.assertRaisesRegex(ResultError, "run.json: is not JSON"):
            run.info
        (self.directory / "case.cfg").unlink()
        with self.assertRaisesRegex(ResultError, "case.cfg: cannot be read"):
            run.case_text

    def test_directories_without_results(self) -> None:
        with self.assertRaisesRegex(ResultError, "is not a directory"):
            Run(self.directory)
        self.directory.mkdir()
        with self.assertRaisesRegex(ResultError, "holds no results"):
            Run(self.directory)

    def test_an_hdf5_file_of_another_kind(self) -> None:
        import h5py

        self.directory.mkdir()
        path = self.directory / "other.h5"
        h5py.File(path, "w").close()
        with self.assertRaisesRegex(ResultError, "is no snapshot of sphdrop"):
            Snapshot(path)


if __name__ == "__main__":
    unittest.main()
