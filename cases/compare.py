#!/usr/bin/python3
"""Runs the cases, compares them with theory and paper, and writes one report.

    /usr/bin/python3 cases/compare.py                              everything at the paper's resolution: many hours
    /usr/bin/python3 cases/compare.py --level quick                coarser: a first look
    /usr/bin/python3 cases/compare.py rigid_wall cantilever/L8_U0.8 'free_vibration/rows*'

What is finished is not run again and what was stopped goes on from its checkpoint, so it can be interrupted at any time. The report is in
RESULTS/LEVEL/report: report.html by itself, report.md with its pictures, table.md. The exit code is 0 if all runs are there
and every recorded value is met, 1 if not, 2 if the command makes no sense.
"""

from __future__ import annotations

import argparse
import contextlib
import difflib
import fcntl
import fnmatch
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

CASES = Path(__file__).resolve().parent
sys.path.insert(0, str(CASES))

try:
    from comparison.cost import in_words, particle_steps, rate_of
    from comparison.model import Comparison
    from comparison.progress import Progress
    from comparison.report import update_page, write_report
    from comparison.runner import Job, Runner, commit_of, is_finished, jobs_of, read_json
    from comparison.study import LEVELS, Study, StudyError, all_studies
    from comparison.tables import counts_line, number
except ModuleNotFoundError as missing:
    if missing.name not in ("numpy", "matplotlib", "h5py"):
        raise
    sys.exit(f"error: this Python has no {missing.name}; numpy, matplotlib and h5py are Debian's: /usr/bin/python3 cases/compare.py")

from program import HELP as PROGRAM_HELP  # noqa: E402
from program import default_program  # noqa: E402

ROOT = CASES.parent


class UsageError(Exception):
    """A command that makes no sense; the text says what would."""


def options() -> argparse.ArgumentParser:
    description, _, explanation = (__doc__ or "").partition("\n")
    parser = argparse.ArgumentParser(description=description, epilog=explanation,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="STUDY[/RUN]", help="only these; * and ? stand for other letters (default: all)")
    parser.add_argument("--level", choices=LEVELS, default=LEVELS[0], help="resolution (default: paper)")
    parser.add_argument("--ranks", type=int, default=2, help="MPI ranks of a run (default: 2)")
    parser.add_argument("--parallel", type=int, default=1, help="runs at a time (default: 1)")
    parser.add_argument("--program", type=Path, default=default_program(), help=PROGRAM_HELP)
    parser.add_argument("--results", type=Path, default=ROOT / "results/comparison", help="default: results/comparison")
    parser.add_argument("--report", type=Path, metavar="DIR",
                        help="folder of the report (default: RESULTS/LEVEL/report, or report_STUDY_... for named studies)")
    parser.add_argument("--cases", type=Path, default=CASES, help="folder of the studies (default: that of this script)")
    parser.add_argument("--list", action="store_true", help="only say what there is to run, what of it is there, and how long it takes")
    parser.add_argument("--report-only", action="store_true", help="run nothing; tell of the finished runs")
    parser.add_argument("--any-version", action="store_true", help="take finished runs of any version of the program")
    parser.add_argument("--keep-going", action="store_true", default=True, help="go on after a failed run (always so)")
    parser.add_argument("--update-comparison", action="store_true", help="put the table into COMPARISON.md in the folder of the studies")
    return parser


def chosen_jobs(studies: Sequence[Study], level: str, results: Path, names: Sequence[str]) -> list[Job]:
    """The runs that the names mean, in the order of the studies. Raises UsageError for a name that means none."""
    jobs = jobs_of(studies, level, results)
    wanted: set[str] = set()
    for name in names:
        pattern = name.rstrip("/") if "/" in name.rstrip("/") else name.rstrip("/") + "/*"
        found = {job.title for job in jobs if fnmatch.fnmatchcase(job.title, pattern)}
        if not found:
            known = [study.name for study in studies] + [job.title for job in jobs]
            if any(study.name == name for study in studies):
                raise UsageError(f"{name} has no runs at level {level}")
            near = difflib.get_close_matches(name, known, 3, 0.5)
            hint = f"did you mean {' or '.join(near)}?" if near else f"there are {', '.join(study.name for study in studies)}"
            raise UsageError(f"there is no {name} at level {level}; {hint}")
        wanted |= found
    return [job for job in jobs if not names or job.title in wanted]


def program_commit(program: Path, any_version: bool) -> str | None:
    """The commit of which finished runs are taken; None for any. Raises UsageError if the program does not run."""
    if not program.is_file():
        raise UsageError(f"there is no program {program}; build it (cmake --preset release, cmake --build --preset release) or name it "
                         "with --program")
    try:
        commit = commit_of(program)
    except (OSError, subprocess.CalledProcessError) as error:
        raise UsageError(f"{program} does not run: {error}") from error
    return None if any_version else commit


