"""Preferences of the extension: folders that programs may read, and the limits of programs."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.to_blender import text_files, user_settings  # noqa: E402
from trg_blender.engine.to_blender.program_runner import host_options  # noqa: E402
from trg_blender.lang.limits import Limits  # noqa: E402
from trg_blender.ui import preferences, registration  # noqa: E402


@pytest.fixture()
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    registration.register()
    yield bpy.context.scene
    registration.unregister()


def use(monkeypatch, **values):
    monkeypatch.setattr(user_settings, "_preferences", lambda: SimpleNamespace(**values))


def test_a_module_has_no_preferences_and_takes_the_defaults(scene):
    assert host_options(scene).limits == Limits()
    assert user_settings.user_folders() == []


def test_limits_of_the_preferences_reach_the_program(scene, monkeypatch):
    use(monkeypatch, max_steps=12_345, max_seconds=7.5)
    limits = host_options(scene).limits
    assert (limits.max_steps, limits.max_seconds) == (12_345, 7.5)
    assert limits.max_string == Limits().max_string


def test_every_shown_limit_is_a_limit_with_its_default(scene):
    shown = preferences.TRGPreferences.bl_rna.properties
    for name in preferences.SHOWN_LIMITS:
        assert shown[name].default == getattr(Limits(), name)


def test_a_folder_of_the_user_may_be_read_and_others_not(scene, monkeypatch, tmp_path):
    allowed, other = tmp_path / "allowed", tmp_path / "other"
    for folder in (allowed, other):
        folder.mkdir()
        (folder / "part.trg").write_text("x = 1;", encoding="utf-8")
    text = bpy.data.texts.new("program.trg")
    with pytest.raises(text_files.FileError):
        text_files.TextFiles(text).resolve_include("part.trg", "program.trg")
    use(monkeypatch, folders=[SimpleNamespace(path=str(allowed))])
    assert text_files.allowed_folders(text) == [allowed]
    assert text_files.TextFiles(text).resolve_include("part.trg", "program.trg").text == "x = 1;"


def test_the_language_of_messages_is_the_users_choice(scene, monkeypatch):
    assert host_options(scene).language == "en"
    use(monkeypatch, language="RU")
    assert host_options(scene).language == "ru"
    use(monkeypatch, language="AUTO")
    assert host_options(scene).language == "en"
