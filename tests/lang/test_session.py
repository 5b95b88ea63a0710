# ruff: noqa: E501 (programs on one line)
"""Sessions: frames, pauses, budgets, the end."""

from __future__ import annotations

from trg_blender.lang import (
    EndEvent,
    FrameEvent,
    HostOptions,
    Limits,
    PauseEvent,
    Session,
    compile_source,
)  # fmt: skip
from trg_blender.lang.faults import FaultReader


def _session(text: str, **options) -> Session:
    return Session(compile_source(text, "main.trg"), HostOptions(**options))


def test_the_budget_counts_from_frame_to_frame() -> None:
    text = "Scene = scene(); while (1) { for (i = 0; i < 15000; i++) ; Scene.Render(); }"
    session = _session(text, limits=Limits(max_steps=40_000))
    assert all(isinstance(session.next_frame(), FrameEvent) for _ in range(50))


def test_a_loop_that_never_renders_can_be_run_in_portions() -> None:
    session = _session("while (1) { }", limits=Limits(max_steps=10**12, max_seconds=1e6))
    assert isinstance(session.next_frame(max_seconds=0.02), PauseEvent)
    assert isinstance(session.next_frame(max_seconds=0.02), PauseEvent)


def test_cancel_ends_the_program_at_its_loop() -> None:
    session = _session("x = 1;\nwhile (1) { }", limits=Limits(max_steps=10**12, max_seconds=1e6))
    session.next_frame(max_seconds=0.01)
    session.cancel()
    event = session.next_frame()
    assert isinstance(event, EndEvent) and event.error is not None and event.out_of_budget
    assert (event.error.code, event.error.span.line) == ("E609", 2)


def test_after_an_error_the_session_is_over() -> None:
    session = _session("Scene = scene(); Scene.Render(); x = 1 / 0;")
    assert isinstance(session.next_frame(), FrameEvent)
    first, second = session.next_frame(), session.next_frame()
    assert isinstance(first, EndEvent) and first is second
    assert first.error is not None and first.error.code == "E401" and not first.out_of_budget


def test_an_alias_of_render_and_one_in_an_argument_suspend() -> None:
    text = "Scene = scene(); r = Scene.Render; r(); f = function(g) { g(); }; f(r); h = f; h(Scene.Render); print(1);"
    session = _session(text)
    frames = 0
    while isinstance(session.next_frame(), FrameEvent):
        frames += 1
    assert (frames, session.output) == (3, ["1"])


def test_a_returned_and_an_aliased_function_suspend() -> None:
    text = (
        "Scene = scene(); mk = function() { return function() { #Scene.Render(); return 4; }; };"
        "f = mk(); a = f() + mk()(); g = h = function() { #Scene.Render(); return 1; }; b = g() + h(); print(a, b);"
    )
    session = _session(text)
    frames = 0
    while isinstance(session.next_frame(), FrameEvent):
        frames += 1
    assert (frames, session.output, session.diagnostics) == (4, ["8 2"], ())


def test_the_clock_is_the_frame_number() -> None:
    text = "Scene = scene(); while (1) { print(std::frame(), std::time(), std::frames(), std::fps()); Scene.Render(); }"
    session = _session(text, frames=10, fps=2.0)
    session.next_frame()
    session.next_frame()
    assert session.output == ["1 0.5 10 2", "2 1 10 2"]


def test_two_sessions_of_one_program_do_not_share_anything() -> None:
    program = compile_source("p.n = 1; f = function() { }; f.k = 1; print(isdef(q), p.n); q = 1;", "m.trg")
    for _ in range(2):
        session = Session(program)
        session.next_frame()
        assert session.output == ["0 1"]


def test_russian_messages() -> None:
    session = _session("x = 1 / 0;", language="ru")
    event = session.next_frame()
    assert isinstance(event, EndEvent) and event.error is not None
    assert event.error.message == "деление на ноль"


def test_a_fault_of_ours_says_so_and_names_the_command_that_repeats_it() -> None:
    session = _session("x = 1;")
    error = FaultReader(session._rt).read(LookupError("a fault that no reader knows"))
    assert (error.code, error.hint) == ("E900", "repeat it with: trg run main.trg")
    assert "LookupError" in error.message
