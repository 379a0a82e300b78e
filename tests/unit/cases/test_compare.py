"""The command cases/compare.py, with a program that stands in for sphdrop."""

from __future__ import annotations

import contextlib
import io
import os
import pty
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

SCRIPT = Path(__file__).resolve().parents[3] / "cases" / "compare.py"
sys.path.insert(0, str(SCRIPT.parent))
import compare  # noqa: E402
from comparison.runner import last_words  # noqa: E402
from test_comparison_report import Balance  # noqa: E402
from toy_study import COMMIT, write_program, write_study  # noqa: E402


class Command(unittest.TestCase):
    draws_ledgers = False  # it takes a second, and test_ledgers.py tests it

    def setUp(self) -> None:
        if not self.draws_ledgers:
            patch = mock.patch("comparison.measure.draw_ledgers", lambda runs, folder: [])
            patch.start()
            self.addCleanup(patch.stop)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()
        self.study = write_study(self.folder / "cases" / "toy")
        self.program = write_program(self.folder / "program")
        self.log = self.folder / "log"
        self.results = self.folder / "results"

    def words(self, *arguments: str) -> list[str]:
        return [sys.executable, "-B", str(SCRIPT), "--cases", str(self.study.parent), "--program", str(self.program),
                "--results", str(self.results), "--ranks", "1", *arguments]

    def environment(self, **more: str) -> dict[str, str]:
        return {**os.environ, "TOY_LOG": str(self.log), **more}

    def compare(self, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
        """As from the command line, but in this process: it has the libraries loaded."""
        words = self.words(*arguments)
        output, error = io.StringIO(), io.StringIO()
        with mock.patch.dict(os.environ, self.environment(**environment)), contextlib.redirect_stdout(output), \
                contextlib.redirect_stderr(error):
            try:
                code = compare.main(words[3:])
            except SystemExit as end:
                code = int(str(end.code))
        return subprocess.CompletedProcess(words, code, output.getvalue(), error.getvalue())

    def made(self) -> list[str]:
        """The runs that the program was asked for since the last time."""
        names = self.log.read_text(encoding="utf-8").split() if self.log.exists() else []
        self.log.unlink(missing_ok=True)
        return names


class Runs(Command):
    def test_everything_is_run_once_and_reported(self) -> None:
        done = self.compare()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.made(), ["slow", "fast"])
        self.assertIn("2 checks pass, 0 fail; 1 goals met, 0 not met", done.stdout)
        again = self.compare()
        self.assertEqual(again.returncode, 0)
        self.assertEqual(self.made(), [], "finished runs were made again")
        self.assertIn("2 there already", again.stdout)

    def test_runs_of_another_commit_are_made_anew_unless_any_will_do(self) -> None:
        self.compare()
        self.made()
        other = "f" * 40
        self.assertEqual(self.compare("--any-version", TOY_COMMIT=other).returncode, 0)
        self.assertEqual(self.made(), [])
        done = self.compare(TOY_COMMIT=other)
        self.assertEqual(self.made(), ["slow", "fast"])
        self.assertIn("2 of them are there from another version", done.stdout)

    def test_a_run_of_another_case_or_setting_is_made_anew(self) -> None:
        self.compare()
        self.made()
        runs = self.study / "runs.toml"
        runs.write_text(runs.read_text(encoding="utf-8").replace("-1.0", "-1.5"), encoding="utf-8")
        done = self.compare()
        self.assertEqual(self.made(), ["fast"])
        self.assertEqual(done.returncode, 1)
        self.assertIn("FAIL: toy: speed_fast = 1.5 m/s, recorded 1 ± 1e-06", done.stdout)
        case = self.study / "case.cfg"
        case.write_text("# a remark\n" + case.read_text(encoding="utf-8"), encoding="utf-8")
        self.compare()
        self.assertEqual(self.made(), [], "a remark changes nothing")
        case.write_text(case.read_text(encoding="utf-8").replace("1e-3", "2e-3"), encoding="utf-8")
        self.compare()
        self.assertEqual(self.made(), ["slow", "fast"])

    def test_a_failed_run_does_not_stop_the_others_and_is_made_again(self) -> None:
        done = self.compare(TOY_FAILS="slow")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(self.made(), ["slow", "fast"])
        self.assertRegex(done.stdout, r"toy/slow: FAILED: ended with exit code 3: the drop is not a number \(.*log.txt\)")
        self.assertIn("1 runs are not there: toy/slow", done.stdout)
        page = (self.results / "paper/report/report.html").read_text(encoding="utf-8")
        self.assertIn("the drop is not a number", page)
        self.assertIn("not run", page)
        self.assertEqual(self.compare().returncode, 0)
        self.assertEqual(self.made(), ["slow"])

    def test_a_stopped_run_goes_on_from_its_checkpoint(self) -> None:
        self.compare(TOY_STOPS="slow")
        self.assertEqual(self.made(), ["slow", "fast"])
        self.assertEqual(self.compare().returncode, 0)
        self.assertEqual(self.made(), ["slow", "resumed"])
        self.assertEqual(self.compare().returncode, 0)
        self.assertEqual(self.made(), [])

    def test_a_stopped_run_of_another_commit_or_case_begins_anew(self) -> None:
        self.compare(TOY_STOPS="slow")
        self.made()
        self.compare(TOY_STOPS="slow", TOY_COMMIT="f" * 40)
        self.assertEqual(self.made(), ["slow", "fast"])
        runs = self.study / "runs.toml"
        runs.write_text(runs.read_text(encoding="utf-8").replace("[runs.slow]\nset = {}", '[runs.slow]\nset = {"time.end" = 2e-3}'), encoding="utf-8")
        self.compare("toy/slow", TOY_COMMIT="f" * 40)
        self.assertEqual(self.made(), ["slow"])

    def test_of_a_failure_the_programs_own_words_are_told(self) -> None:
        dashes = "-" * 74
        log = f"one\nsphdrop: the drop left\n\n{dashes}\nPrimary job  terminated\n{dashes}\n{dashes}\nExit code: 3\n{dashes}\n"
        self.assertEqual(last_words(log), "one / sphdrop: the drop left")
        self.assertEqual(last_words(f"{dashes}\nmpirun was unable to find the program\n"), f"{dashes} / mpirun was unable to find the program")
        self.assertEqual(last_words("1\n2\n3\n4\n"), "2 / 3 / 4")
        self.assertEqual(last_words(""), "nothing was said")

    def test_named_runs_only(self) -> None:
        for names, made in ((["toy/fast"], ["fast"]), (["toy/*ow"], ["slow"]), (["toy"], [])):
            self.assertEqual(self.compare(*names).returncode, 0)
            self.assertEqual(self.made(), made)
        self.assertTrue((self.results / "paper/report_toy/report.md").exists())
        self.assertFalse((self.results / "paper/report").exists())

    def test_levels_have_their_own_runs(self) -> None:
        self.assertEqual(self.compare("--level", "short").returncode, 0)
        self.assertEqual(self.made(), ["slow"])
        self.assertEqual(sorted(path.name for path in (self.results / "short").iterdir()), [".lock", "report", "toy"])

    def test_several_ranks_and_runs_at_a_time(self) -> None:
        launcher = self.folder / "bin" / "mpirun"
        launcher.parent.mkdir()
        launcher.write_text('#!/bin/bash\necho "ranks=$2" >> "$TOY_LOG"\nshift 2\nexec "$@"\n', encoding="utf-8")
        launcher.chmod(0o755)
        done = self.compare("--ranks", "3", "--parallel", "2", PATH=f"{launcher.parent}:{os.environ['PATH']}")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(self.made()), ["fast", "ranks=3", "ranks=3", "slow"])


