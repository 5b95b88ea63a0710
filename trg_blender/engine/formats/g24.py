"""Images of the CGSG group: `.gsm` (grey), `.g24` (BGR), `.g32` (BGRA).

Layout: u16 width, u16 height, then the pixels without row padding, top row first. Which of the three it
is follows from the file's length, not from its name. A few files were written bottom row first; the
format cannot say so, hence the `rows_bottom_up` option.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from .byte_reader import ByteReader
from .model import Pixels
from .pixels import RGB_FROM_BGR, check_pixels, swap_red_blue

HEAD_BYTES = 4
MAX_SIDE = 0xFFFF


def read_g24(path: str | Path, rows_bottom_up: bool = False) -> Pixels:
    """Pixels uint8 (h, w, c) of a .gsm, .g24 or .g32 file: grey, RGB or RGBA, row 0 is the bottom row.

    `rows_bottom_up`: the file stores its bottom row first. Raises FormatError, OSError.
    """
    return parse_g24(Path(path).read_bytes(), str(path), rows_bottom_up)


def write_g24(path: str | Path, pixels: Pixels) -> None:
    """Writes pixels (h, w, c), row 0 the bottom row, as grey, BGR or BGRA, top row first."""
    Path(path).write_bytes(pack_g24(pixels))


def parse_g24(data: bytes, file: str, rows_bottom_up: bool = False) -> Pixels:
    """As read_g24, from the file's bytes; `file` names it in a FormatError."""
    reader = ByteReader(data, file)
    width, height = (int(value) for value in reader.read_struct("HH", "header"))
    if not width or not height:
        raise reader.fail(f"a size of at least 1 x 1, found {width} x {height}", 0)
    channels = _channels_by_length(reader, width * height)
    raw = reader.read_pixels(width * height * channels, "pixels").reshape(height, width, channels)
    return swap_red_blue(raw if rows_bottom_up else raw[::-1])


def _channels_by_length(reader: ByteReader, area: int) -> int:
    for channels in RGB_FROM_BGR:
        if reader.remaining() == channels * area:
            return channels
    lengths = ", ".join(str(HEAD_BYTES + channels * area) for channels in RGB_FROM_BGR)
    raise reader.fail(f"a file of {lengths} bytes (1, 3, 4 a pixel), it has {len(reader.data)}")


def pack_g24(pixels: Pixels) -> bytes:
    """The file's bytes; ValueError for pixels that the format cannot hold."""
    check_pixels(pixels)
    height, width, _ = pixels.shape
    if max(width, height) > MAX_SIDE:
        raise ValueError(f"a side of at most {MAX_SIDE} pixels is needed, got {width} x {height}")
    return struct.pack("<HH", width, height) + np.ascontiguousarray(swap_red_blue(pixels)[::-1]).tobytes()
