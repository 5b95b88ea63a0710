"""Programs in a scene: the timeline is the program's frames; what is wrong with a program is said."""

from __future__ import annotations

import threading
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine import run_text  # noqa: E402
from trg_blender.engine.to_blender.main_thread import MainThread, MainThreadBusy  # noqa: E402
from trg_blender.engine.to_blender.program_runner import EXIT_BUDGET, EXIT_WRONG, ProgramRunner  # noqa: E402

# The paper's program with its one misplaced bracket mended.
PAPER = """include("stl\\\\rt\\\\trg_raytrace.trg");

std::setrndmode("cuda");

Scene = scene();

BuildFence = function( s = 15 ~ "num", gr = 6 ~ "num", a = #vec3(0) ~ "vec3" )
{
    #Scene.Add(#fence(a + #vec3(0, 1, 0), s, 2, gr, #material::blue_plastic()));
    i = 0;
    an = #mth::Degree2Radian(90);
    P1 = #mth::Degree2Radian(360) / gr;
    while (i < gr)
    {
        #Scene.Add(#conus(#vec3(an * s, 1, s), 1, 3, material::red_plastic()));
        an += P1;
        i++;
    }
};

t = texture("chess.g24", 2);
a = material::white_plastic();
a.SetTexture(t, 1);
Scene.Add(tor(vec3(0, 0.75, 1), 0.75, 5, material::green_plastic()));
BuildFence(15, 6);

Scene.Add(model("BIN\\\\MODELS\\\\cow.g3dm", enviroment(0, 1), material::red_plastic()));

Scene.Add(plane(vec3(0, 1, 0), 0, material::silver()));

p = dir_light(vec3(-7, 5, 8), vec3(1, 1, 1));
Scene.Add(p);

while (1)
{
    Scene.CamSet(1920, 1080, vec3(30, 10, 30 * mth::sin(i / 180 * 3.14)),
                vec3(0, 0, 0), vec3(0, 1, 0));
    Scene.Render();
    i += 3;
}
"""
MOVING = """Scene = scene();
s = sphere(vec3(0, 1, 0), 1, material::silver());
Scene.Add(s);
Scene.Add(sphere(vec3(5, 1, 0), 1, material::silver()));
while (1)
{
    Scene.Render();
    s.Move(vec3(1, 0, 0));
}
"""


@pytest.fixture
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene


def new_text(source: str, name: str = "scene.trg") -> bpy.types.Text:
    text = bpy.data.texts.new(name)
    text.write(source)
    return text


def x_of_spheres(scene) -> list[float]:
    bpy.context.view_layer.update()
    return sorted(obj.matrix_world.translation.x for obj in scene.objects if obj.get("trg_kind") == "sphere")


def test_the_papers_program_runs_three_frames_with_its_camera_moving(scene):
    runner, text = ProgramRunner(), new_text(PAPER)
    places = []
    for frame in (1, 2, 3):
        outcome = runner.run(scene, text, frame)
        assert outcome.failure is None, outcome.failure
        bpy.context.view_layer.update()
        places.append(tuple(scene.camera.matrix_world.translation))
        if frame > 1:
            assert outcome.counts.total == outcome.counts.updated == 1
    # (x, y, z) of TRG is (x, -z, y); i counts 0, 3, 6.
    expected = [(30.0, -30.0 * np.sin(i / 180 * 3.14), 10.0) for i in (0, 3, 6)]
    np.testing.assert_allclose(places, expected, atol=1e-5)
    kinds = sorted(obj.get("trg_kind") for obj in scene.objects)
    assert kinds == ["camera", *["conus"] * 6, "dir", "fence", "model", "plane", "tor"]
    assert (scene.render.resolution_x, scene.render.resolution_y) == (1920, 1080)
    assert any("cow.g3dm" in line for line in runner.log)


def test_a_frame_writes_only_what_its_program_moved(scene):
    runner, text = ProgramRunner(), new_text(MOVING)
    runner.run(scene, text, 1)
    outcome = runner.run(scene, text, 2)
    assert (outcome.counts.updated, outcome.counts.total) == (1, 1)
    assert x_of_spheres(scene) == [1.0, 5.0]
    assert runner.run(scene, text, 2).counts.total == 0


def test_going_forward_runs_ahead_and_going_back_runs_anew(scene):
    runner, text = ProgramRunner(), new_text(MOVING)
    runner.run(scene, text, 12)
    assert x_of_spheres(scene) == [5.0, 11.0]
    runner.run(scene, text, 4)
    assert x_of_spheres(scene) == [3.0, 5.0]
    assert len(scene.objects) == 2


