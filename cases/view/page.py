"""A page for the browser that needs nothing beside it: film, curves to look along, results, case and provenance."""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

from sphdrop_reader import ResultError, Run
from view.curves import panels_of
from view.facts import outcome, provenance, set_up

FOLDER = Path(__file__).parent


@dataclass(frozen=True)
class Film:
    """Frames as JPEG with their times in s; `first` is the one to show first."""

    times: Sequence[float]
    frames: Sequence[bytes]
    rate: float
    first: int = 0


def _table(lines: Sequence[tuple[str, str]]) -> str:
    rows = "".join(f"<tr><th>{escape(label)}</th><td>{escape(value)}</td></tr>" for label, value in lines)
    return f"<table>{rows}</table>" if rows else ""


def comparison_table(names: Sequence[str], columns: Sequence[Sequence[tuple[str, str]]]) -> str:
    """A line for each label that any run has, a column for each run."""
    labels = list(dict.fromkeys(label for column in columns for label, _ in column))
    found = [dict(column) for column in columns]
    head = "<tr><th></th>" + "".join(f"<th>{escape(name)}</th>" for name in names) + "</tr>"
    body = "".join(f"<tr><th>{escape(label)}</th>" + "".join(f"<td>{escape(column.get(label, '–'))}</td>" for column in found) + "</tr>"
                   for label in labels)
    return f'<div class="wide"><table>{head}{body}</table></div>'


def _results(names: Sequence[str], runs: Sequence[Run]) -> str:
    if len(runs) == 1:
        return '<div class="facts">' + "".join(_table(make(runs[0])) for make in (outcome, set_up, provenance)) + "</div>"
    return comparison_table(names, [[*outcome(run), *set_up(run), *provenance(run)] for run in runs])


def _cases(names: Sequence[str], runs: Sequence[Run]) -> str:
    parts = []
    for name, run in zip(names, runs):
        try:
            parts.append(f"<details><summary>{escape(name)}</summary><pre>{escape(run.case_text)}</pre></details>")
        except ResultError:
            continue
    return "<h2>Case as it was run</h2>" + "".join(parts) if parts else ""


def _film_section(film: Film | None) -> str:
    if film is None:
        return ""
    frames = "".join(f'<script type="text/plain" id="frame-{number}">data:image/jpeg;base64,'
                     f"{base64.b64encode(frame).decode('ascii')}</script>" for number, frame in enumerate(film.frames))
    return (f'<section id="film"><img id="frame" alt="particles at the time below">'
            f'<div id="controls"><button id="play">play</button>'
            f'<input id="slider" type="range" min="0" max="{len(film.frames) - 1}" value="0" aria-label="time">'
            f'<span id="frame-time"></span></div></section>{frames}')


def page(names: Sequence[str], runs: Sequence[Run], film: Film | None) -> str:
    """The whole file."""
    data = panels_of(names, runs)
    data["frame_times"] = [time * 1e3 for time in film.times] if film else []
    data["frame_rate"] = film.rate if film else 1
    data["first_frame"] = film.first if film else 0
    # "</" would end the script's element.
    text = json.dumps(data, separators=(",", ":")).replace("</", "<\\/")
    curves = ('<h2>Curves <small id="cursor-time"></small></h2><p>Point at a curve to read it; draw over a stretch of time to look closer, '
              'double-click to see all.</p><svg width="0" height="0" style="position:absolute"><clipPath id="plot-area">'
              '<rect x="58" y="8" width="492" height="188"/></clipPath></svg><div id="charts"></div>')
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{escape(", ".join(names))}: sphdrop</title>
<style>
{(FOLDER / "page.css").read_text(encoding="utf-8")}</style>
</head>
<body>
<h1>{escape(" and ".join(names))}</h1>
{_film_section(film)}
{curves}
<h2>Results</h2>
{_results(names, runs)}
{_cases(names, runs)}
<script type="application/json" id="data">{text}</script>
<script>
{(FOLDER / "page.js").read_text(encoding="utf-8")}</script>
</body>
</html>
"""
