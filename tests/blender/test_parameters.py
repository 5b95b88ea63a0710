"""Exported parameters as properties of a scene."""

from __future__ import annotations

import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.cli import main  # noqa: E402
from trg_blender.engine import run_text  # noqa: E402
from trg_blender.ui import live_parameters, registration  # noqa: E402

PROGRAM = """export radius = 3 ~ "num" ~ range(0.5, 10); // of the ball
export count = 2 ~ range(1, 5, 1);
export tint = vec3(1, 0.5, 0) ~ "colour";
export look = "gold" ~ choice("gold", "silver");
export fog = 0 ~ "flag";
export label = "hi";
S = scene();
S.CamSet(32, 18, vec3(0, 1, 30), vec3(0, 1, 0), vec3(0, 1, 0));
for (i = 0; i < count; i++) S.Add(sphere(vec3(i * 3, 0, 0), radius));
print(radius, count, tint, look, fog, label);
while (1) S.Render();
"""
FIGURES = ("radius", "count", "tint", "look", "fog", "label")


@pytest.fixture()
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    registration.register()
    yield bpy.context.scene
    registration.unregister()


def _give(scene, source=PROGRAM):
    text = bpy.data.texts.new("program.trg")
    text.from_string(source)
    scene.trg.program = text
    return text


def _run(scene, frame=1):
    """What the program printed in this run."""
    log = run_text.program_log(scene)
    log.clear()
    outcome = run_text.run_program(scene, frame)
    return log[-1] if log else "", outcome


def test_choosing_a_program_offers_its_parameters(scene):
    _give(scene)
    parameters = scene.trg.parameters
    assert tuple(parameters.keys()) == FIGURES
    looks = parameters.id_properties_ui("radius").as_dict()
    assert (looks["min"], looks["max"], looks["default"]) == (0.5, 10.0, 3.0)
    assert looks["description"] == "of the ball"
    assert isinstance(parameters["count"], int) and parameters["fog"] is False
    assert parameters.id_properties_ui("tint").as_dict()["subtype"] == "COLOR"
    assert [item[0] for item in parameters.id_properties_ui("look").as_dict()["items"]] == ["gold", "silver"]


def test_a_changed_value_runs_the_program_again(scene):
    _give(scene)
    assert _run(scene)[0] == "3 2 vec3(1, 0.5, 0) gold 0 hi"
    assert _run(scene)[0] == ""  # nothing changed: the frame is there
    parameters = scene.trg.parameters
    parameters["radius"], parameters["count"], parameters["look"] = 4.0, 3, 1
    parameters["fog"], parameters["label"] = True, "ho"
    said, outcome = _run(scene)
    assert said == "4 3 vec3(1, 0.5, 0) silver 1 ho" and outcome.failure is None
    assert [o.type for o in scene.objects].count("MESH") == 3


def test_values_stay_when_the_text_changes_and_move_into_the_new_range(scene):
    text = _give(scene)
    scene.trg.parameters["radius"], scene.trg.parameters["count"] = 7.0, 4
    narrower = PROGRAM.replace("range(1, 5, 1)", "range(1, 3, 1)")
    text.from_string(narrower.replace('export fog = 0 ~ "flag";', "fog = 0;"))
    said, outcome = _run(scene)
    assert outcome.failure is None and said.startswith("7 3 ")
    assert "fog" not in scene.trg.parameters


def test_a_value_that_an_animation_drives_out_of_its_range_stays_inside(scene):
    _give(scene)
    scene.trg.parameters["radius"] = 44.0
    said, outcome = _run(scene)
    assert outcome.failure is None and said.startswith("10 ")


def test_parameters_can_be_keyed(scene):
    _give(scene)
    parameters = scene.trg.parameters
    for frame, radius in ((1, 1.0), (5, 5.0)):
        parameters["radius"] = radius
        assert parameters.keyframe_insert('["radius"]', frame=frame)
    scene.frame_set(5)
    assert _run(scene, 5)[0].startswith("5 ")
    scene.frame_set(1)
    assert _run(scene, 1)[0].startswith("1 ")


def _move(scene, name, value):
    """What the interface does when a slider moves: set the property, tag its scene, update."""
    scene.trg.parameters[name] = value
    scene.update_tag()
    bpy.context.view_layer.update()


