"""What an editor needs to know of a program, faulty or not; nothing is run.

Places are lines and columns as spans have them: from 1, in characters.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from . import ast
from .bind import HOST
from .diagnostics import Diagnostic, DiagnosticBag, Notice
from .files import FileResolver, NoFiles
from .program import understand, without_consequences
from .resolve import FunctionInfo, Resolution
from .scan import Token, scan_source
from .source import SourceFile, Span


@dataclass(frozen=True, slots=True)
class Word:
    """The name at a place. `before` is the sign in front of it (`.`, `#`, `~` or empty)."""

    name: str
    span: Span
    before: str
    index: int
    """Of its first token."""


@dataclass(frozen=True, slots=True)
class Analysis:
    """A program as far as it was understood."""

    main: str
    sources: dict[str, SourceFile]
    trees: tuple[ast.FileTree, ...]
    resolution: Resolution
    tokens: tuple[Token, ...]
    """Of the main file."""
    diagnostics: tuple[Diagnostic, ...]

    def function_at(self, line: int, col: int) -> FunctionInfo | None:
        """The innermost function of the main file around a place; None at the top level."""
        found: FunctionInfo | None = None
        for info in self.resolution.functions.values():
            if info.file == self.main and _covers(info.node.span, line, col):
                if found is None or _covers(found.node.span, info.node.span.line, info.node.span.col):
                    found = info
        return found

    def token_index(self, line: int, col: int) -> int | None:
        """The token that a place lies in or just behind; a name wins over a sign."""
        touching = [n for n, t in enumerate(self.tokens) if t.kind != "end" and _covers(t.span, line, col)]
        words = [n for n in touching if self.tokens[n].kind in ("name", "keyword", "string")]
        return next(iter(words or touching), None)

    def word_at(self, line: int, col: int) -> Word | None:
        """The name or keyword at a place, `space::name` as a whole."""
        index = self.token_index(line, col)
        if index is None or self.tokens[index].kind not in ("name", "keyword"):
            return None
        first = last = index
        while first >= 2 and self._text(first - 1) == "::" and self.tokens[first - 2].kind == "name":
            first -= 2
        while self._text(last + 1) == "::" and self.tokens[last + 2].kind == "name":
            last += 2
        names = [t.text for t in self.tokens[first : last + 1] if t.text != "::"]
        before = self._text(first - 1)
        span = self.tokens[first].span.to(self.tokens[last].span)
        return Word("::".join(names), span, before if before in (".", "#", "~") else "", first)

    def _text(self, index: int) -> str:
        return self.tokens[index].text if 0 <= index < len(self.tokens) else ""

    # What a name means.

    def definition(self, word: Word, context: FunctionInfo | None) -> Span | None:
        """Where the variable, parameter or field of that name is first assigned."""
        if word.before == ".":
            return self.fields().get(word.name)
        local = word.before != "#" and "::" not in word.name
        if context is not None and local and word.name in context.locals:
            return context.locals[word.name]
        return self.resolution.globals.get(word.name)

    def fields(self) -> dict[str, Span]:
        """The fields that the program assigns, with the place of the first time."""
        found: dict[str, Span] = {}
        for node in self.expressions():
            if isinstance(node, ast.Assign) and isinstance(node.target, ast.Field):
                found.setdefault(node.target.name, node.target.span)
        return found

    def expressions(self) -> Iterator[ast.Expr]:
        """Every expression of the program."""
        for nodes in self.resolution.top.values():
            yield from nodes
        for info in self.resolution.functions.values():
            yield from info.expressions

    def value_of(self, name: str, context: FunctionInfo | None) -> ast.Expr | None:
        """The first value that is assigned to a variable."""
        nodes = context.expressions if context is not None and name in context.locals else None
        for node in self.expressions() if nodes is None else nodes:
            if isinstance(node, ast.Assign) and node.op == "=" and isinstance(node.target, ast.Path):
                if node.target.name == name:
                    return node.value
        return None

    def kind_of(self, node: ast.Expr | None, context: FunctionInfo | None, depth: int = 0) -> str:
        """The type of a value as far as the text tells it, else an empty string."""
        if node is None or depth > 8:
            return ""
        match node:
            case ast.Number():
                return "num"
            case ast.String():
                return "str"
            case ast.Function():
                return "function"
            case ast.Path():
                return self.kind_of_variable(node.name, context, depth)
            case ast.Call():
                return self._kind_of_call(node, context, depth)
            case ast.Binary():
                kinds = {self.kind_of(n, context, depth + 1) for n in (node.left, node.right)}
                return "vec3" if "vec3" in kinds else ""
        return ""

    def kind_of_variable(self, name: str, context: FunctionInfo | None, depth: int = 0) -> str:
        """The type of a variable: its parameter's, else that of the first value assigned to it."""
        if context is not None:
            for parameter in context.node.parameters:
                if parameter.name == name:
                    return parameter.type_name or self.kind_of(parameter.default, context, depth + 1)
        return self.kind_of(self.value_of(name, context), context, depth + 1)

    def _kind_of_call(self, node: ast.Call, context: FunctionInfo | None, depth: int) -> str:
        callee = node.callee
        if isinstance(callee, ast.Path) and callee.name in HOST.functions:
            return _known_type(HOST.functions[callee.name].result)
        if isinstance(callee, ast.Field):
            owner = self.kind_of(callee.object, context, depth + 1)
            row = HOST.methods.get((owner, callee.name))
            return "" if row is None else _known_type(row.result)
        return ""


def _known_type(result: str) -> str:
    return "" if result in ("any", "anything", "undef") else result


def _covers(span: Span, line: int, col: int) -> bool:
    return (span.line, span.col) <= (line, col) <= (span.end_line, span.end_col)


def analyse_source(
    text: str, file_name: str, resolver: FileResolver | None = None, language: str = "en"
) -> Analysis:
    """Understand a text as far as it goes. Errors are in `diagnostics`; none is raised."""
    bag = DiagnosticBag(language)
    source = SourceFile.from_text(file_name, text)
    tokens = tuple(scan_source(source, DiagnosticBag()))
    try:
        loader, resolution = understand(source, resolver or NoFiles(), bag)
    except RecursionError:
        bag.add(Notice("E220", Span(file_name, 1, 1, 1, 1), {"limit": "stack"}))
        return Analysis(file_name, {file_name: source}, (), Resolution(HOST.names), tokens, bag.in_order())
    return Analysis(
        file_name, loader.sources, tuple(loader.trees), resolution, tokens, without_consequences(bag)
    )
