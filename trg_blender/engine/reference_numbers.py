"""Instructions of numbers and vectors over arrays of points: Blender's Math, Vector Math, Map Range."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .reference_colors import Operands
from .reference_math import normalize
from .reference_patterns import smooth_step
from .scene_arrays import Float64
from .texture_ops import MAPPINGS, MATH_OPERATIONS, PROJECTIONS, RANGES, VECTOR_MODES, VECTOR_OPERATIONS


def divide_safe(a: Float64, b: Float64) -> Float64:
    return np.where(b != 0.0, a / np.where(b != 0.0, b, 1.0), 0.0)


def _power(a: Float64, b: Float64) -> Float64:
    plain = np.where(a < 0.0, (b == np.trunc(b)), True) & (a != 0.0)
    return np.where(b == 0.0, 1.0, np.where(plain, np.power(np.where(plain, a, 1.0), b), 0.0))


def _logarithm(a: Float64, b: Float64) -> Float64:
    good = (a > 0.0) & (b > 0.0)
    return np.where(good, divide_safe(np.log(np.where(good, a, 1.0)), np.log(np.where(good, b, 2.0))), 0.0)


def _smooth_minimum(a: Float64, b: Float64, k: Float64) -> Float64:
    h = np.maximum(k - np.abs(a - b), 0.0) / np.where(k != 0.0, k, 1.0)
    return np.minimum(a, b) - np.where(k != 0.0, h**3 * k / 6.0, 0.0)


def _wrap(a: Float64, high: Float64, low: Float64) -> Float64:
    span = high - low
    return np.where(span != 0.0, a - span * np.floor((a - low) / np.where(span != 0.0, span, 1.0)), low)


def _ping_pong(a: Float64, b: Float64) -> Float64:
    x = divide_safe(a - b, b * 2.0)
    return np.where(b != 0.0, np.abs((x - np.floor(x)) * b * 2.0 - b), 0.0)


def _compare(a: Float64, b: Float64, c: Float64) -> Float64:
    return ((a == b) | (np.abs(a - b) <= np.maximum(c, 1.1920929e-7))).astype(np.float64)


_MATH: dict[str, Callable[[Float64, Float64, Float64], Float64]] = {
    "ADD": lambda a, b, c: a + b,
    "SUBTRACT": lambda a, b, c: a - b,
    "MULTIPLY": lambda a, b, c: a * b,
    "DIVIDE": lambda a, b, c: divide_safe(a, b),
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b, c: _power(a, b),
    "LOGARITHM": lambda a, b, c: _logarithm(a, b),
    "SQRT": lambda a, b, c: np.sqrt(np.maximum(a, 0.0)),
    "INVERSE_SQRT": lambda a, b, c: np.where(a > 0.0, 1.0 / np.sqrt(np.where(a > 0.0, a, 1.0)), 0.0),
    "ABSOLUTE": lambda a, b, c: np.abs(a),
    "EXPONENT": lambda a, b, c: np.exp(a),
    "MINIMUM": lambda a, b, c: np.minimum(a, b),
    "MAXIMUM": lambda a, b, c: np.maximum(a, b),
    "LESS_THAN": lambda a, b, c: (a < b).astype(np.float64),
    "GREATER_THAN": lambda a, b, c: (a > b).astype(np.float64),
    "SIGN": lambda a, b, c: np.sign(a),
    "COMPARE": _compare,
    "SMOOTH_MIN": _smooth_minimum,
    "SMOOTH_MAX": lambda a, b, c: -_smooth_minimum(-a, -b, c),
    "ROUND": lambda a, b, c: np.floor(a + 0.5),
    "FLOOR": lambda a, b, c: np.floor(a),
    "CEIL": lambda a, b, c: np.ceil(a),
    "TRUNC": lambda a, b, c: np.trunc(a),
    "FRACT": lambda a, b, c: a - np.floor(a),
    "MODULO": lambda a, b, c: np.where(b != 0.0, np.fmod(a, np.where(b != 0.0, b, 1.0)), 0.0),
    "FLOORED_MODULO": lambda a, b, c: np.where(b != 0.0, a - np.floor(divide_safe(a, b)) * b, 0.0),
    "WRAP": _wrap,
    "SNAP": lambda a, b, c: np.floor(divide_safe(a, b)) * b,
    "PINGPONG": lambda a, b, c: _ping_pong(a, b),
    "SINE": lambda a, b, c: np.sin(a),
    "COSINE": lambda a, b, c: np.cos(a),
    "TANGENT": lambda a, b, c: np.tan(a),
    "ARCSINE": lambda a, b, c: np.arcsin(np.clip(a, -1.0, 1.0)),
    "ARCCOSINE": lambda a, b, c: np.arccos(np.clip(a, -1.0, 1.0)),
    "ARCTANGENT": lambda a, b, c: np.arctan(a),
    "ARCTAN2": lambda a, b, c: np.arctan2(a, b),
    "SINH": lambda a, b, c: np.sinh(a),
    "COSH": lambda a, b, c: np.cosh(a),
    "TANH": lambda a, b, c: np.tanh(a),
    "RADIANS": lambda a, b, c: np.radians(a),
    "DEGREES": lambda a, b, c: np.degrees(a),
}


def _math(o: Operands) -> Float64:
    return _MATH[MATH_OPERATIONS[o.mode]](o.number(0), o.number(1), o.number(2))[:, None]


def _dot(a: Float64, b: Float64) -> Float64:
    return (a * b).sum(axis=1, keepdims=True)


def _unit(a: Float64) -> Float64:
    size = np.linalg.norm(a, axis=1, keepdims=True)
    return np.where(size > 0.0, a / np.where(size > 0.0, size, 1.0), 0.0)


def _refract(a: Float64, b: Float64, eta: Float64) -> Float64:
    n = _unit(b)
    c = _dot(n, a)
    k = 1.0 - eta * eta * (1.0 - c * c)
    return np.where(k < 0.0, 0.0, a * eta - n * (eta * c + np.sqrt(np.maximum(k, 0.0))))


_VECTOR: dict[str, Callable[[Float64, Float64, Float64, Float64], Float64]] = {
    "CROSS_PRODUCT": lambda a, b, c, s: np.cross(a, b),
    "PROJECT": lambda a, b, c, s: b * divide_safe(_dot(a, b), _dot(b, b)),
    "REFLECT": lambda a, b, c, s: a - 2.0 * _unit(b) * _dot(a, _unit(b)),
    "REFRACT": lambda a, b, c, s: _refract(a, b, s),
    "FACEFORWARD": lambda a, b, c, s: np.where(_dot(c, b) < 0.0, a, -a),
    "DOT_PRODUCT": lambda a, b, c, s: _dot(a, b),
    "DISTANCE": lambda a, b, c, s: np.linalg.norm(a - b, axis=1, keepdims=True),
    "LENGTH": lambda a, b, c, s: np.linalg.norm(a, axis=1, keepdims=True),
    "SCALE": lambda a, b, c, s: a * s,
    "NORMALIZE": lambda a, b, c, s: _unit(a),
}


def _vector_math(o: Operands) -> Float64:
    a, b, c = o.vector(0), o.vector(1), o.vector(2)
    if o.mode < VECTOR_MODES:
        return _MATH[MATH_OPERATIONS[o.mode]](a, b, c)
    name = VECTOR_OPERATIONS[o.mode - VECTOR_MODES]
    value = _VECTOR[name](a, b, c, o.number(3)[:, None])
    return np.broadcast_to(value, a.shape)


def _ease(low: Float64, high: Float64, x: Float64, smoother: bool) -> Float64:
    t = np.clip(divide_safe(x - low, high - low), 0.0, 1.0)
    return t**3 * (t * (t * 6.0 - 15.0) + 10.0) if smoother else smooth_step(t)


def _map_range(o: Operands) -> Float64:
    x, low, high, to_low, to_high, steps = (o.vector(k) for k in range(6))
    t, kind = divide_safe(x - low, high - low), RANGES[o.mode]
    if kind == "STEPPED":
        t = np.where(steps > 0.0, divide_safe(np.floor(t * (steps + 1.0)), steps), 0.0)
    if kind in ("SMOOTHSTEP", "SMOOTHERSTEP"):
        smoother = kind == "SMOOTHERSTEP"
        t = np.where(low > high, 1.0 - _ease(high, low, x, smoother), _ease(low, high, x, smoother))
    return np.where(low != high, to_low + t * (to_high - to_low), 0.0)


def rotate_euler(v: Float64, angles: Float64, backwards: bool) -> Float64:
    """About x, then y, then z; `backwards` undoes it."""
    (cx, cy, cz), (sx, sy, sz) = np.cos(angles).T, np.sin(angles).T
    rows = np.array(
        [
            [cy * cz, sy * sx * cz - cx * sz, sy * cx * cz + sx * sz],
            [cy * sz, sy * sx * sz + cx * cz, sy * cx * sz - sx * cz],
            [-sy, cy * sx, cy * cx],
        ]
    )
    return np.einsum("jin,nj->ni" if backwards else "ijn,nj->ni", rows, v)


def _mapping(o: Operands) -> Float64:
    v, location, rotation, scale = (o.vector(k) for k in range(4))
    kind = MAPPINGS[o.mode]
    if kind == "TEXTURE":
        return divide_safe(rotate_euler(v - location, rotation, True), scale)
    if kind == "NORMAL":
        return normalize(rotate_euler(divide_safe(v, scale), rotation, False))
    turned = rotate_euler(v * scale, rotation, False)
    return turned + location if kind == "POINT" else turned


def _affine(o: Operands) -> Float64:
    rows = o.table(1, 12).reshape(3, 4)
    return o.vector(0) @ rows[:, :3].T + rows[:, 3]


def _project(o: Operands) -> Float64:
    p = o.vector(0) * 2.0 - 1.0
    x, y, z = p.T
    across = np.hypot(x, y)
    if PROJECTIONS[o.mode] == "tube":
        flat = np.column_stack([0.5 * (1.0 - np.arctan2(x, y) / np.pi), 0.5 * (z + 1.0), 0.0 * z])
        return np.where((across > 0.0)[:, None], flat, 0.0)
    size = np.linalg.norm(p, axis=1)
    u = np.where(across > 0.0, 0.5 - np.arctan2(x, y) / (2.0 * np.pi), 0.0)
    v = 1.0 - np.arccos(np.clip(divide_safe(z, size), -1.0, 1.0)) / np.pi
    return np.where((size > 0.0)[:, None], np.column_stack([u, v, 0.0 * z]), 0.0)


def _clamp(o: Operands) -> Float64:
    low, high = o.vector(1), o.vector(2)
    return np.clip(o.vector(0), np.minimum(low, high), np.maximum(low, high))


NUMBER_OPS: dict[str, Callable[[Operands], Float64]] = {
    "copy": lambda o: np.column_stack([o.number(k) for k in range(3)]),
    "math": _math,
    "vector_math": _vector_math,
    "map_range": _map_range,
    "mapping": _mapping,
    "affine": _affine,
    "project": _project,
    "clamp": _clamp,
}
