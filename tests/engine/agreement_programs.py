"""Scenes whose materials ask texture programs, for the agreement of native and reference."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from trg_blender.engine.program_builder import ProgramBuilder, ProgramPool, Value
from trg_blender.engine.scene_arrays import Material, MeshArrays, SceneArrays, Texture
from trg_blender.engine.texture_ops import (
    INFOS,
    MATH_OPERATIONS,
    NOISE_COLORED,
    NOISE_KIND_SHIFT,
    NOISE_NORMALIZE,
    NOISES,
    NORMALS,
)

from .arrays import checker, place

NOISE_3D = 2 | NOISES.index("FBM") << NOISE_KIND_SHIFT | NOISE_NORMALIZE
SECOND_UV, TANGENT = 1, 2
"""corner attributes of these scenes"""


def constant(*numbers: float) -> Value:
    return Value(tuple(float(x) for x in numbers))


def noise(builder: ProgramBuilder, at: Value, scale: float, colored: bool = False) -> Value:
    numbers = (0.0, scale, 2.0, 0.5, 2.0, 0.0, 1.0, 0.0)
    mode = NOISE_3D | (NOISE_COLORED if colored else 0)
    return builder.emit("noise", at, *(constant(x) for x in numbers), mode=mode)


def bump(builder: ProgramBuilder, place_op: str, scale: float, distance: float) -> Value:
    heights = [noise(builder, builder.emit(place_op), scale).part(0)]
    for side in (1, 2):
        builder.emit("shift", constant(1.0), mode=side)
        builder.place = side
        heights.append(noise(builder, builder.emit(place_op), scale).part(0))
    builder.emit("shift", constant(1.0), mode=0)
    builder.place = 0
    normal = builder.emit("normal", mode=NORMALS.index("shading"))
    return builder.emit("bump", *heights, constant(0.8), constant(distance), normal, constant(1.0))


def normal_map(builder: ProgramBuilder, mode: int) -> Value:
    """Tangent space (0), object's (1) or the world's (2), with a bent colour that varies."""
    wave = noise(builder, builder.emit("attribute"), 6.0, colored=True)
    base = (0.5, 0.5, 0.9) if mode == 0 else (0.6, 0.3, 0.9)
    color = builder.emit("blend", constant(0.25), constant(*base), wave)
    tangent = builder.emit("attribute", mode=TANGENT)
    return builder.emit("normal_map", color, constant(0.9), tangent, mode=mode)


def with_attributes(mesh: MeshArrays) -> MeshArrays:
    """A second UV map, and tangents that follow the first."""
    corners = mesh.vertices[mesh.triangles]
    turned = corners[..., :2] @ np.array([[0.6, -0.8], [0.8, 0.6]], np.float32) * 2.0
    along = corners[:, 1] - corners[:, 0]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    tangent = np.concatenate([np.repeat(along[:, None], 3, axis=1), np.ones((*corners.shape[:2], 1))], axis=2)
    attributes = {SECOND_UV: turned.astype(np.float32), TANGENT: tangent.astype(np.float32)}
    space = ((0.9, 0.8, 0.7), (0.1, 0.2, 0.3))
    return replace(mesh, attributes=attributes, texture_space=space)


def programmed(scene: SceneArrays, **programs: tuple[ProgramBuilder, Value]) -> SceneArrays:
    """`scene` whose materials 0 and 1 ask `programs`, by the name of the texture column."""
    scene.meshes = [with_attributes(mesh) for mesh in scene.meshes]
    scene.attributes = ["", "uv:second", "tangent:first"]
    scene.images = [checker()]
    scene.textures = [Texture(0, 2.0, 2.0, uv_map=SECOND_UV)]
    pool, columns = ProgramPool(), {}
    for name, (builder, result) in programs.items():
        columns[f"{name}_texture"] = len(scene.textures)
        scene.textures.append(Texture(-1, program=pool.add(builder.steps, result)))
    scene.programs = pool.arrays()
    scene.materials = [replace(one, **columns) for one in scene.materials]
    squashed = np.array([[-0.8, 0.3, 0.0], [0.0, 1.0, 0.2], [0.0, 0.0, 0.5]])
    scene.instances[1] = place(1, 1, (-0.3, 0.3, 0.4), linear=squashed)
    scene.instances[2].randoms = np.array([0.7], np.float32)
    return scene


def colors(scene: SceneArrays) -> SceneArrays:
    """Colour, roughness, metal and light by noise, images, coordinates, facts and the view."""
    base, rough, metal, glow = (ProgramBuilder() for _ in range(4))
    multiply_add = MATH_OPERATIONS.index("MULTIPLY_ADD")
    # Mirrors would make the rare bright paths of which z-scores know nothing.
    random = rough.emit("info", mode=INFOS.index("random"))
    rough_of_copy = rough.emit("math", random, constant(0.2), constant(0.3), mode=multiply_add)
    second = rough.emit("attribute", mode=SECOND_UV).part(0)
    part = rough.emit("math", second, mode=MATH_OPERATIONS.index("FRACT"))
    behind = metal.emit("layer_weight", constant(0.4), metal.emit("normal"), mode=1)
    box = base.emit("box", base.emit("object"), constant(0.3), mode=0)
    return programmed(
        scene,
        base=(base, base.emit("blend", constant(0.5), box, noise(base, base.emit("generated"), 5.0, True))),
        roughness=(rough, rough.emit("math", part, constant(0.4), rough_of_copy, mode=multiply_add)),
        metallic=(metal, metal.emit("copy", behind, behind, behind)),
        emission=(glow, noise(glow, glow.emit("position"), 3.0, True)),
    )


def reliefs(scene: SceneArrays, kind: str) -> SceneArrays:
    """Bumps by the place in an object or the world, or a map of normals in one of three spaces."""
    builder = ProgramBuilder()
    if kind in ("object", "position"):
        result = bump(builder, kind, 4.0, 0.15)
    else:
        result = normal_map(builder, ("tangent", "local", "world").index(kind))
    return programmed(scene, normal=(builder, result))


def program_scenes(studio: Callable[[Material], SceneArrays]) -> dict[str, SceneArrays]:
    """By name; `studio` sets up material 1 on a ball and a box."""
    made = {
        "programs_colors": colors(studio(Material(emission_r=0.3, emission_g=0.2, emission_b=0.1))),
        "programs_second_uv": programmed(studio(Material(base_texture=0))),
    }
    for kind in ("object", "position", "tangent", "local", "world"):
        made[f"programs_relief_{kind}"] = reliefs(studio(Material(0.7, 0.5, 0.3, roughness=0.4)), kind)
    return made
