"""Surface shader nodes -> one Material row: Principled, simple BSDFs, Emission, Add and Mix."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import bpy

from ..scene_arrays import INTERFACES, Color, Material
from .mixtures import Factor, Part, mix_parts
from .sockets import as_color, as_number, feeding_socket, input_socket
from .textures import TextureTable

BLACK = Material(0.0, 0.0, 0.0, specular=0.0)
UNUSED_WHEN_ZERO = ("Subsurface Weight", "Anisotropic", "Thin Film Thickness", "Thin Wall")
"""Principled inputs that TRG does not render: silent while zero, named in the warning otherwise."""


@dataclass(slots=True)
class ShaderReader:
    """Reads the shader of one material and remembers what it had to leave out."""

    owner: str
    textures: TextureTable
    missed: list[str] = field(default_factory=list)
    attributes: set[int] = field(default_factory=set)
    """numbers of the corner attributes that the textures read"""

    def miss(self, what: str) -> None:
        """Notes once that `what` is not rendered."""
        if what not in self.missed:
            self.missed.append(what)

    def read_surface(self, socket: bpy.types.NodeSocket | None) -> tuple[Material, list[Material]]:
        """The row for the shader plugged into `socket`, black when nothing is, as in Cycles; and the rows
        that it is a mixture of."""
        return mix_parts(self._parts(socket, 1.0, (), 0), self)

    def _parts(
        self, socket: bpy.types.NodeSocket | None, share: float, factors: tuple[Factor, ...], depth: int
    ) -> list[Part]:
        """The shaders behind `socket`, each with its weight."""
        source = feeding_socket(socket) if socket is not None else None
        if source is None or depth > 64:
            return [Part(BLACK, None, share, factors)]
        node = source.node
        if node.type == "ADD_SHADER":
            return [part for one in node.inputs for part in self._parts(one, share, factors, depth + 1)]
        if node.type == "MIX_SHADER":
            value, texture = self.number(node, node.inputs[0].name)
            shares, both = (1.0, 1.0), ((Factor(node.inputs[0], True),), (Factor(node.inputs[0], False),))
            if texture < 0:
                shares, both = (1.0 - _share(value), _share(value)), ((), ())
            return [
                part
                for one, own, by in zip(node.inputs[1:3], shares, both, strict=True)
                if own > 0.0
                for part in self._parts(one, share * own, (*factors, *by), depth + 1)
            ]
        read = _READERS.get(node.type)
        if read is None:
            self.miss(f"node {node.name!r} ({node.bl_label or node.type})")
            return [Part(Material(specular=0.0), node, share, factors)]
        return [Part(read(self, node), node, share, factors)]

    def glow(self, node: bpy.types.Node, color_name: str, strength_name: str) -> tuple[Color, int]:
        """Emission, colour times strength, and the row of the texture that it is multiplied by."""
        color, texture = self.color(node, color_name)
        strength, strength_texture = self.number(node, strength_name)
        if strength_texture < 0:
            red, green, blue = (max(channel * strength, 0.0) for channel in color)
            return (red, green, blue), texture if max(red, green, blue) > 0.0 else -1
        product = self.textures.product(
            (input_socket(node, color_name), input_socket(node, strength_name)), self.owner, self.attributes
        )
        return (1.0, 1.0, 1.0), product

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

    def plain_color(self, node: bpy.types.Node, name: str) -> Color:
        """Colour of an input that no texture drives here, each channel at least 0; white where one does."""
        value, texture = self.color(node, name)
        if texture >= 0:
            self.miss(f"a texture on {name} of node {node.name!r}")
        red, green, blue = (max(channel, 0.0) for channel in value)
        return red, green, blue

    def _value(self, socket: bpy.types.NodeSocket | None) -> tuple[float | Color, int]:
        if socket is None:
            return 0.0, -1
        if feeding_socket(socket) is None:
            return socket.default_value, -1
        constant, texture = self.textures.read(socket, self.owner, self.attributes)
        if constant is None:
            return ((1.0, 1.0, 1.0) if socket.type == "RGBA" else socket.default_value), texture
        return (constant if len(constant) > 2 else constant[0]), -1

    def normal(self, node: bpy.types.Node) -> int:
        """Row of the texture that gives the shading normal; -1 where the node's Normal is not linked."""
        socket = input_socket(node, "Normal")
        if socket is None or feeding_socket(socket) is None:
            return -1
        constant, texture = self.textures.read(socket, self.owner, self.attributes)
        if constant is not None:
            self.miss(f"a constant Normal of node {node.name!r}")
        return texture


