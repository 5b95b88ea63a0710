"""The library written in TRG."""

from __future__ import annotations

HEAD = 'include("stl/rt/trg_raytrace.trg"); Scene = scene();'


def test_a_ring_stands_on_a_circle(run) -> None:
    make = "function(p, n) { return sphere(p, 1 + n); }"
    outcome = run(f"{HEAD} stl::ring(Scene, {make}, 4, 2); Scene.Render();")
    assert outcome.error is None
    shapes = outcome.frames[0].shapes
    assert [s.parameters[1] for s in shapes] == [1, 2, 3, 4]
    radii = [s.parameters[0][0] ** 2 + s.parameters[0][2] ** 2 for s in shapes]
    assert all(abs(r - 4) < 1e-9 for r in radii)


def test_a_row_includes_both_ends(run) -> None:
    make = "function(p, n) { return sphere(p, 1); }"
    outcome = run(f"{HEAD} stl::row(Scene, {make}, 3, vec3(0), vec3(2, 0, 0)); Scene.Render();")
    assert [s.parameters[0] for s in outcome.frames[0].shapes] == [(0, 0, 0), (1, 0, 0), (2, 0, 0)]


def test_daylight_and_stage_fill_the_scene(run) -> None:
    outcome = run(f"{HEAD} stl::daylight(Scene); stl::stage(Scene, material::jade()); Scene.Render();")
    (scene,) = outcome.frames
    assert [s.kind for s in scene.shapes] == ["plane"]
    assert [light.kind for light in scene.lights] == ["dir"]
    assert scene.background == (0.55, 0.7, 0.9)


def test_a_wrong_argument_is_an_error_of_the_library_with_the_call_in_its_stack(run) -> None:
    (found,) = run(f'{HEAD}\nstl::orbit("a");').diagnostics
    assert (found.code, found.span.file) == ("E434", "stl/rt/trg_raytrace.trg")
    assert [(name, str(span)) for name, span in found.stack] == [("stl::orbit", "main.trg:2:1")]
