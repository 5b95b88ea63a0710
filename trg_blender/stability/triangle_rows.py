"""Rows of triangles that are tiny, huge, far or garbage, and of rays that are none: G04, G08 to G16."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np

from ..engine.native import RayScene
from .case import EMBREE, EVERY, Case, NotApplicable, Outcome, Row
from .meshes import (
    ACCELS,
    Float32,
    edge_and_vertex_rays,
    icosphere,
    mesh_of,
    random_rays,
    same_hits,
    scene_of,
)

SETS = ("baseline", "avx2", "avx512")


def instruction_sets(accel: str, count: int, seed: int = 0) -> Outcome:
    """G04: rays that leak with one instruction set, or whose distance differs between two."""
    mesh = icosphere(5)
    rays = edge_and_vertex_rays(mesh, count, 1 + seed)
    found, failed = {}, np.zeros(count, bool)
    for name in SETS:
        try:
            scene = RayScene(accel, instruction_set=name)
        except ValueError:
            continue
        scene.add_instance(scene.add_mesh(mesh.vertices, mesh.triangles))
        scene.build()
        hits = scene.intersect(*rays)
        failed |= (hits.triangle < 0) | ~scene.occluded(*rays)
        found[name] = hits.t
    if len(found) < 2:
        raise NotApplicable("this machine has one instruction set")
    first = next(iter(found.values()))
    for t in found.values():
        failed |= np.abs(t - first) > 1e-6 * first
    return Outcome(int(failed.sum()), count, f"{int(failed.sum())} of {count} over {', '.join(found)}")


def sized(scale: float) -> Row:
    """G08, G09: rays at a triangle of edge `scale`, from as far; weights to 1e-6, t to 4 ulp."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]) * scale
        rng = np.random.default_rng(4 + seed)
        weights = rng.dirichlet([2, 2, 2], count)
        origins = (weights @ corners + np.array([0, 0, scale])).astype(np.float32)
        down = np.tile(np.float32([0, 0, -1]), (count, 1))
        hits = scene_of(mesh_of(corners, np.array([[0, 1, 2]])), accel).intersect(origins, down)
        failed = (hits.triangle < 0) | ~(np.abs(hits.t - scale) <= 4 * np.spacing(np.float32(scale)))
        off = np.maximum(np.abs(hits.u - weights[:, 1]), np.abs(hits.v - weights[:, 2]))
        return Outcome(int((failed | (off > 1e-6)).sum()), count)

    return row


def too_large(accel: str, count: int, seed: int = 0) -> Outcome:
    """G09: triangles above 1e18 are left out and counted, and the others of the mesh are hit."""
    if accel == EMBREE:
        raise NotApplicable("what a library leaves out is its own affair")
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1.8e18, 0, 0], [0, 3e38, 0]], np.float32)
    scene = RayScene(accel)
    mesh = scene.add_mesh(vertices, np.array([[0, 1, 2], [0, 3, 2], [0, 1, 4]], np.int32))
    scene.add_instance(mesh)
    left_out = scene.build().degenerate_triangles
    origins = np.random.default_rng(seed).uniform(0.01, 0.49, (count, 3)).astype(np.float32)
    origins[:, 2] = 1
    hits = scene.intersect(origins, np.tile(np.float32([0, 0, -1]), (count, 1)))
    failed = count if left_out != 2 else int((hits.triangle != 0).sum())
    return Outcome(failed, count, f"{left_out} of 2 left out, {failed} of {count} rays wrong")


def direction_length(length: float) -> Row:
    """G10: rays from the middle of a ball whose directions are so long."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        directions = np.random.default_rng(5 + seed).normal(size=(count, 3))
        directions *= length / np.linalg.norm(directions, axis=1, keepdims=True)
        given = directions.astype(np.float32)
        hits = scene_of(icosphere(3), accel).intersect(np.zeros((count, 3), np.float32), given)
        distance = hits.t.astype(np.float64) * np.linalg.norm(given.astype(np.float64), axis=1)
        return Outcome(int((~((distance > 0.98) & (distance < 1.0001))).sum()), count)

    return row


def plain(width: float) -> Row:
    """G13: two triangles `width` wide seen from 1.7 above, down to a slope of 2 / width; t to 1e-6."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * width
        scene = scene_of(mesh_of(corners, np.array([[0, 1, 2], [0, 2, 3]])), accel)
        rng = np.random.default_rng(seed)
        slopes = np.exp(rng.uniform(np.log(2.0 / width), np.log(1e-2), count))
        turn = rng.uniform(0, 2 * np.pi, count)
        directions = np.stack([np.cos(turn), np.sin(turn), -3 * slopes], axis=1).astype(np.float32)
        hits = scene.intersect(np.tile(np.float32([0, 0, 1.7]), (count, 1)), directions)
        exact = float(np.float32(1.7)) / -directions[:, 2].astype(np.float64)
        return Outcome(int((~(np.abs(hits.t / exact - 1) <= 1e-6)).sum()), count)

    return row


