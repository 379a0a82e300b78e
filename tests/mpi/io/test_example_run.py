"""The run directory of write_example_run, read back by sphdrop_reader and by VTK.

usage: test_example_run.py DIRECTORY
"""

from __future__ import annotations

import importlib.util
import json
import sys
import unittest
from pathlib import Path

import numpy as np
from sphdrop_reader import Run

DIRECTORY = Path(sys.argv[1]) if len(sys.argv) > 1 else Path()
TOTAL = 4000


class ExampleRun(unittest.TestCase):
    def setUp(self) -> None:
        self.run_directory = Run(DIRECTORY)

    def test_snapshots(self) -> None:
        ids = np.arange(TOTAL)
        snapshots = self.run_directory.snapshots
        self.assertEqual(len(snapshots), 3)
        for number, snapshot in enumerate(snapshots):
            self.assertEqual(snapshot.time, number * 1e-4)
            self.assertEqual(snapshot.step, number * 20000)
            self.assertEqual(snapshot.state_hash, f"feedbeef{number:08x}")
            self.assertEqual(snapshot.names, ["id", "material", "position", "pressure", "velocity"])
            np.testing.assert_array_equal(snapshot["id"], ids)
            np.testing.assert_array_equal(snapshot["position"], np.stack((ids * 1e-6, np.sqrt(ids)), axis=1))
            np.testing.assert_array_equal(snapshot["velocity"], np.stack((-ids, ids / 3.0), axis=1))
            np.testing.assert_array_equal(snapshot["pressure"], 100.0 + ids)
            np.testing.assert_array_equal(snapshot.fluid, ids < 1000)
            np.testing.assert_array_equal(snapshot.solid, ids >= 1000)
            self.assertEqual(snapshot.unit("velocity"), "m/s")
            self.assertEqual(snapshot.description("material"), "0 liquid, 1 solid")

    def test_history(self) -> None:
        history = self.run_directory.history
        self.assertEqual(list(history), ["time", "drop_width"])
        self.assertEqual(history.unit("time"), "s")
        np.testing.assert_array_equal(history["time"], np.arange(5) * 5e-5)
        np.testing.assert_array_equal(history["drop_width"], 1e-3 + np.arange(5) / 3e6)

    def test_record(self) -> None:
        info = self.run_directory.info
        self.assertEqual(info["status"], "completed")
        self.assertEqual(info["ranks"], 3)
        self.assertEqual(sum(info["ranks_by_host"].values()), 3)
        self.assertEqual(info["state_hash"], "feedbeef00000002")
        self.assertEqual(info["details"], {"particles": TOTAL})
        self.assertLessEqual(info["start"], info["end"])
        self.assertTrue(all(info[key] for key in ("version", "git_commit", "build", "libraries")))

    def test_index(self) -> None:
        index = json.loads((DIRECTORY / "snapshots.vtkhdf.series").read_text())
        self.assertEqual(index["file-series-version"], "1.0")
        self.assertEqual([entry["time"] for entry in index["files"]], [0.0, 1e-4, 2e-4])

    @unittest.skipUnless(importlib.util.find_spec("vtkmodules"), "VTK's Python modules are not installed")
    def test_vtk_reads_the_same(self) -> None:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOHDF import vtkHDFReader

        reader = vtkHDFReader()
        path = str(DIRECTORY / "snapshot_000002.vtkhdf")
        self.assertTrue(reader.CanReadFile(path))
        reader.SetFileName(path)
        reader.Update()
        grid = reader.GetOutput()
        self.assertEqual(grid.GetNumberOfPoints(), TOTAL)
        self.assertEqual(grid.GetNumberOfCells(), TOTAL)
        self.assertEqual({grid.GetCellType(cell) for cell in range(TOTAL)}, {1})
        points = vtk_to_numpy(grid.GetPoints().GetData())
        ids = np.arange(TOTAL)
        np.testing.assert_array_equal(points[:, 1], np.sqrt(ids))
        data = grid.GetPointData()
        np.testing.assert_array_equal(vtk_to_numpy(data.GetArray("pressure")), 100.0 + ids)
        np.testing.assert_array_equal(vtk_to_numpy(data.GetArray("velocity"))[:, 1], ids / 3.0)
        np.testing.assert_array_equal(vtk_to_numpy(data.GetArray("material")), (ids >= 1000).astype(int))
        cell_points = [grid.GetCell(cell).GetPointId(0) for cell in (0, 17, TOTAL - 1)]
        self.assertEqual(cell_points, [0, 17, TOTAL - 1])
        fields = grid.GetFieldData()
        self.assertEqual(fields.GetArray("TimeValue").GetValue(0), 2e-4)
        self.assertEqual(fields.GetArray("step").GetValue(0), 40000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
