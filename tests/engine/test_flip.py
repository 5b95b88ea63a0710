"""FLIP against its authors' own program, and its ends."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.flip import flip


def pictures(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A smooth picture with edges, and the same with noise and a shifted part."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[0:48, 0:64] / 64.0
    reference = np.stack([x, y, (np.sin(20.0 * x) > 0) * 0.8], axis=-1)
    test = np.clip(reference + rng.normal(0.0, 0.1, reference.shape), 0.0, 1.0)
    test[10:20, 20:40] = np.roll(reference, 3, axis=1)[10:20, 20:40]
    return reference, test


@pytest.mark.parametrize("seed", range(3))
def test_equals_the_authors_program(seed: int):
    evaluator = pytest.importorskip("flip_evaluator", reason="flip_evaluator (requirements) is not here")
    reference, test = pictures(seed)
    theirs, mean, _ = evaluator.evaluate(
        reference.astype(np.float32), test.astype(np.float32), "LDR", inputsRGB=True, applyMagma=False
    )
    ours = flip(reference, test)
    assert np.abs(ours - theirs[..., 0]).max() < 2e-3
    assert ours.mean() == pytest.approx(mean, abs=2e-4)


def test_equal_pictures_do_not_differ():
    reference, _ = pictures(0)
    assert flip(reference, reference).max() == 0.0


def test_black_and_white_differ_most():
    black, white = np.zeros((32, 32, 3)), np.ones((32, 32, 3))
    found = flip(black, white)
    assert found.min() > 0.95 and found.max() <= 1.0


def test_other_shapes_are_refused():
    with pytest.raises(ValueError, match="shapes"):
        flip(np.zeros((4, 4, 3)), np.zeros((4, 5, 3)))
    with pytest.raises(ValueError, match="shapes"):
        flip(np.zeros((4, 4)), np.zeros((4, 4)))
