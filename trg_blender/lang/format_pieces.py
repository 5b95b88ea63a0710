"""The formatter's view of a text: tokens with the comments and line breaks before each.

Comments are no tokens of the language; they lie in the gaps between tokens.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from .diagnostics import DiagnosticBag
from .scan import scan_source
from .source import SourceFile

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_OVERLOAD_AND_ASSIGN = ("+=", "-=", "*=", "/=", "%=")


@dataclass(frozen=True, slots=True)
class Comment:
    """`newlines` stand before it; `col` is its first column, from 0."""

    text: str
    newlines: int
    col: int

    @property
    def ends_line(self) -> bool:
        return self.text.startswith("//")

    @property
    def content(self) -> tuple[str, ...]:
        """The comment without what indentation may change: equal for the same comment."""
        return tuple(line.strip() for line in self.text.split("\n"))


@dataclass(frozen=True, slots=True)
class Piece:
    """A token, the comments before it, and the line breaks directly before it."""

    kind: str
    text: str
    line: int
    comments: tuple[Comment, ...]
    newlines: int

    @property
    def breaks(self) -> int:
        """Line breaks between the token before and whatever comes first: a comment or the token."""
        return self.comments[0].newlines if self.comments else self.newlines


def read_pieces(source: SourceFile) -> list[Piece]:
    """The pieces of a text that scans without errors; the last has kind `end`.

    `operator+=` is two tokens here as it is for the parser: the field `operator+` and `=`.
    """
    starts = [0]
    for line in source.lines:
        starts.append(starts[-1] + len(line) + 1)
    pieces: list[Piece] = []
    end = 0
    for token in scan_source(source, DiagnosticBag()):
        span = token.span
        start = starts[span.line - 1] + span.col - 1
        comments, newlines = _read_gap(source.text, end, start)
        end = starts[span.end_line - 1] + span.end_col - 1
        whole = Piece(token.kind, source.text[start:end], span.line, comments, newlines)
        follows_operator = bool(pieces) and pieces[-1].text == "operator"
        pieces += _split_assignment(whole) if follows_operator else [whole]
    return pieces


def _split_assignment(piece: Piece) -> list[Piece]:
    if piece.text not in _OVERLOAD_AND_ASSIGN:
        return [piece]
    return [replace(piece, text=piece.text[0]), Piece("op", "=", piece.line, (), 0)]


def _read_gap(text: str, start: int, end: int) -> tuple[tuple[Comment, ...], int]:
    """The comments between two tokens and the line breaks behind the last one."""
    comments: list[Comment] = []
    at = start
    while match := _COMMENT.search(text, at, end):
        newlines = text.count("\n", at, match.start())
        col = match.start() - (text.rfind("\n", 0, match.start()) + 1)
        comments.append(Comment(match.group(), newlines, col))
        at = match.end()
    return tuple(comments), text.count("\n", at, end)


def content_of(pieces: list[Piece]) -> list[tuple[object, ...]]:
    """What formatting must not change: the tokens and the comments, in order."""
    found: list[tuple[object, ...]] = []
    for piece in pieces:
        found += [comment.content for comment in piece.comments]
        found.append((piece.kind, piece.text))
    return found
