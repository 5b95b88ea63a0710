"""What `auto` loses against the best accelerator: build and trace of every kind, for few and many rays.

Usage: python -m benchmarks.accel_choice [--repeats N]. One thread; best of N. Prints nanoseconds a
triangle and a ray of every kind, and the regret of the choice; ends with the mean and the worst.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import dataclass

import numpy as np

from tests.native.meshes import ACCELS, Float32, Mesh, icosphere, mesh_of, random_rays, soup
from trg_blender.engine.native import RayScene

RAY_COUNTS = (10, 1_000, 100_000, 10_000_000)
SAMPLE = 20_000
"""rays that are traced to learn what one costs"""
MOST_BRUTE = 100_000
"""triangles above which `none` is measured with few rays"""


@dataclass(frozen=True)
class Cost:
    build: float
    ray: float

    def total(self, rays: int) -> float:
        return self.build + rays * self.ray


def stadium() -> Mesh:
    """A small dense ball in the middle of a wide field of large triangles."""
    ball, field = icosphere(5, 0.01, 0.5), soup(2000, 0.3, seed=1)
    vertices = np.concatenate([ball.vertices, field.vertices]).astype(np.float64)
    return mesh_of(vertices, np.concatenate([ball.triangles, field.triangles + len(ball.vertices)]))


SCENES = {
    "soup12": soup(12, 0.5, seed=1),
    "soup60": soup(60, 0.3, seed=1),
    "soup300": soup(300, 0.2, seed=1),
    "soup3000": soup(3000, 0.1, seed=1),
    "soup30000": soup(30_000, 0.04, seed=1),
    "ball5120": icosphere(4, 0.5, 0.5),
    "ball81920": icosphere(6, 0.5, 0.5),
    "stadium": stadium(),
    "soup300000": soup(300_000, 0.015, seed=1),
}


def measure(mesh: Mesh, accel: str, rays: tuple[Float32, Float32], repeats: int) -> Cost:
    build = ray = np.inf
    few = max(20, SAMPLE * MOST_BRUTE // max(len(mesh.triangles), 1) // 200)
    count = min(SAMPLE, few) if accel == "none" else SAMPLE
    origins, directions = rays[0][:count], rays[1][:count]
    for _ in range(repeats):
        scene = RayScene(accel)
        scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
        build = min(build, scene.build(1).seconds)
        start = time.perf_counter()
        scene.intersect(origins, directions, threads=1)
        ray = min(ray, (time.perf_counter() - start) / count)
    return Cost(build, ray)


def chosen(mesh: Mesh, rays: int) -> str:
    scene = RayScene("auto")
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    return scene.build(1, rays).accel


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=3)
    arguments = parser.parse_args()
    regrets = []
    for name, mesh in SCENES.items():
        rays = random_rays(SAMPLE, seed=2)
        costs = {accel: measure(mesh, accel, rays, arguments.repeats) for accel in ACCELS}
        parts = [
            f"{accel} {1e9 * cost.build / len(mesh.triangles):.0f} / {1e9 * cost.ray:.0f}"
            for accel, cost in costs.items()
        ]
        sys.stdout.write(f"{name}: ns a triangle / ns a ray: {', '.join(parts)}\n")
        for count in RAY_COUNTS:
            totals = {accel: cost.total(count) for accel, cost in costs.items()}
            best, choice = min(totals, key=totals.__getitem__), chosen(mesh, count)
            regrets.append(totals[choice] / totals[best] - 1)
            sys.stdout.write(f"  {count:>9} rays: {choice}, best {best}, regret {regrets[-1]:.1%}\n")
    sys.stdout.write(f"mean regret {np.mean(regrets):.1%}, worst {max(regrets):.1%}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
