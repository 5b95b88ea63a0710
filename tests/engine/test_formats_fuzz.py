"""Damage of every kind: a reader gives a valid model or a FormatError, within bounded memory."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest

from trg_blender.engine.formats import FormatError, Model
from trg_blender.engine.formats.g3d import pack_g3d, parse_g3d
from trg_blender.engine.formats.g3dm import pack_g3dm, parse_g3dm
from trg_blender.engine.formats.g24 import pack_g24, parse_g24
from trg_blender.engine.formats.obj import parse_obj

from .samples import assert_valid, small_model

OBJ = b"# square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 1\nvn 0 0 1\nusemtl gold\nf 1/1/1 2//1 -1/1 1\nf 1 2 3\n"
IMAGE = pack_g24(np.arange(24, dtype=np.uint8).reshape(2, 3, 4))
MEMORY_LIMIT = 4 << 20


def parse_image(data: bytes, file: str) -> Model:
    pixels = parse_g24(data, file)
    assert pixels.ndim == 3 and pixels.nbytes == len(data) - 4
    return Model(())


FORMATS: dict[str, tuple[Callable[[bytes, str], Model], bytes]] = {
    "g3dm": (parse_g3dm, pack_g3dm(small_model())),
    "g3d": (parse_g3d, pack_g3d(small_model())),
    "g24": (parse_image, IMAGE),
    "obj": (parse_obj, OBJ),
}


def outcome(parse: Callable[[bytes, str], Model], data: bytes) -> str:
    """'valid' or 'refused'; anything else is the test's failure."""
    try:
        assert_valid(parse(data, "fuzz"))
    except FormatError as error:
        assert 0 <= error.offset <= len(data)
        return "refused"
    return "valid"


@pytest.mark.parametrize("name", ["g3dm", "g3d"])
def test_a_model_file_cut_anywhere_is_refused(name: str):
    parse, data = FORMATS[name]
    assert {outcome(parse, data[:length]) for length in range(len(data))} == {"refused"}


def test_an_image_cut_anywhere_is_refused_but_where_it_is_as_long_as_one_of_another_kind():
    valid = [length for length in range(len(IMAGE)) if outcome(parse_image, IMAGE[:length]) == "valid"]
    assert valid == [4 + 6, 4 + 3 * 6]


def test_an_obj_cut_anywhere_is_refused_or_a_smaller_model():
    assert {outcome(parse_obj, OBJ[:length]) for length in range(len(OBJ))} == {"refused", "valid"}


@pytest.mark.parametrize("name", FORMATS)
def test_random_byte_flips_never_get_through_unchecked(name: str):
    parse, data = FORMATS[name]
    rng = np.random.default_rng(20190101)
    seen = set()
    tracemalloc.start()
    for _ in range(1500):
        damaged = bytearray(data)
        for position in rng.integers(len(data), size=rng.integers(1, 6)):
            damaged[position] = rng.choice([0, 255, rng.integers(256)])
        seen.add(outcome(parse, bytes(damaged)))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert seen == {"refused", "valid"}
    assert peak < MEMORY_LIMIT


@pytest.mark.parametrize("name", ["g3dm", "g3d", "g24"])
def test_all_ones_at_any_word_stay_within_memory(name: str):
    parse, data = FORMATS[name]
    tracemalloc.start()
    for offset in range(0, len(data) - 3):
        outcome(parse, data[:offset] + b"\xff\xff\xff\xff" + data[offset + 4 :])
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < MEMORY_LIMIT


@pytest.mark.parametrize("name", FORMATS)
def test_noise_is_refused(name: str):
    parse, _ = FORMATS[name]
    rng = np.random.default_rng(7)
    assert {outcome(parse, rng.bytes(int(rng.integers(0, 400)))) for _ in range(200)} == {"refused"}
