"""What docs/tracing.md says of bad input beyond wrong arguments: limits, odd memory, far places."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.native import RayScene, load_native

from .meshes import ACCELS, Float32, icosphere, random_rays, same_hits, scene_of

TRIANGLE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
FACE = np.array([[0, 1, 2]], np.int32)
DOWN = (np.float32([[0.2, 0.2, 1]]), np.float32([[0, 0, -1]]))


def shifted(array: np.ndarray) -> np.ndarray:
    """A copy whose items lie at odd addresses."""
    raw = np.zeros(array.nbytes + 1, np.uint8)[1:]
    raw[:] = np.frombuffer(array.tobytes(), np.uint8)
    return raw.view(array.dtype).reshape(array.shape)


def one_triangle(transform: Float32 | None = None, accel: str = "bvh") -> RayScene:
    scene = RayScene(accel)
    scene.add_instance(scene.add_mesh(TRIANGLE, FACE), transform)
    scene.build()
    return scene


@pytest.mark.parametrize("accel", ACCELS)
def test_a12_scenes_of_nothing_are_never_met(accel: str):
    empty, flat, unseen = RayScene(accel), RayScene(accel), RayScene(accel)
    empty.build()
    mesh = flat.add_mesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    flat.add_instance(mesh)
    flat.add_instance(flat.add_mesh(TRIANGLE * np.float32([1, 0, 0]), FACE))
    assert flat.build().degenerate_triangles == 1
    unseen.add_mesh(TRIANGLE, FACE)
    assert unseen.build().triangles == 0
    for scene in (empty, flat, unseen):
        hits = scene.intersect(*DOWN)
        assert (hits.triangle[0], hits.instance[0], hits.t[0]) == (-1, -1, np.inf)
        assert not scene.occluded(*DOWN).any()
    assert one_triangle(accel=accel).intersect(*DOWN).t[0] == 1


def test_more_than_2_30_rows_are_refused_before_they_are_read():
    try:
        rows = np.zeros((2**30 + 1, 3), np.int32)
    except MemoryError:
        pytest.skip("this machine gives no 12 GB of address space")
    scene = load_native().Scene()
    with pytest.raises(ValueError, match=r"triangles: more than 2\^30 rows"):
        scene.add_mesh(TRIANGLE, rows)
    with pytest.raises(ValueError, match=r"vertices: more than 2\^30 rows"):
        scene.add_mesh(rows.view(np.float32), FACE)


def test_pictures_of_more_than_2_30_pixels_are_refused():
    scene = load_native().Scene()
    scene.set_camera(0, np.eye(3, 4), np.array([-1.0, 1, -1, 1]))
    scene.build()
    for sides in ((1 << 20, 1 << 20), (1 << 16, (1 << 14) + 1)):
        with pytest.raises(ValueError, match="width, height: more than"):
            scene.start_render(*sides, 1)
    with pytest.raises(ValueError, match="width, height: expected"):
        scene.start_render((1 << 20) + 1, 1, 1)


@pytest.mark.parametrize("threads", [-1, 4097])
def test_numbers_of_threads_beyond_reason_are_refused(threads: int):
    scene = one_triangle()
    for call in (
        lambda: scene.build(threads),
        lambda: scene.intersect(*DOWN, threads=threads),
        lambda: scene.occluded(*DOWN, threads=threads),
        lambda: scene.update_vertices(0, TRIANGLE, threads),
        lambda: scene.update_transforms(0, np.eye(3, 4, dtype=np.float32)[None], threads),
    ):
        with pytest.raises(ValueError, match="threads: expected 0 to 4096"):
            call()


def test_items_at_odd_addresses_are_refused_and_copied_by_ray_scene():
    with pytest.raises(ValueError, match="vertices: expected items at multiples of their size"):
        load_native().Scene().add_mesh(shifted(TRIANGLE), FACE)
    scene = RayScene()
    scene.add_instance(scene.add_mesh(shifted(TRIANGLE), shifted(FACE)))
    scene.build()
    assert scene.intersect(shifted(DOWN[0]), shifted(DOWN[1])).t[0] == 1


def test_outputs_that_share_memory_are_refused():
    scene = load_native().Scene()
    scene.build()
    origins, directions = np.zeros((4, 3), np.float32), np.ones((4, 3), np.float32)
    memory = np.zeros((6, 4), np.float32)
    ids = np.zeros((2, 4), np.int32)
    rays = (origins, directions, memory[0], memory[1])
    scene.intersect(*rays, memory[2], memory[3], memory[4], ids[0], ids[1])
    for outs in (
        (memory[2], memory[2], memory[4], ids[0], ids[1]),
        (memory[2], memory[3], memory[4], memory[2].view(np.int32), ids[1]),
        (memory[1], memory[3], memory[4], ids[0], ids[1]),
        (origins.reshape(-1)[:4], memory[3], memory[4], ids[0], ids[1]),
    ):
        with pytest.raises(ValueError, match="output arrays: expected memory that nothing else uses"):
            scene.intersect(*rays, *outs)
    with pytest.raises(ValueError, match="output arrays"):
        scene.occluded(*rays, origins.view(np.uint8).reshape(-1)[:4])


@pytest.mark.parametrize("size", [1e19, 1e30, 3e38])
def test_an_instance_placed_out_of_reach_is_not_met_and_hides_nothing(size: float):
    far = np.eye(3, 4, dtype=np.float32)
    far[:, 3] = size
    mesh, rays = icosphere(2), random_rays(500, seed=1)
    scene = RayScene("bvh")
    index = scene.add_mesh(mesh.vertices, mesh.triangles)
    scene.add_instance(index)
    large = np.float32(size) * np.eye(3, 4, dtype=np.float32)
    for transform in (far, far * np.float32([[1, 1, 1, -1]]), large):
        scene.add_instance(index, transform)
        scene.add_instance(scene.add_sphere(), far)
    scene.build()
    assert same_hits(scene.intersect(*rays), scene_of(mesh).intersect(*rays))


def test_a_point_too_far_for_floats_is_met_by_no_query_and_a_plane_has_finite_coordinates():
    scene = RayScene()
    scene.add_instance(scene.add_plane())
    scene.build()
    for direction, met in (([0, -1e-38, -1e-45], False), ([1e7, 1e7, -1e-38], True), ([0, 3e38, -1], True)):
        rays = (np.float32([[0.1, 0.2, 0.3]]), np.float32([direction]))
        hits = scene.intersect(*rays)
        assert (hits.triangle[0] == 0) == met and scene.occluded(*rays)[0] == met
        if met:
            assert np.isfinite([hits.t[0], hits.u[0], hits.v[0]]).all()


def test_an_object_that_changes_the_scene_while_it_is_read_does_no_harm():
    """From Python 3.12 on a class may give a buffer, and do anything meanwhile."""
    scene = load_native().Scene()
    scene.add_instance(scene.add_mesh(TRIANGLE, FACE))
    scene.build()

    class Meddler:
        def __buffer__(self, flags: int) -> memoryview:
            for _ in range(50):
                scene.add_mesh(TRIANGLE, FACE)
            return memoryview(TRIANGLE)

    try:
        memoryview(Meddler())
    except TypeError:
        pytest.skip("only from Python 3.12 on")
    scene.build()
    with pytest.raises(RuntimeError, match="built"):
        scene.update_vertices(0, Meddler())
    assert scene.add_mesh(Meddler(), FACE) == 151
