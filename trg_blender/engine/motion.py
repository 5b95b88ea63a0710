"""What moves while a shutter is open, as keys between which every entry of a matrix goes straight."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .scene_arrays import Float64, SceneArrays

LARGEST_TURN = np.radians(1.0)
"""Between two keys: a point that turns so far leaves its circle by less than 4e-5 of the radius."""
MOST_KEYS = 1025


def turning_keys(places: Float64) -> Float64:
    """(keys, 3, 4) for (n, 3, 4) `places` at even times: rotations turn evenly from one to the next, stretch
    and translation go straight, as Blender's Cycles has it. The places are among the keys; n is 2 or more.
    """
    turns, stretches = zip(*(split_turn(place[:, :3]) for place in places), strict=True)
    axes = [turn_vector(turns[k].T @ turns[k + 1]) for k in range(len(places) - 1)]
    angle = max(float(np.linalg.norm(axis)) for axis in axes)
    parts = min(max(1, int(np.ceil(angle / LARGEST_TURN))), (MOST_KEYS - 1) // len(axes))
    keys = []
    for k, axis in enumerate(axes):
        for part in np.arange(parts) / parts:
            linear = turns[k] @ rotation(axis * part) @ blend(stretches[k], stretches[k + 1], part)
            shift = blend(places[k][:, 3], places[k + 1][:, 3], part)
            keys.append(places[k] if part == 0.0 else np.column_stack([linear, shift]))
    return np.stack([*keys, places[-1]])


def blend(a: Float64, b: Float64, part: float) -> Float64:
    return a * (1.0 - part) + b * part


def split_turn(linear: Float64) -> tuple[Float64, Float64]:
    """(3, 3) -> rotation and stretch, whose product it is (polar decomposition; a mirror is stretch)."""
    u, sizes, v = np.linalg.svd(linear)
    sign = np.sign(np.linalg.det(u @ v))
    return sign * u @ v, sign * v.T @ np.diag(sizes) @ v


def turn_vector(turn: Float64) -> Float64:
    """(3,) axis times angle of a rotation matrix, the angle from 0 to pi."""
    twist = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2.0
    sine, cosine = float(np.linalg.norm(twist)), (np.trace(turn) - 1.0) / 2.0
    angle = float(np.arctan2(sine, cosine))
    if sine > 1e-6:
        return twist * (angle / sine)
    if cosine > 0.0:
        return twist
    # Half a turn: its matrix is 2 a a' - 1, whose longest column is along the axis.
    square = (turn + np.eye(3)) / 2.0
    column = square[:, int(np.argmax(np.diag(square)))]
    return np.asarray(column / np.linalg.norm(column) * np.pi)


def rotation(vector: Float64) -> Float64:
    """The matrix of a rotation about `vector` by its length (Rodrigues)."""
    angle = float(np.linalg.norm(vector))
    x, y, z = vector
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    first = np.sinc(angle / np.pi)
    second = 0.5 * np.sinc(angle / (2.0 * np.pi)) ** 2
    return np.eye(3) + first * cross + second * (cross @ cross)


def moves(scene: SceneArrays) -> bool:
    return scene.camera.motion is not None or any(each.motion is not None for each in scene.instances)


def still_at(scene: SceneArrays, time: float) -> SceneArrays:
    """The scene as it stands at `time`, 0 to 1 while the shutter is open."""
    camera, instances = scene.camera, []
    if camera.motion is not None:
        camera = replace(camera, matrix=place_at(camera.motion[None], time)[0], motion=None)
    for each in scene.instances:
        if each.motion is not None:
            places = place_at(np.asarray(each.motion, dtype=np.float64), time).astype(np.float32)
            each = replace(each, transforms=places, motion=None)
        instances.append(each)
    return replace(scene, camera=camera, instances=instances)


def place_at(keys: Float64, time: float) -> Float64:
    """(k, 3, 4) of (k, keys, 3, 4)."""
    steps = keys.shape[1] - 1
    key = min(int(time * steps), steps - 1)
    return blend(keys[:, key], keys[:, key + 1], time * steps - key)
