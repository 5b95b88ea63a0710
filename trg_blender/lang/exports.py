"""Exported parameters: `export radius = 3 ~ "num" ~ range(0, 10);` at the top level of a program.

The default is written as a constant, so that a host knows all parameters without running anything.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

from . import ast
from .diagnostics import DiagnosticBag, Notice, closest, is_certain
from .source import SourceFile, Span

ParameterValue = float | str | tuple[float, float, float]
"""Of a num or flag, of a str, of a vec3 or colour."""
TYPES = ("num", "flag", "vec3", "colour", "str")
_USAGES = {"range": ("num", "range(low, high[, step])"), "choice": ("str", 'choice("a", "b", ...)')}
MAX_TURNS = 2.0**53
"""Steps in a range: beyond, not every one has a number of its own."""
_STARS = re.compile(r"^\s*/?\*+|\*+/\s*$")


@dataclass(frozen=True, slots=True)
class Export:
    """One parameter. `type` is one of TYPES; `low`, `high` bound a num, `step` is its grain if it has one."""

    name: str
    type: str
    default: ParameterValue
    span: Span
    """The name in the text."""
    low: float | None = None
    high: float | None = None
    step: float | None = None
    choices: tuple[str, ...] = ()
    """What a str may be; empty: anything."""
    doc: str = ""
    """The comment in the lines above, or behind it in its line."""

    @property
    def wanted(self) -> str:
        """What a value must be, for messages."""
        if self.choices:
            return " | ".join(f'"{choice}"' for choice in self.choices)
        if self.low is not None and self.high is not None:
            grain = f" step {self.step:g}" if self.step is not None else ""
            return f"{self.low:g} .. {self.high:g}{grain}"
        return "0 | 1" if self.type == "flag" else self.type

    def fit(self, value: object) -> ParameterValue | None:
        """`value` as a value of this parameter, or None when it is none."""
        if self.type == "str":
            is_one = isinstance(value, str) and (not self.choices or value in self.choices)
            return value if is_one else None  # type: ignore[return-value]
        if self.type in ("vec3", "colour"):
            return self._fit_triple(value)
        return self._fit_number(value)

    def _fit_number(self, value: object) -> float | None:
        number = _finite(value)
        if number is None or (self.type == "flag" and number not in (0.0, 1.0)):
            return None
        if self.low is None or self.high is None:
            return number
        if not self.low <= number <= self.high:
            return None
        if self.step is not None:
            turns = (number - self.low) / self.step
            if abs(turns - round(turns)) > 1e-6 * max(1.0, abs(turns)):
                return None
        return number

    def _fit_triple(self, value: object) -> tuple[float, float, float] | None:
        if not isinstance(value, tuple | list) or len(value) != 3:
            return None
        x, y, z = map(_finite, value)
        if x is None or y is None or z is None:
            return None
        return None if self.type == "colour" and min(x, y, z) < 0.0 else (x, y, z)


def _finite(value: object) -> float | None:
    if not isinstance(value, int | float):
        return None
    try:
        number = float(value)
    except OverflowError:  # a whole number of Python's
        return None
    return number if math.isfinite(number) else None


def parameter_value(export: Export, given: Mapping[str, object]) -> ParameterValue:
    """The value of a parameter when the host gives `given`, which was checked before."""
    value = export.fit(given[export.name]) if export.name in given else None
    return export.default if value is None else value


def read_exports(
    trees: list[ast.FileTree], sources: Mapping[str, SourceFile], bag: DiagnosticBag
) -> dict[str, Export]:
    """All parameters of a program by name; what is wrong with one goes to `bag`."""
    found: dict[str, Export] = {}
    for tree in trees:
        for node in tree.statements:
            if not isinstance(node, ast.Export):
                continue
            export = _Reader(node, sources[tree.name], bag).read()
            if export is None:
                continue
            if export.name in found:
                related = ((found[export.name].span, "exported_here"),)
                bag.add(Notice("E331", export.span, {"name": export.name}, related=related))
            found.setdefault(export.name, export)
    return found


class _Reader:
    """Reads one export statement."""

    def __init__(self, node: ast.Export, source: SourceFile, bag: DiagnosticBag) -> None:
        self.node = node
        self.source = source
        self.bag = bag

    def read(self) -> Export | None:
        """The parameter, or None after an error."""
        node, assignment = self.node, self.node.assignment
        default = constant_of(assignment.value)
        if default is None:
            self._error("E330", assignment.value.span)
            return None
        target = assignment.target
        assert isinstance(target, ast.Path)
        kind = self._type(default)
        if kind is None:
            return None
        doc = doc_comment(self.source, node.span)
        export = Export(target.name, kind, default, target.span, doc=doc)
        limited = export if node.limits is None else self._limited(export, node.limits)
        if limited is not None and limited.fit(default) is None:
            values = {"name": target.name, "wanted": limited.wanted, "value": shown_value(default)}
            self._error("E332", assignment.value.span, **values)
            return None
        return limited

    def _type(self, default: ParameterValue) -> str | None:
        name = self.node.type_name
        if name is None:
            return "str" if isinstance(default, str) else "num" if isinstance(default, float) else "vec3"
        if name in TYPES:
            return name
        guess = closest(name, TYPES)
        hint, meant = ("did_you_mean", {"name": guess}) if guess else (None, None)
        place = self.node.type_span or self.node.span
        certain = guess is not None and is_certain(name, guess, TYPES)
        fix = (place, f'"{guess}"') if certain else None
        self.bag.add(Notice("E333", place, {"name": name}, hint, meant, fix=fix))
        return None

    def _limited(self, export: Export, limits: ast.Call) -> Export | None:
        callee = limits.callee
        name = callee.name if isinstance(callee, ast.Path) else ""
        wanted, usage = _USAGES[name]
        values = [constant_of(argument) for argument in limits.arguments]
        if export.type == wanted:
            made = _with_range(export, values) if name == "range" else _with_choices(export, values)
            if made is not None:
                return made
        self._error("E334", limits.span, name=name, wanted=wanted, usage=usage)
        return None

    def _error(self, code: str, span: Span, **values: object) -> None:
        self.bag.add(Notice(code, span, values))


def _with_range(export: Export, values: list[ParameterValue | None]) -> Export | None:
    numbers = [v for v in values if isinstance(v, float)]
    if len(numbers) != len(values) or len(values) not in (2, 3) or numbers[0] >= numbers[1]:
        return None
    step = numbers[2] if len(numbers) == 3 else None
    reach = numbers[1] - numbers[0]
    if math.isinf(reach) or step is not None and not (0.0 < step <= reach and reach / step <= MAX_TURNS):
        return None
    return Export(
        export.name, export.type, export.default, export.span, numbers[0], numbers[1], step, doc=export.doc
    )


def _with_choices(export: Export, values: list[ParameterValue | None]) -> Export | None:
    texts = tuple(v for v in values if isinstance(v, str))
    if len(texts) != len(values) or len(set(texts)) != len(texts) or not texts:
        return None
    return Export(export.name, export.type, export.default, export.span, choices=texts, doc=export.doc)


def constant_of(node: ast.Expr) -> ParameterValue | None:
    """The value of a constant as written: a number, a string, `vec3` of numbers; else None."""
    match node:
        case ast.Number():
            return node.value
        case ast.String():
            return node.text
        case ast.Unary(op="-" | "+", operand=ast.Number(value=value)):
            return -value if node.op == "-" else value
        case ast.Call(callee=ast.Path(name="vec3"), arguments=arguments) if len(arguments) in (1, 3):
            parts = [constant_of(argument) for argument in arguments]
            numbers = [part for part in parts if isinstance(part, float)]
            if len(numbers) == len(parts):
                x, y, z = numbers if len(numbers) == 3 else numbers * 3
                return (x, y, z)
    return None


def shown_value(value: object) -> str:
    """A value given by a host, short, for messages."""
    if isinstance(value, tuple | list):
        return f"vec3({', '.join(map(shown_value, value))})"
    return (
        f'"{value[:60]}"' if isinstance(value, str) else f"{value:g}" if _finite(value) is not None else "?"
    )


def doc_comment(source: SourceFile, span: Span) -> str:
    """The comment of a statement: behind it in its line, else in the lines right above it."""
    lines = source.lines
    behind = lines[span.end_line - 1][span.end_col - 1 :].strip()
    if behind.startswith("//"):
        return behind.lstrip("/").strip()
    if behind.startswith("/*") and behind.endswith("*/"):
        return _STARS.sub("", _STARS.sub("", behind)).strip()
    above: list[str] = []
    at = span.line - 2
    if at >= 0 and lines[at].rstrip().endswith("*/"):
        while at >= 0:
            above.append(_STARS.sub("", _STARS.sub("", lines[at])).strip())
            if "/*" in lines[at]:
                break
            at -= 1
    else:
        while at >= 0 and lines[at].lstrip().startswith("//"):
            above.append(lines[at].strip().lstrip("/").strip())
            at -= 1
    return " ".join(line for line in reversed(above) if line)
