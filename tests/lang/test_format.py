"""The formatter: one layout, the same program, every comment."""

from __future__ import annotations

import dataclasses
import os
from pathlib import Path

import pytest
from hypothesis import given, settings

from trg_blender.lang import ProgramError, SourceFile
from trg_blender.lang.ast import FileTree
from trg_blender.lang.diagnostics import DiagnosticBag
from trg_blender.lang.format import format_source
from trg_blender.lang.format_pieces import read_pieces
from trg_blender.lang.parse import parse_source

from .program_texts import PROGRAM_TEXTS

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("TRG_SHARED", ROOT.parent / "shared"))
OWN = [*(ROOT / "examples").rglob("*.trg"), *(ROOT / "stl").rglob("*.trg")]
CASES = [*(ROOT / "tests/lang/cases").rglob("*.trg"), *(SHARED / "data/conformance").rglob("*.trg")]


def tree_of(text: str) -> FileTree:
    """The tree of a text; AssertionError when it does not parse."""
    bag = DiagnosticBag()
    tree = parse_source(SourceFile.from_text("x.trg", text), bag)
    assert not bag.items, (bag.items, text)
    return tree


def without_spans(node: object) -> object:
    """A tree as nested tuples of what it means."""
    if isinstance(node, tuple | list):
        return tuple(without_spans(item) for item in node)
    if dataclasses.is_dataclass(node):
        kept = [f for f in dataclasses.fields(node) if "span" not in f.name and f.name != "includes"]
        return (type(node).__name__, *(without_spans(getattr(node, f.name)) for f in kept))
    return node


def comments_of(text: str) -> list[tuple[str, ...]]:
    pieces = read_pieces(SourceFile.from_text("x.trg", text))
    return [comment.content for piece in pieces for comment in piece.comments]


def check_facts(text: str) -> None:
    """Same tree, same comments, no change at the second time, no space at the end of a line."""
    made = format_source(text, "x.trg")
    assert without_spans(tree_of(made)) == without_spans(tree_of(text))
    assert comments_of(made) == comments_of(text)
    assert format_source(made, "x.trg") == made
    assert all(line == line.rstrip() for line in made.split("\n"))
    assert made == "" or (made.endswith("\n") and not made.endswith("\n\n"))


@settings(deadline=None, max_examples=600)
@given(PROGRAM_TEXTS)
def test_any_program_keeps_its_tree_and_comments(text: str):
    check_facts(text)


@pytest.mark.parametrize("path", [*OWN, *CASES], ids=lambda p: f"{p.parent.name}/{p.name}")
def test_a_program_of_the_project_keeps_its_tree_and_comments(path: Path):
    text = path.read_bytes().decode("utf-8")
    bag = DiagnosticBag()
    parse_source(SourceFile.from_text("x.trg", text), bag)
    if bag.error_count:
        with pytest.raises(ProgramError):
            format_source(text, "x.trg")
    else:
        check_facts(text)


AS_THE_PAPER = ("paper.trg", "fence.trg")
"""The paper's program, and the one made from it, keep the paper's own spacing."""


@pytest.mark.parametrize(
    "path", [path for path in OWN if path.name not in AS_THE_PAPER], ids=lambda p: f"{p.parent.name}/{p.name}"
)
def test_examples_and_library_are_in_the_standard_layout(path: Path):
    text = path.read_text(encoding="utf-8")
    assert format_source(text, path.name) == text, f"run: trg fmt {path.relative_to(ROOT)}"


EXTENSIONS = {
    "lists": ("l=[1,[2 , 3],[ ]] ;l [ 0 ]=l[1] [0];", "l = [1, [2, 3], []];\nl[0] = l[1][0];\n"),
    "for in": ("for(x  in [1,2])f(x);", "for (x in [1, 2]) f(x);\n"),
    "exported parameters": (
        'export  r=3~"num"~range( 0,10 );',
        'export r = 3 ~ "num" ~ range(0, 10);\n',
    ),
}


