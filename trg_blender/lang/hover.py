"""What a word of a program means, in a few lines of Markdown, and where it is defined."""

from __future__ import annotations

from . import ast
from .analysis import Analysis, Word
from .bind import HOST
from .completion import function_text, receiver
from .exports import doc_comment
from .resolve import FunctionInfo
from .source import Span
from .words import KEYWORD_DOCS, SPECIAL_DOCS, TYPE_DOCS, signature_text


def describe(analysis: Analysis, line: int, col: int) -> tuple[str, Span] | None:
    """The description of the word at a place as Markdown, and the word's span; None where there is none."""
    word = analysis.word_at(line, col)
    if word is None:
        return None
    context = analysis.function_at(line, col)
    text = (
        _member_text(analysis, word, context) if word.before == "." else _name_text(analysis, word, context)
    )
    return None if text is None else (text, word.span)


def define(analysis: Analysis, line: int, col: int) -> Span | None:
    """Where the name at a place is first assigned; the start of the file for an include's name."""
    word = analysis.word_at(line, col)
    if word is not None:
        return analysis.definition(word, analysis.function_at(line, col))
    for tree in analysis.trees:
        for node in tree.statements:
            if isinstance(node, ast.Include) and tree.name == analysis.main and _on(node.span, line, col):
                file = tree.includes.get(node.span)
                return None if file is None else Span(file, 1, 1, 1, 1)
    return None


def _on(span: Span, line: int, col: int) -> bool:
    return (span.line, span.col) <= (line, col) <= (span.end_line, span.end_col)


def _member_text(analysis: Analysis, word: Word, context: FunctionInfo | None) -> str | None:
    """A method of the type before the dot, or every method of that name when the type is not known."""
    kind = receiver(analysis, list(analysis.tokens[: word.index - 1]), context)[1]
    rows = [row for (owner, name), row in HOST.methods.items() if name == word.name and kind in ("", owner)]
    if rows:
        return "\n\n".join(_code(signature_text(row), row.doc) for row in rows)
    if word.name in analysis.fields():
        return _code(f".{word.name}", "A field.")
    return None


def _name_text(analysis: Analysis, word: Word, context: FunctionInfo | None) -> str | None:
    name = word.name
    own = context is not None and word.before != "#" and name in context.locals
    if not own and name in HOST.functions:
        row = HOST.functions[name]
        return _code(signature_text(row), row.doc)
    if not own and name in HOST.constants:
        constant = HOST.constants[name]
        return _code(f"{name} = {constant.value!r}", constant.doc)
    if own or name in analysis.resolution.globals:
        return _variable_text(analysis, name, context if own else None)
    return (KEYWORD_DOCS | SPECIAL_DOCS).get(name)


def _variable_text(analysis: Analysis, name: str, context: FunctionInfo | None) -> str:
    value = analysis.value_of(name, context)
    parameter = context is not None and any(p.name == name for p in context.node.parameters)
    what = "parameter" if parameter else ("global variable" if context is None else "local variable")
    comment = "" if context is not None else _comment_of(analysis, name)
    if isinstance(value, ast.Function):
        return _code(function_text(name, value), comment or f"A function in a {what}.")
    kind = analysis.kind_of_variable(name, context)
    meaning = f"A {what}: {TYPE_DOCS[kind]}." if kind in TYPE_DOCS else f"A {what}."
    return _code(f"{name}: {kind}" if kind else name, comment or meaning)


def _comment_of(analysis: Analysis, name: str) -> str:
    """The comment above the first assignment to a global, or behind it."""
    place = analysis.resolution.globals.get(name)
    if place is None or place.file not in analysis.sources:
        return ""
    return doc_comment(analysis.sources[place.file], place)


def _code(signature: str, doc: str) -> str:
    return f"```trg\n{signature}\n```\n{doc}".rstrip()
