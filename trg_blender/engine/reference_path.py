"""The path integrator of the reference renderer: docs/architecture.md, section 4, read aloud in numpy.

A batch of paths walks together, one loop turn a segment; paths that end drop out of the arrays.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from .holes import has_holes
from .path_rules import NO_RULES, PathRules
from .reference_bsdf import Bsdf, Scattered, build_bsdf, evaluate_bsdf, sample_bsdf
from .reference_camera import CameraRays
from .reference_closures import choose_closures
from .reference_emission import Glow, build_glow, pdf_glow, sample_glow
from .reference_environment import Sky, build_sky, evaluate_sky, pdf_sky, sample_sky
from .reference_lights import LightSample, hit_light, sample_light, suns_seen
from .reference_limits import (
    Limits,
    all_kinds,
    clamp_light,
    count_scattering,
    count_sheets,
    dark_ways,
    drop_caustics,
    lit_share,
    new_limits,
    sheets_left,
)
from .reference_math import dot, mis_weight
from .reference_media import (
    Stack,
    absorption_of,
    cross_surface,
    find_beginnings,
    light_left,
    no_media,
    row_absorption,
)
from .reference_nested import (
    Boundaries,
    Nested,
    build_nested,
    face_boundaries,
    media_around,
    meet_boundaries,
    no_boundaries,
    put_hits,
)
from .reference_passes import PassNotes, make_notes, note_shadow, note_source, note_vertex, split_bsdf
from .reference_scene import FAR, MISS, Hits, Rays, TracedScene, build_traced_scene
from .reference_sheets import (
    MOST_SHEETS,
    Straight,
    has_sheets,
    pass_sheets,
    pick,
    sheet_values,
    straight,
    transmittance,
)
from .reference_sheets import beyond as sheet_beyond
from .reference_surface import MaterialTable, Surface, bend_to_horizon, build_material_table, build_surface
from .scene_arrays import CAMERA_KINDS, SHADOW_RAY, Float64, SceneArrays

ORTHOGRAPHIC = CAMERA_KINDS.index("orthographic")
ROULETTE_START = 3
"""Segments before Russian roulette begins."""


@dataclass(frozen=True, slots=True)
class World:
    """Everything that paths meet."""

    scene: SceneArrays
    traced: TracedScene
    materials: MaterialTable
    glow: Glow | None
    color: Float64
    sky: Sky | None = None
    sheets: bool = False
    """whether any material lets light straight through"""
    media: bool = False
    """whether any surface encloses something that absorbs or has a priority"""
    nested: Nested | None = None
    """of the surfaces whose insides have priorities; None: there are none"""
    rules: PathRules = NO_RULES
    held_out: NDArray[np.bool_] | None = None
    """(copies,) of which the camera sees holes; None: of none"""


@dataclass(slots=True)
class RayCounts:
    camera: int = 0
    shadow: int = 0
    bounce: int = 0
    clamped: int = 0
    """contributions that a clamp made smaller"""


@dataclass(slots=True)
class Estimate:
    """What a batch of n paths brought home."""

    radiance: Float64
    """(n, 3)"""
    hit: NDArray[np.bool_]
    """(n,) whether the camera ray met a surface"""
    normal: Float64
    """(n, 3) shading normal of the first hit, 0 for a miss"""
    notes: PassNotes | None = None
    """what passes get; None when none is asked for"""
    rays: RayCounts = field(default_factory=RayCounts)
    rules: PathRules = NO_RULES


@dataclass(slots=True)
class Paths:
    """The paths still under way; `index` says which of the batch each is."""

    rays: Rays
    throughput: Float64
    pdf: Float64
    """(n,) density of the direction by the surface it left; inf after a delta and from the camera"""
    index: NDArray[np.int64]
    media: Stack
    limits: Limits


Place = tuple[Estimate, int, NDArray[np.uint8]]
"""the estimate that light is added to, the segment, and the ways of scattering (n,) that are dark"""


def build_world(scene: SceneArrays, width: int, rules: PathRules = NO_RULES) -> World:
    """For a picture `width` pixels wide. Raises ImportError without embreex."""
    traced = build_traced_scene(scene)
    materials = build_material_table(scene, traced.triangles, width)
    glow = build_glow(traced.triangles, materials)
    sky = None if scene.environment is None else build_sky(scene.environment)
    nested = build_nested(traced, materials)
    media = nested is not None or bool(np.any(row_absorption(materials) > 0.0))
    color = np.asarray(scene.world, dtype=np.float64)
    held_out = holes_of(scene)
    sheets = has_sheets(materials)
    return World(scene, traced, materials, glow, color, sky, sheets, media, nested, rules, held_out)


def holes_of(scene: SceneArrays) -> NDArray[np.bool_] | None:
    if not any(one.holdout for one in scene.instances):
        return None
    copies = [len(one.transforms) for one in scene.instances]
    return np.repeat(np.array([one.holdout for one in scene.instances], bool), copies)


def trace_paths(
    world: World,
    camera: CameraRays,
    max_bounces: int,
    rng: np.random.Generator,
    passes: tuple[str, ...] = (),
) -> Estimate:
    """One sample for each camera ray, with what `passes` need beside it."""
    count = len(camera.near)
    estimate = Estimate(np.zeros((count, 3)), np.zeros(count, dtype=bool), np.zeros((count, 3)))
    estimate.rules = world.rules
    estimate.notes = make_notes(count, passes, world.scene.pass_data)
    paths = paths_of(world, camera)
    for segment in range(max_bounces + 2):
        paths, hits = meet(world, paths, rng)
        boundary = None
        if world.nested is not None:
            paths, hits, boundary = pass_boundaries(world, paths, hits, rng)
        if segment == 0:
            estimate.rays.camera += count
        else:
            estimate.rays.bounce += len(paths.index)
            collect_lights(world, paths, hits, estimate, segment)
        collect_world(world, outdoors(world, paths), hits, estimate, segment)
        met = shown(world, hits, segment)
        paths, hits = keep(paths, hits, met)
        if len(paths.index) == 0:
            break
        surface = build_surface(world.materials, hits, -paths.rays.direction)
        if boundary is not None:
            surface = face_boundaries(surface, boundary, met)
        if segment == 0:
            estimate.hit[paths.index] = True
            estimate.normal[paths.index] = surface.ns
        paths = absorb(world, paths, hits, surface)
        collect_emission(world, paths, hits, surface, (estimate, segment))
        # The ray after the last scattering only collects emission.
        if segment == max_bounces + 1:
            break
        surface, scale = choose_closures(surface, world.materials, rng)
        surface = bend_to_horizon(surface)
        if segment == 0:
            estimate.hit[paths.index[surface.material.column["holdout"] > 0.0]] = False
        surface, bare, dark = drop_caustics(surface, dark_ways(world.rules, paths.limits))
        paths = replace(paths, throughput=paths.throughput * (scale * bare * ~paths.limits.ended)[:, None])
        bsdf = build_bsdf(surface)
        if segment == 0 and estimate.notes is not None:
            note_vertex(estimate.notes, paths.index, bsdf, hits.t + camera.near[paths.index])
        gather_direct_light(world, paths, bsdf, rng, (estimate, segment, dark))
        scattered = sample_bsdf(bsdf, rng)
        if segment == 0 and estimate.notes is not None:
            estimate.notes.shares[paths.index] = split_bsdf(bsdf, scattered.wi, np.isinf(scattered.pdf))
        paths = replace(paths, media=beyond(world, paths, surface, scattered.wi))
        paths = note_scattering(world, paths, bsdf, scattered, (dark, rng.random(len(dark))))
        paths = go_on(paths, surface, scattered, rng, roulette=segment >= ROULETTE_START)
    return estimate


def paths_of(world: World, camera: CameraRays) -> Paths:
    """The beginnings of the paths, in the media that the camera is in."""
    count = len(camera.near)
    bright, pdf = np.ones((count, 3)), np.full(count, np.inf)
    paths = Paths(camera.rays, bright, pdf, np.arange(count), no_media(count), new_limits(count))
    if world.nested is not None and world.scene.camera.kind != ORTHOGRAPHIC:
        paths.media[:] = media_around(world.nested, world.scene.camera.matrix[:, 3])
    return paths


def shown(world: World, hits: Hits, segment: int) -> NDArray[np.bool_]:
    """(n,) which hits are surfaces, and for the camera no holes."""
    met = hits.triangle != MISS
    if segment == 0 and world.held_out is not None:
        met[met] = ~world.held_out[world.traced.triangles.copy[hits.triangle[met]]]
    return met


def meet(world: World, paths: Paths, rng: np.random.Generator) -> tuple[Paths, Hits]:
    """Where the paths' rays end, and the paths coloured by what they went straight through."""
    rays = replace(paths.rays, mask=paths.limits.kind)
    hits = world.traced.intersect(rays)
    if not world.sheets:
        return paths, hits
    way = straight(rays, sheets_left(world.rules, paths.limits, 1))
    hits, tint, passed = pass_sheets(world.traced, world.materials, way, hits, rng)
    limits = count_sheets(world.rules, paths.limits, passed)
    return replace(paths, throughput=paths.throughput * tint, limits=limits), hits


