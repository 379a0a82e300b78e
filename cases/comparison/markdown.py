"""As much of Markdown as the studies' README.md files use, turned into HTML.

Headings, paragraphs, lists of one depth, tables, fences, quotes, rules; in a line code, emphasis, links and pictures. HTML
in the text is shown, not obeyed; comments vanish.
"""

from __future__ import annotations

import html
import re
from collections.abc import Callable

Link = Callable[[str], str | None]

_INLINE = re.compile(r"`([^`]+)`|!\[([^\]]*)\]\(([^)\s]+)\)|\[([^\]]+)\]\(([^)\s]+)\)|\*\*(.+?)\*\*|(?<![\w*])\*([^*\s][^*]*)\*")
_ITEM = re.compile(r"(?:[-*+]|\d+[.)])\s+")
_RULE = re.compile(r"\s*\|?\s*:?-{2,}:?\s*(\|\s*:?-{2,}:?\s*)*\|?\s*")


def to_html(text: str, deeper: int = 0, link: Link = lambda target: target, picture: Link = lambda source: source) -> str:
    """Headings go `deeper` levels down. `link` and `picture` give the address to use for one in the text; None leaves the
    bare text in its place."""
    lines = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL).splitlines()
    blocks: list[str] = []
    k = 0
    while k < len(lines):
        line = lines[k]
        if not line.strip():
            k += 1
        elif line.startswith("```"):
            end = next((n for n in range(k + 1, len(lines)) if lines[n].startswith("```")), len(lines))
            blocks.append(f"<pre><code>{html.escape(chr(10).join(lines[k + 1:end]))}</code></pre>")
            k = end + 1
        elif match := re.match(r"(#{1,6})\s+(.*)", line):
            level = min(6, len(match[1]) + deeper)
            blocks.append(f"<h{level}>{inline(match[2], link, picture)}</h{level}>")
            k += 1
        elif re.fullmatch(r"\s*(-{3,}|\*{3,})\s*", line):
            blocks.append("<hr>")
            k += 1
        elif "|" in line and k + 1 < len(lines) and "|" in lines[k + 1] and _RULE.fullmatch(lines[k + 1]):
            end = next((n for n in range(k + 2, len(lines)) if "|" not in lines[n]), len(lines))
            blocks.append(_table([line, *lines[k + 2:end]], link, picture))
            k = end
        elif _ITEM.match(line):
            items, k = _items(lines, k)
            tag = "ol" if line[0].isdigit() else "ul"
            blocks.append(f"<{tag}>" + "".join(f"<li>{inline(item, link, picture)}</li>" for item in items) + f"</{tag}>")
        else:
            quoted = line.startswith(">")
            end = k + 1
            while end < len(lines) and lines[end].strip() and not re.match(r"#{1,6}\s|```", lines[end]) \
                    and not _ITEM.match(lines[end]) and lines[end].startswith(">") == quoted:
                end += 1
            body = inline(" ".join(part.strip().lstrip("> ") if quoted else part.strip() for part in lines[k:end]), link, picture)
            blocks.append(f"<blockquote><p>{body}</p></blockquote>" if quoted else f"<p>{body}</p>")
            k = end
    return "\n".join(blocks)


def _items(lines: list[str], start: int) -> tuple[list[str], int]:
    """The items of a list with the lines that go on in them; and the line after it."""
    items: list[str] = []
    k = start
    while k < len(lines) and lines[k].strip():
        if _ITEM.match(lines[k]):
            items.append(_ITEM.sub("", lines[k], count=1))
        elif lines[k].startswith(" "):
            items[-1] += " " + lines[k].strip()
        else:
            break
        k += 1
    return items, k


def _table(lines: list[str], link: Link, picture: Link) -> str:
    rows = []
    for number, line in enumerate(lines):
        tag = "td" if number else "th"
        cells = re.split(r"(?<!\\)\|", line.strip().removeprefix("|").removesuffix("|"))
        rows.append("<tr>" + "".join(
            f"<{tag}>{inline(cell.strip().replace(chr(92) + '|', '|'), link, picture)}</{tag}>" for cell in cells) + "</tr>")
    return '<div class="wide"><table>' + "".join(rows) + "</table></div>"


def inline(text: str, link: Link = lambda target: target, picture: Link = lambda source: source) -> str:
    """A line's text: escaped, with code, emphasis, links and pictures."""
    parts, last = [], 0
    for match in _INLINE.finditer(text):
        parts.append(html.escape(text[last:match.start()], quote=False))
        last = match.end()
        code, alternative, source, words, target, strong, emphasis = match.groups()
        if code is not None:
            parts.append(f"<code>{html.escape(code, quote=False)}</code>")
        elif source is not None:
            address = picture(source)
            parts.append(html.escape(alternative) if address is None else
                         f'<img src="{html.escape(address)}" alt="{html.escape(alternative)}">')
        elif target is not None:
            address = link(target)
            body = inline(words, link, picture)
            parts.append(body if address is None else f'<a href="{html.escape(address)}">{body}</a>')
        elif strong is not None:
            parts.append(f"<strong>{inline(strong, link, picture)}</strong>")
        else:
            parts.append(f"<em>{inline(emphasis, link, picture)}</em>")
    parts.append(html.escape(text[last:], quote=False))
    return "".join(parts)