def _is_waiting():
    return bpy.app.timers.is_registered(live_parameters.run_when_settled)


def _width(scene):
    (ball,) = [o for o in scene.objects if o.name.startswith("sphere")][:1]
    return ball.dimensions.x


def test_a_slider_that_moved_and_rests_runs_the_program(scene):
    _give(scene)
    _run(scene)
    bpy.context.view_layer.update()
    assert not _is_waiting()
    _move(scene, "radius", 4.0)
    assert _is_waiting()
    scene.trg.parameters["radius"] = 5.0  # still moving when the timer comes
    assert live_parameters.run_when_settled() == live_parameters.REST_SECONDS
    log = run_text.program_log(scene)
    log.clear()
    assert live_parameters.run_when_settled() is None
    assert log[-1].startswith("5 ")
    bpy.context.view_layer.update()
    assert _width(scene) == pytest.approx(10.0)


def test_other_changes_of_a_scene_run_no_program(scene):
    _give(scene)
    _run(scene)
    scene.update_tag()
    bpy.context.view_layer.update()
    scene.objects[0].location.x = 3.0
    bpy.context.view_layer.update()
    assert not _is_waiting()


def test_a_frame_that_moves_a_keyed_slider_runs_no_program_by_itself(scene):
    _give(scene)
    for frame, radius in ((1, 1.0), (5, 5.0)):
        scene.trg.parameters["radius"] = radius
        scene.trg.parameters.keyframe_insert('["radius"]', frame=frame)
    _run(scene)
    scene.frame_set(5)
    scene.update_tag()
    bpy.context.view_layer.update()
    assert not _is_waiting()


def test_what_a_slider_breaks_is_said_and_mended(scene):
    _give(scene, PROGRAM.replace("print(radius", "x = 1 / (radius - 4); print(radius"))
    _run(scene)
    bpy.context.view_layer.update()
    _move(scene, "radius", 4.0)
    live_parameters.run_when_settled()
    assert "division by zero" in live_parameters.failure_of(scene)
    _move(scene, "radius", 5.0)
    live_parameters.run_when_settled()
    assert live_parameters.failure_of(scene) == ""


def test_frames_of_a_keyed_slider_do_not_depend_on_the_way_there(scene):
    """Frame k with its value is the k-th Render() of a run that had this value from the start."""
    _give(scene)
    for frame, radius in ((1, 1.0), (5, 5.0)):
        scene.trg.parameters["radius"] = radius
        scene.trg.parameters.keyframe_insert('["radius"]', frame=frame)
    widths = {}
    for frame in (1, 3, 5, 3, 1):
        scene.frame_set(frame)
        assert run_text.run_program(scene, frame).failure is None
        bpy.context.view_layer.update()
        assert widths.setdefault(frame, _width(scene)) == _width(scene)
    assert widths[1] == pytest.approx(2.0) and widths[5] == pytest.approx(10.0)


def test_values_are_saved_with_the_file(scene, tmp_path):
    _give(scene)
    scene.trg.parameters["radius"] = 6.0
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "a.blend"))
    assert _run(bpy.context.scene)[0].startswith("6 ")


def test_a_wrong_program_may_be_chosen(scene):
    _give(scene, "export a = ;")
    assert tuple(scene.trg.parameters.keys()) == ()


@pytest.mark.parametrize("setting", ["raduis=4", "radius=40"])
def test_trg_render_refuses_a_wrong_set(setting, tmp_path, capsys):
    file = tmp_path / "m.trg"
    file.write_text(PROGRAM)
    assert main(["render", str(file), "--set", setting, "-o", str(tmp_path / "a.png")]) == 2
    assert "radius" in capsys.readouterr().err


def test_trg_render_sets_parameters(tmp_path):
    file = tmp_path / "m.trg"
    file.write_text(PROGRAM)
    picture = tmp_path / "a.png"
    words = ["render", str(file), "--set", "count=5", "--samples", "1", "--device", "cpu", "-o", str(picture)]
    assert main([*words, "--quiet"]) == 0
    assert picture.is_file()
    assert [o.type for o in bpy.context.scene.objects].count("MESH") == 5
