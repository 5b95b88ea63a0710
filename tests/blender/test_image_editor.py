"""The image editor's part of TRG: pixels looked behind, slots compared, pictures saved."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine import session, shots  # noqa: E402
from trg_blender.engine.from_blender import SceneReader  # noqa: E402
from trg_blender.engine.probe import Shot  # noqa: E402
from trg_blender.engine.render_engine import settings_of  # noqa: E402
from trg_blender.ui import registration  # noqa: E402
from trg_blender.ui.image_editor import compare, inspect, save  # noqa: E402

from .stage import default_cube, read_exr  # noqa: E402

SIZE = (64, 36)


@pytest.fixture()
def scene():
    registration.register()
    yield default_cube(SIZE, 8)
    registration.unregister()


def shot_of(scene) -> Shot:
    graph = bpy.context.evaluated_depsgraph_get()
    arrays = SceneReader().read(scene, graph, SIZE)
    settings = settings_of(scene, scene.view_layers[0], SIZE, {}, [])
    return Shot(arrays, settings, session.render(arrays, settings).pixels, None, 8.0)


def test_a_pixel_names_object_material_and_place(scene):
    inspect.look_at(scene, shot_of(scene), 32, 18)
    assert (inspect.looked.object, inspect.looked.material) == ("Cube", "Material")
    lines = dict(inspect.fact_lines(inspect.looked.facts, 0.0, 1.0))
    assert lines["Pixel"] == "32, 18"
    assert max(abs(v) for v in inspect.looked.facts.surface.position) == pytest.approx(1.0, abs=1e-4)
    inspect.look_at(scene, shot_of(scene), 0, 35)
    assert dict(inspect.fact_lines(inspect.looked.facts, 0.0, 1.0))["Surface"] == "none"
    inspect.look_at(scene, shot_of(scene), 64, 0)
    assert inspect.looked.facts is None
    inspect.forget()


def test_nothing_is_kept_without_a_window(scene):
    bpy.ops.render.render()
    assert shots.shots.last_of(scene.name) is None
    assert shots.shots.filled_slots() == []
    assert not bpy.ops.trg.compare.poll()


def test_two_pictures_are_compared(scene):
    rng = np.random.default_rng(1)
    a = rng.random((20, 30, 4), np.float32)
    b = a.copy()
    b[5:10, 5:10, 0] += 0.5
    absolute, error, flips = compare.differ(a, b, "ABSOLUTE")
    assert error == pytest.approx(np.sqrt(25 * 0.25 / (20 * 30 * 3)), rel=1e-5)
    assert absolute[7, 7, 0] == pytest.approx(0.5) and absolute[15, 15].tolist() == [0.0, 0.0, 0.0, 1.0]
    assert 0.0 < flips < 0.2
    assert compare.differ(a, a, "FLIP")[2] == 0.0
    image = compare.show_picture(compare.DIFFERENCE, absolute)
    assert tuple(image.size) == (30, 20)
    stored = np.empty(20 * 30 * 4, np.float32)
    image.pixels.foreach_get(stored)
    assert np.array_equal(stored.reshape(absolute.shape), absolute)
    assert compare.show_picture(compare.DIFFERENCE, np.ones((4, 4, 4), np.float32)).size[0] == 4


def test_saving_leaves_the_scenes_settings_alone(scene, tmp_path: Path):
    scene.view_layers[0].use_pass_normal = True
    bpy.ops.render.render()
    scene.render.image_settings.file_format = "JPEG"
    for kind, suffix in (("PNG", ".png"), ("EXR", ".exr")):
        done = bpy.ops.trg.save_picture(filepath=str(tmp_path / "picture"), kind=kind)
        assert done == {"FINISHED"}
        assert (tmp_path / f"picture{suffix}").stat().st_size > 500
    assert scene.render.image_settings.file_format == "JPEG"
    pytest.importorskip("OpenEXR", reason="OpenEXR (requirements) reads the passes back")
    channels, _ = read_exr(tmp_path / "picture.exr")
    assert any("Normal" in name for name in channels)


def test_a_folder_that_cannot_be_is_said(scene, tmp_path: Path):
    bpy.ops.render.render()
    (tmp_path / "file").write_text("no folder")
    with pytest.raises(RuntimeError, match=r"p\.png"):
        bpy.ops.trg.save_picture(filepath=str(tmp_path / "file" / "p.png"), kind="PNG")


def test_settings_are_put_back_after_an_error(scene):
    with pytest.raises(ZeroDivisionError), save.file_settings(scene, "EXR"):
        raise ZeroDivisionError
    assert scene.render.image_settings.file_format == "PNG"
