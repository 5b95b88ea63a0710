"""The text of a long string: a buffer that all strings made by appending to it share.

`s = s + "x"` would copy the whole of `s`. What is appended is written behind the text in the same buffer
instead, as long as nothing else was written there. Every string knows its own length, so the shorter ones
read as they were. Bytes count once for each buffer, with the room that it reserves.
"""

from __future__ import annotations

import sys
from io import StringIO
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .runtime import Runtime

SHORT_TEXT = 64
"""Strings up to this length have no buffer: they count as memory blocks, as numbers do."""
_RESERVE = 8
"""A buffer that grows reserves one part in so many more than it needs."""


class TextBuffer:
    """A text that can grow at its end; its bytes count towards the live total while it lives.

    Making and growing one raise TrgError when the text is too long or all texts together are.
    Up to `room` characters, ASCII may be appended by `write` alone, `length` being kept up by hand.
    """

    __slots__ = ("_flat", "_size", "_stream", "_width", "length", "room", "rt", "write")

    def __init__(self, rt: Runtime, text: str) -> None:
        size = sys.getsizeof(text)
        self.rt = rt
        self.length = self.room = len(text)
        self._size = 0
        rt.hold_text(self.length, size)
        self._size = size
        self._width = _bytes_of_character(text)
        self._flat: str | None = text

    def __del__(self) -> None:
        self.rt.live_text -= self._size

    def append(self, piece: str) -> None:
        """Append any text and reserve room behind it."""
        length = self.length + len(piece)
        limit = self.rt.limits.max_string
        room = max(length, min(length + length // _RESERVE, limit))
        width = max(self._width, _bytes_of_character(piece))
        growth = room * width - self.room * self._width
        self.rt.hold_text(length, growth)
        self._size += growth
        self._width = width
        if self._flat is not None:
            self._stream = StringIO(newline="")
            self.write = self._stream.write
            self.write(self._flat)
            self._flat = None
        self.write(piece)
        self.length, self.room = length, room

    def text(self) -> str:
        """The whole text. The next append has to copy it."""
        if self._flat is None:
            self.rt.work_on_text(self.length * self._width)
            self._flat = self._stream.getvalue()
            self._stream.close()
            growth = (self.length - self.room) * self._width
            self.rt.live_text += growth
            self._size += growth
            self.room = self.length
        return self._flat


def _bytes_of_character(text: str) -> int:
    """How many bytes Python keeps for every character of a text."""
    if text.isascii():
        return 1
    highest = max(text)
    return 1 if highest < "\u0100" else 2 if highest < "\U00010000" else 4
