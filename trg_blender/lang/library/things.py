"""The values that make a scene: shapes, lights, materials, textures, media.

They can be edited; `record()` hands out a frozen record, the same object as long as nothing changed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from ..runtime import Place, Runtime
from ..scene import (
    IDENTITY,
    TEXTURE_SLOTS,
    LightRecord,
    MaterialRecord,
    MediumRecord,
    ShapeRecord,
    TextureRecord,
    Transform,
)
from ..values import TrgError, Value
from ..vector import Vec3

Triple = tuple[float, float, float]
AIR = MediumRecord()
_new = object.__new__


def triple(v: Vec3) -> Triple:
    """A vector as a plain tuple, as records hold it."""
    return (v[0], v[1], v[2])


def name_error(name: str, reason: str) -> TrgError:
    return TrgError("E508", name=name, reason=reason)


class Medium(Value):
    """What fills a shape."""

    __slots__ = ("record", "rt")
    kind = "medium"

    def __init__(self, rt: Runtime, record: MediumRecord) -> None:
        self.rt = rt
        self.record = record

    def shown(self) -> str:
        return f"enviroment({self.record.decay:g}, {self.record.index:g})"


class Texture(Value):
    """An image file."""

    __slots__ = ("record", "rt")
    kind = "texture"

    def __init__(self, rt: Runtime, record: TextureRecord) -> None:
        self.rt = rt
        self.record = record

    def shown(self) -> str:
        return f"texture({self.record.file})"


class Material(Value):
    """A material that may be edited; its record's version rises when an edit changed something."""

    __slots__ = ("_draft", "_record", "rt")
    kind = "material"

    def __init__(self, rt: Runtime, record: MaterialRecord) -> None:
        self.rt = rt
        self._draft = record
        self._record: MaterialRecord | None = None

    def edit(self, **changes: object) -> Material:
        """Set fields of the record."""
        self._draft = replace(self._draft, **changes)  # type: ignore[arg-type]
        self.rt.scene.materials_changed = True
        return self

    def set_texture(self, texture: Texture, slot: int) -> Material:
        textures = dict(self._draft.textures)
        textures[TEXTURE_SLOTS[max(1, slot)]] = texture.record
        order = list(TEXTURE_SLOTS.values())
        return self.edit(textures=tuple(sorted(textures.items(), key=lambda t: order.index(t[0]))))

    @property
    def draft(self) -> MaterialRecord:
        return self._draft

    def record(self) -> MaterialRecord:
        last = self._record
        if last is None:
            self._record = self._draft
        elif last is not self._draft:
            self._draft = replace(self._draft, version=last.version)
            if self._draft == last:
                self._draft = last
            else:
                self._draft = replace(self._draft, version=last.version + 1)
            self._record = self._draft
        return self._record  # type: ignore[return-value]

    def shown(self) -> str:
        return f"material {self._draft.name}"


Look = Material | Medium | None
"""What a shape may be given at the end of its arguments."""


class Placed(Value):
    """A shape or a light: stands in the scene or not, and can be moved and named."""

    __slots__ = ("rt",)
    rt: Runtime

    def touch(self) -> None:
        """Note that the record must be made anew."""
        self.rt.scene.dirty[self] = None  # type: ignore[index]

    def move_by(self, change: Callable[[Transform], Transform]) -> None:
        """Replace the transform by `change` of it."""
        raise NotImplementedError