class Interruption(Command):
    def test_finished_runs_stay_and_the_rest_is_made_later(self) -> None:
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number):
                process = subprocess.Popen(self.words(), env=self.environment(TOY_WAITS="fast"), stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, text=True)
                waits = self.results / "paper/toy/fast/waits"
                end = time.monotonic() + 30
                while not waits.exists() or not waits.read_text(encoding="utf-8"):
                    self.assertLess(time.monotonic(), end)
                    time.sleep(0.02)
                child = int(waits.read_text(encoding="utf-8"))
                refused = self.compare()
                self.assertEqual(refused.returncode, 2)
                self.assertIn("another comparison is running", refused.stderr)
                process.send_signal(number)
                output, error = process.communicate(timeout=20)
                self.assertEqual(process.returncode, 1)
                self.assertIn("stopped. Finished runs stay", error)
                self.assertNotIn("Traceback", error)
                self.assertNotIn("FAILED", output)
                with self.assertRaises(ProcessLookupError):
                    os.kill(child, 0)
                self.made()
                self.assertEqual(self.compare("--report-only").returncode, 1, "a run is not there")
                self.assertEqual(self.compare().returncode, 0)
                self.assertEqual(self.made(), ["fast"])
                (self.results / "paper/toy/fast/run.json").unlink()

    def test_on_a_terminal_a_line_tells_of_the_present_run(self) -> None:
        ours, theirs = pty.openpty()
        process = subprocess.Popen(self.words("toy/slow"), env=self.environment(TOY_WAITS="slow", COLUMNS="100"), stdout=theirs,
                                   stderr=theirs, stdin=subprocess.DEVNULL)
        os.close(theirs)
        text = ""
        try:
            while "of 1 ms (0 %) in" not in text:
                text += os.read(ours, 4096).decode()
        except OSError:
            self.fail(f"no such line in {text!r}")
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(20)
            os.close(ours)
        self.assertRegex(text, r"\[0/1\] toy/slow: 0 of 1 ms \(0 %\) in \d+ s; all in about ")


