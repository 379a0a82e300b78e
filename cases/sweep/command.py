"""The command line of sphdrop-sweep."""

from __future__ import annotations

import argparse
import csv
import shutil
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from program import HELP as PROGRAM_HELP
from program import default_program
from sweep.table import SweepError, folder_of, grid, read_table, row_of, settings

EPILOG = """examples:
  sphdrop-sweep table 'solid.length=8 mm;12 mm' 'drop.velocity=[0,-0.5];[0,-1]' > table.csv
  sphdrop-sweep run table.csv cases/cantilever/case.cfg results/sweep --parallel 2
  jobs/sweep.sh table.csv cases/cantilever/case.cfg results/sweep --ntasks=4     the same as a Slurm job array

The table is CSV: its header names parameters, each row is a run (jobs/sweep_table.csv is one). What is finished is not run
again, what was stopped goes on from its checkpoint, and a run that fails is told and does not stop the others.
FOLDER/sweep.csv has a row for each run: contact time, largest width and deflection, restitution, We, theory; the figures
beside it draw them. The exit code is 0 if all runs are there, 1 if not, 2 if the command or the table makes no sense.
"""


def parser() -> argparse.ArgumentParser:
    made = argparse.ArgumentParser(prog="sphdrop-sweep", formatter_class=argparse.RawDescriptionHelpFormatter, epilog=EPILOG,
                                   description="Runs a table of parameters and makes one table of the results.")
    commands = made.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, text: str, *arguments: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=text, description=text)
        for argument in arguments:
            added.add_argument(argument.lower(), metavar=argument, type=str if argument == "NUMBER" else Path)
        return added

    run = command("run", "make the runs on this machine, then collect", "TABLE", "CASE", "FOLDER")
    run.add_argument("--parallel", type=int, default=1, help="runs at a time (default: 1)")
    run.add_argument("--ranks", type=int, default=1, help="MPI ranks of a run (default: 1)")
    run.add_argument("--program", type=Path, default=default_program(), help=PROGRAM_HELP)
    run.add_argument("--any-version", action="store_true", help="take finished runs of any version of the program")
    command("collect", "write FOLDER/sweep.csv and the figures of the runs that are there", "TABLE", "FOLDER")
    table = commands.add_parser("table", help="print the table of every combination of values",
                                description="print the table of every combination of values")
    table.add_argument("axes", nargs="+", metavar="PARAMETER=VALUE;VALUE;...")
    command("count", "print how many runs the table has", "TABLE")
    command("folder", "print the name of a run's folder; the first run is 0", "TABLE", "NUMBER")
    command("settings", "print a run's arguments of sphdrop, one a line", "TABLE", "NUMBER")
    return made


def collect_and_draw(table: Sequence[dict[str, str]], folder: Path) -> int:
    # Only here: what a job script asks of the table needs no numpy, h5py or matplotlib.
    import matplotlib

    matplotlib.use("Agg")
    from sweep.figures import draw_all
    from sweep.results import collect

    rows = collect(table, folder)
    for path in draw_all(table, rows, folder):
        print(path)
    return 0 if all(row["status"] == "completed" for row in rows) else 1


def run(options: argparse.Namespace) -> int:
    from sweep.local import make_runs

    if options.parallel < 1 or options.ranks < 1:
        raise SweepError("--parallel and --ranks must be at least 1")
    if not options.program.is_file():
        raise SweepError(f"there is no program {options.program}; build it (cmake --preset release, cmake --build --preset release) "
                         "or name it with --program")
    if options.ranks > 1 and shutil.which("mpirun") is None:
        raise SweepError("there is no mpirun; install Open MPI (jobs/install_packages.sh) or use --ranks 1")
    table = read_table(options.table)
    options.folder.mkdir(parents=True, exist_ok=True)
    failures = make_runs(table, options.case.resolve(), options.folder.resolve(), options.program, options.ranks, options.parallel,
                         options.any_version)
    return max(collect_and_draw(table, options.folder), 1 if failures else 0)


def answer(options: argparse.Namespace) -> int:
    if options.command == "table":
        rows = grid(options.axes)
        writer = csv.DictWriter(sys.stdout, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
        return 0
    if options.command == "run":
        return run(options)
    table = read_table(options.table)
    if options.command == "collect":
        return collect_and_draw(table, options.folder)
    if options.command == "count":
        print(len(table))
    else:
        number = row_of(table, options.number)
        print(folder_of(number) if options.command == "folder" else "\n".join(settings(table[number])))
    return 0


def interrupt(*_: object) -> None:
    raise KeyboardInterrupt


def main(arguments: Sequence[str] | None = None) -> int:
    options = parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, interrupt)
    try:
        return answer(options)
    except (SweepError, OSError, subprocess.CalledProcessError) as error:
        print(f"sphdrop-sweep: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\nstopped. The same command goes on with the rest.", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
