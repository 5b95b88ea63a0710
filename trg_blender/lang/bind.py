"""How built-ins are declared, checked and called.

Every built-in function, constant and method is one row: its name, a signature in a small notation,
what it returns, one line of documentation, and the Python function behind it. Argument checks,
messages, completion and the reference all come from the row. The notation:

    "centre: vec3, radius: num > 0, count: num 1..100, looks: material|medium?, ...rest: any"

`?` means optional (None), `= 2` a default number, `> 0`, `>= 0` and `a..b` a range, `...` any
number of arguments. Types are those of `typeof`, `any` (all but undef), `anything` (undef too) and
`colour` (a vec3 of numbers that are not negative). Numbers and vectors must be finite.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .invoke import function_invoker, method_invoker, named_for_faults
from .values import Str, TrgError, Value, type_name
from .vector import Vec3

if TYPE_CHECKING:
    from .runtime import Place, Runtime

LARGEST = 1.7976931348623157e308
_PARAMETER = re.compile(
    r"(?P<rest>\.\.\.)?(?P<name>\w+): (?P<types>[\w|]+)(?P<optional>\?)?"
    r"(?: (?:(?P<open>>) (?P<above>\S+)|>= (?P<least>\S+)|(?P<low>-?[\d.]+?)\.\.(?P<high>-?[\d.e]+)))?"
    r"(?: = (?P<default>\S+))?"
)


@dataclass(frozen=True, slots=True)
class HostParameter:
    """One parameter of a built-in; numbers lie in low..high, `low` itself excluded when `open_low`."""

    name: str
    types: tuple[str, ...]
    required: bool = True
    default: float | None = None
    low: float = -LARGEST
    high: float = LARGEST
    open_low: bool = False
    rest: bool = False
    takes_number: bool = False
    takes_vector: bool = False


@dataclass(frozen=True, slots=True)
class Builtin:
    """One row of the host table. Methods have an `owner` type and a name such as `shape.Move`."""

    name: str
    signature: str
    parameters: tuple[HostParameter, ...]
    result: str
    doc: str
    run: Callable[..., object]
    owner: str | None = None
    fast: Callable[..., object] | None = None
    """Does the work for arguments that need no check; None for all others."""
    placed: bool = False
    """`run` takes the place of the call instead of `rt`: what it makes is numbered there."""

    @property
    def rest(self) -> HostParameter | None:
        """The last parameter, if it takes any number of arguments."""
        return self.parameters[-1] if self.parameters and self.parameters[-1].rest else None

    @property
    def shown(self) -> str:
        """The name as messages show it."""
        owner, _, name = self.name.rpartition(".")
        return f"Scene.{name}" if owner == "scene" else self.name

    @property
    def required(self) -> int:
        return sum(p.required and not p.rest for p in self.parameters)


@dataclass(frozen=True, slots=True)
class HostConstant:
    name: str
    value: float
    doc: str


class HostFunction(Value):
    """A built-in as a value of the program. Called with the hidden depth first, as functions are."""

    __slots__ = ("builtin", "invoke")
    kind = "function"

    def __init__(self, builtin: Builtin, invoke: Callable[..., object]) -> None:
        self.builtin = builtin
        self.invoke = invoke

    def __call__(self, _depth: int, *arguments: object) -> object:
        return self.invoke(*arguments)


def parse_signature(text: str) -> tuple[HostParameter, ...]:
    """The parameters of a signature. A text outside the notation raises ValueError."""
    return tuple(_parse_parameter(part) for part in text.split(", ")) if text else ()


def _parse_parameter(text: str) -> HostParameter:
    m = _PARAMETER.fullmatch(text)
    if m is None:
        raise ValueError(f"signature not understood: {text!r}")
    low = m["above"] or m["least"] or m["low"]
    types = tuple(m["types"].split("|"))
    return HostParameter(
        name=m["name"],
        types=types,
        required=not (m["optional"] or m["default"] or m["rest"]),
        default=float(m["default"]) if m["default"] else None,
        low=float(low) if low else -LARGEST,
        high=float(m["high"]) if m["high"] else LARGEST,
        open_low=bool(m["open"]),
        rest=bool(m["rest"]),
        takes_number="num" in types,
        takes_vector="vec3" in types,
    )


class HostTable:
    """All built-ins, by name; filled once, at import, by the modules of `library`."""

    def __init__(self) -> None:
        self.functions: dict[str, Builtin] = {}
        self.constants: dict[str, HostConstant] = {}
        self.methods: dict[tuple[str, str], Builtin] = {}

    def function(
        self,
        name: str,
        signature: str,
        doc: str,
        result: str = "undef",
        fast: Callable[..., object] | None = None,
    ) -> Callable[[Callable[..., object]], Callable[..., object]]:
        """Declare the decorated `run(rt, *arguments)` as built-in function `name`."""

        def declare(run: Callable[..., object]) -> Callable[..., object]:
            self.functions[name] = Builtin(
                name, signature, parse_signature(signature), result, doc, run, fast=fast
            )
            return run

        return declare

    def maker(
        self, name: str, signature: str, doc: str, result: str
    ) -> Callable[[Callable[..., object]], Callable[..., object]]:
        """Declare the decorated `run(place, *arguments)` as built-in function `name`."""

        def declare(run: Callable[..., object]) -> Callable[..., object]:
            self.functions[name] = Builtin(
                name, signature, parse_signature(signature), result, doc, run, placed=True
            )
            return run

        return declare

    def pure(
        self, name: str, signature: str, doc: str, compute: Callable[..., object], result: str = "num"
    ) -> None:
        """Declare a function of its arguments alone."""

        def run(_rt: Runtime, *arguments: object) -> object:
            return compute(*arguments)

        self.function(name, signature, doc, result)(run)

    def constant(self, name: str, value: float, doc: str) -> None:
        self.constants[name] = HostConstant(name, value, doc)

    def method(
        self, owner: type[Value], name: str, signature: str, doc: str, result: str = ""
    ) -> Callable[[Callable[..., object]], Callable[..., object]]:
        """Declare the decorated `run(rt, object, *arguments)` as method `name` of class `owner`."""

        def declare(run: Callable[..., object]) -> Callable[..., object]:
            row = Builtin(
                f"{owner.kind}.{name}", signature, parse_signature(signature),
                result or owner.kind, doc, run, owner.kind,
            )  # fmt: skip
            self.methods[owner.kind, name] = row
            setattr(owner, "T_" + name, method_invoker(row, make_checker(row)))
            return run

        return declare

    def direct(self, owner: type[Value], name: str, invoke: Callable[..., object]) -> None:
        """Let programs call `invoke(object, depth, arguments...)` as it stands for declared method `name`:
        it checks the arguments by itself, their number excepted.
        """
        setattr(owner, "T_" + name, named_for_faults(self.methods[owner.kind, name], invoke))

    @property
    def names(self) -> frozenset[str]:
        """Every name that the resolver takes as built in."""
        return frozenset(self.functions) | frozenset(self.constants)

    @property
    def placed_names(self) -> frozenset[str]:
        """The functions that number what they make by the place of the call."""
        return frozenset(row.name for row in self.functions.values() if row.placed)

    def row(self, name: str) -> Builtin | None:
        """The function or method of a full name such as `list.append`."""
        owner, _, method = name.rpartition(".")
        return self.methods.get((owner, method)) if owner else self.functions.get(name)

    def method_names(self, kind: str) -> list[str]:
        return [name for owner, name in self.methods if owner == kind]

    def bind(self, rt: Runtime) -> dict[str, object]:
        """The globals of a session that stand for built-ins."""
        made: dict[str, object] = {f"g_{c.name}": c.value for c in self.constants.values()}
        for row in self.functions.values():
            invoke = make_invoker(rt, row)
            made["b_" + row.name] = invoke
            made["g_" + row.name] = HostFunction(row, invoke)
        for constant in self.constants.values():
            made["b_" + constant.name] = constant.value
        return made


HOST = HostTable()
"""The host table. Import `library` to have it filled."""


def make_invoker(rt: Runtime, row: Builtin, place: Place | None = None) -> Callable[..., object]:
    """`row` as a Python function that checks its arguments. `place` is where it is called, if known."""
    run, fast = row.run, row.fast
    check = make_checker(row)
    if fast is not None:

        def invoke_fast(*arguments: object) -> object:
            made = fast(*arguments)
            return made if made is not None else run(rt, *check(arguments))

        return invoke_fast
    if not row.placed:
        return function_invoker(row, rt, check)
    if place is not None:
        return function_invoker(row, place, check)

    def invoke_somewhere(*arguments: object) -> object:
        return run(rt.place(row.name), *check(arguments))

    return invoke_somewhere


def make_checker(row: Builtin) -> Callable[[tuple[object, ...]], Iterable[object]]:
    """A function that turns arguments into Python values, defaults filled in.

    It raises TrgError naming the first argument that is wrong.
    """
    parameters, rest, least = row.parameters, row.rest, row.required
    most = len(parameters) - (rest is not None)
    defaults = tuple(p.default for p in parameters)

    def check(arguments: tuple[object, ...]) -> Iterable[object]:
        given = len(arguments)
        if given < least or (given > most and rest is None):
            raise wrong_count(row, given)
        for parameter, value in zip(parameters, arguments, strict=False):
            if parameter.rest or not _passes(parameter, value):
                return _check_all(row, arguments)
        return arguments if given >= most else arguments + defaults[given:most]

    return check


def _check_all(row: Builtin, arguments: tuple[object, ...]) -> list[object]:
    """The long way: every argument with its message; strings become Python's."""
    parameters = row.parameters
    last = len(parameters) - 1
    checked = [_check(row, i, parameters[min(i, last)], v) for i, v in enumerate(arguments)]
    checked += [p.default for p in parameters[len(arguments) :] if not p.rest]
    return checked


