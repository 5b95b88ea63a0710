"""The grammar for editors is the generated one, and colours what the language reads."""

from __future__ import annotations

import importlib.util
import json
import re
from pathlib import Path
from types import ModuleType

import pytest

from trg_blender.lang import HOST
from trg_blender.lang.scan import ESCAPES, KEYWORDS

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tools/editors"


@pytest.fixture(scope="module")
def generator() -> ModuleType:
    spec = importlib.util.spec_from_file_location("make_grammar", ROOT / "tools/make_grammar.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def grammar() -> dict:
    return json.loads((FOLDER / "syntaxes/trg.tmLanguage.json").read_text(encoding="utf-8"))


def as_python(pattern: str) -> re.Pattern[str]:
    """An Oniguruma expression of the grammar for Python's `re`."""
    plain = pattern.replace(r"[\p{L}\p{N}_]", r"\w").replace(r"[\p{L}\p{N}_.:]", r"[\w.:]")
    return re.compile(plain.replace(r"[\p{L}_]", r"[^\W\d]"))


def rules() -> list[tuple[str, re.Pattern[str]]]:
    """(scope, expression) of every rule in order; a rule with an end by its beginning."""
    whole = grammar()
    found = []
    for pattern in whole["patterns"]:
        for one in whole["repository"][pattern["include"].removeprefix("#")]["patterns"]:
            found.append((one.get("name", "type"), as_python(one.get("match") or one["begin"])))
    return found


def scope_at(text: str, at: int) -> str:
    """The scope that an editor gives the text at an index: the first rule that matches there wins."""
    position, table = 0, rules()
    while position <= at:
        matches = [(m.start(), n, m.end()) for n, (_, rule) in enumerate(table)
                   if (m := rule.search(text, position)) and m.end() > m.start()]  # fmt: skip
        if not matches:
            return ""
        start, number, end = min(matches)
        if start <= at < end:
            return table[number][0]
        position = max(end, position + 1)
    return ""


def test_the_committed_grammar_is_the_generated_one(generator: ModuleType):
    committed = (FOLDER / "syntaxes/trg.tmLanguage.json").read_text(encoding="utf-8")
    assert committed == generator.grammar_text(), "run: python tools/make_grammar.py"


@pytest.mark.parametrize("word", sorted(KEYWORDS))
def test_a_keyword_is_coloured_as_one_and_a_longer_name_is_not(word: str):
    assert scope_at(f"{word} (", 0).startswith(("keyword.control", "storage.type"))
    assert not scope_at(f"{word}x = 1", 0).startswith(("keyword.control", "storage.type"))
    assert not scope_at(f"ж{word} = 1", 1).startswith(("keyword.control", "storage.type"))


def test_every_built_in_is_coloured_as_one():
    names = [*HOST.functions, *HOST.constants]
    assert [n for n in names if scope_at(f"{n}(1)", 0) != "support.function.trg"] == []
    methods = {name for _, name in HOST.methods}
    assert [m for m in methods if scope_at(f"x.{m}(1)", 2) != "support.function.method.trg"] == []


@pytest.mark.parametrize(
    ("text", "mark", "scope"),
    [
        ("a = 1; // if", "// if", "comment.line"),
        ("/* a", "/*", "comment.block"),
        ('a = "if";', '"if', "string.quoted"),
        ('f = function(a = 1 ~ "num")', '~ "num"', "type"),
        ("a = .5e3;", ".5e3", "constant.numeric"),
        ("x1 = 2;", "1", ""),
        ("Стройка = function() {};", "Стройка", "entity.name.function"),
        ("a.sphere = 1;", "sphere", "variable.other.member"),
        ("my::size = 1;", "my", "entity.name.namespace"),
        ('include("a.trg");', "include", "keyword.control.import"),
        ("export r = 3;", "export", "keyword.control.import"),
        ("a = include_me;", "include", ""),
        ("a += 1;", "+=", "keyword.operator"),
    ],
)
def test_scope(text: str, mark: str, scope: str):
    found = scope_at(text, text.index(mark))
    assert found.startswith(scope) if scope else found == ""


def test_the_escapes_are_those_of_the_scanner():
    string = next(p for p in grammar()["repository"]["strings"]["patterns"] if "begin" in p)
    right, wrong = (as_python(p["match"]) for p in string["patterns"])
    assert all(right.fullmatch("\\" + key) for key in ESCAPES)
    assert right.fullmatch("\\M") is None
    assert wrong.fullmatch("\\M") is not None


def test_the_package_description_names_files_that_exist():
    package = json.loads((FOLDER / "package.json").read_text(encoding="utf-8"))
    contributed = package["contributes"]
    named = [
        contributed["grammars"][0]["path"],
        contributed["languages"][0]["configuration"],
        package["main"],
    ]
    assert [path for path in named if not (FOLDER / path).is_file()] == []
    assert contributed["grammars"][0]["scopeName"] == grammar()["scopeName"]
    json.loads((FOLDER / "language-configuration.json").read_text(encoding="utf-8"))
