"""Spheres and planes of the reference renderer, met in float64 beside Embree's triangles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .reference_math import dot, normalize
from .scene_arrays import Float64, InstanceArrays, SceneArrays


@dataclass(frozen=True, slots=True)
class Shape:
    """One placed shape; it is a row of Triangles that has no area."""

    kind: str
    linear: Float64
    """(3, 3) of its object to world"""
    translation: Float64
    inverse: Float64
    """of `linear`"""
    material: int
    copy: int
    """which of the scene's copies of meshes it is"""


@dataclass(frozen=True, slots=True)
class ShapeHits:
    t: Float64
    """(n,) inf for a miss"""
    u: Float64
    v: Float64


@dataclass(frozen=True, slots=True)
class ShapePoints:
    """Points of one shape with given coordinates, in the world."""

    position: Float64
    outside: Float64
    """(n, 3) unit normals"""


def each_copy(scene: SceneArrays) -> Iterator[tuple[InstanceArrays, Float64]]:
    """Every copy of a mesh with its (3, 4) object to world, over all instances."""
    for one in scene.instances:
        for transform in np.asarray(one.transforms, dtype=np.float64):
            yield one, transform


def place_shapes(scene: SceneArrays) -> Iterator[Shape]:
    for copy, (one, transform) in enumerate(each_copy(scene)):
        kind = scene.meshes[one.mesh].shape
        if kind != "triangles":
            linear = transform[:, :3]
            material = int(one.slot_materials[0])
            yield Shape(kind, linear, transform[:, 3], np.linalg.inv(linear), material, copy)


def meet_shape(shape: Shape, origin: Float64, direction: Float64, far: Float64) -> ShapeHits:
    """The nearest hits within (0, far) of rays (n, 3)."""
    o = (origin - shape.translation) @ shape.inverse.T
    d = direction @ shape.inverse.T
    with np.errstate(divide="ignore", invalid="ignore"):
        roots = _meet_sphere(o, d) if shape.kind == "sphere" else [-o[:, 2] / d[:, 2]]
        t = np.full(len(o), np.inf)
        for root in reversed(roots):
            t = np.where((root > 0.0) & (root < far), root, t)
        p = o + np.where(np.isfinite(t), t, 0.0)[:, None] * d
    if shape.kind == "plane":
        return ShapeHits(t, p[:, 0], p[:, 1])
    u = np.arctan2(p[:, 0], -p[:, 1]) / (2.0 * np.pi)
    v = 0.5 + np.arctan2(p[:, 2], np.hypot(p[:, 0], p[:, 1])) / np.pi
    return ShapeHits(t, u % 1.0, v)


def shape_points(shape: Shape, u: Float64, v: Float64) -> ShapePoints:
    """The inverse of the coordinates that `meet_shape` gives."""
    if shape.kind == "plane":
        local = np.stack([u, v, np.zeros_like(u)], axis=1)
        normals = np.tile([0.0, 0.0, 1.0], (len(u), 1))
    else:
        height, turn = (v - 0.5) * np.pi, 2.0 * np.pi * u
        across = np.cos(height)
        local = normals = np.stack([across * np.sin(turn), -across * np.cos(turn), np.sin(height)], axis=1)
    position = local @ shape.linear.T + shape.translation
    return ShapePoints(position, normalize(normals @ shape.inverse))


def _meet_sphere(o: Float64, d: Float64) -> list[NDArray[np.float64]]:
    """Both distances, the nearer one first; NaN for a miss."""
    dd = dot(d, d)
    middle = -dot(o, d) / dd
    q = o + middle[:, None] * d
    half = np.sqrt((1.0 - dot(q, q)) / dd)
    return [middle - half, middle + half]
