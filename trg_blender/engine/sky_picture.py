"""Blender's Sky Texture as an environment and a sun, by a model of our own (sky_atmosphere.py).

Agreement with Cycles: docs/decisions/sky.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .scene_arrays import Color, Float32, Float64
from .sky_atmosphere import (
    GROUND,
    Atmosphere,
    Sky,
    build_glow,
    scattered_light,
    sunlight,
)
from .sky_spectrum import to_rec709

WIDTH, HEIGHT = 128, 192
LOWEST, HIGHEST = 1.0, 59e3
"""m of a camera above the ground"""
HORIZON = 4e-4
"""Radians above it of what fades out below."""
LIMB_SHARE = 0.8
"""Of the middle's radiance, the mean over the disc: its rim is darker."""
REPEATED_TINT, REPEATED_SUN_TINT = np.array([1.02, 1.15, 1.21]), np.array([1.03, 1.07, 1.09])
REPEATED_ANGSTROM = 0.9
"""Fitted to the pictures of Blender's sky of multiple scattering, which has another sun and other dust."""


@dataclass(frozen=True, slots=True)
class SkyDescription:
    """What the node says; angles in radians, densities times a clear day's, altitude in metres."""

    elevation: float
    air: float = 1.0
    dust: float = 1.0
    ozone: float = 1.0
    altitude: float = 0.0
    repeated: bool = False
    """whether light is scattered more than once"""


def make_picture(sky: SkyDescription) -> Float32:
    """(HEIGHT, WIDTH, 3) radiances, as scene_arrays.Environment has them, the sun standing towards +y."""
    described, tint = _prepare(sky)
    radius = GROUND + min(max(sky.altitude, LOWEST), HIGHEST)
    latitude = (np.arange(HEIGHT) + 0.5) / HEIGHT * np.pi - 0.5 * np.pi
    longitude = (0.5 - (np.arange(WIDTH) + 0.5) / WIDTH) * 2.0 * np.pi
    beside, column = np.unique(np.round(np.cos(longitude - 0.5 * np.pi), 9), return_inverse=True)
    rows = latitude if sky.repeated else np.concatenate([[HORIZON], latitude[HEIGHT // 2 :]])
    up, around = np.meshgrid(rows, beside, indexing="ij")
    turn = np.sin(up) * np.sin(sky.elevation) + np.cos(up) * np.cos(sky.elevation) * around
    light = scattered_light(described, radius, np.sin(up).ravel(), np.clip(turn, -1.0, 1.0).ravel())
    colors = np.maximum((light @ to_rec709()) * tint, 0.0).reshape(*up.shape, 3)[:, column]
    if not sky.repeated:
        # No ground: the horizon fades out.
        fade = np.clip(1.0 + 2.5 * np.sin(latitude[: HEIGHT // 2]), 0.0, 1.0) ** 3
        colors = np.concatenate([fade[:, None, None] * colors[:1], colors[1:]])
    return colors.astype(np.float32)


def sun_irradiance_of(sky: SkyDescription, angle: float) -> Color:
    """Of a surface that faces the sun of angular radius `angle`, as far as it stands above the horizon."""
    # Blender's disc shows no ozone.
    described = Atmosphere(sky.air, sky.dust, 0.0)
    tint = REPEATED_SUN_TINT if sky.repeated else np.ones(3)
    radius = GROUND + min(max(sky.altitude, LOWEST), HIGHEST)
    above = _share_above(sky.elevation / max(angle, 1e-6))
    # What is left of a sun at the horizon is seen where it stands out of it.
    middle = max(sky.elevation, 0.5 * (sky.elevation + angle) if above > 0.0 else 0.0, 0.0)
    light = sunlight(described, np.array([radius]), np.array([np.sin(middle)]))
    red, green, blue = (np.maximum(light @ to_rec709(), 0.0)[0] * tint * (LIMB_SHARE * above)).tolist()
    return (red, green, blue)


def _share_above(height: float) -> float:
    """Of a unit disc whose centre stands `height` above a line."""
    held = min(max(height, -1.0), 1.0)
    return 0.5 + (math.asin(held) + held * math.sqrt(1.0 - held * held)) / math.pi


def _prepare(sky: SkyDescription) -> tuple[Sky, Float64]:
    angstrom = REPEATED_ANGSTROM if sky.repeated else 0.0
    atmosphere = Atmosphere(sky.air, sky.dust, sky.ozone, angstrom=angstrom)
    glow = build_glow(atmosphere) if sky.repeated else None
    return Sky(atmosphere, float(np.sin(sky.elevation)), glow), REPEATED_TINT if sky.repeated else np.ones(3)
