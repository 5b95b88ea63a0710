"""The layout tree of a text: how tokens group into statements, blocks and bodies.

It is made of the tokens of a program that parses, so it looks only at what tells statements apart,
and it keeps every token: parentheses, semicolons, empty statements.
"""

from __future__ import annotations

from dataclasses import dataclass

from .format_pieces import Piece


@dataclass(frozen=True, slots=True)
class Run:
    """Tokens of one statement or head in order; a Block among them is the body of a function."""

    parts: tuple[Piece | Block, ...]


@dataclass(frozen=True, slots=True)
class Block:
    opening: Piece
    statements: tuple[Node, ...]
    closing: Piece


@dataclass(frozen=True, slots=True)
class Control:
    """`if`, `while`, `for`: heads with their bodies; an `else` is a head of its own."""

    branches: tuple[tuple[Run, Node], ...]


@dataclass(frozen=True, slots=True)
class Switch:
    """Each case is its label up to the colon and its statements."""

    head: Run
    opening: Piece
    cases: tuple[tuple[Run, tuple[Node, ...]], ...]
    closing: Piece


Node = Run | Block | Control | Switch


def first_piece(node: Node | Piece) -> Piece:
    """The first token of a node."""
    match node:
        case Piece():
            return node
        case Run():
            return first_piece(node.parts[0])
        case Block():
            return node.opening
        case Control():
            return first_piece(node.branches[0][0])
        case Switch():
            return first_piece(node.head)


def last_piece(node: Node | Piece) -> Piece:
    """The last token of a node."""
    match node:
        case Piece():
            return node
        case Run():
            return last_piece(node.parts[-1])
        case Block() | Switch():
            return node.closing
        case Control():
            return last_piece(node.branches[-1][1])


class _Builder:
    def __init__(self, pieces: list[Piece]) -> None:
        self.pieces = pieces
        self.at = 0

    @property
    def text(self) -> str:
        piece = self.pieces[self.at]
        return piece.text if piece.kind in ("op", "keyword") else ""

    def next(self) -> Piece:
        self.at += 1
        return self.pieces[self.at - 1]

    def statements(self, ends: tuple[str, ...]) -> tuple[Node, ...]:
        found: list[Node] = []
        while self.pieces[self.at].kind != "end" and self.text not in ends:
            found.append(self.statement())
        return tuple(found)

    def statement(self) -> Node:
        match self.text:
            case "{":
                return self.block()
            case "if":
                return self.conditional()
            case "while" | "for":
                head = self.head()
                return Control(((head, self.statement()),))
            case "switch":
                return self.switch()
        return self.run(";")

    def block(self) -> Block:
        opening = self.next()
        statements = self.statements(("}",))
        return Block(opening, statements, self.next())

    def head(self, *before: Piece) -> Run:
        """A keyword and its parentheses."""
        keyword = self.next()
        inside = self.run(")", self.next())
        return Run((*before, keyword, *inside.parts))

    def conditional(self) -> Control:
        branches = [(self.head(), self.statement())]
        while self.text == "else":
            word = self.next()
            if self.text == "if":
                branches.append((self.head(word), self.statement()))
            else:
                branches.append((Run((word,)), self.statement()))
                break
        return Control(tuple(branches))

    def switch(self) -> Switch:
        head, opening = self.head(), self.next()
        cases = []
        while self.text != "}":
            label = self.run(":")
            cases.append((label, self.statements(("case", "default", "}"))))
        return Switch(head, opening, tuple(cases), self.next())

    def run(self, end: str, *opened: Piece) -> Run:
        """Tokens up to and with `end`, outside of inner brackets."""
        parts: list[Piece | Block] = list(opened)
        depth = 0
        while self.pieces[self.at].kind != "end":
            text = self.text
            if text == "{":
                parts.append(self.block())
                continue
            parts.append(self.next())
            if depth == 0 and text == end:
                break
            depth += (text in ("(", "[")) - (text in (")", "]"))
        return Run(tuple(parts))


def build_layout(pieces: list[Piece]) -> tuple[Node, ...]:
    """The statements of a text that parses."""
    return _Builder(pieces).statements(())


def fits_one_line(block: Block) -> bool:
    """Whether a block was written on one line and holds no more than one statement there."""
    if block.opening.line != block.closing.line or len(block.statements) > 1:
        return False
    if any(c.ends_line for c in block.closing.comments):
        return False
    return all(stays_on_line(node) for node in block.statements)


def stays_on_line(node: Node) -> bool:
    """Whether a node was written on one line, and every block in it may stay there."""
    if first_piece(node).line != last_piece(node).line:
        return False
    match node:
        case Run():
            return all(fits_one_line(part) for part in node.parts if isinstance(part, Block))
        case Block():
            return fits_one_line(node)
        case Control():
            return all(stays_on_line(n) for branch in node.branches for n in branch)
        case Switch():
            return False
