"""The scenes on which native and reference must agree: every material, light, camera and kind of geometry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from trg_blender.engine.scene_arrays import Environment, Light, Material, RenderSettings, SceneArrays, Texture

from .agreement_programs import program_scenes
from .agreement_rules import rule_cases
from .arrays import ball, box, checker, light, look_at, place, quad

Case = tuple[SceneArrays, RenderSettings]

SIZE = 16
SETTINGS = RenderSettings(SIZE, SIZE, samples=512, seed=5, max_bounces=4)
GREY = Material(0.7, 0.6, 0.5, specular=0.0)
KEY = light(
    "area_rectangle",
    (9, 8, 7),
    (1.5, -1.0, 3.0),
    direction=(-0.4, 0.3, -1.0),
    axis_u=(0.6, 0, -0.24),
    axis_v=(0, 0.5, 0.15),
)


def studio(subject: Material, *lights: Light, world=(0.1, 0.15, 0.2)) -> SceneArrays:
    """A ball and a box of `subject` on a grey floor."""
    return SceneArrays(
        look_at((2.6, -2.4, 1.8), (0, 0, 0.3), 0.42),
        [quad(3.0), ball(0.6, 10), box(0.35)],
        [place(0, 0), place(1, 1, (-0.3, 0.3, 0.62)), place(2, 1, (0.8, -0.5, 0.37))],
        [GREY, subject],
        lights=list(lights) or [KEY],
        world=world,
    )


MATERIALS = {
    "diffuse": Material(0.8, 0.3, 0.2, specular=0.0),
    "plastic": Material(0.2, 0.5, 0.8, roughness=0.4),
    "plastic_polished": Material(0.2, 0.5, 0.8, roughness=0.0, ior=1.8),
    "plastic_half_specular": Material(0.9, 0.9, 0.9, roughness=0.7, specular=0.5),
    "metal": Material(0.9, 0.6, 0.3, metallic=1.0, roughness=0.3),
    "metal_rough": Material(0.9, 0.6, 0.3, metallic=1.0, roughness=0.9),
    "mirror": Material(0.9, 0.9, 0.95, metallic=1.0, roughness=0.0),
    "glass": Material(0.9, 0.95, 1.0, transmission=1.0, roughness=0.0),
    "glass_rough": Material(0.9, 0.7, 1.0, transmission=1.0, roughness=0.5),
    "glass_thin_index": Material(0.9, 0.7, 1.0, transmission=1.0, roughness=0.3, ior=1.0),
    "glass_below_one": Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.3, ior=0.75),
    "mixture": Material(0.9, 0.5, 0.4, metallic=0.3, transmission=0.5, roughness=0.4, ior=1.4),
    "mixture_polished": Material(0.9, 0.5, 0.4, metallic=0.3, transmission=0.5, roughness=0.0),
    "metal_tinted_edge": Material(
        0.9, 0.6, 0.3, metallic=1.0, roughness=0.6, specular_tint_r=0.3, specular_tint_g=0.8
    ),
    "glossy": Material(0.7, 0.6, 0.3, metallic=1.0, roughness=0.7, metal_grazing=0.0),
    "metal_single": Material(0.9, 0.6, 0.3, metallic=1.0, roughness=0.9, multiscatter=0.0),
    "plastic_strong": Material(0.2, 0.5, 0.8, roughness=0.6, specular=2.0, specular_tint_g=0.2),
    "clay": Material(0.8, 0.5, 0.3, specular=0.0, diffuse_roughness=0.9),
    "coat": Material(
        0.7, 0.2, 0.1, roughness=0.7, coat=0.8, coat_roughness=0.3, coat_ior=1.7, coat_tint_b=0.3
    ),
    "coat_polished": Material(0.7, 0.2, 0.1, metallic=0.5, roughness=0.4, coat=1.0, coat_roughness=0.0),
    "sheen": Material(0.1, 0.2, 0.5, roughness=0.8, sheen_r=0.9, sheen_g=0.6, sheen_b=0.4),
    "glass_stained": Material(0.5, 0.7, 0.9, roughness=0.4, transmission=1.0, interface=1),
    "refraction_only": Material(0.9, 0.7, 0.9, roughness=0.3, transmission=1.0, interface=2),
    "everything": Material(
        0.9, 0.5, 0.4, 0.3, 0.4, 1.4, transmission=0.5, coat=0.5, coat_roughness=0.2, sheen_g=0.5
    ),
    "half_there": Material(0.9, 0.5, 0.4, alpha=0.4, through_g=0.6, emission_r=0.5),
    "half_there_glass": Material(0.9, 0.5, 0.9, transmission=1.0, roughness=0.2, alpha=0.7),
    "not_there": Material(0.9, 0.5, 0.4, alpha=0.0, through_r=0.7),
    "translucent": Material(0.8, 0.5, 0.3, specular=0.0, translucent=1),
    "absorbing": Material(
        1.0, 1.0, 1.0, transmission=1.0, roughness=0.0, absorption_r=0.3, absorption_g=1.5, absorption_b=4.0
    ),
    "absorbing_rough": Material(
        1.0, 1.0, 1.0, transmission=1.0, roughness=0.4, absorption_r=0.3, absorption_g=1.5, absorption_b=4.0
    ),
    "glowing": Material(0.5, 0.5, 0.5, emission_r=2.0, emission_g=1.0, emission_b=0.3),
}

LIGHTS = {
    "sun": light("sun", (2, 1.8, 1.5), direction=(0.5, -0.6, 1.0)),
    "sun_with_angle": light("sun", (2, 1.8, 1.5), direction=(0.5, -0.6, 1.0), angle=0.2),
    "point": light("point", (3, 2, 2), (0.9, 0.6, 1.6)),
    "point_sphere": light("point", (3, 2, 2), (0.9, 0.6, 1.6), radius=0.4),
    "point_falloff": light("point", (2, 2, 3), (0.9, 0.6, 1.6), falloff=(0.5, 0.2, 0.3)),
    "spot": light(
        "spot", (6, 5, 5), (1.5, -1.5, 2.5), direction=(-0.6, 0.6, -1.0), cos_outer=0.85, cos_inner=0.95
    ),
    "spot_sphere": light(
        "spot",
        (6, 5, 5),
        (1.5, -1.5, 2.5),
        direction=(-0.6, 0.6, -1.0),
        radius=0.3,
        cos_outer=0.85,
        cos_inner=0.95,
    ),
    "spot_falloff": light(
        "spot",
        (4, 5, 5),
        (1.5, -1.5, 2.5),
        direction=(-0.6, 0.6, -1.0),
        falloff=(1.0, 0.0, 0.1),
        cos_outer=0.85,
        cos_inner=0.95,
    ),
    "rectangle": KEY,
    "point_soft": light("point", (3, 2, 2), (0.9, 0.6, 1.6), radius=0.4, soft=1.0),
    "spread": replace(KEY, spread=1.6),
    "ellipse": light(
        "area_ellipse",
        (9, 8, 7),
        (0.3, -0.4, 1.9),
        direction=(0, 0, -1),
        axis_u=(0.6, 0, 0),
        axis_v=(0.1, 0.3, 0),
    ),
    "rectangle_near": light(
        "area_rectangle",
        (2, 2, 3),
        (0.2, -0.2, 1.5),
        direction=(0, 0, -1),
        axis_u=(1.5, 0, 0),
        axis_v=(0, 0.6, 0),
    ),
    "rectangle_beside": light(
        "area_rectangle",
        (3, 3, 2),
        (1.4, 0.2, 0.5),
        direction=(-1, 0.2, 0),
        axis_u=(0.14, 0.7, 0),
        axis_v=(0, 0, 0.5),
        spread=2.2,
    ),
    "ellipse_near": light(
        "area_ellipse",
        (3, 3, 4),
        (-0.2, 0.1, 1.4),
        direction=(0, 0, -1),
        axis_u=(0.9, 0.3, 0),
        axis_v=(-0.2, 0.6, 0),
    ),
    "soft_near": light("spot", (3, 2, 2), (0.4, -0.4, 1.0), direction=(0, 0, -1), radius=0.5, soft=1.0),
}


def _mixed() -> SceneArrays:
    """A material that is a third plastic, a third glass and a fifth translucent, glows a little, and has
    holes; the weights add up to more than what stops light, as Add Shader makes them."""
    scene = studio(
        Material(0, 0, 0, specular=0.0, alpha=0.7, emission_g=0.3, through_r=0.5, mix_first=2, mix_count=3)
    )
    scene.materials += [
        Material(0.2, 0.5, 0.8, roughness=0.4, weight=0.3),
        Material(1.0, 0.9, 0.9, transmission=1.0, roughness=0.2, weight=0.3),
        Material(0.9, 0.9, 0.5, specular=0.0, translucent=1, weight=0.2),
    ]
    return scene


def _nested_media() -> SceneArrays:
    """A lamp and a glass ball inside a ball of absorbing glass, all of glass that absorbs differently."""
    scene = studio(
        MATERIALS["absorbing_rough"],
        light("point", (0.3, 0.3, 0.3), (-0.3, 0.3, 0.9), radius=0.15),
        world=(0.7, 0.8, 0.9),
    )
    scene.materials.append(
        Material(1, 1, 1, transmission=1.0, roughness=0.2, absorption_r=3.0, absorption_b=0.5)
    )
    inner = place(1, 2, (-0.3, 0.3, 0.5))
    inner.transforms[..., :3] *= 0.4
    scene.instances.append(inner)
    return scene


def _priorities() -> SceneArrays:
    """Rough glass, water that absorbs and ice that overlap, by priorities."""
    rough = Material(1, 1, 1, transmission=1.0, roughness=0.25, ior=1.5, priority=2.0)
    water = Material(0.9, 1, 1, transmission=1.0, roughness=0.0, ior=1.33, priority=1.0, absorption_r=1.0)
    ice = replace(rough, roughness=0.1, ior=1.2)
    lamp = light("point", (0.3, 0.3, 0.3), (-0.3, 0.3, 0.9), radius=0.15)
    scene = studio(rough, lamp, world=(0.7, 0.8, 0.9))
    scene.materials += [water, ice]
    scene.instances += [place(1, 2, (-0.3, 0.3, 0.5)), place(1, 3, (0.3, -0.3, 0.6))]
    scene.instances[-1].transforms[..., :3] *= 0.6
    return scene


def _textured_layers() -> SceneArrays:
    """Weights and roughnesses of layers and transmission by one picture."""
    names = ("transmission", "coat", "sheen", "sheen_roughness", "diffuse_roughness")
    row = Material(0.8, 0.5, 0.3, roughness=0.3, coat_roughness=0.2, sheen_r=1.0, sheen_g=0.5, sheen_b=0.2)
    scene = studio(replace(row, **{f"{name}_texture": 0 for name in names}))
    scene.images, scene.textures = [checker()], [Texture(0, 4.0, 2.0)]
    return scene


def _textured() -> SceneArrays:
    scene = studio(
        Material(
            roughness_texture=1,
            metallic_texture=2,
            base_texture=0,
            emission_texture=3,
            emission_r=0.5,
            emission_g=0.5,
            emission_b=0.5,
        )
    )
    rng = np.random.default_rng(3)
    floats = checker(3, srgb=False)
    floats.pixels = rng.random((3, 5, 1)).astype(np.float32)
    scene.images = [checker(), floats]
    scene.textures = [
        Texture(0, 2.0, 3.0, 0.1, 0.2),
        Texture(1, wrap=1, scale_u=1.3),
        Texture(1),
        Texture(0, wrap=1),
    ]
    scene.materials[0] = replace(GREY, base_texture=1)
    return scene


def _mirrored_and_squashed() -> SceneArrays:
    scene = studio(MATERIALS["glass_rough"])
    squashed = np.array([[-0.8, 0.3, 0.0], [0.0, 1.0, 0.2], [0.0, 0.0, 0.5]])
    scene.instances = [place(0, 0), place(1, 1, (-0.3, 0.3, 0.4), linear=squashed)]
    scene.instances += [place(2, 1, (0.8, -0.5, 0.4), linear=np.diag([1.0, -1.0, 1.0]))]
    return scene


def _wild_normals() -> SceneArrays:
    """A ball of mixed facets whose corner normals often mirror the viewer into it, or look away."""
    scene = studio(replace(MATERIALS["mixture"], coat=0.5, coat_roughness=0.3))
    mesh = scene.meshes[1]
    wild = mesh.normals + np.random.default_rng(5).normal(scale=0.7, size=mesh.normals.shape)
    wild /= np.linalg.norm(wild, axis=-1, keepdims=True)
    scene.meshes[1] = replace(mesh, normals=wild.astype(np.float32))
    return scene


def _many_copies() -> SceneArrays:
    scene = studio(MATERIALS["plastic"])
    for index in range(25):
        scene.instances.append(
            place(2, 1, (index % 5 * 0.5 - 1, index // 5 * 0.5 - 1, 0.1), linear=np.eye(3) * 0.2)
        )
    return scene


def _glow() -> SceneArrays:
    scene = studio(MATERIALS["plastic"], KEY)
    scene.lights = []
    scene.materials += [Material(0, 0, 0, emission_r=8, emission_g=6, emission_b=3, specular=0.0)]
    scene.instances += [place(2, 2, (0.3, 0.6, 1.6)), place(1, 2, (-0.9, -0.9, 0.3), linear=np.eye(3) * 0.2)]
    return scene


def way(*keys: np.ndarray) -> np.ndarray:
    """(1, keys, 3, 4): the motion of one instance."""
    return np.stack(keys)[None].astype(np.float32)


def at(place: tuple[float, float, float], size: float = 1.0) -> np.ndarray:
    """(3, 4)"""
    return np.column_stack([size * np.eye(3), place])


def _moving() -> SceneArrays:
    """A ball that turns a corner, a glowing box that grows, an exact sphere that is half there, a camera."""
    scene = studio(MATERIALS["plastic"], KEY)
    scene.materials += [Material(0, 0, 0, emission_r=8, emission_g=6, emission_b=3, specular=0.0)]
    scene.materials += [Material(0.9, 0.5, 0.4, alpha=0.5, through_g=0.6)]
    scene.instances[1].motion = way(at((-0.7, 0.3, 0.62)), at((-0.3, 0.3, 0.62)), at((-0.3, 0.3, 1.0)))
    glowing = place(2, 2)
    glowing.motion = way(at((0.3, 0.6, 1.6), 0.4), at((0.5, 0.6, 1.6), 1.2))
    sphere = replace(ball(1.0, 10), shape="sphere")
    scene.meshes.append(sphere)
    veiled = place(3, 3)
    veiled.motion = way(at((0.6, -1.1, 0.3), 0.3), at((1.3, -1.1, 0.5), 0.4))
    for each in (glowing, veiled):
        each.transforms = each.motion.mean(axis=1)
    scene.instances += [glowing, veiled]
    there = look_at((2.8, -2.2, 1.9), (0.2, 0, 0.3), 0.42).matrix
    scene.camera.motion = np.stack([scene.camera.matrix, there])
    return scene


def _orthographic() -> SceneArrays:
    scene = studio(MATERIALS["metal"])
    scene.camera = look_at((2.6, -2.4, 1.8), (0, 0, 0.3), 1.5, kind=1)
    scene.camera.clip_start, scene.camera.clip_end = 3.2, 4.5
    return scene


def _lens(kind: int = 0, blades: int = 0) -> SceneArrays:
    scene = studio(MATERIALS["plastic"])
    scene.camera = look_at((2.6, -2.4, 1.8), (0, 0, 0.3), 0.42 if kind == 0 else 1.5, kind=kind)
    scene.camera.aperture, scene.camera.focus = 0.25, 3.0
    scene.camera.blades, scene.camera.blade_turn, scene.camera.squeeze = blades, 0.3, 0.6
    return scene


def _panorama() -> SceneArrays:
    scene = studio(MATERIALS["plastic"])
    scene.camera = look_at((0.6, -0.9, 0.9), (0, 0, 0.4), kind=2)
    scene.camera.window = (-2.5, 3.0, -1.3, 1.5)
    return scene


def _all_lights() -> SceneArrays:
    scene = studio(MATERIALS["plastic"], *LIGHTS.values())
    scene.materials[0] = replace(GREY, emission_g=0.3)
    return scene


def _many_lights() -> SceneArrays:
    rng = np.random.default_rng(1)
    bulbs = [
        light(
            "point", tuple(rng.random(3)), (*rng.uniform(-2, 2, 2), rng.uniform(1.2, 3)), radius=0.1 * (k % 3)
        )
        for k in range(12)
    ]
    return studio(MATERIALS["plastic"], *bulbs)


def _light_tree(
    kinds: str = "psra", subject: str = "plastic", suns: int = 0, lowest: float = 0.3
) -> SceneArrays:
    """More emitters than are listed: points, spots, areas, turned anyhow. Where rough glass would gather a
    lamp right before it, `lowest` keeps them above."""
    rng = np.random.default_rng(7)
    lamps = []
    for number in range(48):
        kind = kinds[number % len(kinds)]
        at = (*rng.uniform(-2.5, 2.5, 2), rng.uniform(lowest, 3.0))
        down = (*rng.uniform(-1, 1, 2), -rng.uniform(0.1, 1.0))
        color = tuple(rng.random(3) * (2.0 if number % 9 else 20.0))
        if kind == "p":
            lamps.append(light("point", color, at, radius=0.1 * (number % 2)))
        elif kind == "s":
            lamps.append(light("spot", color, at, direction=down, cos_outer=0.7, cos_inner=0.9))
        else:
            half = np.cross(down, (1.0, 0.0, 0.0))
            lamps.append(
                light(
                    "area_ellipse" if kind == "a" else "area_rectangle",
                    color,
                    at,
                    direction=down,
                    axis_u=0.2 * half,
                    axis_v=0.2 * np.cross(half, down),
                )
            )
    lamps += [light("sun", (0.3, 0.3, 0.3), direction=(0.2, 0.1 * k, 1.0), angle=0.1) for k in range(suns)]
    return studio(MATERIALS[subject], *lamps)


def _tree_of_triangles() -> SceneArrays:
    scene = _glow()
    scene.meshes[1].shape = "sphere"
    scene.materials += [Material(0.3, 0.3, 0.3, emission_r=1, emission_g=2, emission_b=3, specular=0.0)]
    for k in range(4):
        scene.instances += [place(2, 3, (k - 1.5, 1.5, 0.5 + 0.4 * k), linear=np.eye(3) * 0.4)]
    scene.lights = [light("point", (3, 2, 2), (0.9, 0.6, 1.6), radius=0.2)]
    return scene


def _shapes() -> SceneArrays:
    """A true plane and true spheres, one stretched and textured, one glowing, among meshes."""
    scene = studio(MATERIALS["plastic"])
    scene.meshes[0].shape, scene.meshes[1].shape = "plane", "sphere"
    scene.images, scene.textures = [checker()], [Texture(0, 4.0, 2.0)]
    scene.materials[0] = replace(GREY, base_texture=0)
    scene.materials += [
        MATERIALS["glass"],
        Material(0.5, 0.5, 0.5, emission_r=2.0, emission_g=1.0, emission_b=0.5),
        replace(GREY, base_texture=0),
    ]
    squashed = np.array([[-0.5, 0.2, 0.0], [0.0, 0.3, 0.1], [0.0, 0.0, 0.4]])
    scene.instances += [
        place(1, 2, (0.3, -0.9, 0.4), linear=np.eye(3) * 0.4),
        place(1, 3, (0.9, 0.5, 0.8), linear=np.eye(3) * 0.5),
        place(1, 4, (-0.9, -0.8, 0.5), linear=squashed),
    ]
    return scene


def sky_picture(height: int = 8, sun: float = 60.0) -> np.ndarray:
    """Radiances of a coarse sky: noise, and one bright texel where the sun is."""
    pixels = np.random.default_rng(4).random((height, 2 * height, 3)).astype(np.float32)
    pixels[height * 3 // 4, height // 2] = (sun, 0.9 * sun, 0.7 * sun)
    return pixels


def _environment() -> SceneArrays:
    scene = studio(MATERIALS["plastic"])
    scene.lights = []
    turn = np.array([[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
    tilt = np.array([[1.0, 0.0, 0.0], [0.0, 0.96, -0.28], [0.0, 0.28, 0.96]])
    scene.environment = Environment(sky_picture(), turn @ tilt)
    return scene


def _environment_and_lights() -> SceneArrays:
    scene = _environment()
    scene.materials[1] = MATERIALS["glass"]
    scene.lights = [KEY, LIGHTS["sun"]]
    scene.environment.seen_by_camera = False
    return scene


def _sky_with_sun() -> SceneArrays:
    """A sun that the camera sees within the environment, as Blender's Sky Texture has it."""
    scene = _panorama()
    scene.environment = Environment(sky_picture(sun=0.5), np.eye(3))
    scene.lights = [light("sun", (2, 1.8, 1.5), direction=(-0.5, 0.6, 0.5), angle=0.3, seen=1.0)]
    return scene


