"""Making Python syntax trees whose nodes stand at places of the TRG text.

A text of the greatest length becomes half a million nodes. The frequent ones are of classes with
slots, which take half of the time and a third of the memory of those that `ast` makes; contexts and
operators are shared. To `compile` a subclass is what its base is.
"""

from __future__ import annotations

import ast as py
from typing import TypeVar

from .source import Span

Node = TypeVar("Node", bound=py.expr | py.stmt | py.arg)
_PLACE = ("lineno", "col_offset", "end_lineno", "end_col_offset")

LOAD, STORE = py.Load(), py.Store()
OPERATORS: dict[str, py.operator] = {
    "+": py.Add(),
    "-": py.Sub(),
    "*": py.Mult(),
    "/": py.Div(),
    "%": py.Mod(),
}
COMPARISONS: dict[str, py.cmpop] = {
    "<": py.Lt(),
    ">": py.Gt(),
    "<=": py.LtE(),
    ">=": py.GtE(),
    "==": py.Eq(),
    "!=": py.NotEq(),
}
IS, IS_NOT, NOT = py.Is(), py.IsNot(), py.Not()


class Read(py.Name):
    __slots__ = (*_PLACE, "id")
    ctx = LOAD


class Write(py.Name):
    __slots__ = (*_PLACE, "id")
    ctx = STORE


class Constant(py.Constant):
    __slots__ = (*_PLACE, "value")


class Call(py.Call):
    __slots__ = (*_PLACE, "args", "func", "keywords")


class NamedExpr(py.NamedExpr):
    __slots__ = (*_PLACE, "target", "value")


class BinOp(py.BinOp):
    __slots__ = (*_PLACE, "left", "op", "right")


class UnaryOp(py.UnaryOp):
    __slots__ = (*_PLACE, "op", "operand")


class Compare(py.Compare):
    __slots__ = (*_PLACE, "comparators", "left", "ops")


class IfExp(py.IfExp):
    __slots__ = (*_PLACE, "body", "orelse", "test")


class Tuple(py.Tuple):
    __slots__ = (*_PLACE, "elts")
    ctx = LOAD


class Attribute(py.Attribute):
    __slots__ = (*_PLACE, "attr", "ctx", "value")


class Subscript(py.Subscript):
    __slots__ = (*_PLACE, "ctx", "slice", "value")


class Assign(py.Assign):
    __slots__ = (*_PLACE, "targets", "value")


class AugAssign(py.AugAssign):
    __slots__ = (*_PLACE, "op", "target", "value")


class Expr(py.Expr):
    __slots__ = (*_PLACE, "value")


class If(py.If):
    __slots__ = (*_PLACE, "body", "orelse", "test")


class Break(py.Break):
    __slots__ = _PLACE


class For(py.For):
    __slots__ = (*_PLACE, "body", "iter", "orelse", "target")


class While(py.While):
    __slots__ = (*_PLACE, "body", "orelse", "test")


SLOTTED = (
    Read, Write, Constant, Call, NamedExpr, BinOp, UnaryOp, Compare, IfExp, Tuple, Attribute,
    Subscript, Assign, AugAssign, Expr, If, Break, For, While,
)  # fmt: skip


def at(node: Node, span: Span) -> Node:
    """`node`, placed at `span`; Python stores what it is given, here columns in characters."""
    _, node.lineno, col, node.end_lineno, end_col = span
    node.col_offset, node.end_col_offset = col - 1, end_col - 1
    return node


def load(name: str, span: Span) -> py.Name:
    node = Read.__new__(Read)
    node.id = name
    _, node.lineno, col, node.end_lineno, end_col = span
    node.col_offset, node.end_col_offset = col - 1, end_col - 1
    return node


def store(name: str, span: Span) -> py.Name:
    node = Write.__new__(Write)
    node.id = name
    return at(node, span)


def constant(value: float | int | str | bool, span: Span) -> py.Constant:
    node = Constant.__new__(Constant)
    node.value = value
    return at(node, span)


def call(name: str, arguments: list[py.expr], span: Span) -> py.Call:
    return invoke(load(name, span), arguments, span)


