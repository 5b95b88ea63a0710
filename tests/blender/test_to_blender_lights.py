"""Lights of a program in Cycles: the radiance of a white surface is what the records promise."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")
addon_utils = pytest.importorskip("addon_utils")

from trg_blender.engine.to_blender import SceneMirror  # noqa: E402
from trg_blender.engine.to_blender.tags import KEY  # noqa: E402
from trg_blender.lang.scene import IDENTITY, CameraRecord, LightRecord, SceneDescription  # noqa: E402

COLOR = (0.8, 0.4, 0.2)
DISTANCE = 3.0
# Looks straight down on the origin from below the lights.
CAMERA = CameraRecord(4, 4, (0.0, 0.5, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -1.0), fov_degrees=0.2)
ABOVE = (0.0, DISTANCE, 0.0)
DOWN = (0.0, -1.0, 0.0)


@pytest.fixture(scope="module", autouse=True)
def cycles():
    addon_utils.enable("cycles")
    yield
    addon_utils.disable("cycles")


@pytest.fixture
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene


def add_white_floor(scene: bpy.types.Scene) -> None:
    """A Lambert surface of albedo 1 at the origin, too small to see itself."""
    bpy.ops.mesh.primitive_plane_add(size=0.1)
    material = bpy.data.materials.new("white")
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(material)


def radiance(scene: bpy.types.Scene, light: LightRecord, tmp_path, samples: int = 256) -> np.ndarray:
    """What Cycles shows of the white floor under the light alone."""
    add_white_floor(scene)
    SceneMirror(scene).apply(SceneDescription(1, (), (light,), CAMERA, background=(0.0, 0.0, 0.0)))
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = samples, False
    scene.cycles.use_adaptive_sampling = False
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(tmp_path / "cycles.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.empty(16 * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(16, -1)[:, :3].mean(axis=0)


def test_a_facing_surface_under_a_dir_light_has_the_lights_colour(scene, tmp_path):
    light = LightRecord("l", 1, "dir", COLOR, direction=(0.0, 2.0, 0.0))
    np.testing.assert_allclose(radiance(scene, light, tmp_path), COLOR, rtol=1e-3)


def test_dir_light_comes_from_where_its_direction_points(scene, tmp_path):
    light = LightRecord("l", 1, "dir", COLOR, direction=(0.6, 0.8, 0.0))
    np.testing.assert_allclose(radiance(scene, light, tmp_path), np.array(COLOR) * 0.8, rtol=1e-3)


def test_a_dir_light_from_below_leaves_the_surface_dark(scene, tmp_path):
    light = LightRecord("l", 1, "dir", COLOR, direction=(0.0, -1.0, 0.0))
    assert radiance(scene, light, tmp_path).max() == 0.0


def test_point_light_falls_with_the_square_of_the_distance(scene, tmp_path):
    light = LightRecord("l", 1, "point", COLOR, position=ABOVE)
    np.testing.assert_allclose(radiance(scene, light, tmp_path), np.array(COLOR) / DISTANCE**2, rtol=1e-3)


def test_moved_light_stands_where_its_transform_says(scene, tmp_path):
    lifted = (*IDENTITY[:7], DISTANCE - 1.0, *IDENTITY[8:])
    light = LightRecord("l", 1, "point", COLOR, position=(0.0, 1.0, 0.0), transform=lifted)
    np.testing.assert_allclose(radiance(scene, light, tmp_path), np.array(COLOR) / DISTANCE**2, rtol=1e-3)


def test_inside_its_inner_cone_a_spot_is_a_point_light(scene, tmp_path):
    light = LightRecord("l", 1, "spot", COLOR, position=ABOVE, direction=DOWN, angle_in=20.0, angle_out=40.0)
    np.testing.assert_allclose(radiance(scene, light, tmp_path), np.array(COLOR) / DISTANCE**2, rtol=1e-3)


@pytest.mark.parametrize(("tilt", "is_lit"), [(9.0, True), (15.0, None), (21.0, False)])
def test_spot_fades_between_its_two_cones(scene, tmp_path, tilt, is_lit):
    aside = (np.sin(np.radians(tilt)), -np.cos(np.radians(tilt)), 0.0)
    light = LightRecord("l", 1, "spot", COLOR, position=ABOVE, direction=aside, angle_in=20.0, angle_out=40.0)
    share = radiance(scene, light, tmp_path)[0] / (COLOR[0] / DISTANCE**2)
    # Blender's smoothstep over the cosine.
    cos = np.cos(np.radians([tilt, 10.0, 20.0]))
    t = np.clip((cos[0] - cos[2]) / (cos[1] - cos[2]), 0.0, 1.0)
    assert share == pytest.approx(t * t * (3.0 - 2.0 * t), abs=0.02)
    if is_lit is not None:
        assert share == pytest.approx(float(is_lit), abs=1e-3)


def test_area_light_has_the_radiance_of_its_colour(scene, tmp_path):
    width, height = 0.5, 0.25
    light = LightRecord("l", 1, "area", COLOR, position=ABOVE, direction=DOWN, size=(width, height))
    # Irradiance of a small rectangle right above, by a fine grid.
    x, y = np.meshgrid((np.arange(200) + 0.5) / 200 - 0.5, (np.arange(200) + 0.5) / 200 - 0.5)
    squared = (x * width) ** 2 + (y * height) ** 2 + DISTANCE**2
    irradiance = (DISTANCE**2 / squared**2).mean() * width * height
    expected = np.array(COLOR) * irradiance / pi
    np.testing.assert_allclose(radiance(scene, light, tmp_path, samples=1024), expected, rtol=1e-2)


def test_other_falloff_is_kept_on_the_object_and_dropped_again(scene):
    mirror = SceneMirror(scene)
    light = LightRecord("l", 1, "point", COLOR, falloff=(1.0, 0.5, 0.0))
    mirror.apply(SceneDescription(1, (), (light,)))
    obj = next(o for o in scene.objects if o.get(KEY) == "l")
    assert tuple(obj["trg_falloff"]) == (1.0, 0.5, 0.0)
    mirror.apply(SceneDescription(2, (), (LightRecord("l", 2, "point", COLOR),)))
    assert "trg_falloff" not in obj


def test_a_light_may_change_its_kind(scene):
    mirror = SceneMirror(scene)
    mirror.apply(SceneDescription(1, (), (LightRecord("l", 1, "point", COLOR),)))
    mirror.apply(
        SceneDescription(2, (), (LightRecord("l", 2, "area", COLOR, direction=DOWN, size=(1.0, 2.0)),))
    )
    (obj,) = [o for o in scene.objects if o.type == "LIGHT"]
    assert (obj.data.type, obj.data.size, obj.data.size_y) == ("AREA", 1.0, 2.0)
