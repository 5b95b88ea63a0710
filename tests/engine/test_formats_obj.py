"""`.obj`: every form of face, names of materials, and what a damaged text is answered with."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from trg_blender.engine.formats import FormatError, read_model
from trg_blender.engine.formats.obj import parse_obj

from .samples import assert_valid

SQUARE = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"


@pytest.mark.parametrize(
    "face", ["1 2 3 4", "1/1 2/2 3/3 4/4", "1//1 2//1 3//1 4//1", "1/1/1 2/2/1 3/3/1 4/4/1", "-4 -3 -2 -1"]
)
def test_every_form_of_face_gives_the_same_square(face: str):
    model = parse_obj(SQUARE + f"f {face}\n".encode(), "x")
    (square,) = model.primitives
    assert square.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert square.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert (square.normals == [0, 0, 1]).all()
    assert square.uvs.tolist() == (
        [[0, 0], [1, 0], [1, 1], [0, 1]] if "/1 " in face[:4] or "/1/" in face else [[0, 0]] * 4
    )
    assert_valid(model)


def test_faces_without_vn_are_flat_and_share_no_vertices():
    (part,) = parse_obj(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n", "x").primitives
    assert len(part.vertices) == 6
    assert part.normals[3].tolist() == [1, 0, 0]


def test_usemtl_splits_by_name_in_order_of_first_use():
    text = (
        SQUARE
        + b"mtllib a b.mtl\nf 1 2 3\nusemtl red one\nf 1 3 4\nusemtl blue\nf 1 2 4\nusemtl red one\nf 2 3 4\n"
    )
    model = parse_obj(text, "x")
    assert [material.name for material in model.materials] == ["red one", "blue"]
    assert [(p.material, len(p.triangles)) for p in model.primitives] == [(-1, 1), (0, 2), (1, 1)]
    assert model.library == "a b.mtl"


def test_colours_w_comments_continuations_and_foreign_lines_are_taken_in_stride():
    text = b"# Rhino\r\nv 0 0 0 1 0 0 # red\r\nv 1 0 0 1\ns off\nv 0 1 \\\n0\no name\nl 1 2\nf 1 2 3"
    (part,) = parse_obj(text, "x").primitives
    assert part.vertices[2].tolist() == [0, 1, 0]
    assert part.colors[:2].tolist() == [[1, 0, 0, 1], [1, 1, 1, 1]]


def test_a_face_may_stand_before_its_vertices():
    assert len(parse_obj(b"f 1 2 3\n" + SQUARE, "x").primitives[0].triangles) == 1


def test_a_zero_normal_becomes_the_face_normal():
    model = parse_obj(SQUARE + b"vn 0 0 0\nvn nan 0 0\nf 1//2 2//3 3//1\n", "x")
    assert (model.primitives[0].normals == [0, 0, 1]).all()
    assert model.warnings == ("2 zero or non-finite normals replaced by face normals",)


def test_an_object_file_is_an_obj_file(tmp_path: Path):
    path = tmp_path / "cow.object"
    path.write_bytes(SQUARE + b"f 1 2 3\n")
    assert np.array_equal(read_model(path).primitives[0].triangles, [[0, 1, 2]])


END = len(SQUARE)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        (b"v 1 2", "3 numbers after v in line 10"),
        (b"v 1 2 x", "numbers after v"),
        (b"v 1_0 2 3", "numbers after v"),
        (b"v 1 nan 3", "finite numbers after v"),
        (b"v 1 1e39 3", "finite numbers after v"),
        (b"vt inf", "finite numbers after vt"),
        (b"vn 1 0", "3 numbers after vn"),
        (b"f 1 2", "at least 3 corners, found 2"),
        (b"f 1 2 0", "a v that is there, found number 0"),
        (b"f 1 2 -5", "a v that is there, found number -5"),
        (b"f 1 2 5", "a face whose v is there: number 5 of 4"),
        (b"f 1 2 3/5", "a face whose vt is there: number 5 of 4"),
        (b"f 1 2 3//2", "a face whose vn is there: number 2 of 1"),
        (b"f 1 2 99999999999999999999", "a v that is there"),
        (b"f 1 2 3/1/1/1", "a corner a, a/b"),
        (b"f 1 2 /1", "a corner a, a/b"),
        (b"f 1 2 1.5", "whole numbers"),
    ],
)
def test_a_damaged_line_is_named_with_its_offset(line: bytes, expected: str):
    with pytest.raises(FormatError) as caught:
        parse_obj(SQUARE + line + b"\nf 1 2 3\n", "bad.obj")
    assert caught.value.offset == END
    assert expected in caught.value.expected


def test_a_text_without_faces_is_no_model():
    with pytest.raises(FormatError, match="at least one face"):
        parse_obj(SQUARE, "x")
