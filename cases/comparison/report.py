"""Writes report.html, report.md and table.md, with the pictures in figures/STUDY beside them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

from comparison.measure import build  # noqa: E402
from comparison.model import Comparison  # noqa: E402
from comparison.report_html import html_report  # noqa: E402
from comparison.report_markdown import BEGIN, END, markdown_report, table_text, updated_page  # noqa: E402
from comparison.study import Study  # noqa: E402


def write_report(studies: Sequence[Study], level: str, results: Path, folder: Path, command: str) -> Comparison:
    """Tells of the finished runs under RESULTS/LEVEL; `folder` is made if it is not there."""
    folder.mkdir(parents=True, exist_ok=True)
    comparison = build(studies, level, results, folder / "figures", command)
    for name, text in (("report.html", html_report(comparison)), ("report.md", markdown_report(comparison, folder)),
                       ("table.md", table_text(comparison))):
        (folder / name).write_text(text, encoding="utf-8")
    return comparison


def update_page(page: Path, comparison: Comparison) -> None:
    """Puts the table between the marks of a Markdown page, which is begun if it is not there. Raises ValueError where the
    marks are missing."""
    text = page.read_text(encoding="utf-8") if page.exists() else f"# Comparison with theory and paper\n\n{BEGIN}{END}"
    page.write_text(updated_page(text, table_text(comparison)), encoding="utf-8")