def _passes(parameter: HostParameter, value: object) -> bool:
    """Whether a number, vector or thing is right beyond doubt; the short way of `_check`."""
    kind = type(value)
    if kind is float:
        return parameter.takes_number and parameter.low < value < parameter.high  # type: ignore[operator]
    if kind is Vec3:
        total = value[0] + value[1] + value[2]  # type: ignore[index]
        return parameter.takes_vector and total - total == 0.0
    return kind is not Str and getattr(kind, "kind", "undef") in parameter.types


def wrong_count(row: Builtin, given: int) -> TrgError:
    """The error of calling `row` with so many arguments."""
    most = len(row.parameters) - (row.rest is not None)
    wanted = str(most) if row.required == most else f"{row.required} to {most}"
    if row.rest is not None:
        wanted = f"at least {row.required}"
    usage = f"{row.shown}({row.signature})"
    return TrgError("E506", "usage", name=row.shown, wanted=wanted, given=given, usage=usage)


def _check(row: Builtin, index: int, parameter: HostParameter, value: object) -> object:
    kind = type_name(value)
    types = parameter.types
    if kind == "generator":
        raise TrgError("E415")
    if "anything" in types or ("any" in types and kind != "undef"):
        return value
    if kind not in types and not (kind == "vec3" and "colour" in types):
        raise _mismatch(row, index, parameter, kind)
    if type(value) is float:
        if not parameter.low <= value <= parameter.high or (parameter.open_low and value == parameter.low):
            raise _out_of_range(row, index, parameter, value)
    elif type(value) is Vec3:
        _check_vector(row, index, parameter, value)
    elif type(value) is Str:
        return value.text
    return value


