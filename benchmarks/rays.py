"""Rays per second of the native core against Embree (embreex), one thread each.

Usage: python -m benchmarks.rays [MODEL.g3dm | MODEL.npz ...] [--rays N] [--rounds N] [--accel bvh]

Runs of the two are interleaved, so that a busy machine slows both; the ratio is the median over the
rounds of native / embreex, with the quartiles as its spread.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parents[1]
SHARED = Path(os.environ.get("TRG_SHARED", ROOT.parent / "shared"))
Float32 = NDArray[np.float32]
Int32 = NDArray[np.int32]


@dataclass(frozen=True)
class Mesh:
    vertices: Float32
    triangles: Int32


@dataclass(frozen=True)
class Rays:
    name: str
    origins: Float32
    directions: Float32


def read_g3dm(path: Path) -> Mesh:
    """All triangles of a G3DM file, materials left aside."""
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
    return Mesh(
        np.ascontiguousarray(np.concatenate(vertices), dtype=np.float32),
        np.ascontiguousarray(np.concatenate(triangles), dtype=np.int32),
    )


def read_mesh(path: Path) -> Mesh:
    if path.suffix.lower() == ".g3dm":
        return read_g3dm(path)
    with np.load(path) as arrays:
        by_width = {arrays[k].dtype.kind: arrays[k] for k in arrays.files if arrays[k].ndim == 2}
        return Mesh(
            by_width["f"].astype(np.float32), by_width["i" if "i" in by_width else "u"].astype(np.int32)
        )


def primary_rays(mesh: Mesh, count: int) -> Rays:
    """Rays of a pinhole camera that has the whole mesh in view, row by row."""
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    centre, size = (low + high) / 2, float(np.linalg.norm(high - low))
    eye = centre + size * np.array([0.55, 0.35, 0.75], np.float32)
    forward = (centre - eye) / np.linalg.norm(centre - eye)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    side = int(np.sqrt(count))
    at = (np.arange(side) + 0.5) / side - 0.5
    y, x = np.meshgrid(at, at, indexing="ij")
    directions = forward + 0.9 * (x[..., None] * right + y[..., None] * up)
    directions = np.ascontiguousarray(directions.reshape(-1, 3), dtype=np.float32)
    origins = np.ascontiguousarray(np.broadcast_to(eye, directions.shape), dtype=np.float32)
    return Rays("primary", origins, directions)


def diffuse_rays(mesh: Mesh, primary: Rays, triangles: Int32, seed: int) -> Rays:
    """Rays from the triangles that `primary` met, cosine-distributed on the side seen, in random order.

    `triangles` is what each primary ray met, -1 for nothing; rays start at random points of them.
    """
    rng = np.random.default_rng(seed)
    seen = rng.permutation(np.resize(np.flatnonzero(triangles >= 0), len(triangles)))
    corners = mesh.vertices[mesh.triangles[triangles[seen]]].astype(np.float64)
    u, v = rng.random((2, len(seen), 1))
    fold = u + v > 1
    u, v = np.where(fold, 1 - u, u), np.where(fold, 1 - v, v)
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normals = np.cross(first, second)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    towards = np.einsum("ij,ij->i", normals, primary.directions[seen].astype(np.float64))
    normals[towards > 0] *= -1
    scatter = rng.normal(size=normals.shape)
    scatter /= np.linalg.norm(scatter, axis=1, keepdims=True)
    points = corners[:, 0] + u * first + v * second + 1e-4 * normals
    return Rays("diffuse", points.astype(np.float32), (normals * 1.0001 + scatter).astype(np.float32))


def native_tracer(mesh: Mesh, accel: str) -> Callable[[Rays], Int32]:
    sys.path.insert(0, str(ROOT))
    from trg_blender.engine.native import RayScene

    scene = RayScene(accel)
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    scene.build()
    return lambda rays: scene.intersect(rays.origins, rays.directions, threads=1).triangle


def embree_tracer(mesh: Mesh) -> Callable[[Rays], Int32]:
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh

    scene = rtcore_scene.EmbreeScene()
    TriangleMesh(scene, mesh.vertices, mesh.triangles)
    scene.run(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32))
    return lambda rays: scene.run(rays.origins, rays.directions)


def time_of(tracer: Callable[[Rays], Int32], rays: Rays) -> float:
    """Processor seconds, which a busy machine disturbs less than the clock on the wall."""
    start = time.thread_time()
    tracer(rays)
    return time.thread_time() - start


def compare(tracers: tuple[Callable[[Rays], Int32], Callable[[Rays], Int32]], rays: Rays, rounds: int) -> str:
    """One line: both speeds (best round) and the quartiles of the ratio."""
    times = np.array([[time_of(tracer, rays) for tracer in tracers] for _ in range(rounds + 1)][1:])
    native, embree = len(rays.origins) / times.min(axis=0) / 1e6
    low, median, high = np.quantile(times[:, 1] / times[:, 0], [0.25, 0.5, 0.75])
    agree = float(np.mean(tracers[0](rays) == tracers[1](rays)))
    return (
        f"{rays.name:8} native {native:7.2f} embreex {embree:7.2f} Mrays/s  "
        f"ratio {median:5.2f} [{low:.2f}, {high:.2f}]  same triangle {agree:.5f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="*", type=Path, default=[SHARED / "data/models/cow.g3dm"])
    parser.add_argument("--rays", type=int, default=1 << 19)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--accel", default="bvh")
    arguments = parser.parse_args()
    for path in arguments.models:
        mesh = read_mesh(path)
        tracers = (native_tracer(mesh, arguments.accel), embree_tracer(mesh))
        sys.stdout.write(f"{path.name}: {len(mesh.triangles)} triangles\n")
        primary = primary_rays(mesh, arguments.rays)
        for rays in (primary, diffuse_rays(mesh, primary, tracers[0](primary), 1)):
            sys.stdout.write(compare(tracers, rays, arguments.rounds) + "\n")


if __name__ == "__main__":
    main()
