"""The formatter: the one layout of a program, as the paper writes its own.

Braces on lines of their own, four spaces a level, one statement a line, at most one empty line in a
row. What the author decides stays: a body of one statement on one line, a statement on the line of
its `if`, the breaks inside of parentheses, every comment. Only space is changed, never a token.
"""

from __future__ import annotations

from .diagnostics import DiagnosticBag, Notice, ProgramError
from .format_pieces import Comment, Piece, content_of, read_pieces
from .format_spaces import Spacing
from .format_tree import (
    Block,
    Control,
    Node,
    Run,
    Switch,
    build_layout,
    first_piece,
    fits_one_line,
    last_piece,
    stays_on_line,
)
from .parse import parse_source
from .source import SourceFile, Span

STEP = 4
_JOINS_LINE = frozenset((",", ";", ".", "::", "if"))
"""Tokens that no line begins with; `if` is that of `else if`."""


def format_source(text: str, file_name: str, language: str = "en") -> str:
    """`text` in the standard layout: lines end in `\\n`, without a byte order mark.

    Formatting twice is formatting once, and the result parses to the same tree. Raises ProgramError
    for a text that does not parse.
    """
    source = SourceFile.from_text(file_name, text)
    bag = DiagnosticBag(language)
    parse_source(source, bag)
    if bag.error_count:
        raise ProgramError(bag.in_order())
    pieces = read_pieces(source)
    made = _Printer().print_program(pieces)
    if content_of(read_pieces(SourceFile.from_text(file_name, made))) != content_of(pieces):
        place = Span(file_name, 1, 1, 1, 1)
        bag.add(Notice("E900", place, {"kind": "formatter", "command": f"trg fmt {file_name}"}, "repeat"))
        raise ProgramError(bag.in_order())
    return made


