"""Translation of expressions to Python's.

Names of the translated code: `g_x` a global or a built-in as a value, `l_x` a local, `b_x` a
built-in that is called directly, `p_0` one that makes things there, `f_0` a function, `m_0` a file,
`c_0` a string, `t1_` a temporary; capital and underscore (`K_`) a helper of the session (see `run.helpers`).
"""

from __future__ import annotations

import ast as py
from collections.abc import Callable

from . import ast
from .pytree import (
    COMPARISONS,
    IS,
    LOAD,
    NOT,
    at,
    attribute,
    binary,
    both,
    call,
    choose,
    compare,
    constant,
    element,
    invoke,
    load,
    named,
    one_or_zero,
    unary,
)
from .resolve import FunctionInfo, Resolution
from .runtime import Site
from .source import Span
from .yields import YieldAnalysis

_NAMED = (ast.Path, ast.Field)


class ProgramParts:
    """What all files of a program share while they are translated."""

    def __init__(self, resolution: Resolution, analysis: YieldAnalysis, placed: frozenset[str]) -> None:
        self.placed = placed
        self.places: dict[tuple[str, Span], str] = {}
        self.resolution = resolution
        self.analysis = analysis
        self.sites: dict[Span, Site] = {}
        self.strings: dict[str, str] = {}
        self.has_self = any(info.takes_self for info in resolution.functions.values())
        self.compare_overloaded = bool(resolution.overloads & COMPARISONS.keys())

    def place_name(self, builtin: str, span: Span) -> str:
        """The global name of a built-in that is called directly: one of its own where it makes things."""
        if builtin not in self.placed:
            return "b_" + builtin
        return self.places.setdefault((builtin, span), f"p_{len(self.places)}")

    def string_name(self, text: str) -> str:
        """The global name of a string constant."""
        return self.strings.setdefault(text, f"c_{len(self.strings)}")


