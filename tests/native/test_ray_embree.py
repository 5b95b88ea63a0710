"""The native tracer and Embree agree on the paper's cow."""

from __future__ import annotations

import numpy as np
import pytest

from .meshes import INDICES, SHARED, Mesh, brute_force, scene_of

COW = SHARED / "data/models/cow.g3dm"


def read_cow() -> Mesh:
    """The first primitive of a G3DM file: counts at 16, vertices of 12 floats, then indices."""
    data = COW.read_bytes()
    vertex_count, index_count = (int(n) for n in np.frombuffer(data, "<u4", 2, 16))
    vertices = np.frombuffer(data, "<f4", 12 * vertex_count, 28).reshape(-1, 12)[:, :3]
    indices = np.frombuffer(data, "<i4", index_count, 28 + 48 * vertex_count)
    return Mesh(np.ascontiguousarray(vertices), indices.reshape(-1, 3).astype(np.int32))


@pytest.mark.skipif(not COW.exists(), reason="the shared models are not here")
@pytest.mark.parametrize("accel", INDICES)
def test_the_cow_is_hit_where_embree_hits_it(accel: str):
    rtcore_scene = pytest.importorskip("embreex.rtcore_scene")
    mesh_construction = pytest.importorskip("embreex.mesh_construction")
    mesh = read_cow()
    assert len(mesh.triangles) == 5804
    embree = rtcore_scene.EmbreeScene()
    mesh_construction.TriangleMesh(embree, mesh.vertices, mesh.triangles)
    rng = np.random.default_rng(1)
    targets = (
        mesh.vertices[rng.integers(len(mesh.vertices), size=50_000)] + rng.normal(size=(50_000, 3)) * 0.5
    )
    origins = (rng.normal(size=(50_000, 3)) * 10 + [0, 6, 0]).astype(np.float32)
    directions = (targets - origins).astype(np.float32)
    expected = embree.run(origins, directions, output=True)
    hits = scene_of(mesh, accel).intersect(origins, directions)
    differ = np.flatnonzero(hits.triangle != expected["primID"])
    assert len(differ) <= 5
    same = (hits.triangle == expected["primID"]) & (hits.triangle >= 0)
    assert np.allclose(hits.t[same], expected["tfar"][same], rtol=2e-5)
    if len(differ):
        # Where they differ, double precision says that we are right or that it is a tie.
        t, triangle, _ = brute_force(mesh, origins[differ], directions[differ])
        ours = hits.triangle[differ]
        assert ((ours == triangle) | np.isclose(hits.t[differ], t, rtol=1e-6)).all()