def garbage(accel: str, count: int, seed: int = 0) -> Outcome:
    """G15: a ball with 1200 triangles that are none answers bit by bit as the clean ball."""
    clean = icosphere(3)
    first = len(clean.vertices)
    bad = np.array([[np.nan, 0, 0], [np.inf, 0, 0], [-np.inf, 1, 1], [2e18, 0, 0], [0, 0, 0], [0.1, 0, 0]])
    vertices = np.concatenate([clean.vertices, bad.astype(np.float32)])
    none = [(0, 1, first + k) for k in range(4)] + [(0, 0, 1), (first + 4, first + 4, first + 5)]
    triangles = np.concatenate([clean.triangles, np.array(none * 200, np.int32)])
    rays = random_rays(count, 6 + seed, 1)
    dirty = scene_of(mesh_of(vertices, triangles), accel)
    hits, expected = dirty.intersect(*rays), scene_of(clean, accel).intersect(*rays)
    wrong = int(((hits.t != expected.t) | (hits.triangle != expected.triangle)).sum())
    if accel == EMBREE:
        return Outcome(wrong, count)
    counted = dirty.build().degenerate_triangles
    failed = count if counted != 1200 else max(wrong, int(not same_hits(hits, expected)))
    return Outcome(failed, count, f"{wrong} of {count} rays differ, {counted} of 1200 counted")


def bad_rays(count: int, value: float) -> Iterator[tuple[Float32, ...]]:
    """Origins, directions, near and far ends with `value` in one of them where that makes no sense."""
    origins, directions = np.zeros((count, 3), np.float32), np.tile(np.float32([0.3, 0.4, 0.5]), (count, 1))
    ends = np.zeros(count, np.float32), np.full(count, np.inf, np.float32)
    sensible = {2: -np.inf, 3: np.inf}
    arrays = (origins, directions, *ends)
    for k, array in enumerate(arrays):
        if sensible.get(k) == value:
            continue
        bad = array.copy()
        bad[..., 0] = value
        if array.ndim == 1:
            bad[:] = value
        yield (*arrays[:k], bad, *arrays[k + 1 :])
    yield origins, 0 * directions, *ends


def rays_that_are_none(accel: str, count: int, seed: int = 0) -> Outcome:
    """G16: such rays meet nothing, in at most 1.1 times the time of rays that miss."""
    if accel == EMBREE:
        raise NotApplicable("rays of embreex have neither near nor far end")
    scene = scene_of(icosphere(5), accel)
    failed = total = 0
    slowest = 0.0
    misses = np.full((count, 3), 3, np.float32), np.full((count, 3), 1, np.float32)
    miss = least_seconds(scene, misses)
    for value in (np.nan, np.inf, -np.inf):
        for rays in bad_rays(count, value):
            failed += int(((scene.intersect(*rays).triangle >= 0) | scene.occluded(*rays)).sum())
            slowest = max(slowest, least_seconds(scene, rays))
            total += count
    # A few thousand rays take less than the clock can tell.
    slow = count >= 50_000 and slowest > 1.1 * miss
    return Outcome(failed + slow, total, f"{failed} of {total} met, {slowest / miss:.2f} times a miss")


def least_seconds(scene: RayScene, rays: tuple[Float32, ...]) -> float:
    """Of three tries on one thread."""
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        scene.intersect(*rays, threads=1)
        seconds.append(time.perf_counter() - start)
    return min(seconds)


def cases() -> Iterator[Case]:
    """G04, G08 to G10, G13, G15, G16."""
    yield Case("G04", "edges and vertices", instruction_sets, ACCELS[1:])
    for scale in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15):
        yield Case("G08", f"edge {scale:g}", sized(scale), EVERY, 100_000, 1000)
    for scale in (1e6, 1e9, 1e12, 1e15):
        yield Case("G09", f"edge {scale:g}", sized(scale), EVERY, 100_000, 1000)
    yield Case("G09", "above 1e18", too_large, ACCELS, 100_000, 1000)
    for length in (1e-37, 1e-20, 1e-15, 1e15, 1e30):
        yield Case("G10", f"length {length:g}", direction_length(length), EVERY, 100_000, 1000)
    for width in (1e4, 1e6, 1e8):
        yield Case("G13", f"two triangles, {width:g} wide", plain(width), EVERY, 512 * 512, 2000)
    yield Case("G15", "1200 in a ball", garbage, EVERY, 100_000, 2000)
    yield Case("G16", "nan, inf, 0 everywhere", rays_that_are_none, ACCELS, 50_000, 1000)
