"""Instructions of colours: blends, adjustments, ramps and curves, over arrays of points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .scene_arrays import LUMINANCE, Float64
from .texture_ops import BLENDS, COLOR_MODELS, TABLE_FLAG


@dataclass(frozen=True, slots=True)
class Operands:
    """What an instruction reads."""

    registers: Float64
    """(n, registers)"""
    constants: Float64
    mode: int
    places: tuple[int, ...]

    def table(self, k: int, width: int) -> Float64:
        """(n or 1, width) numbers from operand `k` on."""
        place = self.places[k]
        if place < 0:
            return self.constants[None, -1 - place : -1 - place + width]
        return self.registers[:, place : place + width]

    def number(self, k: int) -> Float64:
        return np.broadcast_to(self.table(k, 1)[:, 0], len(self.registers))

    def vector(self, k: int) -> Float64:
        return np.broadcast_to(self.table(k, 3), (len(self.registers), 3))


def rgb_to_hsv(c: Float64) -> Float64:
    top, spread = c.max(axis=1), c.max(axis=1) - c.min(axis=1)
    saturation = np.where(top != 0.0, spread / np.where(top != 0.0, top, 1.0), 0.0)
    hue = _hue(c, top, np.where(spread != 0.0, spread, 1.0)) / 6.0
    hue = np.where(hue < 0.0, hue + 1.0, hue)
    return np.column_stack([np.where(saturation != 0.0, hue, 0.0), saturation, top])


def _hue(c: Float64, top: Float64, spread: Float64) -> Float64:
    r, g, b = c.T
    return np.where(
        r == top,
        (g - b) / spread,
        np.where(g == top, 2.0 + (b - r) / spread, 4.0 + (r - g) / spread),
    )


def hsv_to_rgb(c: Float64) -> Float64:
    h = np.where(c[:, 0] == 1.0, 0.0, c[:, 0]) * 6.0
    sector = np.floor(h)
    f, s, v = h - sector, c[:, 1], c[:, 2]
    p, q, t = v * (1.0 - s), v * (1.0 - s * f), v * (1.0 - s * (1.0 - f))
    cases = [(v, t, p), (q, v, p), (p, v, t), (p, q, v), (t, p, v)]
    rgb = np.column_stack([v, p, q])
    for number, case in enumerate(cases):
        rgb = np.where((sector == number)[:, None], np.column_stack(case), rgb)
    return np.where((s != 0.0)[:, None], rgb, v[:, None])


def rgb_to_hsl(c: Float64) -> Float64:
    top, low = c.max(axis=1), c.min(axis=1)
    spread, light = top - low, np.minimum(1.0, 0.5 * (top + low))
    safe = np.where(spread != 0.0, spread, 1.0)
    below = np.where(light > 0.5, 2.0 - top - low, top + low)
    saturation = spread / np.where(below != 0.0, below, 1.0)
    hue = _hue(c, top, safe) / 6.0
    hue = np.where(hue < 0.0, hue + 1.0, hue)
    flat = spread == 0.0
    return np.column_stack([np.where(flat, 0.0, hue), np.where(flat, 0.0, saturation), light])


def hsl_to_rgb(c: Float64) -> Float64:
    h = c[:, :1] * 6.0
    chroma = (1.0 - np.abs(2.0 * c[:, 2:] - 1.0)) * c[:, 1:2]
    n = np.column_stack([np.abs(h - 3.0) - 1.0, 2.0 - np.abs(h - 2.0), 2.0 - np.abs(h - 4.0)])
    return (np.clip(n, 0.0, 1.0) - 0.5) * chroma + c[:, 2:]


def _burn(t: Float64, a: Float64, b: Float64) -> Float64:
    left = 1.0 - t + t * b
    return np.where(left <= 0.0, 0.0, np.clip(1.0 - (1.0 - a) / np.where(left == 0.0, 1.0, left), 0.0, 1.0))


def _dodge(t: Float64, a: Float64, b: Float64) -> Float64:
    left = 1.0 - t * b
    lit = np.where(left <= 0.0, 1.0, np.minimum(a / np.where(left == 0.0, 1.0, left), 1.0))
    return np.where(a == 0.0, a, lit)


def _mixed(a: Float64, b: Float64, t: Float64) -> Float64:
    return a * (1.0 - t) + b * t


def _overlay(t: Float64, a: Float64, b: Float64) -> Float64:
    s = 1.0 - t
    return np.where(a < 0.5, a * (s + 2.0 * t * b), 1.0 - (s + 2.0 * t * (1.0 - b)) * (1.0 - a))


BlendFunction = Callable[[Float64, Float64, Float64], Float64]
CHANNEL_BLENDS: dict[str, BlendFunction] = {
    "MIX": lambda t, a, b: _mixed(a, b, t),
    "DARKEN": lambda t, a, b: _mixed(a, np.minimum(a, b), t),
    "MULTIPLY": lambda t, a, b: a * (1.0 - t + t * b),
    "BURN": _burn,
    "LIGHTEN": lambda t, a, b: _mixed(a, np.maximum(a, b), t),
    "SCREEN": lambda t, a, b: 1.0 - (1.0 - t + t * (1.0 - b)) * (1.0 - a),
    "DODGE": _dodge,
    "ADD": lambda t, a, b: a + t * b,
    "OVERLAY": _overlay,
    "SOFT_LIGHT": lambda t, a, b: _mixed(a, (1.0 - a) * b * a + a * (1.0 - (1.0 - b) * (1.0 - a)), t),
    "LINEAR_LIGHT": lambda t, a, b: a + t * (2.0 * b - 1.0),
    "DIFFERENCE": lambda t, a, b: _mixed(a, np.abs(a - b), t),
    "EXCLUSION": lambda t, a, b: np.maximum(_mixed(a, a + b - 2.0 * a * b, t), 0.0),
    "SUBTRACT": lambda t, a, b: a - t * b,
    "DIVIDE": lambda t, a, b: np.where(b != 0.0, _mixed(a, a / np.where(b != 0.0, b, 1.0), t), a),
}


def _blend(o: Operands) -> Float64:
    name, t, a, b = BLENDS[o.mode], o.vector(0), o.vector(1), o.vector(2)
    if name in CHANNEL_BLENDS:
        return CHANNEL_BLENDS[name](t, a, b)
    share, old, new = t[:, :1], rgb_to_hsv(a), rgb_to_hsv(b)
    if name == "SATURATION":
        dyed = hsv_to_rgb(np.column_stack([old[:, 0], _mixed(old[:, 1], new[:, 1], t[:, 0]), old[:, 2]]))
        return np.where(old[:, 1:2] != 0.0, dyed, a)
    if name == "VALUE":
        return hsv_to_rgb(np.column_stack([old[:, :2], _mixed(old[:, 2], new[:, 2], t[:, 0])]))
    saturation = new[:, 1] if name == "COLOR" else old[:, 1]
    dyed = hsv_to_rgb(np.column_stack([new[:, 0], saturation, old[:, 2]]))
    return np.where(new[:, 1:2] != 0.0, _mixed(a, dyed, share), a)


def _table_at(table: Float64, x: Float64, smooth: bool) -> Float64:
    """(n, 4) rows of `table` at x between 0 and 1."""
    at = np.clip(np.nan_to_num(x), 0.0, 1.0) * (len(table) - 1)
    row = np.floor(at).astype(np.int64)
    rest = (at - row)[:, None] if smooth else 0.0
    return table[row] * (1.0 - rest) + table[np.minimum(row + 1, len(table) - 1)] * rest


def _ramp(o: Operands) -> Float64:
    rows = o.mode & (TABLE_FLAG - 1)
    return _table_at(o.table(1, 4 * rows).reshape(rows, 4), o.number(0), bool(o.mode & TABLE_FLAG))


def _curves(o: Operands) -> Float64:
    rows, color = o.mode & (TABLE_FLAG - 1), o.vector(1)
    table = o.table(2, 4 * rows).reshape(rows, 4)
    low = o.number(3)[:, None]
    x = (color - low) / (o.number(4)[:, None] - low)
    curved = np.column_stack([_table_at(table, x[:, k], True)[:, k] for k in range(3)])
    if o.mode & TABLE_FLAG:
        below = table[0, :3] + (table[0, :3] - table[1, :3]) * -x * (rows - 1)
        above = table[-1, :3] + (table[-1, :3] - table[-2, :3]) * (x - 1.0) * (rows - 1)
        curved = np.where(x < 0.0, below, np.where(x > 1.0, above, curved))
    return _mixed(color, curved, o.number(0)[:, None])


def _adjust_hsv(o: Operands) -> Float64:
    color, by = o.vector(0), o.vector(1)
    old = rgb_to_hsv(color)
    hue = old[:, 0] + by[:, 0] + 0.5
    new = np.column_stack(
        [hue - np.floor(hue), np.clip(old[:, 1] * by[:, 1], 0.0, 1.0), old[:, 2] * by[:, 2]]
    )
    return np.maximum(_mixed(color, hsv_to_rgb(new), o.number(2)[:, None]), 0.0)


def _contrast(o: Operands) -> Float64:
    contrast = o.number(2)[:, None]
    return np.maximum(o.vector(0) * (1.0 + contrast) + o.number(1)[:, None] - contrast * 0.5, 0.0)


def _gamma(o: Operands) -> Float64:
    color, gamma = o.vector(0), o.number(1)[:, None]
    lit = np.where(color > 0.0, np.power(np.where(color > 0.0, color, 1.0), gamma), color)
    return np.where(gamma == 0.0, 1.0, lit)


_SEPARATE = dict(zip(COLOR_MODELS, (np.array, rgb_to_hsv, rgb_to_hsl), strict=True))
_COMBINE = dict(zip(COLOR_MODELS, (np.array, hsv_to_rgb, hsl_to_rgb), strict=True))


def _combine(o: Operands) -> Float64:
    return _COMBINE[COLOR_MODELS[o.mode]](np.column_stack([o.number(k) for k in range(3)]))


COLOR_OPS: dict[str, Callable[[Operands], Float64]] = {
    "blend": _blend,
    "ramp": _ramp,
    "curves": _curves,
    "adjust_hsv": _adjust_hsv,
    "contrast": _contrast,
    "invert": lambda o: _mixed(o.vector(0), 1.0 - o.vector(0), o.number(1)[:, None]),
    "gamma": _gamma,
    "separate": lambda o: _SEPARATE[COLOR_MODELS[o.mode]](o.vector(0)),
    "combine": _combine,
    "grey": lambda o: np.repeat((o.vector(0) @ LUMINANCE)[:, None], 3, axis=1),
}
