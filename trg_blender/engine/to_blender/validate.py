"""A second look at the records of a program, before Blender sees them.

The language checks its arguments; this is the border, and it trusts nobody.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...lang.scene import (
    IDENTITY,
    CameraRecord,
    LightRecord,
    MaterialRecord,
    SceneDescription,
    ShapeRecord,
    TextureRecord,
)
from ...lang.source import Span
from .errors import SceneError

MAX_SHAPES = 1_000_000
MAX_LIGHTS = 100_000
MAX_PICTURE_SIDE = 65_536
MAX_PICTURE_PIXELS = 16_384 * 16_384
MAX_FENCE_PIECES = 10_000
MAX_LENGTH = 1e12

SHAPE_PARAMETERS: dict[str, tuple[tuple[str, str], ...]] = {
    "sphere": (("centre", "point"), ("radius", "size")),
    "box": (("corner1", "point"), ("corner2", "point")),
    "plane": (("normal", "direction"), ("distance", "number")),
    "tor": (("centre", "point"), ("tube_radius", "size"), ("ring_radius", "size")),
    "conus": (("base_centre", "point"), ("radius", "size"), ("height", "size")),
    "cylinder": (("base_centre", "point"), ("radius", "size"), ("height", "size")),
    "fence": (("centre", "point"), ("radius", "size"), ("height", "size"), ("count", "count")),
    "triangle": (("p0", "point"), ("p1", "point"), ("p2", "point")),
    "model": (("file", "text"),),
}
LIGHT_KINDS = ("dir", "point", "spot", "area")


def check_counts(scene: SceneDescription) -> None:
    """Raise SceneError when the scene holds more than Blender can be asked for."""
    if len(scene.shapes) > MAX_SHAPES:
        raise SceneError(f"the scene has {len(scene.shapes)} shapes; the limit is {MAX_SHAPES}", scene.origin)
    if len(scene.lights) > MAX_LIGHTS:
        raise SceneError(f"the scene has {len(scene.lights)} lights; the limit is {MAX_LIGHTS}", scene.origin)


def check_shape(shape: ShapeRecord) -> None:
    """Raise SceneError unless kind, parameters and transform of the record can be built."""
    expected = SHAPE_PARAMETERS.get(shape.kind)
    if expected is None:
        raise SceneError(f"there is no shape of the kind {shape.kind!r}", shape.origin, shape.key)
    if len(shape.parameters) != len(expected):
        raise SceneError(
            f"{shape.kind} takes {len(expected)} values, {len(shape.parameters)} given",
            shape.origin,
            shape.key,
        )
    for (name, rule), value in zip(expected, shape.parameters, strict=True):
        problem = _problem(rule, value)
        if problem:
            raise SceneError(f"{shape.kind}: {name} {problem}", shape.origin, shape.key)
    _check_transform(shape.transform, shape.kind, shape.origin, shape.key)
    _check_numbers((shape.medium.decay, shape.medium.index), f"{shape.kind}: medium", shape.origin, shape.key)


def check_material(material: MaterialRecord) -> None:
    """Raise SceneError unless every number of the material is finite and none is negative."""
    numbers = (
        *material.base_color,
        material.metallic,
        material.roughness,
        material.ior,
        material.transmission,
        *material.emission_color,
        material.emission_strength,
        *(texture.tiles for _, texture in material.textures),
    )
    label = f"material {material.name!r}"
    _check_numbers(numbers, label, material.origin, material.key)
    if min(numbers) < 0.0:
        raise SceneError(f"{label} has a negative value", material.origin, material.key)


def check_light(light: LightRecord) -> None:
    """Raise SceneError unless the light can be built."""
    label = f"{light.kind} light"
    if light.kind not in LIGHT_KINDS:
        raise SceneError(f"there is no light of the kind {light.kind!r}", light.origin, light.key)
    numbers = (
        *light.color,
        *light.position,
        *light.direction,
        *light.falloff,
        light.angle_in,
        light.angle_out,
        *light.size,
    )
    _check_numbers(numbers, label, light.origin, light.key)
    _check_transform(light.transform, label, light.origin, light.key)
    if min(light.color) < 0.0:
        raise SceneError(f"{label}: colour is negative", light.origin, light.key)
    if light.kind != "point" and not any(light.direction):
        raise SceneError(f"{label}: direction is zero", light.origin, light.key)
    if light.kind == "area" and min(light.size) <= 0.0:
        raise SceneError(f"{label}: size must be positive", light.origin, light.key)
    if light.kind == "spot" and not 0.0 < light.angle_out <= 180.0:
        raise SceneError(
            f"{label}: the outer angle must lie between 0 and 180 degrees", light.origin, light.key
        )


def check_camera(camera: CameraRecord) -> None:
    """Raise SceneError unless picture size, position and field of view can be used."""
    width, height = camera.width, camera.height
    if not (1 <= width <= MAX_PICTURE_SIDE and 1 <= height <= MAX_PICTURE_SIDE):
        raise SceneError(f"the picture cannot be {width} x {height}", camera.origin)
    if width * height > MAX_PICTURE_PIXELS:
        raise SceneError(
            f"the picture has {width * height} pixels; the limit is {MAX_PICTURE_PIXELS}", camera.origin
        )
    _check_numbers(
        (*camera.location, *camera.target, *camera.up, camera.fov_degrees), "camera", camera.origin, ""
    )
    if camera.location == camera.target:
        raise SceneError("the camera stands where it looks at", camera.origin)
    if not any(camera.up):
        raise SceneError("the camera's up vector is zero", camera.origin)
    if not 0.01 <= camera.fov_degrees < 179.0:
        raise SceneError("the field of view must lie between 0.01 and 179 degrees", camera.origin)


def check_background(scene: SceneDescription) -> None:
    """Raise SceneError unless background and ambient light are finite and not negative."""
    colors = [scene.ambient]
    if not isinstance(scene.background, TextureRecord):
        colors.append(scene.background)
    for color in colors:
        _check_numbers(color, "the background", scene.origin, "")
        if min(color) < 0.0:
            raise SceneError("the background has a negative value", scene.origin)


def _problem(rule: str, value: object) -> str:
    """What is wrong with a parameter, or nothing."""
    if rule == "text":
        return "" if isinstance(value, str) else "is not a text"
    if rule in ("point", "direction"):
        if not isinstance(value, tuple) or len(value) != 3 or not _all_usable(value):
            return "is not a vector of finite numbers"
        return "is zero" if rule == "direction" and not any(value) else ""
    if not isinstance(value, int | float) or not _all_usable((value,)):
        return "is not a finite number"
    if rule == "size" and value <= 0:
        return "must be positive"
    if rule == "count" and not 1 <= value <= MAX_FENCE_PIECES:
        return f"must lie between 1 and {MAX_FENCE_PIECES}"
    return ""


def _all_usable(numbers: Iterable[object]) -> bool:
    return all(isinstance(n, (int, float)) and -MAX_LENGTH <= n <= MAX_LENGTH for n in numbers)


def _check_transform(transform: tuple[float, ...], label: str, origin: Span | None, key: str) -> None:
    if transform is IDENTITY:
        return
    if len(transform) != 12 or not _all_usable(transform):
        raise SceneError(f"{label}: its transform is not made of finite numbers", origin, key)


def _check_numbers(numbers: Iterable[float], label: str, origin: Span | None, key: str) -> None:
    if not _all_usable(numbers):
        raise SceneError(f"{label} has a value that is not finite", origin, key)
