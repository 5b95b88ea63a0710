"""Final renders with the TRG engine inside Blender: pictures, passes, borders, and what goes wrong."""

from __future__ import annotations

import math

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine import render_engine, run_text  # noqa: E402
from trg_blender.engine.devices import find_device  # noqa: E402
from trg_blender.engine.result import records  # noqa: E402
from trg_blender.engine.to_blender.program_runner import ProgramFailure  # noqa: E402
from trg_blender.ui import registration  # noqa: E402

from .stage import default_cube, read_exr, write_exr  # noqa: E402

SIZE = (48, 36)

pytestmark = pytest.mark.skipif(
    not (find_device("cpu").available or find_device("embree").available), reason="no device to render with"
)


@pytest.fixture(autouse=True)
def registered():
    registration.register()
    yield
    registration.unregister()


@pytest.fixture
def cube():
    return default_cube(SIZE, 16)


def render(scene, path, layers=False):
    """Renders to a float EXR; gives {channel: (h, w)} with the top row first, as files have it."""
    pytest.importorskip("OpenEXR")
    write_exr(scene, path, layers)
    return read_exr(path)[0]


def rgb(channels):
    return np.stack([channels[name] for name in "RGB"], axis=-1)


def test_the_default_cube_looks_as_in_cycles(cube, tmp_path):
    """Means of blocks of pixels, which hide the noise of both."""
    addon_utils = pytest.importorskip("addon_utils")
    cube.trg.samples = 128
    ours = rgb(render(cube, tmp_path / "trg.exr"))
    addon_utils.enable("cycles")
    try:
        cube.render.engine = "CYCLES"
        cube.cycles.samples, cube.cycles.use_denoising = 128, False
        cube.cycles.pixel_filter_type = "BOX"
        theirs = rgb(render(cube, tmp_path / "cycles.exr"))
    finally:
        cube.render.engine = "TRG"
        addon_utils.disable("cycles")
    assert ours.mean() == pytest.approx(theirs.mean(), rel=0.02)
    blocks = [each.reshape(9, 4, 12, 4, 3).mean(axis=(1, 3)) for each in (ours, theirs)]
    np.testing.assert_allclose(blocks[0], blocks[1], rtol=0.1)


