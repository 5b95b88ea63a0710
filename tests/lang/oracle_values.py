"""The values of the plain evaluator of `oracle.py`, and what operators do to them without overloads."""

from __future__ import annotations

import math

from trg_blender.lang import ast
from trg_blender.lang.values import format_number


class Refusal(Exception):
    """The program is wrong at this point; `code` as in the table of messages."""

    def __init__(self, code: str) -> None:
        super().__init__(code)
        self.code = code


class Undefined:
    """The one value of variables that have none."""


UNDEFINED = Undefined()


class Function:
    def __init__(self, node: ast.Function) -> None:
        self.node = node


class Object(dict):
    __hash__ = object.__hash__

    def __eq__(self, other: object) -> bool:
        return self is other


class List:
    def __init__(self, items: list[object]) -> None:
        self.items = items


class Vector:
    def __init__(self, *parts: float) -> None:
        self.parts = parts

    def __eq__(self, other: object) -> bool:
        pairs = zip(self.parts, other.parts, strict=True) if isinstance(other, Vector) else [(0.0, 1.0)]
        return all(a == b for a, b in pairs)

    __hash__ = None


def truth(value: object) -> bool:
    return not (value is UNDEFINED or value == 0.0 or value == "")


def make_vector(arguments: list[object]) -> Vector:
    """`vec3(...)`."""
    if len(arguments) not in (1, 3):
        raise Refusal("E50")
    for value in arguments:
        if type(value) is not float or not math.isfinite(value):
            raise Refusal("E50")
    return Vector(*(arguments if len(arguments) == 3 else arguments * 3))


def negated(op: str, value: object) -> object:
    """A sign before a value."""
    if isinstance(value, Vector):
        return Vector(*(-part for part in value.parts)) if op == "-" else value
    if value is UNDEFINED:
        value = 0.0
    if type(value) is not float:
        raise Refusal("E413")
    return -value if op == "-" else value


def place_in(holder: object, index: object) -> int:
    """The index as one of Python's."""
    if not isinstance(holder, List):
        raise Refusal("E44")
    if type(index) is not float or not 0.0 <= index < len(holder.items) or index != index // 1.0:
        raise Refusal("E44")
    return int(index)


def binary(op: str, left: object, right: object) -> object:
    """`left op right` of two values."""
    if op in ("==", "!="):
        numbers = {type(left), type(right)} == {float, Undefined}
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
    if any(isinstance(v, Vector) for v in numbers):
        return vector_arithmetic(op, *numbers)
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


def vector_arithmetic(op: str, a: object, b: object) -> Vector:
    kinds = tuple("v" if isinstance(v, Vector) else "n" if type(v) is float else "?" for v in (a, b))
    if (op, *kinds) not in {
        ("+", "v", "v"), ("-", "v", "v"), ("*", "v", "v"), ("*", "v", "n"), ("*", "n", "v"), ("/", "v", "n"),
    }:  # fmt: skip
        raise Refusal("E41")
    if op == "/" and b == 0.0:
        raise Refusal("E401")
    left, right = (v.parts if isinstance(v, Vector) else (v,) * 3 for v in (a, b))
    return Vector(*(arithmetic(op, x, y) for x, y in zip(left, right, strict=True)))


def shown(value: object, depth: int = 0) -> str:
    """What `print` shows."""
    if isinstance(value, Vector):
        return f"vec3({', '.join(map(format_number, value.parts))})"
    if isinstance(value, List):
        return f"[{', '.join(shown(v, depth + 1) for v in value.items)}]" if depth < 4 else "[...]"
    if isinstance(value, Object) and not depth:
        fields = list(value.items())[:16]
        return f"object({', '.join(f'{name} = {shown(field, 1)}' for name, field in fields)})"
    if depth and isinstance(value, str):
        return f'"{value[:80]}"'
    if type(value) is float:
        return format_number(value)
    if isinstance(value, str):
        return value
    return {Undefined: "undef", Function: "function"}.get(type(value), "object")
