# ruff: noqa: E501 (programs on one line)
"""Lists: literals, elements, methods, loops, bounds; each row is a program and its output, or its error."""

from __future__ import annotations

import pytest

from trg_blender.lang import Limits

OUTPUTS = {
    "a literal and list() make the same": ("print([1, 2], list(1, 2), [], list());", "[1, 2] [1, 2] [] []"),
    "elements are read and written": ("l = [1, 2]; l[1] = l[0] + 4; print(l);", "[1, 5]"),
    "compound assignment and steps reach elements": ("l = [1]; l[0] += 2; l[0]++; --l[0]; print(l);", "[3]"),
    "assignments to elements have values": ("l = [1]; print(l[0]++, ++l[0], l[0]--, (l[0] = 9), (l[0] += 1), l);", "1 3 3 9 10 [10]"),
    "the index of a step is computed once": ("n = 0; f = function() { #n++; return 0; }; l = [5]; x = l[f()]++; l[f()] += 1; print(n, l);", "2 [7]"),
    "lists in lists": ("m = [[1, 2], [3, 4]]; m[1][0] = 7; print(m[1][0] + m[0][1], m);", "9 [[1, 2], [7, 4]]"),
    "lists in fields and fields of elements": ("o.l = [object()]; o.l[0].x = 3; print(o.l[0].x);", "3"),
    "functions in lists are called": ("l = [function(x) { return x * 2; }, mth::sqrt]; print(l[0](4), l[1](9));", "8 3"),
    "length": ("print(len([]), len([1, [2, 3]]), len(\"ab\"));", "0 2 2"),
    "append insert remove pop": ("l = [1]; l.append(2).append(3); l.insert(0, 0); l.insert(4, 4); print(l.remove(1), l.pop(), l);", "1 4 [0, 2, 3]"),
    "equality is identity": ("a = [1]; b = a; print(a == b, a == [1], a != [1], copy(a) == a);", "1 0 1 0"),
    "a copy is shallow": ("a = [1, [2]]; b = copy(a); b[0] = 5; b[1][0] = 6; print(a, b);", "[1, [6]] [5, [6]]"),
    "lists are true": ("if ([]) print(1);", "1"),
    "the type has a name": ('f = function(l ~ "list") { return typeof(l); }; print(f([]));', "list"),
    "strings in lists print in quotes": ('print(["a", vec3(1), object(), print]);', '["a", vec3(1, 1, 1), object, function]'),
    "a list in itself prints": ("l = [1]; l.append(l); print(l);", "[1, [1, [1, [1, [...]]]]]"),
    "a long list prints its beginning": ("l = []; for (i = 0; i < 150; i++) l.append(i); print(l);", "[" + ", ".join(map(str, range(100))) + ", ...]"),
    "for in goes over the elements": ("for (x in [3, 4]) print(x); print(x);", "3\n4\n4"),
    "for in over nothing": ("x = 1; for (x in []) print(2); print(x);", "1"),
    "for in with break and continue": ("for (x in [1, 2, 3, 4]) { if (x == 2) continue; if (x == 4) break; print(x); }", "1\n3"),
    "for in inside a function": ("f = function(l) { s = 0; for (x in l) { if (x == 2) continue; s += x; } return s; }; print(f([1, 2, 3]), f([]));", "4 0"),
    "for in to a global": ("f = function() { for (#g in [1, 2]) { } }; g = 0; f(); print(g);", "2"),
    "for in nests": ("for (a in [1, 2]) for (b in [10, 20]) print(a + b);", "11\n21\n12\n22"),
    "elements that are appended are visited": ("l = [1]; for (x in l) { if (len(l) < 4) l.append(x + 1); } print(l, x);", "[1, 2, 3, 4] 4"),
    "a removed element shifts the rest": ("l = [1, 2, 3, 4]; for (x in l) { if (x == 2) l.remove(1); else print(x); }", "1\n4"),
    "a new list in the variable does not change the loop": ("l = [1, 2]; for (x in l) { l = []; print(x); }", "1\n2"),
    "a switch inside for in": ("for (x in [1, 2]) { switch (x) { case 1: continue; default: print(x); } }", "2"),
    "the right side is computed before the target": ('l = [0]; f = function(n) { print(n); return 0; }; l[f("index")] = f("value"); x = (l[f("index")] = f("value"));', "value\nindex\nvalue\nindex"),
    "undefined elements are kept": ("l = [u]; print(typeof(l[0]), isdef(l[0])); if (0) u = 1;", "undef 0"),
}  # fmt: skip


@pytest.mark.parametrize("fact", OUTPUTS, ids=lambda f: f.replace(" ", "_"))
def test_output(fact, run) -> None:
    text, expected = OUTPUTS[fact]
    outcome = run(text)
    assert outcome.error is None, outcome.diagnostics
    assert "\n".join(outcome.output) == expected


