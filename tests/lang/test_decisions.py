# ruff: noqa: E501 (programs on one line)
"""Decisions of the language, by topic: each row is a program and its output, or its error."""

from __future__ import annotations

import pytest

OUTPUTS = {
    "a chain of assignments runs from the right": ("a = b = 3; print(a, b);", "3 3"),
    "a compound assignment has a value": ("b = 1; a = (b += 2); print(a, b);", "3 3"),
    "a field assignment has a value": ("a = (p.x = 4); print(a, p.x);", "4 4"),
    "steps of fields have values": ("p.x = 1; print(p.x++, ++p.x, p.x--, --p.x);", "1 3 3 1"),
    "a step of an undefined variable counts from 0": ("if (0) i = 1; print(i++, i);", "0 1"),
    "modulo has the sign of the divisor": ("print(-7 % 3, 7 % -3);", "2 -2"),
    "overflow is infinite": ("x = 1e308 * 10; print(x, -x);", "inf -inf"),
    "whole numbers print without a point": ("print(9007199254740992, 1e16, 0.1, -0.0);", "9007199254740992 1e+16 0.1 0"),
    "strings escape": ('print("a\\tb\\"c\\\\");', 'a\tb"c\\'),
    "a comment ends a line": ("print(1); // print(2);", "1"),
    "a bare block makes no context": ("{ a = 1; } print(a);", "1"),
    "a switch takes the first match": ("switch (2) { case 2: print(1); break; case 2: print(2); }", "1"),
    "default may stand first": ("switch (5) { default: print(0); break; case 1: print(1); }", "0"),
    "default in the middle falls through": ("switch (5) { case 1: print(1); default: print(0); case 2: print(2); }", "0\n2"),
    "switch compares strings": ('switch ("b") { case "a": print(1); break; case "b": print(2); }', "2"),
    "an empty switch does nothing": ("switch (1) { } print(1);", "1"),
    "continue in a nested switch continues the loop": (
        "n = 0; for (i = 0; i < 3; i++) { switch (1) { case 1: switch (i) { case 1: continue; } } n++; } print(n);", "2"),
    "continue in a while runs the condition": ("i = 0; while (i++ < 5) { if (i == 2) continue; print(i); }", "1\n3\n4\n5"),
    "break leaves the inner loop only": ("for (i = 0; i < 2; i++) { for (;;) { break; } print(i); }", "0\n1"),
    "all parts of for are optional": ("i = 0; for (;;) { if (i == 3) break; i++; } print(i);", "3"),
    "nested operators of objects": (
        "v = object(); v.n = 1; v.operator+ = function(a, b) { r = object(); r.n = a.n + b.n; r.operator+ = a.operator+; return r; };"
        " w = v + v + v; print(w.n);", "3"),
    "compound assignment uses the operator": ("a = object(); a.operator+ = function(x, y) { return 7; }; a += 1; print(a);", "7"),
    "a step uses the operator": ("a = object(); a.operator+ = function(x, y) { return y; }; a++; print(a);", "1"),
    "unary minus calls operator- with 0": ("a = object(); a.operator- = function(x, y) { return x; }; print(-a);", "0"),
    "an operator sees left and right in order": (
        'a = object(); a.operator- = function(x, y) { return typeof(x) + typeof(y); }; print(5 - a, a - 5);', "numobject objectnum"),
    "a comparison sees left and right in order": (
        'a = object(); a.operator< = function(x, y) { print(typeof(x)); return 1; }; b = 5 < a; b = a < 5;', "num\nobject"),
    "equality sees left and right in order": (
        'a = object(); a.operator== = function(x, y) { print(typeof(x)); return 1; }; b = 5 == a; b = a == 5;', "num\nobject"),
    "not may be overloaded": ("a = object(); a.operator! = function(x) { return 5; }; print(!a, !0);", "5 1"),
    "the assignment token is split behind an operator": ("a = object(); a.operator+=function(x, y) { return 3; }; print(a + 1);", "3"),
    "objects are equal to themselves only": ("a = object(); b = object(); print(a == a, a == b, a != b);", "1 0 1"),
    "copies are shallow": ("a = object(); a.n = 1; a.o = object(); b = copy(a); b.n = 2; print(a.n, b.n, a.o == b.o);", "1 2 1"),
    "functions have fields": ("f = function() { return 1; }; f.n = 5; print(f.n, f());", "5 1"),
    "function values are different each time": ("mk = function() { return function() { }; }; print(mk() == mk());", "0"),
    "isdef asks without a warning": ("print(isdef(a), isdef(o.f)); if (0) { a = 1; o = 1; }", "0 0"),
    "isdef sees fields": ("o.f = 1; print(isdef(o.f), isdef(o.g));", "1 0"),
    "a name may be Cyrillic with combining marks": ("й = 1; print(й);", "1"),
    "built-ins are values": ("f = mth::sqrt; print(f(9), typeof(f));", "3 function"),
    "methods are values": ("Scene = scene(); f = Scene.Add; f(sphere(vec3(0), 1)); print(typeof(f));", "function"),
    "default after default": ("f = function(a = 1, b = a + 1) { return b; }; print(f(), f(5), f(5, 2));", "2 6 2"),
    "a default in the middle": ("f = function(a = 1, b) { return a + b; }; print(f(2, 3));", "5"),
    "objects print their fields": ("p.x = 1; p.s = \"t\"; print(p, object);", 'object(x = 1, s = "t") function'),
    "vectors divide and negate": ("print(vec3(2, 4, 6) / 2, -vec3(1));", "vec3(1, 2, 3) vec3(-1, -1, -1)"),
    "logic gives one or zero": ("print(5 && 3, 0 || 7, 0 && 1);", "1 1 0"),
    "strings add numbers from both sides": ('print(1 + "a" + 2);', "1a2"),
    "length counts characters": ('print(len("длина"));', "5"),
    "a call may stand on several lines": ("o.f = function() { return 3; };\nprint(o\n  .f());", "3"),
    "random numbers are the same in every run": ("a = mth::rand(); std::seed(0); print(a == mth::rand(), a >= 0, a < 1);", "1 1 1"),
    "functions of vectors": ("print(mth::dot(vec3(1, 2, 3), vec3(1)), mth::cross(vec3(1, 0, 0), vec3(0, 1, 0)), mth::length(vec3(3, 4, 0)), mth::normalize(vec3(0, 5, 0)));",
                             "6 vec3(0, 0, 1) 5 vec3(0, 1, 0)"),
    "functions of numbers": ("print(mth::floor(-1.5), mth::ceil(1.2), mth::abs(-2), mth::min(3, 1, 2), mth::max(3, 1), mth::clamp(5, 0, 1), mth::sign(-3), mth::pow(2, 10), mth::mix(0, 10, 0.25));",
                             "-2 2 2 1 3 1 -1 1024 2.5"),
    "noise is smooth and bounded": ("a = mth::noise(vec3(0.5, 1.5, 2.5)); print(a == mth::noise(vec3(0.5, 1.5, 2.5)), a < 1, a > -1);", "1 1 1"),
    "a global reached by hash inside a field call": ("o = object(); o.n = 2; f = function() { return #o.n; }; print(f());", "2"),
    "hash creates an object": ("f = function() { #p.x = 1; }; f(); print(p.x); if (0) p = 0;", "1"),
    "a switch inside a function": ('f = function(x) { switch (x) { case 1: return "a"; } return "b"; }; print(f(1), f(2));', "a b"),
    "mixed logic and comparison": ("print(1 < 2 && 2 < 3 || 0, !(1 == 2));", "1 1"),
}  # fmt: skip


