"""Rays that go together are traced together: their answers are those of rays that go alone."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.native import Hits, RayScene

from .meshes import Float32, Mesh, icosphere, mesh_of, scene_of, soup
from .test_ray_instances import placed, rotation


def beams(
    count: int, width: float, seed: int, eye: tuple[float, float, float] = (2.1, 1.7, 3.3)
) -> tuple[Float32, Float32]:
    """`count` bundles of 16 rays about one eye, towards points of a ball; a bundle is `width` wide."""
    rng = np.random.default_rng(seed)
    axis = -np.array(eye) + rng.uniform(-1, 1, (count, 1, 3))
    directions = axis + width * rng.normal(size=(count, 16, 3))
    origins = np.broadcast_to(np.float32(eye), directions.shape)
    return np.ascontiguousarray(origins.reshape(-1, 3)), directions.reshape(-1, 3).astype(np.float32)


def assert_as_alone(mesh: Mesh, origins: Float32, directions: Float32, t_max: float = np.inf) -> Hits:
    """Rays of one mesh give the same bits in bundles and out of them."""
    return assert_bundles_as_alone(scene_of(mesh, "bvh"), origins, directions, t_max)


def assert_bundles_as_alone(
    scene: RayScene, origins: Float32, directions: Float32, t_max: float = np.inf
) -> Hits:
    """Rays in an order that makes bundles of 16, and in one that makes none, give the same bits."""
    together = scene.intersect(origins, directions, tmax=t_max, threads=1)
    hidden = scene.occluded(origins, directions, tmax=t_max, threads=1)
    # A stride that is prime to the batch leaves no two neighbours next to each other.
    order = (np.arange(len(origins)) * 7919) % len(origins)
    assert len(np.unique(order)) == len(origins)
    apart = scene.intersect(origins[order], directions[order], tmax=t_max, threads=1)
    for name in ("t", "u", "v", "triangle", "instance"):
        assert np.array_equal(getattr(together, name)[order], getattr(apart, name)), name
    assert np.array_equal(hidden, together.triangle >= 0)
    assert np.array_equal(hidden[order], scene.occluded(origins[order], directions[order], tmax=t_max))
    return together


@pytest.mark.parametrize("width", [1e-5, 1e-3, 1e-2, 0.1])
@pytest.mark.parametrize("length", [1e-6, 1.0, 300.0])
def test_a_beam_from_one_eye_hits_what_its_rays_hit_alone(width: float, length: float):
    origins, directions = beams(500, width, seed=1)
    hits = assert_as_alone(soup(3000, 0.15, seed=2), origins, directions * np.float32(length))
    assert 0.2 < np.mean(hits.triangle >= 0) < 1


@pytest.mark.parametrize("spread", [1e-4, 1e-2, 0.05])
def test_a_beam_from_many_origins_hits_what_its_rays_hit_alone(spread: float):
    origins, directions = beams(500, 0.02, seed=3)
    origins = origins + np.random.default_rng(4).uniform(-spread, spread, origins.shape).astype(np.float32)
    assert_as_alone(soup(3000, 0.15, seed=5), origins, directions)
    assert_as_alone(soup(3000, 0.15, seed=5), origins, directions, t_max=1.0)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_beams_at_shared_corners_and_edges_do_not_leak(scale: float):
    mesh = icosphere(4, scale)
    rng = np.random.default_rng(6)
    corners = mesh.vertices[mesh.triangles[rng.integers(0, len(mesh.triangles), 2000)]].astype(np.float64)
    share = rng.random((2000, 8, 1))
    on_edges = corners[:, None, 0] * share + corners[:, None, 1] * (1 - share)
    at_corners = np.broadcast_to(corners[:, None, 0], (2000, 8, 3))
    eye = np.float32(scale * np.array([0.11, -0.23, 0.07]))
    directions = np.concatenate([on_edges, at_corners], axis=1).reshape(-1, 3) - eye
    origins = np.broadcast_to(eye, directions.shape).astype(np.float32)
    hits = assert_as_alone(mesh, np.ascontiguousarray(origins), directions.astype(np.float32))
    assert (hits.triangle >= 0).all()


def test_of_equal_hits_the_first_triangle_counts_in_a_beam_too():
    one = icosphere(3)
    twice = mesh_of(
        np.tile(one.vertices, (2, 1)), np.concatenate([one.triangles, one.triangles + len(one.vertices)])
    )
    origins, directions = beams(300, 1e-3, seed=7)
    hits = assert_as_alone(twice, origins, directions)
    assert hits.triangle.max() < len(one.triangles)


def test_a_beam_with_rays_that_cannot_be_traced_leaves_the_others_alone():
    origins, directions = beams(200, 1e-3, seed=8)
    directions[::16, 1] = np.nan
    directions[5::16] = 0
    origins[9::16, 0] = np.inf
    hits = assert_as_alone(soup(2000, 0.3, seed=9), origins, directions)
    for first in (0, 5, 9):
        assert (hits.triangle[first::16] < 0).all()
    assert (hits.triangle >= 0).any()


def general_world(rotated: bool) -> RayScene:
    """Meshes merged and placed (turned, mirrored, stretched, twice in one place), spheres, planes."""
    rng = np.random.default_rng(10)
    scene = RayScene("bvh")
    for seed in (11, 12):
        mesh = soup(400, 0.2, seed=seed)
        scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    ball, sphere, plane = icosphere(3), scene.add_sphere(), scene.add_plane()
    copies = scene.add_mesh(ball.vertices, ball.triangles)
    for k in range(20):
        turn = rotation(k) if rotated else np.eye(3)
        stretch = np.diag([0.3, 0.3 + 0.02 * k, -0.2 if k % 3 == 0 else 0.2])
        place = placed(turn @ stretch, rng.uniform(-1.5, 1.5, 3))
        scene.add_instance(copies, place)
        if k % 5 == 0:
            scene.add_instance(copies, place)
        scene.add_instance(sphere, placed(turn * 0.15, rng.uniform(-1.5, 1.5, 3)))
    scene.add_instance(plane, placed(np.eye(3), np.array([0.0, 0.0, -2.0])))
    scene.build()
    return scene


@pytest.mark.parametrize("rotated", [False, True])
@pytest.mark.parametrize("width", [1e-4, 1e-2, 0.1])
def test_a_beam_through_a_general_world_hits_what_its_rays_hit_alone(rotated: bool, width: float):
    scene = general_world(rotated)
    origins, directions = beams(500, width, seed=13)
    hits = assert_bundles_as_alone(scene, origins, directions)
    assert len(np.unique(hits.instance)) > 20
    assert np.mean(hits.triangle >= 0) > 0.5
    shift = np.random.default_rng(14).uniform(-0.02, 0.02, origins.shape).astype(np.float32)
    assert_bundles_as_alone(scene, origins + shift, directions)
    assert_bundles_as_alone(scene, origins + shift, directions, t_max=1.0)


@pytest.mark.parametrize("isa", ["baseline", "avx2", "avx512"])
def test_every_instruction_set_brings_a_ray_into_a_placed_mesh_alike(isa: str):
    ball = icosphere(4)
    origins, directions = beams(300, 1e-2, seed=15)
    expected = None
    for instruction_set in ("baseline", isa):
        scene = RayScene("bvh", instruction_set=instruction_set)
        copies = scene.add_mesh(ball.vertices, ball.triangles)
        for k in range(8):
            scene.add_instance(copies, placed(0.4 * rotation(k), np.array([0.3 * k - 1, 0.1 * k, 0.2])))
        scene.build()
        hits = scene.intersect(origins, directions)
        expected = expected or hits
        for name in ("t", "u", "v", "triangle", "instance"):
            assert np.array_equal(getattr(hits, name), getattr(expected, name)), name
    assert np.mean(hits.triangle >= 0) > 0.1


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_beams_do_not_leak_out_of_a_placed_mesh(scale: float):
    ball = icosphere(4)
    scene = RayScene("bvh")
    copies = scene.add_mesh(ball.vertices, ball.triangles)
    centre = scale * np.array([3.0, -2.0, 1.0])
    scene.add_instance(copies, placed(scale * rotation(16), centre))
    scene.add_instance(copies, placed(0.1 * scale * rotation(17), centre + 5 * scale))
    scene.build()
    origins, directions = beams(1000, 1e-2, seed=18)
    eye = np.float32(centre + scale * np.array([0.1, 0.2, -0.1]))
    hits = assert_bundles_as_alone(scene, np.broadcast_to(eye, origins.shape).copy(), directions)
    assert (hits.instance == 0).all()
