"""Where things stand in an author's text: source files and spans."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple


class Span(NamedTuple):
    """A stretch of a source text. Lines and columns are 1-based and count characters.

    A tuple, since compiling a long program makes and compares hundreds of thousands.
    """

    file: str
    line: int
    col: int
    end_line: int
    end_col: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.col}"

    def to(self, end: Span) -> Span:
        """The span from the start of this one to the end of `end`."""
        return tuple.__new__(Span, (*self[:3], *end[3:]))


@dataclass(frozen=True, slots=True)
class SourceFile:
    """A text as the scanner sees it: no byte order mark, every line ended by `\\n`."""

    name: str
    text: str
    lines: tuple[str, ...] = field(repr=False)

    @staticmethod
    def from_text(name: str, text: str) -> SourceFile:
        text = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
        return SourceFile(name, text, tuple(text.split("\n")))
