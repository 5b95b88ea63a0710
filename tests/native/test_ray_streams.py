"""Rays of a batch that take turns through a large world: their answers are those of rays alone."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from trg_blender.engine.native import RayScene

from .meshes import Mesh, random_rays, same_hits, scene_of, soup
from .test_ray_instances import TRANSFORMS

STREAMED_BYTES = 16 << 20
"""worlds above this trace their rays in turns (native/accel/trace_stream.h)"""


@cache
def large_mesh() -> Mesh:
    return soup(400_000, 0.01, seed=1)


@cache
def large_scene(accel: str, triangle_test: str = "watertight") -> RayScene:
    return scene_of(large_mesh(), accel, triangle_test)


def placed_scene(accel: str, instruction_set: str = "auto") -> RayScene:
    """The large mesh as it is, turned and sheared, a small one in a grid of places, and spheres."""
    scene = RayScene(accel, instruction_set=instruction_set)
    large, small = large_mesh(), soup(500, 0.3, seed=2)
    mesh = scene.add_mesh(large.vertices, large.triangles)
    for name in ("moved", "turned", "sheared"):
        scene.add_instance(mesh, TRANSFORMS[name])
    scene.add_instance(mesh)
    other = scene.add_mesh(small.vertices, small.triangles)
    spot = np.concatenate([0.2 * np.eye(3), np.zeros((3, 1))], axis=1)
    for corner in np.ndindex(3, 3, 3):
        spot[:, 3] = np.array(corner) - 1
        scene.add_instance(other, spot.astype(np.float32))
    sphere = scene.add_sphere()
    for x in (-2.0, 2.5):
        spot[:, 3] = (x, 0.5, 0.5)
        scene.add_instance(sphere, spot.astype(np.float32))
    scene.build()
    return scene


def awkward_rays(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Random rays, among them some along axes, from afar, of odd lengths, and not numbers at all."""
    origins, directions = random_rays(count, seed=3)
    directions[::7, 1] = 0
    directions[::11, :2] = 0
    directions[::13] *= np.float32(1e-20)
    origins[::17] *= np.float32(1e5)
    directions[::17] = 0.5 - origins[::17]
    origins[::19, 0] = np.nan
    directions[::23] = 0
    return origins, directions


def test_the_worlds_of_these_tests_are_large_enough_for_turns():
    scene = RayScene("bvh")
    mesh = large_mesh()
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    assert scene.build().bytes > STREAMED_BYTES


@pytest.mark.parametrize("triangle_test", ["watertight", "classic"])
@pytest.mark.parametrize("t_max", [np.inf, 0.7])
def test_rays_in_turns_hit_what_they_hit_in_a_grid(triangle_test: str, t_max: float):
    origins, directions = awkward_rays(20_000)
    if triangle_test == "classic":
        # From afar its edges are wider than the boxes: what is met depends on the index.
        near = ~(np.abs(origins) > 100).any(axis=1)
        origins, directions = origins[near], directions[near]
    turns, alone = large_scene("bvh", triangle_test), large_scene("grid", triangle_test)
    hits = turns.intersect(origins, directions, tmax=t_max)
    assert same_hits(hits, alone.intersect(origins, directions, tmax=t_max))
    assert np.array_equal(turns.occluded(origins, directions, tmax=t_max), hits.triangle >= 0)
    assert 0.1 < np.mean(hits.triangle >= 0) < 1


@pytest.mark.parametrize("instruction_set", ["baseline", "avx2", "avx512"])
def test_rays_in_turns_go_through_placed_soups_and_spheres(instruction_set: str):
    origins, directions = awkward_rays(20_000)
    try:
        turns = placed_scene("bvh", instruction_set)
    except ValueError:
        pytest.skip(f"this machine has no {instruction_set}")
    alone = placed_scene("grid", instruction_set)
    hits = turns.intersect(origins, directions)
    assert same_hits(hits, alone.intersect(origins, directions))
    assert np.array_equal(turns.occluded(origins, directions), hits.triangle >= 0)
    assert len(np.unique(hits.instance)) > 10


@pytest.mark.parametrize("count", [0, 1, 7, 8, 9, 255, 257])
def test_batches_of_any_size_come_to_their_end(count: int):
    origins, directions = random_rays(count, seed=4)
    hits = large_scene("bvh").intersect(origins, directions)
    for k in range(count):
        one = large_scene("bvh").intersect(origins[k : k + 1], directions[k : k + 1])
        assert (one.t[0], one.triangle[0]) == (hits.t[k], hits.triangle[k])
