"""The records a program hands over with each Scene.Render(): plain, frozen, each with its origin.

Coordinates are TRG's: right-handed, Y up, metres; colours linear RGB; angles as the field says.
Keys are stable from frame to frame and from run to run of one program (`sphere@12:5#3`: kind, place of
the constructor call, count at that place), so that whoever mirrors the scene touches only what changed:
equal key and equal version mean an equal record.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from .source import Span

Vec3 = tuple[float, float, float]
Transform = tuple[float, ...]
"""Three rows of four, row-major: object to TRG world."""

IDENTITY: Transform = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)

TEXTURE_SLOTS = {1: "base_color", 2: "roughness", 3: "metallic", 4: "normal", 5: "emission"}


@dataclass(frozen=True, slots=True)
class TextureRecord:
    key: str
    file: str
    """As the author wrote it."""
    path: str | None
    """Where the resolver found it; None when it is missing (a warning was given: show a placeholder)."""
    tiles: float = 1.0
    origin: Span | None = None


@dataclass(frozen=True, slots=True)
class MaterialRecord:
    """A Principled-like material, with the paper's Phong row kept beside it for `classic`."""

    key: str
    version: int
    name: str
    base_color: Vec3 = (0.8, 0.8, 0.8)
    metallic: float = 0.0
    roughness: float = 0.5
    ior: float = 1.5
    transmission: float = 0.0
    emission_color: Vec3 = (0.0, 0.0, 0.0)
    emission_strength: float = 0.0
    phong_ambient: Vec3 = (0.0, 0.0, 0.0)
    phong_diffuse: Vec3 = (0.8, 0.8, 0.8)
    phong_specular: Vec3 = (0.0, 0.0, 0.0)
    phong_power: float = 32.0
    reflect: float = 0.0
    refract: float = 0.0
    textures: tuple[tuple[str, TextureRecord], ...] = ()
    """(slot name from TEXTURE_SLOTS, texture), in slot order."""
    origin: Span | None = None


@dataclass(frozen=True, slots=True)
class MediumRecord:
    decay: float = 0.0
    """Absorption per unit length."""
    index: float = 1.0


@dataclass(frozen=True, slots=True)
class ShapeRecord:
    """One shape. `parameters` by kind, in constructor order:

    sphere (centre, radius) | box (corner1, corner2) | plane (normal, distance) |
    tor (centre, tube_radius, ring_radius) | conus (base_centre, radius, height) |
    cylinder (base_centre, radius, height) | fence (centre, radius, height, count) |
    triangle (p0, p1, p2) | model (file,)

    Vectors are Vec3, numbers float. `path` is the resolved file of a model, None when missing.
    """

    key: str
    version: int
    kind: str
    parameters: tuple[Vec3 | float | str, ...]
    mesh_key: str
    """Equal for shapes that share a mesh (x.Copy()); the mesh is the shape before `transform`."""
    material: MaterialRecord | None
    medium: MediumRecord = MediumRecord()
    transform: Transform = IDENTITY
    name: str = ""
    path: str | None = None
    origin: Span | None = None


@dataclass(frozen=True, slots=True)
class LightRecord:
    """One light. `kind`: dir | point | spot | area.

    dir: `direction` points towards the light; colour (1, 1, 1) gives a facing white Lambert surface
    the radiance 1. point and spot: `position`, `falloff` (cc, cl, cq): radiance of a facing white
    Lambert surface at distance d is colour * min(1, 1 / (cc + cl d + cq d^2)); the default (0, 0, 1)
    is the plain inverse square, without the minimum. spot: `direction` is
    where it shines, `angle_in` and `angle_out` full cone angles in degrees. area: rectangle centred on
    `position`, shining along `direction`, `size` (width, height) metres, colour is its radiance.
    """

    key: str
    version: int
    kind: str
    color: Vec3
    position: Vec3 = (0.0, 0.0, 0.0)
    direction: Vec3 = (0.0, 1.0, 0.0)
    falloff: Vec3 = (0.0, 0.0, 1.0)
    angle_in: float = 0.0
    angle_out: float = 0.0
    size: tuple[float, float] = (0.0, 0.0)
    transform: Transform = IDENTITY
    name: str = ""
    origin: Span | None = None


@dataclass(frozen=True, slots=True)
class CameraRecord:
    width: int
    height: int
    location: Vec3
    target: Vec3
    up: Vec3
    fov_degrees: float = 53.13010235415598
    """On the shorter side of the picture."""
    origin: Span | None = None


@dataclass(frozen=True, slots=True)
class RenderModes:
    """What the program asked for by std::set...; None leaves it to the host."""

    device: str | None = None
    accel: str | None = None
    antialiasing: str | None = None
    antialiasing_n: int = 1


@dataclass(frozen=True, slots=True)
class SceneDescription:
    """The scene at one Scene.Render()."""

    frame: int
    """1 for the first Render() of the program."""
    shapes: tuple[ShapeRecord, ...] = ()
    lights: tuple[LightRecord, ...] = ()
    camera: CameraRecord | None = None
    background: Vec3 | TextureRecord = (0.3, 0.5, 0.7)
    ambient: Vec3 = (0.0, 0.0, 0.0)
    modes: RenderModes = field(default_factory=RenderModes)
    origin: Span | None = None
    """The Render() call."""
