"""Argument checks of built-ins, compiled to Python from the rows of the host table.

The compiled function tests arguments that are right beyond doubt in one expression and runs the
built-in; everything else goes the long way, `bind.make_checker`, which finds the words for what is
wrong. How many arguments a row without defaults gets, Python checks; `faults` puts that into words.
Rows that take strings, functions or any number of arguments have the long way only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cache
from types import GeneratorType
from typing import TYPE_CHECKING

from .values import FIELD, Undef, Value
from .vector import Vec3

if TYPE_CHECKING:
    from .bind import Builtin, HostParameter

Invoker = Callable[..., object]
LongWay = Callable[[tuple[object, ...]], Iterable[object]]

_FUNCTION = """
def make(head, run, slow):
    def invoke({parameters}):
        if {test}:
            return run(head, {arguments})
        return slow(({arguments}), {more})
    return invoke
"""
_METHOD = """
def make(run, slow):
    def invoke(self, _depth, {parameters}):
        if {test}:
            return run(self.rt, self, {arguments})
        return slow(self, ({arguments}), {more})
    return invoke
"""
_LONG_WAY_TYPES = frozenset(("str", "function"))


@dataclass(slots=True)
class _Text:
    """The pieces of one compiled function, and the names that they use."""

    parameters: list[str] = field(default_factory=list)
    tests: list[str] = field(default_factory=list)
    scope: dict[str, object] = field(default_factory=dict)


def kinds() -> dict[str, type]:
    """The class of every type of value that is a class, by the name that `typeof` gives it."""
    found: dict[str, type] = {}
    todo: list[type[Value]] = [Value]
    while todo:
        one = todo.pop()
        todo += one.__subclasses__()
        if "kind" in vars(one):
            found[one.kind] = one
    return found


def function_invoker(row: Builtin, head: object, long_way: LongWay) -> Invoker:
    """`row` as a function of its arguments; `run` gets `head` before them: a runtime or a place."""
    run = row.run
    make = _compile(row)
    if make is None:
        return lambda *arguments: run(head, *long_way(arguments))
    defaults = _defaults(row)

    def slow(arguments: tuple[object, ...], more: tuple[object, ...]) -> object:
        return run(head, *long_way(_given(arguments, more, defaults)))

    return named_for_faults(row, make(head, run, slow))


def method_invoker(row: Builtin, long_way: LongWay) -> Invoker:
    """`row` as a method of its owner's class, called with the hidden first argument of all calls."""
    run = row.run
    make = _compile(row)
    if make is None:

        def invoke(self: Value, _depth: object, *arguments: object) -> object:
            return run(self.rt, self, *long_way(arguments))  # type: ignore[attr-defined]

        return invoke
    defaults = _defaults(row)

    def slow(self: Value, arguments: tuple[object, ...], more: tuple[object, ...]) -> object:
        return run(self.rt, self, *long_way(_given(arguments, more, defaults)))  # type: ignore[attr-defined]

    return named_for_faults(row, make(run, slow))


def named_for_faults(row: Builtin, invoke: Invoker) -> Invoker:
    """`invoke`, under a name by which `faults` knows `row` when Python complains of the arguments' number."""
    invoke.__qualname__ = f"{FIELD}{row.name}"
    return invoke


def _defaults(row: Builtin) -> tuple[object, ...]:
    return tuple(_MISSING if p.required else p.default for p in row.parameters)


_MISSING = object()


def _given(
    arguments: tuple[object, ...], more: tuple[object, ...], defaults: tuple[object, ...]
) -> tuple[object, ...]:
    """The arguments that the call wrote."""
    if more:
        return arguments + more
    count = len(arguments)
    while count and arguments[count - 1] is defaults[count - 1]:
        count -= 1
    return arguments[:count]


@cache
def _compile(row: Builtin) -> Callable[..., Invoker] | None:
    """The maker of `row`'s invoker; None for a row that has only the long way."""
    text = _Text()
    fixed = all(parameter.required for parameter in row.parameters)
    for index, parameter in enumerate(row.parameters):
        test = _test(parameter, f"a{index}", text.scope)
        if test is None:
            return None
        default = f"D{index}"
        text.scope[default] = _MISSING if parameter.required else parameter.default
        text.parameters.append(f"a{index}" if fixed else f"a{index}={default}")
        text.tests.append(f"({test})" if parameter.required else f"(a{index} is {default} or {test})")
    count = len(row.parameters)
    pattern = _FUNCTION if row.owner is None else _METHOD
    source = pattern.format(
        parameters=", ".join(text.parameters if fixed else [*text.parameters, "*more"]),
        arguments="".join(f"a{n}, " for n in range(count)),
        test=" and ".join(text.tests if fixed else ["not more", *text.tests]) or "True",
        more="()" if fixed else "more",
    )
    scope: dict[str, object] = {"__builtins__": {}, "type": type, "float": float, **text.scope}
    scope.update(Vec3=Vec3, Undef=Undef, G=GeneratorType, MISSING=_MISSING)
    exec(compile(source, f"<{row.name}>", "exec"), scope)  # noqa: S102 - made of the host table alone
    return scope["make"]  # type: ignore[return-value]


def _test(parameter: HostParameter, name: str, scope: dict[str, object]) -> str | None:
    """An expression that is true only for right arguments; None when there is no short one."""
    if parameter.rest or _LONG_WAY_TYPES.intersection(parameter.types):
        return None
    classes = kinds()
    tests = []
    for kind in parameter.types:
        if kind == "num":
            below = "<" if parameter.open_low else "<="
            tests.append(f"type({name}) is float and {parameter.low!r} {below} {name} <= {parameter.high!r}")
        elif kind in ("vec3", "colour"):
            tests.append(_vector_test(name, kind == "colour"))
        elif kind in ("any", "anything"):
            undefined = f" and type({name}) is not Undef" if kind == "any" else ""
            tests.append(f"type({name}) is not G and {name} is not MISSING{undefined}")
        elif kind in classes:
            scope[f"T{kind}"] = classes[kind]
            tests.append(f"type({name}) is T{kind}")
        else:
            return None
    return " or ".join(tests)


def _vector_test(name: str, is_colour: bool) -> str:
    parts = [f"{name}[{n}]" for n in range(3)]
    positive = "".join(f" and {part} >= 0.0" for part in parts) if is_colour else ""
    return f"type({name}) is Vec3 and ({' + '.join(parts)}) * 0.0 == 0.0{positive}"
