"""Wrong arguments name themselves and their first bad row; wrong times are refused."""

from __future__ import annotations

import threading

import numpy as np
import pytest

from trg_blender.engine.native import RayScene, load_native

from .meshes import icosphere, random_rays, scene_of

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
TRIANGLES = np.array([[0, 1, 2]], np.int32)


@pytest.mark.parametrize(
    ("vertices", "triangles", "message"),
    [
        (VERTICES.astype(np.float64), TRIANGLES, "vertices: expected float32, got float64"),
        (VERTICES, TRIANGLES.astype(np.int64), "triangles: expected int32, got int64"),
        (VERTICES[:, :2].copy(), TRIANGLES, r"vertices: expected shape \(n, 3\), got \(3, 2\)"),
        (VERTICES.ravel(), TRIANGLES, r"vertices: expected shape \(n, 3\), got \(9,\)"),
        (VERTICES, np.array([[0, 1, 2], [0, 1, 3]], np.int32), "triangles: row 1 has vertex index 3"),
        (VERTICES, np.array([[-1, 1, 2]], np.int32), "triangles: row 0 has vertex index -1"),
        ([["a", "b", "c"]], TRIANGLES, "vertices: expected float32"),
    ],
)
def test_bad_meshes_are_refused(vertices, triangles, message: str):
    with pytest.raises(ValueError, match=message):
        RayScene().add_mesh(vertices, triangles)


@pytest.mark.parametrize(
    ("mesh", "transform", "message"),
    [
        (1, None, "mesh: index 1 of 1"),
        (-1, None, "mesh: index -1 of 1"),
        (0, np.zeros((3, 4), np.float32), "transform: row 0 is singular"),
        (0, np.full((3, 4), np.nan, np.float32), "transform: row 0 is not finite"),
        (0, np.eye(4, dtype=np.float32), r"transform: expected shape \(3, 4\), got \(4, 4\)"),
    ],
)
def test_bad_instances_are_refused(mesh: int, transform, message: str):
    scene = RayScene()
    scene.add_mesh(VERTICES, TRIANGLES)
    with pytest.raises(ValueError, match=message):
        scene.add_instance(mesh, transform)


def test_a_bad_row_among_many_instances_is_named_and_none_is_added():
    scene = load_native().Scene()
    scene.add_mesh(VERTICES, TRIANGLES)
    transforms = np.tile(np.eye(3, 4, dtype=np.float32), (5, 1, 1))
    transforms[3, 0] = 0
    with pytest.raises(ValueError, match="transforms: row 3 is singular"):
        scene.add_instances(0, transforms)
    assert scene.add_instances(0, transforms[:3]) == 0
    assert scene.add_instance(0) == 3


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((np.zeros((2, 3)), np.zeros((2, 3), np.float32)), "origins: expected float32, got float64"),
        (
            (np.zeros((2, 3), np.float32), np.zeros((3, 3), np.float32)),
            r"directions: expected shape \(2, 3\)",
        ),
        ((np.zeros((2, 2), np.float32), np.zeros((2, 3), np.float32)), r"origins: expected shape \(n, 3\)"),
        (
            (np.zeros((2, 3), np.float32), np.ones((2, 3), np.float32), np.zeros(3)),
            r"tmin: expected shape \(2,\)",
        ),
    ],
)
def test_bad_rays_arguments_are_refused(arguments, message: str):
    with pytest.raises(ValueError, match=message):
        scene_of(icosphere(1)).intersect(*arguments)


def test_outputs_that_cannot_be_written_are_refused():
    scene = load_native().Scene()
    scene.build()
    rays = [
        np.zeros((1, 3), np.float32),
        np.ones((1, 3), np.float32),
        np.zeros(1, np.float32),
        np.ones(1, np.float32),
    ]
    out = np.zeros(1, np.uint8)
    out.flags.writeable = False
    with pytest.raises(ValueError, match="out: expected a C-contiguous writable array of uint8"):
        scene.occluded(*rays, out)


@pytest.mark.parametrize(("accel", "test"), [("octree", "watertight"), ("bvh", "exact")])
def test_unknown_names_are_refused(accel: str, test: str):
    with pytest.raises(ValueError, match="expected"):
        RayScene(accel, test)


def test_a_query_before_the_build_or_after_a_change_is_refused():
    scene = RayScene()
    rays = (np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32))
    with pytest.raises(RuntimeError, match="must be built"):
        scene.intersect(*rays)
    scene.build()
    assert scene.intersect(*rays).triangle[0] == -1
    scene.add_mesh(VERTICES, TRIANGLES)
    with pytest.raises(RuntimeError, match="must be built"):
        scene.occluded(*rays)


def test_a_change_during_a_query_is_refused_and_queries_run_side_by_side():
    scene = scene_of(icosphere(5))
    origins, directions = random_rays(1_000_000, seed=1)
    alone = scene.intersect(origins, directions, threads=1)
    results, refusals = [], []
    threads = [
        threading.Thread(target=lambda: results.append(scene.intersect(origins, directions, threads=1)))
        for _ in range(2)
    ]
    for thread in threads:
        thread.start()
    # The mesh is wrong, so that nothing changes should no query be under way at that moment.
    while any(thread.is_alive() for thread in threads) and not refusals:
        try:
            scene.add_mesh(VERTICES, TRIANGLES + 7)
        except RuntimeError as error:
            refusals.append(str(error))
        except ValueError:
            continue
    for thread in threads:
        thread.join()
    assert len(results) == 2
    assert refusals and "in use" in refusals[0]
    assert all(np.array_equal(result.triangle, alone.triangle) for result in results)
