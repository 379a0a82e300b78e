"""How much of a run's time its checkpoints take at the default interval, for the cantilever at the resolution of the paper.

usage: checkpoint_cost.py
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from running_program import ROOT, checkpoints, run, state_hash  # noqa: E402

STEPS, EVERY = 400, 10
STEP = 6e-9  # s, about
DEFAULT_INTERVAL = 600  # s, checkpoint.wall_interval
REPETITIONS = 3


def seconds_of_output(place: Path, ranks: int, interval: float) -> float:
    result = run(ROOT / "cases" / "cantilever" / "case.cfg", "--quiet", "--output", "out", "--fresh", "--until", STEPS * STEP,
                 "--set", f"checkpoint.interval={interval:g}", ranks=ranks, directory=place)
    state_hash(result)
    record = json.loads((place / "out" / "run.json").read_text(encoding="utf-8"))
    return float(record["details"]["seconds in output"])


def main() -> None:
    with tempfile.TemporaryDirectory(prefix="sphdrop-") as folder:
        place = Path(folder)
        print("| ranks | a checkpoint, bytes | a checkpoint, ms | share of the time |\n|---|---|---|---|")
        for ranks in (1, 2):
            # The one at the end is written in both.
            costs = sorted((seconds_of_output(place, ranks, EVERY * STEP) - seconds_of_output(place, ranks, 0))
                           / (STEPS / EVERY - 1) for _ in range(REPETITIONS))
            size = checkpoints(place / "out")[-1].stat().st_size
            print(f"| {ranks} | {size} | {1e3 * costs[0]:.0f} to {1e3 * costs[-1]:.0f} | "
                  f"{100 * costs[-1] / DEFAULT_INTERVAL:.4f} % |", flush=True)


if __name__ == "__main__":
    main()
