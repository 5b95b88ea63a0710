"""A render from arrays to picture, on every device that is here."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine import session
from trg_blender.engine.devices import DEVICE_NAMES, Unavailable, find_device
from trg_blender.engine.errors import SceneError
from trg_blender.engine.native import NativeMissing, load_native
from trg_blender.engine.scene_arrays import (
    LIGHT_FIELDS,
    MATERIAL_FIELDS,
    TEXTURE_FIELDS,
    InstanceArrays,
    Material,
    RenderSettings,
    Texture,
)

from .arrays import IDENTITY, checker, floor_scene, light, look_at

SUN = light("sun", (np.pi, np.pi, np.pi), direction=(0, 0, 1))
LAMBERT = Material(0.8, 0.4, 0.2, specular=0.0)
SETTINGS = RenderSettings(8, 6, samples=16, max_bounces=2)


@pytest.fixture(params=["cpu", "embree"])
def settings(request) -> RenderSettings:
    reason = find_device(request.param).reason
    if reason is not None:
        pytest.skip(reason)
    return replace(SETTINGS, device=request.param)


def test_a_lambert_floor_under_a_sun_has_its_colour(settings):
    result = session.render(floor_scene(LAMBERT, SUN), settings)
    assert result.pixels.shape == (6, 8, 4)
    assert result.pixels.dtype == np.float32
    assert result.pixels == pytest.approx(np.broadcast_to([0.8, 0.4, 0.2, 1.0], (6, 8, 4)), rel=1e-5)


def test_pictures_have_the_bottom_row_first_and_x_to_the_right(settings):
    scene = floor_scene(
        Material(0, 0, 0, specular=0.0, emission_r=1, emission_g=1, emission_b=1, emission_texture=0)
    )
    pixels = np.zeros((2, 2, 3), np.float32)
    pixels[0, 1, 0] = 1.0
    pixels[1, 0, 1] = 1.0
    scene.images, scene.textures = [checker()], [Texture(0)]
    scene.images[0].pixels, scene.images[0].srgb = pixels, False
    scene.camera = look_at((0, 0, 3), (0, 0, 0), 4.0, kind=1)
    found = session.render(scene, replace(settings, width=2, height=2, samples=64)).pixels
    assert found[..., 0].argmax() == 1
    assert found[..., 1].argmax() == 2


def test_passes_are_those_asked_for(settings):
    scene = floor_scene(LAMBERT, SUN)
    assert session.render(scene, settings).passes == {}
    passes = session.render(scene, replace(settings, passes=("depth", "normal"))).passes
    assert passes["depth"] == pytest.approx(np.full((6, 8), 3.0), rel=1e-6)
    assert passes["normal"] == pytest.approx(np.broadcast_to([0.0, 0.0, 1.0], (6, 8, 3)), abs=1e-6)


def test_a_border_is_that_part_of_the_whole_picture(settings):
    scene = floor_scene(Material(base_texture=0, specular=0.0), SUN)
    scene.images, scene.textures = [checker(16)], [Texture(0)]
    scene.camera = look_at((0, 0, 3), (0, 0, 0), 0.9)
    whole = session.render(scene, replace(settings, samples=512))
    part = session.render(scene, replace(settings, samples=512, border=(2, 1, 7, 5)))
    assert part.pixels.shape == (4, 5, 4)
    assert part.pixels == pytest.approx(whole.pixels[1:5, 2:7], abs=0.08)


def test_a_transparent_film_leaves_the_world_out(settings):
    scene = floor_scene(LAMBERT, SUN, world=(3.0, 2.0, 1.0))
    scene.camera = look_at((0, 0, 30), (0, 0, 0), 0.4)
    opaque = session.render(scene, settings).pixels
    scene.transparent_film = True
    film = session.render(scene, replace(settings, samples=64)).pixels
    assert (opaque[..., 3] == 1.0).all()
    assert film[0, 0] == pytest.approx([0, 0, 0, 0], abs=1e-5)
    middle = film[3, 4]
    assert middle[3] == pytest.approx(1.0, abs=1e-6)
    assert middle[:3] == pytest.approx([0.8 + 2.4, 0.4 + 0.8, 0.2 + 0.2], rel=2e-2)


def test_an_empty_scene_shows_the_world(settings):
    scene = floor_scene(LAMBERT, world=(0.2, 0.3, 0.4))
    scene.meshes, scene.instances, scene.materials = [], [], []
    pixels = session.render(scene, settings).pixels
    assert pixels == pytest.approx(np.broadcast_to([0.2, 0.3, 0.4, 1.0], (6, 8, 4)), rel=1e-6)


def test_cancel_keeps_the_picture(settings):
    job = session.start(floor_scene(LAMBERT, SUN), replace(settings, width=64, height=64, samples=10_000_000))
    while job.poll(0.02).samples < 8:
        pass
    job.cancel()
    while not job.poll(0.01).done:
        pass
    result = job.result()
    assert result.report["error"]["stopped_by"] == "cancel"
    assert 8 <= result.report["samples"] < 10_000_000
    assert result.pixels[32, 32, :3] == pytest.approx([0.8, 0.4, 0.2], rel=1e-4)


def test_progress_grows_to_the_target(settings):
    job = session.start(floor_scene(LAMBERT, SUN), replace(settings, width=32, height=32, samples=256))
    seen = []
    while True:
        progress = job.poll(0.01)
        seen.append(progress.samples)
        assert job.picture().shape == (32, 32, 4)
        if progress.done:
            break
    assert seen == sorted(seen)
    assert (seen[-1], progress.target) == (256, 256)
    assert progress.rays_per_second > 0.0
    assert progress.error.rmse is not None


def test_the_seed_is_the_picture(settings):
    lamp = light(
        "area_rectangle", (5, 5, 5), (0, 0, 1), direction=(0, 0, -1), axis_u=(0.5, 0, 0), axis_v=(0, 0.5, 0)
    )
    scene = floor_scene(LAMBERT, lamp)
    first = session.render(scene, settings).pixels
    assert np.array_equal(first, session.render(scene, replace(settings, threads=1)).pixels)
    assert not np.array_equal(first, session.render(scene, replace(settings, seed=1)).pixels)


def test_vertices_that_are_not_finite_are_named_and_their_triangles_left_out(settings):
    scene = floor_scene(LAMBERT, SUN)
    mesh = scene.meshes[0]
    mesh.vertices = np.vstack([mesh.vertices, [[np.nan, 0, 0]]]).astype(np.float32)
    mesh.triangles = np.vstack([mesh.triangles, [[0, 1, 4]]]).astype(np.int32)
    mesh.uvs = None
    result = session.render(scene, settings)
    assert result.report["numerics"]["degenerate_triangles"] == 1
    assert "'Quad'" in result.report["warnings"][0]
    assert result.pixels[3, 4, :3] == pytest.approx([0.8, 0.4, 0.2], rel=1e-5)


BAD_SETTINGS = {
    "0 x 6": {"width": 0},
    "8 x -1": {"height": -1},
    "border": {"border": (3, 3, 3, 5)},
    "leaves": {"border": (0, 0, 9, 5)},
    "samples": {"samples": 0},
    "max_bounces": {"max_bounces": -1},
    "unknown passes: shadow": {"passes": ("shadow",)},
}


@pytest.mark.parametrize("word", BAD_SETTINGS)
def test_a_picture_that_cannot_be_is_refused_in_words(settings, word: str):
    with pytest.raises(SceneError, match=word):
        session.start(floor_scene(LAMBERT, SUN), replace(settings, **BAD_SETTINGS[word]))


def spoil_triangle(scene):
    scene.meshes[0].triangles = scene.meshes[0].triangles + 2


def spoil_normals(scene):
    scene.meshes[0].normals = np.zeros((1, 3, 3), np.float32)


def spoil_instance(scene):
    scene.instances.append(InstanceArrays(7, IDENTITY, np.array([0], np.int32), "Lost"))


def spoil_transform(scene):
    scene.instances.append(InstanceArrays(0, 0 * IDENTITY, np.array([0], np.int32), "Flat"))


def spoil_material(scene):
    scene.instances[0].slot_materials = np.array([3], np.int32)


def spoil_texture(scene):
    scene.materials[0] = Material(base_texture=2)


def spoil_light(scene):
    scene.lights[0] = replace(scene.lights[0], kind=17)


BAD_SCENES = {
    "mesh 'Quad': a triangle": spoil_triangle,
    "mesh 'Quad': normals": spoil_normals,
    "object 'Lost': mesh 7": spoil_instance,
    "object 'Flat': a transform": spoil_transform,
    "object 'Thing': a slot": spoil_material,
    "material 0: base_texture": spoil_texture,
    "light 0: kind 17": spoil_light,
}


@pytest.mark.parametrize("words", BAD_SCENES)
def test_a_scene_that_cannot_be_is_refused_by_the_name_of_its_object(settings, words: str):
    scene = floor_scene(LAMBERT, SUN)
    BAD_SCENES[words](scene)
    with pytest.raises(SceneError, match=words):
        session.start(scene, settings)


@pytest.mark.parametrize("name", [name for name in DEVICE_NAMES if name not in ("cpu", "embree")])
def test_an_absent_device_says_why(name: str):
    with pytest.raises(Unavailable, match=f"device {name}: not built yet"):
        session.start(floor_scene(LAMBERT, SUN), replace(SETTINGS, device=name))


def test_what_is_not_built_yet_says_so(settings):
    with pytest.raises(Unavailable, match="integrator photons"):
        session.start(floor_scene(LAMBERT, SUN), replace(settings, integrator="photons"))


def test_the_tables_of_the_native_core_have_the_same_columns():
    try:
        native = load_native()
    except NativeMissing as missing:
        pytest.skip(str(missing))
    assert tuple(native.MATERIAL_FIELDS) == MATERIAL_FIELDS
    assert tuple(native.LIGHT_FIELDS) == LIGHT_FIELDS
    assert tuple(native.TEXTURE_FIELDS) == TEXTURE_FIELDS
