"""The values of a running program.

A number is a Python float and a function a Python function; everything else derives from `Value`,
whose operators raise `TrgError` where the language has none. Translated code can reach only
attributes that begin with `T_`; the attributes here do not, save the components of a vector.
"""

from __future__ import annotations

import operator
import sys
from collections.abc import Callable, Mapping
from types import FrameType, FunctionType, GeneratorType, MethodType
from typing import TYPE_CHECKING

from .texts import SHORT_TEXT, TextBuffer

if TYPE_CHECKING:
    from .runtime import Runtime

FIELD = "T_"
ARITHMETIC: Mapping[str, Callable[..., object]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "%": operator.mod,
}
COMPARISON: Mapping[str, Callable[..., object]] = {
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}


class TrgError(Exception):
    """An error of the running program. It stands at the place that the traceback tells, or at an
    operand of what runs there."""

    def __init__(
        self, code: str, /, hint: str | None = None, operand: int | None = None, **values: object
    ) -> None:
        super().__init__(code)
        self.code = code
        self.hint = hint
        self.operand = operand
        self.values = values
        self.argument: int | None = None
        self.renamed: tuple[str, str] | None = None
        """(written, meant), when the name that ends the place is certainly a typing error."""


class Value:
    """Base of all values that are neither numbers nor functions."""

    __slots__ = ()
    kind = "value"

    def __add__(self, other: object) -> object:
        return compute("+", self, other)

    def __radd__(self, other: object) -> object:
        return compute("+", other, self)

    def __sub__(self, other: object) -> object:
        return compute("-", self, other)

    def __rsub__(self, other: object) -> object:
        return compute("-", other, self)

    def __mul__(self, other: object) -> object:
        return compute("*", self, other)

    def __rmul__(self, other: object) -> object:
        return compute("*", other, self)

    def __truediv__(self, other: object) -> object:
        return compute("/", self, other)

    def __rtruediv__(self, other: object) -> object:
        return compute("/", other, self)

    def __mod__(self, other: object) -> object:
        return compute("%", self, other)

    def __rmod__(self, other: object) -> object:
        return compute("%", other, self)

    def __getitem__(self, index: object) -> object:
        raise TrgError("E440", kind=self.kind)

    def __setitem__(self, index: object, value: object) -> None:
        raise TrgError("E440", kind=self.kind)

    def __neg__(self) -> object:
        return negate(self)

    def __pos__(self) -> object:
        return affirm(self)

    def __lt__(self, other: object) -> object:
        return compare("<", self, other)

    def __gt__(self, other: object) -> object:
        return compare(">", self, other)

    def __le__(self, other: object) -> object:
        return compare("<=", self, other)

    def __ge__(self, other: object) -> object:
        return compare(">=", self, other)


class Undef(Value):
    """The value of a variable that has none; counts as 0 in arithmetic, with one warning a place."""

    __slots__ = ("rt",)
    kind = "undef"

    def __init__(self, rt: Runtime) -> None:
        self.rt = rt

    def __bool__(self) -> bool:
        return False

    def __getitem__(self, index: object) -> object:
        raise self._no_elements()

    def __setitem__(self, index: object, value: object) -> None:
        raise self._no_elements()

    def _no_elements(self) -> TrgError:
        site = self.rt.site()
        named = site is not None and site.names and site.names[0]
        return TrgError("E446", "new_list", name=named or "it")

    def __eq__(self, other: object) -> bool:
        if type(other) is float:
            self.rt.warn_undefined(None)
            return other == 0.0
        return self is other

    __hash__ = object.__hash__


class Str(Value):
    """A string: a short one holds its text, a longer one the first `length` characters of a buffer."""

    __slots__ = ("held", "length", "rt")
    kind = "str"

    def __init__(self, rt: Runtime, held: str | TextBuffer, length: int) -> None:
        self.rt = rt
        self.held = held
        self.length = length

    @property
    def text(self) -> str:
        held = self.held
        if type(held) is str:
            return held
        if held.length == self.length:  # type: ignore[union-attr]
            return held.text()  # type: ignore[union-attr]
        text = held.text()[: self.length]  # type: ignore[union-attr]
        self.held = text if len(text) <= SHORT_TEXT else TextBuffer(self.rt, text)
        return text

    def __bool__(self) -> bool:
        return self.length != 0

    def __eq__(self, other: object) -> bool:
        return type(other) is Str and other.length == self.length and other.text == self.text

    def __hash__(self) -> int:
        return hash(self.text)

    def __add__(self, other: object) -> object:
        held = self.held
        if type(other) is Str:
            piece = other.held
            if type(held) is TextBuffer and type(piece) is str and held.length == self.length:
                length = self.length + other.length
                if self.length < length <= held.room and piece.isascii():
                    held.write(piece)
                    held.length = length
                    return Str(self.rt, held, length)
            return self._append(other.text)
        if type(other) is float:
            return self._append(format_number(other))
        return compute("+", self, other)

    def _append(self, piece: str) -> Str:
        held, rt = self.held, self.rt
        if not piece:
            return self
        if type(held) is TextBuffer and held.length == self.length:
            held.append(piece)
            return Str(rt, held, held.length)
        return rt.text(self.text + piece)

    def __radd__(self, other: object) -> object:
        if type(other) is float:
            return self.rt.text(format_number(other) + self.text)
        return compute("+", other, self)

    def __lt__(self, other: object) -> object:
        return self.text < other.text if type(other) is Str else compare("<", self, other)

    def __gt__(self, other: object) -> object:
        return self.text > other.text if type(other) is Str else compare(">", self, other)

    def __le__(self, other: object) -> object:
        return self.text <= other.text if type(other) is Str else compare("<=", self, other)

    def __ge__(self, other: object) -> object:
        return self.text >= other.text if type(other) is Str else compare(">=", self, other)


