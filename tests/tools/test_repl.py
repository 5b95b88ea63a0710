"""`trg repl`: entries, values, what stays, limits, and a real terminal."""

from __future__ import annotations

import os
import select
import subprocess
import sys
import time
from pathlib import Path

import pytest

from trg_blender.lang import HostOptions, Limits, NoFiles
from trg_blender.lang.interactive import Interactive, is_complete

ROOT = Path(__file__).resolve().parents[2]


def session_of(**options) -> Interactive:
    return Interactive(NoFiles(), HostOptions(**options))


def values_of(*entries: str) -> list[str | None]:
    """The values of entries that must not fail."""
    session = session_of()
    found = []
    for entry in entries:
        outcome = session.enter(is_complete(entry)[1])
        assert not outcome.failed, outcome.diagnostics
        found.append(outcome.value)
    return found


def test_an_expression_shows_its_value_and_a_statement_none():
    assert values_of("1 + 2", "a = 5", "a", '"шар"', "vec3(1)", "if (a) a;") == [
        None if v == "" else v for v in ("3", "", "5", "шар", "vec3(1, 1, 1)", "")
    ]


def test_variables_functions_and_objects_stay():
    entries = ("a = 2;", "f = function(x) { return x * #a; };", "f(21)", "a = 3;", "f(21)", "o.n = 1;", "o.n")
    assert values_of(*entries) == [None, None, "42", None, "63", None, "1"]


def test_strings_and_functions_of_earlier_entries_keep_their_meaning():
    entries = (
        'f = function() { return "one"; };',
        '"two"',
        'g = function() { return "three" + #f(); };',
        "g()",
    )
    assert values_of(*entries)[-1] == "threeone"


def test_a_function_may_be_entered_again():
    assert values_of("f = function() { return 1; };", "f = function() { return 2; };", "f()")[-1] == "2"


def test_the_last_value_has_a_name_and_no_value_leaves_it():
    assert values_of("20", "last::value + 1", "print(1)", "last::value * 2") == ["20", "21", None, "42"]


def test_methods_and_overloads_reach_over_entries():
    entries = (
        "v = object(); v.n = 1;", "v.add = function(self, k) { return self.n + k; };", "v.add(4)",
        "v.operator< = function(a, b) { return 1; };", "v < 0",
        "v.operator+ = function(a, b) { return 7; };", "v + v",
    )  # fmt: skip
    assert [v for v in values_of(*entries) if v is not None] == ["5", "1", "7"]


def test_an_include_runs_once_and_its_names_stay():
    entries = (
        'include("stl/rt/trg_raytrace.trg");',
        'include("stl/rt/trg_raytrace.trg");',
        "stl::orbit(0, 2, 3)",
    )
    assert values_of(*entries)[-1] == "vec3(2, 3, 0)"


def test_an_exported_parameter_is_a_variable_with_its_default_and_may_be_exported_again():
    entries = ('export r = 3 ~ "num" ~ range(0, 10);', "r", "export r = 4;", "r", "a = r + 1;", "a")
    assert [v for v in values_of(*entries) if v is not None] == ["3", "4", "5"]


def test_an_entry_that_does_not_compile_leaves_nothing():
    session = session_of()
    (found,) = session.enter("b = 1; c = missing;").diagnostics
    assert (found.code, str(found.span)) == ("E302", "<1>:1:12")
    assert session.global_names == ()
    assert [d.code for d in session.enter("b;").diagnostics] == ["E302"]


def test_an_entry_that_fails_while_it_runs_keeps_what_it_did():
    session = session_of()
    (found,) = session.enter("a = 1;\nb = 1 / 0;").diagnostics
    assert (found.code, str(found.span)) == ("E401", "<1>:2:5")
    assert session.enter("a;").value == "1"


def test_an_error_in_a_function_of_an_earlier_entry_points_there_and_names_the_calls():
    session = session_of()
    session.enter("f = function(x) { return 1 / x; };")
    (found,) = session.enter("f(0);").diagnostics
    assert str(found.span) == "<1>:1:26"
    assert [(name, str(span)) for name, span in found.stack] == [("f", "<2>:1:1")]
    assert found.span.file in session.sources


def test_every_entry_has_a_budget_of_its_own():
    session = session_of(limits=Limits(max_steps=30_000))
    for _ in range(5):
        assert not session.enter("for (i = 0; i < 20000; i++) { }").failed
    (found,) = session.enter("while (1) { }").diagnostics
    assert found.code == "E601"
    assert session.enter("i;").value == "20000"


