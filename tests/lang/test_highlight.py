"""Colours of a text, word by word."""

from __future__ import annotations

import pytest

from trg_blender.lang.highlight import highlight


def shown(text: str) -> list[list[tuple[str, str]]]:
    """(characters, kind) of every coloured run but signs, line by line."""
    lines = text.split("\n")
    return [
        [(line[run.start : run.end], run.kind) for run in runs if run.kind != "symbol"]
        for line, runs in zip(lines, highlight(text), strict=True)
    ]


def test_each_kind_has_its_colour():
    text = 'include("a.trg"); // why\nfor (x in l) Scene.Add(sphere(vec3(0, 1.5e3, x), mth::PI));'
    assert shown(text) == [
        [("include", "keyword"), ('"a.trg"', "string"), ("// why", "comment")],
        [
            ("for", "keyword"), ("in", "keyword"), ("Add", "builtin"), ("sphere", "builtin"),
            ("vec3", "builtin"), ("0", "number"), ("1.5e3", "number"), ("mth", "builtin"), ("PI", "builtin"),
        ],
    ]  # fmt: skip


def test_a_comment_over_lines_colours_each_of_them():
    assert shown("a = 1; /* one\n\n  two */ if\n") == [
        [("1", "number"), ("/* one", "comment")], [], [("  two */", "comment"), ("if", "keyword")], [],
    ]  # fmt: skip


def test_an_open_comment_reaches_to_the_end():
    assert shown("x /* a\nif") == [[("/* a", "comment")], [("if", "comment")]]


@pytest.mark.parametrize(
    "text", ["", "\n\n", '"open', "a ? b @ $ \\ \x00 'c'", "шар = сфера(1);", "/*", "1..2...3"]
)
def test_any_text_gives_runs_inside_of_its_lines(text: str):
    lines = text.split("\n")
    found = highlight(text)
    assert len(found) == len(lines)
    for line, runs in zip(lines, found, strict=True):
        ends = [0, *(place for run in runs for place in (run.start, run.end)), len(line)]
        assert ends == sorted(ends)


def test_fields_and_includes_elsewhere_are_plain_names():
    assert shown("a.sphere = 1; include = 2; x = include;")[0] == [("1", "number"), ("2", "number")]
