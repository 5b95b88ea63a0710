"""Surface shader nodes -> one Material row: Principled, simple BSDFs, Emission, Add and Mix."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import bpy

from ..scene_arrays import Color, Material
from .sockets import as_color, as_number, constant_of, feeding_socket, input_socket
from .textures import TextureTable

BLACK = Material(0.0, 0.0, 0.0, specular=0.0)
UNUSED_WHEN_ZERO = (
    "Subsurface Weight", "Anisotropic", "Coat Weight", "Sheen Weight", "Thin Film Thickness",
    "Diffuse Roughness", "Thin Wall",
)  # fmt: skip
"""Principled inputs that TRG does not render: silent while zero, named in the warning otherwise."""


@dataclass(slots=True)
class ShaderReader:
    """Reads the shader of one material and remembers what it had to leave out."""

    owner: str
    textures: TextureTable
    missed: list[str] = field(default_factory=list)
    uv_maps: list[str] = field(default_factory=list)

    def miss(self, what: str) -> None:
        """Notes once that `what` is not rendered."""
        if what not in self.missed:
            self.missed.append(what)

    def read_surface(self, socket: bpy.types.NodeSocket | None, depth: int = 0) -> Material:
        """The row for the shader plugged into `socket`; black when nothing is, as in Cycles."""
        source = feeding_socket(socket) if socket is not None else None
        if source is None or depth > 64:
            return BLACK
        node = source.node
        if node.type == "MIX_SHADER":
            return self._mix(node, depth)
        if node.type == "ADD_SHADER":
            return self._add(node, depth)
        read = _READERS.get(node.type)
        if read is None:
            self.miss(f"node {node.name!r} ({node.bl_label or node.type})")
            return Material(specular=0.0)
        return read(self, node)

    def color(self, node: bpy.types.Node, *names: str) -> tuple[Color, int]:
        """Colour of an input and the row of the texture that replaces it (-1: none)."""
        value, texture = self._value(input_socket(node, *names))
        return as_color(value), texture

    def number(self, node: bpy.types.Node, *names: str) -> tuple[float, int]:
        """Number of an input and the row of the texture that replaces it (-1: none)."""
        value, texture = self._value(input_socket(node, *names))
        return as_number(value), texture

    def plain_number(self, node: bpy.types.Node, name: str) -> float:
        """Number of an input that no texture can drive here."""
        value, texture = self.number(node, name)
        if texture >= 0:
            self.miss(f"a texture on {name} of node {node.name!r}")
        return value

    def _value(self, socket: bpy.types.NodeSocket | None) -> tuple[float | Color, int]:
        if socket is None:
            return 0.0, -1
        source = feeding_socket(socket)
        if source is None:
            return socket.default_value, -1
        constant = constant_of(source)
        if constant is not None:
            return constant, -1
        if source.node.type == "TEX_IMAGE" and source.name == "Color":
            row, uv_map = self.textures.add(source.node, self.owner)
            self.uv_maps.append(uv_map)
            return (1.0, 1.0, 1.0), row
        self.miss(f"node {source.node.name!r} ({source.node.bl_label}) on {socket.name}")
        return socket.default_value, -1

    def _add(self, node: bpy.types.Node, depth: int) -> Material:
        """Emission adds exactly; of two scattering shaders the first is kept."""
        first, second = (self.read_surface(socket, depth + 1) for socket in node.inputs)
        if not _scatters(first):
            first, second = second, first
        if _scatters(second) or (first.emission_texture >= 0 and second.emission_texture >= 0):
            self.miss(f"the second shader of node {node.name!r} (Add Shader)")
            return first
        return replace(
            first,
            emission_r=first.emission_r + second.emission_r,
            emission_g=first.emission_g + second.emission_g,
            emission_b=first.emission_b + second.emission_b,
            emission_texture=max(first.emission_texture, second.emission_texture),
        )

    def _mix(self, node: bpy.types.Node, depth: int) -> Material:
        """The weightier shader of a Mix Shader; exact at factors 0 and 1."""
        factor = self.plain_number(node, node.inputs[0].name)
        if 0.0 < factor < 1.0:
            self.miss(f"the lighter shader of node {node.name!r} (Mix Shader)")
        return self.read_surface(node.inputs[1 if factor < 0.5 else 2], depth + 1)


def _scatters(row: Material) -> bool:
    has_base = row.base_texture >= 0 or row.base_r > 0 or row.base_g > 0 or row.base_b > 0
    return has_base or row.specular > 0


def _diffuse(reader: ShaderReader, node: bpy.types.Node) -> Material:
    base, texture = reader.color(node, "Color")
    if reader.plain_number(node, "Roughness") > 0:
        reader.miss(f"Roughness of node {node.name!r} (Diffuse BSDF)")
    return Material(*base, specular=0.0, base_texture=texture)


def _glossy(reader: ShaderReader, node: bpy.types.Node) -> Material:
    base, texture = reader.color(node, "Color", "Base Color")
    roughness, roughness_texture = reader.number(node, "Roughness")
    return Material(
        *base, metallic=1.0, roughness=roughness, base_texture=texture, roughness_texture=roughness_texture
    )


def _glass(reader: ShaderReader, node: bpy.types.Node) -> Material:
    """Glass BSDF tints each interface by its colour; the model by the root of the base colour."""
    base, texture = reader.color(node, "Color")
    if texture >= 0:
        reader.miss(f"a texture on Color of node {node.name!r}")
    tint = [channel * channel for channel in base]
    roughness, roughness_texture = reader.number(node, "Roughness")
    return Material(
        *tint,
        roughness=roughness,
        ior=_safe_ior(reader.plain_number(node, "IOR")),
        transmission=1.0,
        roughness_texture=roughness_texture,
    )


def _transparent(reader: ShaderReader, node: bpy.types.Node) -> Material:
    """An interface of index 1 bends and reflects nothing."""
    base, _ = reader.color(node, "Color")
    return Material(*(channel * channel for channel in base), roughness=0.0, ior=1.0, transmission=1.0)


def _emission(reader: ShaderReader, node: bpy.types.Node) -> Material:
    color, texture = reader.color(node, "Color")
    strength = reader.plain_number(node, "Strength")
    glow = [channel * strength for channel in color]
    return replace(
        BLACK, emission_r=glow[0], emission_g=glow[1], emission_b=glow[2], emission_texture=texture
    )


def _principled(reader: ShaderReader, node: bpy.types.Node) -> Material:
    for name in UNUSED_WHEN_ZERO:
        socket = node.inputs.get(name)
        if socket is not None and (socket.is_linked or float(socket.default_value) > 0):
            reader.miss(f"{name} of node {node.name!r} (Principled BSDF)")
    _check_principled(reader, node)
    base, base_texture = reader.color(node, "Base Color")
    roughness, roughness_texture = reader.number(node, "Roughness")
    metallic, metallic_texture = reader.number(node, "Metallic")
    transmission = reader.plain_number(node, "Transmission Weight")
    level = reader.plain_number(node, "Specular IOR Level")
    ior, specular = _dielectric(_safe_ior(reader.plain_number(node, "IOR")), level, transmission)
    emission, emission_texture = reader.color(node, "Emission Color")
    strength = reader.plain_number(node, "Emission Strength")
    return Material(
        *base,
        metallic=min(max(metallic, 0.0), 1.0),
        roughness=min(max(roughness, 0.0), 1.0),
        ior=ior,
        specular=specular,
        transmission=min(max(transmission, 0.0), 1.0),
        emission_r=emission[0] * strength,
        emission_g=emission[1] * strength,
        emission_b=emission[2] * strength,
        base_texture=base_texture,
        roughness_texture=roughness_texture,
        metallic_texture=metallic_texture,
        emission_texture=emission_texture if strength > 0 else -1,
    )


def _check_principled(reader: ShaderReader, node: bpy.types.Node) -> None:
    """Inputs whose neutral value is not zero."""
    name = f"of node {node.name!r} (Principled BSDF)"
    alpha = node.inputs["Alpha"]
    if alpha.is_linked or alpha.default_value < 1:
        reader.miss(f"Alpha {name}")
    if node.inputs["Normal"].is_linked:
        reader.miss(f"Normal {name}")
    tint = input_socket(node, "Specular Tint")
    if tint is not None and (tint.is_linked or min(tint.default_value[:3]) < 1):
        reader.miss(f"Specular Tint {name}")


def _dielectric(ior: float, level: float, transmission: float) -> tuple[float, float]:
    """(ior, specular): level 0.5 leaves the IOR's reflection, below it scales down.

    Above 0.5 a scaled Fresnel term would pass one, so that the IOR with the doubled reflection at
    normal incidence takes its place (as Cycles does), unless the IOR also bends transmitted light.
    """
    if level <= 0.5 or transmission > 0:
        return ior, min(max(2.0 * level, 0.0), 1.0)
    f0 = min(((ior - 1) / (ior + 1)) ** 2 * 2.0 * level, 0.9801)
    return (1 + math.sqrt(f0)) / (1 - math.sqrt(f0)), 1.0


def _safe_ior(ior: float) -> float:
    return ior if ior >= 1e-3 else 1e-3


_READERS: dict[str, Callable[[ShaderReader, bpy.types.Node], Material]] = {
    "BSDF_PRINCIPLED": _principled,
    "BSDF_DIFFUSE": _diffuse,
    "BSDF_GLOSSY": _glossy,
    "BSDF_METALLIC": _glossy,
    "BSDF_GLASS": _glass,
    "BSDF_TRANSPARENT": _transparent,
    "EMISSION": _emission,
}
