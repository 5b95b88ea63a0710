"""The lint for names that look the same and are not: letters of other scripts with one shape."""

from __future__ import annotations

from collections.abc import Iterable

from .diagnostics import DiagnosticBag, Notice
from .source import Span

_SHAPES = str.maketrans(
    "асеорхуіјѕһԁԛԝАВЕКМНОРСТХУІЈЅ" + "ονΑΒΕΖΗΙΚΜΝΟΡΤΥΧ",
    "aceopxyijshdqwABEKMHOPCTXYIJS" + "ovABEZHIKMNOPTYX",
)
"""Cyrillic, then Greek letters, and the Latin ones that look like them."""


def shape_of(name: str) -> str:
    """The name as it looks: with Latin letters where others have the same shape."""
    return name if name.isascii() else name.translate(_SHAPES)


def lint_look_alikes(names: Iterable[tuple[str, Span]], builtins: Iterable[str], bag: DiagnosticBag) -> None:
    """A lint at each name that looks like an earlier one, or like a built-in, and differs from it."""
    firsts: dict[str, tuple[str, Span | None]] = {shape_of(b): (b, None) for b in builtins}
    told: set[str] = set()
    for name, span in names:
        first, place = firsts.setdefault(shape_of(name), (name, span))
        if first == name or name in told:
            continue
        told.add(name)
        related = ((place, "other_name"),) if place is not None else ()
        bag.add(Notice("L804", span, {"name": name}, "write_again", {"other": first}, related), "lint")
