"""A program's exported parameters as properties of the scene, `scene.trg.parameters`.

They are custom properties with the limits of the export, so that panels show them as sliders, colours
and choices, and so that they can be keyed. A choice is stored as its number in the list of choices.
"""

from __future__ import annotations

import math
from typing import Any

import bpy

from ... import lang

MAX_INTEGER = 2.0**31 - 1.0


def offer_parameters(scene: bpy.types.Scene, program: lang.Program) -> None:
    """Give the scene a property for each export. A value that is there and fits stays; others go."""
    stored = _stored(scene)
    if stored is None:
        return
    gone = set(stored.keys()) - set(program.exports)
    for name in gone:
        del stored[name]
    for export in program.exports.values():
        _offer(stored, export)


def _offer(stored: Any, export: lang.Export) -> None:
    """Write only what is not so yet: this runs before every frame."""
    name = export.name
    old = export.fit(_snapped(export, stored[name])) if name in stored else None
    native = _to_property(export, export.default if old is None else old)
    kept = name in stored and old is not None and _kind(stored[name]) is _kind(native)
    if not kept:
        stored[name] = native
    looks = _looks(export)
    shown = stored.id_properties_ui(name)
    known = shown.as_dict()
    if (
        any(known.get(key) != value for key, value in looks.items() if key != "items")
        or "items" in looks
        and [i[0] for i in known.get("items", ())] != list(export.choices)
    ):
        shown.update(**looks)


def _kind(native: Any) -> type:
    is_triple = hasattr(native, "__len__") and not isinstance(native, str)
    return tuple if is_triple else type(native)


def parameter_values(scene: bpy.types.Scene, program: lang.Program) -> dict[str, Any]:
    """The scene's values of a program's parameters, moved into their range and onto its step."""
    stored = _stored(scene)
    if stored is None:
        return {}
    return {n: _snapped(e, stored[n]) for n, e in program.exports.items() if n in stored}


def store_parameters(scene: bpy.types.Scene, program: lang.Program, values: dict[str, Any]) -> None:
    """Set values that were checked against the program."""
    offer_parameters(scene, program)
    stored = _stored(scene)
    for name, value in values.items():
        stored[name] = _to_property(program.exports[name], value)


def _stored(scene: bpy.types.Scene) -> Any:
    return getattr(getattr(scene, "trg", None), "parameters", None)


def _is_whole(export: lang.Export) -> bool:
    """Whether a num steps through whole numbers that Blender's integers can hold."""
    if export.step is None or max(abs(export.low), abs(export.high)) > MAX_INTEGER:
        return False
    return export.step.is_integer() and export.low.is_integer()


def _to_property(export: lang.Export, value: Any) -> Any:
    if export.choices:
        return export.choices.index(value)
    if export.type == "flag":
        return bool(value)
    if export.type == "num" and _is_whole(export):
        return round(value)
    return value


def _snapped(export: lang.Export, value: Any) -> Any:
    """A property as a value of the language; what cannot be one is handed on and refused later."""
    if export.choices and isinstance(value, int):
        return export.choices[value] if 0 <= value < len(export.choices) else None
    if export.type in ("vec3", "colour"):
        return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value
    if export.low is not None and isinstance(value, int | float):
        return _in_range(export, float(value))
    return value


def _in_range(export: lang.Export, number: float) -> float:
    """The nearest number of the range: limits may have changed with the text, and keys know no steps."""
    held = min(max(number, export.low), export.high)
    if export.step is None:
        return held
    turns = math.floor((held - export.low) / export.step + 0.5)
    place = export.low + turns * export.step
    return place if place <= export.high else place - export.step


def _looks(export: lang.Export) -> dict[str, Any]:
    """What the user interface has to know of the property."""
    looks: dict[str, Any] = {"description": export.doc}
    if export.choices:
        looks["items"] = [(c, c, "", n) for n, c in enumerate(export.choices)]
        looks["default"] = export.choices.index(export.default)
    elif export.type == "colour":
        looks |= {"subtype": "COLOR", "min": 0.0, "soft_max": 1.0, "default": export.default}
    else:
        looks["default"] = _to_property(export, export.default)
    if export.low is not None:
        whole = _is_whole(export)
        looks["min"] = int(export.low) if whole else export.low
        looks["max"] = int(export.high) if whole else export.high
        if whole:
            looks["step"] = int(export.step)
    return looks