@contextlib.contextmanager
def alone(folder: Path) -> Iterator[None]:
    """While this holds, no other comparison runs into the folder: it would wipe out what this one writes."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / ".lock").open("w", encoding="utf-8") as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise UsageError(f"another comparison is running into {folder}; wait for it, use --report-only, or another folder "
                             "with --results") from None
        yield


def make_runs(jobs: Sequence[Job], chosen: argparse.Namespace) -> list[str]:
    """Makes what is missing; the titles of what failed."""
    commit = program_commit(chosen.program, chosen.any_version)
    if chosen.ranks > 1 and shutil.which("mpirun") is None:
        raise UsageError("there is no mpirun; install Open MPI (jobs/install_packages.sh) or use --ranks 1")
    missing = [job for job in jobs if not is_finished(job, commit)]
    older = sum(is_finished(job, None) for job in missing)
    rate = rate_of((read_json(job.results / "run.json") for job in jobs), chosen.ranks)
    with Progress(missing, rate, chosen.parallel, sys.stdout) as progress:
        text = f"{len(jobs)} runs at level {chosen.level}, {len(jobs) - len(missing)} there already"
        if missing:
            text += (f"; {len(missing)} to make on {chosen.ranks} {'rank' if chosen.ranks == 1 else 'ranks'}, "
                     f"about {in_words(progress.seconds_left())}")
        print(text, flush=True)
        if older:
            print(f"{older} of them are there from another version of the program; --any-version would take them", flush=True)
        runner = Runner(chosen.program, chosen.ranks, chosen.parallel, commit, watch=progress)
        outcomes = runner.run(missing)
    return [outcome.job.title for outcome in outcomes if outcome.error]


def list_jobs(jobs: Sequence[Job], chosen: argparse.Namespace) -> None:
    """A line for each run: whether it is there, and about how long it takes."""
    rate = rate_of((read_json(job.results / "run.json") for job in jobs), chosen.ranks)
    width = max((len(job.title) for job in jobs), default=0)
    total = 0.0
    for job in jobs:
        seconds = particle_steps(job.study.parameters(job.variant)) * rate
        is_there = is_finished(job, None)
        total += 0.0 if is_there else seconds
        state = f"there, of {read_json(job.results / 'run.json').get('git_commit', '')[:8]}" if is_there else f"about {in_words(seconds)}"
        print(f"{job.title:{width}}  {state}")
    print(f"{len(jobs)} runs at level {chosen.level}; what is missing takes about {in_words(total)} on {chosen.ranks} ranks")


def tell(comparison: Comparison, folder: Path) -> None:
    """The outcome on the terminal."""
    for study in comparison.studies:
        for problem in study.problems:
            print(f"problem: {study.study.name}: {problem}")
        for row in study.rows:
            e = row.expected
            for check, mode, measured, recorded, tolerance in (
                    (row.check, "", row.measured, e.ours, e.tolerance),
                    (row.modern_check, " in mode modern", row.modern, e.modern, e.modern_tolerance)):
                if check in ("fail", "missing"):
                    value = f"{number(measured, 6)} {e.unit}, recorded {number(recorded, 6)} ± {number(tolerance, 2)}"
                    print(f"{check.upper()}: {study.study.name}: {e.quantity}{mode}" + (f" = {value}" if check == "fail" else ""))
    print(counts_line(comparison))
    print(f"report: {folder / 'report.html'}")


def compare(chosen: argparse.Namespace, command: str) -> int:
    if chosen.ranks < 1 or chosen.parallel < 1:
        raise UsageError("--ranks and --parallel must be at least 1")
    if chosen.update_comparison and chosen.names:
        raise UsageError("--update-comparison takes the table of all studies: name none")
    studies = all_studies(chosen.cases.resolve())
    if not studies:
        raise UsageError(f"there are no studies in {chosen.cases}: no folder with a runs.toml")
    results = chosen.results.resolve()
    jobs = chosen_jobs(studies, chosen.level, results, chosen.names)
    if chosen.list:
        list_jobs(jobs, chosen)
        return 0
    failed: list[str] = []
    if not chosen.report_only:
        with alone(results / chosen.level):
            failed = make_runs(jobs, chosen)
    named = [study for study in studies if any(job.study is study for job in jobs)]
    default = "_".join(["report", *(study.name for study in named)]) if chosen.names else "report"
    folder = (chosen.report or results / chosen.level / default).resolve()
    print("measuring and drawing", flush=True)
    comparison = write_report(named, chosen.level, results, folder, command)
    if chosen.update_comparison:
        page = chosen.cases / "COMPARISON.md"
        try:
            update_page(page, comparison)
        except ValueError as error:
            raise UsageError(f"{page} {error}") from error
    tell(comparison, folder)
    absent = [job.title for job in jobs if not is_finished(job, None)]
    if absent:
        print(f"{len(absent)} runs are not there: {', '.join(absent[:10])}" + (", ..." if len(absent) > 10 else ""))
    return 0 if comparison.passes and not failed and not absent else 1


def interrupt(*_: object) -> None:
    raise KeyboardInterrupt


def main(arguments: Sequence[str] | None = None) -> int:
    words = list(sys.argv[1:] if arguments is None else arguments)
    chosen = options().parse_args(words)
    signal.signal(signal.SIGTERM, interrupt)
    try:
        return compare(chosen, shlex.join(["cases/compare.py", *words]))
    except (UsageError, StudyError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\nstopped. Finished runs stay; the same command goes on with the rest, --report-only tells of what is there.",
              file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
