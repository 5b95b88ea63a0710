"""Media with priorities in the reference renderer: where several overlap, one rules, and boundaries of the
others are not there (Schmidt and Budge 2002). Boundaries within the reach of rounding count as one.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .reference_math import dot
from .reference_media import Stack, cross_surface, no_media, ruling_media
from .reference_scene import FAR, MISS, Hits, Rays, TracedScene, Triangles, refine_hits
from .reference_shapes import meet_shape, shape_points
from .reference_sheets import beyond, pick
from .reference_surface import MaterialTable, Surface
from .scene_arrays import Float64

MOST_AROUND = 4096
"""So many surfaces are looked at to find what a camera stands in."""


@dataclass(frozen=True, slots=True)
class Part:
    """The surfaces with priorities of one copy of a mesh."""

    copy: int
    rows: NDArray[np.int64]
    """of the scene's triangles; one for a shape"""
    alone: Triangles
    """those rows"""
    embree: Any
    """of those triangles; None for a shape"""


@dataclass(frozen=True, slots=True)
class Nested:
    traced: TracedScene
    table: MaterialTable
    parts: tuple[Part, ...]


@dataclass(slots=True)
class Boundaries:
    """Where n paths pass from one ruling medium into another."""

    ratio: Float64
    """(n,) index behind over index before; 0 where there is none"""
    behind: Stack
    slack: Float64
    """(n,) how far off surfaces lie that count as this one"""


def no_boundaries(count: int) -> Boundaries:
    return Boundaries(np.zeros(count), no_media(count), np.zeros(count))


def build_nested(traced: TracedScene, table: MaterialTable) -> Nested | None:
    """None where no material has a priority."""
    triangles = traced.triangles
    wanted = table.columns["priority"][triangles.material] > 0.0 if len(triangles.material) else np.zeros(0)
    if not np.any(wanted):
        return None
    parts = []
    for copy in np.unique(triangles.copy[wanted]):
        rows = np.flatnonzero(wanted & (triangles.copy == copy))
        embree = None if rows[0] >= triangles.first_shape else build_embree(triangles, rows)
        parts.append(Part(int(copy), rows, take_triangles(triangles, rows), embree))
    return Nested(traced, table, tuple(parts))


def take_triangles(triangles: Triangles, rows: NDArray[np.int64]) -> Triangles:
    taken = (getattr(triangles, one.name)[rows] for one in fields(triangles) if one.name != "shapes")
    return Triangles(*taken)


def build_embree(triangles: Triangles, rows: NDArray[np.int64]) -> Any:
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    embree = EmbreeScene(robust=True)
    corners = np.ascontiguousarray(triangles.corners[rows].reshape(-1, 3), dtype=np.float32)
    TriangleMesh(embree, corners, np.arange(3 * len(rows), dtype=np.int32).reshape(-1, 3))
    return embree


def meet_part(nested: Nested, part: Part, rays: Rays) -> Hits:
    """The nearest hits on one copy."""
    triangles = nested.traced.triangles
    if part.embree is None:
        found = meet_shape(
            triangles.shapes[part.rows[0] - triangles.first_shape], rays.origin, rays.direction, rays.far
        )
        row = np.where(np.isfinite(found.t), part.rows[0], MISS)
        return Hits(row, found.t, found.u, found.v)
    alone = TracedScene(part.alone, part.embree)
    near = alone.intersect(rays)
    return refine_hits(triangles, rays, np.where(near.triangle == MISS, MISS, part.rows[near.triangle]))


def outside_at(nested: Nested, rays: Rays, hits: Hits) -> NDArray[np.bool_]:
    """(n,) whether rays meet the outer sides."""
    triangles = nested.traced.triangles
    normal = triangles.outside[hits.triangle].copy()
    for row in np.unique(hits.triangle[hits.triangle >= triangles.first_shape]):
        here = hits.triangle == row
        shape = triangles.shapes[row - triangles.first_shape]
        normal[here] = shape_points(shape, hits.u[here], hits.v[here]).outside
    return dot(normal, rays.direction) <= 0.0


def cross_one(
    nested: Nested, media: tuple[Stack, Stack], row: NDArray[np.int64], enters: NDArray[np.bool_]
) -> tuple[Stack, Stack]:
    """Media before a surface and behind all surfaces so far, with one more of material `row` gone through.
    What is left without having been entered was there from the beginning."""
    before, behind = media
    unknown = ~enters & ~np.any(behind == row[:, None], axis=1)
    told = np.ones(len(row), dtype=bool)
    before = np.where(unknown[:, None], cross_surface(nested.table, before, row, told), before)
    behind = np.where(unknown[:, None], cross_surface(nested.table, behind, row, told), behind)
    return before, cross_surface(nested.table, behind, row, enters)


