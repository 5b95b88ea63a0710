"""Rows of what accelerators do with boxes, cells and equal triangles: A03 to A12."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import numpy as np

from ..engine.native import RayScene
from .case import EMBREE, EVERY, TRACED, Case, NotApplicable, Outcome, Row
from .meshes import (
    ACCELS,
    INDICES,
    Float32,
    Float64,
    Mesh,
    bipyramid,
    cube,
    icosphere,
    mesh_of,
    random_rays,
    scene_of,
    soup,
)
from .ray_rows import Outward, Rays, like_brute_force

TIMED = 50_000
"""Below so many rays a row only looks at the hits: the clock would tell nothing."""


def rays_on_faces(accel: str, count: int, seed: int = 0) -> Outcome:
    """A03: axis-parallel rays with the origin exactly on the planes that bound a stack of squares."""
    failed = total = 0
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    rim = np.array([(0, 0), (1, 0), (0, 1), (1, 1), (0.5, 0), (0, 0.5), (1, 0.25), (0.75, 1)], float)
    quads = np.concatenate([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * k for k in range(40)])
    for axis in range(3):
        stack = np.concatenate([corners + [0, 0, height] for height in np.arange(40.0)])
        scene = scene_of(mesh_of(np.roll(stack, axis, axis=1), quads), accel)
        for zero in (0.0, -0.0):
            origins = np.concatenate([rim, np.full((8, 1), -1.0)], axis=1)
            directions = np.tile([zero, -zero, 1.0], (8, 1))
            given = (np.roll(a, axis, axis=1).astype(np.float32) for a in (origins, directions))
            failed += int((~(np.abs(scene.intersect(*given).t - 1) < 1e-6)).sum())
            total += 8
    return Outcome(failed, total)


def far_grid(offset: float) -> Row:
    """A06: a fine ball far from the origin, rays past and at it."""
    mesh = icosphere(4, 1.0, offset)

    def shoot(count: int, seed: int) -> Rays:
        origins, directions = random_rays(count, 5 + seed, 3)
        return (origins + np.float32(offset)).astype(np.float32), directions

    return like_brute_force(mesh, shoot)


def drift(length: float, offset: float) -> Row:
    """A05: rays along a row of `length` cells with a triangle in nearly each; what a tree does not lose.

    Which cells are walked cannot be seen from outside: a skipped one shows when its triangle is lost.
    """

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        if accel == EMBREE:
            raise NotApplicable("a walk through cells is meant")
        rng = np.random.default_rng(3 + seed)
        triangles = int(16 * length)
        corners = rng.random((triangles, 1, 3)) * [length, 1, 1] + 0.05 * rng.normal(size=(triangles, 3, 3))
        mesh = mesh_of(corners.reshape(-1, 3) + offset, np.arange(3 * triangles).reshape(-1, 3))
        start, end = rng.random((count, 3)), rng.random((count, 3))
        start[:, 0], end[:, 0] = -1.0, length + 1.0
        rays = (start + offset).astype(np.float32), (end - start).astype(np.float32)
        hits, expected = (scene_of(mesh, name).intersect(*rays) for name in (accel, "bvh"))
        return Outcome(int(((hits.t != expected.t) | (hits.triangle != expected.triangle)).sum()), count)

    return row


def grid_of_points(steps: int) -> Float64:
    at = np.linspace(-1, 1, steps)
    return np.stack(np.meshgrid(at, at, at, indexing="ij"), axis=-1).reshape(-1, 3)


def in_cell_planes(direction: tuple[int, int, int]) -> Row:
    """A08: rays through the corners and along the planes of what is likely to be the grid's cells."""
    faces = np.random.default_rng(4).permutation(729).reshape(-1, 3)
    mesh = mesh_of(grid_of_points(9), faces)
    origins = (grid_of_points(17) - 3 * np.array(direction, float)).astype(np.float32)

    def shoot(count: int, _: int) -> Rays:
        return origins[:count], np.tile(np.float32(direction), (min(count, len(origins)), 1))

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        return like_brute_force(mesh, shoot)(accel, min(count, len(origins)), seed)

    return row


def teapot_in_stadium() -> tuple[Mesh, Rays]:
    """A fine ball in the middle of a coarse field 10^4 times as wide, and rays."""
    ball, field = icosphere(6, 0.5, 0.5), soup(200, 0.5, seed=2)
    vertices = np.concatenate([ball.vertices, (field.vertices - 0.5) * np.float32([1e4, 1e4, 1])])
    triangles = np.concatenate([ball.triangles, field.triangles + len(ball.vertices)])
    return mesh_of(vertices, triangles), random_rays(2000, seed=3)


def rate(scene: RayScene, rays: tuple[Float32, Float32]) -> float:
    """Rays a second on one thread, best of three."""
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        scene.intersect(*rays, threads=1)
        seconds.append(time.perf_counter() - start)
    return len(rays[0]) / min(seconds)


