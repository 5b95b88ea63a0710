"""The reference of the language and its library, made from the tables that the language itself uses.

Built-ins come from the host table, words and operators from `words`, the parts written in TRG from the
heads of the files under `stl/`, errors from the table of messages.
"""

from __future__ import annotations

import re
from pathlib import Path

from .bind import HOST
from .exports import TYPES as EXPORT_TYPES
from .files import bundled_library
from .messages import MESSAGES
from .parse_expr import OVERLOADS
from .reference_text import CodeBlock, Heading, Paragraph, Part, Table, to_html, to_markdown
from .resolve import TYPE_NAMES
from .source import SourceFile
from .words import (
    KEYWORD_DOCS,
    OPERATOR_DOCS,
    PREFIX_DOCS,
    SPECIAL_DOCS,
    TYPE_DOCS,
    keyword_names,
    levels,
    names_in,
    signature_text,
    spaces,
)

TITLE = "TRG reference"
_INTRODUCTION = (
    "Every word, operator, built-in and library file of TRG. `trg doc` makes this text from the tables "
    "that the language itself uses; the rules of the language stand in docs/language.md."
)
_NOTATION = (
    "How a built-in is read: `name: type` is a parameter, `|` parts the types that it takes, `?` makes it "
    "optional, `= 2` gives its default, `> 0` and `1..100` its range, `...` means any number of arguments. "
    "`any` is every type but undef, `anything` undef too, `colour` a vec3 that is not negative. Behind "
    "`->` stands the type of the result."
)
_SEVERITIES = {"E": "error", "W": "warning", "L": "hint"}
_SPACE_TITLES = {
    "": "Built-in functions",
    "material": "material:: - the material library",
    "mth": "mth:: - mathematics",
    "std": "std:: - render modes, clock, random seed, limits",
}


def reference_parts() -> list[Part]:
    """The whole reference in order."""
    parts: list[Part] = [Heading(1, TITLE), Paragraph(_INTRODUCTION)]
    parts += [*_words(), *_operators(), *_types(), *_builtins(), *_methods(), *_library(), *_errors()]
    return parts


def reference_markdown() -> str:
    return to_markdown(reference_parts())


def reference_html() -> str:
    return to_html(reference_parts(), TITLE)


def _words() -> list[Part]:
    rows = [(name, KEYWORD_DOCS[name]) for name in keyword_names()]
    types = ", ".join(f"`{name}`" for name in EXPORT_TYPES)
    special = [(name, doc) for name, doc in SPECIAL_DOCS.items()]
    return [
        Heading(2, "Keywords"),
        Table(("keyword", "meaning"), tuple(rows)),
        Paragraph("These words are ordinary names except at the beginning of a statement:"),
        Table(("word", "meaning"), tuple(special)),
        Paragraph(
            f"The types of an exported parameter are {types}; a num may "
            'have a `range(low, high, step)`, a str a `choice("a", "b")`.'
        ),
    ]


def _operators() -> list[Part]:
    rows = [
        (operator, str(number), OPERATOR_DOCS[operator])
        for number, level in enumerate(levels(), start=2)
        for operator in level
    ]
    overloads = " ".join(f"`{name}`" for name in sorted(OVERLOADS))
    return [
        Heading(2, "Operators"),
        Paragraph(
            "Level 1 binds closest. Level 1 are the operators in front of or behind one value; the last "
            "level, right to left, are `=` `+=` `-=` `*=` `/=` `%=`, which assign and have a value."
        ),
        Table(("operator", "meaning with one value"), tuple(PREFIX_DOCS.items())),
        Table(("operator", "level", "meaning between two values"), tuple(rows)),
        Paragraph(f"An object may define {overloads} by a field such as `v.operator+`."),
    ]


def _types() -> list[Part]:
    rows = tuple((name, TYPE_DOCS.get(name, "")) for name in TYPE_NAMES)
    return [
        Heading(2, "Types"),
        Paragraph("The names that `typeof` gives and that stand behind `~` in a parameter list."),
        Table(("type", "meaning"), rows),
    ]


