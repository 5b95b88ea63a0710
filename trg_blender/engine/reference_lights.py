"""Lights of the reference renderer: sampled from a point, and met by a bounce ray.

Each kind answers two questions with the same measure (density per steradian, seen from the point), so
that next-event estimation and bounce rays can share every light by multiple importance sampling.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .reference_math import build_frame, cone_solid_angle, dot, normalize, sample_cone
from .scene_arrays import LIGHT_KINDS, Float64, Light

INVERSE_SQUARE = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class LightSample:
    """One direction from each of n points towards one light."""

    wi: Float64
    """(n, 3) unit"""
    distance: Float64
    """(n,) to the light, inf for a sun"""
    radiance: Float64
    """(n, 3) radiance over density; for a delta light the irradiance that it gives a facing surface"""
    pdf: Float64
    """(n,) per steradian; inf for a delta"""
    copy: NDArray[np.int64] | None = None
    """(n,) the copy of a mesh that shines; None for lights"""


@dataclass(frozen=True, slots=True)
class LightHit:
    """What bounce rays see of one light."""

    radiance: Float64
    """(n, 3), 0 beside the light or behind the surface that the ray hits"""
    pdf: Float64
    """(n,) with which `sample_light` would have chosen the direction"""
    distance: Float64
    """(n,) anything where it is not seen"""


def sample_light(light: Light, points: Float64, rng: np.random.Generator) -> LightSample:
    """One sample of `light` from each of `points` (n, 3)."""
    kind = LIGHT_KINDS[light.kind]
    if kind == "sun":
        return sample_sun(light, len(points), rng)
    if kind in ("point", "spot"):
        return sample_bulb(light, points, rng)
    return sample_area(light, points, rng)


def hit_light(light: Light, origin: Float64, direction: Float64, t_surface: Float64) -> LightHit | None:
    """`light` along bounce rays that end at `t_surface`; None for a light without extent."""
    kind = LIGHT_KINDS[light.kind]
    if kind == "sun":
        return hit_sun(light, direction, t_surface) if light.angle > 0.0 else None
    if kind in ("point", "spot"):
        return hit_bulb(light, origin, direction, t_surface) if has_sphere(light) else None
    return hit_area(light, origin, direction, t_surface)


def color_of(light: Light) -> Float64:
    return np.array([light.color_r, light.color_g, light.color_b])


def position_of(light: Light) -> Float64:
    return np.array([light.position_x, light.position_y, light.position_z])


def direction_of(light: Light) -> Float64:
    return normalize(np.array([light.direction_x, light.direction_y, light.direction_z]))


def has_sphere(light: Light) -> bool:
    """Whether a point or spot has extent: the paper's falloff makes every light a delta."""
    return light.radius > 0.0 and falloff_of(light) == INVERSE_SQUARE


def falloff_of(light: Light) -> tuple[float, float, float]:
    return (light.falloff_constant, light.falloff_linear, light.falloff_quadratic)


# Suns


def sun_cone(light: Light) -> tuple[float, float]:
    """1 - cos of the angular radius, and the factor from irradiance to radiance."""
    return 2.0 * np.sin(0.5 * light.angle) ** 2, 1.0 / (np.pi * np.sin(light.angle) ** 2)


def sample_sun(light: Light, count: int, rng: np.random.Generator) -> LightSample:
    towards = np.tile(direction_of(light), (count, 1))
    far = np.full(count, np.inf)
    if light.angle <= 0.0:
        return LightSample(towards, far, np.tile(color_of(light), (count, 1)), far)
    one_minus_cos, per_irradiance = sun_cone(light)
    wi = build_frame(towards).to_world(sample_cone(rng, np.full(count, one_minus_cos)))
    pdf = np.full(count, 1.0 / cone_solid_angle(one_minus_cos))
    radiance = np.tile(color_of(light) * per_irradiance, (count, 1))
    return LightSample(wi, far, radiance / pdf[:, None], pdf)


def hit_sun(light: Light, direction: Float64, t_surface: Float64) -> LightHit:
    one_minus_cos, per_irradiance = sun_cone(light)
    towards = direction_of(light)
    # 1 - cos from the chord, which keeps its digits at small angles.
    chord = direction - towards
    inside = np.isinf(t_surface) & (0.5 * dot(chord, chord) <= one_minus_cos)
    pdf = np.where(inside, 1.0 / cone_solid_angle(one_minus_cos), 0.0)
    return LightHit(inside[:, None] * color_of(light) * per_irradiance, pdf, np.full(len(pdf), np.inf))


