"""Wavefront `.obj` (and the same text named `.object`): v, vt, vn, f in every form, usemtl as names.

Faces take `a`, `a/b`, `a//c`, `a/b/c`, negative numbers count back from the last element read, polygons
become fans of triangles. A corner without vn gets its face's normal (the group's own loaders shade from
faces). Material libraries are named, not read. All other statements are passed over. The group's
dialect, triangles of `v` and `f` only, is a subset.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np

from .errors import FormatError
from .model import Model, ModelMaterial, Primitive, mean_face_normals, repair_normals

INT32_MAX = 2**31 - 1
FLOAT32_MAX = float(np.finfo(np.float32).max)
KIND_NAMES = ("v", "vt", "vn")
ABSENT = -1
FACE_NORMAL = -2
"""and below: FACE_NORMAL minus the face's number, as the normal of corners without vn"""


@dataclass(slots=True)
class _ObjText:
    """What the statements of the file amount to, flat."""

    positions: array[float] = field(default_factory=lambda: array("d"))
    colors: array[float] = field(default_factory=lambda: array("d"))
    uvs: array[float] = field(default_factory=lambda: array("d"))
    normals: array[float] = field(default_factory=lambda: array("d"))
    corners: array[int] = field(default_factory=lambda: array("i"))
    """three a corner: v, vt, vn, 0-based or ABSENT; three corners a triangle"""
    face_offsets: array[int] = field(default_factory=lambda: array("q"))
    """where each face stands in the file"""
    triangle_faces: array[int] = field(default_factory=lambda: array("i"))
    triangle_materials: array[int] = field(default_factory=lambda: array("i"))
    materials: dict[str, int] = field(default_factory=dict)
    material: int = -1
    library: str = ""

    def count(self, kind: int) -> int:
        """Elements read so far of KIND_NAMES[kind]."""
        return (len(self.positions) // 3, len(self.uvs) // 2, len(self.normals) // 3)[kind]


@dataclass(frozen=True, slots=True)
class _Line:
    file: str
    number: int
    offset: int
    words: list[bytes]

    def fail(self, expected: str) -> FormatError:
        return FormatError(self.file, self.offset, f"{expected} in line {self.number}")


def read_obj(path: str | Path) -> Model:
    """The model in `path`. Raises FormatError for a damaged file, OSError for an unreadable one."""
    return parse_obj(Path(path).read_bytes(), str(path))


def parse_obj(data: bytes, file: str) -> Model:
    """The model in `data`, one primitive a used material in order of first use.

    Raises FormatError for numbers that are none or not finite, a reference to an element that is not
    there, a face of fewer than three corners, a file without any face.
    """
    text = _ObjText()
    for line in _split_lines(data, file):
        _read_statement(text, line)
    if not text.triangle_faces:
        raise FormatError(file, len(data), "at least one face (f)")
    corners = np.frombuffer(text.corners, dtype=np.int32).reshape(-1, 3, 3).copy()
    _check_references(text, corners, file)
    faces = np.frombuffer(text.triangle_faces, dtype=np.int32)
    corners[:, :, 2] = np.where(corners[:, :, 2] == ABSENT, FACE_NORMAL - faces[:, None], corners[:, :, 2])
    owners = np.frombuffer(text.triangle_materials, dtype=np.int32)
    groups = list(dict.fromkeys(owners.tolist()))
    built = [_build_primitive(text, corners[owners == owner], owner) for owner in groups]
    replaced = sum(count for _, count in built)
    notes = (f"{replaced} zero or non-finite normals replaced by face normals",) if replaced else ()
    materials = tuple(ModelMaterial(name) for name in text.materials)
    return Model(tuple(primitive for primitive, _ in built), materials, library=text.library, warnings=notes)


def _split_lines(data: bytes, file: str) -> Iterator[_Line]:
    """Statements as _Line, without comments and empty lines; a backslash at the end joins two lines."""
    offset = start = number = 0
    words: list[bytes] = []
    joined = False
    for number, raw in enumerate(data.splitlines(keepends=True), 1):
        body = raw.split(b"#", 1)[0].rstrip()
        start = start if joined else offset
        offset += len(raw)
        words += body.removesuffix(b"\\").split()
        joined = body.endswith(b"\\")
        if words and not joined:
            yield _Line(file, number, start, words)
            words = []
    if words:
        yield _Line(file, number, start, words)


def _read_statement(text: _ObjText, line: _Line) -> None:
    match line.words[0]:
        case b"v":
            _read_vertex(text, line)
        case b"vt":
            text.uvs.extend((*_read_numbers(line, 1, 3), 0.0)[:2])
        case b"vn":
            text.normals.extend(_read_numbers(line, 3, 3, finite=False))
        case b"f":
            _read_face(text, line)
        case b"usemtl":
            name = _decode(b" ".join(line.words[1:]))
            text.material = text.materials.setdefault(name, len(text.materials)) if name else -1
        case b"mtllib":
            text.library = text.library or _decode(b" ".join(line.words[1:]))


def _read_vertex(text: _ObjText, line: _Line) -> None:
    """x y z, x y z w (w is dropped, as every loader of meshes does) or x y z r g b."""
    numbers = _read_numbers(line, 3, 7)
    text.positions.extend(numbers[:3])
    text.colors.extend(numbers[-3:] if len(numbers) >= 6 else (1.0, 1.0, 1.0))


def _read_numbers(line: _Line, least: int, most: int, finite: bool = True) -> list[float]:
    """Between `least` and `most` numbers that fit float32; further words of the line are passed over."""
    words = line.words[1 : most + 1]
    if len(words) < least:
        raise line.fail(f"{least} numbers after {_decode(line.words[0])}")
    try:
        numbers = [float(_plain(word)) for word in words]
    except ValueError:
        raise line.fail(f"numbers after {_decode(line.words[0])}") from None
    if finite and not all(abs(number) <= FLOAT32_MAX for number in numbers):
        raise line.fail(f"finite numbers after {_decode(line.words[0])}")
    return numbers


def _plain(word: bytes) -> bytes:
    """`word` itself; ValueError for Python's digit groups, which .obj does not know."""
    if b"_" in word:
        raise ValueError(word)
    return word


def _decode(raw: bytes) -> str:
    return raw.decode("utf-8", errors="replace")


def _read_face(text: _ObjText, line: _Line) -> None:
    corners = [_read_corner(text, line, word) for word in line.words[1:]]
    if len(corners) < 3:
        raise line.fail(f"a face of at least 3 corners, found {len(corners)}")
    for second, third in pairwise(corners[1:]):
        text.corners.extend((*corners[0], *second, *third))
        text.triangle_faces.append(len(text.face_offsets))
        text.triangle_materials.append(text.material)
    text.face_offsets.append(line.offset)


def _read_corner(text: _ObjText, line: _Line, word: bytes) -> tuple[int, int, int]:
    """0-based references (v, vt, vn) of one corner; ABSENT where a part is missing."""
    parts = word.split(b"/")
    if len(parts) > 3 or not parts[0]:
        raise line.fail("a corner a, a/b, a//c or a/b/c")
    references = [ABSENT, ABSENT, ABSENT]
    for kind, part in enumerate(parts):
        if part:
            references[kind] = _read_reference(text, line, kind, part)
    return references[0], references[1], references[2]


def _read_reference(text: _ObjText, line: _Line, kind: int, part: bytes) -> int:
    try:
        number = int(_plain(part))
    except ValueError:
        raise line.fail("whole numbers in a face") from None
    index = number - 1 if number > 0 else text.count(kind) + number
    if number == 0 or index < 0 or number > INT32_MAX:
        raise line.fail(f"a {KIND_NAMES[kind]} that is there, found number {number}")
    return index


def _check_references(text: _ObjText, corners: np.ndarray, file: str) -> None:
    """Raises FormatError for a reference past the last element; faces may come before their vertices."""
    for kind, name in enumerate(KIND_NAMES):
        beyond = np.flatnonzero((corners[:, :, kind] >= text.count(kind)).any(axis=1))
        if beyond.size:
            number = int(corners[beyond[0], :, kind].max()) + 1
            expected = f"a face whose {name} is there: number {number} of {text.count(kind)}"
            raise FormatError(file, text.face_offsets[text.triangle_faces[int(beyond[0])]], expected)


def _build_primitive(text: _ObjText, corners: np.ndarray, material: int) -> tuple[Primitive, int]:
    """The indexed primitive of triangles (m, 3 corners, 3) and how many normals were replaced.

    Equal corners share a vertex, numbered in order of first use.
    """
    positions = np.frombuffer(text.positions, dtype=np.float64).astype(np.float32).reshape(-1, 3)
    keys = corners.reshape(-1, 3)
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    rank = np.empty(len(first), dtype=np.int32)
    rank[np.argsort(first)] = np.arange(len(first), dtype=np.int32)
    triangles = rank[inverse.reshape(-1)].reshape(-1, 3)
    used = np.sort(first)
    vertices = positions[keys[used, 0]]
    normals = mean_face_normals(vertices, triangles)
    stored = keys[used, 2] >= 0
    if stored.any():
        table = np.frombuffer(text.normals, dtype=np.float64).reshape(-1, 3)
        normals[stored] = np.clip(table[keys[used[stored], 2]], -FLOAT32_MAX, FLOAT32_MAX)
    mended, replaced = repair_normals(normals, vertices, triangles)
    uvs, colors = _pick_uvs(text, keys[used, 1]), _pick_colors(text, keys[used, 0])
    return Primitive(vertices, uvs, mended, colors, triangles, material), replaced


def _pick_uvs(text: _ObjText, references: np.ndarray) -> np.ndarray:
    uvs = np.zeros((len(references), 2), dtype=np.float32)
    given = references >= 0
    if given.any():
        uvs[given] = np.frombuffer(text.uvs, dtype=np.float64).reshape(-1, 2)[references[given]]
    return uvs


def _pick_colors(text: _ObjText, references: np.ndarray) -> np.ndarray:
    colors = np.ones((len(references), 4), dtype=np.float32)
    colors[:, :3] = np.frombuffer(text.colors, dtype=np.float64).reshape(-1, 3)[references]
    return colors
