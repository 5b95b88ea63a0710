"""The resolver: which variable every name means; static errors and lints.

A context is the top level of the program or one function. Functions see their parameters, the
names assigned in them, built-ins, and globals by `#name` or `space::name`; nothing else.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from . import ast
from .diagnostics import DiagnosticBag, Notice, closest, is_certain
from .look_alikes import lint_look_alikes
from .source import Span

TYPE_NAMES = (
    "num", "str", "vec3", "list", "object", "function", "undef",
    "scene", "shape", "light", "material", "texture", "medium",
)  # fmt: skip
HOST_SPACES = frozenset(("std", "mth", "material", "stl"))


@dataclass(slots=True)
class FunctionInfo:
    """What the emitter needs to know of one function."""

    node: ast.Function
    file: str
    index: int
    outer: FunctionInfo | None
    locals: dict[str, Span] = field(default_factory=dict)
    expressions: list[ast.Expr] = field(default_factory=list)
    yields: bool = False

    @property
    def name(self) -> str:
        return self.node.name or "function"

    @property
    def takes_self(self) -> bool:
        parameters = self.node.parameters
        return bool(parameters) and parameters[0].name == "self"


@dataclass(slots=True)
class Resolution:
    """The names of a whole program. `top` holds the top-level expressions of each file."""

    builtins: frozenset[str]
    globals: dict[str, Span] = field(default_factory=dict)
    functions: dict[int, FunctionInfo] = field(default_factory=dict)
    """By id() of the function's node."""
    top: dict[str, list[ast.Expr]] = field(default_factory=dict)
    file_variables: set[str] = field(default_factory=set)
    """Globals that no function and only one file names: nothing but that file's code can see them."""
    overloads: set[str] = field(default_factory=set)
    statement_values: set[int] = field(default_factory=set)
    """id() of every expression that is a whole statement: its value goes nowhere."""

    def is_builtin(self, path: ast.Path, context: FunctionInfo | None) -> bool:
        """Whether `path`, read in `context`, means a built-in."""
        if context is not None and not path.is_global and path.name in context.locals:
            return False
        return path.name in self.builtins


def default_expressions(node: ast.Function) -> list[ast.Expr]:
    """The expressions of a function's parameter defaults, inner ones included."""
    defaults = (p.default for p in node.parameters if p.default is not None)
    return ast.walk_context(tuple(ast.ExprStatement(d.span, d) for d in defaults))


