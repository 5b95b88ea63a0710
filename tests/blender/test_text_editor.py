"""The text editor's part of TRG without a window: what it knows, offers and writes."""

from __future__ import annotations

from pathlib import Path

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine import run_text  # noqa: E402
from trg_blender.ui import registration  # noqa: E402
from trg_blender.ui.text_editor import log, menus, operators, overlay, places, project  # noqa: E402
from trg_blender.ui.text_editor.documents import documents, is_trg  # noqa: E402

PROGRAM = """include("part.trg");
Scene = scene();
Scene.Add(ball(2));
Scene.Add(model("cow.g3dm", enviroment(0, 1), material::gold()));
Scene.CamSet(64, 36, vec3(0, 1, 5), vec3(0, 1, 0), vec3(0, 1, 0));
print("made");
Scene.Render();
"""
PART = "ball = function(r) { return sphere(vec3(0, 1, 0), r, material::gold()); };\n"


@pytest.fixture()
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    registration.register()
    yield bpy.context.scene
    registration.unregister()


def text_of(name: str, source: str):
    text = bpy.data.texts.new(name)
    text.from_string(source)
    return text


def test_a_text_is_trg_by_its_name_or_file(scene, tmp_path: Path):
    assert is_trg(text_of("a.trg", ""))
    assert not is_trg(text_of("a.py", ""))
    assert not is_trg(None)
    (tmp_path / "b.trg").write_text("a = 1;\n")
    loaded = bpy.data.texts.load(str(tmp_path / "b.trg"))
    loaded.name = "renamed"
    assert is_trg(loaded)


def test_colours_follow_the_text_and_mistakes_wait_for_a_rest(scene):
    text = text_of("a.trg", "x = shpere(1);\n")
    document = documents.look(text)
    assert [run.kind for run in document.runs[0]] == ["symbol", "symbol", "number", "symbol", "symbol"]
    assert document.analysis is None
    assert documents.check_rested() and not document.is_checked
    document.changed -= 1.0
    assert documents.check_rested() and document.is_checked
    (mistake,) = overlay.mistakes_by_line(document, "a.trg").values()
    assert (mistake.code, mistake.span.col) == ("E302", 5)
    text.from_string("x = sphere(vec3(0), 1, material::gold());\n")
    assert not documents.look(text).is_checked
    assert documents.look(text).analysis is document.analysis  # the old one until the text rests
    assert overlay.mistakes_by_line(documents.check(text), "a.trg") == {}


def test_an_error_wins_over_a_warning_of_its_line(scene):
    text = text_of("a.trg", "a = 1; if (a = 2) shpere(1);\n")
    found = overlay.mistakes_by_line(documents.check(text), "a.trg")
    assert [found[0].severity, len(found)] == ["error", 1]


def test_the_completion_offers_what_begins_like_the_word(scene):
    text = text_of("a.trg", "radius = 1;\nx = rad;\n")
    text.cursor_set(1, character=7)
    assert operators.suggestions(text)[0][0] == "radius"
    operators.insert_word(text, "radius")
    assert text.as_string() == "radius = 1;\nx = radius;\n"
    text.from_string("m = material::go;\n")
    text.cursor_set(0, character=16)
    assert "gold" in [item[0] for item in operators.suggestions(text)]


def test_comments_go_on_and_off(scene):
    lines = ["  a = 1;", "", "    b = 2;"]
    commented = operators.toggled(lines)
    assert commented == ["  // a = 1;", "", "  //   b = 2;"]
    assert operators.toggled(commented) == lines


def test_a_program_knows_its_includes_and_files(scene):
    scene.trg.program = text_of("main.trg", PROGRAM)
    text_of("part.trg", PART)
    assert operators.included_by(scene) == {"part.trg"}
    assert bpy.ops.trg.build() == {"FINISHED"}
    rows = [(row.kind, row.name, row.depth, row.is_open) for row in project.project_rows(scene)]
    assert rows == [
        ("program", "main.trg", 0, True), ("include", "part.trg", 1, True), ("model", "cow.g3dm", 1, False),
    ]  # fmt: skip
    assert project.project_rows(scene)[2].icon == "ERROR"  # the model is nowhere


def test_the_log_is_filtered_and_its_places_found(scene):
    scene.trg.program = text_of("main.trg", PROGRAM)
    text_of("part.trg", PART)
    bpy.ops.trg.build()
    rows = log.log_rows(run_text.program_log(scene), "", only_problems=False)
    assert "made" in [row.text for row in rows]
    (warning,) = log.log_rows(run_text.program_log(scene), "COW", only_problems=True)
    assert (warning.file, warning.line) == ("main.trg", 4)
    assert bpy.ops.trg.log_clear() == {"FINISHED"}
    assert run_text.program_log(scene) == []


def test_an_error_tells_its_place_to_whoever_asks(scene):
    scene.trg.program = text_of("main.trg", "a = 1;\nb = 1 / 0;\n")
    with pytest.raises(RuntimeError):
        bpy.ops.trg.build()
    (found,) = run_text.last_diagnostics(scene)
    assert (found.span.file, found.span.line) == ("main.trg", 2)


def test_a_place_in_the_library_opens_its_file(scene):
    name = "stl/arrange.trg"
    text = places.text_named(name)
    assert text is not None and "arrange::" in text.as_string()
    assert places.text_named(name) == text
    assert places.text_named("nowhere.trg") is None


def test_every_example_is_a_template_that_compiles(scene):
    found = menus.templates()
    assert len(found) >= 10
    for path in found:
        text = bpy.data.texts.load(str(path))
        assert [d.message for d in documents.check(text).analysis.diagnostics if d.severity == "error"] == []


def test_reload_reads_the_file_again(scene, tmp_path: Path):
    path = tmp_path / "a.trg"
    path.write_text("a = 1;\n")
    text = bpy.data.texts.load(str(path))
    path.write_text("a = 2;\n")
    assert bpy.ops.trg.reload(name=text.name) == {"FINISHED"}
    assert text.as_string() == "a = 2;\n"
    path.unlink()
    with pytest.raises(RuntimeError, match=r"a\.trg"):
        bpy.ops.trg.reload(name=text.name)


def test_nothing_is_left_behind(scene):
    registration.unregister()
    try:
        assert not hasattr(bpy.types.WindowManager, "trg_log")
        assert not hasattr(bpy.types, "TRG_TEXT_PT_log")
        functions = getattr(bpy.types.TEXT_MT_templates.draw, "_draw_funcs", [])
        assert not [each for each in functions if each.__module__.startswith("trg_blender")]
    finally:
        registration.register()