def meet_boundaries(
    nested: Nested, paths: tuple[Rays, Stack], hits: Hits, boundary: Boundaries
) -> tuple[Hits, Stack, NDArray[np.bool_]]:
    """One step of paths (rays and media) over the surfaces at `hits`: where the same medium rules on both
    sides the hit becomes the one behind, and the last of what is returned is true; elsewhere `boundary`
    is written."""
    rays, media = paths
    material = nested.traced.triangles.material
    priority = np.append(nested.table.columns["priority"], 0.0)
    wanted = (hits.triangle != MISS) & (
        priority[np.where(hits.triangle == MISS, -1, material[hits.triangle])] > 0.0
    )
    rows = np.flatnonzero(wanted & (boundary.ratio == 0.0))
    passed = np.zeros(len(hits.t), dtype=bool)
    if len(rows) == 0:
        return hits, media, passed
    here = pick(hits, rows)
    ray = Rays(rays.origin[rows], rays.direction[rows], rays.far[rows])
    pile = pile_up(nested, ray, here, media[rows])
    before, after = ruling_media(nested.table, pile.before), ruling_media(nested.table, pile.behind)
    same = before == after
    media = media.copy()
    media[rows] = np.where(same[:, None], pile.behind, pile.before)
    passed[rows[same]] = True
    index = np.append(nested.table.columns["ior"], 1.0)
    boundary.ratio[rows] = np.where(same, 0.0, index[after] / index[before])
    boundary.behind[rows], boundary.slack[rows] = pile.behind, pile.step
    owned = own_surface(nested, pile.surfaces, (before, after, priority))
    hits = put_hits(hits, rows[~same], pick(owned, np.flatnonzero(~same)))
    return beyond(nested.traced, rays, hits, rows[same]), media, passed


@dataclass(frozen=True, slots=True)
class Pile:
    """Surfaces that lie upon one another, at n hits."""

    before: Stack
    behind: Stack
    surfaces: list[Hits]
    step: Float64


def pile_up(nested: Nested, rays: Rays, hits: Hits, media: Stack) -> Pile:
    triangles = nested.traced.triangles
    place = rays.origin + hits.t[:, None] * rays.direction
    step = 1e-6 + 4e-6 * np.abs(place).max(axis=1)
    start = np.maximum(hits.t - step, 0.0)
    window = Rays(rays.origin + start[:, None] * rays.direction, rays.direction, hits.t + step - start)
    stacks = cross_one(
        nested, (media, media), triangles.material[hits.triangle], outside_at(nested, rays, hits)
    )
    surfaces = [hits]
    for part in nested.parts:
        found = meet_part(nested, part, window)
        other = (
            (found.triangle != MISS) & (triangles.copy[hits.triangle] != part.copy) & (found.t <= window.far)
        )
        if not other.any():
            continue
        enters = outside_at(nested, rays, found)
        crossed = cross_one(nested, stacks, triangles.material[found.triangle], enters)
        stacks = (
            np.where(other[:, None], crossed[0], stacks[0]),
            np.where(other[:, None], crossed[1], stacks[1]),
        )
        triangle = np.where(other, found.triangle, MISS)
        surfaces.append(Hits(triangle, found.t + start, found.u, found.v))
    return Pile(*stacks, surfaces, step)


def own_surface(
    nested: Nested, surfaces: list[Hits], rulers: tuple[NDArray[np.int64], NDArray[np.int64], Float64]
) -> Hits:
    """Of the surfaces in a pile that of the stronger medium."""
    before, after, priority = rulers
    material = np.append(nested.traced.triangles.material, -2)
    rows = [np.where(one.triangle == MISS, -2, material[one.triangle]) for one in surfaces]
    has_after = np.any([row == after for row in rows], axis=0)
    more = priority[after] - priority[before]
    owner = np.where((more > 0.0) | ((more == 0.0) & has_after), after, before)
    chosen, settled = surfaces[0], rows[0] == owner
    for one, row in zip(surfaces[1:], rows[1:], strict=True):
        taken = ~settled & (row == owner)
        settled |= taken
        chosen = put_hits(chosen, np.flatnonzero(taken), pick(one, np.flatnonzero(taken)))
    return chosen


def put_hits(hits: Hits, rows: NDArray[np.int64], other: Hits) -> Hits:
    """`hits` with those in `rows` replaced."""
    triangle, t, u, v = hits.triangle.copy(), hits.t.copy(), hits.u.copy(), hits.v.copy()
    triangle[rows], t[rows], u[rows], v[rows] = other.triangle, other.t, other.u, other.v
    return Hits(triangle, t, u, v)


def face_boundaries(surface: Surface, boundary: Boundaries, met: NDArray[np.bool_]) -> Surface:
    """`surface`, at those `met` (n,), with what it divides."""
    epsilon = np.maximum(surface.epsilon, 1.1 * np.where(boundary.ratio > 0.0, boundary.slack, 0.0)[met])
    return replace(surface, ratio=boundary.ratio[met], behind=boundary.behind[met], epsilon=epsilon)


def media_around(nested: Nested, origin: Float64) -> NDArray[np.int64]:
    """(MOST_MEDIA,) what a camera at `origin` stands in: media left on the way up without having been
    entered, the nearest last."""
    rays = Rays(np.asarray(origin, float)[None], np.array([[0.0, 0.0, 1.0]]), np.array([FAR]))
    entered, around = no_media(1), []
    hits = nested.traced.intersect(rays)
    for _ in range(MOST_AROUND):
        if hits.triangle[0] == MISS:
            break
        row = nested.traced.triangles.material[hits.triangle]
        enters = outside_at(nested, rays, hits)
        if not enters[0] and not np.any(entered == row):
            around.append(row)
        entered = cross_surface(nested.table, entered, row, enters)
        hits = beyond(nested.traced, rays, hits, np.array([0]))
    media = no_media(1)
    for row in reversed(around):
        media = cross_surface(nested.table, media, row, np.array([True]))
    return media.reshape(-1)
