"""The sheen and the rough diffuse base of the reference renderer, local to the shading normal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .reference_math import dot, normalize, sample_cosine
from .scene_arrays import Float64


@dataclass(frozen=True, slots=True)
class Sheen:
    """Fibres on the surface as a linearly transformed cosine (Zeltner, Burley and Chiang 2022).

    The rational fits to its tables are those that MaterialX publishes.
    """

    a: Float64
    b: Float64
    azimuth: Float64
    """of the viewer, radians"""
    albedo: Float64


def build_sheen(wo: Float64, roughness: Float64) -> Sheen:
    x, y = np.clip(wo[:, 2], 0.0, 1.0), np.maximum(roughness, 0.01)
    spread = y * (0.0206607 + 1.58491 * y) / (0.0379424 + y * (1.32227 + y))
    middle = y * (-0.193854 + y * (-1.14885 + y * (1.7932 - 0.95943 * y**2))) / (0.046391 + y)
    offset = y * (0.000654023 + (-0.0207818 + 0.119681 * y) * y) / (1.26264 + y * (-1.92021 + y))
    albedo = np.exp(-0.5 * ((x - middle) / spread) ** 2) / (spread * np.sqrt(2.0 * np.pi)) + offset
    a = (2.58126 * x + 0.813703 * y) * y / (1.0 + 0.310327 * x**2 + 2.60994 * x * y)
    b = np.sqrt(1.0 - x) * (y - 1.0) * y**3
    b = b / (0.0000254053 + 1.71228 * x - 1.71506 * x * y + 1.34174 * y**2)
    return Sheen(a, b, np.arctan2(wo[:, 1], wo[:, 0]), np.clip(albedo, 0.0, 1.0))


def eval_sheen(sheen: Sheen, wi: Float64) -> Float64:
    """(n,) density, whose integral over the upper hemisphere is 1."""
    local = turn(wi, -sheen.azimuth)
    back = np.stack(
        [sheen.a * local[:, 0] + sheen.b * local[:, 2], sheen.a * local[:, 1], local[:, 2]], axis=1
    )
    return np.maximum(local[:, 2], 0.0) / np.pi * (sheen.a / np.maximum(dot(back, back), 1e-12)) ** 2


def sample_sheen(sheen: Sheen, rng: np.random.Generator) -> Float64:
    """(n, 3) directions with density eval_sheen."""
    c = sample_cosine(rng, len(sheen.a))
    w = np.stack([c[:, 0] - c[:, 2] * sheen.b, c[:, 1], c[:, 2] * sheen.a], axis=1)
    return turn(normalize(w), sheen.azimuth)


def turn(w: Float64, angle: Float64) -> Float64:
    """Directions turned about z."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * w[:, 0] - s * w[:, 1], s * w[:, 0] + c * w[:, 1], w[:, 2]], axis=1)


def rough_diffuse(color: Float64, roughness: Float64, wo: Float64, wi: Float64) -> Float64:
    """(n, 3) value times cosine, before the colour: Fujii's Oren and Nayar with light scattered again.

    The second part follows the OpenPBR surface specification 1.1 ("Glossy-diffuse slab"); as in Cycles it
    gets the colour once more when the caller multiplies by it.
    """
    a = 1.0 / (np.pi + roughness * (0.5 * np.pi - 2.0 / 3.0))
    b = roughness * a
    cos_i, cos_o = np.maximum(wi[:, 2], 0.0), wo[:, 2]
    t = dot(wi, wo) - cos_i * cos_o
    t = np.where(t > 0.0, t / np.maximum(np.maximum(cos_i, cos_o), 1e-12), t)
    mean = a * np.pi + b * (2.0 * np.pi - 5.6) / 3.0
    gone_o = 1.0 - (a * np.pi + b * rough_diffuse_tail(cos_o))
    gone_i = 1.0 - (a * np.pi + b * rough_diffuse_tail(cos_i))
    strength = gone_o * gone_i / np.pi * mean / np.where(mean < 1.0, 1.0 - mean, 1.0)
    again = strength[:, None] * color**2 / (1.0 - color * (1.0 - mean)[:, None])
    once = (a + b * t)[:, None]
    return np.where((roughness > 1e-5)[:, None], once + again, 1.0 / np.pi) * cos_i[:, None]


def rough_diffuse_tail(cosine: Float64) -> Float64:
    """Integral of the angular term over the hemisphere, seen at `cosine`."""
    c = np.clip(cosine, 1e-6, 1.0)
    s = np.sqrt(1.0 - c * c)
    return s * (np.arccos(c) - 2.0 / 3.0 - s * c) + 2.0 / 3.0 * s / c * (1.0 - s**3)
