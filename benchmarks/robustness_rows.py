"""The rows of the catalogue of stiff cases that are ray queries: what each shoots and what counts as failed.

A row takes an accelerator and a number of rays and says how many of them failed. `truth` in extended
precision (80 bits) decides where a ray is clearly inside or outside; rays nearer to an edge than its
rounding count as neither.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tests.native.meshes import (
    Float32,
    Mesh,
    bipyramid,
    edge_and_vertex_rays,
    icosphere,
    mesh_of,
    same_hits,
    scene_of,
    soup,
)

Rays = tuple[Float32, Float32]
Extended = NDArray[np.longdouble]


@dataclass(frozen=True)
class Outcome:
    failed: int
    total: int


Row = Callable[[str, int], Outcome]


def leaks(mesh: Mesh, rays: Rays, accel: str) -> Outcome:
    """Rays from inside a closed mesh that meet nothing, or that an any-hit query lets through."""
    scene = scene_of(mesh, accel)
    missed = (scene.intersect(*rays).triangle < 0) | ~scene.occluded(*rays)
    return Outcome(int(missed.sum()), len(missed))


def random_inner_rays(mesh: Mesh, count: int, seed: int) -> Rays:
    rng = np.random.default_rng(seed)
    origins, _ = edge_and_vertex_rays(mesh, count, seed)
    return origins, rng.normal(size=(count, 3)).astype(np.float32)


def spiky(seed: int = 1, steps: int = 64) -> Mesh:
    """A closed sphere of steps x steps quads whose corners lie at random radii of 1 to 6."""
    rng = np.random.default_rng(seed)
    polar, around = np.linspace(0, np.pi, steps + 1)[1:-1], np.linspace(0, 2 * np.pi, steps, endpoint=False)
    t, p = (a.ravel() for a in np.meshgrid(polar, around, indexing="ij"))
    directions = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=1)
    poles = np.array([[0, 0, 1.0], [0, 0, -1.0]])
    vertices = np.concatenate([directions, poles]) * rng.uniform(1, 6, (len(directions) + 2, 1))
    k, after = np.arange(steps), (np.arange(steps) + 1) % steps
    rows = [np.stack([k, after, np.full(steps, len(directions))], axis=1)]
    for ring in range(steps - 2):
        a, b = ring * steps + k, ring * steps + after
        rows += [np.stack([a, a + steps, b], axis=1), np.stack([b, a + steps, b + steps], axis=1)]
    last = (steps - 2) * steps
    rows.append(np.stack([last + after, last + k, np.full(steps, len(directions) + 1)], axis=1))
    return mesh_of(vertices, np.concatenate(rows))


def closed(mesh: Mesh, seed: int) -> Row:
    return lambda accel, count: leaks(mesh, edge_and_vertex_rays(mesh, count, seed), accel)


def far_random(mesh: Mesh, seed: int) -> Row:
    return lambda accel, count: leaks(mesh, random_inner_rays(mesh, count, seed), accel)


def parity(mesh: Mesh) -> Row:
    """From the centre of a star-shaped mesh the surface is met once: nothing is farther than 8 ulp behind."""

    def row(accel: str, count: int) -> Outcome:
        origins, directions = edge_and_vertex_rays(mesh, count, 7)
        rays = (0 * origins, origins + directions)
        scene = scene_of(mesh, accel)
        first = scene.intersect(*rays)
        behind = first.t * np.float32(1 + 8 * 2.0**-23)
        again = scene.intersect(*rays, tmin=behind)
        return Outcome(int(((first.triangle < 0) | (again.triangle >= 0)).sum()), count)

    return row


@dataclass(frozen=True)
class Lone:
    """Rays at one triangle each: ray k at triangle k, `inside` its weights' least (negative: outside)."""

    mesh: Mesh
    origins: Float32
    directions: Float32


def edge_margin(lone: Lone) -> tuple[Extended, Extended]:
    """For every ray, the least of the exact barycentric weights of its triangle, and the exact t."""
    corners = lone.mesh.vertices[lone.mesh.triangles].astype(np.longdouble)
    o, d = lone.origins.astype(np.longdouble), lone.directions.astype(np.longdouble)
    a, b, c = (corners[:, k] - o for k in range(3))
    edges = np.stack([(d * np.cross(x, y)).sum(1) for x, y in ((b, c), (c, a), (a, b))])
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    t = (normal * a).sum(1) / (normal * d).sum(1)
    return (edges / edges.sum(0)).min(0), t


def lone_row(make: Callable[[int], Lone], t_ulp: float) -> Row:
    """One scene for each thousand of triangles, spread so far apart that no ray meets two."""

    def row(accel: str, count: int) -> Outcome:
        lone = make(min(count, 20_000))
        weight, t = edge_margin(lone)
        failed = 0
        for k in range(0, len(weight), 500):
            part = slice(k, k + 500)
            failed += lone_failures(lone, part, accel, weight[part], t[part], t_ulp)
        return Outcome(failed, len(weight))

    return row


def lone_failures(lone: Lone, part: slice, accel: str, weight: Extended, t: Extended, t_ulp: float) -> int:
    failed = 0
    for triangle, origin, direction, w, true in zip(
        lone.mesh.triangles[part], lone.origins[part], lone.directions[part], weight, t, strict=True
    ):
        corners = Mesh(lone.mesh.vertices[triangle], np.array([[0, 1, 2]], np.int32))
        hits = scene_of(corners, accel).intersect(origin[None], direction[None])
        if abs(w) < 1e-9:
            continue
        met = hits.triangle[0] == 0
        off = (
            abs(np.longdouble(hits.t[0]) - true) > t_ulp * np.spacing(np.float32(abs(true))) if met else False
        )
        failed += int(met != (w > 0) or off)
    return failed


