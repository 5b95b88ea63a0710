"""Textures of the reference renderer: images made linear, looked up bilinearly at texel centres."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .scene_arrays import WRAP_MODES, Float64, ImageArrays, Texture


def linear_image(image: ImageArrays) -> Float64:
    """(h, w, 3) scene-linear values of an image; one channel becomes grey, alpha is left out."""
    pixels = np.asarray(image.pixels)
    values = pixels.astype(np.float64)
    if pixels.dtype == np.uint8:
        values /= 255.0
    values = np.repeat(values[..., :1], 3, axis=2) if values.shape[2] == 1 else values[..., :3]
    return srgb_to_linear(values) if image.srgb else values


def srgb_to_linear(values: Float64) -> Float64:
    """IEC 61966-2-1."""
    return np.where(values <= 0.04045, values / 12.92, ((np.maximum(values, 0.0) + 0.055) / 1.055) ** 2.4)


def look_up(pixels: Float64, texture: Texture, uv: Float64) -> Float64:
    """(n, 3) bilinear values at `uv` (n, 2); the value of a texel lies at its centre, row 0 is at v = 0."""
    height, width = pixels.shape[:2]
    x = (uv[:, 0] * texture.scale_u + texture.offset_u) * width - 0.5
    y = (uv[:, 1] * texture.scale_v + texture.offset_v) * height - 0.5
    left, bottom = np.floor(x), np.floor(y)
    fx, fy = (x - left)[:, None], (y - bottom)[:, None]
    x0, x1 = wrap(left, width, texture.wrap), wrap(left + 1, width, texture.wrap)
    y0, y1 = wrap(bottom, height, texture.wrap), wrap(bottom + 1, height, texture.wrap)
    lower = pixels[y0, x0] * (1.0 - fx) + pixels[y0, x1] * fx
    upper = pixels[y1, x0] * (1.0 - fx) + pixels[y1, x1] * fx
    return lower * (1.0 - fy) + upper * fy


def wrap(index: Float64, size: int, mode: int) -> NDArray[np.int64]:
    """Texel indices inside the picture, by the mode of WRAP_MODES."""
    if WRAP_MODES[mode] == "repeat":
        return np.mod(index, size).astype(np.int64)
    return np.clip(index, 0, size - 1).astype(np.int64)
