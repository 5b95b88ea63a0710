"""Closest and any hit against float64 brute force, and what the answers promise."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.native import RayScene

from .meshes import ACCELS, brute_force, icosphere, mesh_of, random_rays, same_hits, scene_of, soup


@pytest.mark.parametrize("accel", ACCELS)
@pytest.mark.parametrize("triangle_test", ["watertight", "classic"])
def test_hits_are_those_of_brute_force_in_double(accel: str, triangle_test: str):
    mesh = soup(700, 0.3, seed=1)
    origins, directions = random_rays(1500, seed=2)
    hits = scene_of(mesh, accel, triangle_test).intersect(origins, directions)
    t, triangle, margin = brute_force(mesh, origins, directions)
    clear = margin > (0 if triangle_test == "watertight" else 1e-5)
    assert clear.mean() > 0.9
    assert np.array_equal(hits.triangle[clear], triangle[clear])
    met = clear & (triangle >= 0)
    assert met.sum() > 500
    assert np.allclose(hits.t[met], t[met], rtol=1e-6 if triangle_test == "watertight" else 1e-4)
    assert np.isinf(hits.t[hits.triangle < 0]).all()


@pytest.mark.parametrize("accel", ACCELS)
def test_u_and_v_give_the_point_that_t_gives(accel: str):
    mesh = soup(500, 0.4, seed=3)
    origins, directions = random_rays(4000, seed=4)
    hits = scene_of(mesh, accel).intersect(origins, directions)
    met = hits.triangle >= 0
    corners = mesh.vertices[mesh.triangles[hits.triangle[met]]].astype(np.float64)
    u, v = hits.u[met, None].astype(float), hits.v[met, None].astype(float)
    by_weights = (1 - u - v) * corners[:, 0] + u * corners[:, 1] + v * corners[:, 2]
    by_distance = origins[met] + hits.t[met, None].astype(float) * directions[met]
    assert np.abs(by_weights - by_distance).max() < 2e-6
    assert min(u.min(), v.min()) >= 0 and (u + v).max() <= 1 + 1e-6


@pytest.mark.parametrize("triangle_test", ["watertight", "classic"])
def test_every_accelerator_gives_the_same_bits(triangle_test: str):
    mesh = soup(3000, 0.1, seed=5)
    origins, directions = random_rays(20000, seed=6)
    expected = scene_of(mesh, "none", triangle_test).intersect(origins, directions)
    for accel in ACCELS[1:]:
        assert same_hits(scene_of(mesh, accel, triangle_test).intersect(origins, directions), expected)


@pytest.mark.parametrize("accel", ACCELS)
def test_occluded_is_closest_hit_within_the_range(accel: str):
    scene = scene_of(soup(800, 0.2, seed=7), accel)
    origins, directions = random_rays(8000, seed=8)
    for tmin, tmax in ((0.0, np.inf), (0.4, 0.8), (0.0, 0.5)):
        met = scene.intersect(origins, directions, tmin, tmax)
        inside = met.t[met.triangle >= 0]
        assert ((inside > tmin) & (inside < tmax)).all()
        assert np.array_equal(scene.occluded(origins, directions, tmin, tmax), met.triangle >= 0)


def test_hits_do_not_depend_on_the_number_of_threads():
    mesh = soup(20000, 0.05, seed=9)
    origins, directions = random_rays(30000, seed=10)
    results = []
    for threads in (1, 2, 5):
        scene = RayScene("bvh")
        scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
        stats = scene.build(threads)
        results.append((stats.nodes, scene.intersect(origins, directions, threads=threads)))
    for nodes, hits in results[1:]:
        assert nodes == results[0][0]
        assert same_hits(hits, results[0][1])


@pytest.mark.parametrize("accel", ACCELS)
def test_of_equal_hits_the_lowest_triangle_counts(accel: str):
    one = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    mesh = mesh_of(one, np.array([[0, 1, 2]] * 40))
    hits = scene_of(mesh, accel).intersect([[0.2, 0.2, 1]], [[0, 0, -1]])
    assert hits.triangle[0] == 0 and hits.t[0] == 1


@pytest.mark.parametrize("accel", ["auto", *ACCELS])
def test_scenes_of_no_and_of_one_triangle_work(accel: str):
    scene = RayScene(accel)
    assert scene.build().triangles == 0
    assert scene.intersect([[0, 0, 1]], [[0, 0, -1]]).triangle[0] == -1
    assert not scene.occluded([[0, 0, 1]], [[0, 0, -1]])[0]
    scene.add_instance(scene.add_mesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)))
    assert scene.build().instances == 1
    assert np.isinf(scene.intersect([[0, 0, 1]], [[0, 0, -1]]).t[0])
    only = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
    scene.add_instance(scene.add_mesh(only, np.array([[0, 1, 2]], np.int32)))
    scene.build()
    hits = scene.intersect([[0, 0, 1], [0, 0, 1]], [[0, 0, -2], [0, 0, 2]])
    assert hits.t.tolist() == [0.5, np.inf]
    assert (hits.triangle.tolist(), hits.instance.tolist()) == ([0, -1], [1, -1])


def test_a_hundred_thousand_equal_triangles_build_and_trace():
    one = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    scene = RayScene("bvh")
    scene.add_instance(
        scene.add_mesh(one.astype(np.float32), np.tile(np.array([[0, 1, 2]], np.int32), (100_000, 1)))
    )
    assert scene.build().seconds < 2
    assert scene.intersect([[0.2, 0.2, 1]], [[0, 0, -1]]).triangle[0] == 0


def test_nested_boxes_of_one_centre_build_and_trace():
    unit = np.array([[-1, -1, 0], [1, -1, 0], [0, 2, 0]], float)
    sizes = np.linspace(1, 2, 20_000)
    vertices = (unit[None] * sizes[:, None, None]).reshape(-1, 3)
    scene = scene_of(mesh_of(vertices, np.arange(len(vertices)).reshape(-1, 3)))
    hits = scene.intersect([[0, 0, 1]], [[0, 0, -1]])
    assert (hits.t[0], hits.triangle[0]) == (1, 0)


def test_auto_says_what_it_chose_and_why():
    scene = RayScene()
    mesh = icosphere(3)
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    stats = scene.build()
    assert stats.accel == "bvh" and "1280" in stats.reason
    assert stats.bytes > 0 and stats.nodes > 0
