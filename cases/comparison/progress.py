"""Tells how the runs go on: a line when one begins and ends and, on a terminal, one that lives in between."""

from __future__ import annotations

import shutil
import threading
import time
from collections.abc import Sequence
from typing import TextIO

from comparison.cost import in_words, particle_steps, reached_time
from comparison.runner import Job, Outcome

INTERVAL = 1.0  # s between two live lines


class Progress:
    """A Watcher for the runs that are to be made. Use it as a context: it ends its thread."""

    def __init__(self, jobs: Sequence[Job], rate: float, parallel: int, stream: TextIO) -> None:
        """`rate`: wall time in s for a particle and a step, until runs have shown it."""
        self._stream, self._is_live, self._parallel = stream, stream.isatty(), parallel
        self._total, self._done = len(jobs), 0
        self._cases = {job.title: job.study.parameters(job.variant) for job in jobs}
        self._work = {title: particle_steps(case) for title, case in self._cases.items()}
        self._waiting = dict(self._work)
        self._running: dict[str, tuple[Job, float]] = {}
        self._made_work = self._made_seconds = 0.0
        self._usual_rate = rate
        self._end = threading.Event()
        self._lock = threading.Lock()
        self._thread = threading.Thread(target=self._live, daemon=True)

    def __enter__(self) -> Progress:
        if self._is_live:
            self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._end.set()
        if self._is_live:
            self._thread.join()
            self._stream.write("\r\033[K")
            self._stream.flush()

    def seconds_left(self) -> float:
        """An estimate, in s, from the rate of the runs made so far or of earlier ones."""
        rate = self._made_seconds / self._made_work if self._made_work > 0 else self._usual_rate
        left = sum(self._waiting.values()) + sum(
            self._work[title] * (1 - self._share(job)) for title, (job, _) in self._running.items())
        return left * rate / self._parallel

    def started(self, job: Job) -> None:
        with self._lock:
            del self._waiting[job.title]
            self._running[job.title] = (job, time.monotonic())
            self._line(f"[{self._done}/{self._total}] {job.title}: runs")

    def ended(self, outcome: Outcome) -> None:
        title = outcome.job.title
        with self._lock:
            self._done += 1
            self._waiting.pop(title, None)
            self._running.pop(title, None)
            if outcome.was_there:
                return
            if not outcome.error:
                self._made_work += self._work[title]
                self._made_seconds += outcome.seconds
            left = self._total - self._done
            text = f"FAILED: {outcome.error}" if outcome.error else f"done in {in_words(outcome.seconds)}"
            rest = f"; {left} left, about {in_words(self.seconds_left())}" if left else ""
            self._line(f"[{self._done}/{self._total}] {title}: {text}{rest}")

    def _share(self, job: Job) -> float:
        return min(1.0, reached_time(job.results / "history.csv") / self._cases[job.title]["time"]["end"])

    def _line(self, text: str) -> None:
        self._stream.write(("\r\033[K" if self._is_live else "") + text + "\n")
        self._stream.flush()

    def live_text(self) -> str:
        """What the runs at work have reached."""
        parts = []
        for title, (job, start) in self._running.items():
            end = self._cases[title]["time"]["end"]
            share = self._share(job)
            parts.append(f"{title}: {1e3 * share * end:.3g} of {1e3 * end:.3g} ms ({100 * share:.0f} %) "
                         f"in {in_words(time.monotonic() - start)}")
        return f"[{self._done}/{self._total}] " + ", ".join(parts) + f"; all in about {in_words(self.seconds_left())}"

    def _live(self) -> None:
        while not self._end.wait(INTERVAL):
            with self._lock:
                if self._running:
                    width = shutil.get_terminal_size().columns - 1
                    self._stream.write("\r\033[K" + self.live_text()[:width])
                    self._stream.flush()

