"""Renders with Persistent Data: what later frames build anew."""

from __future__ import annotations

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.devices import find_device  # noqa: E402
from trg_blender.engine.result import records  # noqa: E402
from trg_blender.ui import registration  # noqa: E402

from .stage import default_cube  # noqa: E402

pytestmark = pytest.mark.skipif(not find_device("cpu").available, reason="no native core")

NOTHING = {"built_trees": 0, "kept_trees": 2, "fitted_trees": 0, "top_level": False}


@pytest.fixture
def stage():
    registration.register()
    scene = default_cube((32, 24), 4)
    bpy.ops.mesh.primitive_uv_sphere_add(location=(2, 0, 0))
    scene.render.use_persistent_data = True
    yield scene
    registration.unregister()


def built(scene) -> dict:
    bpy.ops.render.render()
    return records.report_of(scene.name)["build"]


def test_repeated_renders_build_what_changed_alone(stage):
    assert built(stage) == {**NOTHING, "built_trees": 2, "kept_trees": 0, "top_level": True}
    assert built(stage) == NOTHING
    bpy.data.objects["Cube"].location.x = 1.0
    assert built(stage) == {**NOTHING, "top_level": True}
    bpy.data.objects["Light"].data.energy = 100.0
    bpy.data.objects["Camera"].location.z += 0.5
    assert built(stage) == NOTHING
    bpy.data.objects["Sphere"].data.vertices[0].co.z += 0.1
    bpy.data.objects["Sphere"].data.update()
    assert built(stage) == {**NOTHING, "kept_trees": 1, "fitted_trees": 1, "top_level": True}


def test_an_animation_that_moves_objects_builds_the_top_level_alone(stage, tmp_path):
    cube = bpy.data.objects["Cube"]
    for frame in (1, 3):
        cube.location.x = 0.3 * frame
        cube.keyframe_insert("location", frame=frame)
    stage.frame_end, stage.render.filepath = 3, str(tmp_path / "frame_")
    seen = []

    def note(*_):
        seen.append(records.report_of(stage.name)["build"])

    bpy.app.handlers.render_post.append(note)
    try:
        bpy.ops.render.render(animation=True)
    finally:
        bpy.app.handlers.render_post.remove(note)
    assert seen[0]["built_trees"] == 2
    assert seen[1:] == [{**NOTHING, "top_level": True}] * 2


def test_without_persistent_data_every_render_builds(stage):
    stage.render.use_persistent_data = False
    for _ in range(2):
        assert built(stage)["built_trees"] == 2