def note_scattering(
    world: World, paths: Paths, bsdf: Bsdf, scattered: Scattered, by: tuple[NDArray[np.uint8], Float64]
) -> Paths:
    """The paths with what they remember of scattering; `by` are the ways that are dark and random numbers."""
    dark, u = by
    limits = count_scattering(world.rules, paths.limits, bsdf, scattered, u)
    lit = (limits.kind & dark) == 0
    return replace(paths, limits=limits, throughput=paths.throughput * lit[:, None])


def keep(paths: Paths, hits: Hits, rows: NDArray[np.bool_]) -> tuple[Paths, Hits]:
    """The paths and hits of some rows only."""
    rays = Rays(paths.rays.origin[rows], paths.rays.direction[rows], paths.rays.far[rows])
    limits = paths.limits.take(rows)
    kept = Paths(rays, paths.throughput[rows], paths.pdf[rows], paths.index[rows], paths.media[rows], limits)
    return kept, Hits(hits.triangle[rows], hits.t[rows], hits.u[rows], hits.v[rows])


def pass_boundaries(
    world: World, paths: Paths, hits: Hits, rng: np.random.Generator
) -> tuple[Paths, Hits, Boundaries]:
    """Paths and hits beyond surfaces of media that give way to others, and the boundaries met there."""
    assert world.nested is not None
    boundary = no_boundaries(len(hits.t))
    rays = replace(paths.rays, mask=paths.limits.kind)
    for _ in range(MOST_SHEETS):
        hits, media, passed = meet_boundaries(world.nested, (rays, paths.media), hits, boundary)
        paths = replace(paths, media=media)
        if not passed.any():
            break
        if world.sheets:
            rows = np.flatnonzero(passed)
            some = Rays(rays.origin[rows], rays.direction[rows], rays.far[rows], paths.limits.kind[rows])
            way = straight(some, sheets_left(world.rules, paths.limits, 1)[rows])
            found, tint, gone = pass_sheets(world.traced, world.materials, way, pick(hits, rows), rng)
            hits = put_hits(hits, rows, found)
            paths.throughput[rows] *= tint
            sheets = np.zeros(len(passed), np.int64)
            sheets[rows] = gone
            paths = replace(paths, limits=count_sheets(world.rules, paths.limits, sheets))
    return paths, hits, boundary


