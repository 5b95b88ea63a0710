"""The evaluator beside a plain tree walker, on programs that hypothesis makes up."""

from __future__ import annotations

import sys
from pathlib import Path

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from trg_blender.lang import HostOptions, Limits, ProgramError, Session, compile_source

sys.path.insert(0, str(Path(__file__).resolve().parent))
from oracle import Oracle, OutOfSteps  # noqa: E402
from oracle_values import Refusal  # noqa: E402

NAMES = ("a", "b", "c", "i")
HEAD = (
    'if (0) { a = 0; b = 0; c = 0; i = 0; o = object(); o.x = 0; }\n'
    "f = function(p, q) { r = p; if (p < q) { r = r + 1; } "
    "while (r < 3) { r++; if (q) break; } return r - q; };\n"
    "g = function(p) { #a = p; if (!p) return; return #f(p, 1); };\n"
    "v = vec3(1, 2, 3); l = [1, [2, v], \"x\"]; w = object(); w.n = 1;\n"
    "w.operator+ = function(p, q) { print(p, q); return #v; };\n"
    "w.operator- = function(p, q) { return p; };\n"
    "w.operator== = function(p, q) { #w.n++; return q; };\n"
    "w.operator< = function(p, q) { return #w.n - 2; };\n"
    "w.operator! = function(p) { return p.n; };\n"
    "w.operator* = 3;\n"
)  # fmt: skip
_ATOMS = st.sampled_from(
    (
        *NAMES,
        "0",
        "1",
        "2",
        "3",
        "0.5",
        "1e300",
        '""',
        '"x"',
        '"2"',
        "o.x",
        "o.y",
        "f",
        "(-1)",
        "v",
        "l",
        "w",
        "l[0]",
        "l[1]",
        "v.x",
        "w.n",
        "[]",
        "[a, 1]",
        "l[1][0]",
    )
)


def _grow(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    two = st.tuples(inner, st.sampled_from("+ - * / % == != < > <= >= && ||".split()), inner)
    name = st.sampled_from((*NAMES, "o.x", "l[0]", "l[1]", "v", "w.n", "l[a]"))
    return st.one_of(
        two.map(lambda t: f"({t[0]} {t[1]} {t[2]})"),
        two.map(lambda t: f"{t[0]} {t[1]} {t[2]}"),
        st.tuples(st.sampled_from("-!+"), inner).map(lambda t: f"{t[0]} ({t[1]})"),
        st.tuples(name, st.sampled_from("= += -= *=".split()), inner).map(
            lambda t: f"({t[0]} {t[1]} {t[2]})"
        ),
        st.tuples(name, st.sampled_from(("++", "--"))).map("".join),
        st.tuples(st.sampled_from(("++", "--")), name).map("".join),
        st.tuples(inner, inner).map(lambda t: f"f({t[0]}, {t[1]})"),
        inner.map(lambda t: f"g({t})"),
        inner.map(lambda t: f"vec3({t})"),
        inner.map(lambda t: f"len({t})"),
        inner.map(lambda t: f"l[{t}]"),
        inner.map(lambda t: f"l.append({t})"),
        st.just("l.pop()"),
        st.tuples(inner, inner).map(lambda t: f"[{t[0]}, {t[1]}]"),
        st.tuples(inner, inner).map(lambda t: f"vec3({t[0]}, {t[1]}, 2)"),
        st.tuples(st.sampled_from(("v", "w", "w")), st.sampled_from("+ - * / == != < !=".split()), inner).map(
            lambda t: f"({t[0]} {t[1]} {t[2]})"
        ),
    )


EXPRESSIONS = st.recursive(_ATOMS, _grow, max_leaves=8)
_SIMPLE = st.one_of(
    EXPRESSIONS.map(lambda e: f"print({e});"),
    st.tuples(st.sampled_from((*NAMES, "o.x", "o.y", "l[0]", "l[i]", "v", "w.n")), EXPRESSIONS).map(
        lambda t: f"{t[0]} = {t[1]};"
    ),
    EXPRESSIONS.map(lambda e: e + ";"),
)
_INSIDE = st.one_of(_SIMPLE, st.sampled_from(("break;", "continue;")))


def _block(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.lists(inner, max_size=4).map(lambda s: "{ " + " ".join(s) + " }")


def _compound(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    body = _block(st.one_of(inner, _INSIDE))
    cases = st.lists(st.tuples(_ATOMS, st.lists(_INSIDE, max_size=3)), max_size=3)
    return st.one_of(
        body.map(lambda b: f"for (i = 0; i < 4; i++) {b}"),
        st.tuples(EXPRESSIONS, body).map(lambda t: f"for (i = 0; i < 3 && {t[0]}; ++i) {t[1]}"),
        st.tuples(st.sampled_from(("l", "l", "[1, v, w]", "l[1]", "a")), body).map(
            lambda t: f"for (i in {t[0]}) {t[1]}"
        ),
        st.tuples(EXPRESSIONS, _block(inner), _block(inner)).map(lambda t: f"if ({t[0]}) {t[1]} else {t[2]}"),
        st.tuples(EXPRESSIONS, cases).map(
            lambda t: "for (c = 0; c < 2; c++) switch (" + t[0] + ") { "
            + " ".join(f"case {v}: {' '.join(s)}" for v, s in t[1]) + " default: print(c); }"
        ),
    )  # fmt: skip


PROGRAMS = st.lists(st.recursive(_SIMPLE, _compound, max_leaves=10), min_size=1, max_size=8).map(
    lambda s: HEAD + "\n".join(s) + "\nprint(a, b, c, i, v, l, w.n);"
)


@settings(max_examples=300, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(PROGRAMS)
def test_the_evaluator_does_what_the_plain_walker_does(text) -> None:
    try:
        session = Session(compile_source(text, "main.trg"), HostOptions(limits=Limits(max_steps=200_000)))
    except ProgramError as error:
        raise AssertionError([d.message for d in error.diagnostics]) from error
    oracle = Oracle(text)
    refused = ""
    try:
        oracle.run()
    except Refusal as refusal:
        refused = refusal.code
    except OutOfSteps:
        assume(False)
    session.next_frame()
    errors = [d.code for d in session.diagnostics if d.severity == "error"]
    limits = Limits()
    assert session.output[: limits.output_lines_frame] == oracle.output[: limits.output_lines_frame]
    assert bool(errors) is bool(refused), (errors, refused)
    if errors:
        assert errors[0].startswith(refused), (errors, refused)
