"""The equirectangular world of the reference renderer: looked up along rays, and drawn from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .reference_lights import LightSample
from .scene_arrays import Environment, Float64

EVEN_SHARE = 0.25
"""How much of the drawing ignores the picture, so that no direction is rare where it shines."""


@dataclass(frozen=True, slots=True)
class Sky:
    """A picture of the world with the table by which its texels are drawn."""

    pixels: Float64
    """(h, w, 3)"""
    rotation: Float64
    """(3, 3) world to picture"""
    chance: Float64
    """(h * w,) of drawing each texel"""
    cumulative: Float64
    """(h * w,) rising to 1"""


def build_sky(environment: Environment) -> Sky:
    pixels = np.asarray(environment.pixels, dtype=np.float64)
    height, width = pixels.shape[:2]
    weight = np.abs(pixels).sum(axis=2) * _row_solid_angles(height, width)[:, None]
    weight = weight.ravel() + 1e-12 * weight.max() + 1e-300
    chance = weight / weight.sum()
    return Sky(pixels, np.asarray(environment.rotation, dtype=np.float64), chance, np.cumsum(chance))


def _row_solid_angles(height: int, width: int) -> Float64:
    """(h,) solid angle of one texel of each row."""
    edges = np.sin(np.pi * (np.arange(height + 1) / height - 0.5))
    return np.diff(edges) * 2.0 * np.pi / width


def _place(sky: Sky, direction: Float64) -> tuple[Float64, Float64]:
    """(u, v) from 0 to 1 of directions (n, 3)."""
    x, y, z = (direction @ sky.rotation.T).T
    return 0.5 - np.arctan2(y, x) / (2.0 * np.pi), 0.5 + np.arctan2(z, np.hypot(x, y)) / np.pi


def evaluate_sky(sky: Sky, direction: Float64) -> Float64:
    """(n, 3) radiance: bilinear between texel centres, round the picture, held at the poles."""
    height, width = sky.pixels.shape[:2]
    u, v = _place(sky, direction)
    x, y = u * width - 0.5, np.clip(v * height - 0.5, 0.0, height - 1.0)
    column, row = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    along, up = (x - column)[:, None], (y - row)[:, None]
    left, right, above = column % width, (column + 1) % width, np.minimum(row + 1, height - 1)
    low = sky.pixels[row, left] * (1.0 - along) + sky.pixels[row, right] * along
    high = sky.pixels[above, left] * (1.0 - along) + sky.pixels[above, right] * along
    return low * (1.0 - up) + high * up


def pdf_sky(sky: Sky, direction: Float64) -> Float64:
    """(n,) density per steradian with which `sample_sky` draws directions."""
    height, width = sky.pixels.shape[:2]
    u, v = _place(sky, direction)
    column = np.clip((u * width).astype(np.int64), 0, width - 1)
    row = np.clip((v * height).astype(np.int64), 0, height - 1)
    density = sky.chance[row * width + column] / _row_solid_angles(height, width)[row]
    return EVEN_SHARE / (4.0 * np.pi) + (1.0 - EVEN_SHARE) * density


def sample_sky(sky: Sky, count: int, rng: np.random.Generator) -> LightSample:
    """`count` directions, the same wherever they are seen from."""
    height, width = sky.pixels.shape[:2]
    texel = np.minimum(
        np.searchsorted(sky.cumulative, rng.random(count), side="right"), height * width - 1
    )
    row, column = texel // width, texel % width
    low, high = (np.sin(np.pi * ((row + k) / height - 0.5)) for k in (0, 1))
    even = rng.random(count) < EVEN_SHARE
    z = np.where(even, 2.0 * rng.random(count) - 1.0, low + (high - low) * rng.random(count))
    u = np.where(even, rng.random(count), (column + rng.random(count)) / width)
    longitude, rim = (0.5 - u) * 2.0 * np.pi, np.sqrt(np.maximum(0.0, 1.0 - z * z))
    local = np.stack([rim * np.cos(longitude), rim * np.sin(longitude), z], axis=1)
    wi = local @ sky.rotation
    pdf = pdf_sky(sky, wi)
    return LightSample(wi, np.full(count, np.inf), evaluate_sky(sky, wi) / pdf[:, None], pdf)
