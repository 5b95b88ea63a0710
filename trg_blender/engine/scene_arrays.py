"""A whole scene as flat arrays: what every renderer of TRG takes, without bpy.

Space is Blender's world: right-handed, Z up, metres; colours are scene-linear Rec.709 radiometry.
The meaning of every number is docs/architecture.md, section 4.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .path_rules import NO_RULES, PathRules
from .texture_ops import ProgramArrays

if TYPE_CHECKING:
    from .classic_arrays import ClassicMaterial

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
Int32 = NDArray[np.int32]
Color = tuple[float, float, float]

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""(3,) weights of linear Rec.709"""

WRAP_MODES = ("repeat", "extend", "clip", "mirror")
FILTERS = ("linear", "closest", "cubic")
CHANNELS = ("color", "alpha", "luminance")
"""what of a texel a texture gives: its colour, or its alpha or its Rec.709 luminance as a grey"""
LIGHT_KINDS = ("sun", "point", "spot", "area_rectangle", "area_ellipse")
SHAPES = ("triangles", "sphere", "plane")
"""what a mesh may be: its triangles, the unit sphere round the origin, the infinite plane z = 0"""
INTERFACES = ("clear", "stained", "refraction_only")
"""what reflection and refraction of a transmitting material look like: docs/architecture.md, section 4"""
CAMERA_RAY, DIFFUSE_RAY, GLOSSY_RAY, TRANSMISSION_RAY, SHADOW_RAY, EVERY_RAY = 1, 2, 4, 8, 16, 255
"""bits of InstanceArrays.masks: rays by the scattering that sent them on, and those towards lights"""
CAMERA_KINDS = ("perspective", "orthographic", "panorama")


@dataclass(slots=True)
class MeshArrays:
    """Triangles of one mesh in its own space, or a shape that rays meet exactly.

    A shape other than triangles is that shape alone; its triangles are a stand-in for who cannot trace
    it. All of it has slot 0. A sphere's u turns about z from -y towards x and its v rises from pole to
    pole, both from 0 to 1; a plane's u and v are x and y.
    """

    vertices: Float32
    """(n, 3)"""
    triangles: Int32
    """(m, 3), counter-clockwise seen from outside"""
    normals: Float32 | None = None
    """(m, 3, 3) corner normals, unit; None is flat shading"""
    uvs: Float32 | None = None
    """(m, 3, 2); None when no material of the scene asks for it"""
    slots: Int32 | None = None
    """(m,) material slot of each triangle; None is slot 0"""
    origin: str = ""
    """Blender name, for messages"""
    shape: str = "triangles"
    """one of SHAPES"""
    attributes: dict[int, Float32] = field(default_factory=dict)
    """(m, 3, 1 to 4) values at the corners, by their index in SceneArrays.attributes (0 is not used)"""
    texture_space: tuple[Color, Color] | None = None
    """scale and offset: generated coordinates are place * scale + offset; None is the place itself"""


@dataclass(frozen=True, slots=True)
class Identity:
    """Who an instance is, for passes."""

    name: str
    """of its object"""
    asset: str = ""
    """of the topmost parent of its object"""
    index: int = 0
    """pass index"""


@dataclass(frozen=True, slots=True)
class PassData:
    """What passes ask of a scene beside its shape; only there when one of them is wanted."""

    materials: tuple[Identity, ...] = ()
    """of SceneArrays.materials, without assets; fewer: the rest have no id"""
    matte_levels: int = 6
    """ids that a pixel of a Cryptomatte keeps"""
    mist: tuple[float, float, float] = (5.0, 25.0, 2.0)
    """start, depth, exponent: ((distance - start) / depth) ** exponent between 0 and 1"""
    ambient_distance: float = 10.0
    """how far off a surface occludes another"""


@dataclass(slots=True)
class InstanceArrays:
    """Copies of one mesh that share their materials."""

    mesh: int
    transforms: Float32
    """(k, 3, 4) object to world"""
    slot_materials: Int32
    """(slots,) slot -> index into SceneArrays.materials"""
    origin: str = ""
    randoms: Float32 | None = None
    """(k,) what the Object Info node calls Random, 0 to 1; None is 0"""
    identities: tuple[Identity, ...] = ()
    """one a copy; empty when no pass asks for them"""
    motion: Float32 | None = None
    """(k, keys, 3, 4) transforms at even steps while the shutter is open, straight lines between;
    `transforms` are those of the middle. None: nothing moves"""
    mask: int = EVERY_RAY
    """bits of the rays that meet the copies"""
    holdout: bool = False
    """the camera sees a hole where they are"""


@dataclass(slots=True)
class ImageArrays:
    """Pixels as they were stored; row 0 is the bottom row."""

    pixels: NDArray[np.uint8] | NDArray[np.float16] | Float32
    """(h, w, c), c = 1, 3 or 4"""
    srgb: bool = True
    """True: red, green and blue are sRGB-encoded; bytes and halves are interpolated so, floats after
    conversion"""
    origin: str = ""


