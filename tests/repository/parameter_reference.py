"""The parameter reference in cases/README.md, which the program's own table writes.

    python3 parameter_reference.py PRINT_PARAMETER_REFERENCE     writes it anew
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from repository import ROOT

PAGE = ROOT / "cases" / "README.md"
BEGIN = "<!-- parameters: written by the target update_parameter_reference -->\n"
END = "<!-- end of parameters -->\n"


def reference_of_program(printer: str | Path) -> str:
    return subprocess.run([str(printer)], capture_output=True, text=True, check=True).stdout


def parts_of(page: str) -> tuple[str, str, str]:
    """Before, reference, after; the marks go with before and after. Raises ValueError where they are missing."""
    for mark in (BEGIN, END):
        if page.count(mark) != 1:
            raise ValueError(f"{PAGE.relative_to(ROOT)} needs exactly one line {mark.strip()!r}")
    before, rest = page.split(BEGIN)
    reference, after = rest.split(END)
    return before + BEGIN, reference, END + after


def main() -> None:
    before, _, after = parts_of(PAGE.read_text(encoding="utf-8"))
    PAGE.write_text(f"{before}\n{reference_of_program(sys.argv[1])}\n{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
