"""The meshes of TRG's shapes: where they lie, that they are closed, and that they face outwards."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.to_blender import SceneMirror  # noqa: E402
from trg_blender.engine.to_blender.tags import KEY  # noqa: E402
from trg_blender.lang.scene import SceneDescription, ShapeRecord  # noqa: E402

SHAPES = {
    "sphere": ((1.0, 2.0, 3.0), 0.5),
    "box": ((3.0, 0.0, 1.0), (1.0, 4.0, -2.0)),
    "tor": ((0.0, 0.75, 1.0), 0.75, 5.0),
    "conus": ((1.0, 0.0, 2.0), 1.0, 3.0),
    "cylinder": ((1.0, -1.0, 2.0), 0.5, 3.0),
    "fence": ((0.0, 1.0, 0.0), 15.0, 2.0, 6.0),
}
# Bounds in TRG's space: low and high corner.
BOUNDS = {
    "sphere": ((0.5, 1.5, 2.5), (1.5, 2.5, 3.5)),
    "box": ((1.0, 0.0, -2.0), (3.0, 4.0, 1.0)),
    "tor": ((-5.75, 0.0, -4.75), (5.75, 1.5, 6.75)),
    "conus": ((0.0, 0.0, 1.0), (2.0, 3.0, 3.0)),
    "cylinder": ((0.5, -1.0, 1.5), (1.5, 2.0, 2.5)),
}
VOLUMES = {
    "sphere": 4.0 / 3.0 * np.pi * 0.5**3,
    "box": 2.0 * 4.0 * 3.0,
    "tor": 2.0 * np.pi**2 * 5.0 * 0.75**2,
    "conus": np.pi * 3.0 / 3.0,
    "cylinder": np.pi * 0.25 * 3.0,
}


def record(kind: str, parameters: tuple, **more) -> ShapeRecord:
    return ShapeRecord(f"{kind}@1:1#1", 1, kind, parameters, kind, None, **more)


def built(shape: ShapeRecord) -> bpy.types.Object:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    SceneMirror(scene).apply(SceneDescription(1, (shape,)))
    bpy.context.view_layer.update()
    return next(obj for obj in scene.objects if obj.get(KEY) == shape.key)


def world_triangles(obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Corners (m, 3, 3) in TRG's space, vertex numbers (m, 3), corner normals (m, 3, 3) in TRG's space."""
    mesh = obj.data
    mesh.calc_loop_triangles()
    vertices = np.array([vertex.co for vertex in mesh.vertices])
    triangles = np.array([t.vertices for t in mesh.loop_triangles])
    loops = np.array([t.loops for t in mesh.loop_triangles])
    normals = np.array([n.vector for n in mesh.corner_normals])[loops]
    matrix = np.array(obj.matrix_world)
    world = vertices @ matrix[:3, :3].T + matrix[:3, 3]
    normals = normals @ np.linalg.inv(matrix[:3, :3])
    normals = normals / np.linalg.norm(normals, axis=-1, keepdims=True)
    if np.linalg.det(matrix[:3, :3]) < 0:
        triangles = triangles[:, ::-1]
        normals = normals[:, ::-1]
    return to_trg(world)[triangles], triangles, to_trg(normals)


def to_trg(points: np.ndarray) -> np.ndarray:
    """Written out on its own, so that an error in axes.py shows."""
    x, y, z = np.moveaxis(points, -1, 0)
    return np.stack((x, z, -y), axis=-1)


def volume_of(corners: np.ndarray) -> float:
    return float(np.linalg.det(corners).sum() / 6.0)


@pytest.mark.parametrize("kind", BOUNDS)
def test_shape_lies_where_its_parameters_say(kind):
    corners, _, _ = world_triangles(built(record(kind, SHAPES[kind])))
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    np.testing.assert_allclose((low, high), BOUNDS[kind], atol=2e-6)


@pytest.mark.parametrize("kind", SHAPES)
def test_every_edge_belongs_to_two_faces_that_run_it_in_opposite_ways(kind):
    _, triangles, _ = world_triangles(built(record(kind, SHAPES[kind])))
    edges = Counter((int(t[i]), int(t[(i + 1) % 3])) for t in triangles for i in range(3))
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)


@pytest.mark.parametrize("kind", VOLUMES)
def test_signed_volume_is_that_of_the_shape_seen_from_outside(kind):
    corners, _, _ = world_triangles(built(record(kind, SHAPES[kind])))
    volume = volume_of(corners)
    assert volume == pytest.approx(VOLUMES[kind], rel=0.01)
    assert volume <= VOLUMES[kind] * (1 + 1e-5)


@pytest.mark.parametrize("kind", SHAPES)
def test_shading_normals_lie_on_the_side_of_the_face(kind):
    corners, _, normals = world_triangles(built(record(kind, SHAPES[kind])))
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    face = face / np.linalg.norm(face, axis=1, keepdims=True)
    assert np.einsum("mij,mj->mi", normals, face).min() > 0.7


def test_sphere_normals_point_from_the_centre():
    corners, _, normals = world_triangles(built(record("sphere", SHAPES["sphere"])))
    radial = (corners - SHAPES["sphere"][0]) / 0.5
    assert np.einsum("mij,mij->mi", normals, radial).min() > 0.999


