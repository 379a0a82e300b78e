"""The report as one HTML file that needs nothing beside it."""

from __future__ import annotations

import base64
from html import escape
from pathlib import Path

from comparison.markdown import to_html
from comparison.model import Comparison, Row, StudyReport
from comparison.report_markdown import readme_text
from comparison.study import Drawing
from comparison.tables import LEGEND, QUANTITY_HEADINGS, RUN_HEADINGS, quantity_cells, run_cells, study_line, summary, worst_of

STYLE = (Path(__file__).parent / "report.css").read_text(encoding="utf-8")
NUMBER_COLUMNS = range(2, 11)  # of QUANTITY_HEADINGS
RUN_NUMBER_COLUMNS = range(1, 11)  # of RUN_HEADINGS
STATE_CLASSES = {"pass": "good", "FAIL": "bad", "MISSING": "bad", "met": "good", "not met": "bad", "not run": "faint"}


def embedded(path: Path) -> str:
    """A picture as a data address."""
    kind = {".jpg": "jpeg", ".svg": "svg+xml"}.get(path.suffix, path.suffix.removeprefix("."))
    return f"data:image/{kind};base64,{base64.b64encode(path.read_bytes()).decode('ascii')}"


def readme_html(report: StudyReport) -> str:
    """The study's README.md two levels down; its pictures embedded, links within the project only named."""
    def picture(source: str) -> str | None:
        path = report.study.folder / source
        return source if "://" in source else embedded(path) if path.is_file() else None

    return to_html(readme_text(report), 2, lambda target: target if "://" in target else None, picture)


def _quantity_row(row: Row, has_description: bool) -> str:
    cells = []
    for column, text in enumerate(quantity_cells(row)):
        kind = "number" if column in NUMBER_COLUMNS else ""
        if column >= len(QUANTITY_HEADINGS) - 2:
            kind = STATE_CLASSES.get(worst_of(text), "")
        body = breakable(text) if column == 0 else escape(text)
        if column == 0 and has_description and row.expected.description:
            body += f"<small>{escape(row.expected.description)}</small>"
        cells.append(f'<td class="{kind}">{body}</td>' if kind else f"<td>{body}</td>")
    return "<tr>" + "".join(cells) + "</tr>"


def breakable(name: str) -> str:
    """A long name that a narrow screen may break after its underscores."""
    return escape(name).replace("_", "_<wbr>")


def _heading_row(headings: tuple[str, ...]) -> str:
    numbers = NUMBER_COLUMNS if headings is QUANTITY_HEADINGS else RUN_NUMBER_COLUMNS
    return "<tr>" + "".join(f'<th class="number">{escape(text)}</th>' if column in numbers else f"<th>{escape(text)}</th>"
                            for column, text in enumerate(headings)) + "</tr>"


def _wide(rows: list[str]) -> str:
    return '<div class="wide"><table>' + "\n".join(rows) + "</table></div>"


def quantity_table(studies: list[StudyReport]) -> str:
    """Every quantity of the studies, each study under a line of its own."""
    rows = [_heading_row(QUANTITY_HEADINGS)]
    for report in studies:
        name = report.study.name
        rows.append(f'<tr class="study"><td colspan="{len(QUANTITY_HEADINGS)}"><a href="#{name}">{name}</a> '
                    f"<small>{escape(study_line(report))}</small></td></tr>")
        rows += [_quantity_row(row, has_description=False) for row in report.rows]
    return _wide(rows)


def figure(drawing: Drawing) -> str:
    title = f"<b>{escape(drawing.paper_figure)}</b> " if drawing.paper_figure else ""
    return (f'<figure><img src="{embedded(drawing.path)}" alt="{escape(drawing.paper_figure or drawing.path.stem)}">'
            f"<figcaption>{title}{escape(drawing.caption)}</figcaption></figure>")


def run_table(report: StudyReport) -> str:
    rows = [_heading_row(RUN_HEADINGS)]
    for run in report.runs:
        kind = ' class="faint"' if run.state != "done" else ""
        cells = [f'<td class="number">{escape(text)}</td>' if column in RUN_NUMBER_COLUMNS else f"<td>{breakable(text)}</td>"
                 for column, text in enumerate(run_cells(run))]
        rows.append(f"<tr{kind}>" + "".join(cells) + "</tr>")
    failures = "".join(f'<p class="bad">{escape(run.job.title)}: {escape(run.error)}</p>' for run in report.runs if run.error)
    return _wide(rows) + failures


def study_section(report: StudyReport) -> str:
    """A study's text, its quantities with what they mean, its pictures, ledgers and runs."""
    name = report.study.name
    parts = [f'<section id="{name}"><h2>{name}</h2>', f"<p><small>{escape(study_line(report))}</small></p>"]
    parts += [f'<p class="bad">Problem: {escape(problem)}</p>' for problem in report.problems]
    parts.append(readme_html(report))
    parts.append(_wide([_heading_row(QUANTITY_HEADINGS), *[_quantity_row(row, has_description=True) for row in report.rows]]))
    parts += [figure(drawing) for drawing in report.drawings]
    if report.ledgers:
        parts.append("<h3>Ledgers</h3>")
        parts += [figure(drawing) for drawing in report.ledgers]
    parts += ["<h3>Runs</h3>", run_table(report), "</section>"]
    return "\n".join(parts)


def html_report(comparison: Comparison) -> str:
    """The whole file."""
    contents = "".join(f'<a href="#{report.study.name}">{report.study.name}</a>' for report in comparison.studies)
    state = "good" if comparison.passes and all(run.state == "done" for run in comparison.runs) else "bad"
    head = [f'<tr><th>{escape(what)}</th><td class="{state if what == "result" else ""}">{escape(value)}</td></tr>'
            for what, value in summary(comparison)]
    body = "\n".join(study_section(report) for report in comparison.studies)
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>sphdrop against theory and paper, level {comparison.level}</title>
<style>
{STYLE}</style>
</head>
<body>
<h1>sphdrop against theory and paper</h1>
{'<div class="wide"><table class="summary">' + "".join(head) + "</table></div>"}
<nav><a href="#quantities">all quantities</a>{contents}</nav>
<section id="quantities"><h2>All quantities</h2>
<p><small>{escape(LEGEND)}</small></p>
{quantity_table(comparison.studies)}
</section>
{body}
</body>
</html>
"""
