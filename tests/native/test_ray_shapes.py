"""Spheres and planes that rays meet in double precision: rows P01, G13 and G14 of the catalogue."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine.native import Hits, RayScene
from trg_blender.stability.shape_rows import exact_sphere, scene_with

from .meshes import ACCELS, Float32, icosphere, random_rays


def at(x: float, y: float, z: float, scale: float = 1.0) -> Float32:
    return np.column_stack([np.eye(3) * scale, (x, y, z)]).astype(np.float32)


@pytest.mark.parametrize("distance", [1e1, 1e2, 1e3, 1e4, 1e5])
@pytest.mark.parametrize("accel", ACCELS)
def test_p01_a_sphere_is_met_from_afar_as_in_exact_arithmetic(distance: float, accel: str):
    rng = np.random.default_rng(1)
    origins = rng.normal(size=(20_000, 3))
    origins *= distance / np.linalg.norm(origins, axis=1, keepdims=True)
    aims = rng.normal(size=origins.shape)
    aims *= (1.2 * rng.random(len(origins)) / np.linalg.norm(aims, axis=1))[:, None]
    origins = origins.astype(np.float32)
    directions = (aims - origins).astype(np.float32)
    hits = scene_with(None, accel=accel).intersect(origins, directions)
    t, across = exact_sphere(origins, directions, 1.0)
    clear = np.abs(across - 1) > 1e-9
    assert clear.mean() > 0.999
    assert np.array_equal(hits.triangle[clear] == 0, across[clear] < 1)
    met = clear & (across < 1)
    assert np.allclose(hits.t[met], t[met].astype(float), rtol=2e-7)


def test_g14_the_horizon_of_a_planet_dips_as_it_must():
    radius, eye = 6.4e6, 1.7
    scene = scene_with(at(0, 0, -radius, radius))
    dip = np.arccos(np.float64(np.float32(radius)) / (np.float64(np.float32(radius)) + eye))
    angles = np.concatenate([dip * (1 + np.linspace(1e-4, 5, 2000)), dip * (1 - np.linspace(1e-4, 1, 2000))])
    directions = np.stack([np.cos(angles), 0 * angles, -np.sin(angles)], axis=1).astype(np.float32)
    hits = scene.intersect(np.tile(np.float32([0, 0, eye]), (4000, 1)), directions)
    assert np.degrees(dip) == pytest.approx(0.0418, rel=0.01)
    assert np.array_equal(hits.triangle == 0, np.arange(4000) < 2000)
    down = scene.intersect([[0, 0, eye]], [[0, 0, -1]])
    assert down.t[0] == pytest.approx(eye, rel=1e-7)


@pytest.mark.parametrize("accel", ACCELS)
def test_g13_a_plane_ends_at_the_horizon_and_nowhere_else(accel: str):
    scene = scene_with(None, "plane", accel)
    slopes = np.geomspace(1e-12, 1, 4000)
    directions = np.stack([np.ones(4000), np.full(4000, 0.3), -slopes], axis=1).astype(np.float32)
    origins = np.tile(np.float32([0, 0, 1.7]), (4000, 1))
    hits = scene.intersect(origins, directions)
    assert (hits.triangle == 0).all()
    assert np.allclose(hits.t, 1.7 / -directions[:, 2].astype(float), rtol=1e-6)
    directions[:, 2] *= -1
    assert (scene.intersect(origins, directions).triangle == -1).all()
    directions[:, 2] = 0
    assert (scene.intersect(origins, directions).triangle == -1).all()
    assert scene.occluded(origins[:1], [[0, 0, -1]], 0, 2)[0]
    assert not scene.occluded(origins[:1], [[0, 0, -1]], 0, 1.6)[0]


def test_coordinates_run_as_promised():
    sphere = scene_with(None)
    hits = sphere.intersect(
        [[0, -3, 0], [3, 0, 0], [0, 0, 3], [0, 0, -3], [-3, 0, 0]],
        [[0, 1, 0], [-1, 0, 0], [0, 0, -1], [0, 0, 1], [1, 0, 0]],
    )
    assert hits.u[[0, 1, 4]].tolist() == [0, 0.25, 0.75]
    assert hits.v.tolist() == [0.5, 0.5, 1, 0, 0.5]
    plane = scene_with(at(10, 0, 0), "plane")
    hits = plane.intersect([[11, 2, 5]], [[0, 0, -1]])
    assert (hits.u[0], hits.v[0], hits.t[0]) == (1, 2, 5)


@pytest.mark.parametrize("accel", ACCELS)
def test_shapes_and_triangles_share_a_scene(accel: str):
    scene = RayScene(accel)
    mesh = icosphere(3)
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles), at(0, 0, 2))
    ball, floor = scene.add_sphere(), scene.add_plane()
    scene.add_instance(ball, at(0, 0, -2))
    scene.add_instance(floor, at(0, 0, -3))
    scene.add_instance(ball, at(3, 0, 0, 0.5))
    scene.build()
    origins = np.float32([[0, 0, 9], [0, 0, 0], [3, 0, 9], [9, 9, 9], [0, 0, -9]])
    directions = np.float32([[0, 0, -1]] * 4 + [[0, 0, 1]])
    hits = scene.intersect(origins, directions)
    # The last ray meets ball and floor where they touch.
    assert hits.instance.tolist() == [0, 1, 3, 2, 1]
    assert np.allclose(hits.t, [6, 1, 8.5, 12, 6])
    origins, directions = random_rays(4000, seed=2, spread=4)
    for tmax in (1.0, np.inf):
        met = scene.intersect(origins, directions, 0, tmax).triangle >= 0
        assert np.array_equal(scene.occluded(origins, directions, 0, tmax), met)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_a_stretched_and_mirrored_sphere_is_its_mesh(scale: float):
    linear = scale * np.array([[1, 0.5, 0], [0, -2, 0], [0.3, 0, 0.25]])
    transform = np.column_stack([linear, scale * np.array([1, 2, 3])]).astype(np.float32)
    origins, directions = random_rays(4000, seed=3, spread=6)
    origins = (scale * origins).astype(np.float32)
    true = scene_with(transform).intersect(origins, directions)
    scene = RayScene()
    mesh = icosphere(6)
    scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles), transform)
    scene.build()
    flat = scene.intersect(origins, directions)
    same = (true.triangle >= 0) == (flat.triangle >= 0)
    assert same.mean() > 0.999 and (true.triangle >= 0).sum() > 200
    both = (true.triangle >= 0) & (flat.triangle >= 0)
    assert np.quantile(np.abs(true.t[both] - flat.t[both]), 0.99) < 1e-2 * scale


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_two_halves_of_a_tie_give_the_lower_instance(scale: float):
    scene = RayScene()
    ball = scene.add_sphere()
    for _ in range(3):
        scene.add_instance(ball, at(0, 0, 0, scale))
    scene.build()
    hits: Hits = scene.intersect([[0, 0, 3 * scale]], [[0, 0, -1]])
    assert hits.instance[0] == 0 and hits.t[0] == pytest.approx(2 * scale, rel=1e-6)
