"""The classic integrator of the reference renderer: docs/decisions/classic.md, read aloud in numpy.

Rays wait in a queue instead of a recursion; a batch of them is traced together.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .classic_arrays import CLASSIC_FIELDS, pack_classic
from .reference_camera import CameraRays
from .reference_lights import (
    area_axes,
    attenuation,
    color_of,
    direction_of,
    has_sphere,
    position_of,
    spot_mask,
    spread_share,
)
from .reference_limits import new_limits
from .reference_math import dot
from .reference_media import (
    Stack,
    absorption_of,
    cross_surface,
    find_beginnings,
    light_left,
    no_media,
    ruling_media,
)
from .reference_nested import face_boundaries, media_around, meet_boundaries, no_boundaries
from .reference_path import ORTHOGRAPHIC, Estimate, Paths, World, collect_world, keep
from .reference_scene import FAR, MISS, Hits, Rays
from .reference_surface import Surface, build_surface
from .scene_arrays import LIGHT_KINDS, Float64, Light

CUT = 1.0 / 256.0
"""A ray all of whose weights are below is not followed."""
MOST_CROSSINGS = 256


@dataclass(frozen=True, slots=True)
class Pending:
    """Rays of one depth that wait."""

    paths: Paths
    """throughput is the weight"""
    depth: int


@dataclass(frozen=True, slots=True)
class Row:
    """Constants at n points."""

    ambient: Float64
    diffuse: Float64
    specular: Float64
    reflect: Float64
    refract: Float64
    """(n, 3) each"""
    power: Float64


def trace_classic(world: World, camera: CameraRays, max_bounces: int) -> Estimate:
    """The picture's light along each camera ray; nothing is random."""
    count = len(camera.near)
    estimate = Estimate(np.zeros((count, 3)), np.zeros(count, dtype=bool), np.zeros((count, 3)))
    table = pack_classic(world.scene).astype(np.float64)
    world = with_classic_media(world, table)
    one, limits = np.ones((count, 3)), new_limits(count)
    start = Paths(camera.rays, one, np.full(count, np.inf), np.arange(count), no_media(count), limits)
    if world.nested is not None and world.scene.camera.kind != ORTHOGRAPHIC:
        start.media[:] = media_around(world.nested, world.scene.camera.matrix[:, 3])
    queue = [Pending(start, 0)]
    estimate.rays.camera = count
    while queue:
        queue += meet(world, table, queue.pop(0), max_bounces, estimate)
    return estimate


def with_classic_media(world: World, table: Float64) -> World:
    """`world` with the classic rows' media: whatever lets light pass counts, the innermost rules unless one
    has a priority."""
    column = {name: table[:, k] for k, name in enumerate(CLASSIC_FIELDS)}
    passes = np.max([column[f"refract_{channel}"] for channel in "rgb"], axis=0) > 0.0
    columns = dict(world.materials.columns)
    for channel in "rgb":
        columns[f"absorption_{channel}"] = np.where(passes, column["decay"], 0.0)
    columns["ior"] = column["ior"]
    columns["priority"] = np.where(passes, np.maximum(columns["priority"], 1e-30), 0.0)
    materials = replace(world.materials, columns=columns)
    nested = None if world.nested is None else replace(world.nested, table=materials)
    return replace(world, materials=materials, nested=nested)


def find_there(
    world: World, rays: Rays, hits: Hits, media: Stack
) -> tuple[Hits, Stack, Surface, NDArray[np.bool_]]:
    """Of rays in `media`: the hits on surfaces that are there, what is before them, and the surfaces of
    those rays (last of what is returned) that meet one, with what lies behind in `behind`."""
    boundary = no_boundaries(len(hits.t))
    for _ in range(MOST_CROSSINGS if world.nested is not None else 0):
        assert world.nested is not None
        hits, media, passed = meet_boundaries(world.nested, (rays, media), hits, boundary)
        if not passed.any():
            break
    met = hits.triangle != MISS
    found = Hits(hits.triangle[met], hits.t[met], hits.u[met], hits.v[met])
    surface = build_surface(world.materials, found, -rays.direction[met])
    surface = face_boundaries(surface, boundary, met)
    assert surface.ratio is not None and surface.behind is not None
    media = media.copy()
    media[met] = find_beginnings(world.materials, media[met], surface)
    crossed = cross_surface(world.materials, media[met], surface.row, surface.outside)
    behind = np.where((surface.ratio > 0.0)[:, None], surface.behind, crossed)
    index = np.append(world.materials.columns["ior"], 1.0)
    here, there = (ruling_media(world.materials, stack) for stack in (media[met], behind))
    return hits, media, replace(surface, behind=behind, ratio=index[there] / index[here]), met