def _diffuse(reader: ShaderReader, node: bpy.types.Node) -> Material:
    base, texture = reader.color(node, "Color")
    rough = node.type == "BSDF_DIFFUSE"
    roughness = _share(reader.plain_number(node, "Roughness")) if rough else 0.0
    return Material(
        *base,
        specular=0.0,
        base_texture=texture,
        diffuse_roughness=roughness,
        normal_texture=reader.normal(node),
    )


def _glossy(reader: ShaderReader, node: bpy.types.Node) -> Material:
    """Facets that reflect the colour at every angle."""
    base, texture = reader.color(node, "Color")
    roughness, roughness_texture = reader.number(node, "Roughness")
    if abs(reader.plain_number(node, "Anisotropy")) > 0:
        reader.miss(f"Anisotropy of node {node.name!r} (Glossy BSDF)")
    return Material(
        *base,
        metallic=1.0,
        roughness=_share(roughness),
        base_texture=texture,
        roughness_texture=roughness_texture,
        metal_grazing=0.0,
        multiscatter=_multiscatter(node),
        normal_texture=reader.normal(node),
    )


def _metallic(reader: ShaderReader, node: bpy.types.Node) -> Material:
    """The F82 tint kind; a conductor given by n and k becomes the colour it has at normal incidence."""
    roughness, roughness_texture = reader.number(node, "Roughness")
    _miss_used(reader, node, ("Anisotropy", "Thin Film Thickness"))
    texture = -1
    if node.fresnel_type == "PHYSICAL_CONDUCTOR":
        n, k = (reader.plain_color(node, name) for name in ("IOR", "Extinction"))
        base = tuple(((a - 1) ** 2 + b * b) / ((a + 1) ** 2 + b * b) for a, b in zip(n, k, strict=True))
        tint = (1.0, 1.0, 1.0)
        reader.miss(f"the exact Fresnel curve of node {node.name!r} (Metallic BSDF)")
    else:
        base, texture = reader.color(node, "Base Color")
        tint = reader.plain_color(node, "Edge Tint")
    return Material(
        *base,
        metallic=1.0,
        roughness=_share(roughness),
        base_texture=texture,
        roughness_texture=roughness_texture,
        multiscatter=_multiscatter(node),
        specular_tint_r=tint[0],
        specular_tint_g=tint[1],
        specular_tint_b=tint[2],
        normal_texture=reader.normal(node),
    )


def _glass(reader: ShaderReader, node: bpy.types.Node) -> Material:
    """Glass BSDF tints both ways by its colour, Refraction BSDF has one; the model takes the square."""
    base = reader.plain_color(node, "Color")
    roughness, roughness_texture = reader.number(node, "Roughness")
    _miss_used(reader, node, ("Thin Film Thickness",))
    kind = "refraction_only" if node.type == "BSDF_REFRACTION" else "stained"
    return Material(
        *(channel * channel for channel in base),
        roughness=_share(roughness),
        ior=_safe_ior(reader.plain_number(node, "IOR")),
        transmission=1.0,
        roughness_texture=roughness_texture,
        interface=INTERFACES.index(kind),
        multiscatter=_multiscatter(node),
        normal_texture=reader.normal(node),
    )


def _transparent(reader: ShaderReader, node: bpy.types.Node) -> Material:
    red, green, blue = (_share(channel) for channel in reader.plain_color(node, "Color"))
    return replace(BLACK, alpha=0.0, through_r=red, through_g=green, through_b=blue)


def _sheen(reader: ShaderReader, node: bpy.types.Node) -> Material:
    if node.distribution != "MICROFIBER":
        reader.miss(f"distribution {node.distribution} of node {node.name!r} (Sheen BSDF)")
    color = reader.plain_color(node, "Color")
    roughness = _share(reader.plain_number(node, "Roughness"))
    return replace(
        BLACK,
        sheen_r=color[0],
        sheen_g=color[1],
        sheen_b=color[2],
        sheen_roughness=roughness,
        normal_texture=reader.normal(node),
    )


def _emission(reader: ShaderReader, node: bpy.types.Node) -> Material:
    glow, texture = reader.glow(node, "Color", "Strength")
    return replace(
        BLACK, emission_r=glow[0], emission_g=glow[1], emission_b=glow[2], emission_texture=texture
    )


def _translucent(reader: ShaderReader, node: bpy.types.Node) -> Material:
    return replace(_diffuse(reader, node), translucent=1)


