"""Shapes, models, media, textures, and the methods of what stands in a scene."""

from __future__ import annotations

from dataclasses import replace

from ..bind import HOST
from ..files import FileError
from ..runtime import Place, Runtime
from ..scene import MediumRecord, TextureRecord
from ..values import TrgError
from ..vector import Vec3
from .things import (
    Light,
    Look,
    Material,
    Medium,
    Placed,
    Shape,
    Texture,
    make_shape,
    multiply,
    name_error,
    rotation,
)

_LOOKS = "mtl: material|medium?, envi: material|medium?"


def find_file(rt: Runtime, name: str) -> str | None:
    """Where a texture or model lies. A missing one is a warning at the call, or an error if strict."""
    site = rt.site()
    span = site.span if site is not None else rt.program.start
    try:
        path = rt.program.resolver.resolve_file(name, span.file)
    except FileError as error:
        raise TrgError(error.code, name=name[:80]) from None
    if path is not None:
        return str(path)
    if rt.options.strict_files:
        raise TrgError("E511", name=name[:80])
    rt.warn("W702", span, name=name[:80])
    return None


@HOST.maker("sphere", f"centre: vec3, radius: num > 0, {_LOOKS}", "A ball.", "shape")
def _sphere(place: Place, centre: Vec3, radius: float, a: Look, b: Look) -> object:
    return make_shape(place, (centre, radius), a, b)


@HOST.maker("box", f"corner1: vec3, corner2: vec3, {_LOOKS}", "A box between corners.", "shape")
def _box(place: Place, corner1: Vec3, corner2: Vec3, a: Look, b: Look) -> object:
    return make_shape(place, (corner1, corner2), a, b)


@HOST.maker(
    "plane", f"normal: vec3, distance: num, {_LOOKS}",
    "The infinite plane of the points P with normal . P = distance.", "shape",
)  # fmt: skip
def _plane(place: Place, normal: Vec3, distance: float, a: Look, b: Look) -> object:
    if not any(normal):
        raise name_error("plane", "the normal has no length")
    return make_shape(place, (normal, distance), a, b)


@HOST.maker(
    "tor", f"centre: vec3, tube_radius: num > 0, ring_radius: num > 0, {_LOOKS}",
    "A torus round the Y axis.", "shape",
)  # fmt: skip
def _tor(place: Place, centre: Vec3, tube: float, ring: float, *looks: Look) -> object:
    return make_shape(place, (centre, tube, ring), *looks)


@HOST.maker(
    "conus", f"base_centre: vec3, radius: num > 0, height: num > 0, {_LOOKS}",
    "A cone that stands on its base and points along +Y.", "shape",
)  # fmt: skip
def _conus(place: Place, base: Vec3, radius: float, height: float, *looks: Look) -> object:
    return make_shape(place, (base, radius, height), *looks)


@HOST.maker(
    "cylinder", f"base_centre: vec3, radius: num > 0, height: num > 0, {_LOOKS}",
    "A cylinder that stands on its base, along +Y.", "shape",
)  # fmt: skip
def _cylinder(place: Place, base: Vec3, radius: float, height: float, *looks: Look) -> object:
    return make_shape(place, (base, radius, height), *looks)


@HOST.maker(
    "fence", f"centre: vec3, radius: num > 0, height: num > 0, count: num 3..10000, {_LOOKS}",
    "A ring of wall pieces round the Y axis, centred on centre.", "shape",
)  # fmt: skip
def _fence(place: Place, centre: Vec3, radius: float, height: float, *rest: object) -> object:
    count, a, b = rest
    pieces = float(int(count))  # type: ignore[call-overload]
    return make_shape(place, (centre, radius, height, pieces), a, b)  # type: ignore[arg-type]


@HOST.maker("triangle", f"p0: vec3, p1: vec3, p2: vec3, {_LOOKS}", "One triangle.", "shape")
def _triangle(place: Place, p0: Vec3, p1: Vec3, p2: Vec3, *looks: Look) -> object:
    return make_shape(place, (p0, p1, p2), *looks)


