"""A cursor over tokens: what the statement and expression parsers share."""

from __future__ import annotations

from .diagnostics import DiagnosticBag, Notice
from .scan import Token
from .source import Span

MAX_LEVELS = 64
MAX_DEPTH = 200
MAX_CHAIN = 400
MAX_LINKS = 100
MAX_ARGUMENTS = 255
MAX_ELEMENTS = 1000
"""Elements of one list literal; longer lists are appended to."""

_WORDS = ("op", "keyword")


class SyntaxStop(Exception):
    """A syntax error was reported; the parser goes on at the next statement."""


class Cursor:
    """Reads tokens, reports what is missing, and counts nesting levels."""

    def __init__(self, tokens: list[Token], bag: DiagnosticBag) -> None:
        self.tokens = tokens
        self.bag = bag
        self.at = 0
        self.token = tokens[0]
        """The next token, `tokens[at]`."""
        self.statement_start = 0
        self.levels = 0

    @property
    def previous(self) -> Span:
        return self.tokens[max(0, self.at - 1)].span

    def next(self) -> Token:
        token = self.token
        if token.kind != "end":
            self.at += 1
            self.token = self.tokens[self.at]
        return token

    def go_to_end(self) -> None:
        self.at = len(self.tokens) - 1
        self.token = self.tokens[self.at]

    def put(self, token: Token) -> None:
        """Put another token in the place of the next."""
        self.tokens[self.at] = self.token = token

    def sees(self, text: str) -> bool:
        """Whether the next token is this operator or keyword."""
        token = self.token
        return token.text == text and token.kind in _WORDS

    def accept(self, text: str) -> bool:
        token = self.token
        if token.text == text and token.kind in _WORDS:
            self.at += 1
            self.token = self.tokens[self.at]
            return True
        return False

    def expect(self, text: str) -> Token:
        """The next token, which must be `text`; the error stands just behind the token before it."""
        token = self.token
        if token.text == text and token.kind in _WORDS:
            self.at += 1
            self.token = self.tokens[self.at]
            return token
        if text == ";" and self.sees(")"):
            raise self.error("E202", self.token.span, self._closes_too_early(), text=")")
        before = self.previous
        place = Span(before.file, before.end_line, before.end_col, before.end_line, before.end_col)
        fix = (place, text) if text == ";" else None
        notice = Notice("E201", place, {"text": text}, None, fix=fix)
        self.bag.add(notice)
        raise SyntaxStop

    def expect_name(self) -> Token:
        token = self.token
        if token.kind == "name":
            return self.next()
        code = "E204" if token.kind == "keyword" else "E203"
        raise self.error(code, token.span, text=token.text)

    def error(self, code: str, span: Span, hint: Notice | str | None = None, **values: object) -> SyntaxStop:
        """Report an error; the caller raises what this returns, to give the statement up."""
        if isinstance(hint, Notice):
            self.bag.add(Notice(code, span, values, hint.hint, hint.hint_values))
        else:
            self.bag.add(Notice(code, span, values, hint))
        return SyntaxStop()

    def enter(self) -> None:
        """One nesting level more; raises SyntaxStop above the limit."""
        self.levels += 1
        if self.levels > MAX_LEVELS:
            raise self.error("E220", self.token.span, "split_nesting", limit=MAX_LEVELS)

    def leave(self) -> None:
        self.levels -= 1

    def depth_above(self, deepest: int) -> int:
        """The depth of a node over children at most so deep; raises SyntaxStop above the limit."""
        depth = 1 + deepest
        if depth > MAX_DEPTH:
            raise self.error("E220", self.token.span, "split_nesting", limit=MAX_DEPTH)
        return depth

    def _closes_too_early(self) -> Notice | None:
        """A hint naming the first `)` of the statement that closes an inner parenthesis."""
        depth = 0
        for token in self.tokens[self.statement_start : self.at]:
            if token.kind != "op":
                continue
            if token.text == "(":
                depth += 1
            elif token.text == ")":
                depth -= 1
                if depth == 1:
                    place = f"{token.span.line}:{token.span.col}"
                    return Notice("", token.span, {}, "closes_too_early", {"place": place})
        return None

    def skip_statement(self) -> None:
        """After an error: behind the next `;` or block, or before the `}` that ends this block.

        An `else` that follows belongs to the statement that was given up.
        """
        depth = 0
        while self.token.kind != "end":
            if depth == 0 and self.sees("}"):
                return
            token = self.next()
            if token.kind != "op":
                continue
            if token.text == "{":
                depth += 1
            elif token.text == "}":
                depth -= 1
                if depth == 0 and not self.sees("else"):
                    self.accept(";")
                    return
            elif token.text == ";" and depth == 0 and not self.sees("else"):
                return

    def skip_to(self, *words: str) -> None:
        """After an error: before one of `words` or the `}` that ends this block."""
        depth = 0
        while self.token.kind != "end":
            if depth == 0 and any(map(self.sees, (*words, "}"))):
                return
            token = self.next()
            if token.kind == "op" and token.text in "{}":
                depth += 1 if token.text == "{" else -1
