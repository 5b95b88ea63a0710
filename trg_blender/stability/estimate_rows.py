"""Rows of sums, stated errors and repeatability: E01 to E08."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ..engine.image_error import estimate_error
from ..engine.pixel_error import UNSEEN
from ..engine.scene_arrays import LUMINANCE, Float64, Light, Material
from .case import ANY, Case, Outcome, Row, within
from .leaving_rows import add_mesh, glass
from .meshes import icosphere
from .stage import (
    GLOW,
    RECTANGLE,
    Camera,
    Settings,
    add_object,
    finish,
    make_floor,
    make_sphere,
    new_scene,
    place,
)

NATIVE = (ANY,)
WIDTH, HEIGHT, SAMPLES = 16, 12, 32
VIEW = Camera(half_width=0.9)
Make = Callable[[str], Any]


def easy(accel: str, albedo: float = 0.5) -> Any:
    """A grey ball on a grey floor under a square light."""
    light = Light(
        RECTANGLE, 3, 3, 3, position_x=0.5, position_z=2.5, direction_z=-1.0, axis_u_x=0.5, axis_v_y=0.5
    )
    scene = new_scene(
        [Material(albedo, albedo, albedo, specular=0.0)], world=0.1, lights=[light], accel=accel
    )
    add_object(scene, make_floor(2.0))
    add_object(scene, make_sphere(12), 0, place(0, 0, 0.4, 0.4))
    return built(scene)


def caustic(accel: str) -> Any:
    """A ball of smooth glass over a floor, lit by a small glowing ball: its focus is found by bounces."""
    bright = Material(0, 0, 0, specular=0, emission_r=200, emission_g=200, emission_b=200)
    grey = Material(0.7, 0.7, 0.7, specular=0.0)
    scene = new_scene([grey, glass(1.5), bright], world=0.02, accel=accel)
    add_object(scene, make_floor(2.0))
    add_object(scene, make_sphere(16), 1, place(0, 0, 0.6, 0.4))
    ball = icosphere(2, 0.12)
    add_mesh(scene, ball, 2, place(1.2, -0.8, 2.0))
    return built(scene)


def built(scene: Any) -> Any:
    VIEW.apply(scene)
    scene.build(1)
    return scene


def render(scene: Any, samples: int, seed: int, **limits: Any) -> Any:
    """A finished job."""
    job = scene.start_render(WIDTH, HEIGHT, samples, seed, 8, 0, (), None, **limits)
    finish(job)
    return job


def pixels_of(job: Any) -> Float64:
    out = np.zeros((HEIGHT, WIDTH, 4), np.float32)
    job.combined(out)
    return out[..., :3].astype(np.float64)


def coverage(make: Make, factor: int, least: float) -> Row:
    """E02, E03: share of pixels whose luminance lies within the stated half width of the truth, a render of
    `factor` times the samples; `count` is the number of seeds."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        scene = make(accel)
        truth = pixels_of(render(scene, factor * SAMPLES, 1_000_003)) @ LUMINANCE
        inside, above = [], []
        for number in range(count):
            job = render(scene, SAMPLES, 1000 * seed + number)
            width = np.zeros((HEIGHT, WIDTH), np.float32)
            job.pixel_error(width, np.zeros((HEIGHT, WIDTH), np.uint8))
            off = truth - pixels_of(job) @ LUMINANCE
            inside.append((np.abs(off) <= width + 1e-7).mean())
            above.append(float((off > width + 1e-7).mean()))
        share, noise = float(np.mean(inside)), 3 * float(np.std(inside)) / np.sqrt(count)
        one_sided = np.mean(above) / max(1 - share, 1e-9)
        figure = f"{share:.3f} +-{noise:.3f}, {100 * one_sided:.0f} % of misses below the truth"
        return Outcome(int(share + noise < least), 1, figure)

    return row


def stated_error(make: Make, factor: int) -> Row:
    """E04: the stated squared error over the true one, and how often the interval holds."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        scene = make(accel)
        reference = render(scene, factor * SAMPLES, 1_000_003)
        truth, own = pixels_of(reference), (estimate_error(reference.error()).rmse or 0.0) ** 2
        stated, true, holds = [], [], []
        for number in range(count):
            job = render(scene, SAMPLES, 1000 * seed + number)
            error = estimate_error(job.error())
            mse = max(float(np.mean((pixels_of(job) - truth) ** 2)) - own, 0.0)
            low, high = error.ci95 or (0.0, 0.0)
            stated.append((error.rmse or 0.0) ** 2)
            true.append(mse)
            holds.append(low <= np.sqrt(mse) <= high)
        ratio, share = float(np.mean(stated) / np.mean(true)), float(np.mean(holds))
        spread = np.array(stated) / np.mean(true) - np.array(true) * ratio / np.mean(true)
        noise, slack = 3 * float(spread.std()) / np.sqrt(count), 3 * np.sqrt(0.09 / count)
        failed = abs(ratio - 1) > 0.1 + noise or share < 0.9 - slack
        return Outcome(int(failed), 1, f"ratio {ratio:.3f} +-{noise:.3f}, holds {100 * share:.0f} %")

    return row


def stop_bias(adaptive: bool) -> Row:
    """E05: the mean of renders that stop by their error, against a long one; `count` renders."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        scene = easy(accel)
        truth = pixels_of(render(scene, 16_384, 1_000_003)).mean()
        jobs = (render(scene, 1 << 20, 1000 * seed + k, rmse=0.05, adaptive=adaptive) for k in range(count))
        means = np.array([pixels_of(job).mean() for job in jobs]) / truth
        bias, noise = means.mean() - 1, 3 * means.std(ddof=1) / np.sqrt(count)
        failed = abs(bias) > max(noise, 1e-5) or (noise <= 1e-3 and abs(bias) > 1e-3)
        return Outcome(int(failed), 1, f"bias {100 * bias:.3f} % +-{100 * noise:.3f} %")

    return row


