"""The statement parser: tokens become the tree of one file."""

from __future__ import annotations

from collections.abc import Callable

from . import ast
from .cursor import Cursor, SyntaxStop
from .diagnostics import DiagnosticBag
from .parse_expr import ExpressionParser
from .scan import scan_source
from .source import SourceFile, Span

MAX_LOOPS = 8
MAX_CASES = 1000
MAX_BRANCHES = 150


class Parser:
    """Recursive descent over statements; one error a statement, then on at the next."""

    def __init__(self, source: SourceFile, bag: DiagnosticBag) -> None:
        self.source = source
        self.bag = bag
        self.cursor = Cursor(scan_source(source, bag), bag)
        self.expressions = ExpressionParser(self.cursor, self)
        # What stands around the statement: loops and switches of this function, outside in.
        self.around: list[str] = []
        self.functions = 0

    def parse_file(self) -> ast.FileTree:
        statements: list[ast.Statement] = []
        cursor = self.cursor
        while cursor.token.kind != "end" and not self.bag.full:
            if cursor.sees("}"):
                self.bag_error("E210", cursor.next().span)
                continue
            self._recovering(statements)
        return ast.FileTree(self.source.name, tuple(statements))

    def parse_function_body(self) -> ast.Block:
        """The block of a function: loops around it end at its border."""
        around, self.around = self.around, []
        self.functions += 1
        start = self.cursor.statement_start
        try:
            return self._block()
        finally:
            self.around = around
            self.functions -= 1
            self.cursor.statement_start = start

    def bag_error(self, code: str, span: Span, text: str = "") -> None:
        """Report without giving the statement up."""
        self.cursor.error(code, span, text=text)

    def _recovering(self, statements: list[ast.Statement]) -> None:
        """Parse one statement into `statements`; after an error skip to the next."""
        cursor = self.cursor
        state = (cursor.levels, len(self.around), self.functions)
        start = cursor.at
        try:
            statements.append(self.statement())
        except SyntaxStop:
            cursor.levels, self.functions = state[0], state[2]
            del self.around[state[1] :]
            if self.bag.full:
                cursor.go_to_end()
                return
            cursor.skip_statement()
            if cursor.at == start and not cursor.sees("}"):
                cursor.next()

    def statement(self) -> ast.Statement:
        cursor = self.cursor
        cursor.statement_start = cursor.at
        cursor.enter()
        token = cursor.token
        made: ast.Statement
        if token.kind == "keyword":
            parse = _KEYWORD_STATEMENTS.get(token.text)
            made = parse(self) if parse else self._expression_statement()
        elif cursor.sees("{"):
            made = self._block()
        elif cursor.sees(";"):
            cursor.next()
            made = ast.Block(token.span, ())
        elif token.text == "include" and self._sees_file_name():
            made = self._include()
        elif token.text == "export" and cursor.tokens[cursor.at + 1].kind == "name":
            made = self._export()
        else:
            made = self._expression_statement()
        cursor.leave()
        return made

    def _expression_statement(self) -> ast.ExprStatement:
        value = self.expressions.parse()
        self.cursor.expect(";")
        return ast.ExprStatement(value.span, value)

    def _block(self) -> ast.Block:
        cursor = self.cursor
        opening = cursor.expect("{")
        statements: list[ast.Statement] = []
        while not cursor.sees("}"):
            if cursor.token.kind == "end":
                self._unclosed(opening.span)
            self._recovering(statements)
        return ast.Block(opening.span.to(cursor.next().span), tuple(statements))

    def _unclosed(self, span: Span) -> None:
        if not any(item.code == "E211" for item in self.bag.items) and not self.bag.full:
            raise self.cursor.error("E211", span)
        raise SyntaxStop

    def _parenthesised(self) -> ast.Expr:
        self.cursor.expect("(")
        value = self.expressions.parse()
        self.cursor.expect(")")
        return value

    def _if(self) -> ast.If:
        cursor = self.cursor
        start = cursor.next().span
        branches = [(self._parenthesised(), self.statement())]
        otherwise: ast.Statement | None = None
        while otherwise is None and cursor.accept("else"):
            if not cursor.sees("if"):
                otherwise = self.statement()
                break
            if len(branches) == MAX_BRANCHES:
                raise cursor.error("E224", cursor.token.span, limit=MAX_BRANCHES)
            cursor.next()
            branches.append((self._parenthesised(), self.statement()))
        return ast.If(start, tuple(branches), otherwise)

    def _inside(self, kind: str, span: Span) -> None:
        self.around.append(kind)
        if len(self.around) > MAX_LOOPS:
            raise self.cursor.error("E225", span, "split_loops", limit=MAX_LOOPS)

    def _while(self) -> ast.While:
        start = self.cursor.next().span
        self._inside("loop", start)
        condition = self._parenthesised()
        body = self.statement()
        self.around.pop()
        return ast.While(start, condition, body)

    def _for(self) -> ast.For | ast.ForEach:
        cursor = self.cursor
        start = cursor.next().span
        self._inside("loop", start)
        cursor.expect("(")
        if self._sees_each():
            return self._for_each(start)
        init = None if cursor.sees(";") else self.expressions.parse()
        cursor.expect(";")
        condition = None if cursor.sees(";") else self.expressions.parse()
        cursor.expect(";")
        step = None if cursor.sees(")") else self.expressions.parse()
        cursor.expect(")")
        body = self.statement()
        self.around.pop()
        return ast.For(start, init, condition, step, body)

    def _sees_each(self) -> bool:
        """Whether a path and `in` come next."""
        tokens, at = self.cursor.tokens, self.cursor.at
        while tokens[at].kind == "name" or tokens[at].text in ("#", "::"):
            at += 1
        return tokens[at].text == "in" and tokens[at].kind == "keyword" and at > self.cursor.at

    def _for_each(self, start: Span) -> ast.ForEach:
        cursor = self.cursor
        target = self.expressions.path()
        cursor.expect("in")
        subject = self.expressions.parse()
        cursor.expect(")")
        body = self.statement()
        self.around.pop()
        depth = cursor.depth_above(subject.depth)
        return ast.ForEach(start, ast.Each(target.span.to(subject.span), target, subject, depth), body)

    def _switch(self) -> ast.Switch:
        cursor = self.cursor
        start = cursor.next().span
        self._inside("switch", start)
        subject = self._parenthesised()
        opening = cursor.expect("{")
        cases: list[ast.Case] = []
        while not cursor.sees("}"):
            if cursor.token.kind == "end":
                self._unclosed(opening.span)
            self._recovering_case(cases)
        cursor.next()
        self.around.pop()
        return ast.Switch(start, subject, tuple(cases))

    def _recovering_case(self, cases: list[ast.Case]) -> None:
        """Parse one case into `cases`; after an error skip to the next, past the limit to the end."""
        cursor = self.cursor
        levels = cursor.levels
        start = cursor.at
        try:
            cases.append(self._case(cases))
        except SyntaxStop:
            if self.bag.full:
                raise
            cursor.levels = levels
            if cursor.at == start:
                cursor.next()
            cursor.skip_to(*(() if len(cases) == MAX_CASES else ("case", "default")))

    def _case(self, before: list[ast.Case]) -> ast.Case:
        cursor = self.cursor
        start = cursor.token.span
        if len(before) == MAX_CASES:
            raise cursor.error("E226", start, limit=MAX_CASES)
        value: ast.Expr | None = None
        if cursor.accept("case"):
            value = self.expressions.parse()
        elif cursor.accept("default"):
            if any(case.value is None for case in before):
                raise cursor.error("E212", start)
        else:
            raise cursor.error("E213", start)
        cursor.expect(":")
        body: list[ast.Statement] = []
        while not (cursor.sees("case") or cursor.sees("default") or cursor.sees("}")):
            if cursor.token.kind == "end":
                break
            self._recovering(body)
        return ast.Case(start, value, tuple(body))

    def _sees_file_name(self) -> bool:
        """Whether a file is meant after the word `include`: a bare string lacks its parenthesis only."""
        after = self.cursor.tokens[self.cursor.at + 1]
        return after.text == "(" or after.kind == "string"

    def _include(self) -> ast.Include:
        cursor = self.cursor
        start = cursor.next().span
        if self.functions or self.around or cursor.levels > 1:
            raise cursor.error("E214", start)
        cursor.expect("(")
        token = cursor.next()
        if token.kind != "string":
            raise cursor.error("E215", token.span)
        cursor.expect(")")
        end = cursor.expect(";").span
        return ast.Include(start.to(end), str(token.value), token.span)

    def _export(self) -> ast.Export:
        cursor = self.cursor
        start = cursor.next().span
        if self.functions or self.around or cursor.levels > 1:
            raise cursor.error("E230", start)
        path = self.expressions.path()
        cursor.expect("=")
        value = self.expressions.parse()
        depth = cursor.depth_above(value.depth)
        assignment = ast.Assign(path.span.to(value.span), "=", path, value, depth)
        type_name, type_span, limits = None, None, None
        if cursor.sees("~") and cursor.tokens[cursor.at + 1].kind == "string":
            type_name, type_span = self.expressions.type_name()
        if cursor.accept("~"):
            limits = self._export_limits()
        end = cursor.expect(";").span
        return ast.Export(start.to(end), assignment, type_name, type_span, limits)

    def _export_limits(self) -> ast.Call:
        place = self.cursor.token.span
        made = self.expressions.parse()
        callee = made.callee if isinstance(made, ast.Call) else None
        if isinstance(callee, ast.Path) and callee.name in ("range", "choice"):
            return made  # type: ignore[return-value]
        raise self.cursor.error("E231", place)

    def _break(self) -> ast.Break:
        span = self.cursor.next().span
        if not self.around:
            self.bag_error("E216", span, text="break")
        self.cursor.expect(";")
        return ast.Break(span)

    def _continue(self) -> ast.Continue:
        span = self.cursor.next().span
        if "loop" not in self.around:
            self.bag_error("E217", span, text="continue")
        self.cursor.expect(";")
        return ast.Continue(span)

    def _return(self) -> ast.Return:
        span = self.cursor.next().span
        if not self.functions:
            self.bag_error("E218", span, text="return")
        value = None if self.cursor.sees(";") else self.expressions.parse()
        self.cursor.expect(";")
        return ast.Return(span if value is None else span.to(value.span), value)


_KEYWORD_STATEMENTS: dict[str, Callable[[Parser], ast.Statement]] = {
    "if": Parser._if,
    "while": Parser._while,
    "for": Parser._for,
    "switch": Parser._switch,
    "break": Parser._break,
    "continue": Parser._continue,
    "return": Parser._return,
}


def parse_source(source: SourceFile, bag: DiagnosticBag) -> ast.FileTree:
    """The tree of one file. Errors go to `bag`; a tree with errors must not be run."""
    return Parser(source, bag).parse_file()
