"""Small models and images that the format tests share."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from trg_blender.engine.formats import Model, ModelMaterial, ModelTexture, Primitive

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("TRG_SHARED", ROOT.parent / "shared"))


def shared_model(name: str) -> Path:
    """A real sample; skips the test where the samples are not to be had."""
    path = SHARED / "data" / "models" / name
    if not path.exists():
        pytest.skip(f"the real sample {name} is not beside the checkout (set TRG_SHARED)")
    return path


def small_primitive(material: int = -1) -> Primitive:
    """Two triangles of a square in z = 0."""
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float32)
    return Primitive(
        vertices=np.column_stack([corners, np.zeros(4)]).astype(np.float32),
        uvs=corners.copy(),
        normals=np.tile(np.array([0, 0, 1], dtype=np.float32), (4, 1)),
        colors=np.ones((4, 4), dtype=np.float32),
        triangles=np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32),
        material=material,
    )


def small_model() -> Model:
    """Two primitives, one material, a texture 3 x 2 with alpha and a grey one 2 x 1."""
    material = ModelMaterial(
        "gold",
        (0.25, 0.5, 0.125),
        (1.0, 0.5, 0.0),
        (0.5, 0.5, 0.5),
        51.0,
        1.0,
        (1, 0, -1, -1, -1, -1, -1, -1),
        "phong",
    )
    rgba = np.arange(24, dtype=np.uint8).reshape(2, 3, 4)
    grey = np.array([[[7], [9]]], dtype=np.uint8)
    textures = ModelTexture("a\\b.png", rgba), ModelTexture("", grey)
    return Model((small_primitive(0), small_primitive()), (material,), textures)


def assert_valid(model: Model) -> None:
    """Every promise that Model and Primitive make about their arrays."""
    for primitive in model.primitives:
        count = len(primitive.vertices)
        assert primitive.vertices.shape == (count, 3) and np.isfinite(primitive.vertices).all()
        assert primitive.uvs.shape == (count, 2) and np.isfinite(primitive.uvs).all()
        assert primitive.colors.shape == (count, 4) and np.isfinite(primitive.colors).all()
        assert np.allclose(np.linalg.norm(primitive.normals.astype(float), axis=1), 1.0, atol=2e-3)
        assert primitive.triangles.shape[1:] == (3,)
        assert primitive.triangles.size == 0 or primitive.triangles.min() >= 0
        assert primitive.triangles.size == 0 or primitive.triangles.max() < count
        assert -1 <= primitive.material < len(model.materials)
    for material in model.materials:
        assert len(material.textures) == 8
        assert all(-1 <= slot < len(model.textures) for slot in material.textures)
    for texture in model.textures:
        assert texture.pixels.ndim == 3 and texture.pixels.shape[2] in (1, 3, 4)


def assert_equal_models(left: Model, right: Model) -> None:
    assert (left.materials, left.library) == (right.materials, right.library)
    assert len(left.primitives) == len(right.primitives)
    for one, other in zip(left.primitives, right.primitives, strict=True):
        assert one.material == other.material
        for name in ("vertices", "uvs", "normals", "colors", "triangles"):
            assert np.array_equal(getattr(one, name), getattr(other, name)), name
    assert [texture.name for texture in left.textures] == [texture.name for texture in right.textures]
    for one_texture, other_texture in zip(left.textures, right.textures, strict=True):
        assert np.array_equal(one_texture.pixels, other_texture.pixels)
