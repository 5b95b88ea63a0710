"""A file that is opened runs its program when its scene wishes it and the preferences allow it."""

from __future__ import annotations

from pathlib import Path

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.ui import registration, run_on_load  # noqa: E402

PROGRAM = """Scene = scene();
Scene.Add(sphere(vec3(0, 1, 0), 1, material::gold()));
Scene.CamSet(64, 36, vec3(0, 1, 5), vec3(0, 1, 0), vec3(0, 1, 0));
Scene.Render();
"""


@pytest.fixture()
def trust():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    registration.register()
    files = bpy.context.preferences.filepaths
    before = files.use_scripts_auto_execute
    yield files
    bpy.context.preferences.filepaths.use_scripts_auto_execute = before
    registration.unregister()


def saved(path: Path, wish: bool, source: str = PROGRAM) -> str:
    text = bpy.data.texts.new("program.trg")
    text.from_string(source)
    scene = bpy.context.scene
    scene.trg.program, scene.trg.run_on_load = text, wish
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return str(path)


@pytest.mark.parametrize(("wish", "trusted", "objects"), [(1, 1, 2), (1, 0, 0), (0, 1, 0)])
def test_wish_and_trust_are_both_needed(trust, tmp_path: Path, wish: int, trusted: int, objects: int):
    path = saved(tmp_path / "scene.blend", bool(wish))
    trust.use_scripts_auto_execute = bool(trusted)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert len(bpy.context.scene.objects) == objects


def test_an_excluded_folder_is_not_trusted(trust, tmp_path: Path):
    trust.use_scripts_auto_execute = True
    assert run_on_load.may_run(str(tmp_path / "a.blend"))
    entry = bpy.context.preferences.autoexec_paths.new()
    entry.path = str(tmp_path)
    try:
        assert not run_on_load.may_run(str(tmp_path / "a.blend"))
        assert run_on_load.may_run("elsewhere/a.blend")
    finally:
        bpy.context.preferences.autoexec_paths.remove(entry)


def test_a_wrong_program_is_told_and_the_file_opens(trust, tmp_path: Path):
    path = saved(tmp_path / "scene.blend", True, "x = 1 / 0;")
    trust.use_scripts_auto_execute = True
    bpy.ops.wm.open_mainfile(filepath=path)
    (failure,) = run_on_load.run_all()
    assert "program.trg:1:5: error" in failure