def test_passes_and_the_report(cube, tmp_path):
    """Depth along the camera's axis and unit normals, in a layered EXR."""
    layer = bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_normal = True
    channels = render(cube, tmp_path / "layers.exr", layers=True)
    depth = channels["ViewLayer.Depth.Z"]
    normal = np.stack([channels[f"ViewLayer.Normal.{axis}"] for axis in "XYZ"], axis=-1)
    assert depth[0, 0] == pytest.approx(1e10)
    centre = np.array([each // 2 for each in depth.shape])
    assert 8.0 < depth[tuple(centre)] < 12.0
    length = np.linalg.norm(normal, axis=-1)
    assert length[tuple(centre)] == pytest.approx(1.0, abs=1e-3) and length[0, 0] == 0.0
    report = records.report_of(cube.name)
    assert report["size"] == list(SIZE) and report["frame"] == 1
    assert report["samples"] == 16 and report["error"]["stopped_by"] == "samples"
    low, high = report["error"]["ci95"]
    assert low < report["error"]["rmse"] < high
    assert report["seconds"]["sync"] > 0 and report["scene"]["triangles"] == 12


@pytest.mark.parametrize("crop", [False, True])
def test_a_border_is_a_part_of_the_whole_picture(cube, tmp_path, crop):
    """The part agrees with the same part of a render of everything."""
    cube.trg.samples = 64
    whole = rgb(render(cube, tmp_path / "whole.exr"))
    cube.render.use_border, cube.render.use_crop_to_border = True, crop
    cube.render.border_min_x, cube.render.border_max_x = 0.25, 0.75
    cube.render.border_min_y, cube.render.border_max_y = 1.0 / 3.0, 1.0
    part = rgb(render(cube, tmp_path / "part.exr"))
    expected = whole[:24, 12:36]
    if not crop:
        assert part.shape == whole.shape and part[24:].max() == 0.0
        part = part[:24, 12:36]
    assert part.shape == expected.shape
    assert np.abs(part - expected).mean() < 0.05 * expected.mean()


def test_every_view_layer_is_rendered(cube, tmp_path):
    bpy.context.view_layer.use_pass_z = False
    second = cube.view_layers.new("second")
    second.use_pass_z = True
    second.layer_collection.children[0].exclude = True
    channels = render(cube, tmp_path / "two.exr", layers=True)
    assert channels["ViewLayer.Combined.R"].max() > channels["second.Combined.R"].max()
    assert channels["second.Depth.Z"].min() == pytest.approx(1e10)


def test_a_transparent_film_has_holes(cube, tmp_path):
    cube.render.film_transparent = True
    alpha = render(cube, tmp_path / "holes.exr")["A"]
    assert alpha[0, 0] == 0.0 and alpha[18, 24] == 1.0


def test_an_empty_scene_shows_its_world(cube, tmp_path):
    for owner in list(bpy.data.objects):
        if owner.type != "CAMERA":
            bpy.data.objects.remove(owner)
    picture = rgb(render(cube, tmp_path / "world.exr"))
    np.testing.assert_allclose(picture, 0.05087609, rtol=1e-5)


def test_objects_move_with_the_frame(cube, tmp_path):
    """The evaluated scene of the frame is what is rendered."""
    owner = bpy.data.objects["Cube"]
    owner.keyframe_insert("location", frame=1)
    owner.location.x = 1000.0
    owner.keyframe_insert("location", frame=2)
    first = rgb(render(cube, tmp_path / "1.exr"))
    cube.frame_set(2)
    second = rgb(render(cube, tmp_path / "2.exr"))
    assert first.std() > 0.01 and second.std() < 1e-4


def test_broken_vertices_render_with_a_warning(cube, tmp_path):
    bpy.data.objects["Cube"].data.vertices[0].co.x = math.nan
    picture = rgb(render(cube, tmp_path / "nan.exr"))
    assert np.isfinite(picture).all()
    assert any("not finite" in warning for warning in records.report_of(cube.name)["warnings"])


def refused(scene, path):
    """Renders, expecting no picture; gives what Blender says."""
    scene.render.filepath = str(path)
    scene.render.image_settings.file_format = "PNG"
    with pytest.raises(RuntimeError) as error:
        bpy.ops.render.render(write_still=True)
    assert not path.exists()
    return str(error.value)


def test_no_camera_is_a_sentence_and_no_picture(cube, tmp_path):
    cube.camera = None
    assert "camera" in refused(cube, tmp_path / "none.png")


@pytest.mark.parametrize("place", ["read", "start"])
def test_a_bug_of_ours_is_one_line_and_no_picture(cube, tmp_path, monkeypatch, place):
    """Neither a traceback nor a black file, in update() or in render()."""

    def fail(*_args):
        raise ZeroDivisionError("on purpose")

    owner = render_engine.SceneReader if place == "read" else render_engine.session
    monkeypatch.setattr(owner, place, fail)
    message = refused(cube, tmp_path / "bug.png")
    assert "internal error" in message and "on purpose" in message and "Traceback" not in message
    assert records.failure_of(cube.name).kind == "internal"


def test_an_error_of_the_program_stops_the_render(cube, tmp_path, monkeypatch):
    failure = ProgramFailure("fence.trg:27:85: error: ')' has no matching '('", 1)
    monkeypatch.setattr(run_text, "take_pending_error", lambda *_: failure)
    assert "fence.trg:27:85: error: ')' has no" in refused(cube, tmp_path / "program.png")
    assert records.failure_of(cube.name).kind == "program"


def test_an_interrupt_stops_the_render(cube, tmp_path, monkeypatch):
    """^C in Blender as a module arrives in whatever Python code runs: here, the polling loop."""

    def interrupt(*_args):
        raise KeyboardInterrupt

    monkeypatch.setattr(render_engine.TRGRenderEngine, "_follow", interrupt)
    cube.trg.samples = 100_000
    assert "cancelled" in refused(cube, tmp_path / "cancelled.png")
    assert records.failure_of(cube.name).kind == "cancelled"
    assert records.report_of(cube.name)["error"]["stopped_by"] == "cancel"


def test_a_missing_device_is_said_with_its_reason(cube, tmp_path, monkeypatch):
    monkeypatch.setattr(render_engine, "choose_device", lambda *_: "cuda")
    assert "device cuda: not built yet" in refused(cube, tmp_path / "cuda.png")
    assert records.failure_of(cube.name).kind == "unavailable"


def test_a_wish_of_the_program_that_cannot_be_had_is_a_warning():
    warnings = []
    assert render_engine.choose_device("cuda", warnings) in ("cpu", "embree")
    assert warnings[0].startswith("device cuda: not built yet")


def test_registering_again_leaves_nothing_behind():
    """The standard panels know TRG only while it is registered."""
    panel = next(each for each in bpy.types.Panel.__subclasses__() if each.__name__ == "RENDER_PT_output")
    assert "TRG" in panel.COMPAT_ENGINES
    registration.unregister()
    assert "TRG" not in panel.COMPAT_ENGINES and not hasattr(bpy.types.Scene, "trg")
    registration.register()


def test_the_pixel_filter_softens_edges(cube, tmp_path):
    """A box is one pixel wide whatever the width says; a wide bell keeps the mean and lessens the slopes."""
    cube.trg.samples = 64
    pictures = {}
    for name, width in (("BOX", 1.5), ("BOX", 6.0), ("BLACKMAN_HARRIS", 6.0)):
        cube.trg.filter_type, cube.trg.filter_width = name, width
        pictures[name, width] = rgb(render(cube, tmp_path / "filtered.exr"))
    box, wide_box, bell = pictures.values()
    np.testing.assert_array_equal(box, wide_box)
    assert bell.mean() == pytest.approx(box.mean(), rel=0.02)
    assert np.abs(np.diff(bell, axis=1)).max() < 0.7 * np.abs(np.diff(box, axis=1)).max()


def animate(owner, path, values):
    for frame, value in values:
        setattr(owner, path, value)
        owner.keyframe_insert(path, frame=frame)


@pytest.mark.parametrize("position", ["START", "CENTER", "END"])
def test_motion_blur_follows_the_shutter(cube, tmp_path, position):
    """A blurred cube covers more pixels; afterwards the scene is where it was."""
    cube.trg.samples = 16
    mover = cube.objects["Cube"]
    animate(mover, "location", ((0, (-2, 0, 0)), (2, (2, 0, 0))))
    cube.frame_set(1)
    still = rgb(render(cube, tmp_path / "still.exr"))
    cube.render.use_motion_blur, cube.render.motion_blur_shutter = True, 1.0
    cube.render.motion_blur_position = position
    blurred = rgb(render(cube, tmp_path / "blurred.exr"))
    assert np.abs(blurred - still).mean() > 0.01 * still.mean()
    assert cube.frame_current == 1 and tuple(mover.location) == pytest.approx((0, 0, 0), abs=1e-5)
    assert not records.report_of(cube.name)["warnings"]


def test_a_mesh_that_changes_in_the_shutter_is_warned_of(cube, tmp_path):
    mesh = cube.objects["Cube"].data
    cube.objects["Cube"].shape_key_add(name="Basis")
    key = cube.objects["Cube"].shape_key_add(name="Grown")
    for point in key.data:
        point.co = 2.0 * point.co
    animate(mesh.shape_keys.key_blocks["Grown"], "value", ((0, 0.0), (2, 1.0)))
    cube.render.use_motion_blur = True
    render(cube, tmp_path / "grown.exr")
    (warning,) = records.report_of(cube.name)["warnings"]
    assert "'Cube'" in warning and "shutter" in warning
