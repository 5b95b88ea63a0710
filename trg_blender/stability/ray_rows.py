"""The rows of the catalogue of stiff cases that are ray queries: what each shoots and what counts as failed.

A row takes an accelerator and a number of rays and says how many of them failed. `truth` in extended
precision (80 bits) decides where a ray is clearly inside or outside; rays nearer to an edge than its
rounding count as neither.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from .case import EMBREE, TRACED, Case, NotApplicable, Outcome, Row
from .meshes import (
    Float32,
    Mesh,
    bipyramid,
    edge_and_vertex_rays,
    icosphere,
    mesh_of,
    scene_of,
    soup,
)

Rays = tuple[Float32, Float32]
Extended = NDArray[np.longdouble]
AT_ONCE = 500_000
"""Rays of one query: more would take memory for nothing."""
NO_NEAR_END = "rays of embreex begin at 0"
BIT_BY_BIT = "compared bit by bit with brute force of the same triangle test"
LONE = (20_000, 200)
"""Lone triangles, each a scene of its own, of a full and of a quick run."""
CORNERS = 1_000_000


@dataclass(frozen=True)
class Outward:
    """Rays from inside a mesh: `edge_share` of them at its edges, the others at its vertices; or anywhere."""

    edge_share: float = 0.5
    at_random: bool = False

    def shoot(self, mesh: Mesh, count: int, seed: int) -> Rays:
        rays = edge_and_vertex_rays(mesh, count, seed, self.edge_share)
        if not self.at_random:
            return rays
        directions = np.random.default_rng(seed).normal(size=(count, 3))
        return rays[0], directions.astype(np.float32)


def closed(make: Callable[[], Mesh], outward: Outward, seed: int) -> Row:
    """Rays from inside a closed mesh that meet nothing, or that an any-hit query lets through."""

    def row(accel: str, count: int, more: int = 0) -> Outcome:
        mesh = make()
        scene, failed = scene_of(mesh, accel), 0
        for part in range(0, count, AT_ONCE):
            some = min(AT_ONCE, count - part)
            rays = outward.shoot(mesh, some, seed + 1000 * more + 7 * part)
            failed += int(((scene.intersect(*rays).triangle < 0) | ~scene.occluded(*rays)).sum())
        return Outcome(failed, count)

    return row


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


def parity(make: Callable[[], Mesh], outward: Outward) -> Row:
    """From the centre of a star-shaped mesh the surface is met once: nothing is farther than 8 ulp behind."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        if accel == EMBREE:
            raise NotApplicable(NO_NEAR_END)
        mesh, failed = make(), 0
        scene = scene_of(mesh, accel)
        for part in range(0, count, AT_ONCE):
            origins, directions = outward.shoot(mesh, min(AT_ONCE, count - part), 7 + seed + part)
            rays = (0 * origins, origins + directions)
            first = scene.intersect(*rays)
            again = scene.intersect(*rays, tmin=first.t * np.float32(1 + 8 * 2.0**-23))
            failed += int(((first.triangle < 0) | (again.triangle >= 0)).sum())
        return Outcome(failed, count)

    return row


@dataclass(frozen=True)
class Lone:
    """Rays at one triangle each: ray k at triangle k, `inside` its weights' least (negative: outside)."""

    mesh: Mesh
    origins: Float32
    directions: Float32


def exact_hits(corners: NDArray[np.floating], rays: Rays) -> tuple[Extended, Extended, Extended]:
    """t, and the weights of the second and third corner, of rays (n, 3) with the planes of the triangles
    `corners` (n, 3, 3), in extended precision."""
    o, d = (side.astype(np.longdouble) for side in rays)
    a, b, c = (corners[:, k].astype(np.longdouble) - o for k in range(3))
    edges = np.stack([(d * np.cross(x, y)).sum(1) for x, y in ((b, c), (c, a), (a, b))])
    normal = np.cross(b - a, c - a)
    weights = edges / edges.sum(0)
    return (normal * a).sum(1) / (normal * d).sum(1), weights[1], weights[2]


def edge_margin(lone: Lone) -> tuple[Extended, Extended]:
    """For every ray, the least of the exact barycentric weights of its triangle, and the exact t."""
    corners = lone.mesh.vertices[lone.mesh.triangles]
    t, u, v = exact_hits(corners, (lone.origins, lone.directions))
    return np.minimum(np.minimum(u, v), 1 - u - v), t


