"""Checkpoints that are damaged, of another format or incomplete: the program refuses them, says so once, leaves them
alone and falls back to the one before.

SPHDROP_LONG_TESTS=1 in the environment damages a hundred instead of ten. Of a thousand damaged files read by the library,
in tests/mpi/io/test_damaged_checkpoint.cpp, not one goes unnoticed.
"""

from __future__ import annotations

import random
import shutil
import unittest
from pathlib import Path

import h5py
from restart_test import RestartTest  # also finds the modules in tests/support
from running_program import AT_ONCE, DONE, LONG, MISTAKE, checkpoints, results, run, state_hash
from sphdrop_reader import _HEAD_BYTES, _digest, _seal_of, _xxh3_library

COUNT = 100 if LONG else 10


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


class RandomDamage(RestartTest):
    def test_are_refused_or_lead_to_the_same_end(self) -> None:
        sound = checkpoints(self.output)[-1].read_bytes()
        generator = random.Random(1)
        refused = 0
        for number in range(COUNT):
            how, content = damaged(sound, generator)
            with self.subTest(number=number, how=how):
                path = self.directory / "checkpoint_000000000001.h5"
                path.write_bytes(content)
                result = run("little.cfg", "--quiet", "--restart", path.name, "--output", "new", ranks=1 + number % 3,
                             directory=self.directory, options=AT_ONCE)
                if result.returncode == DONE:
                    self.assertEqual(state_hash(result), self.whole_hash)
                    continue
                refused += 1
                self.assertEqual(result.returncode, MISTAKE, result.stderr)
                self.assert_said_once(result, f"sphdrop: cannot go on: {path.name} ")
                self.assertEqual(path.read_bytes(), content)
        # Zeros over zeros are no damage.
        self.assertGreater(refused, 0.8 * COUNT)


class ChosenDamage(RestartTest):
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
            for choice in ("latest", "auto") if LONG else (("latest", "auto")[number % 2],):
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
                self.assert_refused("--restart", f"out/{newest.name}", saying=(f"cannot go on: out/{newest.name} ", word))

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