def suns_seen(lights: list[Light], direction: Float64) -> Float64:
    """(n, 3) what camera rays that leave the scene see of suns that belong to the environment."""
    total = np.zeros_like(direction)
    for light in lights:
        if light.seen > 0.5 and LIGHT_KINDS[light.kind] == "sun" and light.angle > 0.0:
            total += hit_sun(light, direction, np.full(len(direction), np.inf)).radiance
    return total


# Points and spots


def spot_mask(light: Light, from_light: Float64) -> Float64:
    """(n,) Blender's cone: smoothstep between the two cosines; 1 for a point."""
    if LIGHT_KINDS[light.kind] != "spot":
        return np.ones(len(from_light))
    cosine = from_light @ direction_of(light)
    width = light.cos_inner - light.cos_outer
    if width <= 0.0:
        return (cosine > light.cos_outer).astype(np.float64)
    x = np.clip((cosine - light.cos_outer) / width, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


def sample_bulb(light: Light, points: Float64, rng: np.random.Generator) -> LightSample:
    offset = position_of(light) - points
    distance = np.linalg.norm(offset, axis=1)
    towards = offset / np.maximum(distance, 1e-300)[:, None]
    if not has_sphere(light):
        strength = spot_mask(light, -towards) * attenuation(light, distance)
        return LightSample(
            towards, distance, strength[:, None] * color_of(light), np.full(len(points), np.inf)
        )
    if light.soft > 0.5:
        return sample_soft(light, points, rng)
    one_minus_cos = sphere_cone(light, distance)
    wi = build_frame(towards).to_world(sample_cone(rng, one_minus_cos))
    hit = hit_bulb(light, points, wi, np.full(len(points), np.inf))
    along = np.maximum(0.0, dot(wi, offset) - light.radius)
    pdf = np.where(distance > light.radius, 1.0 / cone_solid_angle(one_minus_cos), np.inf)
    return LightSample(wi, along, sphere_radiance(light, wi) / pdf[:, None] * (hit.pdf > 0.0)[:, None], pdf)


def sample_soft(light: Light, points: Float64, rng: np.random.Generator) -> LightSample:
    """A point of the disc that faces each of `points`."""
    offset = position_of(light) - points
    away = np.maximum(np.linalg.norm(offset, axis=1), 1e-300)
    frame = build_frame(offset / away[:, None])
    reach, angle = np.sqrt(rng.random(len(points))), 2.0 * np.pi * rng.random(len(points))
    local = np.stack([reach * np.cos(angle), reach * np.sin(angle), 0.0 * reach], axis=1) * light.radius
    place = offset + frame.to_world(local)
    distance = np.linalg.norm(place, axis=1)
    wi = place / distance[:, None]
    pdf = distance**3 / (away * np.pi * light.radius**2)
    return LightSample(wi, distance, sphere_radiance(light, wi) / pdf[:, None], pdf)


def hit_soft(light: Light, origin: Float64, direction: Float64, t_surface: Float64) -> LightHit:
    offset = position_of(light) - origin
    away, along = np.linalg.norm(offset, axis=1), dot(offset, direction)
    t = np.where(along > 0.0, away * away / np.where(along > 0.0, along, 1.0), np.inf)
    seen = (t < t_surface) & (t * t - away * away <= light.radius**2)
    pdf = np.where(seen, t**3 / (away * np.pi * light.radius**2), 0.0)
    return LightHit(np.where(seen[:, None], sphere_radiance(light, direction), 0.0), pdf, t)


def attenuation(light: Light, distance: Float64) -> Float64:
    """Irradiance of a delta light over its colour, at `distance` and facing it."""
    constant, linear, quadratic = falloff_of(light)
    with np.errstate(divide="ignore"):
        if falloff_of(light) == INVERSE_SQUARE:
            return 1.0 / (distance * distance)
        return np.minimum(
            1.0, 1.0 / np.maximum(constant + linear * distance + quadratic * distance * distance, 0.0)
        )


def sphere_cone(light: Light, distance: Float64) -> Float64:
    """1 - cos of the cone that the light's sphere fills from outside."""
    sine_squared = np.clip(light.radius**2 / np.maximum(distance, 1e-300) ** 2, 0.0, 1.0)
    return sine_squared / (1.0 + np.sqrt(1.0 - sine_squared))


def sphere_radiance(light: Light, direction: Float64) -> Float64:
    """(n, 3) radiance of the sphere along rays in `direction`; a spot's cone acts on the ray."""
    return spot_mask(light, -direction)[:, None] * color_of(light) / (np.pi * light.radius**2)


def hit_bulb(light: Light, origin: Float64, direction: Float64, t_surface: Float64) -> LightHit:
    """The near side of the sphere; from inside nothing is seen, the sphere shines outwards."""
    if light.soft > 0.5:
        return hit_soft(light, origin, direction, t_surface)
    offset = position_of(light) - origin
    distance = np.linalg.norm(offset, axis=1)
    along = dot(offset, direction)
    miss = offset - along[:, None] * direction
    half_chord_squared = light.radius**2 - dot(miss, miss)
    near = along - np.sqrt(np.maximum(half_chord_squared, 0.0))
    seen = (distance > light.radius) & (half_chord_squared >= -1e-9 * light.radius**2) & (near > 0.0)
    seen &= near < t_surface
    pdf = np.where(seen, 1.0 / cone_solid_angle(np.maximum(sphere_cone(light, distance), 1e-300)), 0.0)
    return LightHit(np.where(seen[:, None], sphere_radiance(light, direction), 0.0), pdf, near)


# Areas


def area_axes(light: Light) -> tuple[Float64, Float64, float]:
    """The two half axes and the area of the whole shape."""
    u = np.array([light.axis_u_x, light.axis_u_y, light.axis_u_z])
    v = np.array([light.axis_v_x, light.axis_v_y, light.axis_v_z])
    shape = np.pi if LIGHT_KINDS[light.kind] == "area_ellipse" else 4.0
    return u, v, shape * float(np.linalg.norm(np.cross(u, v)))


def spread_share(light: Light, cosine: Float64) -> Float64:
    """(n,) radiance over colour at `cosine` to the axis (Blender's spread)."""
    if light.spread >= np.pi - 1e-4:
        return np.ones_like(cosine)
    half = max(0.5 * light.spread, 1e-3)
    safe = np.clip(cosine, 1e-12, 1.0)
    tangent = np.sqrt(1.0 - safe * safe) / safe
    return np.maximum(np.tan(half) - tangent, 0.0) / (np.tan(half) - half)


def sample_area(light: Light, points: Float64, rng: np.random.Generator) -> LightSample:
    u, v, area = area_axes(light)
    first, second = rng.random(len(points)), rng.random(len(points))
    if LIGHT_KINDS[light.kind] == "area_ellipse":
        a = np.sqrt(first) * np.cos(2.0 * np.pi * second)
        b = np.sqrt(first) * np.sin(2.0 * np.pi * second)
    else:
        a, b = 2.0 * first - 1.0, 2.0 * second - 1.0
    offset = position_of(light) + a[:, None] * u + b[:, None] * v - points
    distance = np.linalg.norm(offset, axis=1)
    wi = offset / np.maximum(distance, 1e-300)[:, None]
    facing = np.maximum(0.0, -wi @ direction_of(light))
    over_pdf = facing * area / np.maximum(distance * distance, 1e-300)
    pdf = 1.0 / np.maximum(over_pdf, 1e-300)
    shares = spread_share(light, facing)
    return LightSample(wi, distance, (over_pdf * shares)[:, None] * color_of(light), pdf)


def hit_area(light: Light, origin: Float64, direction: Float64, t_surface: Float64) -> LightHit:
    u, v, area = area_axes(light)
    facing = -direction @ direction_of(light)
    offset = position_of(light) - origin
    t = -(offset @ direction_of(light)) / np.where(facing > 0.0, facing, np.inf)
    place = t[:, None] * direction - offset
    a, b = in_axes(place, u, v)
    if LIGHT_KINDS[light.kind] == "area_ellipse":
        within: NDArray[np.bool_] = a * a + b * b <= 1.0
    else:
        within = (np.abs(a) <= 1.0) & (np.abs(b) <= 1.0)
    seen = within & (facing > 0.0) & (t > 0.0) & (t < t_surface)
    pdf = np.where(seen, t * t / np.maximum(facing * area, 1e-300), 0.0)
    return LightHit((seen * spread_share(light, facing))[:, None] * color_of(light), pdf, t)


def in_axes(place: Float64, u: Float64, v: Float64) -> tuple[Float64, Float64]:
    """Coordinates of points of the plane in the half axes, which need not be perpendicular."""
    uu, uv, vv = u @ u, u @ v, v @ v
    determinant = max(uu * vv - uv * uv, 1e-300)
    pu, pv = place @ u, place @ v
    return (pu * vv - pv * uv) / determinant, (pv * uu - pu * uv) / determinant
