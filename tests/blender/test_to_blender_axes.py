"""The one conversion of axes, and the parts of matrices, without bpy objects."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("bpy")

from trg_blender.engine.to_blender import axes  # noqa: E402
from trg_blender.engine.to_blender.transforms import decompose, frame_of_direction, quaternions_of  # noqa: E402


def test_y_up_becomes_z_up_and_back():
    assert axes.vector_to_blender((1.0, 2.0, 3.0)) == (1.0, -3.0, 2.0)
    assert axes.vector_to_trg((1.0, -3.0, 2.0)) == (1.0, 2.0, 3.0)
    points = np.array([(1.0, 2.0, 3.0), (0.0, 1.0, 0.0)], dtype=np.float32)
    assert axes.points_to_blender(points).tolist() == [[1.0, -3.0, 2.0], [0.0, 0.0, 1.0]]
    assert axes.points_to_blender(points).dtype == np.float32
    np.testing.assert_array_equal(axes.points_to_trg(axes.points_to_blender(points)), points)


def test_the_conversion_keeps_handedness():
    assert np.linalg.det(axes.TRG_TO_BLENDER) == pytest.approx(1.0)


def test_a_transform_acts_on_converted_points_as_it_did_on_the_originals():
    rng = np.random.default_rng(1)
    matrix = np.vstack((rng.normal(size=(3, 4)), (0, 0, 0, 1)))
    point = rng.normal(size=3)
    moved = (matrix @ (*point, 1.0))[:3]
    converted = axes.transforms_to_blender(matrix) @ (*axes.vector_to_blender(point), 1.0)
    np.testing.assert_allclose(converted[:3], axes.vector_to_blender(moved), atol=1e-12)


def random_rotations(count: int) -> np.ndarray:
    q, _ = np.linalg.qr(np.random.default_rng(2).normal(size=(count, 3, 3)))
    return q * np.sign(np.linalg.det(q))[:, None, None]


def matrices_of(quaternions: np.ndarray) -> np.ndarray:
    w, x, y, z = quaternions.T
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )
    return np.moveaxis(np.array(rows), 2, 0)


def test_quaternions_give_their_rotations_back_half_turns_included():
    half_turns = np.array(
        [np.diag(d) for d in ((1, -1, -1), (-1, 1, -1), (-1, -1, 1), (1, 1, 1))], dtype=float
    )
    rotations = np.concatenate((random_rotations(1000), half_turns))
    np.testing.assert_allclose(matrices_of(quaternions_of(rotations)), rotations, atol=1e-12)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_parts_of_an_unsheared_matrix_give_it_back(sign):
    rotations = random_rotations(200)
    scales = np.random.default_rng(3).uniform(0.01, 100.0, size=(200, 3)) * (sign, 1.0, 1.0)
    matrices = np.tile(np.eye(4), (200, 1, 1))
    matrices[:, :3, :3] = rotations * scales[:, None, :]
    matrices[:, :3, 3] = np.arange(600).reshape(200, 3)
    parts = decompose(matrices)
    assert parts.exact.all()
    back = matrices_of(parts.rotations) * parts.scales[:, None, :]
    np.testing.assert_allclose(back, matrices[:, :3, :3], atol=1e-9)
    np.testing.assert_array_equal(parts.locations, matrices[:, :3, 3])


def test_shear_and_flatness_are_told():
    sheared, flat = np.eye(4), np.eye(4)
    sheared[0, 1] = 0.01
    flat[1, 1] = 0.0
    assert decompose(np.array([np.eye(4), sheared, flat])).exact.tolist() == [True, False, False]


def test_a_frame_looks_along_its_direction_even_when_up_is_parallel():
    for forward, up in (
        ((1, 2, 3), (0, 0, 1)),
        ((0, 0, 1), (0, 0, 1)),
        ((0, 0, -2), (0, 0, 1)),
        ((0, 1, 0), (0, 3, 0)),
    ):
        frame = frame_of_direction(np.array(forward, dtype=float), np.array(up, dtype=float))
        np.testing.assert_allclose(frame.T @ frame, np.eye(3), atol=1e-12)
        assert np.linalg.det(frame) == pytest.approx(1.0)
        np.testing.assert_allclose(-frame[:, 2], np.array(forward) / np.linalg.norm(forward), atol=1e-12)
