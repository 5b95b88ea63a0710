"""Lists: `list(...)` and the methods of lists."""

from __future__ import annotations

from ..bind import HOST
from ..lists import POINTER, List, count_elements, index_error
from ..runtime import Runtime
from ..values import TrgError


@HOST.function("list", "...values: anything", "A list of the values given; [a, b] is the same.", "list")
def _list(rt: Runtime, *values: object) -> object:
    return List(rt, list(values))


@HOST.method(List, "append", "value: anything", "Add an element at the end.")
def _append(_rt: Runtime, target: List, value: object) -> object:
    return target.append(None, value)


HOST.direct(List, "append", List.append)


@HOST.method(
    List, "insert", "index: num, value: anything", "Add an element before the one at index, or at the end."
)
def _insert(rt: Runtime, target: List, index: float, value: object) -> object:
    items = target.items
    place = len(items) if index == len(items) else _place(items, index)
    count_elements(rt, 1)
    target.counted += 1
    rt.work_on_text(POINTER * (len(items) - place))
    items.insert(place, value)
    return target


@HOST.method(List, "remove", "index: num", "Take the element at index out and return it.", "any")
def _remove(rt: Runtime, target: List, index: float) -> object:
    items = target.items
    place = _place(items, index)
    rt.work_on_text(POINTER * (len(items) - place))
    target.uncount(1)
    return items.pop(place)


@HOST.method(List, "pop", "", "Take the last element out and return it.", "any")
def _pop(_rt: Runtime, target: List) -> object:
    if not target.items:
        raise TrgError("E445")
    target.uncount(1)
    return target.items.pop()


def _place(items: list[object], index: float) -> int:
    """`index` as a place of `items`. Raises TrgError at the argument when it is none."""
    if 0.0 <= index < len(items) and index == int(index):
        return int(index)
    raise index_error(index, len(items))
