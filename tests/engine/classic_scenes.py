"""Small scenes for the classic integrator."""

from __future__ import annotations

import numpy as np

from trg_blender.engine.classic_arrays import ClassicMaterial, classic_row
from trg_blender.engine.scene_arrays import Material, MeshArrays, RenderSettings, SceneArrays

from .arrays import ball, box, light, look_at, place, quad

SETTINGS = RenderSettings(8, 8, samples=1, integrator="classic", aa="none")
BLACK = (0.0, 0.0, 0.0)


def studio() -> SceneArrays:
    """A mirror ball and a tinted box on a floor, under every kind of light."""
    lamps = [
        light("sun", (2, 2, 2), direction=(0.5, -0.3, 1)),
        light("point", (3, 2, 1), (1.5, -1, 2), falloff=(1, 0.1, 0.1)),
        light("point", (3, 4, 3), (-1.5, -1.5, 2), radius=0.2),
        light(
            "area_rectangle",
            (9, 8, 7),
            (1.5, -1.0, 3.0),
            direction=(-0.4, 0.3, -1.0),
            axis_u=(0.6, 0, -0.24),
            axis_v=(0, 0.5, 0.15),
            spread=2.0,
        ),
        light("spot", (6, 6, 6), (-1, -1, 2), direction=(0.3, 0.3, -1), cos_outer=0.8, cos_inner=0.9),
    ]
    scene = SceneArrays(
        look_at((2.6, -2.4, 1.8), (0, 0, 0.3), 0.42),
        [quad(3.0), ball(0.6, 10), box(0.35)],
        [place(0, 0), place(1, 1, (-0.3, 0.3, 0.62)), place(2, 2, (0.8, -0.5, 0.37))],
        [
            Material(0.7, 0.6, 0.5, specular=0.0),
            Material(0.9, 0.9, 0.95, metallic=1.0, roughness=0.0),
            Material(emission_r=0.05),
        ],
        lights=lamps,
        world=(0.1, 0.15, 0.2),
        ambient=(0.1, 0.2, 0.1),
    )
    tinted = classic_row(
        ambient=(0.2, 0.1, 0.3),
        diffuse=(0.1, 0.1, 0.1),
        specular=(0.5, 0.5, 0.5),
        power=20.0,
        refract=(0.9, 0.3, 0.2),
        reflect=(0.1, 0.1, 0.1),
        ior=1.3,
        decay=0.5,
    )
    scene.classic = [None, None, tinted]
    return scene


def layers(rows: list[ClassicMaterial], emission: float = 0.0, eye=(0.0, 0.0, 8.0)) -> SceneArrays:
    """Wide sheets facing up at z = 0, 1, 2 .. of these materials, the lowest of radiance `emission`."""
    materials = [Material(emission_r=emission, emission_g=emission, emission_b=emission)]
    materials += [Material() for _ in rows[1:]]
    return SceneArrays(
        look_at(eye, (0, 0, 0), 1e-6),
        [quad(50.0)],
        [place(0, index, (0, 0, index)) for index in range(len(rows))],
        materials,
        classic=list(rows),
    )


def stripes(lean: float = 0.3, count: int = 12) -> SceneArrays:
    """Glowing slanted bars before black: nothing but edges."""
    vertices, triangles = [], []
    for index in range(count):
        x = -3.0 + 6.0 * index / count
        base = len(vertices)
        vertices += [[x, -4, 0], [x + 0.22, -4, 0], [x + 0.22 + lean, 4, 0], [x + lean, 4, 0]]
        triangles += [[base, base + 1, base + 2], [base, base + 2, base + 3]]
    bars = MeshArrays(np.array(vertices, np.float32), np.array(triangles, np.int32))
    glow = Material(0, 0, 0, specular=0.0, emission_r=1.0, emission_g=0.8, emission_b=0.6)
    return SceneArrays(look_at((0.2, -2.0, 4.0), (0, 0, 0), 0.5), [bars], [place(0)], [glow])
