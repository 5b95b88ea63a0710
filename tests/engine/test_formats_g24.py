"""`.gsm`, `.g24`, `.g32`: the kind by length, the top row first, real samples to the byte."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from trg_blender.engine.formats import FormatError, read_g24, write_g24
from trg_blender.engine.formats.g24 import pack_g24, parse_g24

from .samples import shared_model


@pytest.mark.parametrize("channels", [1, 3, 4])
def test_pixels_survive_the_round_trip(tmp_path: Path, channels: int):
    pixels = np.arange(6 * channels, dtype=np.uint8).reshape(2, 3, channels)
    write_g24(tmp_path / "image.g24", pixels)
    assert np.array_equal(read_g24(tmp_path / "image.g24"), pixels)


def test_the_file_starts_with_the_top_row_in_bgr():
    pixels = np.array([[[1, 2, 3]], [[4, 5, 6]]], dtype=np.uint8)
    assert pack_g24(pixels) == struct.pack("<HH", 1, 2) + bytes([6, 5, 4, 3, 2, 1])


def test_a_file_with_its_bottom_row_first_can_be_flipped():
    pixels = np.array([[[1]], [[2]]], dtype=np.uint8)
    assert parse_g24(pack_g24(pixels), "x", rows_bottom_up=True).ravel().tolist() == [2, 1]


@pytest.mark.parametrize(
    ("name", "shape"),
    [("CGSG.g24", (256, 256, 3)), ("SMOKE.G32", (128, 128, 4)), ("glow.g32", (128, 128, 4))],
)
def test_a_real_image_is_read_to_the_byte(name: str, shape: tuple[int, int, int]):
    path = shared_model(name)
    pixels = read_g24(path)
    assert pixels.shape == shape
    assert pack_g24(pixels) == path.read_bytes()


def test_the_smoke_has_202_levels_of_alpha_and_the_glow_is_opaque():
    assert len(np.unique(read_g24(shared_model("SMOKE.G32"))[:, :, 3])) == 202
    assert np.unique(read_g24(shared_model("glow.g32"))[:, :, 3]).tolist() == [255]


@pytest.mark.parametrize(
    ("data", "offset", "expected"),
    [
        (b"", 0, "4 bytes of header"),
        (b"\1\0\1", 0, "4 bytes of header"),
        (struct.pack("<HH", 0, 5), 0, "at least 1 x 1"),
        (struct.pack("<HH", 65535, 65535) + b"abc", 4, "a file of 4294836229, "),
        (struct.pack("<HH", 2, 1) + bytes(5), 4, "a file of 6, 10, 12 bytes"),
        (struct.pack("<HH", 1, 1) + bytes(5), 4, "it has 9"),
    ],
)
def test_a_damaged_image_names_offset_and_expectation(data: bytes, offset: int, expected: str):
    with pytest.raises(FormatError) as caught:
        parse_g24(data, "bad.g24")
    assert caught.value.offset == offset
    assert expected in caught.value.expected


def test_pixels_of_another_type_are_refused():
    with pytest.raises(ValueError, match="uint8"):
        pack_g24(np.zeros((1, 1, 3), dtype=np.float32))