@dataclass(slots=True)
class Texture:
    """A look-up: the image at (scale_u u + skew_u v + offset_u, skew_v u + scale_v v + offset_v), or a
    program."""

    image: int
    """index into SceneArrays.images; -1 where there is a program"""
    scale_u: float = 1.0
    scale_v: float = 1.0
    offset_u: float = 0.0
    offset_v: float = 0.0
    wrap: int = 0
    """index into WRAP_MODES"""
    skew_u: float = 0.0
    skew_v: float = 0.0
    filter: int = 0
    """index into FILTERS"""
    channel: int = 0
    """index into CHANNELS"""
    uv_map: int = 0
    """index into SceneArrays.attributes; 0 is MeshArrays.uvs"""
    unassociate: int = 0
    """1: the stored colour was multiplied by alpha; divide it after interpolation"""
    program: int = -1
    """row of ProgramArrays.programs, which then gives the value"""


@dataclass(slots=True)
class Material:
    """One row of the material table; `*_texture` is an index into SceneArrays.textures or -1."""

    base_r: float = 0.8
    base_g: float = 0.8
    base_b: float = 0.8
    metallic: float = 0.0
    roughness: float = 0.5
    ior: float = 1.5
    specular: float = 1.0
    transmission: float = 0.0
    emission_r: float = 0.0
    emission_g: float = 0.0
    emission_b: float = 0.0
    base_texture: int = -1
    roughness_texture: int = -1
    metallic_texture: int = -1
    emission_texture: int = -1
    normal_texture: int = -1
    """gives the shading normal, in the world"""
    specular_tint_r: float = 1.0
    specular_tint_g: float = 1.0
    specular_tint_b: float = 1.0
    metal_grazing: float = 1.0
    """1: metal whitens towards grazing angles, 0: it is the base colour everywhere"""
    multiscatter: float = 1.0
    """1: facets pass on the light that single scattering loses between them, 0: they do not"""
    interface: int = 0
    """index into INTERFACES"""
    diffuse_roughness: float = 0.0
    coat: float = 0.0
    coat_roughness: float = 0.03
    coat_ior: float = 1.5
    coat_tint_r: float = 1.0
    coat_tint_g: float = 1.0
    coat_tint_b: float = 1.0
    sheen_r: float = 0.0
    sheen_g: float = 0.0
    sheen_b: float = 0.0
    sheen_roughness: float = 0.5
    alpha: float = 1.0
    """share of the surface that is there; the rest lets light straight through, coloured by `through_*`"""
    through_r: float = 1.0
    through_g: float = 1.0
    through_b: float = 1.0
    alpha_texture: int = -1
    translucent: int = 0
    """1: the diffuse base shines on the side away from the light instead"""
    mix_first: int = -1
    """first of the `mix_count` rows that this one is a mixture of, whose own lobes are then unused"""
    mix_count: int = 0
    weight: float = 1.0
    """of a row that is part of a mixture"""
    weight_texture: int = -1
    absorption_r: float = 0.0
    absorption_g: float = 0.0
    absorption_b: float = 0.0
    """per metre, of what the surface encloses"""
    priority: float = 0.0
    """of what it encloses where media overlap or touch: the highest rules; 0: none, absorption adds up"""
    transmission_texture: int = -1
    coat_texture: int = -1
    sheen_texture: int = -1
    """multiplies the sheen"""
    sheen_roughness_texture: int = -1
    diffuse_roughness_texture: int = -1
    holdout: int = 0
    """1: the camera sees a hole, everyone else black"""


@dataclass(slots=True)
class Light:
    """One row of the light table."""

    kind: int
    """index into LIGHT_KINDS"""
    color_r: float
    color_g: float
    color_b: float
    position_x: float = 0.0
    position_y: float = 0.0
    position_z: float = 0.0
    direction_x: float = 0.0
    direction_y: float = 0.0
    direction_z: float = 1.0
    """sun: unit vector towards the light; spot and area: unit vector along which it shines"""
    axis_u_x: float = 0.0
    axis_u_y: float = 0.0
    axis_u_z: float = 0.0
    axis_v_x: float = 0.0
    axis_v_y: float = 0.0
    axis_v_z: float = 0.0
    radius: float = 0.0
    angle: float = 0.0
    """sun: angular radius, radians"""
    cos_outer: float = -1.0
    cos_inner: float = -1.0
    falloff_constant: float = 0.0
    falloff_linear: float = 0.0
    falloff_quadratic: float = 1.0
    spread: float = 3.141592653589793
    """area: full angle of the cone that it shines into, radians; pi is all of its side"""
    soft: float = 0.0
    """point and spot: 1 for a disc that faces whoever it lights instead of a sphere"""
    seen: float = 0.0
    """sun with angle: 1 for one that the camera sees wherever it sees the environment"""