def test_an_edited_text_is_compiled_again_and_an_equal_one_is_not(scene):
    runner, text = ProgramRunner(), new_text(MOVING)
    runner.run(scene, text, 1)
    program = runner._program
    runner.run(scene, text, 2)
    assert runner._program is program
    text.from_string(MOVING.replace("vec3(1, 0, 0)", "vec3(2, 0, 0)"))
    runner.run(scene, text, 2)
    assert x_of_spheres(scene) == [2.0, 5.0]


def test_the_last_frame_of_a_program_that_ends_stays(scene):
    text = new_text("S = scene(); S.Add(sphere(vec3(7, 0, 0), 1, material::gold())); S.Render();")
    outcome = ProgramRunner().run(scene, text, 5)
    assert (outcome.failure, outcome.ended) == (None, True)
    assert x_of_spheres(scene) == [7.0]


def test_a_program_without_a_frame_is_wrong(scene):
    outcome = ProgramRunner().run(scene, new_text("S = scene();"), 1)
    assert outcome.failure.exit_code == EXIT_WRONG
    assert "Scene.Render()" in outcome.failure.text


def test_a_syntax_error_names_file_line_and_column_and_leaves_the_scene(scene):
    runner, text = ProgramRunner(), new_text(MOVING)
    runner.run(scene, text, 1)
    text.from_string("S = scene(;\n")
    outcome = runner.run(scene, text, 1)
    assert outcome.failure.exit_code == EXIT_WRONG
    assert outcome.failure.text.startswith("scene.trg:1:11: error: ")
    assert outcome.failure.diagnostics[0].span.line == 1
    assert len(scene.objects) == 2
    assert runner.log[-1] == outcome.failure.text


def test_an_error_while_running_names_its_place_and_the_next_run_starts_anew(scene):
    runner, text = ProgramRunner(), new_text("S = scene();\nS.Render();\nx = 1 / 0;\n")
    assert runner.run(scene, text, 1).failure is None
    outcome = runner.run(scene, text, 2)
    assert outcome.failure.text.startswith("scene.trg:3:")
    assert outcome.failure.exit_code == EXIT_WRONG
    assert runner.run(scene, text, 1).failure is None


def test_an_endless_loop_without_frames_is_out_of_budget(scene):
    outcome = ProgramRunner().run(scene, new_text("S = scene();\ni = 0;\nwhile (1) { i++; }\n"), 1)
    assert outcome.failure.exit_code == EXIT_BUDGET
    assert outcome.failure.text.startswith("scene.trg:3:")


def test_output_and_warnings_land_in_the_log_once(scene):
    runner = ProgramRunner()
    text = new_text(
        'S = scene();\nwhile (1) { print("frame ", std::frame()); x = y + 1; S.Render(); y = 1; }'
    )
    for frame in (1, 2, 2, 3):
        runner.run(scene, text, frame)
    prints = [line for line in runner.log if line.startswith("frame")]
    assert len(prints) == 3
    assert sum("warning" in line for line in runner.log) == 1


def test_texts_of_the_blend_are_included_before_files(scene, tmp_path):
    (tmp_path / "part.trg").write_text("size = 9;", encoding="utf-8")
    (tmp_path / "disk.trg").write_text("height = 4;", encoding="utf-8")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    new_text("size = 3;", "part.trg")
    text = new_text(
        'include("part.trg"); include("disk.trg"); S = scene();\n'
        "S.Add(sphere(vec3(size, height, 0), 1, material::gold())); S.Render();"
    )
    runner = ProgramRunner()
    outcome = runner.run(scene, text, 1)
    assert outcome.failure is None, outcome.failure
    (obj,) = scene.objects
    assert tuple(obj.location) == (3.0, 0.0, 4.0)
    bpy.data.texts["part.trg"].from_string("size = 5;")
    runner.run(scene, text, 1)
    assert scene.objects[0].location.x == 5.0