class Report(Command):
    draws_ledgers = True

    def test_holds_the_table_the_text_the_pictures_and_the_runs(self) -> None:
        self.compare()
        folder = self.results / "paper/report"
        page, text = ((folder / name).read_text(encoding="utf-8").replace("<wbr>", "") for name in ("report.html", "report.md"))
        parsed = Balance(page)
        parsed.check(self)
        for address in parsed.addresses:
            self.assertTrue(address.startswith(("#", "data:image/png;base64,")), f"{address[:80]} is not in the file")
        self.assertEqual(sum(address.startswith("data:") for address in parsed.addresses), 3)
        self.assertIn("<h3>A toy</h3>", page)
        for each in (page, text):
            for words in ("speed_slow", "speed_fast", "-20 % (paper)", "Fig. 99", "speed at the start, downwards", COMMIT,
                          "00000000deadbeef", "largest_unaccounted_energy", "all runs are there and all checks pass", "2 of 2 runs"):
                self.assertIn(words, each)
        self.assertIn("| speed_slow | m/s | 0.5 |  | 0.5 ± 0.01 | 0.5 |  | +0 % |  | 0.5 ± 1e-06 |  | pass | met |", text)
        self.assertRegex(text, r"\| slow \| 100 \| 50 \| 1 \| 2\.0 \| \d+\.\d \| \d+ \| 0 % \| 0 % \| 0 % \| 0 % \|")
        pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text)
        self.assertEqual(pictures, [f"figures/toy/{name}.png" for name in ("speed", "ledger", "ledgers")])
        for picture in pictures:
            self.assertEqual((folder / picture).read_bytes()[:4], b"\x89PNG")
        self.assertIn((folder / "table.md").read_text(encoding="utf-8").splitlines()[-1], text)

    def test_runs_in_mode_modern_stand_beside_their_twins(self) -> None:
        """The stand-in is twice as fast if it is told to be modern; see toy_study.py."""
        runs, expected = self.study / "runs.toml", self.study / "expected.csv"
        runs.write_text(runs.read_text(encoding="utf-8").replace("set = {}", 'set = {}\nmodern = ["slow"]', 1), encoding="utf-8")
        head, *rows = expected.read_text(encoding="utf-8").splitlines()
        values = {"paper,speed_slow": "1.0,1e-6,"}
        rows = [",".join(row.split(",")[:9]) + "," + values.get(",".join(row.split(",")[:2]), ",,") + '"x"' for row in rows]
        expected.write_text("\n".join([head.replace("description", "modern,modern_tolerance,description"), *rows]) + "\n", encoding="utf-8")
        for names, made in ((["*/*_modern"], ["slow_modern"]), ([], ["slow", "fast"])):
            done = self.compare(*names)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(self.made(), made)
        text = (self.results / "paper/report/report.md").read_text(encoding="utf-8")
        self.assertIn("| speed_slow | m/s | 0.5 |  | 0.5 ± 0.01 | 0.5 | 1 | +0 % | +1e+02 % | 0.5 ± 1e-06 | 1 ± 1e-06 | pass | met; modern not met |", text)
        self.assertIn("| speed_fast | m/s |  | 1.25 |  | 1 |  | -20 % (paper) |", text)
        self.assertIn("3 of 3 runs, CPU time 0 s; of these 1 in mode modern, 0 s", text)
        self.assertIn("3 checks pass, 0 fail; 1 goals met, 0 not met; in mode modern 0 met, 1 not met", text)
        self.assertRegex(text, r"\| cpu_time_of_pairs \| s \|  \|  \|  \| [\d.e-]+ \| [\d.e-]+ \|")
        self.assertRegex(text, r"\| slow_modern \| 100 \| 50 \| 1 \| 2\.0 \|")
        self.compare("--report-only", "toy/slow")
        expected.write_text(expected.read_text(encoding="utf-8").replace("1.0,1e-6,", "1.1,1e-6,", 1), encoding="utf-8")
        done = self.compare("--report-only")
        self.assertEqual(done.returncode, 1)
        self.assertIn("FAIL: toy: speed_slow in mode modern = 1 m/s, recorded 1.1 ± 1e-06", done.stdout)

    def test_the_table_goes_into_its_page(self) -> None:
        page = self.study.parent / "COMPARISON.md"
        self.assertEqual(self.compare("--update-comparison").returncode, 0)
        first = page.read_text(encoding="utf-8")
        self.assertIn("| speed_slow |", first)
        page.write_text(first.replace("# Comparison", "# My own words"), encoding="utf-8")
        self.compare("--report-only", "--update-comparison")

        def but_how_made(text: str) -> list[str]:
            return [line for line in text.splitlines() if not line.startswith(("| command", "| report made"))]

        again = page.read_text(encoding="utf-8")
        self.assertEqual(but_how_made(again), but_how_made(first.replace("# Comparison", "# My own words")))
        self.assertIn("--report-only", again)
        page.write_text("no marks", encoding="utf-8")
        done = self.compare("--report-only", "--update-comparison")
        self.assertEqual(done.returncode, 2)
        self.assertIn("COMPARISON.md needs exactly one line", done.stderr)
        self.assertEqual(page.read_text(encoding="utf-8"), "no marks")

    def test_a_study_that_cannot_be_measured_or_drawn_is_a_problem(self) -> None:
        plot = self.study / "plot.py"
        sound = plot.read_text(encoding="utf-8")
        self.compare()
        for broken, words in (
            (sound.replace("return {f", "1 / 0; return {f"), "measure: ZeroDivisionError: division by zero (plot.py, line"),
            (sound.replace('"drop_velocity_y"])', '"drop_speed"])'), "draw: ResultError:"),
            ("import nothing_like_this", "ModuleNotFoundError"),
            (None, "plot.py: is missing"),
        ):
            if broken is None:
                plot.unlink()
            else:
                plot.write_text(broken, encoding="utf-8")
            done = self.compare("--report-only")
            self.assertEqual(done.returncode, 1, words)
            self.assertIn(words, done.stdout)
            self.assertIn(words, (self.results / "paper/report/report.md").read_text(encoding="utf-8"))

    def test_a_quantity_that_is_not_measured_fails(self) -> None:
        with (self.study / "expected.csv").open("a", encoding="utf-8") as stream:
            stream.write("paper,depth,mm,1,,,,,,not there\n")
        done = self.compare()
        self.assertEqual(done.returncode, 1)
        self.assertIn("MISSING: toy: depth", done.stdout)

    def test_plot_runs_alone(self) -> None:
        self.compare("toy/slow")
        script = self.folder / "cases" / "toy" / "plot.py"
        script.write_text("import sys\nsys.path.insert(0, " + repr(str(SCRIPT.parent)) + ")\n" + script.read_text(encoding="utf-8") +
                          "\nif __name__ == '__main__':\n    from comparison.standalone import standalone_main\n"
                          "    sys.exit(standalone_main(__file__, measure, draw))\n", encoding="utf-8")

        def alone(*arguments: str) -> subprocess.CompletedProcess[str]:
            return subprocess.run([sys.executable, "-B", str(script), *arguments], capture_output=True, text=True, check=False, timeout=60)

        done = alone(str(self.results / "paper/toy"), "--output", str(self.folder / "pictures"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"speed_slow +m/s +0\.5 +0\.5 +0\.5 +- +0\.5\n")
        self.assertRegex(done.stdout, r"speed_fast .* not measured")
        self.assertIn("not there or not finished: fast", done.stdout)
        self.assertTrue((self.folder / "pictures/speed.png").exists())
        self.assertEqual(alone(str(self.folder)).returncode, 1)
        self.assertEqual(alone(str(self.folder / "nothing")).returncode, 2)


class Usage(Command):
    def test_mistakes_are_named(self) -> None:
        for arguments, words in (
            (["toi"], "did you mean toy"),
            (["toy/fats"], "did you mean toy/fast"),
            (["xyzzy"], "there are toy"),
            (["toy/fast", "--level", "short"], "there is no toy/fast at level short"),
            (["--level", "quick", "toy"], "toy has no runs at level quick"),
            (["--ranks", "0"], "--ranks and --parallel must be at least 1"),
            (["--program", "nothing"], "there is no program nothing"),
            (["--update-comparison", "toy"], "name none"),
            (["--cases", str(self.folder)], "there are no studies"),
            (["--nonsense"], "--nonsense"),
        ):
            with self.subTest(arguments=arguments):
                done = self.compare(*arguments)
                self.assertEqual(done.returncode, 2)
                self.assertIn(words, done.stderr)
                self.assertNotIn("Traceback", done.stderr)
        self.assertEqual(self.made(), [])

    def test_list_runs_nothing(self) -> None:
        done = self.compare("--list")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"toy/slow +about \d+ s\ntoy/fast +about \d+ s\n2 runs at level paper")
        self.compare("toy/slow")
        self.assertEqual(self.made(), ["slow"])
        self.assertIn(f"toy/slow  there, of {COMMIT[:8]}", self.compare("--list").stdout)


if __name__ == "__main__":
    unittest.main()
