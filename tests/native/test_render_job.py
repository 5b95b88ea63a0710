"""Jobs of the native renderer: repeatability, progress, passes, error and impossible input."""

from __future__ import annotations

import gc
import threading
from typing import Any

import numpy as np
import pytest

from trg_blender.engine.image_error import measure_error
from trg_blender.engine.scene_arrays import (
    LIGHT_FIELDS,
    MATERIAL_FIELDS,
    TEXTURE_FIELDS,
    Light,
    Material,
    Texture,
    pack_table,
)

from .render_scenes import (
    BLACK,
    GLOW,
    GREY,
    POINT,
    RECTANGLE,
    WHITE,
    Camera,
    Settings,
    add_object,
    film_size,
    finish,
    make_floor,
    make_sphere,
    new_scene,
    picture,
    place,
    start,
    trg_native,
)

PLASTIC = Material(0.8, 0.4, 0.2, roughness=0.3)
GLASS = Material(0.9, 1.0, 0.9, transmission=1.0, roughness=0.6)


def mixed_scene(built: bool = True) -> Any:
    """A floor, a glass and a plastic sphere, an area light and a point, seen from above."""
    lights = [
        Light(RECTANGLE, 5.0, 5.0, 4.0, position_z=2.5, direction_z=-1.0, axis_u_x=0.5, axis_v_y=0.5),
        Light(POINT, 1.0, 2.0, 3.0, position_x=1.0, position_z=2.0),
    ]
    scene = new_scene([GREY, PLASTIC, GLASS], world=0.2, lights=lights)
    add_object(scene, make_floor())
    vertices, triangles = make_sphere(16)
    normals = np.ascontiguousarray(vertices[triangles])
    add_object(scene, (vertices, triangles), 1, place(-0.4, 0.0, 0.4, 0.4), normals)
    add_object(scene, (vertices, triangles), 2, place(0.5, 0.2, 0.3, 0.3))
    Camera().apply(scene)
    if built:
        scene.build(1)
    return scene


def film_of(scene: Any, settings: Settings) -> tuple[np.ndarray, np.ndarray]:
    job = start(scene, settings)
    finish(job)
    sums = np.full((8, *film_size(settings), 3), np.nan)
    counts = np.full(8, -1, np.int64)
    job.replicates(sums, counts)
    return sums, counts


def test_columns_are_those_of_the_scene_arrays() -> None:
    assert trg_native.MATERIAL_FIELDS == MATERIAL_FIELDS
    assert trg_native.LIGHT_FIELDS == LIGHT_FIELDS
    assert trg_native.TEXTURE_FIELDS == TEXTURE_FIELDS


def test_any_number_of_threads_gives_the_same_bits() -> None:
    scene = mixed_scene()
    one, _ = film_of(scene, Settings(37, 23, samples=13, threads=1))
    for threads in (2, 5):
        other, _ = film_of(scene, Settings(37, 23, samples=13, threads=threads))
        assert np.array_equal(one, other)


def test_a_border_is_a_crop_bit_for_bit() -> None:
    scene = mixed_scene()
    whole, _ = film_of(scene, Settings(40, 30, samples=9))
    part, _ = film_of(scene, Settings(40, 30, samples=9, border=(7, 3, 29, 22)))
    assert np.array_equal(part, whole[:, 3:22, 7:29])


def test_seeds_give_different_samples_of_the_same_picture() -> None:
    scene = mixed_scene()
    a = film_of(scene, Settings(samples=256, seed=1))[0].sum(axis=0)
    b = film_of(scene, Settings(samples=256, seed=2))[0].sum(axis=0)
    assert not np.array_equal(a, b)
    assert a.mean() == pytest.approx(b.mean(), rel=0.01)


