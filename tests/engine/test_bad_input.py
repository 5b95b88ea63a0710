"""Files as they arrive from strangers, from the disk: one clear sentence each, nothing half-read."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable
from pathlib import Path

import pytest

from trg_blender.engine.formats import FormatError, read_g24, read_model
from trg_blender.engine.formats.g3d import pack_g3d
from trg_blender.engine.formats.g3dm import pack_g3dm

from .samples import ROOT, small_model

ELEPHANT = ROOT / "examples" / "models" / "elephant.g3dm"
CHESS = ROOT / "examples" / "chess.g24"
OBJ = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def refusal(path: Path, read: Callable[[Path], object] = read_model) -> FormatError:
    with pytest.raises(FormatError) as caught:
        read(path)
    return caught.value


def written(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("suffix", [".g3dm", ".g3d", ".obj", ".object"])
def test_an_empty_model_file_is_refused(tmp_path: Path, suffix: str):
    assert refusal(written(tmp_path / f"empty{suffix}", b"")).offset == 0


def test_the_message_is_one_sentence_with_file_offset_and_expectation(tmp_path: Path):
    path = written(tmp_path / "cut.g3dm", ELEPHANT.read_bytes()[:100_000])
    assert str(refusal(path)) == (
        f"{path}: at byte 28: expected 186432 bytes of 2604 vertices and 15360 indices in primitive 0,"
        " 99972 left"
    )


@pytest.mark.parametrize("share", [0.01, 0.25, 0.5, 0.75, 0.99])
def test_a_model_cut_on_its_way_is_refused_with_little_memory(tmp_path: Path, share: float):
    data = ELEPHANT.read_bytes()
    path = written(tmp_path / "cut.g3dm", data[: int(share * len(data))])
    tracemalloc.start()
    refusal(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 4 * len(data)


@pytest.mark.parametrize(
    ("name", "data", "expected"),
    [
        ("picture.g3dm", CHESS.read_bytes(), "the signature 'G3DM'"),
        ("older.g3dm", pack_g3d(small_model()), "the signature 'G3DM'"),
        ("newer.g3d", pack_g3dm(small_model()), "the signature 'G3D' and a zero byte"),
        ("text.g3dm", OBJ, "the signature 'G3DM'"),
        ("binary.obj", pack_g3dm(small_model()), "at least one face (f)"),
        ("scene.blend", b"BLENDER", "a model file whose name ends with one of .g3d, .g3dm, .obj, .object"),
    ],
)
def test_a_file_of_another_format_says_what_was_expected(
    tmp_path: Path, name: str, data: bytes, expected: str
):
    assert refusal(written(tmp_path / name, data)).expected.startswith(expected)


def test_a_model_is_no_image():
    assert "a file of" in refusal(ELEPHANT, read_g24).expected


def test_a_missing_model_is_an_error_of_the_system_not_of_the_format(tmp_path: Path):
    with pytest.raises(FileNotFoundError):
        read_model(tmp_path / "cow.g3dm")


def test_a_folder_named_like_a_model_is_an_error_of_the_system(tmp_path: Path):
    (tmp_path / "folder.obj").mkdir()
    with pytest.raises(OSError, match="folder"):
        read_model(tmp_path / "folder.obj")


def test_a_polygon_of_many_corners_takes_memory_in_proportion(tmp_path: Path):
    corners = b" ".join(b"%d" % (1 + k % 3) for k in range(50_000))
    path = written(tmp_path / "fan.obj", OBJ + b"f " + corners + b"\n")
    tracemalloc.start()
    model = read_model(path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert len(model.primitives[0].triangles) == 49_999
    assert peak < 200 * path.stat().st_size
