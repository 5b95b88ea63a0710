"""Static errors of a program that has errors of syntax too: what can be said in spite of them.

A statement with an error is missing from the tree, and with it the names that it assigns. What is
said of such a name may be wrong, so it is not said; a file that was not found may define any name.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping

from . import ast
from .bind import HOST
from .diagnostics import Diagnostic, DiagnosticBag
from .resolve import Resolution, resolve_program
from .scan import Token, scan_source
from .source import SourceFile

_NAME_ERRORS = frozenset(("E301", "E302", "E303"))
_FILE_ERRORS = frozenset(("E109", "E320", "E321", "E322", "E510", "E511", "E512"))


def resolve_despite_errors(
    trees: list[ast.FileTree], sources: Mapping[str, SourceFile], bag: DiagnosticBag
) -> Resolution:
    """The meaning of what was understood. Errors that do not hang on the rest go to `bag`."""
    own = DiagnosticBag(bag.language)
    resolution = resolve_program(trees, HOST.names, own)
    missing = any(d.code in _FILE_ERRORS for d in bag.items)
    faulty = {d.span.file for d in bag.items}
    unread: set[str] = set()
    for tree in trees:
        if tree.name in faulty:
            unread |= _names_not_in_tree(tree, sources[tree.name], resolution)
    for found in own.in_order():
        if found.code in _NAME_ERRORS and (missing or _name_at(found, sources) in unread):
            continue
        bag.take(found)
    return resolution


def _name_at(found: Diagnostic, sources: Mapping[str, SourceFile]) -> str:
    """The name that a diagnostic stands at."""
    span = found.span
    written = sources[span.file].lines[span.line - 1][span.col - 1 : span.end_col - 1]
    return unicodedata.normalize("NFC", "".join(written.removeprefix("#").split()))


def _names_not_in_tree(tree: ast.FileTree, source: SourceFile, resolution: Resolution) -> set[str]:
    """The variables that the text names where the tree has nothing."""
    in_tree = {(e.span.line, e.span.col) for e in resolution.top[tree.name] if isinstance(e, ast.Path)}
    for info in resolution.functions.values():
        if info.file == tree.name:
            in_tree |= {(e.span.line, e.span.col) for e in info.expressions if isinstance(e, ast.Path)}
            in_tree |= {(p.span.line, p.span.col) for p in info.node.parameters}
    tokens = scan_source(source, DiagnosticBag())
    names: set[str] = set()
    for index, token in enumerate(tokens):
        before = tokens[index - 1].text if index else ""
        if token.kind != "name" or before in (".", "::"):
            continue
        start = tokens[index - 1].span if before == "#" else token.span
        if (start.line, start.col) not in in_tree:
            names.add(_path_from(tokens, index))
    return names


def _path_from(tokens: list[Token], index: int) -> str:
    """`a::b` when the token is the first of such a path, else its own name."""
    parts = [tokens[index].text]
    while tokens[index + 1].text == "::" and tokens[index + 2].kind == "name":
        index += 2
        parts.append(tokens[index].text)
    return "::".join(parts)
