"""Diagnostics: what is wrong, where, and what to type instead; and how they are shown."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Literal

from .messages import hint_text, message_text
from .source import SourceFile, Span

Severity = Literal["error", "warning", "lint"]

MAX_ERRORS = 20
_SHOWN_COLUMNS = 160
_SHOWN_CALLS = 8


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding. `code` is stable; `stack` holds the calls that led here, innermost first."""

    code: str
    severity: Severity
    message: str
    span: Span
    hint: str | None = None
    related: tuple[tuple[Span, str], ...] = ()
    stack: tuple[tuple[str, Span], ...] = ()
    fix: tuple[Span, str] | None = None


class ProgramError(Exception):
    """The program cannot be run; `diagnostics` holds every error found, in source order.

    `sources` are the texts that they point into, as far as they were read.
    """

    def __init__(
        self, diagnostics: tuple[Diagnostic, ...], sources: Mapping[str, SourceFile] | None = None
    ) -> None:
        super().__init__("; ".join(f"{d.span}: {d.message}" for d in diagnostics[:3]))
        self.diagnostics = diagnostics
        self.sources = dict(sources or {})


@dataclass(frozen=True, slots=True)
class Notice:
    """What to say about one place, before it is put into words of a language."""

    code: str
    span: Span
    values: Mapping[str, object]
    hint: str | None = None
    hint_values: Mapping[str, object] | None = None
    related: tuple[tuple[Span, str], ...] = ()
    fix: tuple[Span, str] | None = None


class DiagnosticBag:
    """Collects diagnostics: one for each place and code, errors up to MAX_ERRORS."""

    def __init__(self, language: str = "en") -> None:
        self.language = language
        self.items: list[Diagnostic] = []
        self._seen: set[tuple[str, Span]] = set()

    @property
    def error_count(self) -> int:
        return sum(item.severity == "error" for item in self.items)

    @property
    def full(self) -> bool:
        return self.error_count >= MAX_ERRORS

    def add(self, notice: Notice, severity: Severity = "error") -> Diagnostic | None:
        """Add what `notice` says; None when that place was reported before or the bag is full."""
        key = (notice.code, notice.span)
        if key in self._seen or (severity == "error" and self.full):
            return None
        self._seen.add(key)
        made = build_diagnostic(notice, severity, self.language)
        self.items.append(made)
        return made

    def take(self, made: Diagnostic) -> None:
        """Add a diagnostic of another bag; nothing when that place has it or this bag is full."""
        key = (made.code, made.span)
        if key in self._seen or (made.severity == "error" and self.full):
            return
        self._seen.add(key)
        self.items.append(made)

    def in_order(self) -> tuple[Diagnostic, ...]:
        """All of them by file, line and column; files in the order in which they were met."""
        files = {d.span.file: n for n, d in reversed(list(enumerate(self.items)))}
        place = lambda d: (files[d.span.file], d.span.line, d.span.col)  # noqa: E731
        return tuple(sorted(self.items, key=place))


def build_diagnostic(notice: Notice, severity: Severity, language: str) -> Diagnostic:
    """Put a notice into words. Unknown codes raise KeyError: the table is incomplete."""
    hint = None
    if notice.hint is not None:
        hint = hint_text(notice.hint, language, notice.hint_values or notice.values)
    related = tuple((span, hint_text(key, language, notice.values)) for span, key in notice.related)
    text = message_text(notice.code, language, notice.values)
    return Diagnostic(notice.code, severity, text, notice.span, hint, related=related, fix=notice.fix)


def closest(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate that `name` may be a typing error of, or None."""
    near = [c for c in candidates if abs(len(c) - len(name)) <= 2][:1000]
    folded = {c.lower(): c for c in near}
    if name.lower() in folded:
        return folded[name.lower()]
    found = get_close_matches(name, near, n=1, cutoff=0.7)
    return found[0] if found else None


def is_certain(name: str, guess: str, candidates: Iterable[str]) -> bool:
    """Whether no other candidate comes near `name`, so that a tool may replace it by `guess`."""
    near = get_close_matches(
        name, [c for c in candidates if abs(len(c) - len(name)) <= 2][:1000], n=2, cutoff=0.7
    )
    return all(found == guess for found in near)


def render_diagnostic(diagnostic: Diagnostic, sources: Mapping[str, SourceFile]) -> str:
    """The diagnostic as lines of text: the place, the source line with carets, the hint, the calls."""
    d = diagnostic
    lines = [f"{d.span}: {d.severity}: {d.message}", *_excerpt(d.span, sources)]
    if d.hint:
        lines.append(f"     = {d.hint}")
    for span, text in d.related:
        lines.append(f"     {text}: {span}")
    for name, span in d.stack[:_SHOWN_CALLS]:
        lines.append(f"     called from {name}, {span}")
    if len(d.stack) > _SHOWN_CALLS:
        lines.append(f"     ... and {len(d.stack) - _SHOWN_CALLS} more calls")
    return "\n".join(lines)


def _excerpt(span: Span, sources: Mapping[str, SourceFile]) -> list[str]:
    source = sources.get(span.file)
    if source is None or not 1 <= span.line <= len(source.lines):
        return []
    text = source.lines[span.line - 1].replace("\t", " ")
    end = span.end_col if span.end_line == span.line else len(text) + 1
    first = max(0, span.col - _SHOWN_COLUMNS // 2) if len(text) > _SHOWN_COLUMNS else 0
    shown = text[first : first + _SHOWN_COLUMNS]
    width = max(1, min(end - span.col, len(shown) - (span.col - 1 - first)))
    gutter = f"{span.line:4d} | "
    return [gutter + shown, " " * 5 + "| " + " " * (span.col - 1 - first) + "^" * width]
