"""The catalogue's ray rows with few rays, for every accelerator and instruction set.

`python -m benchmarks.robustness` shoots all the rays that the catalogue asks for.
"""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks import leaving_rows
from benchmarks.robustness_rates import teapot_in_stadium
from benchmarks.robustness_rows import rows
from trg_blender.engine.native import Hits, RayScene

from .meshes import (
    ACCELS,
    INDICES,
    edge_and_vertex_rays,
    icosphere,
    mesh_of,
    scene_of,
)

ROWS = dict(rows())
LEAVING_ROWS = dict(leaving_rows.rows())


@pytest.mark.parametrize("name", ROWS)
@pytest.mark.parametrize("accel", INDICES)
def test_no_ray_of_the_row_fails(name: str, accel: str):
    count = 300 if name.startswith(("G07", "G11", "G12")) else 4000
    outcome = ROWS[name](accel, count)
    assert outcome.total == count and outcome.failed == 0


@pytest.mark.parametrize("name", LEAVING_ROWS)
def test_leaving_a_surface_loses_nothing(name: str):
    accels = ["bvh"] if name.startswith(("S07", "S08", "S11", "S12")) else INDICES
    for accel in accels:
        outcome = LEAVING_ROWS[name](accel, 1600)
        assert outcome.total > 0 and outcome.failed == 0, accel


def hits_with(instruction_set: str, accel: str) -> Hits:
    mesh = icosphere(4)
    try:
        scene = RayScene(accel, instruction_set=instruction_set)
    except ValueError as refusal:
        pytest.skip(str(refusal))
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
    scene.build()
    rays = edge_and_vertex_rays(mesh, 40_000, seed=1)
    hits = scene.intersect(*rays)
    assert np.array_equal(scene.occluded(*rays), hits.triangle >= 0)
    return hits


@pytest.mark.parametrize("accel", ACCELS)
@pytest.mark.parametrize("instruction_set", ["avx2", "avx512"])
def test_g04_fused_and_plain_arithmetic_meet_the_same_surface(instruction_set: str, accel: str):
    plain, fused = hits_with("baseline", accel), hits_with(instruction_set, accel)
    assert (plain.triangle >= 0).all() and (fused.triangle >= 0).all()
    assert np.allclose(plain.t, fused.t, rtol=1e-6)


def test_an_instruction_set_that_nobody_has_is_refused():
    with pytest.raises(ValueError, match="expected auto, baseline"):
        RayScene(instruction_set="mmx")


@pytest.mark.parametrize("accel", INDICES)
def test_a11_equal_and_nested_triangles_build(accel: str):
    one = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    sizes = np.linspace(1, 2, 20_000)[:, None, None]
    nested = np.array([[-1, -1, 0], [1, -1, 0], [0, 2, 0]], float)[None] * sizes
    equal = mesh_of(one, np.tile([[0, 1, 2]], (100_000, 1)))
    for mesh in (equal, mesh_of(nested.reshape(-1, 3), np.arange(60_000).reshape(-1, 3))):
        scene = scene_of(mesh, accel)
        hits = scene.intersect([[0.2, 0.2, 1]], [[0, 0, -1]])
        assert (hits.t[0], hits.triangle[0]) == (1, 0)


def test_a09_a_teapot_in_a_stadium_is_the_same_to_a_divided_grid():
    mesh, rays = teapot_in_stadium()
    flat, divided = scene_of(mesh, "grid"), scene_of(mesh, "grid2")
    assert np.array_equal(flat.intersect(*rays).triangle, divided.intersect(*rays).triangle)
