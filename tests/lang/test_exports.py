# ruff: noqa: E501 (programs on one line)
"""Exported parameters: what a program says of them, and the values that a host gives."""

from __future__ import annotations

import pytest

from trg_blender.cli import main
from trg_blender.commands import run as run_command
from trg_blender.lang import EndEvent, HostOptions, ParameterError, Session, compile_source, parse_parameter

PROGRAM = """\
/* How far
 * the ring reaches. */
export radius = 3 ~ "num" ~ range(0, 10);
export count = 8 ~ range(1, 100, 1); // pieces
// The colour
// of all.
export tint = vec3(1, 0.5, 0) ~ "colour";

export look = "gold" ~ choice("gold", "silver");
export fog = 0 ~ "flag";
export shift = vec3(0);
export label = "hi";
print(radius, count, tint, look, fog, shift, label);
"""


def _run(**parameters: object) -> tuple[list[str], list[tuple[str, int]]]:
    session = Session(compile_source(PROGRAM, "m.trg"), HostOptions(parameters=parameters))
    event = session.next_frame()
    assert isinstance(event, EndEvent)
    return session.output, [(d.code, d.span.line) for d in session.diagnostics]


def test_exports_say_everything_without_running() -> None:
    exports = compile_source(PROGRAM, "m.trg").exports
    assert list(exports) == ["radius", "count", "tint", "look", "fog", "shift", "label"]
    radius, count, tint = exports["radius"], exports["count"], exports["tint"]
    assert (radius.type, radius.default, radius.low, radius.high, radius.step) == (
        "num",
        3.0,
        0.0,
        10.0,
        None,
    )
    assert (radius.span.line, radius.span.col) == (3, 8)
    assert (count.type, count.step) == ("num", 1.0)
    assert (tint.type, tint.default) == ("colour", (1.0, 0.5, 0.0))
    assert exports["look"].choices == ("gold", "silver")
    assert [exports[n].type for n in ("look", "fog", "shift", "label")] == ["str", "flag", "vec3", "str"]


def test_comments_document_parameters() -> None:
    exports = compile_source(PROGRAM, "m.trg").exports
    docs = [exports[n].doc for n in ("radius", "count", "tint", "look")]
    assert docs == ["How far the ring reaches.", "pieces", "The colour of all.", ""]


def test_defaults_hold_where_the_host_gives_nothing() -> None:
    assert _run() == (["3 8 vec3(1, 0.5, 0) gold 0 vec3(0, 0, 0) hi"], [])


def test_values_of_the_host_go_in() -> None:
    given = {"radius": 5, "tint": (0, 0, 1), "look": "silver", "fog": True, "label": "x"}
    assert _run(**given) == (["5 8 vec3(0, 0, 1) silver 1 vec3(0, 0, 0) x"], [])


@pytest.mark.parametrize(
    ("name", "value", "line"),
    [("radius", 11, 3), ("radius", "4", 3), ("radius", float("nan"), 3), ("radius", 10**400, 3), ("count", 1.5, 4),
     ("tint", (0, -1, 0), 7), ("tint", 1, 7), ("look", "glod", 9), ("fog", 2, 10), ("shift", (1, 2), 11),
     ("label", 4, 12), ("label", None, 12)],
)  # fmt: skip
def test_a_value_that_does_not_fit_is_an_error_at_the_export(name, value, line) -> None:
    output, found = _run(**{name: value})
    assert output == [] and found == [("E521", line)]


def test_the_error_names_parameter_range_and_value() -> None:
    session = Session(compile_source(PROGRAM, "m.trg"), HostOptions(parameters={"radius": 40}))
    session.next_frame()
    message = session.diagnostics[0].message
    assert all(word in message for word in ("radius", "0", "10", "40"))


def test_an_unknown_parameter_gets_a_guess() -> None:
    session = Session(compile_source(PROGRAM, "m.trg"), HostOptions(parameters={"raduis": 4}))
    session.next_frame()
    (found,) = session.diagnostics
    assert found.code == "E520" and "radius" in (found.hint or "")