@pytest.mark.parametrize("name", EXTENSIONS)
def test_what_goes_beyond_the_paper(name: str):
    given_text, wanted = EXTENSIONS[name]
    assert format_source(given_text, "x.trg") == wanted
    check_facts(given_text)


LAYOUTS = {
    "operators stand apart and signs do not": ("a=-b+ - -c*( d ) ;", "a = -b + - -c * (d);\n"),
    "steps keep to their variable": ("a ++;--  b;c=a++ + ++b;", "a++;\n--b;\nc = a++ + ++b;\n"),
    "calls and paths are tight": ("# my :: f ( 1 ,x . y );", "#my::f(1, x.y);\n"),
    "a number before a dot keeps its space": ("a = 1 .x;", "a = 1 .x;\n"),
    "an operator field": (
        "v . operator += function(a,b){return a;};",
        "v.operator+ = function(a, b) { return a; };\n",
    ),
    "parameters with defaults and types": (
        'f=function( s=15~"num",a=#vec3(0)){return s;};',
        'f = function(s = 15 ~ "num", a = #vec3(0)) { return s; };\n',
    ),
    "braces on lines of their own": (
        "if(a){b=1;c=2;}else{d=3;\n}",
        "if (a)\n{\n    b = 1;\n    c = 2;\n}\nelse\n{\n    d = 3;\n}\n",
    ),
    "a statement stays on the line of its head": ("if(a)b=1;else c=2;", "if (a) b = 1; else c = 2;\n"),
    "or below it": ("for(;;)\n i++;", "for (;;)\n    i++;\n"),
    "else if is one chain": (
        "if(a)\n b;\nelse\nif(c)\n d;",
        "if (a)\n    b;\nelse if (c)\n    d;\n",
    ),
    "a switch": (
        "switch(a){case 1:b=1;break;default:\nc=2;}",
        "switch (a)\n{\n    case 1: b = 1; break;\n    default:\n        c = 2;\n}\n",
    ),
    "breaks inside parentheses are kept": (
        "f(a,\n b(c,\n d),\n e\n);",
        "f(a,\n    b(c,\n        d),\n    e\n);\n",
    ),
    "one empty line at most": ("a;\n\n\n\nb;\n{\n\nc;\n\n}\n", "a;\n\nb;\n{\n    c;\n}\n"),
    "trailing and own comments": (
        "a = 1; // one\n   // two\n\n\n/* three */ b = f(1 /* x */, 2);",
        "a = 1;  // one\n// two\n\n/* three */ b = f(1 /* x */, 2);\n",
    ),
    "the lines of a comment move together": (
        "{\n/* a\n   b */\nx;\ny;\n}",
        "{\n    /* a\n       b */\n    x;\n    y;\n}\n",
    ),
    "comments before a brace belong inside": ("{\na;\nb;\n// last\n}", "{\n    a;\n    b;\n    // last\n}\n"),
    "a body among arguments": (
        "f(function(a){\nb=1;\nreturn b;},2);",
        "f(function(a)\n{\n    b = 1;\n    return b;\n}, 2);\n",
    ),
    "an empty text": ("", ""),
    "an empty statement behind a block": ("if (a) { };", "if (a) {};\n"),
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_layout(name: str):
    given_text, wanted = LAYOUTS[name]
    assert format_source(given_text, "x.trg") == wanted
    check_facts(given_text)


def test_a_faulty_program_is_refused_with_its_errors():
    with pytest.raises(ProgramError) as caught:
        format_source("a = ;\nb = 1", "x.trg")
    assert [d.span.line for d in caught.value.diagnostics] == [1, 2]


def test_a_byte_order_mark_and_windows_lines_become_plain():
    assert format_source("\ufeffa=1;\r\n\r\nb;\r\n", "x.trg") == "a = 1;\n\nb;\n"
