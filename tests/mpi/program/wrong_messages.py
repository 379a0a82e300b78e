"""What the program says of the wrong inputs, and the page that shows it: README.md beside this.

    SPHDROP_PROGRAM=... wrong_messages.py    writes the page anew
"""

from __future__ import annotations

import fcntl
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from wrong_inputs import GOOD, GOOD_DROP, SECTIONS, Wrong

PAGE = Path(__file__).resolve().parent / "README.md"
BEGIN, END = "<!-- messages: written by wrong_messages.py -->", "<!-- end of messages -->"
CASE = "impact.cfg"
# Of a checkpoint, which names the commit that wrote it.
PASSING = re.compile(r"\b[0-9a-f]{32}\b|\b\d+(?= of \d+ bytes)|(?<= of )\d+(?= bytes)")


def program(*words: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([os.environ["SPHDROP_PROGRAM"], *words], cwd=folder, capture_output=True, text=True, check=False, timeout=60)


class Folder:
    """Where the inputs lie. An unfinished run is made once and copied."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.template = folder / "template"
        (self.template / CASE).parent.mkdir()
        (self.template / CASE).write_text(GOOD, encoding="utf-8")
        made = program(CASE, "--output", "unfinished", "--max-walltime", "1", "--quiet", folder=self.template)
        if made.returncode != 5:
            raise AssertionError(f"no unfinished run could be made:\n{made.stderr}")

    @contextmanager
    def prepared(self, wrong: Wrong) -> Iterator[Path]:
        here = self.folder / "here"
        here.mkdir()
        text = GOOD if wrong.text is None else wrong.text
        if wrong.edit is not None:
            if wrong.edit[0] not in text:
                raise AssertionError(f"the good case has no {wrong.edit[0]!r}")
            text = text.replace(wrong.edit[0], wrong.edit[1], 1)
        (here / CASE).write_text(text, encoding="utf-8")
        if wrong.drop is not None:
            if wrong.drop[0] not in GOOD_DROP:
                raise AssertionError(f"the good drop has no {wrong.drop[0]!r}")
            (here / "drop.csv").write_text(GOOD_DROP.replace(*wrong.drop, 1), encoding="utf-8")
        lock = None
        if wrong.prepare == "folder":
            (here / "folder").mkdir()
        elif wrong.prepare == "file":
            (here / "notes.txt").write_text("Things to do\n" * 99, encoding="utf-8")
        elif wrong.prepare == "own case":
            (here / CASE).rename(here / "case.cfg")
        elif wrong.prepare == "busy":
            (here / "busy").mkdir()
            lock = open(here / "busy/run.lock", "w", encoding="utf-8")
            fcntl.flock(lock, fcntl.LOCK_EX)
        elif wrong.prepare:
            shutil.copytree(self.template / "unfinished", here / "unfinished")
            (checkpoint,) = (here / "unfinished").glob("checkpoint_*.h5")
            whole = bytearray(checkpoint.read_bytes())
            if wrong.prepare == "cut short":
                checkpoint.write_bytes(whole[: len(whole) // 2])
            elif wrong.prepare == "changed":
                whole[len(whole) // 2] ^= 1
                checkpoint.write_bytes(whole)
        try:
            yield here
        finally:
            if lock is not None:
                lock.close()
            shutil.rmtree(here)

    def said_of(self, wrong: Wrong) -> tuple[int, str]:
        """The exit code and what stands on standard error."""
        with self.prepared(wrong) as here:
            words = (CASE, *wrong.words) if wrong.line is None else wrong.line
            done = program(*words, "--quiet", folder=here)
        return done.returncode, PASSING.sub("...", done.stderr.strip().removeprefix("sphdrop: "))


def shown_input(wrong: Wrong) -> str:
    if wrong.drop is not None and wrong.drop[1] and not wrong.words:
        lines = wrong.drop[1].splitlines()
        return ", ".join(f"`{line}`" for line in lines[:3]) + (", ..." if len(lines) > 3 else "")
    if wrong.edit is not None:
        return f"`{wrong.edit[1].removeprefix(wrong.edit[0]).strip()}`".replace("\n", "`, `")
    if wrong.line is not None or wrong.words:
        return "`" + " ".join(f"'{word}'" if " " in word or not word else word for word in wrong.words or wrong.line or ()) + "`"
    return ""


def escaped(text: str) -> str:
    return "<br>".join(f"`{line.strip()}`" for line in text.replace("|", "\\|").replace("`", "'").splitlines())


def row(wrong: Wrong, said: str) -> str:
    given = shown_input(wrong)
    return f"| {wrong.what}{': ' + given if len(given) > 2 else ''} | {escaped(said)} |"


def messages() -> list[tuple[str, list[tuple[Wrong, int, str]]]]:
    with tempfile.TemporaryDirectory() as name:
        folder = Folder(Path(name))
        return [(title, [(wrong, *folder.said_of(wrong)) for wrong in wrongs]) for title, wrongs in SECTIONS]


def table(all_messages: list[tuple[str, list[tuple[Wrong, int, str]]]]) -> str:
    parts = []
    for title, rows in all_messages:
        lines = "\n".join(row(wrong, said) for wrong, _, said in rows)
        parts.append(f"### {title}\n\n| What | What the program says |\n|---|---|\n{lines}\n")
    return "\n".join(parts)


def table_in(page: str) -> str:
    found = re.search(f"{re.escape(BEGIN)}\n\n(.*?)\n{re.escape(END)}", page, flags=re.DOTALL)
    if found is None:
        raise AssertionError(f"{PAGE} has no place for the messages")
    return found[1]


if __name__ == "__main__":
    text = PAGE.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN)
    _, tail = rest.split(END)
    PAGE.write_text(f"{head}{BEGIN}\n\n{table(messages())}\n{END}{tail}", encoding="utf-8")
    sys.stdout.write(f"{PAGE} is written\n")
