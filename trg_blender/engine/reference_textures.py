"""Textures of the reference renderer: interpolation of the stored values, then out of their encoding."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .scene_arrays import CHANNELS, FILTERS, LUMINANCE, WRAP_MODES, Float64, ImageArrays, Texture

Taps = list[tuple[NDArray[np.int64], Float64]]
"""texel (-1: none) and weight of each that a look-up mixes along one axis"""


@dataclass(frozen=True, slots=True)
class Picture:
    """An image ready for look-up."""

    values: Float64
    """(h, w, 4) as interpolated, bytes as 0 to 1; one channel is a grey, no alpha is 1"""
    encoded: bool
    """whether red, green and blue leave sRGB after interpolation"""


def prepare_image(image: ImageArrays) -> Picture:
    pixels = np.asarray(image.pixels)
    values = pixels.astype(np.float64)
    if pixels.dtype == np.uint8:
        values /= 255.0
    channels = values.shape[2]
    whole = np.ones((*values.shape[:2], 4))
    whole[..., :3] = values[..., :1] if channels == 1 else values[..., :3]
    if channels == 4:
        whole[..., 3] = values[..., 3]
    if image.srgb and pixels.dtype == np.float32:
        whole[..., :3] = srgb_to_linear(whole[..., :3])
        return Picture(whole, False)
    return Picture(whole, image.srgb)


def srgb_to_linear(values: Float64) -> Float64:
    """IEC 61966-2-1."""
    return np.where(values <= 0.04045, values / 12.92, ((np.maximum(values, 0.0) + 0.055) / 1.055) ** 2.4)


def look_up(picture: Picture, texture: Texture, uv: Float64) -> Float64:
    """(n, 3) values of `texture` at `uv` (n, 2); row 0 is at v = 0."""
    u, v = uv[:, 0], uv[:, 1]
    x = u * texture.scale_u + v * texture.skew_u + texture.offset_u
    y = u * texture.skew_v + v * texture.scale_v + texture.offset_v
    texels = look_up_texels(picture, texture, x, y)
    if CHANNELS[texture.channel] == "color":
        return texels[:, :3]
    if CHANNELS[texture.channel] == "alpha":
        return np.repeat(texels[:, 3:], 3, axis=1)
    return np.repeat(texels[:, :3] @ LUMINANCE[:, None], 3, axis=1)


def look_up_texels(picture: Picture, texture: Texture, x: Float64, y: Float64) -> Float64:
    """(n, 4) linear colour and alpha at image coordinates x and y, 0 to 1 from edge to edge."""
    height, width = picture.values.shape[:2]
    total = np.zeros((len(x), 4))
    columns = make_taps(x * width, width, texture)
    for row, row_weight in make_taps(y * height, height, texture):
        for column, weight in columns:
            inside = (row >= 0) & (column >= 0)
            texel = picture.values[np.maximum(row, 0), np.maximum(column, 0)]
            total += texel * np.where(inside, row_weight * weight, 0.0)[:, None]
    if texture.unassociate:
        alpha = total[:, 3]
        total[:, :3] /= np.where(alpha == 0.0, 1.0, alpha)[:, None]
    if picture.encoded:
        total[:, :3] = srgb_to_linear(np.clip(total[:, :3], 0.0, 1.0))
    return total


def make_taps(position: Float64, size: int, texture: Texture) -> Taps:
    """The value of a texel lies at its centre."""
    position = np.where(np.isfinite(position), position, 0.0)
    if FILTERS[texture.filter] == "closest":
        return [(wrap(np.floor(position), size, texture.wrap), np.ones_like(position))]
    low = np.floor(position - 0.5)
    t = position - 0.5 - low
    if FILTERS[texture.filter] == "linear":
        return [(wrap(low + k, size, texture.wrap), w) for k, w in ((0, 1.0 - t), (1, t))]
    weights = (
        (1.0 - t) ** 3 / 6.0,
        (0.5 * t - 1.0) * t * t + 2.0 / 3.0,
        (-0.5 * t - 0.5) * (1.0 - t) ** 2 + 2.0 / 3.0,
        t**3 / 6.0,
    )
    return [(wrap(low + k - 1, size, texture.wrap), w) for k, w in enumerate(weights)]


def wrap(index: Float64, size: int, mode: int) -> NDArray[np.int64]:
    """Texel indices inside the picture, by the mode of WRAP_MODES; -1 for none."""
    name = WRAP_MODES[mode]
    if name == "repeat":
        return np.mod(index, size).astype(np.int64)
    if name == "extend":
        return np.clip(index, 0, size - 1).astype(np.int64)
    if name == "clip":
        return np.where((index >= 0) & (index < size), index, -1).astype(np.int64)
    turned = np.mod(index, 2 * size)
    return np.where(turned < size, turned, 2 * size - 1 - turned).astype(np.int64)
