"""Meshes and rays of the ray benchmarks.

Scenes come from `../shared`: closed-form ones from `peers/make_scenes.py`, real ones from
`data/scenes`; models (G3DM) from wherever the caller says.
"""

from __future__ import annotations

import contextlib
import importlib.util
import io
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[1]
SHARED = Path(os.environ.get("TRG_SHARED", ROOT.parent / "shared"))
Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
Int32 = NDArray[np.int32]
SYNTHETIC = ("flake12k", "arch", "torus1m", "hairball")
REAL = ("sponza", "stadium", "dragon")
SCENES = ("flake12k", "sponza", "stadium", "arch", "dragon", "torus1m", "hairball")
SELF_HIT_OFFSET = 1e-4


@dataclass(frozen=True)
class Mesh:
    vertices: Float32
    """(n, 3)"""
    triangles: Int32
    """(m, 3)"""
    camera: Float64
    """eye, target, up (3 each), vertical angle of view in degrees"""
    light: Float64
    """centre and radius of a spherical light"""


@dataclass(frozen=True)
class Rays:
    name: str
    origins: Float32
    directions: Float32
    t_min: Float32
    t_max: Float32
    shadow: bool = False
    """any hit will do"""


@dataclass(frozen=True)
class Results:
    """What a query fills, for n rays."""

    t: Float32
    u: Float32
    v: Float32
    triangle: Int32
    instance: Int32
    hidden: NDArray[np.uint8]


def empty_results(count: int) -> Results:
    t, u, v = np.zeros((3, count), np.float32)
    triangle, instance = np.zeros((2, count), np.int32)
    return Results(t, u, v, triangle, instance, np.zeros(count, np.uint8))


def read_scene(name: str, folder: Path) -> Mesh:
    """The mesh of one of SCENES. `folder` keeps what is computed. Raises FileNotFoundError."""
    path = SHARED / "data/scenes" / f"{name}.npz"
    if name in SYNTHETIC:
        path = folder / f"{name}.npz"
        if not path.exists():
            folder.mkdir(parents=True, exist_ok=True)
            _make_scene(name, folder)
    with np.load(path) as arrays:
        return Mesh(
            np.ascontiguousarray(arrays["V"], np.float32),
            np.ascontiguousarray(arrays["F"], np.int32),
            arrays["cam"].astype(np.float64),
            arrays["light"].astype(np.float64),
        )