class Shape(Placed):
    """A shape of the scene; `make_shape` makes it."""

    __slots__ = (
        "_record", "material", "medium", "mesh", "name", "number", "parameters", "path", "place",
        "transform",
    )  # fmt: skip
    kind = "shape"

    parameters: tuple[object, ...]
    place: Place
    number: int
    material: Material | None
    medium: MediumRecord
    transform: Transform
    name: str
    path: str | None
    mesh: Shape | None
    """The shape whose mesh it shares, None for its own."""
    _record: ShapeRecord | None

    @property
    def figure(self) -> str:
        return self.place.kind

    @property
    def key(self) -> str:
        return f"{self.place.prefix}{self.number}"

    def copy(self, place: Place) -> Shape:
        """Another shape that shares the mesh, made at `place`."""
        made = make_shape(place, self.parameters, self.material, None)
        made.mesh, made.path, made.name = self.mesh or self, self.path, self.name
        made.medium, made.transform = self.medium, self.transform
        return made

    def move_by(self, change: Callable[[Transform], Transform]) -> None:
        self.transform = change(self.transform)
        self.touch()

    def record(self) -> ShapeRecord:
        last = self._record
        material = None if self.material is None else self.material.record()
        if last is None:
            key = self.key
            self._record = last = ShapeRecord(
                key, 1, self.figure, tuple(map(_plain, self.parameters)),
                key if self.mesh is None else self.mesh.key, material, self.medium, self.transform,
                self.name, self.path, self.place.span,
            )  # fmt: skip
            return last
        now = (material, self.medium, self.transform, self.name)
        if now != (last.material, last.medium, last.transform, last.name):
            self._record = last = replace(
                last, version=last.version + 1, material=material, medium=self.medium,
                transform=self.transform, name=self.name,
            )  # fmt: skip
        return last

    def shown(self) -> str:
        return self.figure


def _plain(value: object) -> Triple | float | str:
    return tuple(value) if type(value) is Vec3 else value  # type: ignore[return-value]


def make_shape(place: Place, parameters: tuple[object, ...], first: Look, second: Look) -> Shape:
    """The shape that a call at `place` makes. Material and medium come in either order, each at most once.

    Most of what a program with many shapes does happens here: no work that Render() can do.
    """
    rt = place.rt
    rt.count_thing()
    place.made = number = place.made + 1
    shape: Shape = _new(Shape)
    shape.rt = rt
    shape.parameters = parameters
    shape.place = place
    shape.number = number
    shape.medium = AIR
    shape.transform = IDENTITY
    shape.name = ""
    shape.path = shape.mesh = shape._record = None
    if second is None and (first is None or isinstance(first, Material)):
        shape.material = first
        return shape
    if first is not None and type(first) is type(second):
        raise name_error(place.kind, "give one material and one enviroment at most")
    shape.material = None
    for value in (first, second):
        if isinstance(value, Material):
            shape.material = value
        elif isinstance(value, Medium):
            shape.medium = value.record
    return shape


class Light(Placed):
    """A light of the scene."""

    __slots__ = ("_draft", "_record")
    kind = "light"

    def __init__(self, rt: Runtime, record: LightRecord) -> None:
        self.rt = rt
        self._draft = record
        self._record: LightRecord | None = None

    @property
    def draft(self) -> LightRecord:
        return self._draft

    def edit(self, **changes: object) -> None:
        self._draft = replace(self._draft, **changes)  # type: ignore[arg-type]
        self.touch()

    def move_by(self, change: Callable[[Transform], Transform]) -> None:
        self.edit(transform=change(self._draft.transform))

    def record(self) -> LightRecord:
        last = self._record
        made = replace(self._draft, version=1 if last is None else last.version)
        if made != last:
            self._record = made if last is None else replace(made, version=last.version + 1)
        return self._record  # type: ignore[return-value]

    def shown(self) -> str:
        return f"{self._draft.kind}_light"


def multiply(a: Transform, b: Transform) -> Transform:
    """The transform that applies `b` first, then `a`."""
    rows = []
    for r in range(3):
        row = a[4 * r : 4 * r + 4]
        for c in range(4):
            total = row[0] * b[c] + row[1] * b[4 + c] + row[2] * b[8 + c]
            rows.append(total + (row[3] if c == 3 else 0.0))
    return tuple(rows)


def rotation(axis: Vec3, degrees: float) -> Transform:
    """Turn about an axis through the origin, counter-clockwise seen against it (Rodrigues)."""
    length = math.hypot(*axis)
    x, y, z = (c / length for c in axis)
    angle = math.radians(degrees)
    s, c = math.sin(angle), math.cos(angle)
    d = 1.0 - c
    return (
        c + x * x * d, x * y * d - z * s, x * z * d + y * s, 0.0,
        y * x * d + z * s, c + y * y * d, y * z * d - x * s, 0.0,
        z * x * d - y * s, z * y * d + x * s, c + z * z * d, 0.0,
    )  # fmt: skip