def test_a_model_is_found_beside_the_file_of_the_text(scene, tmp_path):
    (tmp_path / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n")
    source = 'S = scene(); S.Add(model("t.obj", enviroment(0, 1), material::gold())); S.Render();'
    (tmp_path / "scene.trg").write_text(source, encoding="utf-8")
    text = bpy.data.texts.load(str(tmp_path / "scene.trg"))
    assert ProgramRunner().run(scene, text, 1).failure is None
    assert len(scene.objects[0].data.polygons) == 1


def test_an_impossible_scene_is_a_failure_with_its_place(scene, tmp_path):
    (tmp_path / "bad.g3dm").write_bytes(b"nonsense")
    source = 'S = scene();\nS.Add(model("bad.g3dm", enviroment(0, 1), material::gold()));\nS.Render();'
    (tmp_path / "scene.trg").write_text(source, encoding="utf-8")
    text = bpy.data.texts.load(str(tmp_path / "scene.trg"))
    outcome = ProgramRunner().run(scene, text, 1)
    assert outcome.failure.text.startswith("scene.trg:2:")
    assert "bad.g3dm" in outcome.failure.text
    assert len(scene.objects) == 0


@pytest.fixture
def with_program(scene, monkeypatch):
    """A scene whose program is `MOVING`, as the properties of the interface would hold it."""
    text = new_text(MOVING)
    monkeypatch.setattr(run_text, "program_of", lambda _: text)
    monkeypatch.setattr(run_text, "ENGINE_ID", scene.render.engine)
    run_text.programs.forget_all()
    yield SimpleNamespace(scene=scene, text=text)
    run_text.programs.forget_all()


def test_the_handlers_build_the_frame_of_the_timeline(with_program):
    scene = with_program.scene
    scene.frame_start = 10
    for current, expected in ((12, 2.0), (10, 0.0), (3, 0.0)):
        scene.frame_set(current)
        run_text.programs.run_in_handler(scene)
        assert run_text.take_pending_error(scene) is None
        assert x_of_spheres(scene)[0] == expected


def test_what_fails_in_a_handler_waits_for_the_engine_once(with_program):
    scene = with_program.scene
    with_program.text.from_string("S = ;")
    run_text.programs.run_in_handler(scene)
    assert str(run_text.take_pending_error()).startswith("scene.trg:1:5: error: ")
    assert run_text.take_pending_error() is None


def test_a_failed_frame_is_tried_once_a_render(with_program):
    scene = with_program.scene
    with_program.text.from_string("S = ;")
    run_text._on_render_init(scene)
    run_text._on_render_pre(scene)
    assert len(run_text.program_log(scene)) == 1
    assert run_text.take_pending_error(scene) is not None
    with_program.text.from_string(MOVING)
    run_text._on_render_init(scene)
    assert run_text.take_pending_error(scene) is None


def test_a_program_cannot_be_started_while_one_runs(with_program):
    scene = with_program.scene
    inner = []

    def again(*_):
        inner.append(run_text.run_program(scene, 1))

    run_text.run_program(scene, 1)
    runner = run_text.programs.runner_of(scene)
    runner_run = ProgramRunner.run
    try:
        ProgramRunner.run = lambda self, *arguments: (again(), runner_run(self, *arguments))[1]
        outer = run_text.run_program(scene, 2)
    finally:
        ProgramRunner.run = runner_run
    assert outer.failure is None
    assert inner[0].failure is not None
    assert runner is run_text.programs.runner_of(scene)


def test_a_scene_without_a_program_is_left_alone(scene):
    assert run_text.run_program(scene, 1) is None


def test_registering_twice_leaves_no_handler_behind():
    run_text.register()
    run_text.unregister()
    names = [f.__module__ for f in bpy.app.handlers.render_pre]
    assert not any(name.endswith("run_text") for name in names)


def call_from_another_thread(main: MainThread, work, monkeypatch) -> dict:
    """As in a window: background mode is off, and the caller is not the main thread."""
    monkeypatch.setattr(
        "trg_blender.engine.to_blender.main_thread.bpy",
        SimpleNamespace(app=SimpleNamespace(background=False)),
    )
    found: dict = {}

    def caller():
        try:
            found["result"] = main.call(work)
        except (MainThreadBusy, ValueError) as error:
            found["error"] = error

    thread = threading.Thread(target=caller)
    thread.start()
    found["thread"] = thread
    return found


def test_a_job_of_another_thread_runs_where_the_pump_runs(monkeypatch):
    main = MainThread()
    main._beat = time.monotonic()
    found = call_from_another_thread(main, threading.current_thread, monkeypatch)
    while found["thread"].is_alive():
        main._pump()
    assert found["result"] is threading.main_thread()


def test_an_error_of_the_job_reaches_the_caller(monkeypatch):
    main = MainThread()
    main._beat = time.monotonic()

    def fail():
        raise ValueError("no")

    found = call_from_another_thread(main, fail, monkeypatch)
    while found["thread"].is_alive():
        main._pump()
    assert isinstance(found["error"], ValueError)


def test_a_caller_gives_up_when_the_main_thread_is_blocked(monkeypatch):
    monkeypatch.setattr("trg_blender.engine.to_blender.main_thread.GIVE_UP_S", 0.2)
    main, ran = MainThread(), []
    found = call_from_another_thread(main, lambda: ran.append(1), monkeypatch)
    found["thread"].join(5.0)
    assert isinstance(found["error"], MainThreadBusy)
    main._pump()
    assert ran == []


def test_the_examples_of_the_repository_build(scene):
    folder = Path(run_text.__file__).resolve().parents[2] / "examples"
    programs = sorted(folder.glob("*.trg"))
    if not programs:
        pytest.skip("the examples are not in this installation")
    for path in programs:
        text = bpy.data.texts.load(str(path))
        outcome = ProgramRunner().run(scene, text, 1)
        assert outcome.failure is None, outcome.failure
