"""The reference renderer: a second, independent implementation of docs/architecture.md, section 4.

Numpy in float64 on the triangles that Embree finds; simple and slow, with random numbers of its own. The
files `reference_*.py` are its parts, `reference_path.py` the integrator.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .antialiasing import is_deterministic, pattern_places, random_places
from .motion import moves, still_at
from .reference_camera import CameraRays, build_camera_rays, filter_offsets
from .reference_classic import trace_classic
from .reference_passes import PassNotes
from .reference_path import Estimate, RayCounts, World, build_world, trace_paths
from .reference_scene import MISS
from .scene_arrays import Float64, RenderSettings, SceneArrays

REPLICATES = 8
REJECTED_PLACES = 16
BATCH = 16384
"""Paths that walk together: small enough to notice a cancel a few times a second."""
FAR_DEPTH = 1e10
"""Depth where nothing is."""

GOLDEN = 0.5 * (5.0**0.5 - 1.0)


@dataclass(slots=True)
class ReferenceFilm:
    """Float64 sums over samples; row 0 is the bottom row."""

    sums: Float64
    """(8, h, w, 3) radiance, one plane a replicate"""
    counts: NDArray[np.int64]
    """(8,) samples of each pixel in each replicate"""
    coverage: Float64
    """(h, w) camera rays that hit"""
    normals: Float64
    """(h, w, 3)"""
    depth: Float64
    """(h, w) distance along -Z at the pixel's centre, FAR_DEPTH for a miss"""
    passes: dict[str, Float64] = field(default_factory=dict)
    """(h, w, channels) sums of the passes asked for"""
    position: Float64 | None = None
    """(h, w, 3) where the rays through the pixels' centres end, 0 for a miss"""
    rays: RayCounts = field(default_factory=RayCounts)
    rejected_samples: int = 0
    rejected_places: list[tuple[int, int, int]] = field(default_factory=list)
    """(x, y, sample) of the first of them, in pixels of the film"""

    @property
    def samples(self) -> int:
        return int(self.counts.sum())

    def mean(self, sums: Float64) -> Float64:
        return sums / max(self.samples, 1)