@pytest.mark.parametrize("samples", [1, 3, 8, 21])
def test_replicates_sum_to_the_picture(samples: int) -> None:
    scene, settings = mixed_scene(), Settings(20, 12, samples=samples)
    job = start(scene, settings)
    finish(job)
    sums, counts = np.zeros((8, 12, 20, 3)), np.zeros(8, np.int64)
    job.replicates(sums, counts)
    combined = np.zeros((12, 20, 4), np.float32)
    job.combined(combined)
    assert counts.tolist() == [samples // 8 + (r < samples % 8) for r in range(8)]
    assert np.allclose(combined[..., :3], sums.sum(axis=0) / samples, rtol=1e-6)
    assert (combined[..., 3] == 1.0).all()


@pytest.mark.parametrize("samples", [1, 2, 3, 21, 64])
def test_error_is_that_of_the_replicates(samples: int) -> None:
    scene, settings = mixed_scene(), Settings(20, 12, samples=samples)
    job = start(scene, settings)
    finish(job)
    sums, counts = np.zeros((8, 12, 20, 3)), np.zeros(8, np.int64)
    job.replicates(sums, counts)
    expected, given = measure_error(sums, counts), job.error()
    assert given["replicates"] == expected["replicates"]
    assert given["mse"] == (None if samples == 1 else pytest.approx(expected["mse"], rel=1e-9))
    assert given["relmse"] == (None if samples == 1 else pytest.approx(expected["relmse"], rel=1e-9))
    assert given["delete_one_mse"] == pytest.approx(expected["delete_one_mse"], rel=1e-9)


def test_the_claimed_error_is_the_error() -> None:
    # A disc over a floor in a narrow view: every pixel's truth is the form factor.
    light = Light(4, 1.0, 1.0, 1.0, position_z=1.0, direction_z=-1.0, axis_u_x=0.5, axis_v_y=0.5)
    scene = new_scene([GREY], lights=[light])
    add_object(scene, make_floor(10.0))
    Camera(eye=(0.0, 0.0, 0.5), half_width=1e-4).apply(scene)
    scene.build(1)
    truth, claimed, actual = 0.5 * 0.25 / 1.25, [], []
    for seed in range(100):
        job = start(scene, Settings(8, 8, samples=16, seed=seed, bounces=0))
        finish(job)
        pixels = np.zeros((8, 8, 4), np.float32)
        job.combined(pixels)
        claimed.append(job.error()["mse"])
        actual.append(float(((pixels[..., :3] - truth) ** 2).mean()))
    assert np.mean(claimed) / np.mean(actual) == pytest.approx(1.0, abs=0.1)


def test_cancel_ends_a_render_of_hours() -> None:
    """How soon is a matter of time: benchmarks/cancel.py."""
    scene = mixed_scene()
    job = start(scene, Settings(512, 512, samples=1 << 20, bounces=64))
    assert not job.poll(0.1)["done"]
    job.cancel()
    state = job.poll(30.0)
    assert state["done"] and state["cancelled"]
    assert state["samples"] < state["target"]


def test_a_cancelled_picture_is_a_mean_of_what_was_done() -> None:
    scene = mixed_scene()
    settings = Settings(256, 256, samples=1 << 20)
    job = start(scene, settings)
    counts = np.zeros(8, np.int64)
    sums = np.zeros((8, 256, 256, 3))
    while counts.sum() < 2:
        job.poll(0.02)
        job.replicates(sums, counts)
    job.cancel()
    assert job.poll(30.0)["done"]
    stopped, done = np.zeros((256, 256, 4), np.float32), np.zeros((256, 256, 4), np.float32)
    job.combined(stopped)
    finished = start(scene, Settings(256, 256, samples=32))
    finish(finished)
    finished.combined(done)
    assert stopped.mean() == pytest.approx(done.mean(), rel=0.02)
    job.replicates(sums, counts)
    assert counts.sum() >= 2
    assert sums.sum(axis=0).mean() / counts.sum() == pytest.approx(stopped[..., :3].mean(), rel=0.02)


def test_dropping_a_running_job_ends_it() -> None:
    scene = mixed_scene()
    job = start(scene, Settings(512, 512, samples=1 << 20))
    job.poll(0.05)
    before = threading.active_count()
    del job
    gc.collect()
    assert threading.active_count() == before
    scene.set_world(1.0, 1.0, 1.0)


def test_a_scene_in_use_cannot_change() -> None:
    scene = mixed_scene()
    job = start(scene, Settings(256, 256, samples=1 << 20))
    with pytest.raises(RuntimeError, match="in use"):
        scene.set_world(1.0, 1.0, 1.0)
    with pytest.raises(RuntimeError, match="in use"):
        scene.set_materials(pack_table([WHITE], MATERIAL_FIELDS))
    job.cancel()


def test_a_picture_can_be_read_while_it_grows() -> None:
    scene = mixed_scene()
    job = start(scene, Settings(128, 128, samples=256))
    pixels = np.zeros((128, 128, 4), np.float32)
    while not job.poll(0.01)["done"]:
        job.combined(pixels)
        assert np.isfinite(pixels).all()
        job.error()
    state = job.poll()
    assert state["samples"] == state["target"] == 256
    assert state["rays_camera"] == 256 * 128 * 128
    assert not state["cancelled"]


def test_passes_of_a_sphere() -> None:
    scene = new_scene([GREY], world=1.0)
    vertices, triangles = make_sphere(64)
    add_object(scene, (vertices, triangles), normals=np.ascontiguousarray(vertices[triangles]))
    Camera(half_width=2.0).apply(scene)
    scene.build(1)
    job = start(scene, Settings(65, 65, samples=64, passes=("depth", "normal", "alpha")))
    finish(job)
    depth, normal = np.zeros((65, 65), np.float32), np.zeros((65, 65, 3), np.float32)
    combined = np.zeros((65, 65, 4), np.float32)
    job.depth(depth)
    job.normal(normal)
    job.combined(combined)
    assert depth[32, 32] == pytest.approx(2.0, abs=1e-3)
    assert depth[0, 0] == np.float32(1e10)
    assert normal[32, 32] == pytest.approx([0, 0, 1], abs=1e-3)
    assert normal[32, 40, 0] == pytest.approx(2.0 * 2.0 * 8 / 65, abs=5e-3)
    assert (normal[0, 0] == 0).all()
    assert combined[0, 0].tolist() == [1.0, 1.0, 1.0, 0.0]
    assert combined[..., 3].mean() == pytest.approx(np.pi / 16, rel=0.01)


def test_passes_not_asked_for_are_refused() -> None:
    job = start(mixed_scene(), Settings(4, 4, samples=1))
    for read, shape in ((job.depth, (4, 4)), (job.normal, (4, 4, 3))):
        with pytest.raises(RuntimeError, match="not asked"):
            read(np.zeros(shape, np.float32))


def test_clipping_hides_from_the_camera_alone() -> None:
    scene = new_scene([GLOW])
    add_object(scene, make_floor())
    for clip, seen in (((0.1, 10.0), 1.0), ((3.5, 10.0), 0.0), ((0.1, 2.5), 0.0)):
        assert picture(scene, Settings(4, 4, samples=1), Camera(clip=clip))[..., 0].mean() == seen


def test_a_perspective_camera_sees_by_its_window() -> None:
    scene = new_scene([GLOW])
    add_object(scene, make_floor(0.5))
    pixels = picture(scene, Settings(30, 30, samples=8), Camera(eye=(0, 0, 1), kind=0, half_width=1.5))
    assert (pixels[10:20, 10:20, 0] == 1.0).all()
    assert pixels[..., 0].sum() == 100.0


def test_empty_scenes_show_their_world() -> None:
    assert (picture(new_scene([], world=0.5), Settings(7, 5, samples=2))[..., :3] == 0.5).all()
    assert (picture(new_scene([]), Settings(1, 1, samples=1))[..., :3] == 0.0).all()
    dark = new_scene([WHITE])
    add_object(dark, make_floor())
    assert (picture(dark, Settings(1, 1, samples=3))[..., :3] == 0.0).all()


def test_a_black_surface_ends_paths() -> None:
    scene = new_scene([BLACK], world=1.0)
    add_object(scene, make_floor())
    Camera().apply(scene)
    scene.build(1)
    assert finish(start(scene, Settings(4, 4, samples=4)))["rays_bounce"] == 0


def test_samples_that_are_not_finite_are_counted_and_dropped() -> None:
    light = Light(POINT, 3e38, 3e38, 3e38, position_z=1e-3)
    scene = new_scene([WHITE], lights=[light])
    add_object(scene, make_floor())
    Camera(half_width=0.01).apply(scene)
    scene.build(1)
    job = start(scene, Settings(8, 8, samples=8))
    assert finish(job)["rejected_samples"] > 0
    pixels = np.zeros((8, 8, 4), np.float32)
    job.combined(pixels)
    assert np.isfinite(pixels).all()


@pytest.mark.parametrize("border", [None, (2, 1, 7, 6)])
def test_the_first_rejected_samples_are_the_same_for_any_number_of_threads(border: Any) -> None:
    light = Light(POINT, 3e38, 3e38, 3e38, position_x=0.003, position_z=1e-3)
    scene = new_scene([WHITE], lights=[light])
    add_object(scene, make_floor())
    Camera(half_width=0.01).apply(scene)
    scene.build(1)
    found = []
    for threads in (1, 3):
        job = start(scene, Settings(8, 8, samples=8, threads=threads, border=border))
        assert finish(job)["rejected_samples"] > 16
        found.append(job.rejected_places())
    assert found[0] == found[1] == sorted(found[0], key=lambda place: place[::-1])
    assert len(found[0]) == 16
    for x, y, sample in found[0][:3]:
        alone = start(scene, Settings(8, 8, samples=sample + 1, border=(x, y, x + 1, y + 1)))
        finish(alone)
        assert (x, y, sample) in alone.rejected_places()


@pytest.mark.parametrize(
    ("column", "value"),
    [
        ("metallic", 1.5),
        ("roughness", np.nan),
        ("ior", 0.0),
        ("base_r", -1.0),
        ("emission_g", np.inf),
        ("base_texture", 0.0),
        ("specular", -1.0),
    ],
)
def test_an_impossible_material_is_named_by_row_and_column(column: str, value: float) -> None:
    table = pack_table([Material(), Material()], MATERIAL_FIELDS)
    table[1, MATERIAL_FIELDS.index(column)] = value
    with pytest.raises(ValueError, match=f"materials: row 1 has {column} = "):
        trg_native.Scene().set_materials(table)


@pytest.mark.parametrize(
    ("column", "value"), [("kind", 5.0), ("kind", 0.5), ("color_r", np.nan), ("radius", -1.0)]
)
def test_an_impossible_light_is_named_by_row_and_column(column: str, value: float) -> None:
    table = pack_table([Light(POINT, 1, 1, 1), Light(POINT, 1, 1, 1)], LIGHT_FIELDS)
    table[1, LIGHT_FIELDS.index(column)] = value
    with pytest.raises(ValueError, match=f"lights: row 1 has {column} = "):
        trg_native.Scene().set_lights(table)


def test_other_impossible_input_is_a_value_error() -> None:
    scene = mixed_scene()
    with pytest.raises(ValueError, match="image"):
        scene.set_textures(pack_table([Texture(0)], TEXTURE_FIELDS))
    with pytest.raises(ValueError, match=f"materials: expected {len(MATERIAL_FIELDS)} columns"):
        scene.set_materials(np.zeros((1, 3), np.float32))
    with pytest.raises(ValueError, match="pixels"):
        scene.add_image(np.zeros((2, 2, 2), np.uint8), True)
    with pytest.raises(ValueError, match="pixels: row 1"):
        scene.add_image(np.array([[[0.0]], [[np.nan]]], np.float32), False)
    with pytest.raises(ValueError, match="border"):
        start(scene, Settings(8, 8, border=(0, 0, 9, 8)))
    with pytest.raises(ValueError, match="samples"):
        start(scene, Settings(8, 8, samples=0))
    with pytest.raises(ValueError, match="passes"):
        start(scene, Settings(8, 8, passes=("albedo",)))
    scene.set_materials(pack_table([WHITE], MATERIAL_FIELDS))
    with pytest.raises(ValueError, match="slot_materials: material 1 of 1"):
        start(scene, Settings(8, 8))
    with pytest.raises(ValueError, match="camera"):
        bare = new_scene([])
        bare.build(1)
        start(bare, Settings(8, 8))
