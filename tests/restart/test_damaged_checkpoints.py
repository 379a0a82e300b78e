"""Checkpoints damaged at random places: the program refuses them, says so once and leaves them alone.

SPHDROP_RESTARTS=all in the environment damages a hundred instead of twenty.
"""

from __future__ import annotations

import os
import random
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from running_program import AT_ONCE, DONE, MISTAKE, ProgramTest, checkpoints, hashes_in, run  # noqa: E402

COUNT = 100 if os.environ.get("SPHDROP_RESTARTS") == "all" else 20


def damaged(content: bytes, generator: random.Random) -> tuple[str, bytes]:
    """What was done, and what came of it: a few flipped bits, a lost end, zeros or an added tail."""
    kind = generator.choice(("flip", "flip", "cut", "zeros", "tail"))
    place = generator.randrange(len(content))
    if kind == "cut":
        return f"cut at {place}", content[:place]
    if kind == "tail":
        return "a tail", content + generator.randbytes(generator.randrange(1, 5000))
    if kind == "zeros":
        return f"zeros at {place}", content[:place] + bytes(min(4096, len(content) - place)) + content[place + 4096 :]
    flipped = bytearray(content)
    for _ in range(generator.randrange(1, 4)):
        flipped[generator.randrange(len(content))] ^= 1 << generator.randrange(8)
    return "flipped bits", bytes(flipped)


class DamagedCheckpoints(ProgramTest):
    def test_are_refused_or_lead_to_the_same_end(self) -> None:
        self.run_here("--until", "20e-6")
        sound = checkpoints(self.output)[-1].read_bytes()
        [expected] = hashes_in(self.run_here("--restart", "latest").stdout)
        generator = random.Random(1)
        refused = 0
        for number in range(COUNT):
            how, content = damaged(sound, generator)
            with self.subTest(number=number, how=how):
                path = self.directory / "checkpoint_000000000001.h5"
                path.write_bytes(content)
                result = run("little.cfg", "--quiet", "--restart", path.name, ranks=1 + number % 3, directory=self.directory,
                             options=AT_ONCE)
                if result.returncode == DONE:
                    self.assertEqual(hashes_in(result.stdout), [expected])
                    continue
                refused += 1
                self.assertEqual(result.returncode, MISTAKE, result.stderr)
                self.assert_said_once(result, f"sphdrop: cannot go on: {path.name} ")
                self.assertEqual(path.read_bytes(), content)
        # Zeros over zeros are no damage.
        self.assertGreater(refused, 0.8 * COUNT)


if __name__ == "__main__":
    unittest.main()
