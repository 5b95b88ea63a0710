# ruff: noqa: E501 (programs on one line)
"""Hostile programs: every one ends in a diagnostic, soon, and reaches nothing."""

from __future__ import annotations

import ast as py
import sys
import time

import pytest

from trg_blender.lang import HOST, Limits, ProgramError, compile_source
from trg_blender.lang.check import ForbiddenTree, check_tree
from trg_blender.lang.memory import resident_bytes

SECONDS = 10.0
"""CPU seconds: other work on the machine must not fail a test."""
MEGABYTES = 600

ESCAPES = [
    "__import__", "eval", "exec", "open", "compile", "globals", "__builtins__", "getattr", "type",
    "K_", "S_", "u_", "d_", "A_", "t_num", "g_print", "l_x", "b_print", "f_0", "m_0", "c_0", "None", "self",
]  # fmt: skip


@pytest.mark.parametrize("name", ESCAPES)
def test_no_python_name_is_reachable(name, run) -> None:
    assert run(f"x = {name};").error == ("E302", "1:5")
    assert run(f"x = #{name};").error == ("E302", "1:5")


FIELDS = [
    "__class__", "__dict__", "__globals__", "__code__", "__mro__", "gi_frame", "f_back", "f_globals",
    "rt", "text", "__init__", "__del__", "record", "invoke", "builtin", "T_x", "__self__", "__func__",
]  # fmt: skip
HOLDERS = {
    "num": "1", "str": '"a"', "vec3": "vec3(1)", "object": "object()", "function": "function() { }",
    "builtin": "mth::sin", "scene": "scene()", "shape": "sphere(vec3(0), 1)", "method": "scene().Add",
    "list": "[1]", "material": "material::gold()", "medium": "enviroment(0, 1)", "light": "dir_light(vec3(1), vec3(1))",
}  # fmt: skip


@pytest.mark.parametrize("holder", HOLDERS)
@pytest.mark.parametrize("field", FIELDS)
def test_no_python_attribute_is_reachable(holder, field, run) -> None:
    code, _ = run(f"v = {HOLDERS[holder]}; print(v.{field});").error
    assert code in ("E420", "E421")
    outcome = run(f"v = {HOLDERS[holder]}; v.{field} = 1; print(v.{field});")
    assert outcome.error is None and outcome.output == ["1"] or outcome.error[0] in (
        "E420", "E421", "E423", "E424",
    )  # fmt: skip


@pytest.mark.parametrize("name", sorted(HOST.functions))
def test_every_builtin_refuses_strange_arguments(name, run) -> None:
    strange = ["", "1", '"a"', "object()", "scene()", "vec3(1)", "print", "function() { }", "1e308 * 10"]
    for value in strange:
        for count in range(7):
            outcome = run(f"x = {name}({', '.join([value or '0'] * count)});")
            assert outcome.error is None or outcome.error[0].startswith(("E4", "E5")), outcome.error


@pytest.mark.parametrize(("kind", "name"), sorted(HOST.methods))
def test_every_method_refuses_strange_arguments(kind, name, run) -> None:
    makers = {
        "scene": "scene()", "shape": "sphere(vec3(0), 1)", "material": "material::gold()",
        "light": "dir_light(vec3(1), vec3(1))", "list": "[1, 2]",
    }  # fmt: skip
    for value in ("1", '"a"', "object()", "vec3(0)", "print", "-1", "1e308 * 10", "sphere(vec3(0), 1)"):
        for count in range(7):
            outcome = run(f"o = {makers[kind]}; o.{name}({', '.join([value] * count)});")
            assert outcome.error is None or outcome.error[0].startswith(("E4", "E5")), outcome.error