def _make_scene(name: str, folder: Path) -> None:
    path = SHARED / "peers/make_scenes.py"
    if not path.exists():
        raise FileNotFoundError(f"{path} is needed to build {name}")
    spec = importlib.util.spec_from_file_location("make_scenes", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.HERE = str(folder)
    with contextlib.redirect_stdout(io.StringIO()):
        getattr(module, name)()
    (folder / f"{name}.mesh").unlink(missing_ok=True)


def read_g3dm(path: Path) -> Mesh:
    """All triangles of a G3DM file, materials left aside, seen from outside."""
    data = path.read_bytes()
    count = int(np.frombuffer(data, "<u4", 1, 4)[0])
    offset, base = 16, 0
    vertices, triangles = [], []
    for _ in range(count):
        vertex_count, index_count, _material = np.frombuffer(data, "<i4", 3, offset)
        offset += 12
        rows = np.frombuffer(data, "<f4", vertex_count * 12, offset).reshape(-1, 12)
        offset += 48 * int(vertex_count)
        indices = np.frombuffer(data, "<i4", index_count, offset).reshape(-1, 3)
        offset += 4 * int(index_count)
        vertices.append(rows[:, :3])
        triangles.append(indices + base)
        base += int(vertex_count)
    points = np.ascontiguousarray(np.concatenate(vertices), dtype=np.float32)
    low, high = points.min(axis=0).astype(float), points.max(axis=0).astype(float)
    centre, size = (low + high) / 2, float(np.linalg.norm(high - low))
    eye = centre + size * np.array([0.55, 0.35, 0.75])
    camera = np.array([*eye, *centre, 0.0, 1.0, 0.0, 45.0])
    light = np.array([*(centre + size * np.array([1.0, 2.0, 1.0])), size / 10])
    return Mesh(points, np.ascontiguousarray(np.concatenate(triangles), dtype=np.int32), camera, light)


def _make_rays(name: str, origins: Float64, directions: Float64, t_max: float = np.inf) -> Rays:
    count = len(origins)
    return Rays(
        name,
        np.ascontiguousarray(origins, np.float32),
        np.ascontiguousarray(directions, np.float32),
        np.zeros(count, np.float32),
        np.full(count, t_max, np.float32),
        shadow=np.isfinite(t_max),
    )


def primary_rays(mesh: Mesh, count: int) -> Rays:
    """One ray through the centre of each pixel of a square picture, in tiles of 4 x 4 pixels."""
    side = int(np.sqrt(count)) // 4 * 4
    eye, target, up = mesh.camera[0:3], mesh.camera[3:6], mesh.camera[6:9]
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    above = np.cross(right, forward)
    at = ((np.arange(side) + 0.5) / side * 2 - 1) * np.tan(np.radians(mesh.camera[9]) / 2)
    pixel = np.arange(side * side).reshape(side // 4, 4, side // 4, 4).transpose(0, 2, 1, 3).reshape(-1)
    x, y = at[pixel % side], at[pixel // side]
    directions = forward + x[:, None] * right + y[:, None] * above
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return _make_rays("primary", np.broadcast_to(eye, directions.shape), directions)


def _surface_points(mesh: Mesh, rays: Rays, results: Results) -> tuple[Float64, Float64]:
    """Points just off the surfaces met, on the side seen, and normals; in the rays' order."""
    met = np.flatnonzero(results.triangle >= 0)
    corners = mesh.vertices[mesh.triangles[results.triangle[met]]].astype(np.float64)
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normals = np.cross(first, second)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    towards = np.einsum("ij,ij->i", normals, rays.directions[met].astype(np.float64))
    normals[towards > 0] *= -1
    u, v = results.u[met, None].astype(float), results.v[met, None].astype(float)
    size = np.abs(corners).max(axis=(1, 2))[:, None]
    return corners[:, 0] + u * first + v * second + SELF_HIT_OFFSET * np.maximum(size, 1) * normals, normals


def bounce_rays(name: str, mesh: Mesh, rays: Rays, results: Results) -> Rays:
    """Cosine-distributed rays from what `rays` met, in the same order."""
    points, normals = _surface_points(mesh, rays, results)
    scatter = np.random.default_rng(1).normal(size=normals.shape)
    scatter /= np.linalg.norm(scatter, axis=1, keepdims=True)
    directions = normals * 1.0001 + scatter
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return _make_rays(name, points, directions)


def shadow_rays(name: str, mesh: Mesh, rays: Rays, results: Results) -> Rays:
    """Rays from what `rays` met to random points of the light; they end just before it."""
    points, _normals = _surface_points(mesh, rays, results)
    at = np.random.default_rng(2).normal(size=points.shape)
    at *= mesh.light[3] / np.linalg.norm(at, axis=1, keepdims=True)
    return _make_rays(name, points, mesh.light[:3] + at - points, 1 - SELF_HIT_OFFSET)


def ray_sets(mesh: Mesh, count: int, trace: Callable[[Rays], Results]) -> list[Rays]:
    """Primary, first and second diffuse, first and second shadow rays; `trace` gives nearest hits."""
    primary = primary_rays(mesh, count)
    seen = trace(primary)
    first = bounce_rays("diffuse1", mesh, primary, seen)
    met = trace(first)
    return [
        primary,
        shadow_rays("shadow1", mesh, primary, seen),
        first,
        shadow_rays("shadow2", mesh, first, met),
        bounce_rays("diffuse2", mesh, first, met),
    ]
