"""Materials of the `classic` integrator: the paper's row of constants, given or derived.

A material without a row of its own gets one from its Principled-like columns (`derive_classic`). The
model is docs/decisions/classic.md.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from .scene_arrays import Color, Float32, Material, SceneArrays

MOST_POWER = 2000.0


@dataclass(slots=True)
class ClassicMaterial:
    """One row of the classic table."""

    ambient_r: float = 0.0
    ambient_g: float = 0.0
    ambient_b: float = 0.0
    diffuse_r: float = 0.8
    diffuse_g: float = 0.8
    diffuse_b: float = 0.8
    specular_r: float = 0.0
    specular_g: float = 0.0
    specular_b: float = 0.0
    power: float = 32.0
    """of the cosine between the mirrored view ray and the light"""
    reflect_r: float = 0.0
    reflect_g: float = 0.0
    reflect_b: float = 0.0
    """share of the mirrored ray, 0 to 1"""
    refract_r: float = 0.0
    refract_g: float = 0.0
    refract_b: float = 0.0
    """share of the ray that passes one surface, 0 to 1; tints shadows too"""
    ior: float = 1.0
    """index of the inside"""
    decay: float = 0.0
    """light falls by exp(-decay t) inside"""
    texture_share: float = 1.0
    """a base texture times this takes the place of diffuse"""


CLASSIC_FIELDS = tuple(f.name for f in fields(ClassicMaterial))


def classic_row(**values: Color | float) -> ClassicMaterial:
    """A row from whole colours: `classic_row(diffuse=(1, 0, 0), reflect=(0.5, 0.5, 0.5))`."""
    row = ClassicMaterial()
    for name, value in values.items():
        if isinstance(value, tuple):
            for channel, part in zip("rgb", value, strict=True):
                setattr(row, f"{name}_{channel}", float(part))
        else:
            setattr(row, name, float(value))
    return row


def derive_classic(material: Material) -> ClassicMaterial:
    """The nearest row of constants: what is rough is a Phong lobe, what is smooth a mirrored ray.

    A closed body passes light through two surfaces, so that one takes the root of the base colour.
    """
    base = np.array([material.base_r, material.base_g, material.base_b])
    metal, glass = material.metallic, (1.0 - material.metallic) * material.transmission
    opaque = (1.0 - material.metallic) * (1.0 - material.transmission)
    alpha = material.roughness**2
    sharp = max(0.0, 1.0 - 4.0 * material.roughness)
    index = (material.ior - 1.0) / (material.ior + 1.0)
    gloss = opaque * min(material.specular * index * index, 1.0)
    shine = np.minimum(metal * base + gloss, 1.0)
    through = np.array([material.through_r, material.through_g, material.through_b])
    there = material.alpha
    passes = glass * np.sqrt(np.clip(base, 0.0, 1.0)) * there + (1.0 - there) * through
    return classic_row(
        diffuse=triple(opaque * there * base),
        specular=triple((1.0 - sharp) * there * shine),
        power=min(max(2.0 / max(alpha * alpha, 1e-6) - 2.0, 1.0), MOST_POWER),
        reflect=triple(sharp * there * shine),
        refract=triple(np.clip(passes, 0.0, 1.0)),
        ior=material.ior if there >= 1.0 and glass > 0.0 else 1.0,
        decay=(material.absorption_r + material.absorption_g + material.absorption_b) / 3.0,
        texture_share=opaque * there,
    )


def triple(values: np.ndarray) -> Color:
    return (float(values[0]), float(values[1]), float(values[2]))


def classic_rows(scene: SceneArrays) -> list[ClassicMaterial]:
    """One row a material, given or derived."""
    given = scene.classic
    return [
        row if row is not None else derive_classic(material)
        for material, row in zip(
            scene.materials, [*given, *[None] * (len(scene.materials) - len(given))], strict=True
        )
    ]


def pack_classic(scene: SceneArrays) -> Float32:
    """Float32 table (materials, len(CLASSIC_FIELDS))."""
    rows = classic_rows(scene)
    table = np.zeros((len(rows), len(CLASSIC_FIELDS)), dtype=np.float32)
    for index, row in enumerate(rows):
        table[index] = [getattr(row, name) for name in CLASSIC_FIELDS]
    return table
