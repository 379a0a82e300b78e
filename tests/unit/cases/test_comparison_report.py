"""What passes, what fails, what is missing; and the report's files."""

from __future__ import annotations

import math
import re
import sys
import tempfile
import unittest
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "cases"))
from comparison.cost import CELL_SHARE, in_words, particle_steps, rate_of, reached_time  # noqa: E402
from comparison.ledgers import Ledger  # noqa: E402
from comparison.markdown import inline, to_html  # noqa: E402
from comparison.measure import ledger_rows, rows_of  # noqa: E402
from comparison.model import Row  # noqa: E402
from comparison.report_markdown import BEGIN, END, deeper_headings, moved_links, updated_page  # noqa: E402
from comparison.study import Expected, Study, StudyError  # noqa: E402
from comparison.tables import QUANTITY_HEADINGS, both, error_text, number, quantity_cells, worst_of  # noqa: E402
from toy_study import write_study  # noqa: E402

NAN = math.nan


def expected(quantity: str = "depth", unit: str = "mm", theory: float = NAN, paper: float = NAN, goal: float = NAN,
             goal_tolerance: float = NAN, ours: float = NAN, tolerance: float = NAN, modern: float = NAN,
             modern_tolerance: float = NAN) -> Expected:
    return Expected("paper", quantity, unit, theory, paper, goal, goal_tolerance, ours, tolerance, "", modern, modern_tolerance)


class Rows(unittest.TestCase):
    def test_a_value_passes_within_the_tolerance(self) -> None:
        row = expected(ours=0.3, tolerance=0.01)
        for measured, check in ((0.3, "pass"), (0.3099, "pass"), (0.2901, "pass"), (0.311, "fail"), (0.289, "fail"), (-0.3, "fail")):
            self.assertEqual(Row(row, measured).check, check, measured)
        self.assertEqual(Row(expected(), 0.3).check, "", "nothing was recorded")

    def test_what_was_not_measured_is_missing_unless_runs_are(self) -> None:
        for row in (expected(ours=0.3, tolerance=0.01), expected(goal=1.0, goal_tolerance=0.1)):
            self.assertEqual(Row(row, NAN).check, "missing")
            self.assertEqual(Row(row, NAN, lacks_runs=True).check, "not run")
            self.assertEqual(Row(row, NAN).goal_state, "")

    def test_a_goal_is_met_or_not_whatever_was_recorded(self) -> None:
        row = expected(goal=2.5, goal_tolerance=0.1, ours=2.0, tolerance=0.01)
        self.assertEqual((Row(row, 2.45).goal_state, Row(row, 2.45).check), ("met", "fail"))
        self.assertEqual((Row(row, 2.0).goal_state, Row(row, 2.0).check), ("not met", "pass"))

    def test_errors_count_from_theory_or_else_paper_or_else_goal(self) -> None:
        self.assertAlmostEqual(Row(expected(theory=2.0, paper=4.0, goal=5.0, goal_tolerance=0), 2.2).error, 0.1)
        self.assertEqual(error_text(Row(expected(theory=2.0, paper=4.0), 2.2)), "+10 %")
        self.assertEqual(error_text(Row(expected(paper=4.0), 3.0)), "-25 % (paper)")
        self.assertEqual(error_text(Row(expected(goal=-2.0, goal_tolerance=0), -3.0)), "-50 % (goal)")
        self.assertEqual(error_text(Row(expected(theory=0.0), 3.0)), "", "of zero there is no share")
        self.assertEqual(error_text(Row(expected(), 3.0)), "")

    def test_rows_are_the_expected_ones_in_their_unit_and_then_the_others(self) -> None:
        rows = rows_of([expected("a"), expected("b", "ms", ours=2.0, tolerance=1e-6)], {"b": 2e-3, "c": 7.0}, lacks_runs=False)
        self.assertEqual([row.expected.quantity for row in rows], ["a", "b", "c"])
        self.assertEqual([row.check for row in rows], ["missing", "pass", ""])
        self.assertIn("not in expected.csv", rows[2].expected.description)
        self.assertEqual(rows[2].measured, 7.0)

    def test_ledgers_give_the_worst_run(self) -> None:
        ledgers = {"a": Ledger(1.0, 0.01, 0.0, 1.0, 1e-14, 2e-4), "b": Ledger(1.0, 0.03, NAN, NAN, NAN, NAN)}
        rows = {row.expected.quantity: row for row in ledger_rows(ledgers, [], "paper", lacks_runs=False)}
        self.assertAlmostEqual(rows["largest_unaccounted_energy"].measured, 3.0)
        self.assertIn("in b", rows["largest_unaccounted_energy"].expected.description)
        self.assertIn("in a", rows["largest_momentum_mismatch"].expected.description)
        recorded = expected("largest_unaccounted_energy", "%", ours=2.0, tolerance=0.1)
        self.assertEqual(ledger_rows(ledgers, [recorded], "paper", lacks_runs=False)[0].check, "fail")
        self.assertEqual(ledger_rows(ledgers, [recorded], "paper", lacks_runs=True)[0].check, "not run")
        self.assertEqual(rows_of([recorded], {}, lacks_runs=False), [], "it would stand there twice")

    def test_cells_stand_under_their_headings(self) -> None:
        cells = dict(zip(QUANTITY_HEADINGS, quantity_cells(Row(expected(theory=2, goal=3, goal_tolerance=0.5, ours=2.5, tolerance=0.01), 2.6)),
                         strict=True))
        self.assertEqual(cells, {"quantity": "depth", "unit": "mm", "theory": "2", "paper": "", "goal": "3 ± 0.5",
                                 "ours (paper's scheme)": "2.6", "ours (modern)": "", "error": "+30 %", "error (modern)": "",
                                 "recorded": "2.5 ± 0.01", "recorded (modern)": "", "check": "FAIL", "goal met": "met"})
        self.assertEqual(number(0.000123456), "0.0001235")


