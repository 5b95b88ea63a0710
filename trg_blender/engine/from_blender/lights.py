"""Blender lights -> rows of the light table, in the radiometry of docs/architecture.md section 4.

Blender states the power of point, spot and area lights in watts and the irradiance of a sun in
W/m^2; `tests/blender/test_from_blender_lights.py` compares every kind with Cycles.
"""

from __future__ import annotations

import math

import bpy
import numpy as np
from mathutils import Matrix

from ..scene_arrays import LIGHT_KINDS, Color, Light
from .sockets import active_tree, as_color, as_number, feeding_socket

FALLOFF_PROPERTY = "trg_falloff"
"""Custom property of a light object: three numbers, the paper's constant, linear, quadratic falloff."""

SMALLEST_CONE_BLEND = 1e-4


def read_light(owner: bpy.types.Object, matrix: Matrix, warnings: list[str]) -> Light | None:
    """Row of the light object `owner` placed by `matrix`; None when it gives no light."""
    light = owner.data
    color = _color(light, owner.name, warnings)
    if max(color) <= 0:
        return None
    if not light.use_shadow:
        warnings.append(f"light {owner.name!r}: light without shadow is rendered with shadow")
    axes = np.array(matrix.to_3x3(), dtype=np.float64)
    if light.type == "SUN":
        return _sun(light, color, axes)
    if light.type == "AREA":
        return _area(light, color, matrix, owner.name, warnings)
    return _bulb(owner, color, matrix)


def _color(light: bpy.types.Light, name: str, warnings: list[str]) -> Color:
    """Colour times energy, with temperature, exposure and a constant Emission node."""
    scale = light.energy * 2.0 ** getattr(light, "exposure", 0.0)
    tint = [scale * channel for channel in light.color]
    if getattr(light, "use_temperature", False):
        tint = [a * b for a, b in zip(tint, light.temperature_color, strict=True)]
    tree = active_tree(light)
    if tree is not None:
        emission = _emission_of_nodes(tree, name, warnings)
        tint = [a * b for a, b in zip(tint, emission, strict=True)]
    return (tint[0], tint[1], tint[2])


def _emission_of_nodes(tree: bpy.types.ShaderNodeTree, name: str, warnings: list[str]) -> Color:
    output = tree.get_output_node("CYCLES")
    source = feeding_socket(output.inputs["Surface"]) if output is not None else None
    if source is None:
        return (0.0, 0.0, 0.0)
    node = source.node
    if node.type != "EMISSION" or node.inputs["Color"].is_linked or node.inputs["Strength"].is_linked:
        warnings.append(f"light {name!r}: only an Emission node with constant inputs is supported")
    if node.type != "EMISSION":
        return (1.0, 1.0, 1.0)
    strength = as_number(node.inputs["Strength"].default_value)
    red, green, blue = as_color(node.inputs["Color"].default_value)
    return (red * strength, green * strength, blue * strength)


def _unit(vector: np.ndarray) -> list[float]:
    length = float(np.linalg.norm(vector))
    return [float(x) / length for x in vector] if length > 0 else [0.0, 0.0, 1.0]


def _sun(light: bpy.types.SunLight, color: Color, axes: np.ndarray) -> Light:
    """Blender's strength is the irradiance already; `light.angle` is the disc's diameter."""
    towards = _unit(axes[:, 2])
    angle = min(light.angle, math.pi) / 2.0
    if not getattr(light, "normalize", True):
        color = _scaled(color, math.pi * math.sin(angle) ** 2 if angle > 0 else 1.0)
    return Light(
        LIGHT_KINDS.index("sun"),
        *color,
        direction_x=towards[0],
        direction_y=towards[1],
        direction_z=towards[2],
        angle=angle,
    )


def _bulb(owner: bpy.types.Object, color: Color, matrix: Matrix) -> Light:
    """Point or spot: P watts spread over the sphere, P / 4 pi a steradian."""
    light = owner.data
    falloff = _falloff(owner)
    radius = float(light.shadow_soft_size) if falloff == (0.0, 0.0, 1.0) else 0.0
    if not getattr(light, "normalize", True) and radius > 0:
        color = _scaled(color, 4.0 * math.pi * radius * radius * math.pi)
    row = Light(LIGHT_KINDS.index("point"), *_scaled(color, 1.0 / (4.0 * math.pi)))
    row.position_x, row.position_y, row.position_z = (float(x) for x in matrix.translation)
    row.radius = radius
    row.soft = float(bool(light.use_soft_falloff) and radius > 0.0)
    row.falloff_constant, row.falloff_linear, row.falloff_quadratic = falloff
    if light.type == "SPOT":
        row.kind = LIGHT_KINDS.index("spot")
        shines = _unit(-np.array(matrix.to_3x3(), dtype=np.float64)[:, 2])
        row.direction_x, row.direction_y, row.direction_z = shines
        row.cos_outer = math.cos(light.spot_size / 2.0)
        blend = max(light.spot_blend, SMALLEST_CONE_BLEND)
        row.cos_inner = row.cos_outer + (1.0 - row.cos_outer) * blend
    return row


def _falloff(owner: bpy.types.Object) -> tuple[float, float, float]:
    stored = owner.get(FALLOFF_PROPERTY)
    if stored is None or isinstance(stored, (int, float, str)) or len(stored) != 3:
        return (0.0, 0.0, 1.0)
    return (float(stored[0]), float(stored[1]), float(stored[2]))


def _area(
    light: bpy.types.AreaLight, color: Color, matrix: Matrix, name: str, warnings: list[str]
) -> Light | None:
    """P watts from a one-sided Lambert emitter: radiance P / (pi area)."""
    axes = np.array(matrix.to_3x3(), dtype=np.float64)
    size_v = light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size
    half_u, half_v = axes[:, 0] * light.size / 2.0, axes[:, 1] * size_v / 2.0
    round_shape = light.shape in ("DISK", "ELLIPSE")
    shines = _unit(-axes[:, 2])
    size = float(np.linalg.norm(np.cross(half_u, half_v))) * (math.pi if round_shape else 4.0)
    if size <= 0:
        warnings.append(f"light {name!r}: an area light without area gives no light")
        return None
    watts = color if getattr(light, "normalize", True) else _scaled(color, size)
    row = Light(
        LIGHT_KINDS.index("area_ellipse" if round_shape else "area_rectangle"),
        *_scaled(watts, 1.0 / (math.pi * size)),
        direction_x=shines[0],
        direction_y=shines[1],
        direction_z=shines[2],
        spread=min(max(float(light.spread), 0.0), math.pi),
    )
    row.position_x, row.position_y, row.position_z = (float(x) for x in matrix.translation)
    row.axis_u_x, row.axis_u_y, row.axis_u_z = (float(x) for x in half_u)
    row.axis_v_x, row.axis_v_y, row.axis_v_z = (float(x) for x in half_v)
    return row


def _scaled(color: Color, factor: float) -> Color:
    return (color[0] * factor, color[1] * factor, color[2] * factor)