@pytest.mark.parametrize("fact", OUTPUTS, ids=lambda f: f.replace(" ", "_"))
def test_output(fact, run) -> None:
    text, expected = OUTPUTS[fact]
    outcome = run(text)
    assert outcome.error is None, outcome.diagnostics
    assert "\n".join(outcome.output) == expected


ERRORS = {
    "single quotes are reserved": ("x = 'a';", "E100", "1:5"),
    "in is a keyword": ("in = 1;", "E205", "1:1"),
    "true is reserved": ("x = true;", "E107", "1:5"),
    "a keyword is no field": ("a.if = 1;", "E204", "1:3"),
    "a comment must end": ("/* x", "E106", "1:1"),
    "numbers have at most 64 characters": ("x = " + "1" * 65 + ";", "E103", "1:5"),
    "only targets are assigned": ("1 = 2;", "E206", "1:1"),
    "two parameters of one name": ("f = function(a, a) { };", "E208", "1:17"),
    "an unknown type": ('f = function(a ~ "nmu") { };', "E304", "1:18"),
    "a type needs quotes": ("f = function(a ~ num) { };", "E209", "1:18"),
    "a stray brace": ("x = 1; }", "E210", "1:8"),
    "include inside a block": ('{ include("a.trg"); }', "E214", "1:3"),
    "include of an expression": ("include(1);", "E215", "1:9"),
    "break in a function inside a loop": ("while (0) { f = function() { break; }; }", "E216", "1:30"),
    "a misspelt name": ("radius = 1; x = raduis;", "E302", "1:17"),
    "a misspelt built-in": ("x = material::glod();", "E302", "1:5"),
    "names of host spaces": ("mth::x = 1;", "E311", "1:1"),
    "stl is the library's": ("stl::x = 1;", "E311", "1:1"),
    "plus joins no vector and number": ("x = vec3(1) + 1;", "E410", "1:5"),
    "a string has no minus": ('x = "a" - "b";', "E410", "1:5"),
    "no formatting by modulo": ('x = "%s" % 5;', "E410", "1:5"),
    "a string is not stepped": ('s = "a"; s++;', "E413", "1:10"),
    "a string is not negated": ('x = -"a";', "E413", "1:5"),
    "an undefined variable in a string": ('x = "a" + u; if (0) u = 1;', "E411", "1:5"),
    "an undefined variable as an argument": ("x = mth::sin(u); if (0) u = 1;", "E507", "1:5"),
    "a field of an undefined variable": ("x = u.f; if (0) u = 1;", "E422", "1:5"),
    "a component cannot be set": ("p = vec3(1); p.x = 5;", "E423", "1:14"),
    "functions have no order": ("f = function() { }; x = f < 1;", "E412", "1:25"),
    "a field of a number is not set": ("x = 1; x.y = 2;", "E420", "1:8"),
    "a field of a shape is not set": ("s = sphere(vec3(0), 1); s.size = 2;", "E424", "1:25"),
    "a built-in has no fields": ("x = mth::sin.f;", "E421", "1:5"),
    "a missing argument": ("f = function(a, b) { };\nf(1);", "E432", "2:1"),
    "too many arguments": ("f = function(a, b = 1) { };\nf(1, 2, 3);", "E433", "2:1"),
    "a missing argument after a default": ("f = function(a = 1, b) { };\nf(1);", "E432", "1:21"),
    "a vector is not 2 numbers": ("x = vec3(1, 2);", "E506", "1:5"),
    "a radius is positive": ("x = sphere(vec3(0), 0);", "E504", "1:5"),
    "numbers for the host are finite": ("x = sphere(vec3(0), 1e308 * 10);", "E503", "1:5"),
    "vectors for the host are finite": ("x = sphere(vec3(1) * (1e308 * 10), 1);", "E503", "1:5"),
    "a colour is not negative": ("x = dir_light(vec3(1), vec3(-1));", "E505", "1:5"),
    "the square root of a negative number": ("x = mth::sqrt(-1);", "E504", "1:5"),
    "no vector without length": ("x = mth::normalize(vec3(0));", "E508", "1:5"),
    "a power that is not real": ("x = mth::pow(-1, 0.5);", "E508", "1:5"),
    "division by an undefined variable": ("x = 1 / u; if (0) u = 1;", "E401", "1:5"),
    "a vector divided by zero": ("x = vec3(1) / 0;", "E401", "1:5"),
    "too many arguments in a call": ("f(" + "1," * 255 + "1);", "E223", "1:513"),
    "operators nest 50 deep": ("a = object(); a.operator+ = function(x, y) { return x + y; }; a + 1;", "E608", "1:53"),
    "a picture has a size": ("Scene = scene(); Scene.CamSet(0, 1, vec3(1), vec3(0), vec3(0, 1, 0));", "E504", "1:18"),
    "an operator field needs a function": ("a = object(); a.operator+ = 5; a + 1;", "E416", "1:32"),
}  # fmt: skip