def test_a_parameter_is_a_variable_like_any_other(run) -> None:
    text = "export r = 3; f = function() { return #r * 2; }; r += 1; print(f());"
    assert run(text, parameters={"r": 10.0}).output == ["22"]


def test_a_name_called_export_is_still_a_name(run) -> None:
    assert run("export = 3; print(export);").output == ["3"]


ERRORS = {
    "the default is a constant": ("export a = 1 + 2;", "E330", "1:12"),
    "a name is exported once": ("export a = 1; export a = 2;", "E331", "1:22"),
    "the default lies in the range": ("export a = 11 ~ range(0, 10);", "E332", "1:12"),
    "the default is one of the choices": ('export a = "x" ~ choice("a", "b");', "E332", "1:12"),
    "the default is of the type": ('export a = "x" ~ "num";', "E332", "1:12"),
    "a colour is not negative": ('export a = vec3(-1, 0, 0) ~ "colour";', "E332", "1:12"),
    "a type that no parameter has": ('export a = 1 ~ "shape";', "E333", "1:16"),
    "a range runs upwards": ("export a = 1 ~ range(5, 1);", "E334", "1:16"),
    "a range is of numbers": ('export a = "x" ~ range(1, 2);', "E334", "1:18"),
    "choices are strings": ("export a = 1 ~ choice(1, 2);", "E334", "1:16"),
    "nothing else limits a parameter": ("export a = 1 ~ foo();", "E231", "1:16"),
    "not in a block": ("{ export a = 1; }", "E230", "1:3"),
    "not in a function": ("f = function() { export a = 1; };", "E230", "1:18"),
    "a default is needed": ("export a;", "E201", "1:9"),
    "built-ins are not exported": ("export vec3 = 1;", "E310", "1:8"),
    "a semicolon ends it": ("export a = 1\nprint(a);", "E201", "1:13"),
}  # fmt: skip


@pytest.mark.parametrize("fact", ERRORS, ids=lambda f: f.replace(" ", "_"))
def test_error(fact, run) -> None:
    text, code, place = ERRORS[fact]
    assert run(text).error == (code, place)


@pytest.mark.parametrize(
    ("text", "expected"),
    [("radius=4", 4.0), ("radius = 4", 4.0), ("tint=1,0,0.5", (1.0, 0.0, 0.5)), ("look=silver", "silver"),
     ("fog=1", 1.0), ("fog=off", 0.0), ("shift=-1,2,3e0", (-1.0, 2.0, 3.0)), ("label=a=b", "a=b")],
)  # fmt: skip
def test_texts_are_read_by_the_parameters_type(text, expected) -> None:
    assert parse_parameter(compile_source(PROGRAM, "m.trg"), text) == (
        text.partition("=")[0].strip(),
        expected,
    )


@pytest.mark.parametrize(
    "text", ["radius=x", "radius=1,2,3", "radius=nan", "tint=1,0", "look=tin", "fog=2", "zzz=1"]
)
def test_texts_that_do_not_fit_are_refused(text) -> None:
    with pytest.raises(ParameterError):
        parse_parameter(compile_source(PROGRAM, "m.trg"), text)


def test_trg_run_sets_parameters(tmp_path, capsys) -> None:
    file = tmp_path / "m.trg"
    file.write_text(PROGRAM)
    assert main(["run", str(file), "--set", "radius=4", "--set", "look=silver"]) == run_command.DONE
    assert capsys.readouterr().out.startswith("4 8 vec3(1, 0.5, 0) silver")


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize(
    ("setting", "said"), [("raduis=4", "radius"), ("radius=40", "10"), ("radius", "NAME=VALUE")]
)
def test_a_wrong_set_is_wrong_usage(command, setting, said, tmp_path, capsys) -> None:
    file = tmp_path / "m.trg"
    file.write_text(PROGRAM)
    assert main([command, str(file), "--set", setting]) == 2
    assert said in capsys.readouterr().err