class _Writer:
    """Lines being written; `indent` is that of the current line."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.line = ""
        self.indent = 0

    def new_line(self, indent: int, blank: bool = False) -> None:
        """Begin a line, after an empty one if `blank`; a line without text is used as it is."""
        if self.line.strip():
            self.lines.append(self.line.rstrip())
        if blank and self.lines and self.lines[-1]:
            self.lines.append("")
        self.line = " " * indent
        self.indent = indent

    def write(self, text: str) -> None:
        self.line += text

    def write_comment(self, comment: Comment) -> None:
        """The comment at the current place; its further lines move with the first."""
        first, *rest = comment.text.split("\n")
        shift = len(self.line) - comment.col
        self.line += first
        for line in rest:
            self.lines.append(self.line.rstrip())
            line = line.expandtabs(STEP)
            body = line.lstrip(" ")
            self.line = " " * max(0, len(line) - len(body) + shift) + body

    @property
    def is_fresh(self) -> bool:
        """Whether nothing stands on the current line yet."""
        return not self.line.strip()


class _Printer:
    def __init__(self) -> None:
        self.out = _Writer()

    def print_program(self, pieces: list[Piece]) -> str:
        self._statements(build_layout(pieces), 0)
        self._lead(pieces[-1], 0, first=not pieces[:-1])
        self.out.new_line(0)
        return "".join(line + "\n" for line in self.out.lines)

    # Statements.

    def _statements(self, statements: tuple[Node, ...], indent: int, after: Piece | None = None) -> None:
        """Statements on lines of their own; a lone `;` stays behind the block that it follows."""
        for number, node in enumerate(statements):
            first = first_piece(node)
            joined = number > 0 and first.text == ";" and first.breaks == 0 and not first.comments
            if not (joined and last_piece(statements[number - 1]).text == "}"):
                self._lead(first, indent, first=number == 0)
            self._node(node, indent)

    def _lead(self, piece: Piece, indent: int, first: bool = False) -> None:
        """The comments before a statement, and the line that it begins."""
        out = self.out
        for comment in piece.comments:
            if comment.newlines == 0 and (out.lines or not out.is_fresh):
                out.write("" if out.is_fresh else "  ")
            else:
                out.new_line(indent, comment.newlines > 1 and not first)
                first = False
            out.write_comment(comment)
        follows = bool(piece.comments) and piece.newlines == 0 and piece.comments[-1].newlines > 0
        if follows and not piece.comments[-1].ends_line and piece.text != "}":
            out.write(" ")
        else:
            blank = piece.newlines > 1 and not first and piece.text != "}" and piece.kind != "end"
            out.new_line(indent, blank)

    def _node(self, node: Node, indent: int) -> None:
        """A node whose place on the line is made."""
        match node:
            case Run():
                self._run(node, indent)
            case Block():
                self._block(node, indent)
            case Control():
                self._control(node, indent)
            case Switch():
                self._switch(node, indent)

    def _block(self, block: Block, indent: int) -> None:
        self.out.write("{")
        if fits_one_line(block):
            self._one_line(block, indent)
            return
        self._statements(block.statements, indent + STEP)
        self._close(block.closing, block.statements, indent)

    def _close(self, closing: Piece, inside: tuple[Node, ...], indent: int) -> None:
        """The `}` of a block on its line, its comments indented as the statements are."""
        if closing.comments:
            self._lead(Piece("op", "}", 0, closing.comments, 1), indent + STEP, first=not inside)
        self.out.new_line(indent)
        self.out.write("}")

    def _one_line(self, block: Block, indent: int) -> None:
        for node in block.statements:
            self._inline_comments(first_piece(node), indent)
            self.out.write(" ")
            self._node(node, indent)
        self._inline_comments(block.closing, indent)
        self.out.write(" }" if self.out.line[-1] != "{" else "}")

    def _inline_comments(self, piece: Piece, indent: int) -> None:
        for comment in piece.comments:
            self.out.write(" ")
            self.out.write_comment(comment)

    def _control(self, node: Control, indent: int) -> None:
        start = len(self.out.lines)
        for number, (head, body) in enumerate(node.branches):
            if number:
                word = first_piece(head)
                behind = word.breaks == 0 and not any(c.ends_line for c in word.comments)
                if behind and len(self.out.lines) == start:
                    self._inline_comments(word, indent)
                    self.out.write(" ")
                else:
                    self._lead(word, indent, first=True)
            self._run(head, indent)
            self._body(body, indent)

    def _body(self, node: Node, indent: int) -> None:
        """What belongs to a head: a block below it, or a statement behind or below it."""
        first = first_piece(node)
        behind = first.breaks == 0 and first.newlines == 0 and not any(c.ends_line for c in first.comments)
        block = isinstance(node, Block)
        if first.text == ";" and behind:
            self._inline_comments(first, indent)
            self._node(node, indent)
        elif behind and (stays_on_line(node) or not block):
            self._inline_comments(first, indent)
            self.out.write(" ")
            self._node(node, indent)
        else:
            inner = indent if block else indent + STEP
            self._lead(first, inner, first=True)
            self._node(node, inner)

    def _switch(self, node: Switch, indent: int) -> None:
        self._run(node.head, indent)
        self._lead(node.opening, indent, first=True)
        self.out.write("{")
        for number, (label, statements) in enumerate(node.cases):
            self._lead(first_piece(label), indent + STEP, first=number == 0)
            self._run(label, indent + STEP)
            if _case_stays(label, statements):
                for statement in statements:
                    self._inline_comments(first_piece(statement), indent)
                    self.out.write(" ")
                    self._node(statement, indent + STEP)
            else:
                self._statements(statements, indent + 2 * STEP)
        self._close(node.closing, (node.head,) if node.cases else (), indent)

    # Tokens of a statement.

    def _run(self, run: Run, indent: int) -> None:
        """The tokens of a statement or head; the first one's place is made."""
        spacing = Spacing()
        opened: list[int] = []
        heads: list[int] = []
        for number, part in enumerate(run.parts):
            if isinstance(part, Block):
                self._function_body(part, heads.pop())
                spacing.after_body(part.closing)
                continue
            closes = part.kind == "op" and part.text in (")", "]")
            if closes and opened:
                opened.pop()
            apart = spacing.take(part)
            if number:
                steps = len(set(opened)) or int(not closes)
                self._place(part, apart, indent + STEP * steps)
            self.out.write(part.text)
            if part.kind == "keyword" and part.text == "function":
                heads.append(self.out.indent)
            if part.text in ("(", "[") and part.kind == "op":
                opened.append(len(self.out.lines))

    def _place(self, piece: Piece, apart: bool, indent: int) -> None:
        """The comments and the space or line break before a token within a statement."""
        out, broken = self.out, False
        for comment in piece.comments:
            if broken or comment.newlines:
                out.new_line(indent)
            elif comment.ends_line or not out.line.endswith(("(", "[")):
                out.write("  " if comment.ends_line else " ")
            out.write_comment(comment)
            broken = comment.ends_line
        joins = piece.kind != "string" and piece.text in _JOINS_LINE
        if broken or (piece.newlines and not joins and not _is_glued(out.line)):
            out.new_line(indent)
        elif apart or (piece.comments and not joins and piece.text != ")"):
            out.write(" ")

    def _function_body(self, block: Block, indent: int) -> None:
        """A body behind its parameters when it fits there, else below, as far in as `function`'s line."""
        opening = block.opening
        if fits_one_line(block) and opening.breaks == 0 and not opening.comments:
            self.out.write(" ")
        else:
            self._lead(opening, indent, first=True)
        self._block(block, indent)


def _is_glued(line: str) -> bool:
    """Whether the next token must follow at once: a break after `.` or `#` helps nobody."""
    return line.endswith((".", "::", "#")) and not line.endswith("*/")


def _case_stays(label: Run, statements: tuple[Node, ...]) -> bool:
    """Whether the statements of a case were written behind its label, on one line."""
    if not statements or first_piece(statements[0]).line != last_piece(label).line:
        return False
    last = last_piece(statements[-1])
    return last.line == last_piece(label).line and all(stays_on_line(node) for node in statements)
