"""`.g3dm` and `.g3d`: real samples to the byte, round trips, and what a damaged file is answered with."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from trg_blender.engine.formats import FormatError, read_g3dm, read_model, write_g3dm
from trg_blender.engine.formats.g3d import pack_g3d, parse_g3d
from trg_blender.engine.formats.g3dm import pack_g3dm, parse_g3dm

from .samples import assert_equal_models, assert_valid, shared_model, small_model

DATA = pack_g3dm(small_model())
PRIMITIVE = 12 + 4 * 48 + 6 * 4
MATERIALS = 16 + 2 * PRIMITIVE
TEXTURES = MATERIALS + 680


def patched(offset: int, layout: str, *values: float) -> bytes:
    data = bytearray(DATA)
    struct.pack_into("<" + layout, data, offset, *values)
    return bytes(data)


def test_the_cow_has_the_counts_of_the_paper_and_stands_on_y_0():
    model = read_g3dm(shared_model("cow.g3dm"))
    (cow,) = model.primitives
    assert (len(cow.vertices), len(cow.triangles), cow.material) == (3100, 5804, -1)
    assert (model.materials, model.textures) == ((), ())
    assert cow.vertices[:, 1].min() == pytest.approx(-0.11, abs=0.005)
    assert cow.vertices[:, 1].max() == pytest.approx(13.22, abs=0.005)
    assert_valid(model)


def test_the_cows_normals_agree_with_the_winding_but_for_three_triangles():
    (cow,) = read_g3dm(shared_model("cow.g3dm")).primitives
    a, b, c = (cow.vertices[cow.triangles[:, k]].astype(float) for k in range(3))
    stored = cow.normals[cow.triangles].astype(float).sum(axis=1)
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), stored) > 0).sum() == 5801


def test_the_bear_has_six_primitives_six_materials_and_a_64_x_64_texture_with_alpha():
    model = read_g3dm(shared_model("bear.g3dm"))
    assert (len(model.primitives), len(model.materials), len(model.textures)) == (6, 6, 1)
    assert model.textures[0].pixels.shape == (64, 64, 4)
    assert_valid(model)


def test_cgsg_has_three_primitives_of_one_material():
    model = read_g3dm(shared_model("CGSG.G3DM"))
    assert (len(model.primitives), len(model.materials)) == (3, 1)
    assert {primitive.material for primitive in model.primitives} == {0}
    assert_valid(model)


@pytest.mark.parametrize("name", ["cow.g3dm", "bear.g3dm", "CGSG.G3DM"])
def test_a_real_model_written_and_read_again_is_the_same(name: str):
    path = shared_model(name)
    model = read_model(path)
    packed = pack_g3dm(model)
    assert len(packed) == path.stat().st_size
    assert_equal_models(parse_g3dm(packed, name), model)


def test_a_small_model_survives_the_round_trip(tmp_path: Path):
    write_g3dm(tmp_path / "small.G3DM", small_model())
    assert_equal_models(read_model(tmp_path / "small.G3DM"), small_model())


def test_texture_rows_are_bottom_up_and_blue_comes_first_in_the_file():
    start = TEXTURES + 312
    assert DATA[start : start + 4] == bytes([2, 1, 0, 3])


def test_g3d_keeps_geometry_material_names_and_the_library():
    model = parse_g3d(pack_g3d(small_model()), "small.g3d")
    assert [material.name for material in model.materials] == ["gold"]
    assert [primitive.material for primitive in model.primitives] == [0, -1]
    assert np.array_equal(model.primitives[0].vertices, small_model().primitives[0].vertices)


DAMAGES = {
    "another signature": (patched(0, "4s", b"G3DX"), 0, "signature"),
    "huge number of primitives": (patched(4, "I", 0xFFFFFFFF), 16, "primitives"),
    "huge number of materials": (patched(8, "I", 0xFFFFFFFF), 16, "materials"),
    "huge number of textures": (patched(12, "I", 0xFFFFFFFF), 16, "textures"),
    "huge number of vertices": (patched(16, "I", 0xFFFFFFFF), 28, "vertices"),
    "huge number of indices": (patched(20, "I", 0xFFFFFFFF), 28, "indices"),
    "a part of a triangle": (patched(20, "I", 5), 28, "multiple of 3"),
    "NaN position": (patched(28 + 48, "f", float("nan")), 28 + 48, "finite position of vertex 1"),
    "infinite position": (patched(28 + 8, "f", float("inf")), 28, "finite position of vertex 0"),
    "index past the vertices": (patched(28 + 192 + 8, "i", 4), 28 + 192 + 8, "index below 4"),
    "negative index": (patched(28 + 192, "i", -1), 28 + 192, "index below 4"),
    "NaN in a material": (patched(MATERIALS + 336, "f", float("nan")), MATERIALS + 336, "finite numbers"),
    "two bytes a pixel": (patched(TEXTURES + 308, "I", 2), TEXTURES + 308, "1, 3 or 4"),
    "texture without width": (patched(TEXTURES + 300, "I", 0), TEXTURES + 300, "at least 1 x 1"),
    "texture past the end": (patched(TEXTURES + 300, "II", 65536, 65536), TEXTURES + 312, "pixels"),
    "trailing bytes": (DATA + b"\0", len(DATA), "the end of the file"),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_model_names_file_offset_and_expectation(damage: str):
    data, offset, expected = DAMAGES[damage]
    with pytest.raises(FormatError) as caught:
        parse_g3dm(data, "bad.g3dm")
    assert (caught.value.file, caught.value.offset) == ("bad.g3dm", offset)
    assert expected in caught.value.expected
    assert str(caught.value).startswith(f"bad.g3dm: at byte {offset}: expected ")


@pytest.mark.parametrize("number", [1, 7, -2, 2**31 - 1])
def test_a_material_number_out_of_range_is_none(number: int):
    assert parse_g3dm(patched(24, "i", number), "x").primitives[0].material == -1


def test_a_texture_number_out_of_range_is_none():
    assert parse_g3dm(patched(MATERIALS + 344, "i", 2), "x").materials[0].textures[0] == -1


@pytest.mark.parametrize("normal", [(0, 0, 0), (float("nan"), 0, 1), (0, float("inf"), 0)])
def test_a_bad_normal_becomes_the_face_normal_with_a_warning(normal: tuple[float, float, float]):
    model = parse_g3dm(patched(28 + 20, "3f", *normal), "x")
    assert model.primitives[0].normals[0].tolist() == [0, 0, 1]
    assert model.warnings == ("primitive 0: 1 zero or non-finite normals replaced by face normals",)


def test_a_non_finite_texture_coordinate_becomes_0_with_a_warning():
    model = parse_g3dm(patched(28 + 48 + 12, "f", float("nan")), "x")
    assert model.primitives[0].uvs[1].tolist() == [0, 0]
    assert len(model.warnings) == 1


def test_an_unknown_suffix_is_a_format_error():
    with pytest.raises(FormatError, match=r"ends with one of \.g3d, "):
        read_model("cow.blend")