def invoke(function: py.expr, arguments: list[py.expr], span: Span) -> py.Call:
    node = Call.__new__(Call)
    node.func, node.args, node.keywords = function, arguments, []
    return at(node, span)


def named(name: str, value: py.expr, span: Span) -> py.NamedExpr:
    node = NamedExpr.__new__(NamedExpr)
    node.target, node.value = store(name, span), value
    return at(node, span)


def binary(left: py.expr, op: str, right: py.expr, span: Span) -> py.BinOp:
    node = BinOp.__new__(BinOp)
    node.left, node.op, node.right = left, OPERATORS[op], right
    return at(node, span)


def unary(op: py.unaryop, operand: py.expr, span: Span) -> py.UnaryOp:
    node = UnaryOp.__new__(UnaryOp)
    node.op, node.operand = op, operand
    return at(node, span)


def compare(left: py.expr, op: py.cmpop, right: py.expr, span: Span) -> py.Compare:
    node = Compare.__new__(Compare)
    node.left, node.ops, node.comparators = left, [op], [right]
    return at(node, span)


def choose(condition: py.expr, then: py.expr, otherwise: py.expr, span: Span) -> py.IfExp:
    node = IfExp.__new__(IfExp)
    node.test, node.body, node.orelse = condition, then, otherwise
    return at(node, span)


def one_or_zero(condition: py.expr, span: Span) -> py.IfExp:
    """The number 1 or 0: Python's truth values never become values of the language."""
    return choose(condition, constant(1.0, span), constant(0.0, span), span)


def both(elements: list[py.expr], span: Span) -> py.Tuple:
    node = Tuple.__new__(Tuple)
    node.elts = elements
    return at(node, span)


def attribute(value: py.expr, name: str, span: Span, context: py.expr_context) -> py.Attribute:
    """A field. Over several lines it keeps its first character only: CPython would otherwise
    move the place of a method call to the line of the name."""
    if span.line != span.end_line:
        span = Span(span.file, span.line, span.col, span.line, span.col + 1)
    node = Attribute.__new__(Attribute)
    node.value, node.attr, node.ctx = value, "T_" + name, context
    return at(node, span)


def element(value: py.expr, index: py.expr, span: Span, context: py.expr_context) -> py.Subscript:
    """An element of a list. Lists and all other values of the language refuse what is no element."""
    node = Subscript.__new__(Subscript)
    node.value, node.slice, node.ctx = value, index, context
    return at(node, span)


def assign(target: py.expr, value: py.expr, span: Span) -> py.Assign:
    node = Assign.__new__(Assign)
    node.targets, node.value = [target], value
    return at(node, span)


def augment(
    target: py.Name | py.Attribute | py.Subscript, op: str, value: py.expr, span: Span
) -> py.AugAssign:
    node = AugAssign.__new__(AugAssign)
    node.target, node.op, node.value = target, OPERATORS[op], value
    return at(node, span)


def statement(value: py.expr, span: Span) -> py.Expr:
    node = Expr.__new__(Expr)
    node.value = value
    return at(node, span)


def when(test: py.expr, body: list[py.stmt], span: Span, orelse: list[py.stmt] | None = None) -> py.If:
    node = If.__new__(If)
    node.test, node.body, node.orelse = test, body, orelse or []
    return at(node, span)


def leave(span: Span) -> py.Break:
    return at(Break.__new__(Break), span)


def walk(target: py.expr, items: py.expr, body: list[py.stmt], orelse: list[py.stmt], span: Span) -> py.For:
    node = For.__new__(For)
    node.target, node.iter, node.body, node.orelse = target, items, body, orelse
    return at(node, span)


def count_steps(body: list[py.stmt], orelse: list[py.stmt], span: Span) -> py.For:
    """A loop over the slice of steps; `orelse` runs when the slice is used up.

    Loop and iterator stand at one place: Python versions differ in which one they report.
    """
    return walk(store("_", span), load("S_", span), body, orelse, span)


def tick(span: Span) -> py.stmt:
    """One step of the budget."""
    return count_steps([leave(span)], [statement(call("T_", [], span), span)], span)


def forever(body: list[py.stmt], span: Span) -> py.While:
    node = While.__new__(While)
    node.test, node.body, node.orelse = constant(True, span), body, []
    return at(node, span)