def nested_transmittance(world: World, way: Straight, media: Stack) -> Float64:
    """(n, 3) of the light along rays that start in `media`; 0 behind something solid."""
    assert world.nested is not None
    rays, left = way.rays, way.left.copy()
    light = np.ones((len(rays.far), 3))
    hits = world.traced.intersect(rays)
    boundary = no_boundaries(len(hits.t))
    for _ in range(MOST_SHEETS):
        hits, media, _passed = meet_boundaries(world.nested, (rays, media), hits, boundary)
        met = hits.triangle != MISS
        if not met.any():
            return light
        rows = np.flatnonzero(met)
        if world.sheets:
            alpha, through = sheet_values(world.materials, pick(hits, rows), rays.direction[rows])
            light[rows] *= ((1.0 - alpha) * (left[rows] > 0))[:, None] * through
            left[rows] -= 1
        else:
            light[rows] = 0.0
        hits.triangle[rows[~np.any(light[rows] > 0.0, axis=1)]] = MISS
        hits = sheet_beyond(world.traced, rays, hits, np.flatnonzero(hits.triangle != MISS))
    light[hits.triangle != MISS] = 0.0
    return light


def outdoors(world: World, paths: Paths) -> Paths:
    """The paths as what lies endlessly far sees them: black where they never left a medium."""
    if not world.media:
        return paths
    far = light_left(absorption_of(world.materials, paths.media), np.full(len(paths.index), np.inf))
    return replace(paths, throughput=paths.throughput * far)


