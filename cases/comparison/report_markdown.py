"""The report as Markdown, with pictures beside it; and its table alone."""

from __future__ import annotations

import os
import re
from pathlib import Path

from comparison.model import Comparison, StudyReport
from comparison.study import Drawing
from comparison.tables import LEGEND, QUANTITY_HEADINGS, RUN_HEADINGS, quantity_cells, run_cells, study_line, summary

BEGIN = "<!-- comparison: written by compare.py --update-comparison -->\n"
END = "<!-- end of comparison -->\n"


def table_lines(headings: tuple[str, ...], rows: list[list[str]]) -> list[str]:
    """A Markdown table."""
    lines = ["| " + " | ".join(headings) + " |", "|---" * len(headings) + "|"]
    return lines + ["| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |" for cells in rows]


def quantity_table(comparison: Comparison) -> list[str]:
    """Every quantity of every study."""
    rows = []
    for report in comparison.studies:
        rows.append([f"**{report.study.name}**: {study_line(report)}", *[""] * (len(QUANTITY_HEADINGS) - 1)])
        rows += [quantity_cells(row) for row in report.rows]
    return table_lines(QUANTITY_HEADINGS, rows)


def table_text(comparison: Comparison) -> str:
    """What cases/COMPARISON.md holds: how the table came about, and the table."""
    head = table_lines(("", ""), [list(entry) for entry in summary(comparison)])
    return "\n".join([*head, "", LEGEND, "", *quantity_table(comparison)]) + "\n"


def updated_page(page: str, table: str) -> str:
    """The page with the table between its two marks. Raises ValueError where they are missing."""
    if page.count(BEGIN) != 1 or page.count(END) != 1 or page.index(BEGIN) > page.index(END):
        raise ValueError(f"needs exactly one line {BEGIN.strip()!r} and after it one {END.strip()!r}")
    before, rest = page.split(BEGIN)
    return f"{before}{BEGIN}\n{table}\n{END}{rest.split(END)[1]}"


def deeper_headings(text: str, levels: int) -> str:
    """A README's headings so many levels down; fences stay as they are."""
    lines, is_fence = [], False
    for line in text.splitlines():
        is_fence ^= line.startswith("```")
        match = re.match(r"(#{1,6})(\s.*)", line)
        lines.append("#" * min(6, len(match[1]) + levels) + match[2] if match and not is_fence else line)
    return "\n".join(lines)


def moved_links(text: str, folder: Path, page_folder: Path) -> str:
    """Relative links of a text in `folder` as they are from another folder."""
    def moved(match: re.Match[str]) -> str:
        target, mark = match[1], match[2] or ""
        if "://" in target or target.startswith(("mailto:", "#")):
            return match[0]
        return f"]({os.path.relpath(folder / target, page_folder)}{mark})"

    return re.sub(r"\]\(([^)#\s]+)(#[^)]*)?\)", moved, text)


def readme_text(report: StudyReport) -> str:
    """Of the study's README.md; nothing if there is none."""
    path = report.study.folder / "README.md"
    return path.read_text(encoding="utf-8") if path.is_file() else ""


def drawing_lines(drawing: Drawing, folder: Path) -> list[str]:
    title = f"**{drawing.paper_figure}** " if drawing.paper_figure else ""
    source = os.path.relpath(drawing.path, folder)
    return [f"![{drawing.paper_figure or drawing.path.stem}]({source})", "", title + drawing.caption, ""]


def study_lines(report: StudyReport, folder: Path) -> list[str]:
    lines = [f"## {report.study.name}", "", study_line(report), ""]
    lines += [f"- **Problem**: {problem}" for problem in report.problems] + [""] * bool(report.problems)
    if text := readme_text(report):
        lines += [moved_links(deeper_headings(text, 2), report.study.folder, folder), ""]
    lines += table_lines(QUANTITY_HEADINGS, [quantity_cells(row) for row in report.rows]) + [""]
    notes = [f"- `{row.expected.quantity}`: {row.expected.description}" for row in report.rows if row.expected.description]
    lines += notes + [""] * bool(notes)
    for drawing in report.drawings:
        lines += drawing_lines(drawing, folder)
    if report.ledgers:
        lines += ["### Ledgers", ""]
        for drawing in report.ledgers:
            lines += drawing_lines(drawing, folder)
    lines += ["### Runs", "", *table_lines(RUN_HEADINGS, [run_cells(run) for run in report.runs]), ""]
    lines += [f"- {run.job.title}: {run.error}" for run in report.runs if run.error]
    return lines + [""]


def markdown_report(comparison: Comparison, folder: Path) -> str:
    """The whole report, for a file in `folder`."""
    lines = ["# sphdrop against theory and paper", ""]
    lines += table_lines(("", ""), [[f"**{what}**", value] for what, value in summary(comparison)])
    lines += ["", "## All quantities", "", LEGEND, "", *quantity_table(comparison), ""]
    for report in comparison.studies:
        lines += study_lines(report, folder)
    return "\n".join(lines).rstrip("\n") + "\n"