class ModernRows(unittest.TestCase):
    """What mode modern gave stands in the row of the paper's scheme and is checked by itself."""

    def test_each_is_checked_against_its_own_record(self) -> None:
        row = expected(theory=0.25, goal=0.25, goal_tolerance=0.01, ours=0.34, tolerance=0.01, modern=0.252, modern_tolerance=0.001)
        found = Row(row, 0.34, modern=0.2525)
        self.assertEqual((found.check, found.modern_check, found.goal_state, found.modern_goal_state), ("pass", "pass", "not met", "met"))
        self.assertAlmostEqual(found.modern_error, 0.01)
        for other, state in ((expected(theory=0.25, goal=0.28, goal_tolerance=0.01), ""), (expected(goal=0.25, goal_tolerance=0.01), ""),
                             (expected(theory=0.25, goal=0.25, goal_tolerance=0.001), "not met")):
            self.assertEqual(Row(other, 0.25, modern=0.252).modern_goal_state, state, "only theory's goals are those of mode modern")
        self.assertTrue(math.isnan(Row(expected(goal=0.25, goal_tolerance=0.01), 0.25, modern=0.25).modern_error))
        self.assertAlmostEqual(Row(replace(row, modern_theory=0.5), 0.34, modern=0.51).modern_error, 0.02)
        self.assertEqual(Row(row, 0.34, modern=0.34).modern_check, "fail")
        self.assertEqual(Row(row, 0.252, modern=0.252).check, "fail")

    def test_runs_that_are_not_there_are_told_apart(self) -> None:
        row = expected(ours=0.34, tolerance=0.01, modern=0.252, modern_tolerance=0.001)
        self.assertEqual(Row(row, 0.34, lacks_modern=True).modern_check, "not run")
        self.assertEqual(Row(row, 0.34, lacks_runs=True).modern_check, "missing")
        self.assertEqual(Row(row, NAN, lacks_modern=True, modern=0.252).check, "missing")
        self.assertEqual(Row(expected(ours=0.34, tolerance=0.01), 0.34).modern_check, "", "nothing was recorded of mode modern")
        self.assertEqual(Row(expected(modern=0.252, modern_tolerance=0.001), NAN, modern=0.252).check, "", "only mode modern has it")

    def test_values_come_into_the_row_of_their_quantity(self) -> None:
        rows = rows_of([expected("a", "ms")], {"a": 2e-3, "b": 1.0}, False, {"a": 3e-3, "c": 7.0})
        self.assertEqual([(row.expected.quantity, row.measured, row.modern) for row in rows[:1]], [("a", 2.0, 3.0)])
        self.assertEqual([row.expected.quantity for row in rows[1:]], ["b", "c"])
        self.assertTrue(math.isnan(rows[1].modern) and math.isnan(rows[2].measured))

    def test_ledgers_are_the_worst_of_either(self) -> None:
        ledgers = {"a": Ledger(1.0, 0.01, 0.0, 1.0, NAN, NAN), "a_modern": Ledger(1.0, 0.03, 0.0, 1.0, NAN, NAN),
                   "b_modern": Ledger(1.0, 0.02, 0.0, 1.0, NAN, NAN)}
        row = ledger_rows(ledgers, [], "paper", False, {"a_modern", "b_modern"})[0]
        self.assertAlmostEqual(row.measured, 1.0)
        self.assertAlmostEqual(row.modern, 3.0)
        self.assertIn("in a and a_modern", row.expected.description)
        recorded = expected("largest_unaccounted_energy", "%", ours=1.0, tolerance=0.1, modern=2.0, modern_tolerance=0.1)
        row = ledger_rows(ledgers, [recorded], "paper", False, {"a_modern", "b_modern"})[0]
        self.assertEqual((row.check, row.modern_check), ("pass", "fail"))

    def test_cells(self) -> None:
        row = expected(theory=2, goal=2, goal_tolerance=0.1, ours=2.5, tolerance=0.01, modern=2.02, modern_tolerance=0.01)
        cells = dict(zip(QUANTITY_HEADINGS, quantity_cells(Row(row, 2.5, modern=2.04)), strict=True))
        self.assertEqual([cells[name] for name in ("ours (modern)", "error (modern)", "recorded (modern)", "check", "goal met")],
                         ["2.04", "+2 %", "2.02 ± 0.01", "pass; modern FAIL", "not met; modern met"])
        self.assertEqual([both("pass", "pass"), both("pass", ""), both("", "pass")], ["pass", "pass", "modern pass"])
        self.assertEqual([worst_of(text) for text in ("pass", "pass; modern FAIL", "FAIL; modern pass", "not met; modern met", "modern met", "")],
                         ["pass", "FAIL", "FAIL", "", "met", ""])