class _Resolver:
    def __init__(self, builtins: frozenset[str], bag: DiagnosticBag) -> None:
        self.result = Resolution(builtins)
        self.bag = bag

    def run(self, files: list[ast.FileTree]) -> Resolution:
        result = self.result
        for tree in files:
            result.top[tree.name] = ast.walk_context(tree.statements)
            self._collect(result.top[tree.name], tree.name, None)
            self._look_at_statements(tree.statements)
        for tree in files:
            self._check(result.top[tree.name], None)
        for info in list(result.functions.values()):
            self._check(info.expressions, info)
            self._check_parameters(info)
        result.file_variables = self._find_file_variables()
        contexts = (result.globals, *(info.locals for info in result.functions.values()))
        lint_look_alikes((n for names in contexts for n in names.items()), result.builtins, self.bag)
        return result

    def _find_file_variables(self) -> set[str]:
        result = self.result
        places: dict[str, set[str]] = {name: set() for name in result.globals}
        contexts = [(f"file {name}", nodes) for name, nodes in result.top.items()]
        contexts += [("function", info.expressions) for info in result.functions.values()]
        for place, expressions in contexts:
            for node in expressions:
                if isinstance(node, ast.Path) and node.name in places:
                    if place != "function" or node.is_global:
                        places[node.name].add(place)
        return {name for name, found in places.items() if len(found) == 1 and "function" not in found}

    # Collecting: functions, and what is assigned where.

    def _collect(self, expressions: list[ast.Expr], file: str, context: FunctionInfo | None) -> None:
        for node in expressions:
            if isinstance(node, ast.Function):
                self._collect_function(node, file, context)
            elif isinstance(node, ast.ASSIGNING):
                self._collect_target(node.target, file, context)
                if isinstance(node.target, ast.Field):
                    self._note_overload(node.target)

    def _collect_function(self, node: ast.Function, file: str, outer: FunctionInfo | None) -> None:
        info = FunctionInfo(node, file, len(self.result.functions), outer)
        self.result.functions[id(node)] = info
        info.locals.update((p.name, p.span) for p in node.parameters)
        info.expressions = default_expressions(node) + ast.walk_context(node.body.statements)
        self._collect(info.expressions, file, info)
        self._look_at_statements(node.body.statements)

    def _look_at_statements(self, statements: tuple[ast.Statement, ...]) -> None:
        _LintWalk(self.bag).run(statements)
        self.result.statement_values.update(
            id(node.value) for node in _walk_statements(statements) if isinstance(node, ast.ExprStatement)
        )

    def _note_overload(self, target: ast.Field) -> None:
        if target.name.startswith("operator"):
            self.result.overloads.add(target.name.removeprefix("operator"))

    def _collect_target(self, target: ast.Expr, file: str, context: FunctionInfo | None) -> None:
        """Note the variable that an assignment to `target` creates, fields' objects included."""
        made_by_field = False
        if isinstance(target, ast.Field) and isinstance(target.object, ast.Path):
            target, made_by_field = target.object, True
        if not isinstance(target, ast.Path):
            return
        is_global = context is None or target.is_global
        if made_by_field and target.name in self.result.builtins:
            return
        if not is_global and context is not None:
            context.locals.setdefault(target.name, target.span)
        elif target.name in self.result.builtins:
            self._error("E310", target.span, "choose_other_name", name=target.name)
        elif self._is_host_name(target.name, file):
            space = target.name.split("::")[0]
            self._error("E311", target.span, "choose_other_space", name=space)
            self.result.globals.setdefault(target.name, target.span)  # one error is enough
        else:
            self.result.globals.setdefault(target.name, target.span)

    @staticmethod
    def _is_host_name(name: str, file: str) -> bool:
        space, separator, _ = name.partition("::")
        if not separator or space not in HOST_SPACES:
            return False
        return not (space == "stl" and file.startswith("stl/"))

    # Checking: every name that is read means something.

    def _check(self, expressions: list[ast.Expr], context: FunctionInfo | None) -> None:
        for node in expressions:
            if isinstance(node, ast.Path):
                self._check_path(node, context)

    def _check_path(self, path: ast.Path, context: FunctionInfo | None) -> None:
        result, name = self.result, path.name
        if context is not None and not path.is_global:
            if name in context.locals:
                return
            if name not in result.builtins:
                self._not_local(path, context)
        elif name not in result.globals and name not in result.builtins:
            self._not_defined(path, [*result.globals, *result.builtins])

    def _not_local(self, path: ast.Path, context: FunctionInfo) -> None:
        name = path.name
        outer = context.outer
        while outer is not None:
            if name in outer.locals and name not in self.result.globals:
                related = ((outer.locals[name], "outer_variable"),)
                self._add("E303", path, "not_a_closure", related)
                return
            outer = outer.outer
        if name in self.result.globals:
            notice = Notice(
                "E301", path.span, {"name": name}, "write_hash", None,
                ((self.result.globals[name], "global_here"),), (path.span, "#" + name),
            )  # fmt: skip
            self.bag.add(notice)
            return
        self._not_defined(path, [*context.locals, *self.result.builtins])

    def _add(self, code: str, path: ast.Path, hint: str, related: tuple[tuple[Span, str], ...]) -> None:
        self.bag.add(Notice(code, path.span, {"name": path.name}, hint, None, related))

    def _not_defined(self, path: ast.Path, candidates: list[str]) -> None:
        if self.bag.full:
            return
        values = {"name": path.name}
        guess = closest(path.name, candidates)
        if guess is None:
            self._error("E302", path.span, **values)
            return
        hint_values = {"name": guess}
        written = ("#" if path.hashed else "") + guess
        fix = (path.span, written) if is_certain(path.name, guess, candidates) else None
        self.bag.add(Notice("E302", path.span, values, "did_you_mean", hint_values, (), fix))

    def _check_parameters(self, info: FunctionInfo) -> None:
        for parameter in info.node.parameters:
            if parameter.type_name is not None and parameter.type_name not in TYPE_NAMES:
                self._unknown_type(parameter.type_name, parameter.type_span or parameter.span)
        for name, span in info.locals.items():
            if name in self.result.builtins:
                self.bag.add(Notice("L802", span, {"name": name}), "lint")

    def _unknown_type(self, name: str, span: Span) -> None:
        guess = closest(name, TYPE_NAMES)
        certain = guess is not None and is_certain(name, guess, TYPE_NAMES)
        fix = (span, f'"{guess}"') if certain else None
        self.bag.add(Notice("E304", span, {"name": name}, "did_you_mean", {"name": guess or "num"}, (), fix))

    def _error(self, code: str, span: Span, hint: str | None = None, **values: object) -> None:
        self.bag.add(Notice(code, span, values, hint))


class _LintWalk:
    """Finds what is allowed but is seldom meant, in the statements of one context."""

    def __init__(self, bag: DiagnosticBag) -> None:
        self.bag = bag

    def run(self, statements: tuple[ast.Statement, ...]) -> None:
        for node in _walk_statements(statements):
            if isinstance(node, ast.If):
                for condition, _ in node.branches:
                    self._condition(condition)
            elif isinstance(node, (ast.While, ast.For)) and node.condition is not None:
                self._condition(node.condition)
            elif isinstance(node, ast.Switch):
                self._fall_through(node)

    def _condition(self, condition: ast.Expr) -> None:
        if isinstance(condition, ast.Assign) and condition.op == "=":
            self.bag.add(Notice("L801", condition.span, {}, "write_equals"), "lint")

    def _fall_through(self, node: ast.Switch) -> None:
        for case in node.cases[:-1]:
            last = case.body[-1] if case.body else None
            if last is not None and not isinstance(last, ast.Break | ast.Continue | ast.Return):
                self.bag.add(Notice("L803", case.span, {}, "write_break"), "lint")


def _walk_statements(statements: tuple[ast.Statement, ...]) -> Iterator[ast.Statement]:
    todo = list(reversed(statements))
    while todo:
        node = todo.pop()
        yield node
        todo.extend(reversed(ast.parts_of(node)[1]))


def resolve_program(files: list[ast.FileTree], builtins: frozenset[str], bag: DiagnosticBag) -> Resolution:
    """The meaning of every name of the program made of `files`. Errors and lints go to `bag`."""
    return _Resolver(builtins, bag).run(files)