def lone_row(make: Callable[[int, int], Lone], t_ulp: float) -> Row:
    """Rays whose hit or miss is not the exact one, or whose t is farther than `t_ulp` from it."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        lone = make(min(count, 20_000), seed)
        weight, t = edge_margin(lone)
        hits = np.array([lone_hit(lone, k, accel) for k in range(len(weight))])
        met, inside = np.isfinite(hits), weight > 0
        with np.errstate(invalid="ignore"):
            off = np.abs(hits - t) > t_ulp * np.spacing(np.abs(t).astype(np.float32))
        wrong = (np.abs(weight) >= 1e-9) & ((met != inside) | (met & off))
        return Outcome(int(wrong.sum()), len(weight))

    return row


def lone_hit(lone: Lone, k: int, accel: str) -> float:
    """t of ray k at triangle k, infinite for a miss."""
    corners = Mesh(lone.mesh.vertices[lone.mesh.triangles[k]], np.array([[0, 1, 2]], np.int32))
    hits = scene_of(corners, accel).intersect(lone.origins[k : k + 1], lone.directions[k : k + 1])
    return float(hits.t[0])


def slivers(aspect: float) -> Callable[[int, int], Lone]:
    def make(count: int, seed: int) -> Lone:
        rng = np.random.default_rng(11 + 1000 * seed)
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


def grazing(angle: float) -> Callable[[int, int], Lone]:
    def make(count: int, seed: int) -> Lone:
        rng = np.random.default_rng(12 + 1000 * seed)
        corners = np.zeros((count, 3, 3))
        corners[:, :, :2] = rng.normal(size=(count, 3, 2))
        lone = aimed(corners, rng, 1.0)
        targets = lone.origins.astype(np.float64) + lone.directions
        turn = rng.uniform(0, 2 * np.pi, count)
        offset = 3 * np.stack([np.cos(turn), np.sin(turn), np.full(count, angle)], axis=1)
        origins = (targets + offset).astype(np.float32)
        return Lone(lone.mesh, origins, (targets - origins).astype(np.float32))

    return make


def far_eye(distance: float) -> Callable[[int, int], Lone]:
    def make(count: int, seed: int) -> Lone:
        rng = np.random.default_rng(13 + 1000 * seed)
        return aimed(rng.normal(size=(count, 3, 3)), rng, distance)

    return make


def like_brute_force(mesh: Mesh, shoot: Callable[[int, int], Rays]) -> Row:
    """Rays whose answer differs by a bit from that of trying every triangle, or from that of any hit."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        if accel == EMBREE:
            raise NotApplicable(BIT_BY_BIT)
        every, scene = scene_of(mesh, "none"), scene_of(mesh, accel)
        failed = 0
        for part in range(0, count, AT_ONCE):
            rays = shoot(min(AT_ONCE, count - part), seed + 7 * part)
            expected, hits = every.intersect(*rays), scene.intersect(*rays)
            wrong = (hits.t != expected.t) | (hits.u != expected.u) | (hits.v != expected.v)
            wrong |= (hits.triangle != expected.triangle) | (hits.instance != expected.instance)
            failed += int((wrong | (scene.occluded(*rays) != (expected.triangle >= 0))).sum())
        return Outcome(failed, count)

    return row


def corner_rays(mesh: Mesh, count: int, seed: int) -> Rays:
    """Rays within 1e-6 of vertices, from three units away."""
    rng = np.random.default_rng(14 + seed)
    corner = mesh.vertices[rng.integers(len(mesh.vertices), size=count)].astype(np.float64)
    origins = (corner + rng.normal(size=corner.shape) * 3).astype(np.float32)
    return origins, (corner - origins + 1e-6 * rng.normal(size=corner.shape)).astype(np.float32)


def box_corner(offset: float, flat: bool) -> Row:
    base = soup(400, 0.02, seed=15)
    vertices = base.vertices.astype(np.float64)
    if flat:
        vertices[:, 2] = np.repeat(vertices[::3, 2], 3)
    mesh = mesh_of(vertices + offset, base.triangles)
    return like_brute_force(mesh, partial(corner_rays, mesh))


def cases() -> Iterator[Case]:
    """G01 to G03, G05 to G07, G11, G12, G17, A01, A02."""
    edges, vertices, anywhere = Outward(1.0), Outward(0.0), Outward(at_random=True)
    for scale in (1e-6, 1e-3, 1.0, 1e3, 1e6):
        make = partial(icosphere, 5, scale)
        yield Case("G01", f"scale {scale:g}", closed(make, edges, 1))
        yield Case("G02", f"scale {scale:g}", closed(make, vertices, 1))
    for offset in (1e1, 1e2, 1e3, 1e4, 1e5):
        make = partial(icosphere, 3 if offset < 1e5 else 2, 1.0, offset)
        yield Case("G03", f"at {offset:g}", closed(make, anywhere, 2))
        yield Case("G03", f"at {offset:g}, edges and vertices", closed(make, Outward(), 2))
    for what, outward in (("edges", edges), ("vertices", vertices), ("anywhere", anywhere)):
        yield Case("G05", what, closed(spiky, outward, 3))
    for radius in (1.0, 1e-3):
        yield Case("G06", f"radius {radius:g}", closed(partial(bipyramid, 2048, radius), Outward(), 4))
    for aspect in (1e3, 1e5, 1e7):
        yield Case("G07", f"aspect {aspect:g}", lone_row(slivers(aspect), 4), TRACED, *LONE)
    for angle in (1e-3, 1e-5):
        yield Case("G11", f"angle {angle:g}", lone_row(grazing(angle), 4), TRACED, *LONE)
    for distance in (1e3, 1e6):
        yield Case("G12", f"from {distance:g}", lone_row(far_eye(distance), 4), TRACED, *LONE)
    for what, outward in (("edges", edges), ("vertices", vertices)):
        yield Case("G17", f"ball, {what}", parity(partial(icosphere, 5), outward))
        yield Case("G17", f"spiky ball, {what}", parity(spiky, outward))
    for offset in (0.0, 1e2, 1e4, 1e6):
        yield Case("A01", f"at {offset:g}", box_corner(offset, flat=False), TRACED, CORNERS, 2000)
        yield Case("A02", f"at {offset:g}", box_corner(offset, flat=True), TRACED, CORNERS, 2000)
