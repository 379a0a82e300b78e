"""What sphdrop_particles writes."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

import numpy as np
from sphdrop_particles import write_particles


class ParticleFiles(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name) / "drop.csv"
        self.position = np.array([[0.1e-3, 1 / 3], [-5e-324, 2e-5]])

    def test_values_come_back_to_the_last_bit(self) -> None:
        write_particles(self.path, self.position, self.position[::-1], [1e-7, 0.1], comment="made up\nby hand")
        lines = self.path.read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines[:3], ["# made up", "# by hand", "x [m],y [m],vx [m/s],vy [m/s],mass [kg/m]"])
        found = np.array([[float(cell) for cell in line.split(",")] for line in lines[3:]])
        np.testing.assert_array_equal(found, np.column_stack((self.position, self.position[::-1], [1e-7, 0.1])))

    def test_positions_alone(self) -> None:
        write_particles(self.path, self.position.tolist())
        self.assertEqual(self.path.read_text(encoding="utf-8").splitlines()[0], "x [m],y [m]")

    def test_what_is_wrong_is_told(self) -> None:
        for arguments, said in (
            ((np.zeros((4, 3)),), "shape [4, 2]"), ((np.zeros(4),), "shape [4, 2]"),
            ((self.position, np.zeros((3, 2))), "vx [m/s],vy [m/s]: an array of shape [2, 2]"),
            ((self.position, None, [1.0]), "1 masses are given for 2 particles"),
            (([[0, 1], [np.nan, 2]],), "row 1 has a value that is not a finite number"),
        ):
            with self.assertRaises(ValueError) as caught:
                write_particles(self.path, *arguments)
            self.assertIn(said, str(caught.exception))
        self.assertFalse(self.path.exists())


if __name__ == "__main__":
    unittest.main()
