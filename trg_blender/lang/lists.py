"""Lists: values that change, shared by reference, with a bound on the elements of all of them.

An index is a whole number from 0 to the length - 1. Python's lists stay inside: translated code
reaches elements by `[]` alone, which Python hands to the two methods here, and methods by the host table.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from itertools import repeat
from types import GeneratorType
from typing import TYPE_CHECKING

from .values import TrgError, Value, format_number, format_value, type_name

if TYPE_CHECKING:
    from .runtime import Runtime

POINTER = 8
"""Bytes that an element takes in its list."""
_IN_ADVANCE = 8
"""Appending counts one part in so many of a list in advance."""
_NO_ROOM: Iterator[None] = repeat(None, 0)
_SHOWN_ELEMENTS = 100
_SHOWN_DEPTH = 4


class List(Value):
    """A list. Its elements count towards the total of the program while it lives.

    `counted` of them are: its length, and as many more as `room` may still be taken from.
    """

    __slots__ = ("counted", "items", "room", "rt")
    kind = "list"

    def __init__(self, rt: Runtime, items: list[object]) -> None:
        self.counted = 0
        self.rt = rt
        count_elements(rt, len(items))
        self.counted = len(items)
        self.items = items
        self.room: Iterator[None] = _NO_ROOM

    def __del__(self) -> None:
        self.rt.live_elements -= self.counted

    def append(self, _depth: object, value: object) -> List:
        """The method of programs: a step of `room` for each element, which is the quickest count."""
        if type(value) is GeneratorType:
            raise TrgError("E415")
        for _ in self.room:
            self.items.append(value)
            return self
        self.reserve()
        self.items.append(value)
        return self

    def reserve(self) -> None:
        """Count one element more, and where there are many some in advance. Raises TrgError."""
        rt, count = self.rt, len(self.items)
        self.uncount(self.counted - count)
        room = count // _IN_ADVANCE if rt.counts_in_advance else 0
        if rt.live_elements + 1 + room > rt.limits.max_elements:
            room = 0
        count_elements(rt, 1 + room)
        self.counted = count + 1 + room
        self.room = repeat(None, room)

    def uncount(self, count: int) -> None:
        """Count so many elements less."""
        self.counted -= count
        self.rt.live_elements -= count

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
    """Count new elements. Raises TrgError above the limit.

    Before that, lists that hold each other are freed, and nothing is counted in advance any more.
    """
    limit = rt.limits.max_elements
    if rt.live_elements + count > limit:
        gc.collect()
        rt.check_time()
        if rt.counts_in_advance:
            _give_up_room(rt)
        if rt.live_elements + count > limit:
            raise TrgError("E612", "raise_other", option="max_elements", limit=limit)
    rt.live_elements += count
    rt.work_on_text(POINTER * count)


def _give_up_room(rt: Runtime) -> None:
    """Count from now on what is, no more: once a run, for it looks at everything that lives."""
    rt.counts_in_advance = False
    for one in gc.get_objects():
        if type(one) is List and one.rt is rt and one.counted:
            one.uncount(one.counted - len(one.items))
            one.room = _NO_ROOM


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
