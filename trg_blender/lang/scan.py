"""The scanner: a source text becomes a list of tokens."""

from __future__ import annotations

import math
import re
import unicodedata
from typing import NamedTuple

from .diagnostics import DiagnosticBag, Notice
from .source import SourceFile, Span

KEYWORDS = frozenset(
    "if else while for in switch case default break continue return function operator".split()
)
RESERVED_WORDS = {"true": "write_1", "false": "write_0"}
_WORDS = KEYWORDS | RESERVED_WORDS.keys()
MAX_NUMBER_LENGTH = 64
MAX_STRING_LENGTH = 65_536
MAX_MARKS = 30
"""Combining marks in a row: what UAX #15 calls stream-safe; NFC takes quadratic time over them."""
ESCAPES = {"n": "\n", "t": "\t", "r": "\r", "0": "\0", '"': '"', "\\": "\\"}

# The string and comment alternatives are unrolled: the short forms need a backtracking entry for
# every character, hundreds of megabytes for one long literal.
TOKEN = re.compile(
    r"""
    (?P<space>[ \t\n\f\v]+)
  | (?P<comment>//[^\n]*|/\*[^*]*\*+(?:[^/*][^*]*\*+)*/)
  | (?P<unclosed>/\*)
  | (?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)
  | (?P<string>"[^"\\\n]*(?:\\.[^"\\\n]*)*")
  | (?P<name>[^\W\d][\w\u0300-\u036f]*)
  | (?P<op>\+\+|--|[-+*/%=!<>]=|&&|\|\||::|[-+*/%=!<>\#~(){}\[\],;.:])
    """,
    re.VERBOSE,
)
_QUOTED = re.compile(r"'[^'\n]*'?")
_REST_OF_NAME = re.compile(r"[\w\u0300-\u036f]+")
_MANY_MARKS = re.compile(rf"[\u0300-\u036f]{{{MAX_MARKS + 1},}}")
_ESCAPE = re.compile(r"\\(.)")
_CHARACTER_HINTS = {
    "'": "double_quotes",
    "&": "write_and",
    "|": "write_or",
    "?": "no_conditional",
    "@": "reserved",
    "$": "reserved",
    "^": "write_pow",
}


class Token(NamedTuple):
    """`kind` is name, keyword, number, string, op or end; `text` as written (names in NFC)."""

    kind: str
    text: str
    value: float | str
    span: Span