def slivers(aspect: float) -> Callable[[int], Lone]:
    def make(count: int) -> Lone:
        rng = np.random.default_rng(11)
        a = rng.normal(size=(count, 3))
        along = rng.normal(size=(count, 3))
        across = np.cross(along, rng.normal(size=(count, 3)))
        across /= np.linalg.norm(across, axis=1, keepdims=True) * aspect
        corners = np.stack([a, a + along, a + rng.random((count, 1)) * along + across], axis=1)
        return aimed(corners, rng, 5.0)

    return make


def aimed(corners: NDArray[np.float64], rng: np.random.Generator, distance: float) -> Lone:
    """Rays from about `distance` away at even points of the triangles."""
    count = len(corners)
    mesh = mesh_of(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))
    weights = rng.dirichlet([1, 1, 1], count)[:, :, None]
    targets = (mesh.vertices.reshape(-1, 3, 3).astype(np.float64) * weights).sum(1)
    origins = (targets + distance * rng.normal(size=(count, 3))).astype(np.float32)
    return Lone(mesh, origins, (targets - origins).astype(np.float32))


def grazing(angle: float) -> Callable[[int], Lone]:
    def make(count: int) -> Lone:
        rng = np.random.default_rng(12)
        corners = np.zeros((count, 3, 3))
        corners[:, :, :2] = rng.normal(size=(count, 3, 2))
        lone = aimed(corners, rng, 1.0)
        targets = lone.origins.astype(np.float64) + lone.directions
        turn = rng.uniform(0, 2 * np.pi, count)
        offset = 3 * np.stack([np.cos(turn), np.sin(turn), np.full(count, angle)], axis=1)
        origins = (targets + offset).astype(np.float32)
        return Lone(lone.mesh, origins, (targets - origins).astype(np.float32))

    return make


def far_eye(distance: float) -> Callable[[int], Lone]:
    def make(count: int) -> Lone:
        rng = np.random.default_rng(13)
        return aimed(rng.normal(size=(count, 3, 3)), rng, distance)

    return make


def like_brute_force(mesh: Mesh, rays: Rays) -> Row:
    """Rays whose answer differs by a bit from that of trying every triangle."""

    def row(accel: str, count: int) -> Outcome:
        some = (rays[0][:count], rays[1][:count])
        expected = scene_of(mesh, "none").intersect(*some)
        hits = scene_of(mesh, accel).intersect(*some)
        if same_hits(hits, expected):
            return Outcome(0, len(some[0]))
        wrong = (hits.t != expected.t) | (hits.triangle != expected.triangle)
        return Outcome(max(1, int(wrong.sum())), len(some[0]))

    return row


def corner_rays(mesh: Mesh, count: int, offset: float) -> Rays:
    """Rays within 1e-6 of vertices, from three units away."""
    rng = np.random.default_rng(14)
    corner = mesh.vertices[rng.integers(len(mesh.vertices), size=count)].astype(np.float64)
    origins = (corner + rng.normal(size=corner.shape) * 3).astype(np.float32)
    return origins, (corner - origins + 1e-6 * rng.normal(size=corner.shape)).astype(np.float32)


def box_corner(offset: float, flat: bool) -> Row:
    base = soup(400, 0.02, seed=15)
    vertices = base.vertices.astype(np.float64)
    if flat:
        vertices[:, 2] = np.repeat(vertices[::3, 2], 3)
    mesh = mesh_of(vertices + offset, base.triangles)
    return like_brute_force(mesh, corner_rays(mesh, 200_000, offset))


def rows() -> Iterator[tuple[str, Row]]:
    """Name and row, in the order of the catalogue."""
    for scale in (1e-6, 1e-3, 1.0, 1e3, 1e6):
        yield f"G01 G02 edge-aim, vertex-aim, scale {scale:g}", closed(icosphere(5, scale), 1)
    for offset in (1e1, 1e2, 1e3, 1e4, 1e5):
        mesh = icosphere(3 if offset < 1e5 else 2, 1.0, offset)
        yield f"G03 random-far, {offset:g}", far_random(mesh, 2)
        yield f"G03 edges and vertices, {offset:g}", closed(mesh, 2)
    yield "G05 spiky", closed(spiky(), 3)
    for radius in (1.0, 1e-3):
        yield f"G06 needle-fan, radius {radius:g}", closed(bipyramid(2048, radius), 4)
    for aspect in (1e3, 1e5, 1e7):
        yield f"G07 sliver, {aspect:g}", lone_row(slivers(aspect), 4)
    for angle in (1e-3, 1e-5):
        yield f"G11 grazing, {angle:g}", lone_row(grazing(angle), 4)
    for distance in (1e3, 1e6):
        yield f"G12 far-eye, {distance:g}", lone_row(far_eye(distance), 4)
    yield "G17 parity, icosphere", parity(icosphere(4))
    yield "G17 parity, spiky", parity(spiky())
    for offset in (0.0, 1e2, 1e4, 1e6):
        yield f"A01 box-corner, {offset:g}", box_corner(offset, flat=False)
        yield f"A02 flat-box, {offset:g}", box_corner(offset, flat=True)