HOSTILE = {
    "an endless loop": "while (1) { }",
    "an endless loop in a function": "f = function() { while (1) { } }; f();",
    "an endless loop in an operator": "a = object(); a.operator+ = function(x, y) { for (;;) { } }; a + 1;",
    "an endless loop in a default": "g = function() { for (;;) { } }; f = function(a = #g()) { }; f();",
    "mutual recursion": "f = function() { #g(); }; g = function() { #f(); }; f();",
    "recursion through a field": "o.f = function(self) { self.f(); }; o.f();",
    "recursion through operators": "a = object(); a.operator+ = function(x, y) { return x + y; }; a + 1;",
    "recursion of a function that renders": "S = scene(); f = function() { #f(); #S.Render(); }; f();",
    "recursion in a default": "f = function(a = #f()) { }; f();",
    "operators and calls in turn": "a = object(); f = function() { return #a + 1; }; a.operator+ = function(x, y) { return #f(); }; f();",
    "exponential calls": "f = function(n) { if (n > 0) { #f(n - 1); #f(n - 1); } }; f(60);",
    "string doubling": 's = "ab"; while (1) s = s + s;',
    "many strings": 's = "ab"; for (i = 0; i < 14; i++) s = s + s; h = 0; while (1) { o = object(); o.s = s + i; o.n = h; h = o; i++; }',
    "a list of objects": "h = 0; while (1) { o = object(); o.n = h; h = o; }",
    "objects with many fields": "h = 0; while (1) { o = object(); " + "".join(f"o.f{i} = 1;" for i in range(900)) + " o.n = h; h = o; }",
    "many functions": "h = 0; while (1) { f = function() { }; f.n = h; h = f; }",
    "many vectors": "h = 0; while (1) { o = object(); o.a = vec3(1); o.b = vec3(2); o.n = h; h = o; }",
    "much output": 's = "ab"; for (i = 0; i < 14; i++) s = s + s; while (1) print(s, s, s, s, s, s, s, s);',
    "much work between two steps": 's = "ab"; for (i = 0; i < 14; i++) s = s + s; while (1) { ' + "x = s + i;" * 49 + " }",
    "many shapes": "while (1) sphere(vec3(0), 1);",
    "many materials": "h = 0; while (1) { o = object(); o.m = material::gold(); o.n = h; h = o; }",
    "copies of large objects": "o = object(); " + "".join(f"o.f{i} = 1;" for i in range(900)) + " h = 0; while (1) { c = copy(o); c.n = h; h = c; }",
    "numbers that grow": "x = 2; while (1) x = x * x + x;",
}  # fmt: skip


@pytest.mark.parametrize("fact", HOSTILE, ids=lambda f: f.replace(" ", "_"))
def test_a_hostile_program_stops(fact, run) -> None:
    start, size = time.thread_time(), resident_bytes()
    outcome = run(HOSTILE[fact])
    assert outcome.error is not None and outcome.error[0].startswith("E6"), outcome.error
    assert time.thread_time() - start < SECONDS
    assert (resident_bytes() - size) / 1048576 < MEGABYTES