def _principled(reader: ShaderReader, node: bpy.types.Node) -> Material:
    _miss_used(reader, node, UNUSED_WHEN_ZERO)
    base, base_texture = reader.color(node, "Base Color")
    roughness, roughness_texture = reader.number(node, "Roughness")
    metallic, metallic_texture = reader.number(node, "Metallic")
    emission, emission_texture = reader.glow(node, "Emission Color", "Emission Strength")
    alpha, alpha_texture = reader.number(node, "Alpha")
    tint = reader.plain_color(node, "Specular Tint")
    transmission, transmission_texture = reader.number(node, "Transmission Weight")
    return replace(
        _layers(reader, node),
        base_r=base[0],
        base_g=base[1],
        base_b=base[2],
        metallic=_share(metallic),
        roughness=_share(roughness),
        ior=_safe_ior(reader.plain_number(node, "IOR")),
        specular=max(2.0 * reader.plain_number(node, "Specular IOR Level"), 0.0),
        transmission=_share(transmission),
        transmission_texture=transmission_texture,
        emission_r=emission[0],
        emission_g=emission[1],
        emission_b=emission[2],
        base_texture=base_texture,
        roughness_texture=roughness_texture,
        metallic_texture=metallic_texture,
        emission_texture=emission_texture,
        specular_tint_r=tint[0],
        specular_tint_g=tint[1],
        specular_tint_b=tint[2],
        multiscatter=_multiscatter(node),
        alpha=_share(alpha),
        alpha_texture=alpha_texture,
        normal_texture=reader.normal(node),
    )


def _layers(reader: ShaderReader, node: bpy.types.Node) -> Material:
    """Coat, sheen and the roughness of the diffuse base of a Principled BSDF; the rest as by default."""
    coat_tint = reader.plain_color(node, "Coat Tint")
    sheen_tint = reader.plain_color(node, "Sheen Tint")
    sheen, sheen_texture = reader.number(node, "Sheen Weight")
    sheen = 1.0 if sheen_texture >= 0 else max(sheen, 0.0)
    coat, coat_texture = reader.number(node, "Coat Weight")
    fibres, fibres_texture = reader.number(node, "Sheen Roughness")
    diffuse, diffuse_texture = reader.number(node, "Diffuse Roughness")
    normal = node.inputs.get("Coat Normal")
    if normal is not None and normal.is_linked:
        reader.miss(f"Coat Normal of node {node.name!r} (Principled BSDF)")
    return Material(
        diffuse_roughness=_share(diffuse),
        diffuse_roughness_texture=diffuse_texture,
        coat=_share(coat),
        coat_texture=coat_texture,
        coat_roughness=_share(reader.plain_number(node, "Coat Roughness")),
        coat_ior=max(reader.plain_number(node, "Coat IOR"), 1.0),
        coat_tint_r=coat_tint[0],
        coat_tint_g=coat_tint[1],
        coat_tint_b=coat_tint[2],
        sheen_r=sheen * sheen_tint[0],
        sheen_g=sheen * sheen_tint[1],
        sheen_b=sheen * sheen_tint[2],
        sheen_texture=sheen_texture,
        sheen_roughness=_share(fibres),
        sheen_roughness_texture=fibres_texture,
    )


def _multiscatter(node: bpy.types.Node) -> float:
    """1 for the distributions that lose no light between facets."""
    if node.bl_idname == "ShaderNodeBsdfRefraction":
        return 0.0
    return 1.0 if node.distribution == "MULTI_GGX" else 0.0


def _miss_used(reader: ShaderReader, node: bpy.types.Node, names: tuple[str, ...]) -> None:
    """Notes those of the inputs `names` that are linked or not zero."""
    for name in names:
        socket = node.inputs.get(name)
        if socket is not None and (socket.is_linked or float(socket.default_value) != 0.0):
            reader.miss(f"{name} of node {node.name!r} ({node.bl_label})")


def _share(value: float) -> float:
    return min(max(value, 0.0), 1.0)


def _safe_ior(ior: float) -> float:
    return ior if ior >= 1e-3 else 1e-3


def _holdout(_reader: ShaderReader, _node: bpy.types.Node) -> Material:
    return replace(BLACK, holdout=1)


_READERS: dict[str, Callable[[ShaderReader, bpy.types.Node], Material]] = {
    "BSDF_PRINCIPLED": _principled,
    "BSDF_DIFFUSE": _diffuse,
    "BSDF_GLOSSY": _glossy,
    "BSDF_METALLIC": _metallic,
    "BSDF_GLASS": _glass,
    "BSDF_REFRACTION": _glass,
    "BSDF_SHEEN": _sheen,
    "BSDF_TRANSLUCENT": _translucent,
    "BSDF_TRANSPARENT": _transparent,
    "EMISSION": _emission,
    "HOLDOUT": _holdout,
}
