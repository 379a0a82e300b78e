"""Kills a run again and again - one rank, mpiexec, or a rank inside a write - and goes on each time with --restart auto,
on a random number of ranks, until the run is done; then the next run begins. After every kill all processes must be gone
in time, every snapshot in the index must open and no checkpoint may be lost; every finished run must have left the same
bytes as one that was never killed.

usage: kill_cycles.py [--cycles N] [--seed S]   200 with SPHDROP_LONG_TESTS=1 in the environment, 6 without, unless told
"""

from __future__ import annotations

import argparse
import json
import random
import shutil
import signal
import statistics
import sys
import tempfile
import time
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from background_run import BackgroundRun, rank_of, send  # noqa: E402
from running_program import (  # noqa: E402
    AT_ONCE,
    DONE,
    LONG,
    checkpoints,
    hashes_in,
    interrupted,
    little_case,
    results,
    run,
    state_hash,
    step_of,
)
from sphdrop_reader import Checkpoint, Run  # noqa: E402

LONGEST_END = 30.0  # s, from the kill until the last process is gone
CASE = little_case(checkpoint_interval=2e-6, snapshot_interval=3e-6)
# What rank 0 may be doing when it is killed: which call, on which files, about how often it comes in a run.
CALLS = (
    ("write", ".h5.part", 200), ("fsync", ".h5.part", 20), ("rename", ".h5.part", 20),
    ("write", ".vtkhdf.part", 100), ("fsync", ".vtkhdf.part", 13), ("rename", ".vtkhdf.part", 13),
    ("fsync", ".series.part", 13), ("rename", ".series.part", 13), ("write", "history.csv", 20),
    ("fsync", "history.csv", 20), ("rename", "run.json.part", 2), ("write", "case.cfg", 1), ("partition", "", 1),
)


class Failed(Exception):
    """What a killed run must not do."""


@dataclass
class Tally:
    seconds_until_gone: list[float] = field(default_factory=list)
    too_late: int = 0  # the run was done before

    def row(self, name: str) -> str:
        times = self.seconds_until_gone
        shown = f"{statistics.mean(times):8.2f} {max(times):8.2f}" if times else f"{'-':>8} {'-':>8}"
        return f"{name:30} {len(times):6} {shown} {self.too_late:9}"