def meet(world: World, table: Float64, pending: Pending, deepest: int, estimate: Estimate) -> list[Pending]:
    """Adds what a batch sees where it lands; gives the rays that go on."""
    paths = pending.paths
    hits = world.traced.intersect(paths.rays)
    if pending.depth > 0:
        estimate.rays.bounce += len(paths.index)
    hits, media, surface, met = find_there(world, paths.rays, hits, paths.media)
    left = light_left(absorption_of(world.materials, media), hits.t)
    paths = replace(paths, media=media, throughput=paths.throughput * left)
    collect_world(world, paths, hits, estimate, pending.depth)
    paths, hits = keep(paths, hits, met)
    if len(paths.index) == 0:
        return []
    row = row_at(world, table, hits, surface)
    weight = paths.throughput
    if pending.depth == 0:
        estimate.hit[paths.index] = True
        estimate.normal[paths.index] = surface.ns
    ambient = row.ambient * np.asarray(world.scene.ambient, dtype=np.float64)
    np.add.at(estimate.radiance, paths.index, weight * (surface.material.emission + ambient))
    lit = replace(paths, throughput=weight)
    for light in world.scene.lights:
        add_tinted(world, table, light_rays(lit, surface, row, light), estimate)
    if pending.depth == deepest:
        return []
    return send_on(lit, surface, row, pending.depth + 1)


def row_at(world: World, table: Float64, hits: Hits, surface: Surface) -> Row:
    """The constants of each point, its base texture looked up."""
    material = world.traced.triangles.material[hits.triangle]
    column = {name: table[material, k] for k, name in enumerate(CLASSIC_FIELDS)}

    def color(name: str) -> Float64:
        return np.stack([column[f"{name}_{channel}"] for channel in "rgb"], axis=1)

    textured = world.materials.columns["base_texture"][material] >= 0
    image = surface.material.base * column["texture_share"][:, None]
    diffuse = np.where(textured[:, None], image, color("diffuse"))
    return Row(
        color("ambient"),
        diffuse,
        color("specular"),
        color("reflect"),
        color("refract"),
        column["power"],
    )


def mirror(wo: Float64, n: Float64) -> Float64:
    return 2.0 * dot(wo, n)[:, None] * n - wo


def refract(wo: Float64, n: Float64, ratio: Float64) -> tuple[Float64, NDArray[np.bool_]]:
    """Snell's law about n, and where it holds; `ratio` is the near index over the far one."""
    cosine = dot(wo, n)
    square = 1.0 - ratio * ratio * (1.0 - cosine * cosine)
    along = ratio * cosine - np.sqrt(np.maximum(square, 0.0))
    return along[:, None] * n - ratio[:, None] * wo, square >= 0.0


def send_on(paths: Paths, surface: Surface, row: Row, depth: int) -> list[Pending]:
    """The mirrored and the refracted rays that weigh enough."""
    mirrored = mirror(surface.wo, surface.ns)
    flat = dot(mirrored, surface.ng) <= 0.0
    mirrored = np.where(flat[:, None], mirror(surface.wo, surface.ng), mirrored)
    assert surface.ratio is not None and surface.behind is not None
    ratio = 1.0 / surface.ratio
    through, passes = refract(surface.wo, surface.ns, ratio)
    by_flat, passes_flat = refract(surface.wo, surface.ng, ratio)
    wrong = passes & (dot(through, surface.ng) >= 0.0)
    through = np.where(wrong[:, None], by_flat, through)
    passes = np.where(wrong, passes_flat, passes)
    through = np.where(passes[:, None], through, mirrored)
    return [
        sent
        for branch in (
            Branch(paths.throughput * row.reflect, mirrored, paths.media),
            Branch(
                paths.throughput * row.refract,
                through,
                np.where(passes[:, None], surface.behind, paths.media),
            ),
        )
        if len((sent := send(paths, surface, branch, depth)).paths.index)
    ]


