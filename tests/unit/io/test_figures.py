"""The figures: drawn for runs with everything and for runs that lack something, and showing what they are to show."""

from __future__ import annotations

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
import figure_history
import figure_particles
import figures
import matplotlib.pyplot as plt
import synthetic_run
from matplotlib.collections import EllipseCollection
from sphdrop_reader import Run


class Figures(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(plt.close, "all")
        self.directory = Path(folder.name) / "run"
        self.enterContext(mock.patch.dict(figures.STYLE, {"savefig.dpi": 60}))  # Quicker.

    def draw(self, *options: str) -> list[str]:
        """Runs the program; returns the names of the files it says it wrote, each of which must hold a picture."""
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            self.assertEqual(figures.main([str(self.directory), *options]), 0)
        paths = [Path(line) for line in output.getvalue().splitlines()]
        for path in paths:
            picture = plt.imread(path)
            self.assertGreater(min(picture.shape[:2]), 80, path)
            self.assertGreater(len(np.unique(picture[..., :3].reshape(-1, 3), axis=0)), 50, f"{path} is empty")
        return [path.name for path in paths]

    def test_everything(self) -> None:
        synthetic_run.write_run(self.directory)
        self.assertEqual(self.draw("--frames", "4"), ["history.png", "strip.png", "picture.png"])
        elsewhere = self.directory / "a" / "b"
        self.assertEqual(len(self.draw("--output", str(elsewhere), "--times", "1.5", "--stress", "von_mises")), 3)
        self.assertTrue((elsewhere / "strip.png").exists())

    def test_what_is_missing_is_left_out(self) -> None:
        cases = {"no beam": {"parts": ["drop"]}, "no drop": {"parts": ["beam"]},
                 "few columns": {"leave_out": ["mass", "velocity", "stress_xx", "stress_xy", "is_fixed", "deflection"]},
                 "no material": {"leave_out": ["material"]}}
        for name, lacking in cases.items():
            with self.subTest(name):
                self.directory = self.directory.parent / name
                synthetic_run.write_run(self.directory, snapshots=2, **lacking)
                self.assertEqual(self.draw(), ["history.png", "strip.png", "picture.png"])

    def test_runs_of_one_kind_of_file(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=1, with_history=False)
        self.assertEqual(self.draw(), ["strip.png", "picture.png"])
        self.directory = self.directory.parent / "history only"
        synthetic_run.write_run(self.directory, snapshots=0)
        self.assertEqual(self.draw(), ["history.png"])

    def test_no_results_is_an_error_without_a_traceback(self) -> None:
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            self.assertEqual(figures.main([str(self.directory)]), 1)
        self.assertIn("is not a directory", errors.getvalue())

    def test_frames_are_evenly_spaced_or_nearest_to_the_times(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=13)
        snapshots = Run(self.directory).snapshots
        steps = [snapshot.step // 1000 for snapshot in figure_particles.choose_frames(snapshots, 4, None)]
        self.assertEqual(steps, [0, 4, 8, 12])
        self.assertEqual(len(figure_particles.choose_frames(snapshots, 50, None)), 13)
        chosen = figure_particles.choose_frames(snapshots, 4, [1.01e-3, 0.99e-3, 9.0])
        self.assertEqual([snapshot.step // 1000 for snapshot in chosen], [4, 12])

    def test_particles_are_drawn_where_they_are_and_at_their_size(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=3)
        snapshot = Run(self.directory).snapshots[1]
        liquid, solid = figure_particles.colourings([snapshot], "xx")
        _, axes = plt.subplots()
        figure_particles.draw_particles(axes, snapshot, liquid, solid)
        beam, clamp, drop = (c for c in axes.collections if isinstance(c, EllipseCollection))
        self.assertEqual(axes.get_aspect(), 1.0)
        np.testing.assert_allclose(drop.get_offsets(), snapshot["position"][snapshot.fluid] * 1e3)
        self.assertEqual(len(clamp.get_offsets()), np.count_nonzero(snapshot["is_fixed"]))
        self.assertEqual(len(beam.get_offsets()) + len(clamp.get_offsets()), np.count_nonzero(snapshot.solid))
        areas = np.pi / 4 * figure_particles.diameters(snapshot) ** 2
        np.testing.assert_allclose(areas, (synthetic_run.SPACING * 1e3) ** 2)
        np.testing.assert_allclose(drop.get_array(), np.linalg.norm(snapshot["velocity"][snapshot.fluid], axis=1))
        moving = snapshot.solid & (snapshot["is_fixed"] == 0)
        np.testing.assert_allclose(beam.get_array(), snapshot["stress_xx"][moving] / 1e6)

    def test_colour_scales_hold_for_all_frames(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=5)
        snapshots = list(Run(self.directory).snapshots)
        liquid, solid = figure_particles.colourings(snapshots, "xx")
        fastest = max(np.percentile(figure_particles.speed(s)[s.fluid], 99.5) for s in snapshots)
        self.assertTrue(fastest <= liquid.scale.vmax <= 1.1 * fastest)
        self.assertEqual(solid.scale.vmin, -solid.scale.vmax)

    def test_von_mises_stress(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=3)
        snapshot = Run(self.directory).snapshots[1]
        xx, yy, xy = (snapshot[f"stress_{ab}"] for ab in ("xx", "yy", "xy"))
        first, second = (xx + yy) / 2 + np.hypot((xx - yy) / 2, xy), (xx + yy) / 2 - np.hypot((xx - yy) / 2, xy)
        expected = np.sqrt(first**2 - first * second + second**2) / 1e6  # From the principal stresses.
        np.testing.assert_allclose(figure_particles.von_mises(snapshot), expected, atol=1e-12)

    def test_the_picture_is_of_the_widest_drop(self) -> None:
        synthetic_run.write_run(self.directory, snapshots=5)
        snapshots = list(Run(self.directory).snapshots)
        self.assertEqual(figure_particles.most_spread(snapshots).step, 2000)

    def test_legends_of_all_curves_leave_the_axes_wide(self) -> None:
        times = np.linspace(0.0, 1e-3, 20)
        history = {"time": times} | {name: times + 1e-3 for panel in figure_history.PANELS for name in panel.curves}
        with plt.rc_context(figures.STYLE):
            drawn = figure_history.draw_history(history)  # type: ignore[arg-type]
            drawn.draw_without_rendering()
        for axes in drawn.axes:
            self.assertGreater(axes.get_position().width, 0.35)
            if (legend := axes.get_legend()) is not None:
                self.assertLess(legend.get_window_extent().x1, drawn.bbox.x1)


if __name__ == "__main__":
    unittest.main()