@pytest.mark.parametrize("fact", ERRORS, ids=lambda f: f.replace(" ", "_"))
def test_error(fact, run) -> None:
    text, code, place = ERRORS[fact]
    assert run(text).error == (code, place)


def test_errors_come_in_source_order_up_to_twenty(run) -> None:
    errors = [d for d in run("x = ;\n" * 30).diagnostics if d.severity == "error"]
    assert [d.span.line for d in errors] == list(range(1, 21))


def test_a_parse_error_does_not_hide_the_next(run) -> None:
    found = run("if (1 { x = 1; }\ny = 2 +;\nz = 3;").diagnostics
    assert [d.span.line for d in found] == [1, 2]


def test_did_you_mean_carries_a_fix(run) -> None:
    (found,) = run("radius = 1;\nx = raduis;").diagnostics
    assert found.fix is not None
    assert found.fix[1] == "radius"
    assert "radius" in (found.hint or "")


def test_a_global_without_hash_points_at_the_global_and_offers_the_hash(run) -> None:
    (found,) = run("g = 7;\nf = function() { return g; };").diagnostics
    assert found.fix is not None and found.fix[1] == "#g"
    assert [(span.line, span.col) for span, _ in found.related] == [(1, 1)]


def test_a_wrong_argument_is_pointed_at(run) -> None:
    (found,) = run("Scene = scene();\nScene.Add(\n    5);").diagnostics
    assert [(span.line, span.col) for span, _ in found.related] == [(3, 5)]


def test_the_stack_names_the_calls_innermost_first(run) -> None:
    text = "f = function(x) { return 1 / x; };\ng = function(x) { return #f(x); };\ng(0);"
    (found,) = run(text).diagnostics
    assert [(name, span.line, span.col) for name, span in found.stack] == [("f", 2, 26), ("g", 3, 1)]


def test_an_undefined_operand_is_pointed_at_wherever_it_stands(run) -> None:
    outcome = run("x = 3 + u; y = u < 1; z = 1 < u; w = -u; v = u * u; if (0) u = 1;")
    assert outcome.error is None
    places = [("W701", f"1:{col}") for col in (9, 16, 31, 39, 46, 50)]
    assert outcome.warnings == places


def test_one_warning_for_a_place_in_a_loop(run) -> None:
    outcome = run("for (k = 0; k < 9; k++) { x = u + 1; } if (0) u = 1;")
    assert outcome.warnings == [("W701", "1:31")]


def test_lints_do_not_stop_a_program(run) -> None:
    outcome = run("a = 0; if (a = 3) print(a); switch (1) { case 1: a = 1; case 2: a = 2; }")
    assert outcome.output == ["3"]
    assert [d.code for d in outcome.diagnostics] == ["L801", "L803"]
