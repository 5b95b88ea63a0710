"""Light records as lights of Blender, and the radiometry between the two.

A TRG colour is the radiance of a white Lambert surface that faces the light, so the irradiance is pi times
it. Blender's `energy` times `color` is

- SUN: irradiance in W/m2, so energy = pi c;
- POINT, SPOT: radiant flux in W of an isotropic source, intensity = energy / (4 pi), so energy = 4 pi^2 c
  for intensity pi c (a spot's flux is that of the whole sphere: its cone only masks);
- AREA: radiant flux in W, radiance = energy / (pi area), so energy = pi area c for radiance c.

`tests/blender/test_to_blender_lights.py` measures each of them in Cycles.
"""

from __future__ import annotations

from math import cos, pi, radians

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ...lang.scene import LightRecord
from .axes import vector_to_blender
from .tags import FALLOFF
from .transforms import frame_of_direction, matrix_of_rows

BLENDER_TYPES = {"dir": "SUN", "point": "POINT", "spot": "SPOT", "area": "AREA"}
PHYSICAL_FALLOFF = (0.0, 0.0, 1.0)
UP_OF_LIGHTS = (0.0, 0.0, 1.0)


def energy_of_sun(color: float) -> float:
    """Blender's strength of a sun of TRG colour `color`."""
    return pi * color


def energy_of_point(color: float) -> float:
    """Watts of a point or spot light of TRG colour `color`."""
    return 4.0 * pi * pi * color


def energy_of_area(radiance: float, area: float) -> float:
    """Watts of a one-sided area light of the given radiance and area in square metres."""
    return pi * area * radiance


def new_light(record: LightRecord) -> bpy.types.Light:
    return bpy.data.lights.new(record.name or record.key, BLENDER_TYPES[record.kind])


def write_light(light: bpy.types.Light, record: LightRecord) -> bpy.types.Light:
    """Make the light equal to a checked record. The block may change its type: use what is returned."""
    if light.type != BLENDER_TYPES[record.kind]:
        light.type = BLENDER_TYPES[record.kind]
        light = bpy.data.lights[light.name]
    strongest = max(record.color)
    light.color = [c / strongest for c in record.color] if strongest > 0.0 else (1.0, 1.0, 1.0)
    if record.kind == "dir":
        light.energy, light.angle = energy_of_sun(strongest), 0.0
    elif record.kind == "area":
        width, height = _area_size(record)
        light.shape, light.size, light.size_y = "RECTANGLE", width, height
        light.energy = energy_of_area(strongest, width * height)
    else:
        light.energy, light.shadow_soft_size = energy_of_point(strongest), 0.0
    if record.kind == "spot":
        _write_cone(light, record)
    return light


def write_falloff(owner: bpy.types.Object, record: LightRecord) -> None:
    """Keep the paper's falloff, which Blender has no setting for, as a property of the light's object."""
    if record.kind in ("point", "spot") and tuple(record.falloff) != PHYSICAL_FALLOFF:
        owner[FALLOFF] = tuple(float(c) for c in record.falloff)
    elif FALLOFF in owner:
        del owner[FALLOFF]


def light_matrix(record: LightRecord) -> Matrix:
    """Where the light stands in Blender's world: it shines along its -Z."""
    moved = matrix_of_rows(record.transform)
    position = (moved @ (*record.position, 1.0))[:3]
    matrix = np.eye(4)
    matrix[:3, 3] = vector_to_blender(position.tolist())
    if record.kind != "point":
        direction = moved[:3, :3] @ record.direction
        shines = vector_to_blender((-direction if record.kind == "dir" else direction).tolist())
        matrix[:3, :3] = frame_of_direction(np.array(shines), np.array(UP_OF_LIGHTS))
    return Matrix(matrix.tolist())


def _write_cone(light: bpy.types.SpotLight, record: LightRecord) -> None:
    """Blender's blend is the share of 1 - cos(outer) over which the mask rises."""
    outer = cos(radians(record.angle_out) / 2.0)
    inner = cos(radians(min(record.angle_in, record.angle_out)) / 2.0)
    light.spot_size = radians(record.angle_out)
    light.spot_blend = min(max((inner - outer) / (1.0 - outer), 0.0), 1.0) if outer < 1.0 else 0.0
    light.show_cone = False


def _area_size(record: LightRecord) -> tuple[float, float]:
    """Width and height in metres, after the record's transform (the mean of its three scales)."""
    scale: NDArray[np.float64] = np.linalg.norm(matrix_of_rows(record.transform)[:3, :3], axis=0)
    mean = float(np.cbrt(scale.prod())) if not np.allclose(scale, 1.0) else 1.0
    return record.size[0] * mean, record.size[1] * mean
