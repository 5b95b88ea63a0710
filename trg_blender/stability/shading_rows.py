"""Rows of pictures of stiff materials, lights and textures: B08 and B10 to B15."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ..engine.program_builder import ProgramBuilder, ProgramPool, Value
from ..engine.scene_arrays import (
    FILTERS,
    MATERIAL_FIELDS,
    TEXTURE_FIELDS,
    Float32,
    Float64,
    Light,
    Material,
    Texture,
    pack_table,
)
from ..engine.texture_ops import MATH_OPERATIONS
from .case import ANY, EMBREE, ONCE, Case, NotApplicable, Outcome, Row, within
from .leaving_rows import add_mesh, box, film, glass, mean_is
from .meshes import mesh_of
from .stage import (
    GLOW,
    GREY,
    POINT,
    RECTANGLE,
    SUN,
    WHITE,
    Camera,
    Settings,
    add_object,
    make_floor,
    make_sphere,
    new_scene,
    picture,
)

PICTURE = 1_000_000
NATIVE = (ANY,)


def as_nothing(accel: str, count: int, seed: int = 0) -> Outcome:
    """B08: a smooth ball of index 1 + 1e-7 before a glowing square; the same picture without it."""
    found = []
    for there in (True, False):
        scene = new_scene([glass(1 + 1e-7), GLOW], world=0.25, accel=accel)
        add_object(scene, make_floor(0.6, -2.0), 1)
        if there:
            add_object(scene, make_sphere(24))
        found.append(picture(scene, film(count, 8, seed), Camera(half_width=1.2))[..., :3].astype(np.float64))
    off = np.abs(found[0] - found[1])
    return within(float(off.mean()), 1e-5, what="mean difference")


Lit = Callable[[str, float], object]


def lit_by_world(accel: str, scale: float) -> object:
    scene = new_scene([GREY], world=scale, accel=accel)
    add_object(scene, make_sphere(16))
    return scene


def lit_by_lights(accel: str, scale: float) -> object:
    lights = [
        Light(POINT, scale, scale, scale, position_x=1.0, position_z=3.0, radius=0.1),
        Light(RECTANGLE, scale, scale, scale, position_z=4.0, direction_z=-1.0, axis_u_x=1.0, axis_v_y=1.0),
        Light(SUN, scale, scale, scale, direction_z=1.0, angle=0.1),
    ]
    scene = new_scene([GREY], lights=lights, accel=accel)
    add_object(scene, make_sphere(16))
    return scene


def glow(radiance: float, **fields: float) -> Material:
    return Material(
        0, 0, 0, specular=0, emission_r=radiance, emission_g=radiance, emission_b=radiance, **fields
    )


def lit_by_surface(accel: str, scale: float) -> object:
    scene = new_scene([GREY, glow(scale)], accel=accel)
    add_object(scene, make_sphere(16))
    add_object(scene, make_floor(1.0, 4.0), 1)
    return scene


def scaled_light(lit: Lit, scale: float) -> Row:
    """B10: the picture under light `scale` times as bright is that of light 1, as often as bright."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        one, other = (
            picture(lit(accel, s), film(count, 2, seed), Camera(half_width=1.2))[..., :3].astype(np.float64)
            for s in (1.0, scale)
        )
        factor = float(np.float32(scale))
        return within(float(np.abs(other / factor - one).max() / one.max()), 1e-5)

    return row


def small_area(size: float) -> Row:
    """B11: a square light of edge `size` 10 above a floor."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        power = 100.0 / size**2
        light = Light(RECTANGLE, power, power, power, position_z=10.0, direction_z=-1.0,
                      axis_u_x=size / 2, axis_v_y=size / 2)  # fmt: skip
        return below(accel, count, seed, [light], [])

    return row


def small_triangle(length: float, width: float) -> Row:
    """B11: a glowing triangle 10 above a floor."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        power = 100.0 / (0.5 * length * width)
        corners = np.array([[-length / 2, 0, 10], [0, width, 10], [length / 2, 0, 10]])
        return below(accel, count, seed, [], [(corners, glow(power))])

    return row


