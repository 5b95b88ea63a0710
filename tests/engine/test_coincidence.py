"""Coincident surfaces are named (row S06)."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.coincidence import coincidence_warnings
from trg_blender.engine.scene_arrays import Material, MeshArrays, SceneArrays

from .arrays import ball, box, look_at, place, quad


def scene_of(meshes, instances) -> SceneArrays:
    return SceneArrays(look_at((3, 0, 0), (0, 0, 0), 0.5), meshes, instances, [Material()])


def warnings_of(meshes, instances) -> list[str]:
    return list(coincidence_warnings(scene_of(meshes, instances)))


def joined(first: MeshArrays, second: MeshArrays) -> MeshArrays:
    triangles = np.concatenate([first.triangles, second.triangles + len(first.vertices)])
    return MeshArrays(np.concatenate([first.vertices, second.vertices]), triangles.astype(np.int32))


def test_ordinary_meshes_are_silent():
    assert (
        warnings_of(
            [ball(1.0, 12), box(1.0), quad(2.0)], [place(0), place(1), place(2), place(0, 0, (1, 0, 0))]
        )
        == []
    )


@pytest.mark.parametrize("turned", [False, True])
def test_triangles_that_are_there_twice_are_counted(turned: bool):
    second = box(1.0)
    if turned:
        second.triangles = np.ascontiguousarray(second.triangles[:, ::-1])
    assert "12 triangles lie exactly on others" in warnings_of([joined(box(1.0), second)], [place(0)])[0]


@pytest.mark.parametrize("meshes", [1, 2])
def test_equal_objects_in_one_place_are_named(meshes: int):
    one, two = place(0, 0, (1, 2, 3)), place(meshes - 1, 0, (1, 2, 3))
    one.origin, two.origin = "A", "B"
    found = warnings_of([box(1.0), box(1.0)], [one, two])
    assert found == ["objects 'A' and 'B': the same mesh in the same place"]


def test_copies_upon_one_another_are_counted():
    one = place(0)
    one.transforms = np.repeat(one.transforms, 3, axis=0)
    assert "2 copies lie exactly on others" in warnings_of([box(1.0)], [one])[0]
    one.transforms[:, 0, 3] = (0.0, 1.0, 2.0)
    assert warnings_of([box(1.0)], [one]) == []