def absorb(world: World, paths: Paths, hits: Hits, surface: Surface) -> Paths:
    """The paths at the surface that they met, dimmed by what filled the way."""
    if not world.media:
        return paths
    media = find_beginnings(world.materials, paths.media, surface)
    left = light_left(absorption_of(world.materials, media), hits.t)
    return replace(paths, throughput=paths.throughput * left, media=media)


def beyond(world: World, paths: Paths, surface: Surface, wi: Float64) -> Stack:
    """What paths are in after they left `surface` along `wi`."""
    if not world.media:
        return paths.media
    passes = dot(wi, surface.ng) < 0.0
    crossed = cross_surface(world.materials, paths.media, surface.row, surface.outside)
    if surface.ratio is not None and surface.behind is not None:
        crossed = np.where((surface.ratio > 0.0)[:, None], surface.behind, crossed)
    return np.where(passes[:, None], crossed, paths.media)


def collect_world(world: World, paths: Paths, hits: Hits, estimate: Estimate, segment: int) -> None:
    """Adds the world where rays leave the scene. A constant one is found by bounces only, an
    environment shares them with its light samples; the camera need not see it."""
    missed = hits.triangle == MISS
    if segment == 0 and not world.scene.transparent_film and has_holes(world.scene):
        estimate.hit[paths.index[missed]] = True
    if world.sky is not None:
        environment = world.scene.environment
        assert environment is not None
        if segment == 0 and (world.scene.transparent_film or not environment.seen_by_camera):
            return
        direction = paths.rays.direction[missed]
        weight = mis_weight(paths.pdf[missed], pdf_sky(world.sky, direction))[:, None]
        light = evaluate_sky(world.sky, direction) * weight
        if segment == 0:
            light = light + suns_seen(world.scene.lights, direction)
    else:
        light = world.color
    add_light(estimate, paths.index[missed], paths.throughput[missed] * light, segment, "environment")


def add_light(
    estimate: Estimate, index: NDArray[np.int64], light: Float64, segment: int, source: str
) -> None:
    """Light from the end of segment `segment` of the paths `index`."""
    light, clamped = clamp_light(estimate.rules, light, segment)
    estimate.rays.clamped += clamped
    estimate.radiance[index] += light
    if estimate.notes is not None:
        note_source(estimate.notes, index, light, segment, source)


def collect_lights(world: World, paths: Paths, hits: Hits, estimate: Estimate, segment: int) -> None:
    """Adds the lights with extent that bounce rays cross on their way."""
    for light in world.scene.lights:
        seen = hit_light(light, paths.rays.origin, paths.rays.direction, hits.t)
        if seen is not None:
            weight = mis_weight(paths.pdf, seen.pdf)[:, None]
            if world.media:
                absorption = absorption_of(world.materials, paths.media)
                weight = weight * light_left(absorption, seen.distance)
            light_seen = paths.throughput * seen.radiance * weight
            add_light(estimate, paths.index, light_seen, segment, "emission")