GEOMETRY: dict[str, Callable[[], SceneArrays]] = {
    "mixed": _mixed,
    "nested_media": _nested_media,
    "priorities": _priorities,
    "textured_layers": _textured_layers,
    "textured": _textured,
    "wild_normals": _wild_normals,
    "shapes": _shapes,
    "mirrored_and_squashed": _mirrored_and_squashed,
    "many_copies": _many_copies,
    "glow": _glow,
    "lens": _lens,
    "lens_blades": lambda: _lens(0, 5),
    "lens_orthographic": lambda: _lens(1, 6),
    "panorama": _panorama,
    "moving": _moving,
    "orthographic_clipped": _orthographic,
    "all_lights": _all_lights,
    "many_lights": _many_lights,
    "light_tree": _light_tree,
    "light_tree_glass_suns": lambda: _light_tree("pr", "glass_rough", 6, 1.5),
    "light_tree_deltas": lambda: _light_tree("s"),
    "light_tree_triangles": _tree_of_triangles,
    "environment": _environment,
    "environment_and_lights": _environment_and_lights,
    "sky_with_sun": _sky_with_sun,
}


def cases() -> dict[str, Case]:
    """Name -> (scene, settings of the reference). All devices take the same scene."""
    found: dict[str, Case] = {}
    for name, material in MATERIALS.items():
        found[f"material_{name}"] = (studio(material), SETTINGS)
    for name, one in LIGHTS.items():
        found[f"light_{name}"] = (studio(MATERIALS["plastic"], one), SETTINGS)
    for name, build in GEOMETRY.items():
        # The reference pays for every light at every surface.
        scene = build()
        found[name] = (scene, replace(SETTINGS, samples=128) if len(scene.lights) > 5 else SETTINGS)
    for name, scene in program_scenes(studio).items():
        found[name] = (scene, SETTINGS)
    found["direct_light_only"] = (studio(MATERIALS["metal"]), replace(SETTINGS, max_bounces=0))
    found["one_bounce"] = (studio(MATERIALS["glass"]), replace(SETTINGS, max_bounces=1))
    for name, width in (("box", 3.0), ("gaussian", 2.0), ("blackman_harris", 1.5)):
        filtered = replace(SETTINGS, pixel_filter=name, filter_width=width)
        found[f"filter_{name}"] = (studio(MATERIALS["glowing"]), filtered)
    found["border"] = (
        studio(MATERIALS["plastic"]),
        replace(SETTINGS, width=32, height=24, border=(7, 4, 23, 20)),
    )
    furnace = studio(Material(0.8, 0.8, 0.8), light("sun", (0, 0, 0)), world=(1, 1, 1))
    found["furnace"] = (furnace, SETTINGS)
    found.update(rule_cases(studio, SETTINGS))
    return found
