"""The checkpoints of write_example_checkpoints, read back by sphdrop_reader and shown by h5dump.

usage: test_example_checkpoints.py DIRECTORY
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

import numpy as np
import sphdrop_reader
from sphdrop_reader import Checkpoint, ResultError, Run

DIRECTORY = Path(sys.argv[1]) if len(sys.argv) > 1 else Path()
FLUID, SOLID = 3000, 1000


class ExampleCheckpoints(unittest.TestCase):
    def setUp(self) -> None:
        self.path = DIRECTORY / "checkpoint_000000000300.h5"
        warnings.simplefilter("error")

    def test_run_lists_them_newest_first(self) -> None:
        names = [path.name for path in Run(DIRECTORY).checkpoints]
        self.assertEqual(names, ["checkpoint_000000000300.h5", "checkpoint_000000000200.h5"])

    def test_header_and_numbers(self) -> None:
        checkpoint = Checkpoint(self.path)
        self.assertEqual(checkpoint.time, 1e-8 * 300)
        self.assertEqual((checkpoint.step, checkpoint.state_hash), (300, "0123456789abcdef"))
        self.assertEqual((checkpoint.case_name, checkpoint.version, checkpoint.git_commit), ("test case", "0.1.0", "55566bd"))
        self.assertEqual(
            checkpoint.case_text,
            'name = "test case"\n\n[resolution]\nparticle_spacing = 1e-05 # \u00b5m, "quoted"\n',
        )
        self.assertEqual(list(checkpoint.numbers), ["contact_impulse", "nothing", "time_step"])
        self.assertEqual(checkpoint.numbers["time_step"].tolist(), [1.25e-8])
        self.assertEqual(checkpoint.numbers["nothing"].tolist(), [])
        impulse = checkpoint.numbers["contact_impulse"].view(np.uint64)
        self.assertEqual(impulse.tolist(), [1 << 63, 0xFFF8DEAD0000BEEF, np.array(3.0).view(np.uint64).item()])
        self.assertEqual(checkpoint.numbers.unit("contact_impulse"), "N s/m")
        self.assertEqual(checkpoint.numbers.description("time_step"), "of the last step")
        with self.assertRaisesRegex(ResultError, "no 'seed'; there are contact_impulse, nothing, time_step"):
            checkpoint.numbers["seed"]

    def test_tables(self) -> None:
        tables = Checkpoint(self.path).tables
        self.assertEqual(list(tables), ["fluid", "solid"])
        for name, first, rows, scale in (("fluid", 0, FLUID, 1.0), ("solid", FLUID, SOLID, -7.0)):
            ids = np.arange(first, first + rows)
            table = tables[name]
            self.assertEqual(list(table), ["density", "unusual", "x"])
            self.assertEqual((table.row_count, table.first_id), (rows, first))
            np.testing.assert_array_equal(table.ids, ids)
            np.testing.assert_array_equal(table["x"], scale * (ids + 0.25))
            np.testing.assert_array_equal(table["density"], scale * (ids + 1.0 / 3.0))
            self.assertEqual(table.unit("density"), "kg/m3")
            self.assertEqual(table.description("x"), "position")
            with self.assertRaisesRegex(ResultError, f"/{name}: there is no 'colour'; there are density, unusual, x"):
                table["colour"]
        unusual = tables["fluid"]["unusual"].view(np.uint64)
        self.assertEqual([f"{bits:016x}" for bits in unusual[4:7].tolist()],
                         ["7ff8000000000001", "fff8dead0000beef", "7ff0000000000001"])

    def test_damaged_ones_are_refused(self) -> None:
        sound = self.path.read_bytes()
        library = sphdrop_reader._xxh3_library()
        self.assertIsNotNone(library, "libxxhash0 comes with libxxhash-dev")
        future = b"sphdrop checkpoint 2\nanything else\n"
        future += sphdrop_reader._seal_of(library, future)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "checkpoint.h5"
            for content, message in (
                (b"", "is no checkpoint of sphdrop"),
                (b"x" * 1000, "is no checkpoint of sphdrop"),
                (future + sound[512:], "is of format 2; this reader knows format 1"),
                (sound[:-1], f"is truncated: {len(sound) - 1} of {len(sound)} bytes are there"),
                (sound[:300], "is truncated: 300 of at least 512 bytes are there"),
                (sound + b"x", f"is damaged: it has {len(sound) + 1} bytes, not {len(sound)}"),
                (sound[:5000] + bytes([sound[5000] ^ 1]) + sound[5001:], "is damaged: the checksum of its bytes is"),
                (sound.replace(b"checkpoint 1", b"checkpoint 2", 1), "is damaged: its first 512 bytes"),
                (sound[:511] + b"x" + sound[512:], "is damaged: its first 512 bytes"),
            ):
                path.write_bytes(content)
                with self.subTest(message), self.assertRaisesRegex(ResultError, message):
                    Checkpoint(path)
            with self.assertRaisesRegex(ResultError, "cannot be read: No such file"):
                Checkpoint(Path(folder) / "missing")

    def test_without_the_library_the_sum_is_not_checked_and_said_so(self) -> None:
        with mock.patch.object(sphdrop_reader, "_xxh3_library", return_value=None):
            with self.assertWarnsRegex(UserWarning, "libxxhash is not there: the checksum was not checked"):
                checkpoint = Checkpoint(self.path)
        self.assertEqual(checkpoint.step, 300)

    @unittest.skipUnless(shutil.which("h5dump"), "h5dump is not installed")
    def test_h5dump_shows_it(self) -> None:
        done = subprocess.run(["h5dump", "-A", self.path], capture_output=True, text=True, check=True)
        for words in ("sphdrop checkpoint 1", "State of a simulation", "kg/m3", 'DATASET "density"', 'GROUP "fluid"'):
            self.assertIn(words, done.stdout)
        done = subprocess.run(["h5dump", "-d", "/case", self.path], capture_output=True, text=True, check=True)
        self.assertIn("[resolution]\n", done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