def hidden_lamp(accel: str) -> Any:
    """A floor that a small glowing ball within smooth glass lights: about one path in a hundred finds it."""
    scene = new_scene([Material(0.5, 0.5, 0.5, specular=0.0), glass(1.5), GLOW], accel=accel)
    add_object(scene, make_floor(2.0))
    for radius, material in ((0.12, 1), (0.1, 2)):
        add_object(scene, make_sphere(12), material, place(0, 0, 1.2, radius))
    camera = Camera(eye=(0, 0, 0.9), half_width=0.9)
    camera.apply(scene)
    scene.build(1)
    return scene


def unseen_light(accel: str, count: int, seed: int = 0) -> Outcome:
    """E06: black pixels at 4 samples have the flag, and 64 samples do not end by their error."""
    scene = hidden_lamp(accel)
    job = render(scene, 4, 1 + seed)
    flags = np.zeros((HEIGHT, WIDTH), np.uint8)
    job.pixel_error(np.zeros((HEIGHT, WIDTH), np.float32), flags)
    black = pixels_of(job).max(axis=2) == 0
    unflagged = int((black & (flags & UNSEEN == 0)).sum())
    stopped = render(scene, 64, 1 + seed, rmse=1e-6, adaptive=True).poll(0.0)["stopped_by"]
    failed = unflagged + (stopped == "error") + (not black.any())
    return Outcome(failed, 1, f"{unflagged} of {int(black.sum())} black unflagged, ended by {stopped}")


def pooled_mean(accel: str, count: int, seed: int = 0) -> Outcome:
    """E07: means of pictures of `count` samples in all whose albedos differ by 1 %, and of two equal ones."""
    samples = max(64, count // (WIDTH * HEIGHT))
    found = []
    for albedo, number in ((0.5, 1), (0.5, 2), (0.505, 3)):
        job = render(easy(accel, albedo), samples, number + 10 * seed)
        sums, counts = np.zeros((8, HEIGHT, WIDTH, 3)), np.zeros(8, np.int64)
        job.replicates(sums, counts)
        means = sums.mean(axis=(1, 2, 3)) / counts
        found.append((means.mean(), means.std(ddof=1) / np.sqrt(8)))
    (a, sa), (b, sb), (c, sc) = found
    equal, changed = abs(a - b) / np.hypot(sa, sb), abs(a - c) / np.hypot(sa, sc)
    figure = f"{changed:.0f} deviations, equal ones {equal:.1f}"
    return Outcome(int(changed < 4.5 or equal > 4.5), 1, figure)


def repeated(accel: str, count: int, seed: int = 0) -> Outcome:
    """E08: 1, 2 and 16 threads, and a part of the picture: the same bits."""
    scene = easy(accel)
    pictures = []
    for threads in (1, 2, 16):
        job = scene.start_render(64, 48, count, 1 + seed, 8, threads, (), None)
        finish(job)
        out = np.zeros((48, 64, 4), np.float32)
        job.combined(out)
        pictures.append(out)
    job = scene.start_render(64, 48, count, 1 + seed, 8, 2, (), (7, 3, 41, 30))
    finish(job)
    part = np.zeros((27, 34, 4), np.float32)
    job.combined(part)
    differ = sum(int((one != pictures[0]).any(axis=2).sum()) for one in pictures[1:])
    differ += int((part != pictures[0][3:30, 7:41]).any(axis=2).sum())
    return Outcome(differ, 2 * 64 * 48 + 27 * 34, f"{differ} pixels differ")


def even_sum(accel: str, count: int, seed: int = 0) -> Outcome:
    """E01: the mean of `count` samples of a constant world, in the film's sums."""
    scene = new_scene([], world=0.1, accel=accel)
    Camera().apply(scene)
    scene.build(1)
    settings = Settings(1, 1, samples=count, seed=seed)
    job = scene.start_render(settings.width, settings.height, count, seed, 0, 1, (), None)
    finish(job)
    sums, counts = np.zeros((8, 1, 1, 3)), np.zeros(8, np.int64)
    job.replicates(sums, counts)
    mean = sums.sum(axis=0)[0, 0, 0] / counts.sum()
    return within(float(abs(mean / float(np.float32(0.1)) - 1)), 1e-7)


def cases() -> Iterator[Case]:
    """E01 to E08."""
    yield Case("E01", "constant", even_sum, NATIVE, 100_000_000, 200_000)
    yield Case("E02", "ball under a square light", coverage(easy, 64, 0.93), NATIVE, 200, 12)
    yield Case("E03", "glass and a small lamp", coverage(caustic, 512, 0.90), NATIVE, 200, 12)
    yield Case("E04", "easy", stated_error(easy, 64), NATIVE, 200, 12)
    yield Case("E04", "caustic", stated_error(caustic, 512), NATIVE, 200, 12)
    yield Case("E05", "even", stop_bias(False), NATIVE, 500, 30)
    yield Case("E05", "adaptive", stop_bias(True), NATIVE, 500, 30)
    yield Case("E06", "lamp within glass", unseen_light, NATIVE, 1, 1)
    yield Case("E07", "albedo 0.5 and 0.505", pooled_mean, NATIVE, 2_000_000, 50_000)
    yield Case("E08", "threads and a part", repeated, NATIVE, 64, 8)
