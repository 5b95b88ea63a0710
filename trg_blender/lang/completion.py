"""What can be written at a place of a program: built-ins, variables, methods, fields, keywords."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from . import ast
from .analysis import Analysis
from .bind import HOST
from .resolve import TYPE_NAMES, FunctionInfo
from .scan import Token
from .source import Span
from .words import KEYWORD_DOCS, SPECIAL_DOCS, TYPE_DOCS, signature_text

SuggestionKind = Literal["function", "method", "constant", "variable", "field", "keyword", "space", "type"]
_VECTOR_FIELDS = ("x", "y", "z")
_INSIDE = ("string", "comment")


@dataclass(frozen=True, slots=True)
class Suggestion:
    """`label` is what is written; `detail` one line on its type, `doc` one on its meaning."""

    label: str
    kind: SuggestionKind
    detail: str = ""
    doc: str = ""


def complete(analysis: Analysis, line: int, col: int) -> list[Suggestion]:
    """What fits at a place, whatever part of the word stands there already; unsorted, no name twice."""
    before = _tokens_before(analysis, line, col)
    if before is None:
        return []
    context = analysis.function_at(line, col)
    last = before[-1].text if before else ""
    if last == ".":
        found = _members(analysis, before[:-1], context)
    elif last == "::":
        found = _in_space(analysis, before)
    elif last == "#":
        found = [*_builtins(), *_variables(analysis, None)]
    elif last == "~":
        found = [Suggestion(f'"{name}"', "type", "", TYPE_DOCS.get(name, "")) for name in TYPE_NAMES]
    else:
        found = [*_variables(analysis, context), *_builtins(), *_keywords()]
    return list({s.label: s for s in reversed(found)}.values())[::-1]


def _tokens_before(analysis: Analysis, line: int, col: int) -> list[Token] | None:
    """The tokens in front of the word at a place; None inside of a string, number or comment."""
    place = (line, col)
    kept = [t for t in analysis.tokens if t.kind != "end" and (t.span.end_line, t.span.end_col) <= place]
    around = [
        t for t in analysis.tokens if (t.span.line, t.span.col) < place < (t.span.end_line, t.span.end_col)
    ]
    if any(t.kind == "string" for t in around) or _in_comment(analysis, line, col):
        return None
    if kept and (kept[-1].span.end_line, kept[-1].span.end_col) == place:
        if kept[-1].kind in ("name", "keyword"):
            kept.pop()
        elif kept[-1].kind in ("number", "string"):
            return None
    return kept


def _in_comment(analysis: Analysis, line: int, col: int) -> bool:
    """Whether a comment opens between the last token in front of a place and the place."""
    source = analysis.sources[analysis.main]
    start = (1, 1)
    for token in analysis.tokens:
        if token.kind != "end" and (token.span.end_line, token.span.end_col) <= (line, col):
            start = (token.span.end_line, token.span.end_col)
    lines = list(source.lines[start[0] - 1 : line])
    if not lines:
        return False
    lines[-1] = lines[-1][: col - 1]
    lines[0] = lines[0][start[1] - 1 :]
    text = "\n".join(lines)
    while True:
        opening = min((at for at in (text.find("//"), text.find("/*")) if at >= 0), default=-1)
        if opening < 0:
            return False
        closing = "\n" if text.startswith("//", opening) else "*/"
        end = text.find(closing, opening + 2)
        if end < 0:
            return True
        text = text[end + len(closing) :]


def _members(analysis: Analysis, before: list[Token], context: FunctionInfo | None) -> list[Suggestion]:
    """Methods and fields of what stands before the dot; all of them when its type is not known."""
    name, kind = receiver(analysis, before, context)
    if kind == "vec3":
        return [Suggestion(n, "field", "num", f"The component {n}.") for n in _VECTOR_FIELDS]
    rows = [(owner, row) for (owner, _), row in HOST.methods.items() if not kind or owner == kind]
    found = [
        Suggestion(row.name.rpartition(".")[2], "method", signature_text(row), row.doc) for _, row in rows
    ]
    if kind in ("", "object", "function"):
        own = _fields_of(analysis, name)
        fields = own or (analysis.fields() if not kind else {})
        found = [*(Suggestion(n, "field") for n in fields), *found]
    return found


def _fields_of(analysis: Analysis, name: str) -> dict[str, Span]:
    """The fields that are assigned to the variable of that name."""
    targets = [n.target for n in analysis.expressions() if isinstance(n, ast.Assign)]
    return {
        t.name: t.span
        for t in targets
        if isinstance(t, ast.Field) and isinstance(t.object, ast.Path) and t.object.name == name
    }


def receiver(analysis: Analysis, before: list[Token], context: FunctionInfo | None) -> tuple[str, str]:
    """The variable that `before` ends with, and the type of the value there; empty when not known."""
    if not before:
        return "", ""
    index = len(before) - 1
    if before[index].text == ")":
        return "", _kind_of_call(analysis, before, context)
    if before[index].kind != "name":
        return "", ""
    name = _path_back(before, index)
    start = index - 2 * name.count("::")
    if start and before[start - 1].text == ".":
        return "", ""
    outside = start > 0 and before[start - 1].text == "#"
    return name, analysis.kind_of_variable(name, None if outside else context)


def _path_back(tokens: list[Token], index: int) -> str:
    """The `a::b` that ends at a token."""
    name = tokens[index].text
    while index >= 2 and tokens[index - 1].text == "::" and tokens[index - 2].kind == "name":
        index -= 2
        name = f"{tokens[index].text}::{name}"
    return name


def _kind_of_call(analysis: Analysis, before: list[Token], context: FunctionInfo | None) -> str:
    """The type of the call that ends with the `)` in front."""
    depth, index = 0, len(before) - 1
    while index >= 0:
        depth += (before[index].text == ")") - (before[index].text == "(")
        if depth == 0:
            break
        index -= 1
    if index < 1 or before[index - 1].kind != "name":
        return ""
    name = _path_back(before, index - 1)
    start = index - 1 - 2 * name.count("::")
    if start and before[start - 1].text == ".":
        owner = receiver(analysis, before[: start - 1], context)[1]
        row = HOST.methods.get((owner, name))
    else:
        row = HOST.functions.get(name)
    return "" if row is None or row.result in ("any", "undef") else row.result


def _in_space(analysis: Analysis, before: list[Token]) -> list[Suggestion]:
    """The names of the space in front of the last `::`, without it."""
    space = _path_back(before, len(before) - 2) + "::" if len(before) > 1 else ""
    found = [*_builtins(whole=True), *_variables(analysis, None)]
    return [
        Suggestion(s.label.removeprefix(space), s.kind, s.detail, s.doc)
        for s in found
        if s.label.startswith(space)
    ]


def _builtins(whole: bool = False) -> list[Suggestion]:
    """Built-ins: with `whole` those of spaces too, else the names of the spaces."""
    rows = HOST.functions.values()
    found = [Suggestion(r.name, "function", signature_text(r), r.doc) for r in rows]
    found += [Suggestion(c.name, "constant", f"{c.value:g}", c.doc) for c in HOST.constants.values()]
    if whole:
        return found
    spaces = sorted({s.label.partition("::")[0] for s in found if "::" in s.label})
    return [s for s in found if "::" not in s.label] + [Suggestion(n, "space") for n in spaces]


def _variables(analysis: Analysis, context: FunctionInfo | None) -> list[Suggestion]:
    """The variables of a function; at the top level and behind `#` the globals."""
    names: Iterable[str] = analysis.resolution.globals if context is None else context.locals
    found = []
    for name in names:
        value = analysis.value_of(name, context)
        if isinstance(value, ast.Function):
            found.append(Suggestion(name, "function", function_text(name, value)))
        else:
            found.append(Suggestion(name, "variable", analysis.kind_of_variable(name, context)))
    return found


def _keywords() -> list[Suggestion]:
    return [Suggestion(n, "keyword", "", doc) for n, doc in (KEYWORD_DOCS | SPECIAL_DOCS).items()]


def function_text(name: str, node: ast.Function) -> str:
    """`name(a ~ "num", b = ...)`: a function of the program in one line."""
    parts = []
    for parameter in node.parameters:
        text = parameter.name + (" = ..." if parameter.default is not None else "")
        parts.append(text if parameter.type_name is None else f'{text} ~ "{parameter.type_name}"')
    return f"{name}({', '.join(parts)})"