class ExpressionEmitter:
    """Translates the expressions of one context (a function, or the top level of a file)."""

    def __init__(self, parts: ProgramParts, context: FunctionInfo | None) -> None:
        self.parts = parts
        self.context = context
        self.suspends = context is None or context.yields
        self.weight = 0
        self.not_yet: frozenset[str] = frozenset()
        """Parameters that have no value while the default of an earlier one is computed."""
        self.temporaries = 0
        """How many are in use."""

    def temporary(self, letter: str = "t") -> str:
        self.temporaries += 1
        return f"{letter}{self.temporaries}_"

    def site(
        self, node: ast.Expr, op: str, operands: tuple[ast.Expr, ...], *, by_field: bool = False
    ) -> None:
        """Note what stands at a place, for messages."""
        span = node.span
        if by_field and span.line != span.end_line:
            span = Span(span.file, span.line, span.col, span.line, span.col + 1)
        names = tuple([o.name if isinstance(o, _NAMED) else "" for o in operands])
        spans = tuple([o.span for o in operands])
        self.parts.sites[span] = Site(node.span, op, spans, names)

    def variable(self, path: ast.Path) -> str:
        """The Python name of a variable."""
        if self.context is None:
            own = path.name in self.parts.resolution.file_variables
            return ("l_" if own else "g_") + path.name
        if not path.is_global and path.name in self.context.locals:
            return "l_" + path.name
        return "g_" + path.name

    def value(self, node: ast.Expr) -> py.expr:
        """The expression as a value of the language."""
        self.weight += 1
        match node:
            case ast.Path():
                absent = node.name in self.not_yet and not node.is_global
                return load("u_" if absent else self.variable(node), node.span)
            case ast.Number():
                return constant(node.value, node.span)
            case ast.String():
                return load(self.parts.string_name(node.text), node.span)
            case ast.Binary():
                return self._spine(node, condition=False)
            case ast.Logic():
                return one_or_zero(self._logic(node), node.span)
            case ast.Unary():
                return self._unary(node)
            case ast.Assign():
                return self._assign(node)
            case ast.Step():
                return self._step(node)
            case ast.Call():
                return self._call(node)
            case ast.Field():
                self.site(node, ".", (node.object,), by_field=True)
                return attribute(self.value(node.object), node.name, node.span, LOAD)
            case ast.Index():
                return self.element(node, LOAD)
            case ast.ListOf():
                elements = both([self.value(e) for e in node.elements], node.span)
                return call("H_", [elements], node.span)
            case ast.Each():
                raise AssertionError("the head of a loop is no value")
            case ast.Function():
                index = self.parts.resolution.functions[id(node)].index
                return call("F_", [load(f"f_{index}", node.span)], node.span)

    def element(self, node: ast.Index, context: py.expr_context) -> py.Subscript:
        """`object[index]`, to be read or assigned to."""
        self.site(node, "[]", (node.object, node.index))
        return element(self.value(node.object), self.value(node.index), node.span, context)

    def condition(self, node: ast.Expr) -> py.expr:
        """The expression where only its truth counts."""
        self.weight += 1
        if isinstance(node, ast.Binary):
            return self._spine(node, condition=True)
        if isinstance(node, ast.Logic):
            return self._logic(node)
        if isinstance(node, ast.Unary) and node.op == "!":
            if "!" not in self.parts.resolution.overloads:
                return unary(NOT, self.condition(node.operand), node.span)
        return self.value(node)

    def equal(self, left: py.expr, right: py.expr, span: Span) -> py.expr:
        """`left == right` as a condition."""
        return self._compare("==", left, right, span)

    # Operators. A chain to the left is walked in a loop: it may be longer than a stack allows.

    def _spine(self, node: ast.Binary, *, condition: bool) -> py.expr:
        chain: list[ast.Binary] = []
        first: ast.Expr = node
        while isinstance(first, ast.Binary):
            chain.append(first)
            first = first.left
        made = self.value(first)
        for link in reversed(chain):
            self.site(link, link.op, (link.left, link.right))
            right = self.value(link.right)
            if link.op not in COMPARISONS:
                made = binary(made, link.op, right, link.span)
                continue
            made = self._compare(link.op, made, right, link.span)
            if link is not node or not condition:
                made = one_or_zero(made, link.span)
        return made

    def _compare(self, op: str, left: py.expr, right: py.expr, span: Span) -> py.expr:
        if self.parts.compare_overloaded:
            return call("L_", [constant(op, span), left, right], span)
        return compare(left, COMPARISONS[op], right, span)

    def _logic(self, node: ast.Logic) -> py.expr:
        operands: list[ast.Expr] = []
        first: ast.Expr = node
        while isinstance(first, ast.Logic) and first.op == node.op:
            operands.append(first.right)
            first = first.left
        operands.append(first)
        op = py.And() if node.op == "&&" else py.Or()
        return at(py.BoolOp(op, [self.condition(o) for o in reversed(operands)]), node.span)

    def _unary(self, node: ast.Unary) -> py.expr:
        self.site(node, node.op, (node.operand,))
        if node.op == "!":
            if "!" in self.parts.resolution.overloads:
                return call("N_", [self.value(node.operand)], node.span)
            zero, one = constant(0.0, node.span), constant(1.0, node.span)
            return choose(self.condition(node.operand), zero, one, node.span)
        op = py.USub() if node.op == "-" else py.UAdd()
        return unary(op, self.value(node.operand), node.span)

    # Assignments whose value is used.

    def _assign(self, node: ast.Assign) -> py.expr:
        target, span = node.target, node.span
        self.site(node, node.op, (target, node.value))
        if isinstance(target, ast.Path):
            name = self.variable(target)
            value = self.value(node.value)
            if node.op != "=":
                value = binary(load(name, target.span), node.op[0], value, span)
            return named(name, value, span)
        if isinstance(target, ast.Index):
            return self._assign_element(target, node)
        self.site(target, ".=", (target.object,), by_field=True)
        if node.op == "=":
            holder = self.holder(target.object)
            arguments = [holder, constant("T_" + target.name, span), self.value(node.value)]
            return call("E_", arguments, target.span)
        return self._change_field(target, node.op[0], lambda: self.value(node.value), span)

    def _assign_element(self, target: ast.Index, node: ast.Assign) -> py.expr:
        """As the statement does it: a plain assignment computes its right side first."""
        self.site(target, "[]", (target.object, target.index))
        if node.op == "=":
            parts = [self.value(node.value), self.value(target.object), self.value(target.index)]
            return call("J_", parts, target.span)
        held, place = self.temporary(), self.temporary()
        read = self._held_element(target, held, place)
        new = binary(read, node.op[0], self.value(node.value), node.span)
        return call("J_", [new, load(held, node.span), load(place, node.span)], target.span)

    def _held_element(self, target: ast.Index, held: str, place: str) -> py.expr:
        """An element, its list and index kept in variables for writing it back."""
        span = target.span
        holder = named(held, self.value(target.object), span)
        return element(holder, named(place, self.value(target.index), span), span, LOAD)

    def _step_element(self, node: ast.Step, target: ast.Index, by: py.expr) -> py.expr:
        span, target_span = node.span, target.span
        self.site(target, "[]", (target.object, target.index))
        held, place, old = self.temporary(), self.temporary(), self.temporary()
        read = self._held_element(target, held, place)
        if node.prefix:
            new = binary(read, "-", by, span)
            return call("J_", [new, load(held, span), load(place, span)], target_span)
        first = named(old, call("Z_", [read], span), span)
        new = binary(load(old, span), "-", by, span)
        second = call("J_", [new, load(held, span), load(place, span)], target_span)
        return self._first_of(first, second, span)

    @staticmethod
    def _first_of(first: py.expr, second: py.expr, span: Span) -> py.expr:
        """Both are computed; the value is the first."""
        return element(both([first, second], span), constant(0, span), span, LOAD)

    def holder(self, node: ast.Expr) -> py.expr:
        """The object of a field that is assigned to; a variable without a value becomes one."""
        made = self.value(node)
        if not isinstance(node, ast.Path) or self.is_builtin(node):
            return made
        undefined = compare(made, IS, load("u_", node.span), node.span)
        fresh = named(self.variable(node), call("O_", [], node.span), node.span)
        return choose(undefined, fresh, self.value(node), node.span)

    def is_builtin(self, path: ast.Path) -> bool:
        """Whether `path` means a built-in here."""
        return self.parts.resolution.is_builtin(path, self.context)

    def _change_field(self, target: ast.Field, op: str, value: Callable[[], py.expr], span: Span) -> py.expr:
        held = self.temporary()
        holder = named(held, self.value(target.object), target.span)
        old = attribute(load(held, target.span), target.name, target.span, LOAD)
        new = binary(old, op, value(), span)
        return call("E_", [holder, constant("T_" + target.name, span), new], target.span)

    def _step(self, node: ast.Step) -> py.expr:
        """`++` is `- -1.0`: exact, and an error for strings, which have a `+`."""
        target, span = node.target, node.span
        self.site(node, node.op, (target,))
        by = constant(step_amount(node.op), span)
        if isinstance(target, ast.Path):
            name = self.variable(target)
            if node.prefix:
                return named(name, binary(load(name, target.span), "-", by, span), span)
            old = self.temporary()
            first = named(old, call("Z_", [load(name, target.span)], span), span)
            second = named(name, binary(load(old, span), "-", by, span), span)
            return self._first_of(first, second, span)
        if isinstance(target, ast.Index):
            return self._step_element(node, target, by)
        self.site(target, ".=", (target.object,), by_field=True)
        if node.prefix:
            return self._change_field(target, "-", lambda: by, span)
        held, old = self.temporary(), self.temporary()
        holder = named(held, self.value(target.object), target.span)
        read = attribute(load(held, target.span), target.name, target.span, LOAD)
        first = named(old, call("Z_", [read], span), span)
        new = binary(load(old, span), "-", by, span)
        return call("B_", [holder, constant("T_" + target.name, span), first, new], target.span)

    # Calls.

    def _call(self, node: ast.Call) -> py.expr:
        callee, span = node.callee, node.span
        operands = (callee, *node.arguments)
        self.site(node, "()", operands)
        if isinstance(callee, ast.Path) and self.is_builtin(callee):
            return self._call_builtin(node, callee)
        function = self._method(callee) if isinstance(callee, ast.Field) else self.value(callee)
        arguments = [self.value(a) for a in node.arguments]
        made: py.expr = invoke(function, [load("d_", span), *arguments], span)
        if self.suspends and self.parts.analysis.may_yield(node, self.context):
            made = self._delegate(made, span)
        return made

    def _call_builtin(self, node: ast.Call, callee: ast.Path) -> py.expr:
        arguments = node.arguments
        if callee.name == "isdef" and len(arguments) == 1 and isinstance(arguments[0], ast.Field):
            tested = arguments[0]
            field = constant("T_" + tested.name, node.span)
            return call("D_", [self.value(tested.object), field], node.span)
        if callee.name == "object" and not arguments:
            return call("O_", [], node.span)
        name = self.parts.place_name(callee.name, node.span)
        return call(name, [self.value(a) for a in arguments], node.span)

    def _method(self, callee: ast.Field) -> py.expr:
        """A function in a field; one whose first parameter is `self` is bound to the object."""
        if not self.parts.has_self:
            return self.value(callee)
        self.site(callee, ".", (callee.object,), by_field=True)
        held, span = self.temporary(), callee.span
        holder = named(held, self.value(callee.object), span)
        function = attribute(load(held, span), callee.name, span, LOAD)
        return call("M_", [holder, function], span)

    def _delegate(self, made: py.expr, span: Span) -> py.expr:
        """Run a call that turned out to be a suspended computation, else take its value."""
        kind = call("Y_", [named("t_", made, span)], span)
        test = compare(kind, IS, load("G_", span), span)
        run = at(py.YieldFrom(load("t_", span)), span)
        return choose(test, run, load("t_", span), span)


def step_amount(op: str) -> float:
    """What `++` or `--` subtracts."""
    return -1.0 if op == "++" else 1.0
