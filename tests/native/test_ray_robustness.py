"""Rows of the catalogue of stiff cases that belong to triangles and boxes (ids in the test names)."""

from __future__ import annotations

import numpy as np
import pytest

from .meshes import (
    ACCELS,
    INDICES,
    bipyramid,
    edge_and_vertex_rays,
    icosphere,
    mesh_of,
    random_rays,
    same_hits,
    scene_of,
    soup,
)

RAYS = 100_000


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_g01_g02_nothing_leaks_at_edges_and_vertices_at_any_scale(scale: float):
    mesh = icosphere(4, scale)
    origins, directions = edge_and_vertex_rays(mesh, RAYS, seed=1)
    scene = scene_of(mesh)
    assert (scene.intersect(origins, directions).triangle >= 0).all()
    assert scene.occluded(origins, directions).all()


@pytest.mark.parametrize("offset", [1e2, 1e4, 1e6])
@pytest.mark.parametrize("levels", [2, 4])
def test_g03_nothing_leaks_far_from_the_origin(offset: float, levels: int):
    mesh = icosphere(levels, 1.0, offset)
    if offset == 1e6 and levels == 4:
        mesh = icosphere(levels, 100.0, offset)
    origins, directions = edge_and_vertex_rays(mesh, RAYS, seed=2)
    assert (scene_of(mesh).intersect(origins, directions).triangle >= 0).all()


@pytest.mark.parametrize("radius", [1.0, 1e-3])
@pytest.mark.parametrize("accel", INDICES)
def test_g06_needle_fans_are_closed(radius: float, accel: str):
    mesh = bipyramid(2048, radius)
    origins, directions = edge_and_vertex_rays(mesh, 20_000, seed=3)
    assert (scene_of(mesh, accel).intersect(origins, directions).triangle >= 0).all()


@pytest.mark.parametrize("scale", [1e-15, 1e-9, 1e6, 1e12, 1e15])
def test_g08_g09_tiny_and_huge_triangles_are_hit(scale: float):
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]) * scale
    scene = scene_of(mesh_of(corners, np.array([[0, 1, 2]])))
    rng = np.random.default_rng(4)
    weights = rng.dirichlet([2, 2, 2], 1000)
    targets = weights @ corners
    origins = (targets + np.array([0, 0, scale])).astype(np.float32)
    hits = scene.intersect(origins, np.tile(np.float32([0, 0, -1]), (1000, 1)))
    assert (hits.triangle == 0).all() and np.allclose(hits.t, scale, rtol=1e-6)
    assert max(np.abs(hits.u - weights[:, 1]).max(), np.abs(hits.v - weights[:, 2]).max()) < 1e-6


@pytest.mark.parametrize("length", [1e-37, 1e-20, 1e-15, 1e15, 1e30])
@pytest.mark.parametrize("accel", ACCELS)
def test_g10_directions_of_any_length_hit(length: float, accel: str):
    mesh = icosphere(3)
    rng = np.random.default_rng(5)
    directions = rng.normal(size=(2000, 3))
    directions *= length / np.linalg.norm(directions, axis=1, keepdims=True)
    hits = scene_of(mesh, accel).intersect(np.zeros((2000, 3), np.float32), directions.astype(np.float32))
    assert (hits.triangle >= 0).all()
    distance = hits.t.astype(np.float64) * np.linalg.norm(directions.astype(np.float32).astype(float), axis=1)
    assert ((distance > 0.98) & (distance < 1.0001)).all()


@pytest.mark.parametrize("width", [1e4, 1e6, 1e8])
def test_g13_a_plain_reaches_to_the_horizon(width: float):
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * width
    scene = scene_of(mesh_of(corners, np.array([[0, 1, 2], [0, 2, 3]])))
    slopes = np.linspace(2.0 / width, 1e-2, 4000)
    directions = np.stack([np.cos(slopes), 0.3 * np.cos(slopes), -3 * slopes], axis=1).astype(np.float32)
    hits = scene.intersect(np.tile(np.float32([0, 0, 1.7]), (4000, 1)), directions)
    assert (hits.triangle >= 0).all()
    exact = 1.7 / -directions[:, 2].astype(np.float64)
    assert np.allclose(hits.t, exact, rtol=1e-6)


