"""Moving what was built: instances by the top level alone, vertices by fitting boxes."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.native import RayScene

from .meshes import ACCELS, Float32, Mesh, icosphere, random_rays, same_hits, soup


def at(x: float, y: float, z: float) -> Float32:
    return np.column_stack([np.eye(3), (x, y, z)]).astype(np.float32)


def build(meshes: list[Mesh], places: list[Float32 | None], accel: str = "bvh") -> RayScene:
    scene = RayScene(accel)
    for mesh, place in zip(meshes, places, strict=True):
        scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles), place)
    scene.build()
    return scene


def check_same(a: RayScene, b: RayScene, seed: int = 1) -> None:
    origins, directions = random_rays(20_000, seed, spread=3)
    expected = b.intersect(origins, directions)
    assert (expected.triangle >= 0).sum() > 500
    assert same_hits(a.intersect(origins, directions), expected)
    assert np.array_equal(a.occluded(origins, directions), expected.triangle >= 0)


@pytest.mark.parametrize("accel", ACCELS)
def test_moved_instances_are_those_of_a_new_scene(accel: str):
    meshes = [soup(500, 0.2, seed=k) for k in range(4)]
    scene = build(meshes, [at(k, 0, 0) for k in range(4)], accel)
    moved = [at(0, k, 0.5) for k in range(4)]
    stats = scene.update_transforms(1, np.stack(moved[1:]))
    assert not stats.rebuilt
    check_same(scene, build(meshes, [at(0, 0, 0), *moved[1:]], accel))


def test_what_was_merged_is_built_anew_once():
    meshes = [soup(300, 0.2, seed=k) for k in range(3)]
    scene = build(meshes, [None, None, None])
    assert scene.update_transforms(1, at(0.5, 0, 0)[None]).rebuilt
    assert not scene.update_transforms(1, at(0.2, 0, 0)[None]).rebuilt
    check_same(scene, build(meshes, [None, at(0.2, 0, 0), None]))


@pytest.mark.parametrize("accel", ACCELS)
@pytest.mark.parametrize("merged", [False, True])
@pytest.mark.parametrize("test", ["watertight", "classic"])
def test_moved_vertices_are_those_of_a_new_mesh(accel: str, merged: bool, test: str):
    def new_scene(first: Mesh) -> RayScene:
        scene = RayScene(accel, test)
        scene.add_instance(scene.add_mesh(first.vertices, first.triangles))
        if merged:
            other = soup(200, 0.2, seed=9)
            scene.add_instance(scene.add_mesh(other.vertices, other.triangles))
        scene.build()
        return scene

    mesh = soup(2000, 0.1, seed=3)
    scene = new_scene(mesh)
    bent = Mesh(
        (mesh.vertices + 0.05 * np.sin(5 * mesh.vertices[:, ::-1])).astype(np.float32), mesh.triangles
    )
    stats = scene.update_vertices(0, bent.vertices)
    assert stats.rebuilt == (accel != "bvh")
    check_same(scene, new_scene(bent))


def test_a_tree_that_no_longer_fits_is_built_anew():
    mesh = icosphere(5)
    scene = build([mesh], [None])
    slightly = scene.update_vertices(0, (mesh.vertices * np.float32([1.1, 1, 1])).astype(np.float32))
    assert not slightly.rebuilt and 0.9 < slightly.growth < 1.1
    order = np.random.default_rng(4).permutation(len(mesh.vertices))
    shuffled = np.ascontiguousarray(mesh.vertices[order])
    stats = scene.update_vertices(0, shuffled)
    assert stats.rebuilt and stats.growth > 1.5
    check_same(scene, build([Mesh(shuffled, mesh.triangles)], [None]))


def test_triangles_that_lose_or_gain_area_are_not_lost():
    mesh = icosphere(2)
    scene = build([mesh], [None])
    flat = mesh.vertices * np.float32([1, 1, 0])
    flat[: len(flat) // 2] = 0
    assert scene.update_vertices(0, flat).rebuilt
    assert scene.update_vertices(0, mesh.vertices).rebuilt
    check_same(scene, build([mesh], [None]))


def test_impossible_updates_are_refused():
    mesh = icosphere(1)
    scene = RayScene()
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    with pytest.raises(RuntimeError, match="built"):
        scene.update_vertices(0, mesh.vertices)
    scene.build()
    with pytest.raises(ValueError, match="vertices"):
        scene.update_vertices(0, mesh.vertices[:-1])
    with pytest.raises(ValueError, match="mesh"):
        scene.update_vertices(1, mesh.vertices)
    with pytest.raises(ValueError, match="transforms"):
        scene.update_transforms(1, at(0, 0, 0)[None])
    with pytest.raises(ValueError, match="singular"):
        scene.update_transforms(0, np.zeros((1, 3, 4), np.float32))
    assert (scene.intersect([[0, 0, 3]], [[0, 0, -1]]).triangle >= 0).all()


def test_a_million_instances_build_quickly_and_small():
    mesh = icosphere(2)
    count = 1_000_000
    rng = np.random.default_rng(5)
    places = np.zeros((count, 3, 4), np.float32)
    places[:, [0, 1, 2], [0, 1, 2]] = 0.003
    places[:, :, 3] = rng.random((count, 3))
    scene = RayScene("bvh")
    scene.add_instances(scene.add_mesh(mesh.vertices, mesh.triangles), places)
    stats = scene.build()
    assert stats.bytes < 300e6
    assert stats.seconds < 6, "2 s on a machine that does nothing else"
    origins, directions = random_rays(2000, seed=6)
    hits = scene.intersect(origins, directions)
    met = hits.triangle >= 0
    assert met.sum() > 1000
    points = origins[met] + hits.t[met, None] * directions[met]
    centres = places[hits.instance[met], :, 3]
    assert np.allclose(np.linalg.norm(points - centres, axis=1), 0.003, rtol=0.1)
