"""A cursor over a file's bytes that checks every length before anything is allocated."""

from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray

from .errors import FormatError


class ByteReader:
    """Reads little-endian fields in order; raises FormatError instead of running past the end."""

    def __init__(self, data: bytes, file: str) -> None:
        self.data = data
        self.file = file
        self.offset = 0

    def remaining(self) -> int:
        return len(self.data) - self.offset

    def fail(self, expected: str, offset: int | None = None) -> FormatError:
        """The error to raise; `offset` defaults to the cursor."""
        return FormatError(self.file, self.offset if offset is None else offset, expected)

    def require(self, size: int, what: str) -> None:
        """Raises FormatError unless `size` more bytes are there."""
        if size > self.remaining():
            raise self.fail(f"{size} bytes of {what}, {self.remaining()} left")

    def read_bytes(self, size: int, what: str) -> bytes:
        self.require(size, what)
        start = self.offset
        self.offset += size
        return self.data[start : self.offset]

    def read_struct(self, layout: str, what: str) -> tuple[int | float, ...]:
        """Fields of a `struct` layout without byte-order mark."""
        return struct.unpack("<" + layout, self.read_bytes(struct.calcsize("<" + layout), what))

    def read_u32s(self, count: int, what: str) -> tuple[int, ...]:
        return tuple(int(value) for value in self.read_struct(f"{count}I", what))

    def read_floats(self, count: int, what: str) -> NDArray[np.float32]:
        """A fresh float32 array (count,)."""
        self.require(4 * count, what)
        values = np.frombuffer(self.data, dtype="<f4", count=count, offset=self.offset)
        self.offset += 4 * count
        return values.astype(np.float32)

    def read_int32s(self, count: int, what: str) -> NDArray[np.int32]:
        """A fresh int32 array (count,)."""
        self.require(4 * count, what)
        values = np.frombuffer(self.data, dtype="<i4", count=count, offset=self.offset)
        self.offset += 4 * count
        return values.astype(np.int32)

    def read_pixels(self, size: int, what: str) -> NDArray[np.uint8]:
        """A fresh uint8 array (size,)."""
        self.require(size, what)
        values = np.frombuffer(self.data, dtype=np.uint8, count=size, offset=self.offset)
        self.offset += size
        return values.copy()

    def read_name(self, size: int, what: str) -> str:
        """A NUL-padded string field of `size` bytes: UTF-8, else the authors' Windows-1251."""
        raw = self.read_bytes(size, what).split(b"\0", 1)[0]
        try:
            return raw.decode("utf-8")
        except UnicodeDecodeError:
            return raw.decode("cp1251", errors="replace")

    def expect_end(self) -> None:
        """Raises FormatError when bytes are left over."""
        if self.remaining():
            raise self.fail(f"the end of the file, {self.remaining()} more bytes follow")


def pack_name(text: str, size: int) -> bytes:
    """`text` in UTF-8, NUL-padded to `size` bytes; ValueError when it does not fit or holds a NUL."""
    raw = text.encode("utf-8")
    if len(raw) >= size or b"\0" in raw:
        raise ValueError(f"a name of at most {size - 1} bytes without NUL is needed, got {text!r}")
    return raw.ljust(size, b"\0")