ERRORS = {
    "reading behind the end": ("l = [1];\nx = l[1];", "E442", "2:7"),
    "writing behind the end": ("l = [1];\nl[1] = 2;", "E442", "2:3"),
    "a negative index": ("l = [1];\nx = l[-1];", "E441", "2:7"),
    "a fractional index": ("l = [1];\nx = l[0.5];", "E441", "2:7"),
    "an index that is a string": ('l = [1];\nx = l["0"];', "E443", "2:7"),
    "an index without a value": ("l = [1];\nx = l[u]; if (0) u = 1;", "E443", "2:7"),
    "an infinite index": ("l = [1];\nx = l[1e308 * 10];", "E441", "2:7"),
    "insert behind the end": ("l = [1];\nl.insert(2, 0);", "E442", "2:10"),
    "remove of a fraction": ("l = [1];\nl.remove(0.5);", "E441", "2:10"),
    "pop of an empty list": ("l = [];\nl.pop();", "E445", "2:1"),
    "an unknown method": ("l = [];\nl.push(1);", "E421", "2:1"),
    "an element of a number": ("n = 1;\nx = n[0];", "E440", "2:5"),
    "an element of a vector": ("v = vec3(1);\nx = v[0];", "E440", "2:5"),
    "an element of a vector is not set": ("v = vec3(1);\nv[0] = 1;", "E440", "2:1"),
    "an element of a string": ('s = "abc";\nx = s[0];', "E440", "2:5"),
    "an element of an object": ("o = object();\nx = o[0];", "E440", "2:5"),
    "an element of a function": ("f = function() { };\nx = f[0];", "E440", "2:5"),
    "an element of a built-in": ("x = mth::sin[0];", "E440", "1:5"),
    "an element of the scene": ("s = scene();\ns[0] = 1;", "E440", "2:1"),
    "an element of nothing": ("x = u[0]; if (0) u = 1;", "E446", "1:5"),
    "elements create no list": ("u[0] = 1; if (0) u = 1;", "E446", "1:1"),
    "for in over a number": ("for (x in 5) { }", "E444", "1:11"),
    "for in over an object": ("f = function() { for (x in object()) { } };\nf();", "E444", "1:28"),
    "lists have no plus": ("x = [1] + [2];", "E410", "1:5"),
    "lists have no order": ("x = [1] < [2];", "E412", "1:5"),
    "lists have no fields of their own": ("l = [];\nl.x = 1;", "E424", "2:1"),
    "a literal is no target": ("[1] = 2;", "E206", "1:1"),
    "a list must be closed": ("l = [1, 2;", "E201", "1:10"),
    "an index must be closed": ("l = [1]; x = l[0;", "E201", "1:17"),
    "an element must stand between commas": ("l = [1, , 2];", "E205", "1:9"),
    "a literal holds at most 1000": ("l = [" + "1," * 1000 + "1];", "E227", "1:2006"),
    "the loop variable of for in is local": ("f = function() { for (x in [1]) { } };\nprint(x);", "E302", "2:7"),
    "for in has one variable": ("for (a.b in [1]) { }", "E201", "1:9"),
    "in stands in for only": ("x = 1 in [1];", "E201", "1:6"),
}  # fmt: skip


@pytest.mark.parametrize("fact", ERRORS, ids=lambda f: f.replace(" ", "_"))
def test_error(fact, run) -> None:
    text, code, place = ERRORS[fact]
    assert run(text).error == (code, place)


def test_hints_say_what_to_write_instead(run) -> None:
    def hint(text: str) -> str:
        return run(text).diagnostics[0].hint or ""

    assert "len(l) - 1" in hint("l = [1]; x = l[-1];")
    assert "mth::floor" in hint("l = [1]; x = l[0.5];")
    assert "append" in hint("l = [1]; l[1] = 2;")


def test_bounds_errors_name_index_and_length(run) -> None:
    message = run("l = [1, 2]; x = l[7];").diagnostics[0].message
    assert "7" in message and "2" in message


GROWING = {
    "append": "l = []; while (1) l.append(1);",
    "insert": "l = []; while (1) l.insert(0, 1);",
    "appending in a loop over the list": "l = [1]; for (x in l) l.append(x);",
    "copies": "l = [1]; h = []; while (1) { h.append(copy(l)); for (x in copy(l)) l.append(x); }",
    "literals": "h = []; while (1) h.append([1, 2, 3, 4, 5, 6, 7, 8]);",
}


@pytest.mark.parametrize("fact", GROWING)
def test_all_lists_together_have_a_limit(fact, run) -> None:
    outcome = run(GROWING[fact], limits=Limits(max_elements=5000))
    assert outcome.error is not None and outcome.error[0] == "E612"
    assert "5000" in outcome.diagnostics[0].message


def test_elements_of_lists_that_are_gone_do_not_count(run) -> None:
    text = "for (i = 0; i < 3000; i++) { l = [1, 2, 3]; l.append(l); l.pop(); l = [4]; m = [5]; m.append(m); } print(1);"
    assert run(text, limits=Limits(max_elements=500)).output == ["1"]


def test_removed_elements_do_not_count(run) -> None:
    text = (
        "l = []; for (i = 0; i < 900; i++) { l.append(i); l.append(i); l.pop(); l.remove(0); } print(len(l));"
    )
    assert run(text, limits=Limits(max_elements=10)).output == ["0"]


def test_for_in_counts_steps_in_functions_too(run) -> None:
    text = (
        "l = []; for (i = 0; i < 100; i++) l.append(i); f = function() { while (1) for (x in #l) { } }; f();"
    )
    assert run(text, limits=Limits(max_steps=20_000)).error[0] == "E601"


def test_a_loop_over_a_list_may_render(run) -> None:
    outcome = run("S = scene(); for (r in [1, 2, 3]) { S.Add(sphere(vec3(0), r)); S.Render(); }")
    assert [len(frame.shapes) for frame in outcome.frames] == [1, 2, 3]


def test_functions_in_lists_may_render(run) -> None:
    outcome = run(
        "S = scene(); l = [function() { #S.Render(); return 5; }]; print(l[0]()); for (f in l) print(f());"
    )
    assert len(outcome.frames) == 2 and outcome.output == ["5", "5"]
