"""The last fence before `compile`: the translated tree holds nothing but what the emitter may make.

It guards against mistakes of our own emitter: whatever the program's text, no attribute without the
prefix `T_`, no name outside the scheme, no statement or expression of another kind gets through.
"""

from __future__ import annotations

import ast as py
import re

from .pytree import SLOTTED, Read, Write

ALLOWED_NODES: frozenset[type] = frozenset(
    {
        py.Module, py.FunctionDef, py.arguments, py.arg, py.Global, py.Return, py.Pass,
        py.Expr, py.Assign, py.AugAssign, py.If, py.While, py.For, py.Break, py.Continue,
        py.Name, py.Constant, py.Attribute, py.Call, py.BinOp, py.UnaryOp, py.BoolOp,
        py.Compare, py.IfExp, py.NamedExpr, py.Tuple, py.Subscript, py.Yield, py.YieldFrom,
        py.Load, py.Store, py.Add, py.Sub, py.Mult, py.Div, py.Mod, py.USub, py.UAdd, py.Not,
        py.And, py.Or, py.Eq, py.NotEq, py.Lt, py.LtE, py.Gt, py.GtE, py.Is, py.IsNot, *SLOTTED,
    }
)  # fmt: skip
_NAME = re.compile(r"[glb]_.+|[fmcp]_[0-9]+|[tkn][0-9]+_|[A-Z]_|[ud]_|t_(?:num|str|vec3|list|object)?|_")
_HELPER = re.compile(r"[A-Z]_")
_WORDS = frozenset(("id", "attr", "name", "names", "arg", "kind", "type_comment"))
_FIELDS = {
    kind: () if issubclass(kind, py.Constant) else tuple(f for f in kind._fields if f not in _WORDS)  # type: ignore[attr-defined]
    for kind in ALLOWED_NODES
}
"""What in a node holds nodes; all of them must be allowed."""
_LOOKED_INTO = frozenset(
    kind
    for kind in ALLOWED_NODES
    if issubclass(kind, (py.Attribute, py.Call, py.Constant, py.FunctionDef, py.Global))
)


class ForbiddenTree(Exception):
    """The emitter made something that it must not make: a bug of ours."""


def check_tree(tree: py.Module) -> None:
    """Raise ForbiddenTree unless every node of `tree` is on the allow-list."""
    todo: list[object] = [tree]
    known: set[str] = set()
    texts: set[int] = set()
    while todo:
        node = todo.pop()
        kind = type(node)
        if isinstance(node, py.Name):
            if node.id not in known:
                _check_name(node.id)
                known.add(node.id)
            if kind is Read or kind is Write:
                continue
        fields = _FIELDS.get(kind)
        if fields is None:
            raise ForbiddenTree(kind.__name__)
        if kind in _LOOKED_INTO:
            _look_into(node, texts)
        for field in fields:
            value = getattr(node, field, None)
            if type(value) is list:
                todo.extend(value)
            elif value is not None:
                todo.append(value)


def _look_into(node: object, texts: set[int]) -> None:
    """Check the words and values of a node; `texts` are the constants that may be strings."""
    if isinstance(node, py.Attribute):
        if not node.attr.startswith("T_"):
            raise ForbiddenTree(f"attribute {node.attr}")
    elif isinstance(node, py.Call):
        _check_call(node, texts)
    elif isinstance(node, py.Constant):
        _check_constant(node, texts)
    elif isinstance(node, py.FunctionDef):
        _check_function(node)
    elif isinstance(node, py.Global):
        for name in node.names:
            _check_name(name)


def _check_name(name: str) -> None:
    if not _NAME.fullmatch(name):
        raise ForbiddenTree(f"name {name}")


def _check_call(node: py.Call, texts: set[int]) -> None:
    if node.keywords:
        raise ForbiddenTree("keyword argument")
    if isinstance(node.func, py.Name) and _HELPER.fullmatch(node.func.id):
        texts.update(id(a) for a in node.args if isinstance(a, py.Constant))


def _check_constant(node: py.Constant, texts: set[int]) -> None:
    if type(node.value) is str and id(node) in texts:
        return
    if type(node.value) not in (float, int, bool):
        raise ForbiddenTree(f"constant of type {type(node.value).__name__}")


def _check_function(node: py.FunctionDef) -> None:
    _check_name(node.name)
    spec = node.args
    if node.decorator_list or spec.vararg or spec.kwarg or spec.kwonlyargs or spec.posonlyargs:
        raise ForbiddenTree("function signature")
    for argument in spec.args:
        _check_name(argument.arg)