class Obj(Value):
    """An object: fields live in the instance dictionary, under names with the prefix `T_`.

    It holds nothing else, not even its runtime: CPython keeps the fields of such an object, up to some
    number, in the object itself.
    """

    kind = "object"

    def __neg__(self) -> object:
        if overload_of(self, "-") is None:
            return negate(self)
        return compute("-", 0.0, self)


def overload_of(value: object, op: str) -> object | None:
    """The operator field of an object, or None."""
    if type(value) is not Obj:
        return None
    return value.__dict__.get(f"{FIELD}operator{op}")


def type_name(value: object) -> str:
    """The name that `typeof` gives a value."""
    if type(value) is float:
        return "num"
    if isinstance(value, Value):
        return value.kind
    if isinstance(value, FunctionType | MethodType) or value is None:
        return "function"
    return "generator" if isinstance(value, GeneratorType) else type(value).__name__


def runtime_of(*values: object) -> Runtime | None:
    """The runtime that values belong to: one tells it, or the code that runs."""
    for value in values:
        rt = getattr(value, "rt", None)
        if rt is not None:
            return rt  # type: ignore[no-any-return]
    return _running_runtime() if Obj in map(type, values) else None


def _running_runtime() -> Runtime | None:
    """The runtime whose method `take_step` the innermost translated code knows as `T_`."""
    frame: FrameType | None = sys._getframe(2)
    while frame is not None:
        step = frame.f_globals.get("T_")
        if type(step) is MethodType:
            return step.__self__  # type: ignore[return-value]
        frame = frame.f_back
    return None


def compute(op: str, left: object, right: object) -> object:
    """Arithmetic that the operands' types do not have: overloads, undef as 0, or an error."""
    rt = runtime_of(left, right)
    stepped = rt.step_operator() if rt is not None and op == "-" else ""
    if stepped == "++":
        op, right = "+", 1.0
    overload = overload_of(left, op) or overload_of(right, op)
    if overload is not None and rt is not None:
        return rt.call_overload(overload, left, right)
    if stepped and type(left) is not Undef:
        raise TrgError("E413", op=stepped, kind=type_name(left))
    undefined = Undef in (type(left), type(right))
    if undefined and rt is not None:
        if Str in (type(left), type(right)):
            raise TrgError("E411") if op == "+" else incomputable(op, type_name(left), type_name(right))
        _warn_operands(rt, left, right)
        numbers = [0.0 if type(value) is Undef else value for value in (left, right)]
        return ARITHMETIC[op](*numbers)
    raise incomputable(op, type_name(left), type_name(right))


def incomputable(op: str, left: str, right: str) -> TrgError:
    """The error of an operator that these types do not have."""
    if "generator" in (left, right):
        return TrgError("E415")
    hint = None
    if {left, right} == {"num", "vec3"} and op in "+-":
        hint = "write_vec3"
    return TrgError("E410", hint, op=op, left=left, right=right)


def compare(op: str, left: object, right: object) -> object:
    """`left op right` for types without an order: undef as 0, or an error.

    Python may call this with the operands exchanged; the place in the source tells.
    """
    rt = runtime_of(left, right)
    site = rt.site() if rt is not None else None
    if site is not None and site.op in COMPARISON and site.op != op:
        op, left, right = site.op, right, left
    kinds = (type(left), type(right))
    if rt is not None and Undef in kinds and Str not in kinds:
        _warn_operands(rt, left, right)
        numbers = [0.0 if type(value) is Undef else value for value in (left, right)]
        return COMPARISON[op](*numbers)
    raise TrgError("E412", op=op, left=type_name(left), right=type_name(right))


def _warn_operands(rt: Runtime, *operands: object) -> None:
    for index, value in enumerate(operands):
        if type(value) is Undef:
            rt.warn_undefined(index)


def negate(value: object) -> object:
    rt = runtime_of(value)
    if type(value) is Undef and rt is not None:
        rt.warn_undefined(0)
        return -0.0
    raise TrgError("E413", op="-", kind=type_name(value))


def affirm(value: object) -> object:
    rt = runtime_of(value)
    if type(value) is Undef and rt is not None:
        rt.warn_undefined(0)
        return 0.0
    raise TrgError("E413", op="+", kind=type_name(value))


def trg_frame(marker: Mapping[str, object]) -> FrameType | None:
    """The innermost frame of translated code whose globals are `marker`."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None and frame.f_globals is not marker:
        frame = frame.f_back
    return frame


def format_number(value: float) -> str:
    """Shortest text that reads back as `value`; whole numbers up to 2^53 without `.0`."""
    if value == value and abs(value) <= 9007199254740992.0 and value == int(value):
        return str(int(value))
    return repr(value)


def format_value(value: object, depth: int = 0) -> str:
    """The text that `print` shows: never an address, never Python's own notation."""
    if type(value) is float:
        return format_number(value)
    if type(value) is Str:
        return value.text if depth == 0 else f'"{value.text[:80]}"'
    if isinstance(value, Obj):
        if depth:
            return "object"
        fields = [(k.removeprefix(FIELD), v) for k, v in list(value.__dict__.items())[:16]]
        return f"object({', '.join(f'{k} = {format_value(v, 1)}' for k, v in fields)})"
    if isinstance(value, Value) and hasattr(value, "shown"):
        return str(value.shown())
    return type_name(value)
