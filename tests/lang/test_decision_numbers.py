# ruff: noqa: E501 (programs on one line)
"""The numbered decisions of the language's design, 1 to 80: a program and its output, or its error, each.

What needs a host stands below the table as a function; `test_every_decision_is_here` counts both.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from trg_blender.lang import DiskFiles, HostOptions, Limits, PauseEvent, Session, compile_source
from trg_blender.lang.files import NoFiles

Expected = str | tuple[str, str]
IF = " if (0) u = 1;"
BALL = "s = sphere(vec3(0), 1);"

TABLE: dict[int, list[tuple[str, Expected]]] = {
    1: [("print(1); // 2\n/* print(3); /* */ print(4);", "1\n4"), ("x = 1; /* ", ("E106", "1:8"))],
    2: [("print(15, 0.75, .5, 1., 1e3);", "15 0.75 0.5 1 1000"), ("x = 0x1F;", ("E101", "1:6")), ("x = 1e999;", ("E102", "1:5"))],
    3: [("x = 'a';", ("E100", "1:5")), ('x = "a\n";', ("E104", "1:5"))],
    4: [('print(len("\\n\\t\\r\\0\\"\\\\"));', "6"), ('x = "BIN\\MODELS";', ("E105", "1:9"))],
    5: [("Радиус = 1; радиус = 2; print(Радиус, радиус);", "1 2"), ("e\u0301 = 1; print(\u00e9);", "1")],
    6: [("\tx = ы;", ("E302", "1:6")), ("\ufeffx = 1;\r\ny = z;", ("E302", "2:5"))],
    7: [("else = 1;", ("E205", "1:1")), ("o.for = 1;", ("E204", "1:3")), ("o = object(); o.operator+ = print; print(1);", "1")],
    8: [("// " + "a" * 262_144, ("E109", "1:1")), ("// " + "a" * 262_000 + "\nprint(1);", "1")],
    9: [("f = function() { }\nx = 1;", ("E201", "1:19")), ("{ x = 1; } ;; print(x);", "1")],
    10: [("f = print; f(f(1), f(2), f()));", ("E202", "1:30"))],
    11: [("{ a = 1; { b = 2; } } print(a, b);", "1 2")],
    12: [("for (i = 0; i < 4; i++) { if (i == 1) continue; print(i); }", "0\n2\n3"), ("for (;;) { break; } print(1);", "1")],
    13: [("switch (2) { default: print(0); case 1 + 1: print(2); case 3: print(3); break; case 4: print(4); }", "2\n3"), ("switch (1) { default: default: }", ("E212", "1:23"))],
    14: [("for (i = 0; i < 3; i++) { switch (i) { case 1: continue; } print(i); }", "0\n2")],
    15: [("break;", ("E216", "1:1")), ("continue;", ("E217", "1:1")), ("return;", ("E218", "1:1")), ("while (0) { f = function() { break; }; }", ("E216", "1:30"))],
    16: [("if (1) if (0) print(1); else print(2);", "2")],
    17: [("print(1 + 2 * 3 < 8 == 1 && 0 || 1, -2 * -3, !0 + 1);", "1 6 2"), ("x = 1 ? 2 : 3;", ("E100", "1:7")), ("x = 1 & 2;", ("E100", "1:7"))],
    18: [("a = b = 3; print(a, b); if (a = 4) print(a);", "3 3\n4")],
    19: [("i = 1; o.n = 1; print(i++, ++i, i--, --i, o.n++, ++o.n);", "1 3 3 1 1 3")],
    20: [("o = object(); o.operator+=function(a, b) { return 5; }; print(o + 1);", "5"), ("o = object(); o.operator& = 1;", ("E100", "1:25")), ("o = object(); o.operator++ = 1;", ("E207", "1:25"))],
    21: [("a = 1; o.b = 2; f = function() { return #a + #o.b; }; print(f(), #a);", "3 1")],
    22: [('f = function(x = 1 ~ "num") { return x; }; print(f());', "1"), ('x = 1 ~ "num";', ("E201", "1:6"))],
    23: [("x = " + "(" * 70 + "1" + ")" * 70 + ";", ("E220", "1:67")), ("while (0) " * 9 + ";", ("E225", "1:81")), ("x = 1" + " + 1" * 401 + ";", ("E221", "1:1607")), ("print(" + "1, " * 255 + "1);", ("E223", "1:772"))],
    24: [("print(7 / 2, 2 * 0.5);", "3.5 1"), ("x = 2; for (i = 0; i < 2000; i++) x = x * x; print(x);", "inf")],
    25: [("print(0.1, 1 / 3, 5, 9007199254740992, 1e16);", "0.1 0.3333333333333333 5 9007199254740992 1e+16")],
    26: [("print(1e308 * 10, -(1e308 * 10));", "inf -inf"), ("x = sphere(vec3(0), 1e308 * 10);", ("E503", "1:5"))],
    27: [("x = 1 / 0;", ("E401", "1:5")), ("x = 1 % 0;", ("E401", "1:5")), ("x = 1; x /= 0;", ("E401", "1:8"))],
    28: [("print(-7 % 3, 7 % -3, 5.5 % 2);", "2 -2 1.5")],
    29: [("print(1 < 2, 2 < 1, !5, !0, 3 && 4, 0 || 0);", "1 0 0 1 1 0"), ("x = 0 && y(); print(x); y = 0;", "0")],
    30: [('if (0 || "" || u) print(1); else print(0); if ("a") print(2); if (object()) print(3);' + IF, "0\n2\n3")],
    31: [('f = print; print(1 == 1, "a" == "a", vec3(1) == vec3(1), object() == object(), f == f, 1 == "1", vec3(1) != 1);', "1 1 1 0 1 0 1")],
    32: [('print(1 < 2, "a" < "b", "B" < "a");', "1 1 1"), ('x = 1 < "a";', ("E412", "1:5")), ("x = vec3(1) < vec3(2);", ("E412", "1:5"))],
    33: [('print("a" + "b", "a" + 1, 1 + "a", "n" + 0.5);', "ab a1 1a n0.5"), ('x = "a" * 3;', ("E410", "1:5")), ('x = "%d" % 3;', ("E410", "1:5"))],
    34: [('s = "ab"; for (i = 0; i < 15; i++) s = s + s; print(len(s));', "65536"), ('s = "ab"; while (1) s = s + s;', ("E605", "1:25"))],
    35: [("a = 1; b = a + 1; a = 5; print(b); f = function() { return #a; }; print(f());", "2\n5")],
    36: [("f = function(n) { print(n); return n; }; x = f(1) + f(2) * f(3); print(f(4), f(5));", "1\n2\n3\n4\n5\n4 5")],
    37: [("print(vec3(1, 2, 3) + vec3(1), vec3(2) * 3, 3 * vec3(2), vec3(2) * vec3(1, 2, 3), vec3(4) / 2, -vec3(1));", "vec3(2, 3, 4) vec3(6, 6, 6) vec3(6, 6, 6) vec3(2, 4, 6) vec3(2, 2, 2) vec3(-1, -1, -1)"), ("x = vec3(1) + 1;", ("E410", "1:5"))],
    38: [("p = vec3(1); p.x = 5;", ("E423", "1:14")), ("a = vec3(1); b = a; b += vec3(1); print(a, b);", "vec3(1, 1, 1) vec3(2, 2, 2)")],
    39: [("an = 0.5; s = 4; print(vec3(an * s, 1, s));", "vec3(2, 1, 4)")],
    40: [('print(typeof(1), typeof("a"), typeof(vec3(1)), typeof([]), typeof(object()), typeof(print), typeof(u), typeof(scene()), typeof(material::gold()));' + IF, "num str vec3 list object function undef scene material"), ('f = function(a ~ "shap") { };', ("E304", "1:18"))],
    41: [('f = function(a ~ "num") { };\nf("1");', ("E434", "1:14"))],
    42: [("print(u + 1, -u, u < 1, u++);" + IF, "1 0 1 0")],
    43: [("x = 1; y = z;", ("E302", "1:12")), ("foo();", ("E302", "1:1"))],
    44: [("u();" + IF, ("E431", "1:1")), ("x = u.f;" + IF, ("E422", "1:5")), ("x = sphere(vec3(0), u);" + IF, ("E507", "1:5")), ('x = "a" + u;' + IF, ("E411", "1:5")), ("print(isdef(u), isdef(print));" + IF, "0 1")],
    45: [("x = 1; f = function() { x = 2; #y = 3; }; f(); print(x, y); y = 0;", "1 3")],
    46: [("x = 5; f = function() { y = x + 1; x = 2; return y; }; print(f());", "1")],
    47: [("g = 1; f = function() { return g; };", ("E301", "1:32"))],
    48: [("my::k = 2; f = function() { return my::k + #my::k; }; print(f());", "4")],
    49: [("f = function() { return #vec3(1) == vec3(1); }; print(f());", "1")],
    50: [("sphere = 1;", ("E310", "1:1")), ("f = function(len) { return len; }; print(f(4));", "4")],
    51: [("my::size = 5; print(my::size);", "5"), ("std::size = 5;", ("E311", "1:1"))],
    52: [("f = function() { a = 1; g = function() { return a; }; };", ("E303", "1:49"))],
    53: [("f = function() { for (i = 0; i < 3; i++) { k = i; } return i + k; }; print(f());", "5")],
    54: [("f();\nf = function() { };", ("E431", "1:1"))],
    55: [("f = function(a, b = 1) { };\nf();", ("E432", "2:1")), ("f = function(a, b = 1) { };\nf(1, 2, 3);", ("E433", "2:1"))],
    56: [("g = 2; f = function(a, b = a + #g, c = #vec3(0)) { return b; }; print(f(1)); g = 5; print(f(1), f(1, 9));", "3\n6 9")],
    57: [("f = function() { }; g = function() { return; }; print(typeof(f()), typeof(g()));", "undef undef")],
    58: [("f = function(n) { if (n == 0) return 0; return #f(n - 1); }; print(f(190));", "0"), ("f = function() { #f(); };\nf();", ("E607", "1:5"))],
    59: [("o.n = 4; o.f = function(self, k) { return self.n + k; }; o.g = function(k) { return k; }; print(o.f(1), o.g(2));", "5 2")],
    60: [("m = material::gold(); m.Metalic(1);", ("E421", "1:23"))],
    61: [("f = function() { return 1; }; f.n = 2; print(f.n + f());", "3")],
    62: [("f = function(a) { }; f(a: 1);", ("E201", "1:25"))],
    63: [("p.x = 1; print(p.x, typeof(p)); q = object(); print(typeof(q));", "1 object\nobject"), ("n = 1; n.x = 2;", ("E420", "1:8"))],
    64: [("p.size = 1; x = p.sise;", ("E421", "1:17"))],
    65: [("a = object(); b = a; b.x = 1; c = copy(a); c.x = 2; print(a.x, c.x);", "1 2")],
    66: [("l = [1, 2]; l[1] = 5; l.append(list(3)); print(l, l[2][0]);", "[1, 5, [3]] 3"), ("l = []; for (x in l) { } print(l[0]);", ("E442", "1:34"))],
    67: [("a = object(); a.operator- = function(x, y) { return typeof(x) + typeof(y); }; a.operator== = function(x, y) { return 1; }; print(a - 1, 1 - a, -a, a != 1);", "objectnum numobject numobject 0"), ("a = object(); a.operator+ = function(x, y) { return 7; }; a += 1; print(a);", "7")],
    68: [("a = object(); a.operator+ = function(x, y) { return x + y; };\na + 1;", ("E608", "1:53")), ("S = scene(); a = object(); a.operator+ = function(x, y) { #S.Render(); return 1; };\nb = a + 1;", ("E415", "2:5"))],
    69: [("o = object(); x = o.__class__;", ("E421", "1:19")), ("o.__class__ = 1; print(o.__class__);", "1")],
    72: [('t = texture("no.png"); print(typeof(t));', "texture"), ('m = model("../a.obj");', ("E510", "1:5"))],
    78: [(BALL + "\ns.Move(\n  5);", ("E501", "2:1"))],
}  # fmt: skip
ROWS = [(number, row) for number, rows in TABLE.items() for row in rows]


@pytest.mark.parametrize(("number", "row"), ROWS, ids=[f"{n:02}-{r[0][:24]!r}" for n, r in ROWS])
def test_decision(number, row, run) -> None:
    text, expected = row
    outcome = run(text)
    if isinstance(expected, tuple):
        assert outcome.error == expected, outcome.diagnostics
        return
    assert outcome.error is None, outcome.diagnostics
    assert "\n".join(outcome.output) == expected


def test_every_decision_is_here() -> None:
    functions = {int(n) for name in globals() for n in re.findall(r"test_decision_(\d\d)_", name)}
    assert functions | set(TABLE) == set(range(1, 81))


def test_decision_42_warns_once_for_a_place(run) -> None:
    outcome = run("for (k = 0; k < 9; k++) x = u + 1;" + IF)
    assert outcome.warnings == [("W701", "1:29")]


def _folder(path: Path, **files: str) -> DiskFiles:
    for name, text in files.items():
        (path / f"{name}.trg").write_text(text)
    return DiskFiles(path)


def test_decision_70_includes_run_once_in_order_in_the_global_context(tmp_path, run) -> None:
    files = _folder(tmp_path, a='print("a"); x = 1; include("b.trg");', b='print("b"); y = x + 1;')
    outcome = run('include("a.trg"); include("b.trg"); include("a.trg"); print(x, y);', resolver=files)
    assert outcome.output == ["a", "b", "1 2"]
    assert run('include("c.trg");', resolver=_folder(tmp_path, c='include("c.trg");')).error[0] == "E320"
    assert run('f = function() { include("a.trg"); };', resolver=files).error[0] == "E214"


def test_decision_70_limits_depth_and_number_of_files(tmp_path, run) -> None:
    deep = _folder(tmp_path, **{f"d{n}": f'include("d{n + 1}.trg");' for n in range(20)})
    assert run('include("d0.trg");', resolver=deep).error[0] == "E322"
    many = _folder(tmp_path, **{f"m{n}": ";" for n in range(40)})
    assert run("".join(f'include("m{n}.trg");\n' for n in range(40)), resolver=many).error == ("E321", "33:9")


@pytest.mark.parametrize(
    "name",
    ["../a.trg", "/a.trg", "C:/a.trg", "C:a.trg", "\\\\\\\\host\\\\a.trg", "file:a.trg", "http://x/a.trg"],
)
def test_decision_71_no_include_leads_out(name, tmp_path, run) -> None:
    assert run(f'include("{name}");', resolver=_folder(tmp_path, a=";")).error == ("E510", "1:9")


def test_decision_71_both_slashes_and_the_bundled_library(run) -> None:
    if NoFiles()._bundled is None:
        pytest.skip("the library lies beside the package in a checkout only")
    text = 'include("stl\\\\rt\\\\trg_raytrace.trg"); include("stl/rt/trg_raytrace.trg"); print(1);'
    assert run(text).output == ["1"]


def test_decision_72_missing_files_warn_or_fail(run) -> None:
    text = 't = texture("no.png");'
    assert run(text).warnings == [("W702", "1:5")]
    assert run(text, strict_files=True).error == ("E511", "1:5")


def test_decision_73_an_endless_main_loop_has_a_budget_per_frame(run) -> None:
    text = "S = scene(); while (1) { for (i = 0; i < 900; i++) { } S.Render(); }"
    outcome = run(text, limits=Limits(max_steps=2000))
    assert outcome.error is None and len(outcome.frames) == 20
    assert run("while (1) { }", limits=Limits(max_steps=2000)).error[0] == "E601"


def test_decision_73_a_loop_that_never_renders_can_be_paused() -> None:
    session = Session(compile_source("while (1) { }", "m.trg"))
    assert isinstance(session.next_frame(max_seconds=0.001), PauseEvent)


def test_decision_74_render_works_through_functions_fields_aliases_and_arguments(run) -> None:
    text = (
        "S = scene(); f = function() { #S.Render(); return 1; }; o.f = f; g = f; r = S.Render; "
        "h = function(k) { return k(); }; x = f() + o.f() + g() + h(f); r(); print(x);"
    )
    outcome = run(text)
    assert outcome.error is None and outcome.output == ["4"] and len(outcome.frames) == 5


def test_decision_75_the_clock_counts_frames(run) -> None:
    text = "S = scene(); for (i = 0; i < 2; i++) { print(std::frame(), std::frames(), std::fps(), std::time()); S.Render(); }"
    assert run(text, frames=10, fps=4.0).output == ["1 10 4 0.25", "2 10 4 0.5"]


def test_decision_76_random_numbers_have_a_seed(run) -> None:
    text = "a = mth::rand(); std::seed(0); b = mth::rand(); std::seed(7); c = mth::rand(); print(a == b, a == c, a);"
    assert run(text).output == run(text).output
    assert run(text).output[0].startswith("1 0 ")


def test_decision_76_an_unknown_render_mode_is_a_warning(run) -> None:
    outcome = run('S = scene(); std::setrndmode("cuda"); S.Render(); std::setrndmode("magic"); S.Render();')
    assert [frame.modes.device for frame in outcome.frames] == ["cuda", None]
    assert [code for code, _ in outcome.warnings] == ["W703"]


def test_decision_77_limits_are_shown_and_named(run) -> None:
    shown = "\n".join(run("std::limits();", limits=Limits(max_steps=4321)).output)
    assert "4321" in shown and "1000000" in shown
    assert "4321" in run("while (1) { }", limits=Limits(max_steps=4321)).diagnostics[0].message


@pytest.mark.parametrize(
    ("text", "place"),
    [("s = sphere(vec3(0), 1,\n 2);", (2, 2)), ("s = sphere(vec3(0),\n 0);", (2, 2)), ("x = mth::sin(\n  object());", (2, 3)),
     (BALL + "\ns.Move(\n  5);", (3, 3)), ("l = [];\nl.insert(1,\n 2);", None)],
)  # fmt: skip
def test_decision_78_related_points_at_the_argument(text, place, run) -> None:
    (found,) = run(text).diagnostics
    places = [(span.line, span.col) for span, _ in found.related]
    assert places == ([] if place is None else [place])
    if place is None:
        assert (found.span.line, found.span.col) == (2, 10)


def test_decision_79_an_error_ends_the_program_and_frames_before_it_stay() -> None:
    session = Session(
        compile_source("S = scene(); S.Render(); x = 1 / 0; S.Render();", "m.trg"), HostOptions()
    )
    session.next_frame()
    ended = session.next_frame()
    assert ended.error is not None and (ended.error.span.line, ended.error.span.col) == (1, 30)
    assert session.next_frame() is ended


def test_decision_80_output_is_cut_in_a_frame_and_in_a_run(run) -> None:
    outcome = run("for (i = 0; i < 300; i++) print(i);")
    assert len(outcome.output) == 201 and outcome.output[-1] == "output cut"
    limits = Limits(output_lines=30)
    outcome = run("S = scene(); while (1) { for (i = 0; i < 20; i++) print(i); S.Render(); }", limits=limits)
    assert len(outcome.output) == 31 and outcome.output[-1] == "output cut"