def small_sun(solid_angle: float) -> Row:
    """B11: a sun of so many steradians."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        sun = Light(SUN, 1, 1, 1, direction_z=1.0, angle=float(np.sqrt(solid_angle / np.pi)))
        return below(accel, count, seed, [sun], [])

    return row


def below(
    accel: str, count: int, seed: int, lights: list[Light], glowing: list[tuple[Float64, Material]]
) -> Outcome:
    """A grey floor where the irradiance straight below is 1."""
    scene = new_scene([GREY, *(material for _, material in glowing)], lights=lights, accel=accel)
    add_object(scene, make_floor(1.0))
    for number, (corners, _) in enumerate(glowing):
        add_mesh(scene, mesh_of(corners, np.array([[0, 1, 2]])), 1 + number)
    pixels = picture(scene, film(count, 0, seed), Camera(eye=(0, 0, 1), half_width=1e-3))
    return mean_is(0.5 / np.pi, pixels, 5e-3)


def sun_in_sky(accel: str, count: int, seed: int = 0) -> Outcome:
    """B12: a sky of ones with a texel of a million, on a floor: the mean, and the spread of pixels."""
    height = 2048 if count >= 100_000 else 256
    pixels = np.ones((height, 2 * height, 3), np.float32)
    row, column = int(0.78 * height), int(0.6 * height)
    pixels[row, column] = 1e6
    scene = new_scene([WHITE], accel=accel)
    scene.set_environment(pixels, np.eye(3))
    add_object(scene, make_floor(0.01))
    settings = Settings(8, 8, max(64, count // 64), 1 + seed, 0, 0)
    values = picture(scene, settings, Camera(eye=(0, 0, 1), half_width=1e-3))[..., 0].astype(np.float64)
    expected = 1.0 + (1e6 - 1) * texel_irradiance(height, row) / np.pi
    noise = 4 * values.std() / np.sqrt(values.size)
    off, spread = abs(values.mean() / expected - 1), values.std() / expected
    # Radiance over density varies by half within the texels of the sun: 0.5 / sqrt(samples), at most.
    failed = off > 1e-3 + noise / expected or spread > 0.75 / np.sqrt(max(64, count // 64))
    return Outcome(int(failed), 1, f"mean off {100 * off:.3f} %, spread {100 * spread:.2f} %")


def texel_irradiance(height: int, row: int) -> float:
    """Of a texel of radiance 1 in a picture of twice that width, bilinear between the centres of texels."""
    steps = 400
    v = (row + 0.5 + (np.arange(2 * steps) + 0.5) / steps - 1.0) / height
    latitude, tent = np.pi * (v - 0.5), 1 - np.abs((np.arange(2 * steps) + 0.5) / steps - 1.0)
    ring = np.maximum(np.sin(latitude), 0) * np.cos(latitude) * tent
    return float(ring.sum() * np.pi / height / steps * np.pi / height)


def bent_floor(normal: tuple[float, float, float], of_corners: bool) -> Row:
    """B13: a white floor in a white world whose shading normal is `normal`, of corners or of a texture."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        number = -1 if of_corners else 0
        material = Material(1.0, 1.0, 1.0, roughness=0.3, metallic=0.5, normal_texture=number)
        scene = new_scene([], world=1.0, accel=accel)
        if not of_corners:
            set_constant_texture(scene, normal)
        scene.set_materials(pack_table([material], MATERIAL_FIELDS))
        vertices, triangles = make_floor(2.0)
        normals = np.tile(np.float32(normal), (2, 3, 1)) if of_corners else None
        try:
            mesh = scene.add_mesh(vertices, triangles, normals, np.zeros((2, 3, 2), np.float32), None)
        except ValueError as refusal:
            return Outcome(0, 1, f"refused: {str(refusal)[:40]}")
        scene.add_instance(mesh, None, np.zeros(1, np.int32))
        values = picture(scene, film(count, 4, seed), Camera(half_width=1.0))[..., 0].astype(np.float64)
        noise = 4 * values.std() / np.sqrt(values.size)
        fine = np.isfinite(values).all() and values.mean() <= 1 + 1e-3 + noise
        return Outcome(int(not fine), 1, f"mean {values.mean():.4f}")

    return row


def set_constant_texture(scene: Any, value: tuple[float, float, float]) -> None:
    """Texture 0 is a program that works out `value`: kernels apply normal textures with programs only."""
    builder, pool = ProgramBuilder(), ProgramPool()
    u = builder.emit("attribute")
    times, plus = (MATH_OPERATIONS.index(name) for name in ("MULTIPLY", "ADD"))
    nothing = builder.emit("vector_math", u, Value((0.0, 0.0, 0.0)), mode=times)
    result = builder.emit("vector_math", nothing, Value(value), mode=plus)
    program = pool.add(builder.steps, result)
    arrays = pool.arrays()
    scene.set_programs(arrays.ops, arrays.constants, arrays.programs)
    scene.set_textures(pack_table([Texture(-1, program=program)], TEXTURE_FIELDS))


