"""Translation of statements, functions and files to a Python syntax tree.

A loop runs over `S_`, an iterator over a slice of the budget's steps. When it is used up, code that
may suspend (files, and functions that reach Render) hands control back to the session; other code
calls `T_`, which puts the next slice in its place or raises at a limit.
"""

from __future__ import annotations

import ast as py

from . import ast
from .emit_expr import ExpressionEmitter, ProgramParts, step_amount
from .pytree import (
    COMPARISONS,
    IS,
    IS_NOT,
    LOAD,
    NOT,
    STORE,
    assign,
    at,
    attribute,
    augment,
    call,
    compare,
    constant,
    count_steps,
    element,
    forever,
    leave,
    load,
    statement,
    store,
    tick,
    unary,
    walk,
    when,
)
from .resolve import FunctionInfo
from .source import Span

TICK_WEIGHT = 300
_GUARD_WEIGHT = 8
_EXACT_TYPES = frozenset(("num", "str", "vec3", "list", "object"))
_CONTINUE = -1


class _Switch:
    """A switch being translated: the variable that says where to go on."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.continues = False


class StatementEmitter:
    """Translates the statements of one context."""

    def __init__(self, parts: ProgramParts, context: FunctionInfo | None) -> None:
        self.parts = parts
        self.expressions = ExpressionEmitter(parts, context)
        self.includes: dict[Span, int] = {}
        self._around: list[_Switch | None] = []

    def block(self, statements: tuple[ast.Statement, ...]) -> list[py.stmt]:
        """The statements in order, with steps of the budget in between; never empty."""
        made: list[py.stmt] = []
        for node in statements:
            made += self._statement(node)
            ticks, self.expressions.weight = divmod(self.expressions.weight, TICK_WEIGHT)
            made += [tick(node.span) for _ in range(ticks)]
        if not made:
            made.append(at(py.Pass(), statements[0].span if statements else _NOWHERE))
        return made

    def _statement(self, node: ast.Statement) -> list[py.stmt]:
        span = node.span
        self.expressions.weight += 1
        match node:
            case ast.ExprStatement():
                with_own = self.expressions.temporaries
                made = self._expression(node.value)
                self.expressions.temporaries = with_own  # what it held in them is no longer needed
                return made
            case ast.Block():
                return self.block(node.statements) if node.statements else []
            case ast.If():
                return self._if(node)
            case ast.While():
                return self._loop(self._guarded(node.condition, node.body, span), span)
            case ast.For():
                return self._for(node)
            case ast.Export():
                return [self._export(node)]
            case ast.ForEach():
                return self._for_each(node)
            case ast.Switch():
                return self._switch(node)
            case ast.Break():
                return [leave(span)]
            case ast.Continue():
                return self._continue(span)
            case ast.Return():
                value = load("u_", span) if node.value is None else self.expressions.value(node.value)
                return [at(py.Return(value), span)]
            case ast.Include():
                return self._include(node)

    def _include(self, node: ast.Include) -> list[py.stmt]:
        index = self.includes.get(node.span)
        if index is None:
            return []
        run = call(f"m_{index}", [load("d_", node.span)], node.span)
        return [statement(at(py.YieldFrom(run), node.span), node.span)]

    # Expressions as statements.

    def _expression(self, node: ast.Expr) -> list[py.stmt]:
        emit = self.expressions
        if isinstance(node, ast.Assign):
            return self._assign(node)
        if isinstance(node, ast.Step):
            emit.site(node, node.op, (node.target,))
            amount = constant(step_amount(node.op), node.span)
            return [self._augment(node.target, "-", amount, node.span)]
        return [statement(emit.value(node), node.span)]

    def _assign(self, node: ast.Assign) -> list[py.stmt]:
        emit, target, span = self.expressions, node.target, node.span
        emit.site(node, node.op, (target, node.value))
        value = emit.value(node.value)
        if node.op != "=":
            return [self._augment(target, node.op[0], value, span)]
        if isinstance(target, ast.Path):
            return [assign(store(emit.variable(target), target.span), value, span)]
        if isinstance(target, ast.Index):
            return [assign(self._target(target), value, span)]
        return self._assign_field(target, value, span)

    def _augment(self, target: ast.Target, op: str, value: py.expr, span: Span) -> py.stmt:
        return augment(self._target(target), op, value, span)

    def _target(self, target: ast.Target) -> py.Name | py.Attribute | py.Subscript:
        emit = self.expressions
        if isinstance(target, ast.Path):
            return store(emit.variable(target), target.span)
        if isinstance(target, ast.Index):
            return emit.element(target, STORE)
        emit.site(target, ".=", (target.object,), by_field=True)
        return attribute(emit.value(target.object), target.name, target.span, STORE)

    def _assign_field(self, target: ast.Field, value: py.expr, span: Span) -> list[py.stmt]:
        """A variable without a value becomes an object, after the value has been computed."""
        emit, holder = self.expressions, target.object
        if not isinstance(holder, ast.Path) or emit.is_builtin(holder):
            return [assign(self._target(target), value, span)]
        held = emit.temporary()
        undefined = compare(emit.value(holder), IS, load("u_", span), span)
        name = emit.variable(holder)
        fresh = assign(store(name, span), call("O_", [], span), span)
        return [
            assign(store(held, span), value, span),
            when(undefined, [fresh], span),
            assign(self._target(target), load(held, span), span),
        ]

    def _export(self, node: ast.Export) -> py.stmt:
        target, span = node.assignment.target, node.assignment.span
        assert isinstance(target, ast.Path)
        value = call("V_", [constant(target.name, span)], span)
        return assign(store(self.expressions.variable(target), span), value, span)

    # Branches and loops.

    def _if(self, node: ast.If) -> list[py.stmt]:
        branches = [(self.expressions.condition(test), self.block((body,))) for test, body in node.branches]
        orelse = [] if node.otherwise is None else self.block((node.otherwise,))
        for test, body in reversed(branches):
            orelse = [when(test, body, node.span, orelse)]
        return orelse

    def _guarded(self, condition: ast.Expr | None, body: ast.Statement, span: Span) -> list[py.stmt]:
        """Leave the loop unless the condition holds, then the body."""
        made: list[py.stmt] = []
        if condition is not None:
            test = unary(NOT, self.expressions.condition(condition), condition.span)
            made.append(when(test, [leave(span)], span))
        self._around.append(None)
        made += self.block((body,))
        self._around.pop()
        return made

    def _loop(self, body: list[py.stmt], span: Span) -> list[py.stmt]:
        suspend: py.expr = at(py.Yield(load("P_", span)), span)
        refill = suspend if self.expressions.suspends else call("T_", [], span)
        inner = count_steps(body, [statement(refill, span), at(py.Continue(), span)], span)
        return [forever([inner, leave(span)], span)]

    def _for(self, node: ast.For) -> list[py.stmt]:
        """With a `continue` inside, the step stands first and a flag skips it on the first turn."""
        span = node.span
        made = [] if node.init is None else self._expression(node.init)
        body = self._guarded(node.condition, node.body, span)
        if node.step is None:
            return made + self._loop(body, span)
        step = self._expression(node.step)
        if not _continues(node.body):
            return made + self._loop(body + step, span)
        flag = self.expressions.temporary("n")
        raised = assign(store(flag, span), constant(1, span), span)
        first = when(load(flag, span), step, span, [raised])
        made.append(assign(store(flag, span), constant(0, span), span))
        return made + self._loop([first, *body], span)

    def _for_each(self, node: ast.ForEach) -> list[py.stmt]:
        """Elements come from an iterator over the living list, with one step of the budget each."""
        emit, span, head = self.expressions, node.span, node.head
        emit.site(head, "in", (head.subject,))
        name = emit.variable(head.target)
        items = call("I_", [emit.value(head.subject)], head.span)
        # Taken before the body: what its statements give back must not be these.
        place, found = emit.temporary(), emit.temporary()
        self._around.append(None)
        body = self.block((node.body,))
        self._around.pop()
        if not emit.suspends:
            paced = call("C_", [items, load("K_", span)], span)
            return [walk(store(name, span), paced, body, [], span)]
        ended = compare(load(found, span), IS, load("A_", span), span)
        taken = call("Q_", [load(place, span), load("A_", span)], span)
        first = [
            assign(store(found, span), taken, span),
            when(ended, [leave(span)], span),
            assign(store(name, span), load(found, span), span),
        ]
        return [assign(store(place, span), items, span), *self._loop([*first, *body], span)]

    def _continue(self, span: Span) -> list[py.stmt]:
        switch = self._around[-1]
        if switch is None:
            return [at(py.Continue(), span)]
        switch.continues = True
        mark = assign(store(switch.name, span), constant(_CONTINUE, span), span)
        return [mark, leave(span)]

    def _switch(self, node: ast.Switch) -> list[py.stmt]:
        """Choose the case in one loop that runs once, then fall through from it in another."""
        emit, span = self.expressions, node.span
        subject, chosen = emit.temporary(), emit.temporary("k")
        made: list[py.stmt] = [assign(store(subject, span), emit.value(node.subject), span)]
        made.append(forever(self._choose(node, subject, chosen), span))
        switch = _Switch(chosen)
        self._around.append(switch)
        bodies: list[py.stmt] = []
        for index, case in enumerate(node.cases):
            if case.body:
                test = compare(load(chosen, span), COMPARISONS["<="], constant(index, span), case.span)
                bodies.append(when(test, self.block(case.body), case.span))
        self._around.pop()
        made.append(forever([*bodies, leave(span)], span))
        if switch.continues:
            test = compare(load(chosen, span), COMPARISONS["=="], constant(_CONTINUE, span), span)
            made.append(when(test, self._continue(span), span))
        return made

    def _choose(self, node: ast.Switch, subject: str, chosen: str) -> list[py.stmt]:
        emit, default = self.expressions, len(node.cases)
        made: list[py.stmt] = []
        for index, case in enumerate(node.cases):
            if case.value is None:
                default = index
                continue
            value = emit.value(case.value)
            test = emit.equal(load(subject, case.value.span), value, case.value.span)
            take = assign(store(chosen, case.span), constant(index, case.span), case.span)
            made.append(when(test, [take, leave(case.span)], case.span))
        made.append(assign(store(chosen, node.span), constant(default, node.span), node.span))
        made.append(leave(node.span))
        return made


_NOWHERE = Span("", 1, 1, 1, 1)


def _continues(body: ast.Statement) -> bool:
    """Whether a `continue` inside belongs to the loop around `body`."""
    todo = [body]
    while todo:
        node = todo.pop()
        if isinstance(node, ast.Continue):
            return True
        if not isinstance(node, (ast.While, ast.For, ast.ForEach)):
            todo.extend(ast.parts_of(node)[1])
    return False


def _global_names(expressions: list[ast.Expr], context: FunctionInfo | None) -> list[str]:
    """The globals that a context assigns to."""
    names: dict[str, None] = {}
    for node in expressions:
        if not isinstance(node, ast.ASSIGNING):
            continue
        target: ast.Expr = node.target
        if isinstance(target, ast.Field):
            target = target.object
        if isinstance(target, ast.Path) and (context is None or target.is_global):
            names[target.name] = None
    return list(names)


def _declare(names: list[str], span: Span) -> list[py.stmt]:
    return [at(py.Global(names), span)] if names else []


def _define(name: str, parameters: list[str], required: int, body: list[py.stmt]) -> py.FunctionDef:
    span = Span("", 1, 1, 1, 1)
    arguments = [at(py.arg(p), span) for p in ("d_", *parameters)]
    defaults: list[py.expr] = [load("A_", span) for _ in parameters[required:]]
    spec = py.arguments([], arguments, None, [], [], None, defaults)
    return at(py.FunctionDef(name, spec, body, []), span)


class FunctionEmitter:
    """Translates one function to a definition `f_<index>(d_, l_...)`; `d_` holds the calls left."""

    def __init__(self, parts: ProgramParts, info: FunctionInfo) -> None:
        self.info = info
        self.parts = parts
        self.statements = StatementEmitter(parts, info)

    def define(self) -> py.FunctionDef:
        info = self.info
        span = info.node.span
        parameters = info.node.parameters
        body = _declare(["g_" + name for name in _global_names(info.expressions, info)], span)
        statements = info.node.body.statements
        guarded = self._begins_with_guard()
        body += [self._descend(span)] if guarded else [self._descend(span), tick(span)]
        own = {p.name for p in parameters}
        body += [
            assign(store("l_" + name, span), load("u_", span), span)
            for name in info.locals
            if name not in own
        ]
        defaults = [p.default is not None for p in parameters]
        required = defaults.index(True) if True in defaults else len(parameters)
        for index, parameter in enumerate(parameters):
            body += self._parameter(parameter, index >= required)
        if guarded:
            body += [*self.statements.block(statements[:1]), tick(span)]
        body += self.statements.block(statements[1:] if guarded else statements)
        body.append(at(py.Return(load("u_", span)), span))
        if info.yields:
            body.append(statement(at(py.Yield(load("P_", span)), span), span))
        return _define(f"f_{info.index}", ["l_" + p.name for p in parameters], required, body)

    def _begins_with_guard(self) -> bool:
        """Whether the body begins with an `if (...) return ...;` that cannot call anything.

        What it ends is counted by the caller's step: the leaves of a recursion cost nothing more.
        """
        node = self.info.node
        first = node.body.statements[0] if node.body.statements else None
        if not isinstance(first, ast.If) or self.parts.resolution.overloads:
            return False
        body = first.branches[0][1]
        inside = ast.walk_context((first,))
        return (
            isinstance(body, ast.Return)
            and first.otherwise is None
            and len(first.branches) == 1
            and len(inside) <= _GUARD_WEIGHT
            and all(isinstance(e, ast.Path | ast.Number | ast.Binary) for e in inside)
            and all(p.default is None for p in node.parameters)
        )

    @staticmethod
    def _descend(span: Span) -> py.stmt:
        """One call deeper: see runtime.CALL_LEVELS."""
        inner = element(load("d_", span), constant(0, span), span, LOAD)
        return assign(store("d_", span), inner, span)

    def _parameter(self, parameter: ast.Parameter, may_lack: bool) -> list[py.stmt]:
        """Fill in the default, then check the type."""
        span, name = parameter.span, "l_" + parameter.name
        emit = self.statements.expressions
        made: list[py.stmt] = []
        if may_lack:
            lacks = compare(load(name, span), IS, load("A_", span), span)
            if parameter.default is None:
                missing = call("R_", [constant(parameter.name, span)], span)
                fill: py.stmt = statement(missing, span)
            else:
                names = [p.name for p in self.info.node.parameters]
                emit.not_yet = frozenset(names[names.index(parameter.name) :])
                fill = assign(store(name, span), emit.value(parameter.default), span)
                emit.not_yet = frozenset()
            made.append(when(lacks, [fill], span))
        kind = parameter.type_name
        if kind is not None:
            arguments = [load(name, span), constant(parameter.name, span), constant(kind, span)]
            check: py.stmt = statement(call("W_", arguments, span), span)
            if kind in _EXACT_TYPES:
                found = call("Y_", [load(name, span)], span)
                check = when(compare(found, IS_NOT, load("t_" + kind, span), span), [check], span)
            made.append(check)
        return made


def emit_file(parts: ProgramParts, tree: ast.FileTree, index: int, includes: dict[Span, int]) -> py.Module:
    """The Python module of one file: its functions, and the generator `m_<index>` that runs it."""
    functions = [i for i in parts.resolution.functions.values() if i.file == tree.name]
    body: list[py.stmt] = [FunctionEmitter(parts, info).define() for info in functions]
    statements = StatementEmitter(parts, None)
    statements.includes = includes
    assigned = _global_names(parts.resolution.top[tree.name], None)
    own = [name for name in assigned if name in parts.resolution.file_variables]
    shared = [name for name in assigned if name not in parts.resolution.file_variables]
    main = _declare(["g_" + name for name in shared], _NOWHERE)
    main += [assign(store("l_" + name, _NOWHERE), load("u_", _NOWHERE), _NOWHERE) for name in own]
    main.append(statement(at(py.Yield(load("P_", _NOWHERE)), _NOWHERE), _NOWHERE))
    main += statements.block(tree.statements)
    body.append(_define(f"m_{index}", [], 0, main))
    return py.Module(body, [])
