"""Lists: values that change, shared by reference, with a bound on the elements of all of them.

An index is a whole number from 0 to the length - 1. Python's lists stay inside: translated code
reaches elements by `[]` alone, which Python hands to the two methods here, and methods by the host table.
"""

from __future__ import annotations

import gc
from typing import TYPE_CHECKING

from .values import TrgError, Value, format_number, format_value, type_name

if TYPE_CHECKING:
    from .runtime import Runtime

POINTER = 8
"""Bytes that an element takes in its list."""
_SHOWN_ELEMENTS = 100
_SHOWN_DEPTH = 4


class List(Value):
    """A list. Its elements count towards the total of the program while it lives."""

    __slots__ = ("items", "rt")
    kind = "list"

    def __init__(self, rt: Runtime, items: list[object]) -> None:
        self.items: list[object] = []
        self.rt = rt
        count_elements(rt, len(items))
        self.items = items

    def __del__(self) -> None:
        self.rt.live_elements -= len(self.items)

    def __getitem__(self, index: object) -> object:
        items = self.items
        if type(index) is float and 0.0 <= index < len(items):
            place = int(index)
            if place == index:
                return items[place]
        raise index_error(index, len(items))

    def __setitem__(self, index: object, value: object) -> None:
        items = self.items
        if type(index) is float and 0.0 <= index < len(items):
            place = int(index)
            if place == index:
                items[place] = value
                return
        raise index_error(index, len(items), "append")

    def shown(self) -> str:
        return _Shown().text_of(self, 0)


def count_elements(rt: Runtime, count: int) -> None:
    """Count new elements. Raises TrgError above the limit; lists that hold each other are freed first."""
    limit = rt.limits.max_elements
    if rt.live_elements + count > limit:
        gc.collect()
        rt.check_time()
        if rt.live_elements + count > limit:
            raise TrgError("E612", "raise_other", option="max_elements", limit=limit)
    rt.live_elements += count
    rt.work_on_text(POINTER * count)


def index_error(index: object, count: int, hint: str | None = None) -> TrgError:
    """Why `index` is no place in a list of `count` elements; `hint` is for the place behind the last."""
    if type(index) is not float:
        return TrgError("E443", operand=1, kind=type_name(index))
    if index != index or index < 0.0 or index != index // 1.0:
        advice = "from_the_end" if index < 0.0 else "round_index"
        return TrgError("E441", advice, operand=1, value=format_number(index))
    return TrgError(
        "E442", hint if index == count else None, operand=1, index=format_number(index), count=count
    )


class _Shown:
    """Puts lists into words; a list that holds itself, or very much, ends in dots."""

    def __init__(self) -> None:
        self._left = _SHOWN_ELEMENTS

    def text_of(self, value: object, depth: int) -> str:
        if type(value) is not List:
            return format_value(value, 1)
        if depth == _SHOWN_DEPTH:
            return "[...]"
        parts: list[str] = []
        for element in value.items:
            if self._left == 0:
                parts.append("...")
                break
            self._left -= 1
            parts.append(self.text_of(element, depth + 1))
        return f"[{', '.join(parts)}]"
