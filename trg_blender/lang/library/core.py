"""Built-ins without a namespace: output, types, vectors, objects."""

from __future__ import annotations

from ..bind import HOST
from ..lists import List
from ..runtime import Runtime
from ..values import Obj, TrgError, Undef, format_value, type_name
from ..vector import Vec3

_new = tuple.__new__


@HOST.function("print", "...values: anything", "Write values to the log, one line.")
def _print(rt: Runtime, *values: object) -> object:
    if not rt.output_is_cut:
        rt.write_line(" ".join(format_value(value) for value in values))
    return rt.undef


@HOST.function("typeof", "value: anything", "The name of a value's type.", "str")
def _typeof(rt: Runtime, value: object) -> object:
    return rt.text(type_name(value))


@HOST.function("isdef", "value: anything", "1 when the variable or field has a value.", "num")
def _isdef(rt: Runtime, value: object) -> object:
    return 0.0 if type(value) is Undef else 1.0


@HOST.function("vec3", "x: num, y: num?, z: num?", "A vector; one number fills all three.", "vec3")
def _vec3(rt: Runtime, x: float, y: float | None, z: float | None) -> object:
    if z is not None:
        return _new(Vec3, (x, y, z))
    if y is None:
        return _new(Vec3, (x, x, x))
    raise TrgError("E506", name="vec3", wanted="1 or 3", given=2)


@HOST.function("object", "", "A new object without fields.", "object")
def _object(_rt: Runtime) -> object:
    return Obj()


@HOST.function("copy", "value: any", "A copy of a list or an object, one level deep; else the value.", "any")
def _copy(rt: Runtime, value: object) -> object:
    if type(value) is List:
        return List(rt, value.items.copy())
    if type(value) is not Obj:
        return value
    made = Obj()
    made.__dict__.update(value.__dict__)
    rt.work_on_text(64 * len(value.__dict__))
    return made


def _list_length(*arguments: object) -> object:
    if len(arguments) == 1 and type(arguments[0]) is List:
        return float(len(arguments[0].items))
    return None


@HOST.function(
    "len", "value: str|list", "The number of characters of a string or of elements of a list.", "num",
    fast=_list_length,
)  # fmt: skip
def _len(rt: Runtime, text: str) -> object:
    return float(len(text))
