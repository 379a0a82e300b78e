"""Looking at a run while it goes on: a line a refresh, and figures that are drawn anew."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from figure_history import draw_history
from sphdrop_reader import History, ResultError, Run

def complete_rows(path: Path) -> str:
    """The history without a last line that is still being written."""
    text = path.read_text(encoding="utf-8")
    return text[: text.rfind("\n") + 1]


def status_line(history: History) -> str:
    """Time, and the last value of what people watch."""
    parts = [f"t = {history['time'][-1] * 1e3:.4g} ms", f"step {history['step'][-1]:.0f}" if "step" in history else ""]
    for name, label in (("drop_width", "D"), ("deflection", "deflection")):
        if name in history and np.isfinite(history[name][-1]):
            parts.append(f"{label} = {history[name][-1] * 1e3:.4g} mm")
    if "total" in history:
        parts.append(f"energy {history['total'][-1] * 1e3:.5g} mJ/m")
    return ", ".join(part for part in parts if part)


def status_of(directory: Path) -> str:
    """As run.json has it; "running" until it is there."""
    try:
        return str(Run(directory).info.get("status", "running"))
    except ResultError:
        return "running"


def write_aside(path: Path, write: Callable[[Path], None]) -> None:
    """Replaces the file at once, so that a viewer never sees half of it."""
    part = path.with_name(f".{path.name}.part{path.suffix}")
    write(part)
    part.replace(path)


def follow(directory: Path, output: Path, interval: float, sleep: Callable[[float], None] = time.sleep) -> int:
    """Until the run ends: prints a line and draws history.png anew whenever rows have come; returns the refreshes done."""
    refreshes, seen = 0, -1
    output.mkdir(parents=True, exist_ok=True)
    while True:
        status = status_of(directory)  # before the rows, so that the last rows of a run that ends are seen
        path = directory / "history.csv"
        text = complete_rows(path) if path.exists() else ""
        rows = text.count("\n")
        if rows > 2 and rows != seen:
            seen = rows
            history = History.of_text(path, text)
            print(status_line(history), flush=True)
            if (figure := draw_history(history)) is not None:
                write_aside(output / "history.png", figure.savefig)
                plt.close(figure)
            refreshes += 1
        if status != "running":
            print(f"the run has ended: {status}", file=sys.stderr)
            return refreshes
        sleep(interval)
