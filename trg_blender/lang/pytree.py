"""Making Python syntax trees whose nodes stand at places of the TRG text."""

from __future__ import annotations

import ast as py
from typing import TypeVar

from .source import Span

Node = TypeVar("Node", bound=py.expr | py.stmt | py.arg)

OPERATORS: dict[str, type[py.operator]] = {
    "+": py.Add,
    "-": py.Sub,
    "*": py.Mult,
    "/": py.Div,
    "%": py.Mod,
}
COMPARISONS: dict[str, type[py.cmpop]] = {
    "<": py.Lt,
    ">": py.Gt,
    "<=": py.LtE,
    ">=": py.GtE,
    "==": py.Eq,
    "!=": py.NotEq,
}


def at(node: Node, span: Span) -> Node:
    """`node`, placed at `span`; Python stores what it is given, here columns in characters."""
    node.lineno, node.col_offset = span.line, span.col - 1
    node.end_lineno, node.end_col_offset = span.end_line, span.end_col - 1
    return node


def load(name: str, span: Span) -> py.Name:
    return at(py.Name(name, py.Load()), span)


def store(name: str, span: Span) -> py.Name:
    return at(py.Name(name, py.Store()), span)


def constant(value: float | int | str | bool, span: Span) -> py.Constant:
    return at(py.Constant(value), span)


def call(name: str, arguments: list[py.expr], span: Span) -> py.Call:
    return at(py.Call(load(name, span), arguments, []), span)


def named(name: str, value: py.expr, span: Span) -> py.NamedExpr:
    return at(py.NamedExpr(store(name, span), value), span)


def binary(left: py.expr, op: str, right: py.expr, span: Span) -> py.BinOp:
    return at(py.BinOp(left, OPERATORS[op](), right), span)


def compare(left: py.expr, op: py.cmpop, right: py.expr, span: Span) -> py.Compare:
    return at(py.Compare(left, [op], [right]), span)


def one_or_zero(condition: py.expr, span: Span) -> py.IfExp:
    """The number 1 or 0: Python's truth values never become values of the language."""
    return at(py.IfExp(condition, constant(1.0, span), constant(0.0, span)), span)


def attribute(value: py.expr, name: str, span: Span, context: py.expr_context) -> py.Attribute:
    """A field. Over several lines it keeps its first character only: CPython would otherwise
    move the place of a method call to the line of the name."""
    if span.line != span.end_line:
        span = Span(span.file, span.line, span.col, span.line, span.col + 1)
    return at(py.Attribute(value, "T_" + name, context), span)


def element(value: py.expr, index: py.expr, span: Span, context: py.expr_context) -> py.Subscript:
    """An element of a list. Lists and all other values of the language refuse what is no element."""
    return at(py.Subscript(value, index, context), span)


def assign(target: py.expr, value: py.expr, span: Span) -> py.Assign:
    return at(py.Assign([target], value), span)


def statement(value: py.expr, span: Span) -> py.Expr:
    return at(py.Expr(value), span)


def when(test: py.expr, body: list[py.stmt], span: Span) -> py.If:
    return at(py.If(test, body, []), span)


def count_steps(body: list[py.stmt], orelse: list[py.stmt], span: Span) -> py.For:
    """A loop over the slice of steps; `orelse` runs when the slice is used up.

    Loop and iterator stand at one place: Python versions differ in which one they report.
    """
    return at(py.For(store("_", span), load("S_", span), body, orelse), span)


def tick(span: Span) -> py.stmt:
    """One step of the budget."""
    return count_steps([at(py.Break(), span)], [statement(call("T_", [], span), span)], span)


def forever(body: list[py.stmt], span: Span) -> py.While:
    return at(py.While(constant(True, span), body, []), span)