@dataclass(frozen=True, slots=True)
class Branch:
    """Weights (n, 3), directions (n, 3) and media of rays that leave n points."""

    weight: Float64
    wi: Float64
    media: Stack


def send(paths: Paths, surface: Surface, branch: Branch, depth: int) -> Pending:
    """The rays of `branch` that weigh enough."""
    rows = branch.weight.max(axis=1) >= CUT
    unit = (branch.wi / np.linalg.norm(branch.wi, axis=1, keepdims=True))[rows]
    rays = Rays(surface.leave(branch.wi)[rows], unit, np.full(len(unit), FAR))
    limits = paths.limits.take(rows)
    on = Paths(rays, branch.weight[rows], paths.pdf[rows], paths.index[rows], branch.media[rows], limits)
    return Pending(on, depth)


def light_from_middle(light: Light, points: Float64) -> tuple[Float64, Float64, Float64]:
    """Unit direction, distance, and irradiance (n, 3) on a surface that faces the light's middle."""
    kind = LIGHT_KINDS[light.kind]
    color = color_of(light)
    if kind == "sun":
        count = len(points)
        return np.tile(direction_of(light), (count, 1)), np.full(count, np.inf), np.tile(color, (count, 1))
    offset = position_of(light) - points
    distance = np.linalg.norm(offset, axis=1)
    wi = offset / np.maximum(distance, 1e-300)[:, None]
    if kind in ("point", "spot"):
        fall = 1.0 / (distance * distance) if has_sphere(light) else attenuation(light, distance)
        return wi, distance, (fall * spot_mask(light, -wi))[:, None] * color
    cosine = np.maximum(-wi @ direction_of(light), 0.0)
    strength = area_axes(light)[2] * cosine * spread_share(light, cosine)
    return wi, distance, (strength / (distance * distance))[:, None] * color


def light_rays(paths: Paths, surface: Surface, row: Row, light: Light) -> Paths:
    """Shadow rays to one light, with what arrives of it by Phong's model if nothing stands between."""
    wi, distance, irradiance = light_from_middle(light, surface.position)
    cosine = dot(surface.ns, wi)
    along = np.maximum(dot(mirror(surface.wo, surface.ns), wi), 0.0)
    value = row.diffuse * cosine[:, None] + row.specular * (along**row.power)[:, None]
    facing = (cosine > 0.0) & (dot(surface.ng, wi) > 0.0)
    sent = paths.throughput * value * irradiance / np.pi * facing[:, None]
    rows = np.any(sent != 0.0, axis=1)
    far = np.where(np.isinf(distance), FAR, distance * (1.0 - 1e-5) - 2.0 * surface.epsilon)
    rays = Rays(surface.leave(wi)[rows], wi[rows], np.maximum(far, 0.0)[rows])
    limits = paths.limits.take(rows)
    return Paths(rays, sent[rows], paths.pdf[rows], paths.index[rows], paths.media[rows], limits)


def add_tinted(world: World, table: Float64, paths: Paths, estimate: Estimate) -> None:
    """Follows light towards its lamp; every surface on the way takes its share."""
    for _ in range(MOST_CROSSINGS):
        if len(paths.index) == 0:
            return
        estimate.rays.shadow += len(paths.index)
        hits = world.traced.intersect(paths.rays)
        hits, media, surface, met = find_there(world, paths.rays, hits, paths.media)
        way = np.where(met, hits.t, np.where(paths.rays.far < FAR, paths.rays.far, np.inf))
        light = paths.throughput * light_left(absorption_of(world.materials, media), way)
        np.add.at(estimate.radiance, paths.index[~met], light[~met])
        paths, hits = keep(replace(paths, throughput=light, media=media), hits, met)
        if len(paths.index) == 0:
            return
        light = paths.throughput * row_at(world, table, hits, surface).refract
        left = np.where(paths.rays.far < FAR, paths.rays.far - hits.t - surface.epsilon, FAR)
        rays = Rays(surface.leave(paths.rays.direction), paths.rays.direction, left)
        assert surface.behind is not None
        on = np.any(light != 0.0, axis=1) & (left > 0.0)
        paths = replace(paths, rays=rays, throughput=light, media=surface.behind)
        paths, _unused = keep(paths, hits, on)