def test_output_frames_and_the_end_of_an_entry_at_its_last_frame():
    session = session_of(frames=3)
    outcome = session.enter("s = scene(); while (1) { print(std::frame()); s.Render(); }")
    assert (outcome.output, outcome.frames, outcome.failed) == (("1", "2", "3"), 3, False)
    assert session.enter("print(4);").output == ("4",)


def test_a_function_entered_before_what_it_calls_could_render_is_named():
    session = session_of()
    session.enter("s = scene(); g = 0;")
    session.enter("f = function() { #g(); };")
    found = session.enter("g = function() { #s.Render(); };").diagnostics
    assert [(d.code, d.span.file) for d in found] == [("W704", "<2>")]


def test_cancelling_ends_the_entry_and_not_the_session():
    session = session_of()
    assert session.enter("a = 1;").failed is False
    session.cancel()
    assert session.enter("a;").value == "1"


@pytest.mark.parametrize(
    ("text", "whole", "entry"),
    [
        ("1 + 2", True, "1 + 2;"),
        ("a = 1;", True, "a = 1;"),
        ("1 // note", True, "1 // note\n;"),
        ("f = function()", False, None),
        ("f = function() {", False, None),
        ("f = function() { }", True, "f = function() { };"),
        ("g(1,", False, None),
        ("[1,", False, None),
        ("1 +", False, None),
        ("if (a)", False, None),
        ("/* open", False, None),
        ("a = ';", True, "a = ';"),
        ("a b c", True, "a b c"),
        (")", True, ")"),
        ("", True, ""),
    ],
)
def test_whether_an_entry_is_whole(text: str, whole: bool, entry: str | None):
    found = is_complete(text)
    assert found[0] is whole
    if entry is not None:
        assert found[1] == entry


def repl(text: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "trg_blender", "repl", *arguments]
    return subprocess.run(
        command,
        cwd=ROOT,
        input=text,
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=60,
        check=False,
    )


def test_the_command_reads_a_pipe_without_prompts():
    done = repl("a = 20\na +\n1\nf = function(x)\n{\n  return x + 1;\n}\nf(a)\n:names\n")
    assert done.stdout == "21\n21\na f\n"
    assert (done.returncode, done.stderr) == (0, "")


def test_the_command_shows_errors_with_a_caret_and_goes_on():
    done = repl('x = shpere(1)\n"after"\n')
    assert done.stdout == "after\n"
    assert "<1>:1:5: error: 'shpere' is not defined" in done.stderr
    assert "^^^^^^" in done.stderr
    assert done.returncode == 1


def test_an_entry_left_open_at_the_end_is_an_error_and_quit_ends():
    assert "not closed" in repl("f = function() {\n").stderr
    assert repl(":quit\nprint(1);\n").stdout == ""


def test_colon_commands_and_russian():
    done = repl(":help\n:nonsense\n1 / 0\n", "--lang", "ru")
    assert ":quit" in done.stdout
    assert "no :nonsense" in done.stdout
    assert "деление на ноль" in done.stderr


@pytest.mark.skipif(sys.platform == "win32", reason="pseudo terminals are POSIX")
def test_on_a_terminal_it_prompts_and_interrupts_end_what_runs(tmp_path: Path):
    import pty

    ours, theirs = pty.openpty()
    environment = {**os.environ, "TRG_HISTORY": str(tmp_path / "history"), "TERM": "dumb", "LANG": "C.UTF-8"}
    process = subprocess.Popen(
        [sys.executable, "-m", "trg_blender", "repl", "--max-steps", "1000000000"],
        cwd=ROOT, stdin=theirs, stdout=theirs, stderr=theirs, env=environment, start_new_session=True,
        preexec_fn=lambda: __import__("fcntl").ioctl(0, __import__("termios").TIOCSCTTY, 0),
    )  # fmt: skip
    os.close(theirs)
    said = ""

    def wait_for(text: str) -> None:
        nonlocal said
        until = time.monotonic() + 30
        while text not in said:
            assert time.monotonic() < until, said
            if select.select([ours], [], [], 0.2)[0]:
                said += os.read(ours, 4096).decode("utf-8", "replace")
        said = said.partition(text)[2]

    wait_for("trg> ")
    os.write(ours, b"f = function()\n")
    wait_for("...> ")
    os.write(ours, b"{ return 6 * 7; }\n")
    wait_for("trg> ")
    os.write(ours, b"f()\n")
    wait_for("42")
    wait_for("trg> ")
    os.write(ours, b"while (1) { }\n")
    time.sleep(1)
    os.write(ours, b"\x03")
    wait_for("cancelled")
    wait_for("trg> ")
    os.write(ours, b":quit\n")
    assert process.wait(timeout=30) == 0
    os.close(ours)
    assert "while (1) { }" in (tmp_path / "history").read_text(encoding="utf-8")
