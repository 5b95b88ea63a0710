"""Vectors, frames and directions of the reference renderer, on float64 arrays of n rows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .scene_arrays import Float64


def dot(a: Float64, b: Float64) -> Float64:
    """(n,) scalar products of the rows."""
    return np.einsum("ij,ij->i", a, b)


def normalize(a: Float64) -> Float64:
    """Rows divided by their length; a row of length 0 stays 0."""
    length = np.linalg.norm(a, axis=-1, keepdims=True)
    return a / np.where(length > 0.0, length, 1.0)


@dataclass(frozen=True, slots=True)
class Frame:
    """Orthonormal frames, one a row; `n` is the local z axis."""

    s: Float64
    t: Float64
    n: Float64

    def to_local(self, v: Float64) -> Float64:
        return np.stack([dot(v, self.s), dot(v, self.t), dot(v, self.n)], axis=1)

    def to_world(self, v: Float64) -> Float64:
        return v[:, 0:1] * self.s + v[:, 1:2] * self.t + v[:, 2:3] * self.n


def build_frame(n: Float64) -> Frame:
    """Any frame around the unit vectors `n` (n, 3)."""
    helper = np.where(np.abs(n[:, 0:1]) > 0.5, [[0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0]])
    s = normalize(np.cross(helper, n))
    return Frame(s, np.cross(n, s), n)


def sample_cosine(rng: np.random.Generator, count: int) -> Float64:
    """(count, 3) local directions with density cos / pi."""
    radius_squared = rng.random(count)
    phi = 2.0 * np.pi * rng.random(count)
    radius = np.sqrt(radius_squared)
    return np.stack([radius * np.cos(phi), radius * np.sin(phi), np.sqrt(1.0 - radius_squared)], axis=1)


def sample_cone(rng: np.random.Generator, one_minus_cos: Float64) -> Float64:
    """Local directions spread evenly over cones about z; `one_minus_cos` (n,) tells their half angles."""
    drop = rng.random(len(one_minus_cos)) * one_minus_cos
    phi = 2.0 * np.pi * rng.random(len(one_minus_cos))
    sine = np.sqrt(np.maximum(0.0, drop * (2.0 - drop)))
    return np.stack([sine * np.cos(phi), sine * np.sin(phi), 1.0 - drop], axis=1)


def cone_solid_angle(one_minus_cos: Float64) -> Float64:
    """Solid angle in steradians of cones whose half angle has the given 1 - cos."""
    return 2.0 * np.pi * one_minus_cos


def mis_weight(own: Float64, other: Float64) -> Float64:
    """Power heuristic with exponent 2 (Veach 1997, 9.2.4); `own` may be inf (a delta): weight 1."""
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = np.where(np.isinf(own), 0.0, other / np.where(own > 0.0, own, np.nan))
    return np.nan_to_num(1.0 / (1.0 + ratio * ratio), nan=0.0)
