"""A plain tree-walking evaluator of the core of the language, to compare the real one with.

It walks the syntax tree as the reference describes it and takes nothing from the translator or the
runtime but the formatting of numbers. It knows numbers, strings, vectors, lists, variables, functions,
objects with their overloads, loops, branches and `print`; `Refusal` means that the program has an error
there, and its kind.
"""

from __future__ import annotations

import sys
from pathlib import Path

from trg_blender.lang import SourceFile, ast
from trg_blender.lang.diagnostics import DiagnosticBag
from trg_blender.lang.parse import parse_source

sys.path.insert(0, str(Path(__file__).resolve().parent))
from oracle_values import (  # noqa: E402
    UNDEFINED,
    Function,
    List,
    Object,
    Refusal,
    Vector,
    binary,
    make_vector,
    negated,
    place_in,
    shown,
    truth,
)

_BUILTINS = ("print", "vec3", "len", "object")
_MIRRORED = ("<", ">", "<=", ">=", "==", "!=", "!")


class OutOfSteps(Exception):
    """The program runs longer than the comparison goes."""


class _Leave(Exception):
    """`break`, `continue` or `return` on its way out."""

    def __init__(self, kind: str, value: object = None) -> None:
        super().__init__(kind)
        self.kind, self.value = kind, value


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
            if case.value is not None and self._equal(subject, case.value, scope):
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

    def _equal(self, subject: object, value: ast.Expr, scope: dict[str, object]) -> bool:
        return self._binary("==", subject, self.value(value, scope)) == 1.0

    def _do_foreach(self, node: ast.ForEach, scope: dict[str, object]) -> None:
        subject = self.value(node.head.subject, scope)
        if not isinstance(subject, List):
            raise Refusal("E444")
        place = 0
        while place < len(subject.items):
            self._store(node.head.target, subject.items[place], scope)
            place += 1
            self.steps -= 1
            if self.steps < 0:
                raise OutOfSteps
            try:
                self.execute(node.body, scope)
            except _Leave as leave:
                if leave.kind == "break":
                    return
                if leave.kind == "return":
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
            field = self._overload("!", value)
            if field is not None:
                return 1.0 if truth(self._call(field, [value])) else 0.0
            return 0.0 if truth(value) else 1.0
        field = self._overload("-", value) if node.op == "-" else None
        return negated(node.op, value) if field is None else self._call_operator(field, [0.0, value])

    def _value_logic(self, node: ast.Logic, scope: dict[str, object]) -> object:
        left = truth(self.value(node.left, scope))
        if left is (node.op == "||"):
            return 1.0 if left else 0.0
        return 1.0 if truth(self.value(node.right, scope)) else 0.0

    def _value_binary(self, node: ast.Binary, scope: dict[str, object]) -> object:
        left, right = self.value(node.left, scope), self.value(node.right, scope)
        return self._binary(node.op, left, right)

    @staticmethod
    def _overload(op: str, *operands: object) -> object:
        """The operator field that counts, or None."""
        for value in operands:
            if isinstance(value, Object) and "operator" + op in value:
                return value["operator" + op]
        return None

    def _binary(self, op: str, left: object, right: object) -> object:
        field, opposite = self._overload(op, left, right), False
        if field is None and op == "!=":
            field, opposite = self._overload("==", left, right), True
        if field is None:
            return binary(op, left, right)
        value = self._call_operator(field, [left, right])
        if op not in _MIRRORED:
            return value
        return 1.0 if truth(value) is not opposite else 0.0

    def _call_operator(self, field: object, operands: list[object]) -> object:
        if not isinstance(field, Function):
            raise Refusal("E416")
        return self._call(field, operands)

    def _value_assign(self, node: ast.Assign, scope: dict[str, object]) -> object:
        target = node.target
        if node.op == "=":
            value = self.value(node.value, scope)
            self._store(target, value, scope)
            return value
        place = self._place(target, scope)
        value = self._binary(node.op[0], self._read(place), self.value(node.value, scope))
        self._write(place, value)
        return value

    def _value_step(self, node: ast.Step, scope: dict[str, object]) -> object:
        place = self._place(node.target, scope)
        old = self._read(place)
        if old is UNDEFINED:
            old = 0.0
        field = self._overload(node.op[0], old)
        if field is not None:
            new = self._call_operator(field, [old, 1.0])
        elif type(old) is float:
            new = old + (1.0 if node.op == "++" else -1.0)
        else:
            raise Refusal("E413")
        self._write(place, new)
        return new if node.prefix else old

    def _place(self, target: ast.Expr, scope: dict[str, object]) -> tuple[object, object]:
        """Where a target lies: its holder, and its name or index there. Found once."""
        if isinstance(target, ast.Path):
            return self._scope(target, scope), target.name
        holder = self.value(target.object, scope)
        return holder, target.name if isinstance(target, ast.Field) else self.value(target.index, scope)

    def _read(self, place: tuple[object, object]) -> object:
        holder, key = place
        if isinstance(holder, List) or not isinstance(key, str):
            if isinstance(key, str) and not isinstance(holder, List):
                raise Refusal("E4")
            return self._element(holder, key)
        if type(holder) is dict:
            return holder.get(key, UNDEFINED)
        return self._field(holder, key)

    def _write(self, place: tuple[object, object], value: object) -> None:
        holder, key = place
        if isinstance(holder, List):
            holder.items[place_in(holder, key)] = value
        elif isinstance(holder, dict):
            holder[key] = value
        else:
            raise Refusal("E42")

    def _store(self, target: ast.Expr, value: object, scope: dict[str, object]) -> None:
        if isinstance(target, ast.Path):
            self._scope(target, scope)[target.name] = value
            return
        holder = self.value(target.object, scope)
        if isinstance(target, ast.Index):
            index = self.value(target.index, scope)
            holder.items[place_in(holder, index)] = value
            return
        if holder is UNDEFINED and isinstance(target.object, ast.Path):
            holder = Object()
            self._store(target.object, holder, scope)
        if not isinstance(holder, Object):
            raise Refusal("E42")
        holder[target.name] = value

    def _value_field(self, node: ast.Field, scope: dict[str, object]) -> object:
        return self._field(self.value(node.object, scope), node.name)

    def _field(self, holder: object, name: str) -> object:
        if isinstance(holder, Vector) and name in ("x", "y", "z"):
            return holder.parts["xyz".index(name)]
        if not isinstance(holder, Object) or name not in holder:
            raise Refusal("E42")
        return holder[name]

    def _value_index(self, node: ast.Index, scope: dict[str, object]) -> object:
        return self._element(self.value(node.object, scope), self.value(node.index, scope))

    def _element(self, holder: object, index: object) -> object:
        return holder.items[place_in(holder, index)]

    def _value_listof(self, node: ast.ListOf, scope: dict[str, object]) -> object:
        return List([self.value(element, scope) for element in node.elements])

    def _value_function(self, node: ast.Function, scope: dict[str, object]) -> object:
        return Function(node)

    def _value_call(self, node: ast.Call, scope: dict[str, object]) -> object:
        if isinstance(node.callee, ast.Path) and node.callee.name in _BUILTINS:
            return self._call_builtin(node.callee.name, [self.value(a, scope) for a in node.arguments])
        if isinstance(node.callee, ast.Field):
            holder = self.value(node.callee.object, scope)
            if isinstance(holder, List):
                if node.callee.name not in ("append", "pop"):
                    raise Refusal("E42")
                return self._call_method(holder, node, scope)
            function = self._field(holder, node.callee.name)
        else:
            function = self.value(node.callee, scope)
        return self._call(function, [self.value(a, scope) for a in node.arguments])

    def _call_method(self, holder: List, node: ast.Call, scope: dict[str, object]) -> object:
        arguments = [self.value(a, scope) for a in node.arguments]
        if node.callee.name == "append":
            holder.items.append(*arguments)
            return holder
        if not holder.items:
            raise Refusal("E445")
        return holder.items.pop()

    def _call_builtin(self, name: str, arguments: list[object]) -> object:
        if name == "print":
            self.output.append(" ".join(map(shown, arguments)))
            return UNDEFINED
        if name == "vec3":
            return make_vector(arguments)
        if name == "object":
            return Object()
        (value,) = arguments
        if not isinstance(value, str | List):
            raise Refusal("E50")
        return float(len(value if isinstance(value, str) else value.items))

    def _call(self, function: object, arguments: list[object]) -> object:
        if not isinstance(function, Function):
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