def divided_over_flat(accel: str, count: int, seed: int = 0) -> Outcome:
    """A09: the rate of `grid2` over that of `grid`, and whether both meet the same."""
    mesh, rays = teapot_in_stadium()
    flat, divided = scene_of(mesh, "grid"), scene_of(mesh, accel)
    differ = int((flat.intersect(*rays).triangle != divided.intersect(*rays).triangle).sum())
    if count < TIMED:
        return Outcome(differ, len(rays[0]), f"{differ} differ, not timed")
    gain = rate(divided, rays) / rate(flat, rays)
    return Outcome(differ + (gain < 20), len(rays[0]), f"{gain:.0f} x, {differ} differ")


def slivers_over_ball(accel: str, count: int, seed: int = 0) -> Outcome:
    """A10: the ray rate of a needle fan over that of a ball."""
    if count < TIMED:
        raise NotApplicable("nothing but time is measured: not in a quick run")
    rates = []
    for mesh in (icosphere(4), bipyramid(2048, 1.0)):
        rates.append(rate(scene_of(mesh, accel), Outward(at_random=True).shoot(mesh, 20_000, 4 + seed)))
    return Outcome(int(rates[1] < 0.2 * rates[0]), 1, f"{rates[1] / rates[0]:.2f} of the ball's")


def equal_triangles(count: int) -> Mesh:
    return mesh_of(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float), np.tile([[0, 1, 2]], (count, 1)))


def nested_triangles(count: int) -> Mesh:
    """With one centre, each larger than the one before."""
    sizes = np.linspace(1, 2, count)[:, None, None]
    nested = np.array([[-1, -1, 0], [1, -1, 0], [0, 2, 0]], float)[None] * sizes
    return mesh_of(nested.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


def same_centre(make: Callable[[int], Mesh]) -> Row:
    """A11: the build ends within 2 s, and of equal hits the first triangle's counts."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        mesh, start = make(count), time.perf_counter()
        scene = scene_of(mesh, accel)
        seconds = time.perf_counter() - start
        hits = scene.intersect(np.float32([[0.2, 0.2, 1]]), np.float32([[0, 0, -1]]))
        right = abs(hits.t[0] - 1) < 1e-6 and (hits.triangle[0] == 0 or accel == EMBREE)
        # A quick run is a test: it must not depend on how busy the machine is.
        slow = count >= TIMED and seconds >= 2.0
        return Outcome(int(not right or slow), 1, f"{seconds:.2f} s, triangle {hits.triangle[0]}")

    return row


def nothing_there(accel: str, count: int, seed: int = 0) -> Outcome:
    """A12: no triangle, one without area, an empty mesh, one that is not placed: no hit; and one triangle."""
    triangle, face = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32), np.array([[0, 1, 2]], np.int32)
    empty, flat, unseen, lone = (RayScene(accel) for _ in range(4))
    flat.add_instance(flat.add_mesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)))
    flat.add_instance(flat.add_mesh(triangle * np.float32([1, 0, 0]), face))
    unseen.add_mesh(triangle, face)
    lone.add_instance(lone.add_mesh(triangle, face))
    origins = np.random.default_rng(seed).uniform(0.01, 0.49, (count, 3)).astype(np.float32)
    origins[:, 2] = 1
    down = np.tile(np.float32([0, 0, -1]), (count, 1))
    failed = 0
    for scene in (empty, flat, unseen, lone):
        scene.build()
        hits, there = scene.intersect(origins, down), scene is lone
        wrong = (hits.triangle != there - 1) | (hits.instance != there - 1)
        wrong |= (hits.t != (1 if there else np.inf)) | (scene.occluded(origins, down) != there)
        failed += int(wrong.sum())
    return Outcome(failed, 4 * count)


def cases() -> Iterator[Case]:
    """A03 to A12."""
    yield Case("A03", "stack of squares, three axes", rays_on_faces, EVERY, 48, 48)
    yield Case(
        "A04",
        "default cube",
        like_brute_force(cube(), lambda count, seed: random_rays(count, 1 + seed, 3)),
        TRACED,
        200_000,
        5000,
    )
    for length in (256.0, 1024.0):
        for offset in (0.0, 1e4):
            yield Case(
                "A05", f"{length:g} long, at {offset:g}", drift(length, offset), INDICES[1:], 20_000, 500
            )
    for offset in (1e2, 1e4):
        yield Case("A06", f"ball at {offset:g}", far_grid(offset), INDICES, 100_000, 1000)
    spanning = like_brute_force(soup(400, 1.5, seed=3), lambda count, seed: random_rays(count, 2 + seed))
    yield Case("A07", "400 large triangles", spanning, INDICES, 200_000, 5000)
    for direction in ((0, 0, -1), (0, -1, 0), (1, 0, 0), (1, 1, 0), (1, -1, 1), (-1, -1, -1)):
        name = "along " + " ".join(str(part) for part in direction)
        yield Case("A08", name, in_cell_planes(direction), INDICES, 4913, 4913)
    yield Case("A09", "ball of 81920 in a field 1e4 wide", divided_over_flat, ("grid2",), TIMED, 2000)
    yield Case("A10", "needle fan of 4096", slivers_over_ball, (*INDICES, EMBREE), TIMED, 2000)
    yield Case("A11", "equal triangles", same_centre(equal_triangles), TRACED, 100_000, 5000)
    yield Case("A11", "nested triangles", same_centre(nested_triangles), TRACED, 100_000, 5000)
    yield Case("A12", "none, flat, empty, unseen, one", nothing_there, ACCELS, 1000, 1000)
