"""The paper's row of constants of a material, where a program has given one."""

from __future__ import annotations

import math

import bpy

from ..classic_arrays import ClassicMaterial, classic_row
from ..scene_arrays import Color, Material

NAMES = ("ambient", "diffuse", "specular")


def read_classic(material: bpy.types.Material | None, row: Material) -> ClassicMaterial | None:
    """The row that `to_blender/materials.py` left on `material`; None where no program made it.

    What passes one surface is tinted by the root of the base colour in `row`: a body has two.
    """
    if material is None or "trg_phong_diffuse" not in material:
        return None
    colors = {name: color_of(material, f"trg_phong_{name}") for name in NAMES}
    reflect, refract = (share_of(material, f"trg_{name}") for name in ("reflect", "refract"))
    base = (row.base_r, row.base_g, row.base_b)
    through: Color = tuple(refract * math.sqrt(min(max(channel, 0.0), 1.0)) for channel in base)  # type: ignore[assignment]
    return classic_row(
        **colors,
        power=max(float(material.get("trg_phong_power", 32.0)), 0.0),
        reflect=(reflect, reflect, reflect),
        refract=through,
        ior=max(row.ior, 1e-3),
        decay=(row.absorption_r + row.absorption_g + row.absorption_b) / 3.0,
        texture_share=1.0,
    )


def color_of(material: bpy.types.Material, name: str) -> Color:
    red, green, blue = (max(float(channel), 0.0) for channel in material[name])
    return (red, green, blue)


def share_of(material: bpy.types.Material, name: str) -> float:
    return min(max(float(material.get(name, 0.0)), 0.0), 1.0)


def read_ambient(world: bpy.types.World | None) -> Color:
    """The program's ambient light; black without one."""
    if world is None or "trg_ambient" not in world:
        return (0.0, 0.0, 0.0)
    red, green, blue = (float(channel) for channel in world["trg_ambient"])
    return (red, green, blue)