MATERIAL_FIELDS = tuple(f.name for f in fields(Material))
LIGHT_FIELDS = tuple(f.name for f in fields(Light))
TEXTURE_FIELDS = tuple(f.name for f in fields(Texture))


def pack_table(rows: list[Material] | list[Light] | list[Texture], names: tuple[str, ...]) -> Float32:
    """Float32 table (len(rows), len(names)) with one column a field, in field order."""
    table = np.zeros((len(rows), len(names)), dtype=np.float32)
    for index, row in enumerate(rows):
        table[index] = [getattr(row, name) for name in names]
    return table


@dataclass(slots=True)
class Camera:
    kind: int
    """index into CAMERA_KINDS"""
    matrix: Float64
    """(3, 4) camera to world, axes unit and orthogonal"""
    window: tuple[float, float, float, float]
    """left, right, bottom, top; of a panorama the longitudes (to the right) and latitudes in radians"""
    clip_start: float = 1e-6
    clip_end: float = 1e30
    aperture: float = 0.0
    """radius of the thin lens, in metres; 0: everything is sharp. A panorama has none"""
    focus: float = 1.0
    """depth of what is sharp"""
    blades: int = 0
    """corners of the aperture, on its rim, the first sides to both sides of +x; below 3 a disc"""
    blade_turn: float = 0.0
    """radians"""
    squeeze: float = 1.0
    """the aperture's width over its height"""
    motion: Float64 | None = None
    """(keys, 3, 4) matrices at even steps while the shutter is open, straight lines between; `matrix` is
    that of the middle. None: it stands still"""


@dataclass(slots=True)
class Environment:
    """A world whose radiance depends on the direction: an equirectangular picture."""

    pixels: Float32
    """(h, w, 3) radiance; row 0 looks down, column w / 2 along +x of the picture, u falls towards +y"""
    rotation: Float64 = field(default_factory=lambda: np.eye(3))
    """(3, 3) orthogonal, direction in the world -> direction in the picture"""
    seen_by_camera: bool = True
    """False: camera rays that leave the scene see black"""
    origin: str = ""


@dataclass(slots=True)
class SceneArrays:
    camera: Camera
    meshes: list[MeshArrays] = field(default_factory=list)
    instances: list[InstanceArrays] = field(default_factory=list)
    materials: list[Material] = field(default_factory=list)
    classic: list[ClassicMaterial | None] = field(default_factory=list)
    """row of a material for the classic integrator; None, or no entry: derived (classic_arrays.py)"""
    images: list[ImageArrays] = field(default_factory=list)
    textures: list[Texture] = field(default_factory=list)
    programs: ProgramArrays = field(default_factory=ProgramArrays)
    attributes: list[str] = field(default_factory=lambda: [""])
    """names of corner attributes, for messages; number 0 stands for MeshArrays.uvs"""
    lights: list[Light] = field(default_factory=list)
    world: Color = (0.0, 0.0, 0.0)
    ambient: Color = (0.0, 0.0, 0.0)
    """ambient light of the classic integrator"""
    environment: Environment | None = None
    """takes the place of `world`"""
    transparent_film: bool = False
    pass_data: PassData | None = None
    warnings: list[str] = field(default_factory=list)


PIXEL_FILTERS = ("box", "gaussian", "blackman_harris")


@dataclass(frozen=True, slots=True)
class RenderSettings:
    """How to render. Names of devices, accelerators and integrators are those of the command line."""

    width: int
    height: int
    samples: int = 64
    seed: int = 0
    seconds: float = 0.0
    """wall-clock seconds of tracing after which the render stops; 0: no limit"""
    rmse: float = 0.0
    """estimated error of the picture (linear) at which the render stops; 0: no such stop"""
    pixel_filter: str = "box"
    """one of PIXEL_FILTERS"""
    filter_width: float = 1.0
    """pixels, as Blender means it: a box is so wide, the others taper off beyond"""
    adaptive: bool = False
    """more samples where there is more noise"""
    max_bounces: int = 12
    rules: PathRules = NO_RULES
    threads: int = 0
    """0: all cores"""
    device: str = "cpu"
    accel: str = "auto"
    triangle_test: str = "watertight"
    integrator: str = "path"
    aa: str = "sobol"
    """one of antialiasing.ANTIALIASINGS"""
    aa_side: int = 4
    """cells along the side of a pixel of supersampling, jittering and mfaa"""
    frame: int = 0
    """its parity picks the pattern of mfaa"""
    passes: tuple[str, ...] = ()
    """any of passes.PASS_NAMES; combined is always there"""
    border: tuple[int, int, int, int] | None = None
    """x_min, y_min, x_max, y_max in pixels of the whole picture (max exclusive): render only that part"""
