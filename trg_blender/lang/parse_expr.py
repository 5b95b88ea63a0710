"""The expression parser: precedence climbing, six Python frames for a nesting level."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from . import ast
from .cursor import MAX_ARGUMENTS, MAX_CHAIN, MAX_ELEMENTS, MAX_LINKS, Cursor
from .scan import Token
from .source import Span

if TYPE_CHECKING:
    from .parse import Parser

PRECEDENCE = {
    "||": 1,
    "&&": 2,
    **dict.fromkeys(("==", "!="), 3),
    **dict.fromkeys(("<", ">", "<=", ">="), 4),
    **dict.fromkeys("+-", 5),
    **dict.fromkeys("*/%", 6),
}
ASSIGNMENTS = frozenset(("=", "+=", "-=", "*=", "/=", "%="))
OVERLOADS = frozenset("+ - * / % == != < > <= >= !".split())
_SPLIT = {"+=": "+", "-=": "-", "*=": "*", "/=": "/", "%=": "%"}


class ExpressionParser:
    """Parses expressions at the cursor. Function bodies go back to the statement parser."""

    def __init__(self, cursor: Cursor, statements: Parser) -> None:
        self.cursor = cursor
        self.statements = statements

    def parse(self) -> ast.Expr:
        """One expression, assignments included."""
        cursor = self.cursor
        cursor.enter()
        left = self._binary(1)
        token = cursor.token
        if token.kind == "op" and token.text in ASSIGNMENTS:
            left = self._assignment(left)
        cursor.leave()
        return left

    def _assignment(self, left: ast.Expr) -> ast.Expr:
        target = self._target(left)
        op = self.cursor.next().text
        value = self.parse()
        if isinstance(value, ast.Function) and op == "=" and not isinstance(target, ast.Index):
            value = replace(value, name=target.name)
        depth = self.cursor.depth_above(max(target.depth, value.depth))
        return ast.Assign(left.span.to(value.span), op, target, value, depth)

    def _target(self, node: ast.Expr) -> ast.Target:
        if isinstance(node, ast.Target):
            return node
        raise self.cursor.error("E206", node.span, "assignable")

    def _binary(self, lowest: int) -> ast.Expr:
        cursor = self.cursor
        left = self._unary()
        chain, deepest = 0, left.depth
        # No token of another kind has the text of an operator.
        while (level := PRECEDENCE.get(cursor.token.text, 0)) >= lowest:
            op = cursor.token.text
            chain += 1
            if chain > MAX_CHAIN:
                raise cursor.error("E221", cursor.token.span, "split_expression", limit=MAX_CHAIN)
            cursor.next()
            right = self._binary(level + 1)
            deepest = max(deepest, right.depth)
            kind = ast.Logic if level <= 2 else ast.Binary
            depth = cursor.depth_above(deepest + chain // 4)
            left = kind(left.span.to(right.span), op, left, right, depth)
        return left

    def _unary(self) -> ast.Expr:
        cursor = self.cursor
        token = cursor.token
        if token.kind != "op" or token.text not in ("-", "+", "!", "++", "--"):
            return self._postfix()
        cursor.enter()
        cursor.next()
        operand = self._unary()
        cursor.leave()
        span = token.span.to(operand.span)
        depth = cursor.depth_above(operand.depth)
        if token.text in ("++", "--"):
            return ast.Step(span, token.text, True, self._target(operand), depth)
        return ast.Unary(span, token.text, operand, depth)

    def _postfix(self) -> ast.Expr:
        cursor = self.cursor
        node = self._primary()
        links = 0
        while cursor.token.kind == "op":
            text = cursor.token.text
            if text == "(":
                node = self._call(node)
            elif text == ".":
                node = self._field(node)
            elif text == "[":
                node = self._index(node)
            elif text in ("++", "--"):
                op = cursor.next()
                span, depth = node.span.to(op.span), cursor.depth_above(node.depth)
                node = ast.Step(span, text, False, self._target(node), depth)
            else:
                break
            links += 1
            if links > MAX_LINKS:
                raise cursor.error("E222", cursor.token.span, "split_expression", limit=MAX_LINKS)
        return node

    def _values(self, closing: str, code: str, limit: int) -> list[ast.Expr]:
        """Expressions with commas between them, up to `closing`; `code` when there are too many."""
        cursor = self.cursor
        cursor.next()
        values: list[ast.Expr] = []
        while not cursor.sees(closing):
            if values:
                cursor.expect(",") if cursor.sees(",") else cursor.expect(closing)
            if len(values) == limit:
                raise cursor.error(code, cursor.token.span, limit=limit)
            values.append(self.parse())
        return values

    def _index(self, node: ast.Expr) -> ast.Index:
        cursor = self.cursor
        cursor.next()
        index = self.parse()
        end = cursor.expect("]")
        depth = cursor.depth_above(max(node.depth, index.depth))
        return ast.Index(node.span.to(end.span), node, index, depth)

    def _list(self) -> ast.ListOf:
        cursor = self.cursor
        start = cursor.token.span
        elements = self._values("]", "E227", MAX_ELEMENTS)
        end = cursor.next()
        depth = cursor.depth_above(max((e.depth for e in elements), default=0))
        return ast.ListOf(start.to(end.span), tuple(elements), depth)

    def _call(self, callee: ast.Expr) -> ast.Call:
        cursor = self.cursor
        arguments = self._values(")", "E223", MAX_ARGUMENTS)
        end = cursor.next()
        depth = cursor.depth_above(max([callee.depth, *[a.depth for a in arguments]]))
        return ast.Call(callee.span.to(end.span), callee, tuple(arguments), depth)

    def _field(self, node: ast.Expr) -> ast.Field:
        cursor = self.cursor
        cursor.next()
        if cursor.accept("operator"):
            name, end = self._overload()
        else:
            token = cursor.expect_name()
            name, end = token.text, token.span
        return ast.Field(node.span.to(end), node, name, cursor.depth_above(node.depth))

    def _overload(self) -> tuple[str, Span]:
        """The operator after `.operator`; `operator+=` is read as `operator+` and `=`."""
        cursor = self.cursor
        token = cursor.token
        if token.kind == "op" and token.text in _SPLIT:
            s = token.span
            middle = s.col + 1
            cursor.put(Token("op", "=", "=", Span(s.file, s.line, middle, s.line, s.end_col)))
            return "operator" + _SPLIT[token.text], Span(s.file, s.line, s.col, s.line, middle)
        if token.kind != "op" or token.text not in OVERLOADS:
            raise cursor.error("E207", token.span, "overloads", text=token.text)
        cursor.next()
        return "operator" + token.text, token.span

    def _primary(self) -> ast.Expr:
        cursor = self.cursor
        token = cursor.token
        if token.kind == "number":
            cursor.next()
            return ast.Number(token.span, float(token.value))
        if token.kind == "string":
            cursor.next()
            return ast.String(token.span, str(token.value))
        if token.kind == "name":
            return self.path()
        if token.kind == "op" and token.text == "#":
            return self.path()
        if cursor.sees("("):
            cursor.next()
            node = self.parse()
            end = cursor.expect(")")
            return replace(node, span=token.span.to(end.span))
        if cursor.sees("["):
            return self._list()
        if cursor.sees("function"):
            return self._function()
        if cursor.sees(")") and cursor.at > cursor.statement_start:
            raise cursor.error("E205", token.span, text=token.text)
        raise cursor.error("E205", token.span, "reserved_word" if token.kind == "keyword" else None)

    def path(self) -> ast.Path:
        """`name`, `#name` or `space::name`."""
        cursor = self.cursor
        start = cursor.token.span
        if cursor.token.kind == "name" and cursor.tokens[cursor.at + 1].text != "::":
            return ast.Path(start, cursor.next().text)
        hashed = cursor.accept("#")
        parts = [cursor.expect_name().text]
        while cursor.accept("::"):
            parts.append(cursor.expect_name().text)
            if len(parts) > 8:
                raise cursor.error("E222", cursor.previous, limit=8)
        return ast.Path(start.to(cursor.previous), "::".join(parts), hashed)

    def _function(self) -> ast.Function:
        cursor = self.cursor
        start = cursor.next().span
        cursor.expect("(")
        parameters: list[ast.Parameter] = []
        while not cursor.sees(")"):
            if parameters:
                cursor.expect(",") if cursor.sees(",") else cursor.expect(")")
            if len(parameters) == MAX_ARGUMENTS:
                raise cursor.error("E223", cursor.token.span, limit=MAX_ARGUMENTS)
            parameters.append(self._parameter(parameters))
        cursor.next()
        body = self.statements.parse_function_body()
        return ast.Function(start.to(body.span), tuple(parameters), body)

    def _parameter(self, before: list[ast.Parameter]) -> ast.Parameter:
        cursor = self.cursor
        name = cursor.expect_name()
        if any(p.name == name.text for p in before):
            raise cursor.error("E208", name.span, name=name.text)
        default = self.parse() if cursor.accept("=") else None
        type_name, type_span = self.type_name() if cursor.sees("~") else (None, None)
        return ast.Parameter(name.span, name.text, default, type_name, type_span)

    def type_name(self) -> tuple[str, Span]:
        """The name behind `~`, and where it stands."""
        cursor = self.cursor
        cursor.next()
        token = cursor.next()
        if token.kind != "string":
            raise cursor.error("E209", token.span, "type_string")
        return str(token.value), token.span
