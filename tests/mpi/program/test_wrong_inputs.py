"""What the program says of wrong inputs is what README.md beside this shows, and the kind of message it should be."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from wrong_inputs import DOUBTS, SECTIONS, SET_UP  # noqa: E402
from wrong_messages import PAGE, messages, table, table_in  # noqa: E402


class WrongInputs(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls) -> None:
        cls.all = messages()

    def test_the_page_is_current(self) -> None:
        self.assertEqual(table(self.all).splitlines(), table_in(PAGE.read_text(encoding="utf-8")).splitlines(),
                         "write it anew: cmake --build --preset release --target update_messages")

    def test_there_are_many(self) -> None:
        self.assertGreaterEqual(sum(len(wrongs) for _, wrongs in SECTIONS), 60)

    def test_each_is_answered_as_it_should_be(self) -> None:
        for _, rows in self.all:
            for wrong, code, said in rows:
                with self.subTest(wrong.what):
                    expected = (0,) if wrong in DOUBTS else (2, 3) if wrong in SET_UP else (2,)
                    self.assertIn(code, expected, said)
                    self.assertTrue(said, "nothing is said")
                    self.assertEqual(wrong in DOUBTS, "warning: " in said, said)
                    self.assertNotIn("/tmp", said)
                    self.assertLess(max(map(len, said.splitlines())), 500, "too long to be read")


if __name__ == "__main__":
    unittest.main()
