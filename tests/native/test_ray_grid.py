"""The regular grid and the divided one against brute force in the cases where grids are known to fail."""

from __future__ import annotations

import numpy as np
import pytest

from .meshes import cube, icosphere, mesh_of, random_rays, same_hits, scene_of, soup


def check_grid(mesh, origins, directions) -> None:
    expected = scene_of(mesh, "none").intersect(origins, directions)
    assert (expected.triangle >= 0).any()
    for accel in ("grid", "grid2"):
        grid = scene_of(mesh, accel)
        assert same_hits(grid.intersect(origins, directions), expected)
        assert np.array_equal(grid.occluded(origins, directions), expected.triangle >= 0)


def grid_of_points(steps: int) -> np.ndarray:
    at = np.linspace(-1, 1, steps)
    return np.stack(np.meshgrid(at, at, at, indexing="ij"), axis=-1).reshape(-1, 3)


def test_a04_the_default_cube_keeps_every_hit():
    origins, directions = random_rays(50_000, seed=1, spread=3)
    check_grid(cube(), origins, directions)


def test_a07_triangles_that_span_many_cells_keep_their_order():
    origins, directions = random_rays(20_000, seed=2)
    check_grid(soup(400, 1.5, seed=3), origins, directions)


@pytest.mark.parametrize(
    "direction", [(0, 0, -1), (0, -1, 0), (1, 0, 0), (1, 1, 0), (1, -1, 1), (-1, -1, -1)]
)
def test_a08_rays_in_cell_planes_and_through_corners_are_not_lost(direction: tuple[int, int, int]):
    mesh = mesh_of(grid_of_points(9), np.random.default_rng(4).permutation(729).reshape(-1, 3))
    origins = (grid_of_points(17) - 3 * np.array(direction, float)).astype(np.float32)
    check_grid(mesh, origins, np.tile(np.float32(direction), (len(origins), 1)))


@pytest.mark.parametrize("offset", [1e2, 1e4])
def test_a06_a_grid_far_from_the_origin_loses_nothing(offset: float):
    mesh = icosphere(4, 1.0, offset)
    origins, directions = random_rays(20_000, seed=5, spread=3)
    check_grid(mesh, (origins + np.float32(offset)).astype(np.float32), directions)


def test_rays_that_start_inside_or_run_along_the_box_are_not_lost():
    mesh = cube()
    origins, directions = random_rays(20_000, seed=6, spread=0.4)
    check_grid(mesh, origins, directions)
    flat = mesh_of(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]] * 30))
    check_grid(flat, np.float32([[0.2, 0.2, 1], [0, 0, 5]]), np.float32([[0, 0, -1], [0, 0, -1]]))
