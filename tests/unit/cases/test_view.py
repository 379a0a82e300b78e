"""sphdrop-view: what it makes of one run, of several, of runs that lack something, and of one that goes on."""

from __future__ import annotations

import contextlib
import io
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parents[3]
for folder in (ROOT / "cases", ROOT / "tests" / "unit" / "io"):
    sys.path.insert(0, str(folder))
import synthetic_run  # noqa: E402
from view import animation, command, curves, facts, follow, frames  # noqa: E402
from sphdrop_reader import History, Run  # noqa: E402

CASE = """name = "synthetic"
[resolution]
spacing = 5e-5
[fluid]
density = 1000
viscosity = 0.001
[drop]
shape = "round"
diameter = 1e-3
velocity = [0.6, -0.8]
[surface_tension]
coefficient = 0.072
[solid]
kind = "cantilever"
length = 6e-3
thickness = 2.5e-4
youngs_modulus = 3e8
"""


class View(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.enterContext(mock.patch.object(command, "FILM_RESOLUTION", 40))  # Quicker.
        self.enterContext(mock.patch.dict(command.STYLE, {"savefig.dpi": 50}))

    def run_of(self, name: str, **lacking: object) -> Path:
        directory = self.folder / name
        synthetic_run.write_run(directory, snapshots=4, **lacking)
        (directory / "case.cfg").write_text(CASE)
        return directory

    def view(self, *arguments: object, expected: int = 0) -> tuple[str, str]:
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            self.assertEqual(command.main([str(argument) for argument in arguments]), expected, errors.getvalue())
        return output.getvalue(), errors.getvalue()

    def data_of(self, page: Path) -> dict:
        return json.loads(re.search(r'id="data">(.*?)</script>', page.read_text(), re.DOTALL)[1].replace("<\\/", "</"))

    def test_one_run(self) -> None:
        run = self.run_of("one")
        output, _ = self.view(run, "--format", "gif")
        for name in ("history.png", "strip.png", "picture.png", "animation.gif", "report.html"):
            self.assertIn(f"{run / name}\n", output)
        film = Image.open(run / "animation.gif")
        self.assertEqual((film.n_frames, film.info["duration"]), (4, 80))  # GIF counts in hundredths of a second
        self.assertNotEqual(film.tobytes(), (film.seek(2), film.tobytes())[1])
        data = self.data_of(run / "report.html")
        history = Run(run).history
        np.testing.assert_allclose(data["times"][0], history["time"] * 1e3, rtol=1e-5)
        panels = {panel["label"]: panel["curves"] for panel in data["panels"]}
        np.testing.assert_allclose(panels["deflection (mm)"][0]["values"], history["deflection"] * 1e3, rtol=1e-5)
        np.testing.assert_allclose(panels["drop width D/D₀"][0]["values"], history["drop_width"] / 1e-3, rtol=1e-5)
        self.assertEqual([curve["legend"] for curve in panels["contact force (N/m)"]], ["y", "x"])
        np.testing.assert_allclose(data["frame_times"], Run(run).snapshots.times * 1e3)
        text = (run / "report.html").read_text()
        self.assertEqual(text.count("data:image/jpeg;base64"), 4)
        self.assertIn("youngs_modulus = 3e8", text)
        self.assertIsNone(re.search(r'(?:src|href)="(?!data:|#)', text), "the page needs a file beside it")
        self.assertIn("D_max/D at the start: 1.8", output)

    def test_several_runs(self) -> None:
        first, second = self.run_of("first"), self.run_of("second", parts=["drop"])
        output, _ = self.view(first, second, "--output", self.folder / "both", "--format", "gif")
        self.assertEqual([Path(line).name for line in output.splitlines()], ["histories.png", "strips.png", "animation.gif", "report.html"])
        data = self.data_of(self.folder / "both" / "report.html")
        # The runs have one name: their folders tell them apart.
        self.assertEqual([(curve["legend"], curve["run"]) for curve in data["panels"][0]["curves"]], [("first", 0), ("second", 1)])
        self.assertIn("<th>first</th><th>second</th>", (self.folder / "both" / "report.html").read_text())

    def test_what_is_missing_is_left_out(self) -> None:
        without_history = self.run_of("snapshots only", with_history=False)
        self.view(without_history, "--only", "page")
        self.assertEqual(self.data_of(without_history / "report.html")["panels"], [])
        directory = self.folder / "history only"
        synthetic_run.write_run(directory, snapshots=0)
        self.view(directory, "--only", "page")
        self.assertEqual(self.data_of(directory / "report.html")["frame_times"], [])
        _, errors = self.view(directory, "--only", "animation", expected=1)
        self.assertIn("no snapshots", errors)

    def test_mistakes_are_told_without_a_traceback(self) -> None:
        _, errors = self.view(self.folder / "nowhere", expected=1)
        self.assertIn("is not a directory", errors)
        run = self.run_of("run")
        for wrong, text in ((["--follow", "-1"], "above 0"), (["--frames", "0"], "at least 1"), ([run, "--follow"], "one run")):
            errors = io.StringIO()
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(errors):
                command.main([str(run), *map(str, wrong)])
            self.assertIn(text, errors.getvalue())
        with mock.patch.object(animation.shutil, "which", lambda name: None):
            self.assertEqual(animation.default_format(), "gif")
            _, errors = self.view(run, "--only", "animation", "--format", "mp4", expected=1)
        self.assertIn("ffmpeg", errors)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_mp4(self) -> None:
        run = self.run_of("one")
        self.view(run, "--only", "animation", "--format", "mp4", "--rate", "5")
        told = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames,r_frame_rate,pix_fmt",
                               "-of", "json", run / "animation.mp4"], capture_output=True, text=True, check=True)
        stream = json.loads(told.stdout)["streams"][0]
        self.assertEqual((stream["nb_read_frames"], stream["r_frame_rate"], stream["pix_fmt"]), ("4", "5/1", "yuv420p"))

    @unittest.skipUnless(shutil.which("chromium"), "chromium is not installed")
    def test_a_browser_draws_the_page(self) -> None:
        run = self.run_of("one")
        self.view(run, "--only", "page")
        shown = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=3000",
                                f"--user-data-dir={self.folder / 'profile'}", "--dump-dom", (run / "report.html").as_uri()],
                               capture_output=True, text=True, timeout=100, check=True).stdout
        data = self.data_of(run / "report.html")
        self.assertIn(f'data-ready="{len(data["panels"])}"', shown)
        drawn = re.findall(r'<path d="(M[^"]+)" class="curve', shown)
        self.assertEqual(len(drawn), sum(len(panel["curves"]) for panel in data["panels"]))
        self.assertTrue(all(path.count("L") == len(data["times"][0]) - 1 for path in drawn))
        self.assertIn('id="frame" alt="particles at the time below" src="data:image/jpeg;base64', shown)

    def test_numbers_of_the_set_up(self) -> None:
        lines = dict(facts.set_up(Run(self.run_of("one"))))
        self.assertEqual(lines["drop"], "round, D0 = 1 mm, U0 = 1 m/s")
        self.assertEqual(lines["Weber number"], "13.9")
        self.assertEqual(lines["beam"], "cantilever, L = 6 mm, H = 0.25 mm, E = 300 MPa")

    def test_frames_are_of_the_longest_run_and_few_enough(self) -> None:
        first, second = (list(Run(self.run_of(name)).snapshots) for name in ("first", "second"))
        np.testing.assert_allclose(frames.film_times([first[:2], second], 3), [0, 2e-3, 3e-3])
        self.assertEqual(frames.nearest(second, 1.9e-3).time, second[2].time)

    def test_long_histories_are_thinned_and_keep_their_end(self) -> None:
        rows = curves.chosen_rows(5000)
        self.assertLessEqual(len(rows), curves.MOST_ROWS + 1)
        self.assertEqual((rows[0], rows[-1], len(set(np.diff(rows[:-1])))), (0, 4999, 1))

    def test_following_a_run(self) -> None:
        run = self.run_of("run")
        lines = (run / "history.csv").read_text().splitlines(keepends=True)
        states = [("running", lines[:2]), ("running", [*lines[:50], lines[50][:-9]]), ("running", lines[:50]), ("completed", lines)]

        def write(state: tuple[str, list[str]]) -> None:
            (run / "run.json").write_text(json.dumps({"status": state[0]}))
            (run / "history.csv").write_text("".join(state[1]))

        write(states.pop(0))
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(follow.follow(run, run, 1.0, sleep=lambda _: write(states.pop(0))), 2)
        told = output.getvalue().splitlines()
        self.assertEqual(states, [])
        self.assertIn(follow.status_line(History.of_text("", "".join(lines[:50]))), told[0])
        self.assertIn("t = 3 ms", told[1])
        self.assertEqual([path.name for path in run.glob("*.part*")], [])
        with Image.open(run / "history.png") as picture:
            self.assertGreater(picture.width, 80)


if __name__ == "__main__":
    unittest.main()
