"""A drop that wets a beam goes on from a checkpoint to the same bits, on any number of ranks."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["SPHDROP_PROGRAM"]
MPIEXEC = os.environ["SPHDROP_MPIEXEC"]

# Everything in it has a state of its own: the base's reconnection, the heat of dampers and drag, the contact's record.
CASE = """
name = "wetting"
[resolution]
spacing = 0.0625e-3
[time]
end = 80e-6
sound_cfl = 0.3
[drop]
diameter = 0.6e-3
arrangement = "lattice"
velocity = [0.3, -2.0]
gap = 1e-6
[solid]
kind = "cantilever"
length = 2e-3
[surface_tension]
contact_angle = 50.0
[contact]
stiffness_form = "fixed"
damping_ratio = 0.1
wall_drag = 1.0
[output]
snapshot_interval = 0.0
history_interval = 1e-6
"""


class Restart(unittest.TestCase):
    def setUp(self) -> None:
        self.directory = Path(tempfile.mkdtemp(prefix="sphdrop-"))
        self.addCleanup(shutil.rmtree, self.directory)
        self.case = self.directory / "wetting.cfg"
        self.case.write_text(CASE)

    def run_program(self, output: str, *arguments: str, ranks: int) -> str:
        """The state's hash at the end."""
        command = ["timeout", "-k", "5", "60", MPIEXEC, "-n", str(ranks), PROGRAM, str(self.case), "--output",
                   str(self.directory / output), "--quiet", *arguments]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        found = re.findall(r"^state hash ([0-9a-f]{16})$", result.stdout, flags=re.MULTILINE)
        self.assertEqual(len(found), 1, result.stdout)
        return found[0]

    def test_in_the_middle(self) -> None:
        whole = self.run_program("whole", ranks=1)
        history = (self.directory / "whole" / "history.csv").read_bytes()
        header, *rows = history.decode().splitlines()
        columns = [name.split()[0] for name in header.split(",")]
        last = dict(zip(columns, map(float, rows[-1].split(","))))
        for name in ("adhesion", "base_width", "reconnection", "dissipated_contact"):
            self.assertTrue(abs(last[name]) > 0, name)
        half = self.run_program("part", "--until", "40e-6", ranks=2)
        self.assertNotEqual(half, whole)
        for ranks in (1, 3):
            shutil.copytree(self.directory / "part", self.directory / str(ranks))
            self.assertEqual(self.run_program(str(ranks), "--restart", "latest", ranks=ranks), whole)
            self.assertEqual((self.directory / str(ranks) / "history.csv").read_bytes(), history, f"{ranks} ranks")


if __name__ == "__main__":
    unittest.main()
