"""Rates of the catalogue's rows about speed: A09 (a divided grid), A10 (slivers), A11 (time of a build).

    python -m benchmarks.robustness_rates

Best of three on one thread. The catalogue asks for 20 times the flat grid's rate in A09, for a fifth of a
ball's rate in A10 (Embree: 1/20 to 1/40), for less than 2 s in A11.
"""

from __future__ import annotations

import sys
import time

import numpy as np
from numpy.typing import NDArray

from tests.native.meshes import INDICES, Mesh, bipyramid, icosphere, mesh_of, random_rays, scene_of, soup
from trg_blender.engine.native import RayScene

from .robustness_rows import random_inner_rays

Rays = tuple[NDArray[np.float64], NDArray[np.float64]]


def rate(scene: RayScene, rays: Rays) -> float:
    """Rays a second on one thread, best of three."""
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        scene.intersect(*rays, threads=1)
        seconds.append(time.perf_counter() - start)
    return len(rays[0]) / min(seconds)


def teapot_in_stadium() -> tuple[Mesh, Rays]:
    """A fine ball in the middle of a coarse field 10^4 times as wide, and rays."""
    ball, field = icosphere(6, 0.5, 0.5), soup(200, 0.5, seed=2)
    vertices = np.concatenate([ball.vertices, (field.vertices - 0.5) * np.float32([1e4, 1e4, 1])])
    triangles = np.concatenate([ball.triangles, field.triangles + len(ball.vertices)])
    return mesh_of(vertices, triangles), random_rays(2000, seed=3)


def equal_triangles() -> Mesh:
    return mesh_of(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float), np.tile([[0, 1, 2]], (100_000, 1)))


def main() -> int:
    mesh, rays = teapot_in_stadium()
    ratio = rate(scene_of(mesh, "grid2"), rays) / rate(scene_of(mesh, "grid"), rays)
    print(f"A09 grid2 over grid: {ratio:.1f} (20)")
    ball, fan = icosphere(4), bipyramid(2048, 1.0)
    rates = [rate(scene_of(one), random_inner_rays(one, 20_000, seed=4)) for one in (ball, fan)]
    print(f"A10 slivers over a ball: {rates[1] / rates[0]:.3f} (0.2)")
    for accel in INDICES:
        start = time.perf_counter()
        scene_of(equal_triangles(), accel)
        print(f"A11 {accel}: {time.perf_counter() - start:.2f} s (2)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