DEEP = {
    "parentheses": "x = " + "(" * 5000 + "1" + ")" * 5000 + ";",
    "minus signs": "x = " + "- " * 5000 + "1;",
    "blocks": "{" * 5000 + "}" * 5000,
    "functions": "x = " + "function() { return " * 3000 + "1" + "; }" * 3000 + ";",
    "calls": "x = print" + "()" * 5000 + ";",
    "fields": "x = 1; y = x" + ".a" * 5000 + ";",
    "sums": "x = 1" + " + 1" * 20000 + ";",
    "sums of sums": "x = " + "(" * 50 + "1" + (" + 1" * 390 + ")") * 50 + ";",
    "comparisons of sums": "x = " + "(" * 50 + "1" + (" < 1" * 390 + ")") * 50 + ";",
    "chains of chains": "x = 1; y = " + "(" * 50 + "x" + (".a" * 90 + ")") * 50 + ";",
    "logic": "x = 1" + " && 1 || 0" * 5000 + ";",
    "assignments": "x = " * 5000 + "1;",
    "else if": "if (0) ; " + "else if (0) ; " * 5000,
    "if": "if (1) " * 5000 + ";",
    "loops": "while (0) " * 5000 + ";",
    "switches": "switch (1) { case 1: " * 3000 + "}" * 3000,
    "cases": "switch (1) { " + "case 1: " * 5000 + "}",
    "paths": "x = " + "a::" * 5000 + "a;",
    "open brackets": "(" * 20000,
    "open blocks": "while (1) {" * 8000,
    "closing brackets": ")" * 20000,
    "closing braces": "}" * 20000,
    "hashes": "#" * 20000,
    "quotes": '"' * 20001,
    "backslashes": '"' + "\\" * 20001,
    "comments": "/*" * 20000,
    "a long string": 'x = "' + "a" * 200_000 + '";',
    "a long name": "a" * 200_000 + " = 1;",
    "a long number": "x = " + "1" * 200_000 + ";",
    "many names": "".join(f"a{i} = b{i};" for i in range(9000)),
    "many errors": "x = ;" * 20000,
    "many continues": "for (i = 0; i < 1; i = i + 1 + 1 + 1 + 1 + 1) { " + "if (0) continue; " * 5000 + "}",
    "many parameters": "f = function(" + ",".join(f"p{i}" for i in range(3000)) + ") { };",
}  # fmt: skip


@pytest.mark.parametrize("fact", DEEP, ids=lambda f: f.replace(" ", "_"))
def test_a_deep_or_long_text_never_ends_in_a_python_error(fact, run) -> None:
    start = time.thread_time()
    outcome = run(DEEP[fact])
    assert all(d.code != "E900" for d in outcome.diagnostics)
    assert time.thread_time() - start < SECONDS


def test_limits_of_texts_within_their_bounds_compile(run) -> None:
    assert run("x = " + "(" * 30 + "1" + " + 1)" * 30 + "; print(x);").output == ["31"]
    assert run("x = 1" + " + 1" * 400 + "; print(x);").output == ["401"]
    assert run("if (0) ; " + "else if (0) ; " * 149 + "else print(1);").output == ["1"]
    cases = "".join(f"case {i}: print({i}); break; " for i in range(1000))
    assert run("switch (999) { " + cases + "}").output == ["999"]


@pytest.mark.parametrize(
    "text",
    ["import os", "x.y", "(lambda: 0)", "[1]", "{}", "f'{1}'", "[i for i in g_x]", "b'a'", "'a'",
     "g_x(a_=1)", "class A: pass", "try:\n pass\nfinally:\n pass", "x", "g_x ** 2", "del g_x",
     "def f_0(*l_a): pass", "assert g_x", "with g_x: pass"],
)  # fmt: skip
def test_the_allow_list_refuses(text) -> None:
    with pytest.raises(ForbiddenTree):
        check_tree(py.parse(text))


def test_nothing_of_python_shows_in_printed_values(run) -> None:
    text = (
        "print(print, scene(), sphere(vec3(0), 1), material::gold(), function() { }, object(), scene().Add);"
    )
    (line,) = run(text).output
    assert "0x" not in line and "<" not in line


def test_output_is_cut(run) -> None:
    outcome = run("for (i = 0; i < 1000; i++) print(i);")
    assert len(outcome.output) == 201
    assert outcome.output[-1] == "output cut"


def test_a_full_python_stack_is_a_diagnostic() -> None:
    def deeper(left: int) -> None:
        if left:
            deeper(left - 1)
            return
        with pytest.raises(ProgramError):
            compile_source("x = " + "(" * 60 + "1" + ")" * 60 + ";", "m.trg")

    frame, used = sys._getframe(), 0
    while frame is not None:
        frame, used = frame.f_back, used + 1
    deeper(sys.getrecursionlimit() - used - 60)


def test_a_limit_names_its_value(run) -> None:
    (found,) = run("for (;;) { }", limits=Limits(max_steps=5000)).diagnostics
    assert found.code == "E601" and "5000" in found.message