def _builtins() -> list[Part]:
    parts: list[Part] = []
    for space in ("", *spaces()):
        parts.append(Heading(2, _SPACE_TITLES.get(space, f"{space}::")))
        if not space:
            parts.append(Paragraph(_NOTATION))
        names = [f"{space}::{name}" if space else name for name in names_in(space)]
        parts.append(Table(("call", "meaning"), tuple(_row_of(name) for name in names)))
    return parts


def _row_of(name: str) -> tuple[str, str]:
    if name in HOST.constants:
        return f"{name} = {HOST.constants[name].value!r}", HOST.constants[name].doc
    row = HOST.functions[name]
    return signature_text(row), row.doc


def _methods() -> list[Part]:
    parts: list[Part] = []
    for owner in dict.fromkeys(owner for owner, _ in HOST.methods):
        rows = tuple(
            (signature_text(row), row.doc) for (kind, _), row in HOST.methods.items() if kind == owner
        )
        parts += [Heading(2, f"Methods of {owner}"), Table(("call", "meaning"), rows)]
    return parts


def _library() -> list[Part]:
    root = bundled_library()
    files = [] if root is None else sorted((root / "stl").rglob("*.trg"))
    parts: list[Part] = [
        Heading(2, "Library files"),
        Paragraph("The part of the library that is written in TRG; `include` makes it known."),
    ]
    for path in files:
        parts.append(Heading(3, path.relative_to(root or path).as_posix()))
        parts += _head_parts(path)
    return parts


def _head_parts(path: Path) -> list[Part]:
    """What the head of a library file says: sentences as paragraphs, indented lines as they are."""
    parts: list[Part] = []
    example = False
    for block in _blocks(head_lines(path)):
        parts.append(_block_part(block, example))
        example = block == ["Use:"]
    return parts


def _blocks(lines: list[str]) -> list[list[str]]:
    """Lines in a row that are indented, empty ones among them too, or in a row that are not."""
    blocks: list[list[str]] = [[]]
    for line in lines:
        last = blocks[-1]
        inside = bool(last) and last[0].startswith("  ")
        if last and (not line or line.startswith("  ") if inside else line and not line.startswith("  ")):
            last.append(line)
        else:
            blocks.append([line] if line else [])
    return [block for block in blocks if block]


def _block_part(block: list[str], example: bool) -> Part:
    text = "\n".join(block).rstrip()
    if not block[0].startswith("  "):
        return Paragraph(" ".join(block))
    margin = min(len(line) - len(line.lstrip()) for line in block if line)
    lines = [line[margin:] for line in text.split("\n")]
    return CodeBlock("\n".join(lines), "c" if example else "text")


def head_lines(path: Path) -> list[str]:
    """The lines of the comment that a file opens with, without its stars; empty when it has none."""
    source = SourceFile.from_text(path.name, path.read_text(encoding="utf-8"))
    text = source.text.lstrip()
    if not text.startswith("/*") or "*/" not in text:
        return []
    lines = text[2 : text.index("*/")].split("\n")
    bare = [line.rstrip() for line in lines]
    starred = [
        line.lstrip()[1:].removeprefix(" ") if line.lstrip().startswith("*") else line for line in bare
    ]
    kept = [line.removeprefix("   ") if not line.startswith("    ") else line for line in starred]
    return "\n".join(kept).strip("\n").split("\n")


def _shown(text: str) -> str:
    """A text of the table with plain names for what is filled in."""
    return re.sub(r"\{(\w+)[^}]*\}", r"{\1}", text).replace("{{", "{").replace("}}", "}")


def _errors() -> list[Part]:
    rows = tuple((code, _SEVERITIES[code[0]], _shown(english)) for code, (english, _) in MESSAGES.items())
    return [
        Heading(2, "Diagnostics"),
        Paragraph("Codes are stable, texts are not. Names in braces are filled in."),
        Table(("code", "severity", "message"), rows),
    ]