def render_reference(
    scene: SceneArrays,
    settings: RenderSettings,
    progress: Callable[[ReferenceFilm], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> ReferenceFilm:
    """The film after `settings.samples` samples a pixel, or what there is when `cancelled` says so.

    `progress` sees the film after each step. Raises ImportError without embreex.
    """
    world = build_world(scene, settings.width, settings.rules)
    film = make_film(world, settings)
    for step, batch in expose(world, settings, cancelled or (lambda: False)):
        add_estimate(film, step, batch)
        if progress is not None:
            progress(film)
    return film


@dataclass(frozen=True, slots=True)
class Window:
    """The part of the picture that is rendered."""

    x_min: int
    y_min: int
    width: int
    height: int


def film_window(settings: RenderSettings) -> Window:
    x_min, y_min, x_max, y_max = settings.border or (0, 0, settings.width, settings.height)
    return Window(x_min, y_min, x_max - x_min, y_max - y_min)


def make_film(world: World, settings: RenderSettings) -> ReferenceFilm:
    """An empty film with its depth pass."""
    window = film_window(settings)
    shape = (window.height, window.width)
    pixels = np.arange(window.width * window.height)
    depth, position = np.full(len(pixels), FAR_DEPTH), np.zeros((len(pixels), 3))
    for first in range(0, len(pixels), BATCH):
        part = pixels[first : first + BATCH]
        camera = pixel_rays(world.scene, settings, part, np.full((len(part), 2), 0.5))
        hits = world.traced.intersect(camera.rays)
        found = (camera.near + np.where(hits.triangle != MISS, hits.t, 0.0)) * camera.depth_per_length
        hit = hits.triangle != MISS
        depth[part] = np.where(hit, found, FAR_DEPTH)
        along = np.where(hit, hits.t, 0.0)[:, None] * camera.rays.direction
        position[part] = np.where(hit[:, None], camera.rays.origin + along, 0.0)
    zero = np.zeros((*shape, 3))
    return ReferenceFilm(
        np.zeros((REPLICATES, *shape, 3)),
        np.zeros(REPLICATES, np.int64),
        np.zeros(shape),
        zero,
        depth.reshape(shape),
        position=position.reshape(*shape, 3),
    )


def pixel_rays(
    scene: SceneArrays,
    settings: RenderSettings,
    pixels: NDArray[np.int64],
    place: Float64,
    lens: Float64 | None = None,
) -> CameraRays:
    """Camera rays through `place` (n, 2) within the film's pixels, which are numbered row by row, and
    through `lens` of the aperture."""
    window = film_window(settings)
    x = window.x_min + pixels % window.width + place[:, 0]
    y = window.y_min + pixels // window.width + place[:, 1]
    return build_camera_rays(scene.camera, (settings.width, settings.height), x, y, lens)


@dataclass(frozen=True, slots=True)
class Step:
    """The next samples of one replicate, for every pixel."""

    replicate: int
    samples: int
    first: int = 0
    """samples of the replicate before these"""

    def sample_numbers(self) -> NDArray[np.int64]:
        """Numbers of its samples among all of a pixel; sample k belongs to replicate k mod 8."""
        return self.replicate + REPLICATES * (self.first + np.arange(self.samples))


def places_in_pixel(
    settings: RenderSettings, numbers: NDArray[np.int64], rng: np.random.Generator
) -> Float64:
    """(n, 2) places of samples in, or by a filter about, their pixel."""
    if is_deterministic(settings):
        pattern = pattern_places(settings)
        return pattern[numbers % len(pattern)]
    place = random_places(settings, len(numbers), rng)
    if settings.aa == "sobol":
        return 0.5 + filter_offsets(settings.pixel_filter, settings.filter_width, place)
    return place


def plan_steps(samples: int, pixels: int) -> Iterator[Step]:
    """Replicates in turn; sample k belongs to replicate k mod 8. Small pictures take several at once."""
    done, each, largest = 0, 1, max(1, BATCH // max(pixels, 1))
    while done < samples:
        until = min(samples, done + REPLICATES * each)
        for replicate in range(REPLICATES):
            count = share_of(replicate, until) - share_of(replicate, done)
            if count > 0:
                yield Step(replicate, count, share_of(replicate, done))
        done, each = until, min(2 * each, largest)


def share_of(replicate: int, samples: int) -> int:
    """How many of the first `samples` samples belong to `replicate`."""
    return (samples - replicate + REPLICATES - 1) // REPLICATES if samples > replicate else 0


def expose(
    world: World, settings: RenderSettings, cancelled: Callable[[], bool]
) -> Iterator[tuple[Step, Estimate]]:
    """Step after step what to add to the film; ends early when cancelled, without a half step."""
    window = film_window(settings)
    pixels = window.width * window.height
    generators = [
        np.random.Generator(np.random.Philox(key=np.array([settings.seed % 2**64, r], dtype=np.uint64)))
        for r in range(REPLICATES)
    ]
    for step in plan_steps(settings.samples, pixels):
        batch = expose_step(world, settings, step, generators[step.replicate], cancelled)
        if batch is None:
            return
        yield step, batch


def expose_step(
    world: World,
    settings: RenderSettings,
    step: Step,
    rng: np.random.Generator,
    cancelled: Callable[[], bool],
) -> Estimate | None:
    """The samples of every pixel, pixel by pixel in a row; None when cancelled."""
    if moves(world.scene):
        return expose_moving(world, settings, step, rng, cancelled)
    window = film_window(settings)
    index = np.repeat(np.arange(window.width * window.height), step.samples)
    numbers = np.tile(step.sample_numbers(), window.width * window.height)
    parts = []
    for first in range(0, len(index), BATCH):
        if cancelled():
            return None
        part = index[first : first + BATCH]
        place = places_in_pixel(settings, numbers[first : first + BATCH], rng)
        if settings.integrator == "classic":
            camera = pixel_rays(world.scene, settings, part, place)
            parts.append(trace_classic(world, camera, settings.max_bounces))
            continue
        camera = pixel_rays(world.scene, settings, part, place, rng.random((len(part), 2)))
        parts.append(trace_paths(world, camera, settings.max_bounces, rng, settings.passes))
    return join_estimates(parts, np.concatenate)


Join = Callable[[list[Any]], Any]


def join_estimates(parts: list[Estimate], join: Join) -> Estimate:
    """Batches as one; `join` makes one array of the arrays of all."""
    return Estimate(
        join([p.radiance for p in parts]),
        join([p.hit for p in parts]),
        join([p.normal for p in parts]),
        join_notes([p.notes for p in parts if p.notes is not None], join),
        RayCounts(
            sum(p.rays.camera for p in parts),
            sum(p.rays.shadow for p in parts),
            sum(p.rays.bounce for p in parts),
            sum(p.rays.clamped for p in parts),
        ),
    )


def join_notes(parts: list[PassNotes], join: Join) -> PassNotes | None:
    """Notes of batches as one; None for none."""
    if not parts:
        return None
    values = {name: join([part.values[name] for part in parts]) for name in parts[0].values}
    return PassNotes(values, join([part.shares for part in parts]), parts[0].data)


def expose_moving(
    world: World,
    settings: RenderSettings,
    step: Step,
    rng: np.random.Generator,
    cancelled: Callable[[], bool],
) -> Estimate | None:
    """The same where something moves: each sample is one time for the whole picture, a golden section on from
    the replicate's last."""
    parts = []
    start = np.random.default_rng([settings.seed % 2**64, step.replicate]).random()
    for number in range(step.first, step.first + step.samples):
        still = build_world(
            still_at(world.scene, (start + number * GOLDEN) % 1.0), settings.width, settings.rules
        )
        part = expose_step(still, settings, Step(step.replicate, 1, number), rng, cancelled)
        if part is None:
            return None
        parts.append(part)
    return join_estimates(parts, lambda each: np.stack(each, axis=1).reshape(-1, *each[0].shape[1:]))


def note_rejected(film: ReferenceFilm, step: Step, rows: NDArray[np.int64]) -> None:
    """Keeps the first REJECTED_PLACES by sample, row and column."""
    pixels, numbers = rows // step.samples, step.sample_numbers()[rows % step.samples]
    width = film.depth.shape[1]
    found = zip(pixels % width, pixels // width, numbers, strict=True)
    places = film.rejected_places + [(int(x), int(y), int(sample)) for x, y, sample in found]
    film.rejected_places = sorted(places, key=lambda place: place[::-1])[:REJECTED_PLACES]


def add_estimate(film: ReferenceFilm, step: Step, batch: Estimate) -> None:
    """Sums the samples of each pixel; a sample that is not finite is dropped and counted."""
    height, width = film.depth.shape
    finite = np.isfinite(batch.radiance).all(axis=1)
    radiance = np.where(finite[:, None], batch.radiance, 0.0)
    film.rejected_samples += int((~finite).sum())
    note_rejected(film, step, np.flatnonzero(~finite))
    film.sums[step.replicate] += radiance.reshape(height, width, step.samples, 3).sum(axis=2)
    film.coverage += batch.hit.reshape(height, width, step.samples).sum(axis=2)
    film.normals += batch.normal.reshape(height, width, step.samples, 3).sum(axis=2)
    film.counts[step.replicate] += step.samples
    for name, values in (batch.notes.values if batch.notes is not None else {}).items():
        values = np.where(finite[:, None] & np.isfinite(values), values, 0.0)
        summed = values.reshape(height, width, step.samples, -1).sum(axis=2)
        film.passes[name] = film.passes[name] + summed if name in film.passes else summed
    film.rays.camera += batch.rays.camera
    film.rays.shadow += batch.rays.shadow
    film.rays.bounce += batch.rays.bounce
    film.rays.clamped += batch.rays.clamped
