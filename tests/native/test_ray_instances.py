"""Instances against the same triangles baked into the world."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.native import RayScene

from .meshes import ACCELS, edge_and_vertex_rays, icosphere, mesh_of, random_rays, same_hits, scene_of, soup


def rotation(seed: int) -> np.ndarray:
    matrix, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return matrix


def placed(linear: np.ndarray, translation) -> np.ndarray:
    return np.concatenate([linear, np.reshape(translation, (3, 1))], axis=1).astype(np.float32)


TRANSFORMS = {
    "moved": placed(np.eye(3), (0.3, -0.2, 0.1)),
    "turned": placed(rotation(1), (0, 0, 0)),
    "mirrored": placed(np.diag([-1.0, 1, 1]), (1, 0, 0)),
    "sheared": placed(np.eye(3) + 10 * np.outer([1, 0, 0], [0, 1, 0]), (0, 0, 0)),
    "small": placed(1e-6 * rotation(2), (0, 0, 0)),
    "large": placed(1e6 * rotation(3), (0, 0, 0)),
    "far": placed(rotation(4), (1e4, -1e4, 1e4)),
}


@pytest.mark.parametrize("name", TRANSFORMS)
@pytest.mark.parametrize("accel", ACCELS)
def test_s09_an_instance_is_its_baked_mesh(name: str, accel: str):
    transform = TRANSFORMS[name].astype(np.float64)
    mesh = icosphere(3)
    scene = RayScene(accel)
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles), TRANSFORMS[name])
    scene.build()
    size = np.linalg.norm(transform[:, :3], 2)
    local_origins, local_directions = random_rays(5000, seed=5, spread=3)
    origins = (local_origins @ transform[:, :3].T + transform[:, 3]).astype(np.float32)
    directions = (local_directions @ transform[:, :3].T).astype(np.float32)
    baked_vertices = mesh.vertices.astype(np.float64) @ transform[:, :3].T + transform[:, 3]
    baked = scene_of(mesh_of(baked_vertices, mesh.triangles), accel).intersect(origins, directions)
    hits = scene.intersect(origins, directions)
    agree = (hits.triangle >= 0) == (baked.triangle >= 0)
    # Rays past the silhouette of a mesh whose vertices were rounded in the world may differ.
    assert agree.mean() > (0.998 if name == "far" else 0.9995)
    both = (hits.triangle >= 0) & (baked.triangle >= 0)
    gap = np.abs(hits.t[both] - baked.t[both]) * np.linalg.norm(directions[both], axis=1)
    rounding = 4 * np.spacing(np.float32(np.abs(transform[:, 3]).max()))
    assert np.quantile(gap, 0.999) < 1e-5 * size + 4 * rounding


@pytest.mark.parametrize("name", TRANSFORMS)
def test_s09_nothing_leaks_out_of_an_instance(name: str):
    transform = TRANSFORMS[name].astype(np.float64)
    mesh = icosphere(3)
    scene = RayScene("bvh")
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles), TRANSFORMS[name])
    scene.build()
    origins, directions = edge_and_vertex_rays(mesh, 40_000, seed=6)
    origins = (origins @ transform[:, :3].T + transform[:, 3]).astype(np.float32)
    directions = (directions @ transform[:, :3].T).astype(np.float32)
    assert (scene.intersect(origins, directions).triangle >= 0).all()


@pytest.mark.parametrize("accel", ACCELS)
def test_many_instances_give_the_nearest_of_all(accel: str):
    mesh = soup(60, 0.4, seed=7)
    rng = np.random.default_rng(8)
    scene = RayScene(accel)
    index = scene.add_mesh(mesh.vertices, mesh.triangles)
    copies, transforms = [], []
    for k in range(50):
        transforms.append(placed(0.5 * rotation(k), rng.random(3) * 2 - 0.5))
        assert scene.add_instance(index, transforms[-1]) == k
        copies.append(mesh.vertices.astype(np.float64) @ transforms[-1][:, :3].T + transforms[-1][:, 3])
    scene.build()
    triangles = np.concatenate([mesh.triangles + k * len(mesh.vertices) for k in range(50)])
    baked = scene_of(mesh_of(np.concatenate(copies), triangles), "none")
    origins, directions = random_rays(10_000, seed=9)
    hits, expected = scene.intersect(origins, directions), baked.intersect(origins, directions)
    same = hits.triangle + 60 * hits.instance == np.where(expected.triangle < 0, -61, expected.triangle)
    assert same.mean() > 0.999
    met = same & (hits.triangle >= 0)
    assert np.allclose(hits.t[met], expected.t[met], rtol=1e-4, atol=1e-6)
    assert np.array_equal(scene.occluded(origins, directions), hits.triangle >= 0)


@pytest.mark.parametrize("accel", ACCELS)
def test_single_meshes_that_stand_still_are_one_soup_bit_by_bit(accel: str):
    meshes = [soup(300, 0.3, seed=k) for k in range(5)]
    scene = RayScene(accel)
    for mesh in meshes:
        scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    scene.build()
    whole = mesh_of(np.concatenate([m.vertices for m in meshes]), np.arange(4500).reshape(-1, 3))
    origins, directions = random_rays(5000, seed=10)
    hits, expected = (
        scene.intersect(origins, directions),
        scene_of(whole, "none").intersect(origins, directions),
    )
    assert np.array_equal(hits.t, expected.t)
    number = np.where(hits.triangle < 0, -1, 300 * hits.instance + hits.triangle)
    assert np.array_equal(number, expected.triangle)


def test_of_coincident_instances_the_first_counts():
    mesh = soup(40, 0.5, seed=11)
    scene = RayScene("bvh")
    index = scene.add_mesh(mesh.vertices, mesh.triangles)
    for _ in range(30):
        scene.add_instance(index)
    scene.build()
    origins, directions = random_rays(2000, seed=12)
    hits = scene.intersect(origins, directions)
    assert (hits.instance[hits.triangle >= 0] == 0).all()
    assert same_hits(hits, scene_of(mesh, "bvh").intersect(origins, directions))
