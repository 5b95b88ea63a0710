"""Lights."""

from __future__ import annotations

from ..bind import HOST
from ..runtime import Runtime
from ..scene import LightRecord
from ..source import Span
from ..vector import Vec3
from .things import Light, Triple, name_error, triple


def _key(rt: Runtime, kind: str) -> tuple[str, Span]:
    rt.count_thing()
    return rt.make_key(f"{kind}_light")


def _direction(kind: str, v: Vec3) -> Triple:
    if not any(v):
        raise name_error(f"{kind}_light", "the direction has no length")
    return triple(v)


@HOST.function(
    "dir_light", "towards_light: vec3, colour: colour",
    "Light from far away, out of the direction given.", "light",
)  # fmt: skip
def _dir_light(rt: Runtime, towards: Vec3, colour: Vec3) -> object:
    direction = _direction("dir", towards)
    key, span = _key(rt, "dir")
    return Light(rt, LightRecord(key, 1, "dir", triple(colour), direction=direction, origin=span))


@HOST.function(
    "point_light",
    "position: vec3, colour: colour, cc: num >= 0 = 0, cl: num >= 0 = 0, cq: num >= 0 = 1",
    "Light from a point, weakened by 1 / (cc + cl d + cq d d).", "light",
)  # fmt: skip
def _point_light(rt: Runtime, position: Vec3, colour: Vec3, *falloff: float) -> object:
    cc, cl, cq = falloff
    if not (cc or cl or cq):
        raise name_error("point_light", "cc, cl and cq cannot all be 0")
    key, span = _key(rt, "point")
    record = LightRecord(
        key, 1, "point", triple(colour), triple(position),
        falloff=(cc, cl, cq), origin=span,
    )  # fmt: skip
    return Light(rt, record)


@HOST.function(
    "spot_light",
    "position: vec3, direction: vec3, angle_in: num 0..180, angle_out: num 0..180, colour: colour",
    "A cone of light; the full angles of its core and its rim in degrees.", "light",
)  # fmt: skip
def _spot_light(rt: Runtime, position: Vec3, direction: Vec3, *rest: object) -> object:
    angle_in, angle_out, colour = rest
    if angle_in > angle_out:  # type: ignore[operator]
        raise name_error("spot_light", "angle_in cannot be greater than angle_out")
    shines = _direction("spot", direction)
    key, span = _key(rt, "spot")
    record = LightRecord(
        key, 1, "spot", triple(colour), triple(position), shines,  # type: ignore[arg-type]
        angle_in=angle_in, angle_out=angle_out, origin=span,  # type: ignore[arg-type]
    )  # fmt: skip
    return Light(rt, record)


@HOST.function(
    "area_light",
    "position: vec3, direction: vec3, width: num > 0, height: num > 0, colour: colour",
    "A rectangle that shines along direction; colour is its radiance.", "light",
)  # fmt: skip
def _area_light(rt: Runtime, position: Vec3, direction: Vec3, *rest: object) -> object:
    width, height, colour = rest
    shines = _direction("area", direction)
    key, span = _key(rt, "area")
    record = LightRecord(
        key, 1, "area", triple(colour), triple(position), shines,  # type: ignore[arg-type]
        size=(width, height), origin=span,  # type: ignore[arg-type]
    )  # fmt: skip
    return Light(rt, record)