class Cycles:
    def __init__(self, seed: int, place: Path) -> None:
        self.random = random.Random(seed)
        self.place = place
        self.tallies: dict[str, Tally] = defaultdict(Tally)
        self.runs = self.restarts = self.hung = 0
        self.reference = self.new_folder("reference")
        start = time.monotonic()
        whole = run("little.cfg", "--quiet", ranks=2, directory=self.reference)
        self.duration = time.monotonic() - start
        if whole.returncode != DONE:
            raise Failed(f"the run does not even work when left alone:\n{whole.stderr}")
        self.hash = state_hash(whole)
        self.expected = results(self.reference / "out")
        self.folder = self.new_folder("run")

    def new_folder(self, name: str) -> Path:
        folder = self.place / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        (folder / "little.cfg").write_text(CASE, encoding="utf-8")
        return folder

    @property
    def output(self) -> Path:
        return self.folder / "out"

    def newest_step(self) -> int:
        found = checkpoints(self.output)
        return step_of(found[-1]) if found else -1

    def cycle(self) -> None:
        ranks = self.random.randint(1, 3)
        kind = self.random.choice(("a rank", "mpiexec", "inside a call"))
        delay = self.random.uniform(0, self.duration)
        options = () if LONG else AT_ONCE
        if kind == "inside a call":
            call, file, most = self.random.choice(CALLS)
            kind = f"inside {call} {file}"
            options += interrupted(call, file, by=signal.SIGKILL, number=int(most * self.random.random() ** 2))
        before = self.newest_step()
        with BackgroundRun("little.cfg", "--quiet", "--restart", "auto", ranks=ranks, directory=self.folder,
                     options=options) as running:
            if kind.startswith("inside"):
                killed = self.wait_until_one_is_killed(running)
            else:
                killed = self.kill_after(delay, running, kind, ranks)
            seconds = running.seconds_until_gone(LONGEST_END)
            code, text, output = running.end(), running.text(1), running.text(0)
            self.hung += running.hung
        self.restarts += before >= 0
        self.check_what_is_left(before, text)
        if code == DONE:
            self.tallies[kind].too_late += 1
            self.check_finished(output)
            return
        if code not in (128 + signal.SIGKILL, -signal.SIGKILL):
            raise Failed(f"{'a kill' if killed else 'no kill'}, but the run ended with {code}:\n{text}")
        self.tallies[kind].seconds_until_gone.append(seconds)

    def kill_after(self, delay: float, running: BackgroundRun, kind: str, ranks: int) -> bool:
        limit = time.monotonic() + delay
        while time.monotonic() < limit:
            if running.process.poll() is not None:
                return False
            time.sleep(0.002)
        if kind == "mpiexec":
            send(running.process.pid, signal.SIGKILL)
            return True
        chosen = str(self.random.randrange(ranks))
        for pid in running.processes():
            if rank_of(pid) == chosen:
                send(pid, signal.SIGKILL)
                return True
        # It has not been started yet, or has ended.
        send(running.process.pid, signal.SIGKILL)
        return True

    def wait_until_one_is_killed(self, running: BackgroundRun) -> bool:
        """The clock starts when mpiexec tells of it, or a rank less is there than before."""
        most = 0
        limit = time.monotonic() + 60
        while running.process.poll() is None and time.monotonic() < limit:
            count = sum(rank_of(pid) != "" for pid in running.processes())
            if count < most:
                break
            most = count
            time.sleep(0.01)
        return True

    def check_what_is_left(self, before: int, text: str) -> None:
        if self.newest_step() < before:
            raise Failed(f"the newest checkpoint was of step {before} and is of step {self.newest_step()} now:\n{text}")
        if "passed over" in text:
            raise Failed(f"a checkpoint was not sound:\n{text}")
        for path in checkpoints(self.output):
            Checkpoint(path)  # verifies its checksums
        if (self.output / "snapshots.vtkhdf.series").exists():
            index = json.loads((self.output / "snapshots.vtkhdf.series").read_text(encoding="utf-8"))
            for entry in index["files"]:
                with h5py.File(self.output / entry["name"], "r") as file:
                    if file.attrs["time"] != entry["time"]:
                        raise Failed(f"{entry['name']} is of {file.attrs['time']} s, in the index of {entry['time']} s")

    def check_finished(self, output: str) -> None:
        if hashes_in(output) != [self.hash]:
            raise Failed(f"another state: {output!r} instead of {self.hash}")
        found = results(self.output)
        others = [name for name in sorted(set(found) | set(self.expected)) if found.get(name) != self.expected.get(name)]
        if others:
            raise Failed(f"other results than of a run that was never killed: {', '.join(others)}")
        if len(Run(self.output).snapshots) != len(Run(self.reference / "out").snapshots):
            raise Failed("other snapshots than of a run that was never killed")
        self.runs += 1
        self.folder = self.new_folder("run")

    def finish(self) -> None:
        """The last run, left alone."""
        last = run("little.cfg", "--quiet", "--restart", "auto", ranks=2, directory=self.folder)
        if last.returncode != DONE:
            raise Failed(f"going on ended with {last.returncode}:\n{last.stderr}")
        self.check_finished(last.stdout)

    def kills(self) -> int:
        return sum(len(tally.seconds_until_gone) for tally in self.tallies.values())

    def report(self) -> str:
        lines = [f"{'killed':30} {'times':>6} {'mean s':>8} {'max s':>8} {'too late':>9}"]
        lines += [self.tallies[name].row(name) for name in sorted(self.tallies)]
        lines.append(f"{self.kills()} kills, {self.restarts} restarts, {self.runs} runs finished with the same bytes; "
                     f"mpiexec hung in its own end {self.hung} times, no rank being left")
        return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cycles", type=int, default=200 if LONG else 6, help="kills, not counting those that come too late")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="sphdrop-") as place:
        cycles = Cycles(options.seed, Path(place))
        try:
            while cycles.kills() < options.cycles:
                cycles.cycle()
            cycles.finish()
        except (Failed, AssertionError, OSError) as error:
            print(f"FAILED after {cycles.kills()} kills, seed {options.seed}: {error}", file=sys.stderr)
            return 1
        finally:
            print(cycles.report(), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
