"""A plain tree-walking evaluator of the core of the language, to compare the real one with.

It walks the syntax tree as the reference describes it and takes nothing from the translator or the
runtime but the formatting of numbers. It knows numbers, strings, variables, functions, objects, loops,
branches and `print`; `Refusal` means that the program has an error there, and its kind.
"""

from __future__ import annotations

import math

from trg_blender.lang import SourceFile, ast
from trg_blender.lang.diagnostics import DiagnosticBag
from trg_blender.lang.parse import parse_source
from trg_blender.lang.values import format_number


class Refusal(Exception):
    """The program is wrong at this point; `code` as in the table of messages."""

    def __init__(self, code: str) -> None:
        super().__init__(code)
        self.code = code


class OutOfSteps(Exception):
    """The program runs longer than the comparison goes."""


class _Leave(Exception):
    """`break`, `continue` or `return` on its way out."""

    def __init__(self, kind: str, value: object = None) -> None:
        super().__init__(kind)
        self.kind, self.value = kind, value


class _Undefined:
    pass


UNDEFINED = _Undefined()


class _Function:
    def __init__(self, node: ast.Function) -> None:
        self.node = node


class _Object(dict):
    __hash__ = object.__hash__

    def __eq__(self, other: object) -> bool:
        return self is other


def truth(value: object) -> bool:
    return not (value is UNDEFINED or value == 0.0 or value == "")


class Oracle:
    """Runs one program; `output` holds the lines printed."""

    def __init__(self, text: str, steps: int = 20_000) -> None:
        self.tree = parse_source(SourceFile.from_text("main.trg", text), DiagnosticBag())
        self.output: list[str] = []
        self.globals: dict[str, object] = {}
        self.steps = steps

    def run(self) -> None:
        """Raises Refusal or OutOfSteps."""
        for node in self.tree.statements:
            self.execute(node, self.globals)

    def execute(self, node: ast.Statement, scope: dict[str, object]) -> None:
        self.steps -= 1
        if self.steps < 0:
            raise OutOfSteps
        getattr(self, "_do_" + type(node).__name__.lower())(node, scope)

    def _do_exprstatement(self, node: ast.ExprStatement, scope: dict[str, object]) -> None:
        self.value(node.value, scope)

    def _do_block(self, node: ast.Block, scope: dict[str, object]) -> None:
        for inner in node.statements:
            self.execute(inner, scope)

    def _do_if(self, node: ast.If, scope: dict[str, object]) -> None:
        for condition, body in node.branches:
            if truth(self.value(condition, scope)):
                return self.execute(body, scope)
        if node.otherwise is not None:
            self.execute(node.otherwise, scope)
        return None

    def _do_while(self, node: ast.While, scope: dict[str, object]) -> None:
        self._loop(node.condition, None, node.body, scope)

    def _do_for(self, node: ast.For, scope: dict[str, object]) -> None:
        if node.init is not None:
            self.value(node.init, scope)
        self._loop(node.condition, node.step, node.body, scope)

    def _loop(self, condition, step, body, scope) -> None:  # noqa: ANN001
        while condition is None or truth(self.value(condition, scope)):
            try:
                self.execute(body, scope)
            except _Leave as leave:
                if leave.kind == "break":
                    return
                if leave.kind == "return":
                    raise
            if step is not None:
                self.value(step, scope)

    def _do_switch(self, node: ast.Switch, scope: dict[str, object]) -> None:
        subject = self.value(node.subject, scope)
        chosen = None
        for index, case in enumerate(node.cases):
            if case.value is not None and binary("==", subject, self.value(case.value, scope)) == 1.0:
                chosen = index
                break
        if chosen is None:
            chosen = next((n for n, c in enumerate(node.cases) if c.value is None), len(node.cases))
        try:
            for case in node.cases[chosen:]:
                for inner in case.body:
                    self.execute(inner, scope)
        except _Leave as leave:
            if leave.kind != "break":
                raise

    def _do_break(self, node: ast.Break, scope: dict[str, object]) -> None:
        raise _Leave("break")

    def _do_continue(self, node: ast.Continue, scope: dict[str, object]) -> None:
        raise _Leave("continue")

    def _do_return(self, node: ast.Return, scope: dict[str, object]) -> None:
        raise _Leave("return", UNDEFINED if node.value is None else self.value(node.value, scope))

    def value(self, node: ast.Expr, scope: dict[str, object]) -> object:
        return getattr(self, "_value_" + type(node).__name__.lower())(node, scope)

    def _value_number(self, node: ast.Number, scope: dict[str, object]) -> object:
        return node.value

    def _value_string(self, node: ast.String, scope: dict[str, object]) -> object:
        return node.text

    def _value_path(self, node: ast.Path, scope: dict[str, object]) -> object:
        return self._scope(node, scope).get(node.name, UNDEFINED)

    def _scope(self, node: ast.Path, scope: dict[str, object]) -> dict[str, object]:
        return self.globals if node.is_global else scope

    def _value_unary(self, node: ast.Unary, scope: dict[str, object]) -> object:
        value = self.value(node.operand, scope)
        if node.op == "!":
            return 0.0 if truth(value) else 1.0
        if value is UNDEFINED:
            value = 0.0
        if type(value) is not float:
            raise Refusal("E413")
        return -value if node.op == "-" else value

    def _value_logic(self, node: ast.Logic, scope: dict[str, object]) -> object:
        left = truth(self.value(node.left, scope))
        if left is (node.op == "||"):
            return 1.0 if left else 0.0
        return 1.0 if truth(self.value(node.right, scope)) else 0.0

    def _value_binary(self, node: ast.Binary, scope: dict[str, object]) -> object:
        left, right = self.value(node.left, scope), self.value(node.right, scope)
        return binary(node.op, left, right)

    def _value_assign(self, node: ast.Assign, scope: dict[str, object]) -> object:
        target = node.target
        if node.op == "=":
            value = self.value(node.value, scope)
        else:
            old = self.value(target, scope)
            value = binary(node.op[0], old, self.value(node.value, scope))
        self._store(target, value, scope)
        return value

    def _value_step(self, node: ast.Step, scope: dict[str, object]) -> object:
        old = self.value(node.target, scope)
        if old is UNDEFINED:
            old = 0.0
        if type(old) is not float:
            raise Refusal("E413")
        new = old + (1.0 if node.op == "++" else -1.0)
        self._store(node.target, new, scope)
        return new if node.prefix else old

    def _store(self, target: ast.Expr, value: object, scope: dict[str, object]) -> None:
        if isinstance(target, ast.Path):
            self._scope(target, scope)[target.name] = value
            return
        assert isinstance(target, ast.Field)
        holder = self.value(target.object, scope)
        if holder is UNDEFINED and isinstance(target.object, ast.Path):
            holder = _Object()
            self._store(target.object, holder, scope)
        if not isinstance(holder, _Object):
            raise Refusal("E42")
        holder[target.name] = value

    def _value_field(self, node: ast.Field, scope: dict[str, object]) -> object:
        holder = self.value(node.object, scope)
        if not isinstance(holder, _Object) or node.name not in holder:
            raise Refusal("E42")
        return holder[node.name]

    def _value_function(self, node: ast.Function, scope: dict[str, object]) -> object:
        return _Function(node)

    def _value_call(self, node: ast.Call, scope: dict[str, object]) -> object:
        if isinstance(node.callee, ast.Path) and node.callee.name == "print":
            values = [self.value(a, scope) for a in node.arguments]
            self.output.append(" ".join(map(shown, values)))
            return UNDEFINED
        function = self.value(node.callee, scope)
        arguments = [self.value(a, scope) for a in node.arguments]
        if not isinstance(function, _Function):
            raise Refusal("E43")
        parameters = function.node.parameters
        if len(arguments) != len(parameters):
            raise Refusal("E43")
        local = {p.name: a for p, a in zip(parameters, arguments, strict=True)}
        try:
            self.execute(function.node.body, local)
        except _Leave as leave:
            return leave.value
        return UNDEFINED