def far_texels(offset: float) -> Row:
    """B14: texel met by rays on a floor whose (u, v) begin at `offset`; exact arithmetic says which."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        if accel == EMBREE:
            raise NotApplicable("images are those of the native core")
        texels = 8
        found: list[Float32] = []
        for start in (0.0, offset):
            scene = new_scene([], accel=accel)
            scene.add_image(np.tile(np.arange(texels, dtype=np.float32)[None, :, None], (2, 1, 3)), False)
            closest = FILTERS.index("closest")
            scene.set_textures(pack_table([Texture(0, filter=closest)], TEXTURE_FIELDS))
            scene.set_materials(pack_table([glow(1, emission_texture=0)], MATERIAL_FIELDS))
            vertices, triangles = make_floor(1.0)
            corners = (vertices[triangles][..., :2].astype(np.float64) + 1) / 2 + start
            mesh = scene.add_mesh(vertices, triangles, None, corners.astype(np.float32), None)
            scene.add_instance(mesh, None, np.zeros(1, np.int32))
            side = max(8, int(np.sqrt(count)))
            found.append(
                picture(scene, Settings(side, side, 1, 1 + seed, 0, 0), Camera(half_width=0.99))[..., 0]
            )
        steps = np.abs(np.round(found[1] - found[0]))
        steps = np.minimum(steps, texels - steps)
        return Outcome(
            int((steps > 1).sum()), steps.size, f"at most {steps.max():.0f} of {texels} texels off"
        )

    return row


def closed_box(albedo: float, bounces: int) -> Row:
    """B15: a closed glowing box seen from within: the sum of the geometric series, as far as bounces go."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        wall = Material(albedo, albedo, albedo, specular=0.0, emission_r=1, emission_g=1, emission_b=1)
        scene = new_scene([wall], accel=accel)
        add_mesh(scene, box(1.0, -1.0, 1.0))
        camera = Camera(eye=(0, 0, 0), half_width=0.5, kind=0)
        pixels = picture(scene, Settings(4, 4, max(8, count // 16), 1 + seed, bounces, 0), camera)
        given = float(np.float32(albedo))
        return mean_is((1 - given ** (bounces + 2)) / (1 - given), pixels, 1e-2)

    return row


BENT = {
    "zero": (0.0, 0.0, 0.0),
    "nan": (np.nan, 0.0, 1.0),
    "below": (0.3, 0.0, -1.0),
    "flat": (1.0, 0.0, 0.0),
    "tilted": (2.0, 0.0, 1.0),
}


def cases() -> Iterator[Case]:
    """B08, B10 to B15."""
    yield Case("B08", "ball of index 1 + 1e-7", as_nothing, ONCE, PICTURE, 20_000)
    lights = (("world", lit_by_world), ("lights", lit_by_lights), ("surface", lit_by_surface))
    for scale in (1e-25, 1e-10, 1e10, 1e25):
        for name, lit in lights:
            yield Case("B10", f"{name} of {scale:g}", scaled_light(lit, scale), ONCE, 100_000, 4000)
    for size in (1e-2, 1e-4, 1e-6):
        yield Case("B11", f"square of {size:g}", small_area(size), ONCE, PICTURE, 4000)
    for width in (1e-2, 1e-5):
        yield Case("B11", f"triangle 0.1 x {width:g}", small_triangle(0.1, width), ONCE, PICTURE, 4000)
    for solid_angle in (1e-5, 1e-9):
        yield Case("B11", f"sun of {solid_angle:g} sr", small_sun(solid_angle), ONCE, PICTURE, 4000)
    yield Case("B12", "texel of a million", sun_in_sky, NATIVE, 200_000, 16_000)
    for what, normal in BENT.items():
        yield Case("B13", f"{what} normals", bent_floor(normal, True), NATIVE, PICTURE, 4000)
        if what != "nan":
            yield Case("B13", f"{what} in a normal map", bent_floor(normal, False), NATIVE, PICTURE, 4000)
    for offset in (1e3, 1e5, 1e6):
        yield Case("B14", f"image at {offset:g}", far_texels(offset), NATIVE, PICTURE, 4000)
    yield Case("B15", "albedo 0.99, 4000 bounces", closed_box(0.99, 4000), NATIVE, 200_000, 4000)
    yield Case("B15", "albedo 0.9999, 100000 bounces", closed_box(0.9999, 100_000), NATIVE, 2000, 64)
