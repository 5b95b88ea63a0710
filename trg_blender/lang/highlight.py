"""What each word of a text is, for editors that are told their colours token by token."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple

from .bind import HOST
from .scan import KEYWORDS, TOKEN
from .words import SPECIAL_DOCS, spaces

RunKind = Literal["keyword", "builtin", "number", "string", "comment", "symbol"]
_METHODS = frozenset(name for _, name in HOST.methods)
_SPACES = frozenset(spaces())


class Run(NamedTuple):
    """Characters of one line that look alike; columns from 0, `end` is the first behind them."""

    start: int
    end: int
    kind: RunKind


def highlight(text: str) -> tuple[tuple[Run, ...], ...]:
    """The coloured runs of each line, in order; plain names and spaces have none. Takes any text."""
    lines: list[list[Run]] = [[] for _ in range(text.count("\n") + 1)]
    line, line_start = 0, 0
    for start, end, kind in _kinds(text):
        line += text.count("\n", line_start, start)
        line_start = text.rfind("\n", 0, start) + 1
        for piece in text[start:end].split("\n"):
            if piece:
                lines[line].append(Run(start - line_start, start - line_start + len(piece), kind))
            start += len(piece) + 1
            if start <= end:
                line, line_start = line + 1, start
    return tuple(map(tuple, lines))


def _kinds(text: str) -> Iterator[tuple[int, int, RunKind]]:
    """Places of what is coloured."""
    at, before = 0, ""
    while at < len(text):
        match = TOKEN.match(text, at)
        if match is None:
            at, before = at + 1, ""
            continue
        start, at = match.span()
        group = match.lastgroup
        if group == "space":
            continue
        if group == "unclosed":
            yield start, len(text), "comment"
            return
        if group in ("comment", "number", "string"):
            yield start, at, group  # type: ignore[misc]
        elif group == "op":
            yield start, at, "symbol"
        else:
            kind = _kind_of_name(match[0], before, text, at)
            if kind is not None:
                yield start, at, kind
        before = match[0] if group != "comment" else before


def _kind_of_name(name: str, before: str, text: str, end: int) -> RunKind | None:
    """`before` is the token in front of the name; `end` the place behind it."""
    if before == ".":
        return "builtin" if name in _METHODS else None
    if before == "::":
        return "builtin"
    if name in KEYWORDS or (name in SPECIAL_DOCS and _opens_statement(before, text, end)):
        return "keyword"
    if name in _SPACES and text[end : end + 2] == "::":
        return "builtin"
    return "builtin" if name in HOST.functions or name in HOST.constants else None


def _opens_statement(before: str, text: str, end: int) -> bool:
    """Whether `include` or `export` means itself here: `include(`, `export name`."""
    after = text[end : end + 80].lstrip()[:1]
    return before in ("", ";", "}") and (after in ("(", "_") or after.isalpha())