def binary(op: str, left: object, right: object) -> object:
    """`left op right` of two values."""
    if op in ("==", "!="):
        numbers = {type(left), type(right)} == {float, _Undefined}
        equal = 0.0 in (left, right) if numbers else type(left) is type(right) and left == right
        return 1.0 if equal is (op == "==") else 0.0
    texts = isinstance(left, str), isinstance(right, str)
    if op == "+" and any(texts):
        if not all(isinstance(v, str | float) for v in (left, right)):
            raise Refusal("E41")
        return "".join(v if isinstance(v, str) else format_number(v) for v in (left, right))
    if op in ("<", ">", "<=", ">=") and all(texts):
        return order(op, left, right)
    numbers = [0.0 if v is UNDEFINED else v for v in (left, right)]
    if any(type(v) is not float for v in numbers):
        raise Refusal("E41")
    a, b = numbers
    if op in ("<", ">", "<=", ">="):
        return order(op, a, b)
    if op in "/%" and b == 0.0:
        raise Refusal("E401")
    return arithmetic(op, a, b)


def order(op: str, a: object, b: object) -> float:
    holds = {"<": a < b, ">": a > b, "<=": a <= b, ">=": a >= b}[op]
    return 1.0 if holds else 0.0


def arithmetic(op: str, a: float, b: float) -> float:
    if op == "%":
        if math.isinf(a):
            return math.nan
        rest = math.fmod(a, b)
        if rest == 0.0:
            return math.copysign(rest, b)
        return rest + b if (rest < 0.0) is not (b < 0.0) else rest
    return {"+": a + b, "-": a - b, "*": a * b, "/": a / (b or 1.0)}[op]


def shown(value: object) -> str:
    """What `print` shows."""
    if type(value) is float:
        return format_number(value)
    if isinstance(value, str):
        return value
    return {_Undefined: "undef", _Function: "function"}.get(type(value), "object")
