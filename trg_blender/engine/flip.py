"""The FLIP difference of two pictures, as one flips between them on a screen.

Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild: "FLIP: A Difference Evaluator for
Alternating Images", HPG 2020. The contrast sensitivity of the eye blurs both pictures; what is left of
colour is compared by the HyAB distance, edges and points by derivatives of Gaussians.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

PIXELS_PER_DEGREE = 67.0206
"""A 4K screen 0.7 m wide seen from 0.7 m (section 3)."""
_RGB_TO_XYZ = np.array(
    [
        [10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
        [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
        [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382],
    ]
)
_XYZ_TO_RGB = np.linalg.inv(_RGB_TO_XYZ)
_WHITE = _RGB_TO_XYZ.sum(axis=1)
_SENSITIVITIES = (((1.0, 0.0047),), ((1.0, 0.0053),), ((34.1, 0.04), (13.5, 0.025)))
"""(weight, width) of the Gaussians for luminance, red-green and blue-yellow (table 1)."""
_WIDEST = 0.04
_COLOUR_POWER, _COLOUR_BEND, _COLOUR_REST = 0.7, 0.4, 0.95
_FEATURE_DEGREES, _FEATURE_POWER = 0.082, 0.5


def flip(reference: Array, test: Array, pixels_per_degree: float = PIXELS_PER_DEGREE) -> Array:
    """The difference of each pixel, 0 (none) to 1, shape (h, w).

    Both pictures are (h, w, 3), display values of sRGB in 0..1; what lies outside is cut off. Raises
    ValueError for shapes that differ or are no such pictures.
    """
    if reference.shape != test.shape or reference.ndim != 3 or reference.shape[2] != 3:
        raise ValueError(f"pictures of shapes {reference.shape} and {test.shape}: not two of (h, w, 3)")
    opponents = [_to_opponents(_linear(np.clip(each, 0.0, 1.0))) for each in (reference, test)]
    colours = [_hunt(_to_lab(_seen(each, pixels_per_degree))) for each in opponents]
    colour = _redistribute(_hyab(*colours) ** _COLOUR_POWER)
    features = [_features((each[..., 0] + 16.0) / 116.0, pixels_per_degree) for each in opponents]
    edges, points = (np.abs(a - b) for a, b in zip(*features, strict=True))
    feature = (np.maximum(edges, points) / np.sqrt(2.0)) ** _FEATURE_POWER
    return np.asarray(colour ** (1.0 - np.minimum(feature, 1.0)))


def _linear(srgb: Array) -> Array:
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def _to_opponents(rgb: Array) -> Array:
    """Linear RGB as Y, Cx, Cz: like L*a*b* without its curve."""
    x, y, z = np.moveaxis(rgb @ _RGB_TO_XYZ.T / _WHITE, -1, 0)
    return np.stack([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)], axis=-1)


def _from_opponents(values: Array) -> Array:
    y = (values[..., 0] + 16.0) / 116.0
    xyz = np.stack([y + values[..., 1] / 500.0, y, y - values[..., 2] / 200.0], axis=-1)
    return xyz * _WHITE @ _XYZ_TO_RGB.T


def _to_lab(rgb: Array) -> Array:
    xyz = rgb @ _RGB_TO_XYZ.T / _WHITE
    delta = 6.0 / 29.0
    x, y, z = np.moveaxis(
        np.where(xyz > delta**3, np.cbrt(np.maximum(xyz, 0.0)), xyz / (3.0 * delta**2) + 4.0 / 29.0), -1, 0
    )
    return np.stack([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)], axis=-1)


def _seen(opponents: Array, pixels_per_degree: float) -> Array:
    """Linear RGB of what the eye resolves."""
    radius = int(np.ceil(3.0 * np.sqrt(_WIDEST / (2.0 * np.pi**2)) * pixels_per_degree))
    degrees = np.arange(-radius, radius + 1) / pixels_per_degree
    channels = []
    for channel, gaussians in zip(np.moveaxis(opponents, -1, 0), _SENSITIVITIES, strict=True):
        total, blurred = 0.0, np.zeros_like(channel)
        for weight, width in gaussians:
            kernel = np.exp(-(np.pi**2) * degrees**2 / width)
            strength = weight * np.sqrt(np.pi / width)
            total += strength * kernel.sum() ** 2
            blurred += strength * _filtered(channel, kernel, kernel)
        channels.append(blurred / total)
    return np.clip(_from_opponents(np.stack(channels, axis=-1)), 0.0, 1.0)


def _filtered(channel: Array, along_x: Array, along_y: Array) -> Array:
    """A picture (h, w) under a separable kernel; beyond its border it repeats its last pixel."""
    return _along(_along(channel, along_x, 1), along_y, 0)


def _along(channel: Array, kernel: Array, axis: int) -> Array:
    radius = len(kernel) // 2
    padding = [(radius, radius) if k == axis else (0, 0) for k in range(2)]
    padded = np.pad(channel, padding, mode="edge")
    size = channel.shape[axis]
    result = np.zeros_like(channel)
    for k, weight in enumerate(kernel):
        result += weight * (padded[:, k : k + size] if axis == 1 else padded[k : k + size])
    return result


def _hunt(lab: Array) -> Array:
    """Colours of dark pixels count less (Hunt)."""
    return np.concatenate([lab[..., :1], 0.01 * lab[..., :1] * lab[..., 1:]], axis=-1)


def _hyab(a: Array, b: Array) -> Array:
    lightness = np.abs(a[..., 0] - b[..., 0])
    return np.asarray(lightness + np.hypot(a[..., 1] - b[..., 1], a[..., 2] - b[..., 2]))


def _redistribute(difference: Array) -> Array:
    """0..1, most of it for the smaller differences (section 4.1)."""
    green, blue = (_hunt(_to_lab(np.array(each))) for each in ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
    largest = float(_hyab(green, blue)) ** _COLOUR_POWER
    bend = _COLOUR_BEND * largest
    steep = difference * (_COLOUR_REST / bend)
    flat = _COLOUR_REST + (difference - bend) / (largest - bend) * (1.0 - _COLOUR_REST)
    return np.where(difference < bend, steep, flat)


def _features(luminance: Array, pixels_per_degree: float) -> Sequence[Array]:
    """Strength of edges and of points."""
    deviation = 0.5 * _FEATURE_DEGREES * pixels_per_degree
    radius = int(np.ceil(3.0 * deviation))
    x = np.arange(-radius, radius + 1, dtype=np.float64)
    bell = np.exp(-(x**2) / (2.0 * deviation**2))
    bell /= bell.sum()
    slope, bow = -x * bell, (x**2 / deviation**2 - 1.0) * bell
    found = []
    for kernel in (slope, bow):
        even = np.where(kernel > 0, kernel / kernel[kernel > 0].sum(), -kernel / kernel[kernel < 0].sum())
        found.append(np.hypot(_filtered(luminance, even, bell), _filtered(luminance, bell, even)))
    return found
