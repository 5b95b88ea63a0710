"""Meshes and rays of the ray rows and ray tests, all closed-form or seeded."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..engine.native import Hits, RayScene
from .embree_rays import EmbreeRays

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
Int32 = NDArray[np.int32]
ACCELS = ("none", "bvh", "grid", "grid2", "tree")
INDICES = ACCELS[1:]
"""those that build something"""


@dataclass(frozen=True)
class Mesh:
    vertices: Float32
    triangles: Int32


def mesh_of(vertices: Float64, triangles: Int32) -> Mesh:
    return Mesh(np.ascontiguousarray(vertices, dtype=np.float32), np.ascontiguousarray(triangles, np.int32))


def icosphere(levels: int, scale: float = 1.0, offset: float = 0.0) -> Mesh:
    """Closed sphere of 20 * 4^levels triangles about (offset, offset, offset)."""
    golden = (1 + 5**0.5) / 2
    corners = [(0, a, b) for a in (-1, 1) for b in (-golden, golden)]
    vertices = [np.roll(c, k) for k in range(3) for c in corners]
    vertices = [v / np.linalg.norm(v) for v in vertices]
    edge = min(np.linalg.norm(vertices[0] - v) for v in vertices[1:]) * 1.01
    near = [[np.linalg.norm(a - b) < edge for b in vertices] for a in vertices]
    triangles = [
        (a, b, c)
        for a in range(12)
        for b in range(a + 1, 12)
        for c in range(b + 1, 12)
        if near[a][b] and near[b][c] and near[a][c]
    ]
    for _ in range(levels):
        triangles = _subdivide(vertices, triangles)
    return mesh_of(np.array(vertices) * scale + offset, np.array(triangles))


def _subdivide(vertices: list[Float64], triangles: list[tuple[int, int, int]]) -> list[tuple[int, int, int]]:
    middles: dict[tuple[int, int], int] = {}

    def middle(a: int, b: int) -> int:
        key = (min(a, b), max(a, b))
        if key not in middles:
            point = vertices[a] + vertices[b]
            vertices.append(point / np.linalg.norm(point))
            middles[key] = len(vertices) - 1
        return middles[key]

    result = []
    for a, b, c in triangles:
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        result += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return result


def cube() -> Mesh:
    """Blender's default cube: corners at -1 and 1."""
    vertices = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return mesh_of(vertices, np.array(triangles))


def soup(count: int, size: float, seed: int) -> Mesh:
    """Random triangles about `size` wide in the unit cube."""
    rng = np.random.default_rng(seed)
    corners = rng.random((count, 1, 3)) + size * (rng.random((count, 3, 3)) - 0.5)
    return mesh_of(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


def bipyramid(count: int, radius: float) -> Mesh:
    """Closed fan of 2 `count` slivers between two apexes."""
    angles = 2 * np.pi * np.arange(count) / count
    rim = np.stack([radius * np.cos(angles), radius * np.sin(angles), 0 * angles], axis=1)
    vertices = np.concatenate([rim, [[0, 0, 1], [0, 0, -1]]])
    k, after = np.arange(count), (np.arange(count) + 1) % count
    upper = np.stack([k, after, np.full(count, count)], axis=1)
    lower = np.stack([after, k, np.full(count, count + 1)], axis=1)
    return mesh_of(vertices, np.concatenate([upper, lower]))


def random_rays(count: int, seed: int, spread: float = 2.0) -> tuple[Float32, Float32]:
    """Rays from about the unit cube towards points in it."""
    rng = np.random.default_rng(seed)
    origins = (rng.random((count, 3)) - 0.5) * 2 * spread + 0.5
    targets = rng.random((count, 3))
    return origins.astype(np.float32), (targets - origins).astype(np.float32)


def scene_of(mesh: Mesh, accel: str = "bvh", triangle_test: str = "watertight") -> RayScene | EmbreeRays:
    """A built scene of one mesh that stands where it is; `embree` is the robust mode of Embree."""
    if accel == "embree":
        return EmbreeRays(mesh.vertices, mesh.triangles)
    scene = RayScene(accel, triangle_test)
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    scene.build()
    return scene


def brute_force(mesh: Mesh, origins: Float32, directions: Float32) -> tuple[Float64, Int32, Float64]:
    """Nearest t (inf: miss) and triangle (-1) by Moeller and Trumbore in float64, and how far the
    nearest decision was from the other one (the least |u|, |v|, |1 - u - v| over all triangles)."""
    corners = mesh.vertices.astype(np.float64)[mesh.triangles]
    p0, e1, e2 = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    best = np.full(len(origins), np.inf)
    triangle = np.full(len(origins), -1, np.int32)
    margin = np.full(len(origins), np.inf)
    for row, (o, d) in enumerate(zip(origins.astype(np.float64), directions.astype(np.float64), strict=True)):
        p, s = np.cross(d, e2), o - p0
        q = np.cross(s, e1)
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = 1 / np.einsum("ij,ij->i", e1, p)
            u, v = np.einsum("ij,ij->i", s, p) * scale, (q @ d) * scale
            t = np.einsum("ij,ij->i", e2, q) * scale
        inside = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
        margin[row] = np.nanmin(np.minimum(np.minimum(abs(u), abs(v)), abs(1 - u - v)))
        if inside.any():
            triangle[row] = np.argmin(np.where(inside, t, np.inf))
            best[row] = t[triangle[row]]
    return best, triangle, margin


def same_hits(a: Hits, b: Hits) -> bool:
    """Every number of both equal, bit by bit."""
    pairs = ((a.t, b.t), (a.u, b.u), (a.v, b.v), (a.triangle, b.triangle), (a.instance, b.instance))
    return all(np.array_equal(x, y) for x, y in pairs)


def edge_and_vertex_rays(
    mesh: Mesh, count: int, seed: int, edge_share: float = 0.5
) -> tuple[Float32, Float32]:
    """Rays from inside a star-shaped mesh at points of its edges (the first of them) and at its vertices."""
    rng = np.random.default_rng(seed)
    vertices = mesh.vertices.astype(np.float64)
    centre = vertices.mean(axis=0)
    size = np.linalg.norm(vertices - centre, axis=1).min()
    inner = (centre + 0.3 * size * (rng.random((16, 3)) - 0.5)).astype(np.float32)
    origins = inner[rng.integers(16, size=count)]
    edges = np.concatenate([mesh.triangles[:, [0, 1]], mesh.triangles[:, [1, 2]], mesh.triangles[:, [2, 0]]])
    chosen = vertices[edges[rng.integers(len(edges), size=count)]]
    along = rng.random((count, 1))
    along[int(count * edge_share) :] = 0
    targets = chosen[:, 0] * (1 - along) + chosen[:, 1] * along
    return origins, (targets - origins).astype(np.float32)