def collect_emission(
    world: World, paths: Paths, hits: Hits, surface: Surface, place: tuple[Estimate, int]
) -> None:
    """Adds the glow of the surface that was hit; `place` is the estimate and the segment."""
    other = np.zeros(len(paths.index))
    if world.glow is not None:
        other = pdf_glow(world.glow, world.traced.triangles, hits.triangle, paths.rays.direction, hits.t)
    weight = mis_weight(paths.pdf, other)[:, None]
    light = paths.throughput * surface.material.emission * weight
    add_light(place[0], paths.index, light, place[1], "emission")


def gather_direct_light(
    world: World, paths: Paths, bsdf: Bsdf, rng: np.random.Generator, place: Place
) -> None:
    """Next-event estimation: one sample of every light, of the environment, and one of all glowing
    triangles together."""
    position = bsdf.surface.position
    if world.sky is not None:
        add_light_sample(world, paths, bsdf, sample_sky(world.sky, len(position), rng), place)
    for light in world.scene.lights:
        add_light_sample(world, paths, bsdf, sample_light(light, position, rng), place)
    if world.glow is not None:
        sample = sample_glow(world.glow, world.traced.triangles, world.materials, position, rng)
        add_light_sample(world, paths, bsdf, sample, place)


def add_light_sample(world: World, paths: Paths, bsdf: Bsdf, sample: LightSample, place: Place) -> None:
    """Adds one light's sample where it is worth a shadow ray and nothing stands between."""
    estimate, segment, dark = place
    value, pdf = evaluate_bsdf(bsdf, sample.wi)
    weight = mis_weight(sample.pdf, pdf)[:, None]
    if world.media:
        media = beyond(world, paths, bsdf.surface, sample.wi)
        weight = weight * light_left(absorption_of(world.materials, media), sample.distance)
    seen = all_kinds(len(dark))
    if world.traced.masks is not None and sample.copy is not None:
        seen = world.traced.masks[sample.copy]
    weight = weight * lit_share(bsdf, sample.wi, seen & ~dark)
    light = paths.throughput * value * sample.radiance * weight
    rows = np.any(light != 0.0, axis=1)
    surface = bsdf.surface
    start = surface.leave(sample.wi)[rows]
    # Short of the light by as much as the ray starts off, lest a glowing triangle shadow itself.
    distance = sample.distance[rows]
    far = np.where(np.isinf(distance), FAR, distance * (1.0 - 1e-5) - 2.0 * surface.epsilon[rows])
    mask = np.full(len(start), SHADOW_RAY, np.uint8)
    rays = Rays(start, sample.wi[rows], np.maximum(far, 0.0), mask)
    estimate.rays.shadow += int(rows.sum())
    way = straight(rays, sheets_left(world.rules, paths.limits, 0)[rows])
    if world.nested is not None:
        start = beyond(world, paths, surface, sample.wi)[rows]
        passed = nested_transmittance(world, way, start)
    elif world.sheets:
        passed = transmittance(world.traced, world.materials, way)
    else:
        passed = np.where(world.traced.occluded(rays)[:, None], 0.0, 1.0)
    brought, clamped = clamp_light(world.rules, passed * light[rows], segment + 1)
    estimate.rays.clamped += clamped
    estimate.radiance[paths.index[rows]] += brought
    if estimate.notes is not None:
        shares = split_bsdf(bsdf, sample.wi, np.zeros(len(rows), bool))[rows] if segment == 0 else None
        note_shadow(estimate.notes, paths.index[rows], brought, shares)


def go_on(
    paths: Paths, surface: Surface, scattered: Scattered, rng: np.random.Generator, roulette: bool
) -> Paths:
    """The next segments; paths without weight end, dim ones by Russian roulette."""
    throughput = paths.throughput * scattered.weight
    alive = np.any(throughput != 0.0, axis=1)
    if roulette:
        survival = np.clip(throughput.max(axis=1), 0.05, 0.95)
        alive &= rng.random(len(survival)) < survival
        throughput = throughput / survival[:, None]
    start = surface.leave(scattered.wi)[alive]
    rays = Rays(start, scattered.wi[alive], np.full(int(alive.sum()), FAR))
    limits = paths.limits.take(alive)
    return Paths(
        rays, throughput[alive], scattered.pdf[alive], paths.index[alive], paths.media[alive], limits
    )
