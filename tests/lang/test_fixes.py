"""One-click fixes: offered where the repair is certain, and right where they are offered."""

from __future__ import annotations

import pytest

from trg_blender.lang import Diagnostic, ProgramError, compile_source
from trg_blender.lang.messages import LANGUAGES


def diagnostics_of(text: str, language: str = "en") -> tuple[Diagnostic, ...]:
    try:
        return compile_source(text, "main.trg", language=language).diagnostics
    except ProgramError as error:
        return error.diagnostics


def repaired(text: str) -> str:
    """The text after the fix of its first diagnostic."""
    span, replacement = diagnostics_of(text)[0].fix
    lines = text.split("\n")
    line = lines[span.line - 1]
    lines[span.line - 1] = line[: span.col - 1] + replacement + line[span.end_col - 1 :]
    return "\n".join(lines)


REPAIRS = {
    "a missing semicolon": ("a = 1\nb = 2;", "a = 1;\nb = 2;"),
    "a global without #": (
        "r = 1;\nf = function() { return r; };",
        "r = 1;\nf = function() { return #r; };",
    ),
    "an unknown escape": ('a = "BIN\\MODELS";', 'a = "BIN\\\\MODELS";'),
    "a mistyped built-in": ("a = shpere(vec3(0), 1);", "a = sphere(vec3(0), 1);"),
    "a mistyped built-in behind #": ("a = #shpere(vec3(0), 1);", "a = #sphere(vec3(0), 1);"),
    "a mistyped variable": ("radius = 1;\na = raduis;", "radius = 1;\na = radius;"),
    "a mistyped type": ('f = function(a ~ "scen") { };', 'f = function(a ~ "scene") { };'),
    "a mistyped type of an export": ('export a = vec3(1) ~ "color";', 'export a = vec3(1) ~ "colour";'),
    "single quotes": ("a = 'шар';", 'a = "шар";'),
    "one &": ("a = 1 & 2;", "a = 1 && 2;"),
    "one |": ("a = 1 | 2;", "a = 1 || 2;"),
    "true": ("a = true;", "a = 1;"),
    "false": ("a = false;", "a = 0;"),
    "after letters outside of the basic plane": ('s = "🎈"; t = "\\q";', 's = "🎈"; t = "\\\\q";'),
}


@pytest.mark.parametrize("name", REPAIRS)
def test_a_fix_repairs_the_program(name: str):
    faulty, right = REPAIRS[name]
    assert repaired(faulty) == right
    assert diagnostics_of(right) == ()


@pytest.mark.parametrize(
    "text",
    [
        "radius1 = 1;\nradius2 = 2;\nx = radius3;",
        "x = entirely_unknown;",
        "f((1;",
        "a = 'open;",
        "a = '\"';",
        "if (a = 1) a;",
    ],
)
def test_what_is_not_certain_gets_no_fix(text: str):
    assert all(d.fix is None for d in diagnostics_of(text) if d.code != "E201")


def test_a_name_with_several_near_ones_still_gets_a_hint():
    (found,) = diagnostics_of("radius1 = 1;\nradius2 = 2;\nx = radius3;")
    assert found.code == "E302"
    assert found.hint is not None


def test_a_global_read_without_hash_names_the_place_of_its_assignment():
    (found,) = diagnostics_of("r = 1;\nf = function() { return r; };")
    assert [(span.line, span.col) for span, _ in found.related] == [(1, 1)]


@pytest.mark.parametrize("name", REPAIRS)
def test_both_languages_tell_the_same_places_and_codes(name: str):
    english, russian = (diagnostics_of(REPAIRS[name][0], language) for language in LANGUAGES)
    assert [(d.code, d.span, d.fix) for d in english] == [(d.code, d.span, d.fix) for d in russian]
    assert all(e.message != r.message for e, r in zip(english, russian, strict=True))


RUN_REPAIRS = {
    "a mistyped field": (
        "o.radius = 1; x = o.raduis;",
        "o.radius = 1; x = o.radius;",
    ),
    "a mistyped field that is called": (
        "o.draw = function() { }; o.drwa();",
        "o.draw = function() { }; o.draw();",
    ),
    "a field on a line of its own": (
        "o.radius = 1; x = o\n  .raduis;",
        "o.radius = 1; x = o\n  .radius;",
    ),
    "a mistyped method": ("S = scene(); S.Rendr();", "S = scene(); S.Render();"),
    "a field of a vector": ("x = vec3(1).X;", "x = vec3(1).x;"),
}


@pytest.mark.parametrize("name", RUN_REPAIRS)
def test_a_fix_repairs_what_fails_at_run_time(name: str, run):
    faulty, right = RUN_REPAIRS[name]
    (found,) = run(faulty).diagnostics
    span, replacement = found.fix
    lines = faulty.split("\n")
    line = lines[span.line - 1]
    lines[span.line - 1] = line[: span.col - 1] + replacement + line[span.end_col - 1 :]
    assert "\n".join(lines) == right
    assert run(right).diagnostics == []


@pytest.mark.parametrize(
    "text",
    [
        "o.radius1 = 1; o.radius2 = 2; x = o.radius3;",
        "o.radius = 1; x = (o.raduis);",
        "o.radius = 1; x = o.entirely;",
        "o.operator+ = function(a, b) { }; x = o.operator-;",
    ],
)
def test_what_fails_at_run_time_and_is_not_certain_gets_no_fix(text: str, run):
    assert [(d.code, d.fix) for d in run(text).diagnostics] == [("E421", None)]
