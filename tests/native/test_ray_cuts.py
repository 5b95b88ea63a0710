"""Trees that cut long slanted triangles answer like everything else."""

from __future__ import annotations

import numpy as np

from trg_blender.engine.native import RayScene

from .meshes import Mesh, mesh_of, random_rays, scene_of


def bars(count: int, seed: int) -> Mesh:
    """`count` thin square prisms, closed, at all angles, as long as the scene: boxes overlap everywhere."""
    rng = np.random.default_rng(seed)
    axes = rng.normal(size=(count, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    first = np.cross(axes, rng.normal(size=(count, 3)))
    first *= 0.01 / np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(axes, first)
    centres = rng.uniform(-1, 1, (count, 3))
    signs = [(a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    corners = np.stack([centres + a * axes + b * first + c * second for a, b, c in signs], axis=1)
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    one = np.array([t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))])
    return mesh_of(corners.reshape(-1, 3), (one + 8 * np.arange(count)[:, None, None]).reshape(-1, 3))


def built(mesh: Mesh, threads: int) -> tuple[RayScene, int]:
    scene = RayScene("bvh")
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    return scene, scene.build(threads).bytes


def test_cut_triangles_are_hit_where_whole_ones_are():
    mesh = bars(150, seed=1)
    origins, directions = random_rays(20000, seed=2)
    found, expected = (scene_of(mesh, accel).intersect(origins, directions) for accel in ("bvh", "none"))
    for name in ("t", "u", "v", "triangle"):
        assert np.array_equal(getattr(found, name), getattr(expected, name)), name
    assert (found.triangle >= 0).sum() > 3000


def test_rays_at_corners_and_edges_of_cut_triangles_meet_what_trying_each_meets():
    mesh = bars(150, seed=3)
    rng = np.random.default_rng(4)
    corners = mesh.vertices[mesh.triangles[rng.integers(0, len(mesh.triangles), 20000)]].astype(np.float64)
    share = np.where(rng.random((20000, 1)) < 0.5, 1.0, rng.random((20000, 1)))
    origins = rng.uniform(-3, 3, (20000, 3)).astype(np.float32)
    directions = (corners[:, 0] * share + corners[:, 1] * (1 - share) - origins).astype(np.float32)
    found, expected = (scene_of(mesh, accel).intersect(origins, directions) for accel in ("bvh", "none"))
    assert np.array_equal(found.triangle, expected.triangle)
    assert np.array_equal(found.t, expected.t)


def test_cutting_does_not_depend_on_the_number_of_threads():
    mesh = bars(3000, seed=5)
    origins, directions = random_rays(4000, seed=6)
    (one, one_bytes), (two, two_bytes) = (built(mesh, threads) for threads in (1, 2))
    assert one_bytes == two_bytes
    a, b = (scene.intersect(origins, directions) for scene in (one, two))
    for name in ("t", "u", "v", "triangle"):
        assert np.array_equal(getattr(a, name), getattr(b, name)), name


def test_cuts_grow_a_tree_by_less_than_half():
    mesh = bars(3000, seed=7)
    _scene, size = built(mesh, 2)
    assert size / len(mesh.triangles) < 100
