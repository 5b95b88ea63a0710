"""A small document model of the reference, and its two faces: Markdown and HTML.

In texts, `code` stands between backquotes; nothing else is marked up.
"""

from __future__ import annotations

import html
import re
from dataclasses import dataclass

_CODE = re.compile(r"`([^`]+)`")
_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
code, pre { font: 14px/1.45 ui-monospace, monospace; }
pre { padding: .7rem; overflow: auto; border: 1px solid #8884; }
table { border-collapse: collapse; } td, th { text-align: left; vertical-align: top; }
td, th { padding: .2rem .8rem .2rem 0; border-bottom: 1px solid #8884; }
:root { color-scheme: light dark; }
"""


@dataclass(frozen=True, slots=True)
class Heading:
    level: int
    text: str

    @property
    def anchor(self) -> str:
        """As web hosts of Markdown make it from the text."""
        return re.sub(r"[^\w\- ]", "", self.text.lower()).replace(" ", "-")


@dataclass(frozen=True, slots=True)
class Paragraph:
    text: str


@dataclass(frozen=True, slots=True)
class CodeBlock:
    text: str
    language: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """Cells of the first column are code when `code_first`."""

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    code_first: bool = True

    def cells(self, row: tuple[str, ...]) -> tuple[str, ...]:
        return (f"`{row[0]}`", *row[1:]) if self.code_first else row


Part = Heading | Paragraph | CodeBlock | Table


def contents_of(parts: list[Part]) -> list[Heading]:
    """The headings of the table of contents."""
    return [part for part in parts if isinstance(part, Heading) and part.level == 2]


def to_markdown(parts: list[Part]) -> str:
    """The document as Markdown, with a table of contents below its title."""
    made = [_markdown(part) for part in parts]
    listed = [f"- [{h.text}](#{h.anchor})" for h in contents_of(parts)]
    made.insert(2, "\n".join(listed))
    return "\n\n".join(made) + "\n"


def _markdown(part: Part) -> str:
    match part:
        case Heading():
            return f"{'#' * part.level} {part.text}"
        case Paragraph():
            return part.text
        case CodeBlock():
            return f"```{part.language}\n{part.text}\n```"
        case Table():
            rows = [part.header, tuple("---" for _ in part.header), *(part.cells(row) for row in part.rows)]
            return "\n".join("| " + " | ".join(_cell(text) for text in row) + " |" for row in rows)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def to_html(parts: list[Part], title: str) -> str:
    """The document as one HTML page that needs nothing else."""
    made = [_html(part) for part in parts]
    listed = "".join(f'<li><a href="#{h.anchor}">{html.escape(h.text)}</a></li>' for h in contents_of(parts))
    made.insert(2, f"<nav><ul>{listed}</ul></nav>")
    head = f'<meta charset="utf-8"><title>{html.escape(title)}</title><style>{_STYLE}</style>'
    return (
        f'<!doctype html>\n<html lang="en"><head>{head}</head><body>\n'
        + "\n".join(made)
        + "\n</body></html>\n"
    )


def _html(part: Part) -> str:
    match part:
        case Heading():
            return f'<h{part.level} id="{part.anchor}">{html.escape(part.text)}</h{part.level}>'
        case Paragraph():
            return f"<p>{_inline(part.text)}</p>"
        case CodeBlock():
            return f"<pre>{html.escape(part.text)}</pre>"
        case Table():
            header = "".join(f"<th>{_inline(text)}</th>" for text in part.header)
            rows = "".join(
                "<tr>" + "".join(f"<td>{_inline(text)}</td>" for text in part.cells(row)) + "</tr>\n"
                for row in part.rows
            )
            return f"<table><tr>{header}</tr>\n{rows}</table>"


def _inline(text: str) -> str:
    return _CODE.sub(r"<code>\1</code>", html.escape(text, quote=False))
