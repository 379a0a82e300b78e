"""A state that is not sound stops the run, and earlier checkpoints stay: going on from one stops at the same place."""

from __future__ import annotations

import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from running_program import AT_ONCE, UNSAFE, ProgramTest, checkpoints, results, step_of  # noqa: E402


class UnsafeStates(ProgramTest):
    def assert_stops_again(self, *settings: str, saying: str) -> None:
        words = [word for setting in settings for word in ("--set", setting)]
        stopped = self.run_here(*words, "--set", "checkpoint.interval=1e-6", ranks=1, code=UNSAFE, options=AT_ONCE)
        self.assert_said_once(stopped, saying)
        message = r"^sphdrop: step (\d+), .*\nLast good snapshot: out/snapshot_\d+.vtkhdf$"
        found = re.search(message, stopped.stderr, flags=re.MULTILINE)
        assert found is not None, stopped.stderr
        left = results(self.output)
        steps = [step_of(path) for path in checkpoints(self.output)]
        self.assertEqual(len(steps), 2)
        self.assertLess(steps[-1], int(found[1]))
        for ranks, start in ((3, "latest"), (2, f"out/{checkpoints(self.output)[0].name}")):
            again = self.run_here("--restart", start, *words, "--set", "checkpoint.interval=1e-6", ranks=ranks, code=UNSAFE,
                                  options=AT_ONCE)
            self.assert_said_once(again, found[0])
            self.assert_same_results(results(self.output), left)

    def test_a_particle_too_fast(self) -> None:
        self.assert_stops_again("safety.speed_limit=4.5", saying="a particle is faster than safety.speed_limit")

    def test_a_particle_too_deep_in_the_beam(self) -> None:
        self.assert_stops_again("contact.overlap_limit=0.005", saying="more than contact.overlap_limit = 0.005")

    def test_a_beam_that_bursts_because_the_step_is_too_long(self) -> None:
        self.assert_stops_again("safety.speed_limit=1e6", "safety.domain_margin=1000", "time.step=1.2e-7",
                                "drop.shape='none'", "drop.velocity=[0, 0]", "solid.initial_tip_velocity=10",
                                saying="a particle is faster than safety.speed_limit")


if __name__ == "__main__":
    unittest.main()
