"""The words and signs of the language, one line each: hover, the reference and highlighting use them."""

from __future__ import annotations

from collections.abc import Iterable

from .bind import HOST, Builtin
from .parse_expr import PRECEDENCE
from .scan import KEYWORDS

KEYWORD_DOCS = {
    "if": "`if (condition) statement`: runs the statement when the condition is true.",
    "else": "`else statement`: what runs when no condition before it was true.",
    "while": "`while (condition) statement`: repeats the statement as long as the condition is true.",
    "for": "`for (start; condition; step) statement`, or `for (x in list) statement` for each element.",
    "in": "`for (x in list)`: x takes each element of the list in turn.",
    "switch": "`switch (value) { case a: ... default: ... }`: goes on at the first equal case.",
    "case": "`case value:` of a switch; without a `break` it runs on into the next one.",
    "default": "`default:` of a switch: where it goes on when no case equals the value.",
    "break": "`break;` leaves the loop or switch around it.",
    "continue": "`continue;` goes on with the next turn of the loop around it.",
    "return": "`return value;` leaves the function; without a value it returns undef.",
    "function": '`function(a, b = 1 ~ "num") { ... }`: a function value; assign it to name it.',
    "operator": "`object.operator+ = function(a, b) { ... };`: what the operator means for the object.",
}
"""The keywords; a test holds them against the scanner's."""

SPECIAL_DOCS = {
    "include": '`include("stl/rt/trg_raytrace.trg");`: runs another file here, once; top level only.',
    "export": '`export radius = 3 ~ "num" ~ range(0, 10);`: a parameter that the user may set.',
}
"""Words with a meaning at the beginning of a statement only."""

OPERATOR_DOCS = {
    "+": "sum of numbers or vectors; joins strings",
    "-": "difference of numbers or vectors; in front of a value its negative",
    "*": "product: numbers, a number with a vector, or two vectors by components",
    "/": "quotient: 7 / 2 is 3.5; division by zero is an error",
    "%": "remainder with the sign of the divisor: -7 % 3 is 2",
    "<": "1 when less, else 0; numbers with numbers, strings with strings",
    ">": "1 when greater, else 0",
    "<=": "1 when less or equal, else 0",
    ">=": "1 when greater or equal, else 0",
    "==": "1 when equal, else 0; values of different types are never equal",
    "!=": "1 when not equal, else 0",
    "&&": "1 when both sides are true, else 0; the right side is not computed after a false left one",
    "||": "1 when a side is true, else 0; the right side is not computed after a true left one",
}
"""Operators between two values, in the order of the reference."""

PREFIX_DOCS = {
    "-": "the negative of a number or vector",
    "+": "the number or vector itself",
    "!": "1 when the value is false (0, an empty string, undef), else 0",
    "++": "adds 1 to a variable or field; behind it, the value is the old one",
    "--": "subtracts 1 from a variable or field; behind it, the value is the old one",
    "#": "`#name`: the global variable, seen from inside a function",
}

TYPE_DOCS = {
    "num": "a number: a double; comparisons give 1 or 0",
    "str": 'a string in double quotes, with the escapes `\\n` `\\t` `\\r` `\\0` `\\"` `\\\\`',
    "vec3": "three numbers with the fields x, y, z; it is a value and never changes",
    "object": "fields by name, made by `object()` or by assigning to a field; a reference",
    "list": "values by index from 0, made by `[a, b]` or `list()`; a reference",
    "function": "a function, built in or written in the program",
    "undef": "what a variable holds before it has a value; counts as 0 in arithmetic, with a warning",
    "scene": "the scene: shapes, lights, the camera",
    "shape": "a shape or model that can be moved and given a material",
    "light": "a light",
    "material": "how a surface looks",
    "texture": "an image for a material",
    "medium": "what fills a shape: absorption and refraction index",
}


def keyword_names() -> list[str]:
    """The keywords in the order of their documentation."""
    return [name for name in KEYWORD_DOCS if name in KEYWORDS]


def levels() -> list[tuple[str, ...]]:
    """The operators between two values by precedence, the closest binding first."""
    found: dict[int, list[str]] = {}
    for operator in OPERATOR_DOCS:
        found.setdefault(PRECEDENCE[operator], []).append(operator)
    return [tuple(found[level]) for level in sorted(found, reverse=True)]


def signature_text(row: Builtin) -> str:
    """`sphere(centre: vec3, radius: num > 0) -> shape`, as hover and the reference show a built-in."""
    result = "" if row.result == "undef" else f" -> {row.result}"
    return f"{row.shown}({row.signature}){result}"


def spaces() -> list[str]:
    """The names before `::` that the host table uses."""
    return sorted({name.partition("::")[0] for name in HOST.names if "::" in name})


def names_in(space: str) -> list[str]:
    """The built-ins of a space, without it (empty: those without one), as declared."""
    names: Iterable[str] = (*HOST.functions, *HOST.constants)
    if not space:
        return [name for name in names if "::" not in name]
    return [name.partition("::")[2] for name in names if name.startswith(space + "::")]