class StudyFiles(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.study = Study(write_study(Path(folder.name) / "toy"))

    def test_parameters_are_the_case_with_the_settings(self) -> None:
        parameters = {variant.name: self.study.parameters(variant) for variant in self.study.variants("paper")}
        self.assertEqual(parameters["slow"]["drop"]["velocity"], [0.0, -0.5])
        self.assertEqual(parameters["fast"]["drop"]["velocity"], [0, -1.0])
        self.assertEqual(self.study.parameters(self.study.variants("short")[0])["time"]["end"], 5e-4)

    def test_runs_in_mode_modern_repeat_their_twins(self) -> None:
        runs = self.study.folder / "runs.toml"
        before = self.study.variants("paper")
        runs.write_text(runs.read_text(encoding="utf-8").replace("set = {}", 'set = {"time.end" = 3e-3}\nmodern = ["fast"]', 1)
                        + '[modern]\nset = {"time.sound_cfl" = 0.4}\n', encoding="utf-8")
        study = Study(self.study.folder)
        *own, modern = study.variants("paper")
        self.assertEqual([variant.name for variant in own], [variant.name for variant in before])
        self.assertEqual((modern.name, modern.twin), ("fast_modern", "fast"))
        self.assertEqual(modern.settings, {**own[1].settings, "mode": "modern", "time.sound_cfl": 0.4})
        self.assertEqual(modern.settings["time.end"], 3e-3)
        self.assertEqual([variant.name for variant in study.variants("short")], ["slow"], "only the level that says so has them")
        folders = {name: Path(name) for name in ("fast", "fast_modern", "another")}
        results = study.results("paper", folders)
        self.assertEqual((list(results), list(results.modern), list(results.modern.modern)), (["fast"], ["fast"], []))
        for text, words in (('[levels.paper]\nset = {}\nmodern = ["fats"]\n', "names the run 'fats'"), ("[modern]\nrun = 1\n", "unknown key 'run'"),
                            ("[runs.a_modern]\nset = {}\n", "are those of runs in mode modern")):
            runs.write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(StudyError, re.escape(words)):
                Study(self.study.folder)

    def test_mistakes_in_expected_are_named_with_their_line(self) -> None:
        head = "level,quantity,unit,theory,paper,goal,goal_tolerance,ours,tolerance,description\n"
        for row, words in (
            ("paper,a,furlong,,,,,,,x", "line 2: there is no unit 'furlong'"),
            ("draft,a,mm,,,,,,,x", "there is no level 'draft'"),
            ("paper,a,mm,two,,,,,,x", "theory is 'two', not a number"),
            ("paper,a,mm,,,,,0.3,,x", "ours needs its tolerance"),
            ("paper,a,mm,,,0.3,-1,,,x", "goal needs its goal_tolerance"),
            ("paper,a,mm,,,,,,,x\npaper,a,mm,,,,,,,x", "line 3: 'a' is there twice"),
            ("paper,a,mm,,,,,,,one, two", "does not have 10 cells"),
            ("paper,a,mm", "does not have 10 cells"),
        ):
            (self.study.folder / "expected.csv").write_text(head + row + "\n", encoding="utf-8")
            with self.assertRaisesRegex(StudyError, re.escape(words)):
                self.study.expected("paper")
        modern = head.replace("description", "modern,modern_tolerance,description")
        (self.study.folder / "expected.csv").write_text(modern + "paper,a,mm,,,,,,,0.3,0.1,x\n", encoding="utf-8")
        self.assertEqual(self.study.expected("paper")[0].modern, 0.3)
        (self.study.folder / "expected.csv").write_text(modern + "paper,a,mm,,,,,,,0.3,,x\n", encoding="utf-8")
        with self.assertRaisesRegex(StudyError, "modern needs its modern_tolerance"):
            self.study.expected("paper")
        (self.study.folder / "expected.csv").write_text("level,quantity\n", encoding="utf-8")
        with self.assertRaisesRegex(StudyError, "has no column"):
            self.study.expected("paper")


class Costs(unittest.TestCase):
    def test_particles_times_steps_of_the_shipped_kind_of_case(self) -> None:
        # The program's own count: 1257 + 3200 moving particles at 5.99 ns a step for 4 ms.
        cantilever = {"resolution": {"spacing": 2.5e-5}, "time": {"end": 4e-3}, "drop": {"velocity": [0, -0.8]},
                      "solid": {"kind": "cantilever", "length": 8e-3}}
        self.assertAlmostEqual(particle_steps(cantilever) / (4457 * 667736), 1.0, delta=0.01)
        # In mode modern 292094 steps for 7 ms: four times as long a step.
        modern = {**cantilever, "mode": "modern", "time": {"end": 7e-3}}
        self.assertAlmostEqual(particle_steps(modern) / ((1257 + CELL_SHARE * 3200) * 292094), 1.0, delta=0.01)
        # Where the liquid's sound sets it, twice as long: 134540 steps of the soft cantilever for 16 ms.
        soft = {**modern, "time": {"end": 16e-3}, "solid": {"kind": "cantilever", "length": 10e-3, "youngs_modulus": 6e6}}
        self.assertAlmostEqual(particle_steps(soft) / ((1257 + CELL_SHARE * 4000) * 134540), 1.0, delta=0.02)
        drop = {"resolution": {"spacing": 2.5e-5}, "time": {"end": 12e-3, "sound_cfl": 0.2}, "drop": {}}
        self.assertAlmostEqual(particle_steps(drop) / (1257 * 100147), 1.0, delta=0.01)
        plate = {"resolution": {"spacing": 2e-3}, "time": {"end": 1.0}, "drop": {"shape": "none"},
                 "solid": {"kind": "cantilever", "length": 0.2, "thickness": 0.02, "youngs_modulus": 2e6, "poisson_ratio": 0.3975}}
        self.assertAlmostEqual(particle_steps(plate) / (1000 / (0.1 * 2.4e-3 / 57.03)), 1.0, delta=0.01)

    def test_the_rate_is_the_median_of_finished_runs(self) -> None:
        def run(seconds: float, status: str = "completed") -> dict[str, object]:
            return {"status": status, "wall_time_seconds": seconds, "ranks": 2, "details": {"particles": 1000, "steps": 1000}}
        self.assertAlmostEqual(rate_of([run(0.1), run(0.2), run(9.0), run(0.0, "running")], ranks=4), 1e-7)

    def test_time_reached_is_that_of_the_last_full_row(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "history.csv")
            self.assertEqual(reached_time(path), 0.0)
            path.write_text("time [s],x [m]\n", encoding="utf-8")
            self.assertEqual(reached_time(path), 0.0)
            path.write_text("time [s],x [m]\n" + "".join(f"{k * 1e-3!r},{'7' * 40}\n" for k in range(1000)) + "9.9", encoding="utf-8")
            self.assertEqual(reached_time(path), 0.999)

    def test_durations_in_words(self) -> None:
        self.assertEqual([in_words(s) for s in (3.2, 99, 150, 5990, 12000)], ["3 s", "99 s", "2 min", "1 h 40 min", "3 h 20 min"])


class Markdown(unittest.TestCase):
    def test_blocks(self) -> None:
        text = "# One\n\nTwo `a<b` *three*\nlines **four**.\n\n- a\n  goes on\n- b\n\n1. c\n\n| x | y |\n|---|---|\n| 1 | `p` |\n\n```sh\n# not <a> heading\n```\n"
        page = to_html(text, deeper=2)
        self.assertIn("<h3>One</h3>", page)
        self.assertIn("<p>Two <code>a&lt;b</code> <em>three</em> lines <strong>four</strong>.</p>", page)
        self.assertIn("<ul><li>a goes on</li><li>b</li></ul>", page)
        self.assertIn("<ol><li>c</li></ol>", page)
        self.assertIn("<tr><th>x</th><th>y</th></tr><tr><td>1</td><td><code>p</code></td></tr>", page)
        self.assertIn("<pre><code># not &lt;a&gt; heading</code></pre>", page)

    def test_text_is_escaped_and_products_are_no_emphasis(self) -> None:
        self.assertEqual(inline("<script> 2 * 3 * 4 a*b*c & `*`"), "&lt;script&gt; 2 * 3 * 4 a*b*c &amp; <code>*</code>")

    def test_links_and_pictures(self) -> None:
        page = inline("[`a`](x.md) [b](https://example.org/?a=1&b=2) ![p](p.png)",
                      lambda target: target if "://" in target else None, lambda source: f"data:{source}")
        self.assertEqual(page, '<code>a</code> <a href="https://example.org/?a=1&amp;b=2">b</a> <img src="data:p.png" alt="p">')

    def test_every_readme_becomes_balanced_html(self) -> None:
        for path in (Path(__file__).resolve().parents[3] / "cases").glob("**/*.md"):
            with self.subTest(path=str(path)):
                Balance(to_html(path.read_text(encoding="utf-8"))).check(self)

    def test_headings_and_links_move_with_a_text(self) -> None:
        self.assertEqual(deeper_headings("# a\n```\n# b\n```\n##### c", 2), "### a\n```\n# b\n```\n###### c")
        self.assertEqual(moved_links("[a](b.md#c) [d](https://e.f) ![g](h.png)", Path("/p/cases/toy"), Path("/p/results/report")),
                         "[a](../../cases/toy/b.md#c) [d](https://e.f) ![g](../../cases/toy/h.png)")


class Balance(HTMLParser):
    """Whether every tag that opens is closed in turn."""

    VOID = {"meta", "img", "hr", "br", "wbr"}

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.mistakes: list[str] = []
        self.addresses: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.addresses += [value or "" for name, value in attrs if name in ("src", "href")]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.mistakes.append(f"</{tag}> at {self.getpos()}")

    def check(self, test: unittest.TestCase) -> None:
        test.assertEqual((self.mistakes, self.open), ([], []))


class Page(unittest.TestCase):
    def test_only_what_stands_between_the_marks_changes(self) -> None:
        page = f"before\n{BEGIN}old\n{END}after\n"
        self.assertEqual(updated_page(page, "new\n"), f"before\n{BEGIN}\nnew\n\n{END}after\n")
        self.assertEqual(updated_page(updated_page(page, "new\n"), "new\n"), updated_page(page, "new\n"))
        for broken in ("nothing", f"{END}{BEGIN}", f"{BEGIN}{BEGIN}{END}"):
            with self.assertRaises(ValueError):
                updated_page(broken, "new")


if __name__ == "__main__":
    unittest.main()