class _Scanner:
    def __init__(self, source: SourceFile, bag: DiagnosticBag) -> None:
        self.source = source
        self.bag = bag
        self.tokens: list[Token] = []
        self.line = 1
        self.line_start = 0

    def run(self) -> list[Token]:
        text, position, end = self.source.text, 0, len(self.source.text)
        name, take, new = self.source.name, self.tokens.append, tuple.__new__
        find = TOKEN.match
        while position < end:
            match = find(text, position)
            if match is None:
                position = self._skip_unknown(position)
                continue
            kind = match.lastgroup
            # Operators and plain names are nearly all there is: they take no call.
            if kind == "op" or (kind == "name" and match[0].isascii() and match[0] not in _WORDS):
                written = match[0]
                first = position - self.line_start + 1
                position += len(written)
                span = new(Span, (name, self.line, first, self.line, first + len(written)))
                take(new(Token, (kind, written, written, span)))
            else:
                position = self._take(match)
        self.tokens.append(Token("end", "", "", self._span(end, end)))
        return self.tokens

    def _take(self, match: re.Match[str]) -> int:
        kind, start, end = match.lastgroup or "", match.start(), match.end()
        if kind in ("space", "comment"):
            self._count_lines(start, end)
        elif kind == "unclosed":
            self._error("E106", start, end)
            self._count_lines(start, len(self.source.text))
            return len(self.source.text)
        elif kind == "name":
            self._take_name(match.group(), start, end)
        elif kind == "number":
            return self._take_number(match.group(), start, end)
        elif kind == "string":
            self._take_string(match.group(), start, end)
        return end

    def _take_name(self, text: str, start: int, end: int) -> None:
        name = text if text.isascii() else self._composed(text, start)
        kind = "keyword" if name in KEYWORDS else "name"
        if not (name[0].isalpha() or name[0] == "_"):  # a sign such as a raised 2 is a \\w, but no letter
            self._error("E100", start, start + 1, text=text[0])
        if name in RESERVED_WORDS:
            fix = (start, end, "1" if name == "true" else "0")
            self._error("E107", start, end, RESERVED_WORDS[name], fix, name=name)
        self.tokens.append(Token(kind, name, name, self._span(start, end)))

    def _composed(self, text: str, start: int) -> str:
        """The name in NFC; too many marks on one letter are an error and go."""
        for found in _MANY_MARKS.finditer(text):
            first, last = start + found.start(), start + found.end()
            self._error("E110", first, last, None, limit=MAX_MARKS)
        return unicodedata.normalize("NFC", _MANY_MARKS.sub("", text))

    def _take_number(self, text: str, start: int, end: int) -> int:
        rest = _REST_OF_NAME.match(self.source.text, end)
        if rest is not None:
            self._error("E101", end, end + 1, "split_number")
            end = rest.end()
        value = 0.0
        if len(text) > MAX_NUMBER_LENGTH:
            self._error("E103", start, end, None, limit=MAX_NUMBER_LENGTH)
        else:
            value = float(text)
        if math.isinf(value):
            self._error("E102", start, end)
            value = 0.0
        self.tokens.append(Token("number", text, value, self._span(start, end)))
        return end

    def _take_string(self, text: str, start: int, end: int) -> None:
        body = text[1:-1]
        if "\\" in body:
            for found in _ESCAPE.finditer(body):
                if found.group(1) not in ESCAPES:
                    at = start + 1 + found.start()
                    fix = (at, at + 2, "\\" + found.group())
                    self._error("E105", at, at + 2, "double_backslash", fix, text=found.group())
            body = _ESCAPE.sub(lambda m: ESCAPES.get(m.group(1), m.group()), body)
        if len(body) > MAX_STRING_LENGTH:
            self._error("E108", start, end, None, limit=MAX_STRING_LENGTH)
        self.tokens.append(Token("string", text, body, self._span(start, end)))

    def _skip_unknown(self, start: int) -> int:
        text = self.source.text
        character = text[start]
        if character == '"':
            end = text.find("\n", start)
            end = len(text) if end < 0 else end
            self._error("E104", start, end, "close_string")
            self.tokens.append(Token("string", text[start:end], "", self._span(start, end)))
            return end
        end = start + 1
        if character == "'":
            end = _QUOTED.match(text, start).end()  # type: ignore[union-attr]
        shown = character if character.isprintable() else f"U+{ord(character):04X}"
        fix = _fix_of(text[start:end], start)
        self._error("E100", start, start + 1, _CHARACTER_HINTS.get(character), fix, text=shown)
        return end

    def _count_lines(self, start: int, end: int) -> None:
        newlines = self.source.text.count("\n", start, end)
        if newlines:
            self.line += newlines
            self.line_start = self.source.text.rfind("\n", start, end) + 1

    def _span(self, start: int, end: int) -> Span:
        first = start - self.line_start + 1
        return Span(self.source.name, self.line, first, self.line, first + end - start)

    def _error(
        self, code: str, start: int, end: int, hint: str | None = None,
        fix: tuple[int, int, str] | None = None, **values: object,
    ) -> None:  # fmt: skip
        """Report an error; `fix` says what to put in place of which characters."""
        repair = None if fix is None else (self._span(fix[0], fix[1]), fix[2])
        self.bag.add(Notice(code, self._span(start, end), values, hint, fix=repair))


def _fix_of(text: str, start: int) -> tuple[int, int, str] | None:
    """What `text`, which is no token, was meant to be, if that is certain."""
    if text in ("&", "|"):
        return start, start + 1, text * 2
    if len(text) > 1 and text[-1] == "'" and not set(text) & {'"', "\\"}:
        return start, start + len(text), f'"{text[1:-1]}"'
    return None


def scan_source(source: SourceFile, bag: DiagnosticBag) -> list[Token]:
    """The tokens of `source`, closed by one of kind `end`. Errors go to `bag`; scanning goes on."""
    return _Scanner(source, bag).run()