def _check_vector(row: Builtin, index: int, parameter: HostParameter, value: Vec3) -> None:
    for component in value:
        if not -LARGEST <= component <= LARGEST:
            raise _argument_error("E503", row, index, parameter)
        if component < 0.0 and "colour" in parameter.types:
            raise _argument_error("E505", row, index, parameter)


def _argument_error(
    code: str, row: Builtin, index: int, parameter: HostParameter, **values: object
) -> TrgError:
    error = TrgError(
        code,
        name=row.shown,
        index=index + 1,
        parameter=parameter.name,
        **values,  # type: ignore[arg-type]
    )
    error.argument = index
    return error


def _mismatch(row: Builtin, index: int, parameter: HostParameter, kind: str) -> TrgError:
    if kind == "undef":
        return _argument_error("E507", row, index, parameter)
    if parameter.types == ("num",):
        return _argument_error("E502", row, index, parameter, kind=kind)
    wanted = _wanted(parameter.types)
    return _argument_error("E501", row, index, parameter, wanted=wanted, kind=kind)


def _wanted(types: Iterable[str]) -> str:
    names = ["a colour (vec3)" if t == "colour" else f"{_article(t)} {t}" for t in types]
    return " or ".join(names)


def _article(word: str) -> str:
    return "an" if word[0] in "aeiou" else "a"


def _out_of_range(row: Builtin, index: int, parameter: HostParameter, value: float) -> TrgError:
    if not -LARGEST <= value <= LARGEST:
        return _argument_error("E503", row, index, parameter)
    if parameter.high == LARGEST:
        wanted = f"{'>' if parameter.open_low else '>='} {parameter.low:g}"
    else:
        wanted = f"{parameter.low:g} .. {parameter.high:g}"
    return _argument_error("E504", row, index, parameter, wanted=wanted, value=f"{value:g}")
