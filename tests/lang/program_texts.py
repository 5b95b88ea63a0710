"""Random programs that parse, as texts: every construct, with comments and breaks anywhere."""

from __future__ import annotations

from collections.abc import Iterable
from random import Random

from hypothesis import strategies as st

NAMES = ("a", "b", "Scene", "шар", "x1", "_", "material::gold", "# a", "#my::x", "mth :: PI")
FIELDS = ("f", "x", "operator +", "operator ==", "operator <", "Радиус")
NUMBERS = ("1", "0.75", ".5", "1.", "1e3", "20")
STRINGS = ('"num"', '"// no comment"', '"a\\\\b /* "', '"\\n"', '""', '"шар 🎈"')
BINARY = ("+", "-", "*", "/", "%", "<", ">", "<=", ">=", "==", "!=", "&&", "||")
GAPS = (
    (" ",) * 14
    + ("", "  ", "\n", "\n\n\n", "\t", "\n    ")
    + (" // note\n", "\n// own line\n\n", "// \n", "/* in */", "/**/")
    + ("\n/* two\n   lines */\n", " /*\n\tx\n*/ ")
)


class _Writer:
    """Writes tokens of the grammar of docs/language.md at random, no deeper than its limits."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.tokens: list[str] = []
        self.in_loop = 0

    def put(self, *tokens: str) -> None:
        for token in tokens:
            self.tokens += token.split(" ") if token[0] != '"' else [token]

    def listed(self, count: int, depth: int) -> None:
        for number in range(count):
            if number:
                self.put(",")
            self.expression(depth)

    def target(self, depth: int) -> None:
        self.put(self.random.choice(NAMES))
        if self.random.random() < 0.3:
            self.put(".", self.random.choice(FIELDS))

    def expression(self, depth: int) -> None:
        kinds = ("leaf",) if depth <= 0 else _EXPRESSIONS
        getattr(self, "_" + self.random.choice(kinds))(depth - 1)

    def _leaf(self, _depth: int) -> None:
        self.put(self.random.choice(NAMES + NUMBERS + STRINGS))

    def _binary(self, depth: int) -> None:
        self.expression(depth)
        self.put(self.random.choice(BINARY))
        self._group(depth) if self.random.random() < 0.5 else self._leaf(depth)

    def _group(self, depth: int) -> None:
        self.put("(")
        self.random.choice((self.expression, self._assign))(depth)
        self.put(")")

    def _assign(self, depth: int) -> None:
        self.target(depth)
        self.put(self.random.choice(("=", "+=", "-=", "%=")))
        self.expression(depth)

    def _sign(self, depth: int) -> None:
        self.put(self.random.choice(("-", "+", "!")))
        self.random.choice((self._leaf, self._group, self._sign, self._step))(depth)

    def _step(self, depth: int) -> None:
        op = self.random.choice(("++", "--"))
        if self.random.random() < 0.5:
            self.put(op)
            self.target(depth)
        else:
            self.target(depth)
            self.put(op)

    def _call(self, depth: int) -> None:
        self.target(depth)
        self.put("(")
        self.listed(self.random.randrange(3), depth)
        self.put(")")

    def _list(self, depth: int) -> None:
        self.put("[")
        self.listed(self.random.randrange(3), depth)
        self.put("]")

    def _index(self, depth: int) -> None:
        self.target(depth)
        self.put("[")
        self.expression(depth)
        self.put("]")

    def _function(self, depth: int) -> None:
        outside, self.in_loop = self.in_loop, 0
        self.put("function", "(")
        for number in range(self.random.randrange(3)):
            self.put(",", f"p{number}") if number else self.put("p0")
            if self.random.random() < 0.4:
                self.put("=")
                self.expression(depth)
            if self.random.random() < 0.4:
                self.put("~", '"num"')
        self.put(")")
        self.block(depth)
        self.in_loop = outside

    def block(self, depth: int) -> None:
        self.put("{")
        for _ in range(self.random.choice((0, 1, 1, 1, 2))):
            self.statement(depth)
        self.put("}")

    def statement(self, depth: int) -> None:
        kinds = ("simple",) if depth <= 0 else _STATEMENTS
        getattr(self, "_" + self.random.choice(kinds))(depth - 1)

    def _simple(self, depth: int) -> None:
        self.random.choice((self.expression, self._assign))(depth)
        self.put(";")

    def _empty(self, _depth: int) -> None:
        self.put(";")

    def _overload(self, _depth: int) -> None:
        self.put("v", ".", "operator", self.random.choice(("+=", "+ =", "< =")), "f", ";")

    def _braces(self, depth: int) -> None:
        self.block(depth)

    def _leave(self, _depth: int) -> None:
        self.put(self.random.choice(("break", "continue")) if self.in_loop else "a", ";")

    def body(self, depth: int) -> None:
        self.random.choice((self.statement, self.block))(depth)

    def _if(self, depth: int) -> None:
        self.put("if", "(")
        self.expression(depth)
        self.put(")")
        self.body(depth)
        if self.random.random() < 0.5:
            self.put("else")
            self.body(depth)

    def _while(self, depth: int) -> None:
        self.put("while", "(")
        self.expression(depth)
        self.put(")")
        self.in_loop += 1
        self.body(depth)
        self.in_loop -= 1

    def _for(self, depth: int) -> None:
        self.put("for", "(")
        for end in (";", ";", ")"):
            if self.random.random() < 0.7:
                self._assign(depth)
            self.put(end)
        self.in_loop += 1
        self.body(depth)
        self.in_loop -= 1

    def _for_each(self, depth: int) -> None:
        self.put("for", "(", "x1", "in")
        self.expression(depth)
        self.put(")")
        self.in_loop += 1
        self.body(depth)
        self.in_loop -= 1

    def _switch(self, depth: int) -> None:
        self.put("switch", "(")
        self.expression(depth)
        self.put(")", "{")
        labels = ["case"] * self.random.randrange(3) + ["default"] * self.random.randrange(2)
        for label in labels:
            self.put(label)
            if label == "case":
                self.expression(depth)
            self.put(":")
            for _ in range(self.random.randrange(3)):
                self.statement(depth)
        self.put("}")


_EXPRESSIONS = (
    "leaf", "binary", "binary", "group", "sign", "step", "call", "call", "function", "list", "index",
)  # fmt: skip
_STATEMENTS = (
    "simple", "simple", "empty", "overload", "braces", "leave", "if", "if", "while", "for", "for_each",
    "switch",
)  # fmt: skip


def _joined(tokens: Iterable[str], random: Random) -> str:
    text = random.choice(GAPS)
    for token in tokens:
        gap = random.choice(GAPS)
        divides = token == "/" and gap.startswith("/")  # would begin a comment of its own
        text += token + (" " if divides else "") + (gap or " ")
    return text


def write_program(seed: int) -> str:
    """The program of a seed: its tokens have anything between them that the language allows."""
    random = Random(seed)
    writer = _Writer(random)
    for _ in range(random.randrange(5)):
        writer.statement(random.randrange(4))
    return _joined(writer.tokens, random)


PROGRAM_TEXTS = st.integers(0, 2**48).map(write_program)
