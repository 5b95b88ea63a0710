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


class _Context:
    """What one context does with functions: found once, since the fixpoint asks again and again."""

    def __init__(self, resolution: Resolution, info: FunctionInfo | None, nodes: list[ast.Expr]) -> None:
        self.info = info
        self.calls: list[ast.Call] = []
        self.lent: list[tuple[str, FunctionInfo]] = []
        """Functions, and the names by which they are called from then on."""
        self.away: list[FunctionInfo] = []
        """Functions that get away as values."""
        self.read: set[str] = set()
        """Names of what is read as a value, built-ins left out."""
        used: set[int] = set()
        for node in nodes:
            if isinstance(node, ast.Assign):
                used.add(id(node.target))
                self._lend(node, resolution, used)
            elif isinstance(node, ast.Call):
                self.calls.append(node)
                used.add(id(node.callee))
        for node in nodes:
            if isinstance(node, _NAMED):
                if node.name not in self.read and id(node) not in used:
                    if not (isinstance(node, ast.Path) and resolution.is_builtin(node, info)):
                        self.read.add(node.name)
            elif isinstance(node, ast.Function) and id(node) not in used:
                self.away.append(resolution.functions[id(node)])

    def _lend(self, node: ast.Assign, resolution: Resolution, used: set[int]) -> None:
        value, target = node.value, node.target
        if not isinstance(value, ast.Function) or id(node) not in resolution.statement_values:
            return
        # Operators and elements have no name to be called by.
        is_operator = isinstance(target, ast.Field) and target.name.startswith("operator")
        name = None if is_operator else _last_name(target)
        if name is not None:
            used.add(id(value))
            self.lent.append((name, resolution.functions[id(value)]))


class YieldAnalysis:
    """`may_yield(call, context)` after `run()`; functions that suspend are marked in the resolution."""

    def __init__(self, resolution: Resolution) -> None:
        self.resolution = resolution
        self.names = {SUSPENDING_METHOD}
        self.escaped = False
        self._contexts = [_Context(resolution, None, nodes) for nodes in resolution.top.values()]
        self._contexts += [
            _Context(resolution, info, info.expressions) for info in resolution.functions.values()
        ]

    def run(self) -> None:
        """Mark functions until nothing changes."""
        state: tuple[object, ...] | None = None
        while True:
            for context in self._contexts:
                self._mark(context)
            for context in self._contexts:
                self._follow_values(context)
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

    def _mark(self, context: _Context) -> None:
        info = context.info
        if info is not None and not info.yields:
            info.yields = any(self.may_yield(call, info) for call in context.calls)

    def _follow_values(self, context: _Context) -> None:
        """Lend names to suspending functions; notice those that get away as values."""
        self.names.update(name for name, info in context.lent if info.yields)
        if not self.escaped:
            away = any(info.yields for info in context.away)
            self.escaped = away or not self.names.isdisjoint(context.read)
