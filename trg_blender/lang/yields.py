"""Which functions may suspend the program: a fixpoint over the names of calls.

`Scene.Render()` suspends. A function that calls a suspending name suspends, and lends that to the
name that it is assigned to. Once a suspending function gets away as a value, every call whose
callee is not a built-in may suspend.
"""

from __future__ import annotations

from . import ast
from .resolve import FunctionInfo, Resolution

SUSPENDING_METHOD = "Render"
_NAMED = (ast.Path, ast.Field)


def _last_name(node: ast.Expr) -> str | None:
    return node.name if isinstance(node, _NAMED) else None


class YieldAnalysis:
    """`may_yield(call, context)` after `run()`; functions that suspend are marked in the resolution."""

    def __init__(self, resolution: Resolution) -> None:
        self.resolution = resolution
        self.names = {SUSPENDING_METHOD}
        self.escaped = False
        self._contexts: list[tuple[FunctionInfo | None, list[ast.Expr]]] = [
            (None, expressions) for expressions in resolution.top.values()
        ]
        self._contexts += [(info, info.expressions) for info in resolution.functions.values()]
        self._calls = [
            (context, [e for e in expressions if isinstance(e, ast.Call)])
            for context, expressions in self._contexts
        ]

    def run(self) -> None:
        """Mark functions until nothing changes."""
        state: tuple[object, ...] | None = None
        while True:
            self._mark_functions()
            self._follow_values()
            marked = sum(info.yields for info in self.resolution.functions.values())
            now = (len(self.names), self.escaped, marked)
            if now == state:
                return
            state = now

    def may_yield(self, call: ast.Call, context: FunctionInfo | None) -> bool:
        """Whether this call may hand back a suspended computation."""
        callee = call.callee
        if isinstance(callee, ast.Path) and self.resolution.is_builtin(callee, context):
            return False
        if isinstance(callee, ast.Function):
            return self.resolution.functions[id(callee)].yields
        return self.escaped or _last_name(callee) in self.names

    def _mark_functions(self) -> None:
        for context, calls in self._calls:
            if context is not None and not context.yields:
                context.yields = any(self.may_yield(call, context) for call in calls)

    def _follow_values(self) -> None:
        """Lend names to suspending functions; notice those that get away as values."""
        functions = self.resolution.functions
        for context, expressions in self._contexts:
            named: set[int] = set()
            for node in expressions:
                if isinstance(node, ast.Assign):
                    named.add(id(node.target))
                    value = node.value
                    is_statement = id(node) in self.resolution.statement_values
                    name = self._lends_name(node.target) if is_statement else None
                    if isinstance(value, ast.Function) and name is not None:
                        named.add(id(value))
                        if functions[id(value)].yields:
                            self.names.add(name)
                elif isinstance(node, ast.Call):
                    named.add(id(node.callee))
            for node in expressions:
                if id(node) in named or self.escaped:
                    continue
                if isinstance(node, ast.Function):
                    self.escaped = functions[id(node)].yields
                elif isinstance(node, _NAMED) and node.name in self.names:
                    builtin = isinstance(node, ast.Path) and self.resolution.is_builtin(node, context)
                    self.escaped = not builtin

    @staticmethod
    def _lends_name(target: ast.Target) -> str | None:
        """The name by which a function assigned to `target` is called; operators and elements have none."""
        is_operator = isinstance(target, ast.Field) and target.name.startswith("operator")
        return None if is_operator else _last_name(target)
