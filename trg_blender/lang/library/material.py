"""`material::` - the library of materials, and the methods that edit one.

The paper's Phong rows become microfacet materials: roughness = sqrt(2 / (power + 2)), the width of
the lobe that a Blinn-Phong power gives (Walter et al., "Microfacet Models for Refraction", 2007).
Dielectrics take the diffuse colour as base colour. A metal has no diffuse part: its reflectance at
normal incidence takes the hue of diffuse + specular, scaled down to at most 0.95 where the sum, made
for lights without units, would reflect more than it receives.
"""

from __future__ import annotations

import math
from dataclasses import replace

from ..bind import HOST
from ..runtime import Runtime
from ..scene import MaterialRecord
from ..vector import Vec3
from .material_table import METALS, TEAPOTS, Triple
from .things import Material, Texture, triple

BRIGHTEST_METAL = 0.95


def phong_roughness(power: float) -> float:
    """The roughness whose lobe is as wide as that of a Phong power."""
    return math.sqrt(2.0 / (power + 2.0))


def metal_colour(diffuse: Triple, specular: Triple) -> Triple:
    """The reflectance at normal incidence of a metal given by a Phong row."""
    total = [d + s for d, s in zip(diffuse, specular, strict=True)]
    scale = min(1.0, BRIGHTEST_METAL / max(total))
    return (total[0] * scale, total[1] * scale, total[2] * scale)


def _fresh(rt: Runtime, name: str, **values: object) -> Material:
    key, span = rt.make_key("material")
    return Material(rt, MaterialRecord(key, 1, name, origin=span, **values))  # type: ignore[arg-type]


def _declare_teapot(name: str) -> None:
    ambient, diffuse, specular, power = TEAPOTS[name]
    is_metal = name in METALS
    values = {
        "base_color": metal_colour(diffuse, specular) if is_metal else diffuse,
        "metallic": 1.0 if is_metal else 0.0,
        "roughness": phong_roughness(power),
        "phong_ambient": ambient,
        "phong_diffuse": diffuse,
        "phong_specular": specular,
        "phong_power": power,
    }

    @HOST.function(f"material::{name}", "", f"A fresh {name.replace('_', ' ')}.", "material")
    def _make(rt: Runtime) -> object:
        return _fresh(rt, name, **values)


for _teapot in TEAPOTS:
    _declare_teapot(_teapot)


@HOST.function("material::glass", "index: num 1..4 = 1.5", "Clear glass.", "material")
def _glass(rt: Runtime, index: float) -> object:
    white = (1.0, 1.0, 1.0)
    return _fresh(
        rt, "glass", base_color=white, roughness=0.0, ior=index, transmission=1.0,
        phong_diffuse=(0.0, 0.0, 0.0), phong_specular=white, phong_power=256.0, refract=1.0,
    )  # fmt: skip


@HOST.function("material::mirror", "", "A perfect mirror.", "material")
def _mirror(rt: Runtime) -> object:
    white = (1.0, 1.0, 1.0)
    return _fresh(
        rt, "mirror", base_color=white, metallic=1.0, roughness=0.0,
        phong_diffuse=(0.0, 0.0, 0.0), phong_specular=white, phong_power=256.0, reflect=1.0,
    )  # fmt: skip


@HOST.function(
    "material::emission", "colour: colour, strength: num >= 0 = 1",
    "A surface that shines with radiance colour * strength.", "material",
)  # fmt: skip
def _emission(rt: Runtime, colour: Vec3, strength: float) -> object:
    black = (0.0, 0.0, 0.0)
    return _fresh(
        rt, "emission", base_color=black, phong_diffuse=black,
        emission_color=triple(colour), emission_strength=strength,
    )  # fmt: skip


@HOST.function(
    "material::pbr", "base: colour, metallic: num 0..1 = 0, smoothness: num 0..1 = 0.5",
    "A material by base colour, metallic and smoothness.", "material",
)  # fmt: skip
def _pbr(rt: Runtime, base: Vec3, metallic: float, smoothness: float) -> object:
    return _fresh(
        rt, "pbr", base_color=triple(base), metallic=metallic, roughness=1.0 - smoothness,
        phong_diffuse=triple(base),
    )  # fmt: skip


@HOST.method(Material, "Color", "colour: colour", "Set the base colour.")
def _color(rt: Runtime, mtl: Material, colour: Vec3) -> object:
    return mtl.edit(base_color=triple(colour), phong_diffuse=triple(colour))


@HOST.method(Material, "Metallic", "metallic: num 0..1", "Set how much it is a metal.")
def _metallic(rt: Runtime, mtl: Material, metallic: float) -> object:
    return mtl.edit(metallic=metallic)


@HOST.method(Material, "Smoothness", "smoothness: num 0..1", "Set 1 - roughness.")
def _smoothness(rt: Runtime, mtl: Material, smoothness: float) -> object:
    return mtl.edit(roughness=1.0 - smoothness)


@HOST.method(Material, "Reflect", "k: num 0..1", "Make it a mirror to the share k.")
def _reflect(rt: Runtime, mtl: Material, k: float) -> object:
    if k == 0.0:
        return mtl.edit(reflect=0.0)
    return mtl.edit(reflect=k, metallic=max(k, mtl.draft.metallic), roughness=0.0)


@HOST.method(Material, "Refract", "k: num 0..1, index: num 1..4 = 1.5", "Make it clear to the share k.")
def _refract(rt: Runtime, mtl: Material, k: float, index: float) -> object:
    if k == 0.0:
        return mtl.edit(refract=0.0, transmission=0.0, ior=index)
    return mtl.edit(refract=k, transmission=k, ior=index, roughness=0.0)


@HOST.method(Material, "Emission", "colour: colour, strength: num >= 0 = 1", "Let it shine by itself.")
def _emit(rt: Runtime, mtl: Material, colour: Vec3, strength: float) -> object:
    return mtl.edit(emission_color=triple(colour), emission_strength=strength)


@HOST.method(
    Material, "SetTexture", "texture: texture, slot: num 0..5 = 0",
    "Put an image on: slot 0 or 1 base colour, 2 roughness, 3 metallic, 4 normal, 5 emission.",
)  # fmt: skip
def _set_texture(rt: Runtime, mtl: Material, texture: Texture, slot: float) -> object:
    return mtl.set_texture(texture, int(slot))


@HOST.method(Material, "Name", "name: str", "Name it for Blender.")
def _name_material(rt: Runtime, mtl: Material, name: str) -> object:
    return mtl.edit(name=name)


@HOST.method(Material, "Copy", "", "Another material with the same values.")
def _copy_material(rt: Runtime, mtl: Material) -> object:
    key, span = rt.make_key("material")
    return Material(rt, replace(mtl.draft, key=key, version=1, origin=span))
