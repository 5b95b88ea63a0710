"""Writes tools/editors/syntaxes/trg.tmLanguage.json: the words come from the language's own tables.

python tools/make_grammar.py          (re)writes the grammar
python tools/make_grammar.py --check  exit code 1 when the committed one is not the generated one
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from trg_blender.lang import HOST  # noqa: E402
from trg_blender.lang.resolve import TYPE_NAMES  # noqa: E402
from trg_blender.lang.scan import ESCAPES  # noqa: E402
from trg_blender.lang.words import SPECIAL_DOCS, keyword_names, names_in, spaces  # noqa: E402

TARGET = ROOT / "tools/editors/syntaxes/trg.tmLanguage.json"
_STORAGE = ("function", "operator")
_WORD_END = r"(?![\p{L}\p{N}_])"
_WORD_START = r"(?<![\p{L}\p{N}_])"
_NAME = r"[\p{L}_][\p{L}\p{N}_]*"


def words(names: list[str]) -> str:
    """An expression that matches these whole words."""
    return f"{_WORD_START}(?:{'|'.join(names)}){_WORD_END}"


def rule(name: str, match: str) -> dict[str, object]:
    return {"name": f"{name}.trg", "match": match}


def build_grammar() -> dict[str, object]:
    """The grammar of the whole language."""
    sections = ("comments", "strings", "numbers", "keywords", "library", "members", "functions", "operators")
    return {
        "$schema": "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
        "name": "TRG",
        "scopeName": "source.trg",
        "fileTypes": ["trg"],
        "patterns": [{"include": f"#{section}"} for section in sections],
        "repository": {
            "comments": {"patterns": comments()},
            "strings": {"patterns": strings()},
            "numbers": {"patterns": [rule("constant.numeric", _number())]},
            "keywords": {"patterns": keywords()},
            "library": {"patterns": library()},
            "members": {"patterns": members()},
            "functions": {
                "patterns": [rule("entity.name.function", rf"{_NAME}(?=\s*=\s*function{_WORD_END})")]
            },
            "operators": {"patterns": operators()},
        },
    }


def comments() -> list[dict[str, object]]:
    return [
        rule("comment.line.double-slash", r"//.*$"),
        {"name": "comment.block.trg", "begin": r"/\*", "end": r"\*/"},
    ]


def strings() -> list[dict[str, object]]:
    escapes = "".join("\\\\" if key == "\\" else key for key in ESCAPES)
    inside = [rule("constant.character.escape", rf"\\[{escapes}]"), rule("invalid.illegal.escape", r"\\.")]
    types = rf'(~)\s*("(?:{"|".join(TYPE_NAMES)})")'
    return [
        {
            "match": types,
            "captures": {
                "1": {"name": "keyword.operator.type.trg"},
                "2": {"name": "storage.type.annotation.trg"},
            },
        },
        {"name": "string.quoted.double.trg", "begin": '"', "end": r'"|$', "patterns": inside},
    ]


def _number() -> str:
    return rf"{_WORD_START}(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?{_WORD_END}"


def keywords() -> list[dict[str, object]]:
    control = [name for name in keyword_names() if name not in _STORAGE]
    special = rf"{_WORD_START}(?:{'|'.join(SPECIAL_DOCS)})(?=\s*\(|\s+{_NAME})"
    return [
        rule("keyword.control", words(control)),
        rule("storage.type.function", words(list(_STORAGE))),
        rule("keyword.control.import", special),
    ]


def library() -> list[dict[str, object]]:
    """Built-ins: those of a space with their space, then the plain ones, not behind a dot."""
    made = [
        rule("support.function", rf"{_WORD_START}{space}\s*::\s*(?:{'|'.join(names_in(space))}){_WORD_END}")
        for space in spaces()
    ]
    plain = words(names_in("")).replace(_WORD_START, r"(?<![\p{L}\p{N}_.:])", 1)
    made.append(rule("support.function", plain))
    made.append(rule("entity.name.namespace", rf"{_NAME}(?=\s*::)"))
    return made


def members() -> list[dict[str, object]]:
    methods = list(dict.fromkeys(name for _, name in HOST.methods))
    behind_dot = rf"(?<=\.)\s*(?:{'|'.join(methods)}){_WORD_END}(?=\s*\()"
    return [
        rule("support.function.method", behind_dot),
        rule("variable.other.member", rf"(?<=\.)\s*{_NAME}"),
        rule("variable.language", words(["self"])),
    ]


def functions() -> list[dict[str, object]]:
    return [rule("entity.name.function", rf"{_NAME}(?=\s*=\s*function{_WORD_END})")]


def operators() -> list[dict[str, object]]:
    return [
        rule("keyword.operator", r"\+\+|--|[-+*/%=!<>]=|&&|\|\||[-+*/%=!<>~]"),
        rule("punctuation.accessor", r"::|\.|#"),
        rule("punctuation.terminator", r";"),
    ]


def grammar_text() -> str:
    return json.dumps(build_grammar(), indent=2, ensure_ascii=False) + "\n"


def main() -> int:
    text = grammar_text()
    if "--check" in sys.argv[1:]:
        same = TARGET.is_file() and TARGET.read_text(encoding="utf-8") == text
        print(
            f"{TARGET.relative_to(ROOT)}: {'as generated' if same else 'differs; run tools/make_grammar.py'}"
        )
        return 0 if same else 1
    TARGET.write_text(text, encoding="utf-8", newline="\n")
    print(TARGET.relative_to(ROOT))
    return 0


if __name__ == "__main__":
    sys.exit(main())
