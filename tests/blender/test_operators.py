"""Operators as a user calls them."""

from __future__ import annotations

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.ui import registration  # noqa: E402

BALL = """Scene = scene();
Scene.Add(sphere(vec3(0, 1, 0), 1, material::gold()));
Scene.CamSet(64, 36, vec3(0, 1, 5), vec3(0, 1, 0), vec3(0, 1, 0));
Scene.Render();
"""


@pytest.fixture()
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    registration.register()
    yield bpy.context.scene
    registration.unregister()


def give_program(scene, source):
    text = bpy.data.texts.new("program.trg")
    text.from_string(source)
    scene.trg.program = text


def test_build_makes_the_scene_of_a_file_that_has_no_camera(scene):
    give_program(scene, BALL)
    assert scene.camera is None
    assert bpy.ops.trg.build() == {"FINISHED"}
    assert scene.camera is not None
    assert [o.type for o in scene.objects].count("MESH") == 1


def test_build_is_not_offered_without_a_program(scene):
    assert not bpy.ops.trg.build.poll()


def test_build_reports_a_wrong_program_with_its_place(scene):
    give_program(scene, "Scene = scene();\nScene.Ad(1);\n")
    with pytest.raises(RuntimeError, match=r"program\.trg:2:1: error"):
        bpy.ops.trg.build()
    assert len(scene.objects) == 0