@HOST.maker(
    "model", "file: str, envi: material|medium?, mtl: material|medium?",
    "A mesh from a .g3dm, .obj, .glb, .ply or .stl file, as large as it is there.", "shape",
)  # fmt: skip
def _model(place: Place, file: str, a: Look, b: Look) -> object:
    shape = make_shape(place, (file,), a, b)
    shape.path = find_file(place.rt, file)
    return shape


def _medium(rt: Runtime, decay: float, index: float) -> object:
    return Medium(rt, MediumRecord(decay, index))


for _name in ("enviroment", "environment"):
    HOST.function(
        _name, "decay: num >= 0, index: num > 0 = 1",
        "What fills a shape: absorption per unit length and refraction index; (0, 1) is air.",
        "medium",
    )(_medium)  # fmt: skip


@HOST.function(
    "texture", "file: str, tiles: num > 0 = 1",
    "An image, repeated tiles times along u and v.", "texture",
)  # fmt: skip
def _texture(rt: Runtime, file: str, tiles: float) -> object:
    key, span = rt.make_key("texture")
    return Texture(rt, TextureRecord(key, file, find_file(rt, file), tiles, span))


# Methods of shapes and lights.


def _placed_methods(owner: type[Placed]) -> None:
    method = HOST.method

    @method(owner, "Move", "by: vec3", "Shift it.")
    def _move(rt: Runtime, thing: Placed, by: Vec3) -> object:
        x, y, z = by
        shift = (1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, y, 0.0, 0.0, 1.0, z)
        thing.move_by(lambda old: multiply(shift, old))
        return thing

    @method(owner, "Rotate", "axis: vec3, degrees: num", "Turn it about an axis through (0, 0, 0).")
    def _rotate(rt: Runtime, thing: Placed, axis: Vec3, degrees: float) -> object:
        if not any(axis):
            raise name_error(f"{owner.kind}.Rotate", "the axis has no length")
        thing.move_by(lambda old: multiply(rotation(axis, degrees), old))
        return thing

    @method(owner, "Scale", "by: vec3|num", "Stretch it from (0, 0, 0).")
    def _scale(rt: Runtime, thing: Placed, by: Vec3 | float) -> object:
        x, y, z = by if isinstance(by, Vec3) else (by, by, by)
        if not (x and y and z):
            raise name_error(f"{owner.kind}.Scale", "no factor may be 0")
        stretch = (x, 0.0, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, z, 0.0)
        thing.move_by(lambda old: multiply(stretch, old))
        return thing


_placed_methods(Shape)
_placed_methods(Light)


@HOST.method(Shape, "Material", "mtl: material", "Give it another material.")
def _set_material(rt: Runtime, shape: Shape, mtl: Material) -> object:
    shape.material = mtl
    shape.touch()
    return shape


@HOST.method(Shape, "Name", "name: str", "Name it for Blender's outliner.")
def _name_shape(rt: Runtime, shape: Shape, name: str) -> object:
    shape.name = name
    shape.touch()
    return shape


@HOST.method(Light, "Name", "name: str", "Name it for Blender's outliner.")
def _name_light(rt: Runtime, light: Light, name: str) -> object:
    light.edit(name=name)
    return light


@HOST.method(Shape, "Copy", "", "Another shape that shares the mesh; not yet in the scene.")
def _copy_shape(rt: Runtime, shape: Shape) -> object:
    return shape.copy(rt.place(shape.figure))


@HOST.method(Light, "Copy", "", "Another light of the same kind; not yet in the scene.")
def _copy_light(rt: Runtime, light: Light) -> object:
    rt.count_thing()
    key, span = rt.make_key(f"{light.draft.kind}_light")
    return Light(rt, replace(light.draft, key=key, origin=span))