@pytest.mark.parametrize("accel", ACCELS)
@pytest.mark.parametrize("triangle_test", ["watertight", "classic"])
def test_g15_garbage_triangles_are_left_out_and_counted(accel: str, triangle_test: str):
    clean = icosphere(3)
    first = len(clean.vertices)
    bad = np.array([[np.nan, 0, 0], [np.inf, 0, 0], [-np.inf, 1, 1], [2e18, 0, 0], [0, 0, 0], [0.1, 0, 0]])
    vertices = np.concatenate([clean.vertices, bad.astype(np.float32)])
    garbage = [(0, 1, first + k) for k in range(4)] + [(0, 0, 1), (first + 4, first + 4, first + 5)]
    triangles = np.concatenate([clean.triangles, np.array(garbage * 200, np.int32)])
    origins, directions = random_rays(20_000, seed=6, spread=1)
    dirty_mesh = mesh_of(vertices, triangles)
    dirty = scene_of(dirty_mesh, accel, triangle_test)
    expected = scene_of(clean, accel, triangle_test).intersect(origins, directions)
    assert same_hits(dirty.intersect(origins, directions), expected)
    assert dirty.build().degenerate_triangles == 1200


def test_g16_bad_rays_miss():
    scene = scene_of(icosphere(5))
    count = 50_000
    origins = np.zeros((count, 3), np.float32)
    directions = np.tile(np.float32([0.3, 0.4, 0.5]), (count, 1))
    tmin, tmax = np.zeros(count, np.float32), np.full(count, np.inf, np.float32)
    for bad in (np.nan, np.inf, -np.inf):
        for array in (origins, directions, tmin, tmax):
            rows = array.copy()
            rows[:] = bad if array.ndim == 1 else np.where([True, False, False], bad, array)
            arrays = [rows if a is array else a for a in (origins, directions, tmin, tmax)]
            if (array is tmax and bad == np.inf) or (array is tmin and bad == -np.inf):
                continue
            hits = scene.intersect(*arrays, threads=1)
            assert (hits.triangle == -1).all() and np.isinf(hits.t).all()
            assert not scene.occluded(*arrays).any()
    assert (scene.intersect(origins, 0 * directions).triangle == -1).all()


@pytest.mark.parametrize("accel", ACCELS)
def test_a03_rays_within_the_faces_of_a_box_are_not_lost(accel: str):
    """Axis-parallel rays with the origin exactly on the planes that bound the triangles."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    heights = np.arange(40.0)
    vertices = np.concatenate([corners + [0, 0, h] for h in heights])
    quads = np.concatenate([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * k for k in range(40)])
    scene = scene_of(mesh_of(vertices, quads), accel)
    rim = [(0, 0), (1, 0), (0, 1), (1, 1), (0.5, 0), (0, 0.5), (1, 0.25), (0.75, 1)]
    origins = np.array([(x, y, -1) for x, y in rim] * 4, np.float32)
    zero = np.repeat(np.float32([0.0, -0.0]), 16)
    directions = np.stack([zero, -zero, np.ones(32, np.float32)], axis=1)
    hits = scene.intersect(origins, directions)
    assert (hits.t == 1).all()


def test_a01_no_box_is_culled_whose_triangle_is_hit():
    for offset in (0.0, 1e2, 1e4):
        mesh = soup(2000, 0.02, seed=7)
        mesh = mesh_of(mesh.vertices.astype(np.float64) + offset, mesh.triangles)
        rng = np.random.default_rng(8)
        corner = mesh.vertices[rng.integers(len(mesh.vertices), size=20_000)].astype(np.float64)
        origins = (corner + rng.normal(size=corner.shape) * 3).astype(np.float32)
        directions = (corner - origins + 1e-6 * rng.normal(size=corner.shape)).astype(np.float32)
        tree, all_triangles = scene_of(mesh, "bvh"), scene_of(mesh, "none")
        assert same_hits(tree.intersect(origins, directions), all_triangles.intersect(origins, directions))
