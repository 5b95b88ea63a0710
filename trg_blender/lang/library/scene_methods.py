"""The scene: what stands in it, its camera, and the hand-over of frames."""

from __future__ import annotations

from collections.abc import Iterator

from ..bind import HOST
from ..runtime import Runtime
from ..scene import CameraRecord, LightRecord, SceneDescription, ShapeRecord, TextureRecord
from ..scene import Vec3 as Triple
from ..source import Span
from ..values import Value
from ..vector import Vec3
from .things import Light, Shape, Texture, name_error, triple

DEFAULT_FOV = 53.13010235415598


class SceneObject(Value):
    """The scene of a run; there is one. Records of what did not change are handed out again."""

    __slots__ = (
        "ambient", "background", "camera", "dirty", "lights", "materials_changed", "rt", "shapes",
        "_light_records", "_shape_records",
    )  # fmt: skip
    kind = "scene"

    def __init__(self, rt: Runtime) -> None:
        self.rt = rt
        self.shapes: dict[Shape, ShapeRecord | None] = {}
        self.lights: dict[Light, LightRecord | None] = {}
        self.dirty: dict[Shape | Light, None] = {}
        self.materials_changed = False
        self.camera: CameraRecord | None = None
        self.background: Triple | TextureRecord | None = None
        self.ambient: Triple = (0.0, 0.0, 0.0)
        self._shape_records: tuple[ShapeRecord, ...] | None = ()
        self._light_records: tuple[LightRecord, ...] | None = ()

    def add_light(self, light: Light) -> None:
        """Put a light in, once."""
        if light not in self.lights:
            self.lights[light] = self.dirty[light] = None

    def remove(self, thing: Shape | Light) -> None:
        """Take a thing out; one that is not there is no error."""
        if isinstance(thing, Shape):
            if self.shapes.pop(thing, None) is not None:
                self._shape_records = None
        elif self.lights.pop(thing, None) is not None:
            self._light_records = None

    def describe(self, frame: int, origin: Span) -> SceneDescription:
        """The scene as records."""
        self._refresh()
        if self._shape_records is None:
            self._shape_records = tuple(r for r in self.shapes.values() if r is not None)
        if self._light_records is None:
            self._light_records = tuple(r for r in self.lights.values() if r is not None)
        extra = {} if self.background is None else {"background": self.background}
        return SceneDescription(
            frame, self._shape_records, self._light_records, self.camera,
            ambient=self.ambient, modes=self.rt.modes, origin=origin, **extra,
        )  # fmt: skip

    def _refresh(self) -> None:
        changed: list[Shape | Light] = list(self.dirty)
        if self.materials_changed:
            changed += [shape for shape in self.shapes if shape not in self.dirty]
        for thing in changed:
            if isinstance(thing, Shape):
                if thing in self.shapes:
                    self.shapes[thing] = thing.record()
                    self._shape_records = None
            elif thing in self.lights:
                self.lights[thing] = thing.record()
                self._light_records = None
        self.dirty.clear()
        self.materials_changed = False


@HOST.function("scene", "", "The scene.", "scene")
def _scene(rt: Runtime) -> object:
    return rt.scene


@HOST.method(SceneObject, "Add", "item: shape|light", "Put a shape or light in; returns it.")
def _add(rt: Runtime, scene: SceneObject, item: Shape | Light) -> object:
    if isinstance(item, Shape):
        shapes = scene.shapes
        if item not in shapes:
            shapes[item] = scene.dirty[item] = None
    else:
        scene.add_light(item)
    return item


@HOST.method(SceneObject, "Remove", "item: shape|light", "Take a shape or light out; returns it.")
def _remove(rt: Runtime, scene: SceneObject, item: Shape | Light) -> object:
    scene.remove(item)
    return item


@HOST.method(
    SceneObject, "CamSet",
    "width: num 1..16384, height: num 1..16384, loc: vec3, at: vec3, up: vec3, fov: num? 1..179",
    "Set the picture's size in pixels and the camera; fov in degrees on the shorter side.",
)  # fmt: skip
def _cam_set(rt: Runtime, scene: SceneObject, width: float, height: float, *rest: object) -> object:
    loc, at, up, fov = rest
    if loc == at:
        raise name_error("Scene.CamSet", "the camera stands where it looks at")
    if up == Vec3.of(0.0, 0.0, 0.0):
        raise name_error("Scene.CamSet", "the up vector has no length")
    site = rt.site()
    scene.camera = CameraRecord(
        int(width), int(height), triple(loc), triple(at), triple(up),  # type: ignore[arg-type]
        DEFAULT_FOV if fov is None else fov, None if site is None else site.span,  # type: ignore[arg-type]
    )  # fmt: skip
    return scene


@HOST.method(SceneObject, "Background", "look: colour|texture", "Set what rays see that miss.")
def _background(rt: Runtime, scene: SceneObject, look: Vec3 | Texture) -> object:
    scene.background = look.record if isinstance(look, Texture) else triple(look)
    return scene


@HOST.method(SceneObject, "Ambient", "colour: colour", "Set the light that comes from everywhere.")
def _ambient(rt: Runtime, scene: SceneObject, colour: Vec3) -> object:
    scene.ambient = triple(colour)
    return scene


@HOST.method(SceneObject, "Render", "", "Hand the frame over and wait for the next.", "undef")
def _render(rt: Runtime, scene: SceneObject) -> object:
    site = rt.site()
    origin = site.span if site is not None else rt.program.start
    return _hand_over(rt, scene, origin)


def _hand_over(rt: Runtime, scene: SceneObject, origin: Span) -> Iterator[object]:
    """Suspends the program with the description; goes on when the host asks for the next frame."""
    yield scene.describe(rt.frame + 1, origin)
    return rt.undef  # type: ignore[return-value]
