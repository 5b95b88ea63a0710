"""Noise, checker, brick, wave and gradient of the reference renderer, in float64.

Perlin 2002 and Musgrave 1998 with the lattice hash (Jenkins' lookup3), scales and repeat distance of
Blender's Noise Texture.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .scene_arrays import Float64
from .texture_ops import NOISES, WAVE_PROFILE_SHIFT, WAVE_RINGS

NOISE_SCALES = (0.25, 0.6616, 0.982, 0.8344)
Words = NDArray[np.uint32]


def rotate_left(x: Words, k: int) -> Words:
    return (x << np.uint32(k)) | (x >> np.uint32(32 - k))


def hash_words(keys: list[Words]) -> Words:
    """One word of each row of up to four."""
    start = np.uint32((0xDEADBEEF + (len(keys) << 2) + 13) & 0xFFFFFFFF)
    a, b, c = (np.full_like(keys[0], start) for _ in range(3))
    a = a + keys[0]
    b = b + keys[1] if len(keys) > 1 else b
    c = c + keys[2] if len(keys) > 2 else c
    if len(keys) > 3:
        for k in (4, 6, 8, 16, 19, 4):
            a, c = (a - c) ^ rotate_left(c, k), c + b
            a, b, c = b, c, a
        a = a + keys[3]
    for k in (14, 11, 25, 16, 4, 14, 24):
        c = (c ^ b) - rotate_left(b, k)
        a, b, c = b, c, a
    return b


def hash_floats(keys: list[float]) -> float:
    words = [np.array([key], np.float32).view(np.uint32) for key in keys]
    return float(hash_words(words)[0]) / 4294967295.0


def lattice_slope(hashed: Words, d: list[Float64]) -> Float64:
    """Dot product of the offsets with the gradients that `hashed` picks."""

    def signed(x: Float64, bit: int) -> Float64:
        return np.where(hashed & np.uint32(bit), -x, x)

    if len(d) == 1:
        return signed((1.0 + (hashed & np.uint32(7))) * d[0], 8)
    if len(d) == 2:
        first = (hashed & np.uint32(7)) < 4
        return signed(np.where(first, d[0], d[1]), 1) + signed(2.0 * np.where(first, d[1], d[0]), 2)
    if len(d) == 3:
        h = hashed & np.uint32(15)
        other = np.where((h == 12) | (h == 14), d[0], d[2])
        return signed(np.where(h < 8, d[0], d[1]), 1) + signed(np.where(h < 4, d[1], other), 2)
    h = hashed & np.uint32(31)
    return (
        signed(np.where(h < 24, d[0], d[1]), 1)
        + signed(np.where(h < 16, d[1], d[2]), 2)
        + signed(np.where(h < 8, d[2], d[3]), 4)
    )


def eval_noise(p: Float64) -> Float64:
    """(n,) noise at `p` (n, dimensions), between about -1 and 1."""
    dimensions = p.shape[1]
    far = np.where(np.abs(p) >= 1e6, 0.5, 0.0)
    place = np.where(np.isfinite(p), np.fmod(np.where(np.isfinite(p), p, 0.0), 100000.0) + far, 0.0)
    cell = np.floor(place)
    rest = place - cell
    fade = rest**3 * (rest * (rest * 6.0 - 15.0) + 10.0)
    words = cell.astype(np.int64).astype(np.uint32)
    values = []
    for corner in range(1 << dimensions):
        step = [(corner >> k) & 1 for k in range(dimensions)]
        hashed = hash_words([words[:, k] + np.uint32(step[k]) for k in range(dimensions)])
        values.append(lattice_slope(hashed, [rest[:, k] - step[k] for k in range(dimensions)]))
    for k in range(dimensions):
        t = fade[:, k]
        values = [values[i] * (1.0 - t) + values[i + 1] * t for i in range(0, len(values), 2)]
    return NOISE_SCALES[dimensions - 1] * values[0]


@dataclass(frozen=True, slots=True)
class Fractal:
    """How octaves add up; numbers at n points."""

    kind: str
    normalize: bool
    detail: Float64
    roughness: Float64
    lacunarity: Float64
    offset: Float64
    gain: Float64


def eval_fractal(p: Float64, f: Fractal) -> Float64:
    """(n,) value of the fractal at `p` (n, dimensions); octaves that a point does not have are masked."""
    place, octaves = p.copy(), []
    for _ in range(int(np.max(np.floor(f.detail), initial=0.0)) + 2):
        octaves.append(eval_noise(place))
        place = place * f.lacunarity[:, None]
    return _FRACTALS[f.kind](octaves, f)


def _share(f: Fractal, octave: int) -> Float64:
    """How much of an octave counts: 1, the fraction of the last, 0."""
    return np.clip(f.detail - octave + 1.0, 0.0, 1.0) if octave else np.ones_like(f.detail)


def _fbm(octaves: list[Float64], f: Fractal) -> Float64:
    amplitude, total, result = np.ones_like(f.detail), np.zeros_like(f.detail), np.zeros_like(f.detail)
    summed = np.zeros_like(f.detail)
    for number, octave in enumerate(octaves):
        share = _share(f, number)
        summed = summed + octave * amplitude
        total = total + amplitude
        level = 0.5 * summed / total + 0.5 if f.normalize else summed
        result = result * (1.0 - share) + level * share
        amplitude = amplitude * f.roughness
    return result


def _multifractal(octaves: list[Float64], f: Fractal) -> Float64:
    value, power = np.ones_like(f.detail), np.ones_like(f.detail)
    for number, octave in enumerate(octaves):
        value = value * (_share(f, number) * power * octave + 1.0)
        power = power * f.roughness
    return value


def _hetero(octaves: list[Float64], f: Fractal) -> Float64:
    value, power = f.offset + octaves[0], f.roughness
    for number, octave in enumerate(octaves[1:], 1):
        value = value + _share(f, number) * (octave + f.offset) * power * value
        power = power * f.roughness
    return value


def _hybrid(octaves: list[Float64], f: Fractal) -> Float64:
    value, power, weight = np.zeros_like(f.detail), np.ones_like(f.detail), np.ones_like(f.detail)
    for number, octave in enumerate(octaves):
        share = np.where(weight > 0.001, _share(f, number), 0.0)
        weight = np.minimum(weight, 1.0)
        signal = (octave + f.offset) * power
        value = value + share * weight * signal
        weight = np.where(share > 0.0, weight * f.gain * signal, 0.0)
        power = power * f.roughness
    return value


def _ridged(octaves: list[Float64], f: Fractal) -> Float64:
    signal = (f.offset - np.abs(octaves[0])) ** 2
    value, power = signal, f.roughness
    for number, octave in enumerate(octaves[1:], 1):
        whole = number <= np.floor(f.detail)
        weight = np.clip(signal * f.gain, 0.0, 1.0)
        signal = (f.offset - np.abs(octave)) ** 2 * weight
        value = value + np.where(whole, signal * power, 0.0)
        power = power * f.roughness
    return value


_FRACTALS: dict[str, Callable[[list[Float64], Fractal], Float64]] = dict(
    zip(NOISES, (_multifractal, _ridged, _hybrid, _fbm, _hetero), strict=True)
)


def shift_noise(p: Float64, seed: float) -> Float64:
    dimensions = p.shape[1]
    keys = [[seed]] if dimensions == 1 else [[seed, float(k)] for k in range(dimensions)]
    return p + np.array([100.0 + 100.0 * hash_floats(key) for key in keys])


def eval_noise_texture(p: Float64, f: Fractal, distortion: Float64, colored: bool) -> Float64:
    """(n, 3) colour at the scaled place; three times the value unless `colored`."""
    dimensions = p.shape[1]
    bend = [eval_noise(shift_noise(p, float(k))) for k in range(dimensions)]
    place = p + np.stack(bend, axis=1) * distortion[:, None]
    value = eval_fractal(place, f)
    if not colored:
        return np.repeat(value[:, None], 3, axis=1)
    others = [eval_fractal(shift_noise(place, float(dimensions + k)), f) for k in range(2)]
    return np.stack([value, *others], axis=1)


def nudge(p: Float64) -> Float64:
    """Cycles moves its patterns by this."""
    return (p + 1e-6) * 0.999999


def eval_checker(p: Float64) -> Float64:
    return (np.mod(np.floor(nudge(p)).sum(axis=1), 2.0) != 0.0).astype(np.float64)


def smooth_step(x: Float64) -> Float64:
    t = np.clip(x, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def eval_brick(p: Float64, numbers: list[Float64], fixed: Float64) -> tuple[Float64, Float64]:
    """Tint and mortar at the scaled place. `numbers`: mortar size and smoothness, bias, width, row
    height; `fixed`: offset, squash and their frequencies."""
    mortar_size, smooth, bias, width, height = numbers
    offset, squash, offset_every, squash_every = fixed
    row = np.floor(p[:, 1] / height)
    shift = np.zeros_like(row)
    if offset_every and squash_every:
        width = np.where(np.fmod(row, squash_every) == 0.0, width * squash, width)
        shift = np.where(np.fmod(row, offset_every) == 0.0, width * offset, 0.0)
    brick = np.floor((p[:, 0] + shift) / width)
    x, y = p[:, 0] + shift - width * brick, p[:, 1] - height * row
    tint = np.clip(hash_brick(row, brick) + bias, 0.0, 1.0)
    edge = np.minimum(np.minimum(x, y), np.minimum(width - x, height - y))
    soft = smooth_step((1.0 - edge / mortar_size) / np.where(smooth == 0.0, 1.0, smooth))
    return tint, np.where(edge >= mortar_size, 0.0, np.where(smooth == 0.0, 1.0, soft))


def hash_brick(row: Float64, brick: Float64) -> Float64:
    def word(x: Float64) -> Words:
        return np.where(np.abs(x) < 2147483520.0, x, 0.0).astype(np.int64).astype(np.uint32)

    n = ((word(row) << np.uint32(16)) + (word(brick) & np.uint32(0xFFFF)) + np.uint32(1013)) & np.uint32(
        0x7FFFFFFF
    )
    n = (n >> np.uint32(13)) ^ n
    mixed = n * (n * n * np.uint32(60493) + np.uint32(19990303)) + np.uint32(1376312589)
    return 0.5 * (mixed & np.uint32(0x7FFFFFFF)) / 1073741824.0


def eval_wave(at: Float64, mode: int, numbers: list[Float64]) -> Float64:
    """`numbers`: distortion, detail, its scale and roughness, phase."""
    distortion, detail, scale, roughness, phase = numbers
    p, direction = nudge(at), mode & 3
    if mode & WAVE_RINGS:
        n = 20.0 * np.linalg.norm(np.delete(p, direction, axis=1) if direction < 3 else p, axis=1)
    else:
        n = p.sum(axis=1) * 10.0 if direction == 3 else p[:, direction] * 20.0
    zero = np.zeros_like(phase)
    fractal = Fractal(
        "FBM", True, np.clip(detail, 0.0, 15.0), np.maximum(roughness, 0.0), zero + 2.0, zero, zero
    )
    n = n + phase + distortion * (eval_fractal(p * scale[:, None], fractal) * 2.0 - 1.0)
    turns = n / (2.0 * np.pi)
    profile = mode >> WAVE_PROFILE_SHIFT
    if profile == 0:
        return 0.5 + 0.5 * np.sin(n - 0.5 * np.pi)
    return turns - np.floor(turns) if profile == 1 else np.abs(turns - np.floor(turns + 0.5)) * 2.0


def eval_gradient(p: Float64, kind: int) -> Float64:
    x, y = p[:, 0], p[:, 1]
    ball = np.maximum(0.999999 - np.linalg.norm(p, axis=1), 0.0)
    values = (
        x,
        np.maximum(x, 0.0) ** 2,
        smooth_step(x),
        (x + y) * 0.5,
        ball,
        ball * ball,
        np.arctan2(y, x) / (2.0 * np.pi) + 0.5,
    )
    return np.clip(values[kind], 0.0, 1.0)
