#!/usr/bin/python3
"""Writes the manual page of the program out of its own --help, --list-parameters and --version.

    python3 manual_page.py PROGRAM PAGE
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

EXIT_CODES = (
    (0, "The run came to its end, or what was asked for was printed."),
    (1, "An internal error."),
    (2, "A mistake in the command line, the case or a file; the message says which, and what is allowed."),
    (3, "The state could not be computed on (not a number, too fast, lost, turned inside out)."),
    (4, "Results could not be written."),
    (5, "Stopped in good order by a signal or a wall time limit; go on with --restart latest."),
)


def told(program: str, argument: str) -> str:
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return subprocess.run([program, argument], capture_output=True, text=True, check=True, env=environment).stdout


def roff(text: str) -> str:
    """Text that troff takes as it is."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line.startswith((".", "'")) else line for line in escaped.splitlines())


def options_of(help_text: str) -> list[tuple[str, str]]:
    """Option and explanation, from lines like "  --set key=value   use this value", explanations going on below."""
    found: list[tuple[str, str]] = []
    for line in help_text.partition("Options:")[2].splitlines():
        begin = re.match(r"^  (-\S.*?)(?:\s{2,}(\S.*))?$", line)
        if begin:
            found.append((begin[1].strip(), begin[2] or ""))
        elif found and line.strip():
            found[-1] = (found[-1][0], f"{found[-1][1]} {line.strip()}".strip())
    return found


def parameters_of(listing: str) -> list[tuple[str, str, str]]:
    """Key, what it takes and description of every parameter; what belongs to a key is indented below it, by 4 where a line
    begins and by 8 where it goes on."""
    found = []
    for entry in re.split(r"\n(?=\S)", listing.strip())[1:]:
        head, description, allowed, default = re.sub(r"\n {8}", " ", entry).split("\n")
        key, takes = head.split(maxsplit=1)
        found.append((key, f"{takes}; {allowed.strip()}; {default.strip()}", description.strip()))
    return found


def page(program: str) -> str:
    version = told(program, "--version").split()[1].rstrip(",")
    parts = [f'.TH SPHDROP 1 "" "sphdrop {version}" "User Commands"',
             ".SH NAME\nsphdrop \\- droplet impact on elastic beams by smoothed particle hydrodynamics",
             ".SH SYNOPSIS\n.B sphdrop\n.RI [ options ] \" case.cfg\"\n.br\n.B mpirun \\-n\n.I ranks\n.B sphdrop\n.RI [ options ] \" case.cfg\"",
             ".SH DESCRIPTION\nReads a case (TOML), simulates it, and writes history.csv, snapshots for ParaView, checkpoints and run.json "
             "into the folder of the results. Results have the same bits on any number of ranks and after any restart.",
             ".SH OPTIONS"]
    parts += [f".TP\n.B {roff(option)}\n{roff(text)}" for option, text in options_of(told(program, "--help"))]
    parts.append(".SH CASE FILE\nPlain numbers are in SI units; a value with a unit stands in quotes, as in\n.BR \"diameter = \\[dq]1 mm\\[dq]\" .")
    for key, takes, text in parameters_of(told(program, "--list-parameters")):
        parts.append(f".TP\n.B {roff(key)}\n{roff(takes)}.\n{roff(text)}.")
    parts.append(".SH EXIT STATUS")
    parts += [f".TP\n.B {code}\n{roff(text)}" for code, text in EXIT_CODES]
    parts.append(".SH ENVIRONMENT\n.TP\n.B SPHDROP_ARCH\nWhere the program is installed for several instruction sets, it takes the "
                 "processor's best of them; this names another, as\n.BR x86\\-64\\-v3 .\nThe results have the same bits with each.")
    parts.append(".SH SIGNALS\nSIGTERM, SIGINT, SIGUSR1 and SIGUSR2 finish the step, write a checkpoint and end the run with exit status 5.")
    parts.append(".SH SEE ALSO\n.BR mpirun (1)\n.PP\nX. Dong, X. Huang, J. Liu, European Journal of Mechanics A/Solids 75 (2019) 237\\-257.")
    return "\n".join(parts) + "\n"


def main(arguments: list[str]) -> int:
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    Path(arguments[1]).write_text(page(arguments[0]), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
