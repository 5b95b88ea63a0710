"""A Sky Texture node of a world -> an environment and a sun (engine/sky_picture.py)."""

from __future__ import annotations

import math

import bpy
import numpy as np

from ..scene_arrays import LIGHT_KINDS, Float32, Float64, Light
from ..sky_picture import SkyDescription, make_picture, sun_irradiance_of

HARDEST_SUN = 1e-3
"""Radians, the least angular radius of a disc: one that Blender makes smaller is drawn as large, as bright
in all."""


def read_sky(node: bpy.types.Node, where: str, warnings: list[str]) -> tuple[Float32, Float64, Light | None]:
    """Radiances, the rotation (3, 3) from the node's directions to them, and the sun if the disc shows."""
    clear = node.sky_type in ("PREETHAM", "HOSEK_WILKIE")
    sky = _describe_clear(node) if clear else _describe(node)
    if clear:
        warnings.append(f"{where}: sky {node.sky_type} is rendered as one of single scattering")
    turn = _azimuth(node) if clear else node.sun_rotation
    rotation = np.array(
        [[math.cos(turn), -math.sin(turn), 0.0], [math.sin(turn), math.cos(turn), 0.0], [0.0, 0.0, 1.0]]
    )
    sun = None if clear or not node.sun_disc else _sun(node, sky)
    return make_picture(sky), rotation, sun


def _describe(node: bpy.types.Node) -> SkyDescription:
    """A node of Blender's own atmosphere; before 5.0 its aerosol was called dust."""
    dust = node.aerosol_density if hasattr(node, "aerosol_density") else node.dust_density
    return SkyDescription(
        _held(node.sun_elevation),
        node.air_density,
        dust,
        node.ozone_density,
        node.altitude,
        node.sky_type == "MULTIPLE_SCATTERING",
    )


def _describe_clear(node: bpy.types.Node) -> SkyDescription:
    """The nearest of a node that gives turbidity: 1 is air alone."""
    up = node.sun_direction.normalized().z if node.sun_direction.length > 0.0 else 1.0
    return SkyDescription(math.asin(up), dust=max(node.turbidity - 1.0, 0.0))


def _azimuth(node: bpy.types.Node) -> float:
    return math.atan2(node.sun_direction.x, node.sun_direction.y)


def _held(elevation: float) -> float:
    """An angle of a full turn as an elevation; past the zenith it sinks again."""
    return math.asin(math.sin(elevation))


def _sun(node: bpy.types.Node, sky: SkyDescription) -> Light | None:
    """The disc, towards +y of the node's directions; `place_sun` turns it into the world."""
    angle = max(0.5 * node.sun_size, HARDEST_SUN)
    red, green, blue = (node.sun_intensity * c for c in sun_irradiance_of(sky, angle))
    if not max(red, green, blue) > 0.0:
        return None
    return Light(
        LIGHT_KINDS.index("sun"),
        red,
        green,
        blue,
        direction_x=0.0,
        direction_y=math.cos(sky.elevation),
        direction_z=math.sin(sky.elevation),
        angle=min(angle, 0.5 * math.pi),
        seen=1.0,
    )


def place_sun(sun: Light, rotation: Float64, strength: float) -> Light:
    """The sun in the world, of which `rotation` (3, 3) leads into the picture."""
    towards = rotation.T @ np.array([sun.direction_x, sun.direction_y, sun.direction_z])
    sun.direction_x, sun.direction_y, sun.direction_z = (float(x) for x in towards)
    sun.color_r, sun.color_g, sun.color_b = (c * strength for c in (sun.color_r, sun.color_g, sun.color_b))
    return sun
