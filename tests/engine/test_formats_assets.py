"""The files that the examples use are what tools/make_assets.py makes."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from trg_blender.engine.formats import read_g24, read_model

from .samples import ROOT, assert_valid

ASSETS = ("chess.g24", "models/elephant.g3dm")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("assets")
    command = [sys.executable, str(ROOT / "tools" / "make_assets.py"), str(folder)]
    subprocess.run(command, check=True, cwd=ROOT, env={"PYTHONPATH": str(ROOT)})
    return folder


@pytest.mark.parametrize("name", ASSETS)
def test_a_committed_asset_equals_the_generators_output(made: Path, name: str):
    assert (made / name).read_bytes() == (ROOT / "examples" / name).read_bytes()


def test_the_elephant_stands_on_y_0_13_units_tall_and_fits_into_the_fence():
    model = read_model(ROOT / "examples" / "models" / "elephant.g3dm")
    (elephant,) = model.primitives
    assert_valid(model)
    assert model.warnings == ()
    assert elephant.vertices[:, 1].min() == 0.0
    assert elephant.vertices[:, 1].max() == 13.0
    assert np.hypot(elephant.vertices[:, 0], elephant.vertices[:, 2]).max() < 15.0


def test_the_elephant_is_wound_outwards():
    (elephant,) = read_model(ROOT / "examples" / "models" / "elephant.g3dm").primitives
    a, b, c = (elephant.vertices[elephant.triangles[:, k]].astype(float) for k in range(3))
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0 > 700.0
    stored = elephant.normals[elephant.triangles].astype(float).sum(axis=1)
    outward = np.einsum("ij,ij->i", np.cross(b - a, c - a), stored) > 0.0
    assert outward.mean() > 0.99


def test_the_chess_board_has_a_dark_square_at_the_bottom_left():
    board = read_g24(ROOT / "examples" / "chess.g24")
    assert board.shape == (128, 128, 3)
    assert board[0, 0].sum() < board[0, -1].sum()
    assert (board[0, 0] == board[-1, -1]).all()