def test_cone_side_has_the_true_normals_up_to_the_tip_and_a_flat_base():
    corners, _, normals = world_triangles(built(record("conus", ((0.0, 0.0, 0.0), 1.0, 3.0))))
    is_base = (corners[..., 1] < 1e-6).all(axis=1)
    np.testing.assert_allclose(normals[is_base] @ (0.0, -1.0, 0.0), 1.0, atol=1e-3)
    # The side of a cone of height 3 and radius 1 leans 1 up for 3 out.
    np.testing.assert_allclose(normals[~is_base][..., 1], 1.0 / np.sqrt(10.0), atol=2e-3)


def test_cylinder_has_a_smooth_side_and_flat_caps():
    corners, _, normals = world_triangles(built(record("cylinder", ((0.0, 0.0, 0.0), 1.0, 3.0))))
    flat = np.ptp(corners[..., 1], axis=1) < 1e-6
    np.testing.assert_allclose(np.abs(normals[flat][..., 1]), 1.0, atol=1e-5)
    radial = corners[~flat] * (1.0, 0.0, 1.0)
    np.testing.assert_allclose(np.einsum("mij,mij->mi", normals[~flat], radial), 1.0, atol=1e-3)


@pytest.mark.parametrize(
    ("normal", "distance"), [((0.0, 1.0, 0.0), 0.0), ((0.0, -1.0, 0.0), 2.0), ((1.0, 2.0, -2.0), 6.0)]
)
def test_plane_holds_the_points_with_normal_times_p_equal_to_distance(normal, distance):
    corners, _, normals = world_triangles(built(record("plane", (normal, distance))))
    length = np.linalg.norm(normal)
    np.testing.assert_allclose(corners @ normal, distance, atol=5e-3 * length)
    np.testing.assert_allclose(normals @ normal, length, rtol=1e-5)
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (face @ normal > 0).all()
    assert np.abs(corners).max() >= 1e4 * 0.99


def test_plane_uvs_are_metres():
    mesh = built(record("plane", ((0.0, 1.0, 0.0), 0.0))).data
    uvs = np.array([uv.vector for uv in mesh.uv_layers[0].uv])
    assert np.ptp(uvs, axis=0).tolist() == [20_000.0, 20_000.0]


def test_triangle_keeps_its_corners_in_order():
    points = ((0.0, 1.0, 0.0), (1.0, 1.0, 0.5), (0.0, 2.0, -1.0))
    corners, _, _ = world_triangles(built(record("triangle", points)))
    np.testing.assert_allclose(corners[0], points, atol=1e-6)


def test_fence_stands_in_a_ring_with_gaps_and_the_given_height():
    obj = built(record("fence", SHAPES["fence"]))
    corners, triangles, _ = world_triangles(obj)
    assert len(obj.data.polygons) == 6 * 6
    assert (corners[..., 1].min(), corners[..., 1].max()) == pytest.approx((0.0, 2.0), abs=1e-5)
    pieces = np.array([corners[triangles // 8 == k].mean(axis=0) for k in range(6)])
    np.testing.assert_allclose(np.linalg.norm(pieces[:, [0, 2]], axis=1), 15.0, rtol=1e-5)
    # Nearest corners of neighbours stay apart.
    points = [np.unique(corners[triangles // 8 == k].round(6), axis=0) for k in range(6)]
    gap = min(np.linalg.norm(points[0][:, None] - points[1][None], axis=2).min(), 99.0)
    assert 0.1 < gap < 2.0


def test_a_flat_box_is_built_without_a_singular_matrix():
    obj = built(record("box", ((0.0, 1.0, 0.0), (2.0, 1.0, 5.0))))
    corners, _, _ = world_triangles(obj)
    assert np.ptp(corners[..., 1]) == 0.0
    assert min(obj.scale) == 1.0


SHEAR = (1.0, 0.5, 0.0, 4.0, 0.0, 1.0, 0.0, 5.0, 0.0, 0.0, 1.0, 6.0)
MIRROR = (-2.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
SHEARED_MIRROR = (-1.0, 0.5, 0.0, 4.0, 0.0, 1.0, 0.0, 5.0, 0.0, 0.0, 1.0, 6.0)
C, S = np.cos(0.3), np.sin(0.3)
TURN = (C, 0.0, S, 1.0, 0.0, 2.0, 0.0, 2.0, -S, 0.0, C, 3.0)


@pytest.mark.parametrize(
    "transform", [SHEAR, MIRROR, SHEARED_MIRROR, TURN], ids=["shear", "mirror", "both", "turn"]
)
@pytest.mark.parametrize("kind", ["box", "conus"])
def test_transform_of_the_record_is_applied_exactly(kind, transform):
    plain, _, _ = world_triangles(built(record(kind, SHAPES[kind])))
    moved, _, normals = world_triangles(built(record(kind, SHAPES[kind], transform=transform)))
    matrix = np.reshape(transform, (3, 4))
    expected = plain @ matrix[:, :3].T + matrix[:, 3]
    key = lambda points: np.unique(points.reshape(-1, 3).round(4), axis=0)  # noqa: E731
    np.testing.assert_allclose(key(moved), key(expected), atol=2e-4)
    assert volume_of(moved) == pytest.approx(volume_of(plain) * abs(np.linalg.det(matrix[:, :3])), rel=1e-4)
    face = np.cross(moved[:, 1] - moved[:, 0], moved[:, 2] - moved[:, 0])
    assert (np.einsum("mij,mj->mi", normals, face) > 0).all()
