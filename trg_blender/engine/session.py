"""One render, from arrays to a picture with its error: `render` in one go, `start` step by step.

Both devices stand behind the same class: the native core, and the reference on Embree.
"""

from __future__ import annotations

import math
import os
import time
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .antialiasing import is_deterministic, with_pattern_samples
from .chance_light import error_in_hits
from .devices import INTEGRATORS, Unavailable, require_device
from .errors import SceneError
from .holes import classic_warnings, with_holes
from .image_error import Evidence, PictureError, estimate_error
from .kept_scene import KeptScene
from .mfaa import SampledFrame
from .native import ACCELERATORS, load_native
from .native_scene import build_native_scene
from .passes import KERNEL_PASSES, PassSource, film_shape, job_passes, read_combined, read_passes
from .path_rules import NO_RULES
from .report import HistoryEntry, Progress, RenderFacts, build_report, seconds_left, seconds_to_target
from .scene_arrays import Float32, Float64, RenderSettings, SceneArrays
from .scene_check import check_camera, check_scene, check_settings

__all__ = ["RenderJob", "Result", "SceneError", "Unavailable", "render", "start"]

CLASSIC_PASSES = ("depth", "normal")
POLL_SECONDS = 0.05
FIRST_ERROR_SAMPLES = 8
ERROR_STEP = 1.4
"""The error is measured when every replicate has a sample, then when the samples have grown by so much."""


class Job(PassSource, Protocol):
    """A running render of either device (docs/architecture.md, 3.3)."""

    def poll(self, timeout_s: float, /) -> dict[str, Any]: ...
    def cancel(self) -> None: ...
    def rejected_places(self) -> list[tuple[int, int, int]]: ...
    def replicates(self, sums: Float64, counts: NDArray[np.int64], /) -> None: ...
    def error(self) -> dict[str, Any]: ...
    def pixel_error(self, half_width: Float32, flags: NDArray[np.uint8], /) -> dict[str, float]: ...


@dataclass(frozen=True, slots=True)
class Result:
    """A finished render. Pictures have the bottom row first; with a border they have its size."""

    pixels: Float32
    """(h, w, 4) linear, associated alpha"""
    passes: dict[str, Float32]
    """those asked for: (h, w), or (h, w, channels) (passes.py)"""
    report: dict[str, Any]
    replicate_sums: Float64
    """(8, h, w, 3) sums of radiance"""
    replicate_counts: NDArray[np.int64]
    """(8,) samples a pixel in each replicate"""


@dataclass(frozen=True, slots=True)
class StartedJob:
    """A job and what is known about it from the start."""

    job: Job
    build: dict[str, Any]
    instruction_set: str | None
    threads: int


def render(scene: SceneArrays, settings: RenderSettings) -> Result:
    """Renders to the end. Raises what `start` raises."""
    job = start(scene, settings)
    while not job.poll(POLL_SECONDS).done:
        pass
    return job.result()


def start(scene: SceneArrays, settings: RenderSettings, kept: KeptScene | None = None) -> RenderJob:
    """Checks and builds the scene and starts tracing.

    With `kept` only what is different from the picture before is built, on the native device.

    Raises SceneError for a scene or picture that cannot be, Unavailable for a device, accelerator or
    integrator that is not here.
    """
    check_settings(settings)
    settings = with_pattern_samples(settings)
    warnings = check_picture(scene, kept)
    scene = with_holes(scene)
    require_device(settings.device)
    if settings.integrator not in INTEGRATORS:
        raise Unavailable(f"integrator {settings.integrator}: not built yet in this version")
    if settings.integrator == "classic":
        allowed = tuple(name for name in settings.passes if name in CLASSIC_PASSES)
        dropped = [name for name in settings.passes if name not in allowed]
        warnings += [f"pass {name}: not with the classic integrator" for name in dropped]
        warnings += classic_warnings(scene)
        if settings.rules.bite(settings.max_bounces):
            warnings.append("bounces by kind, clamps and caustics: not with the classic integrator")
        settings = replace(settings, passes=allowed, rules=NO_RULES)
    asked = replace(settings, passes=job_passes(scene, settings))
    if settings.device == "embree":
        warnings += missing_passes(settings)
    started = start_native(scene, asked, kept) if settings.device == "cpu" else start_reference(scene, asked)
    return RenderJob(scene, settings, started, warnings)


def check_picture(scene: SceneArrays, kept: KeptScene | None) -> list[str]:
    """check_scene, but of a scene that was rendered before the camera alone."""
    if kept is None or not kept.knows(scene):
        return check_scene(scene)
    check_camera(scene.camera)
    return []


def start_native(scene: SceneArrays, settings: RenderSettings, kept: KeptScene | None) -> StartedJob:
    """`settings.passes` are those of the job."""
    if settings.accel not in ACCELERATORS:
        raise Unavailable(f"accelerator {settings.accel}: not built yet in this version")
    native = load_native()
    try:
        if kept is None:
            built, statistics = build_native_scene(native, scene, settings)
        else:
            built, statistics = kept.bring(native, scene, settings)
        job = built.start_render(
            settings.width,
            settings.height,
            settings.samples,
            settings.seed % 2**32,
            settings.max_bounces,
            settings.threads,
            settings.passes,
            settings.border,
            settings.seconds,
            settings.rmse,
            settings.adaptive,
            settings.rules.packed(settings.max_bounces),
        )
    except ValueError as refusal:
        raise SceneError(str(refusal)) from refusal
    return StartedJob(
        job, statistics, native.info().get("instruction_set"), settings.threads or os.cpu_count() or 1
    )


def missing_passes(settings: RenderSettings) -> list[str]:
    """A line on the passes that the reference renderer leaves empty."""
    from .reference_passes import REFERENCE_PASSES

    missing = [name for name in KERNEL_PASSES if name in settings.passes and name not in REFERENCE_PASSES]
    return [f"device embree: empty passes: {', '.join(missing)}"] if missing else []


def start_reference(scene: SceneArrays, settings: RenderSettings) -> StartedJob:
    """`settings.passes` are those of the job; accelerator and threads do not apply."""
    from .reference_job import ReferenceJob
    from .reference_path import build_world

    begin = time.perf_counter()
    world = build_world(scene, settings.width, settings.rules)
    baked = sum(
        len(one.transforms) * len(scene.meshes[one.mesh].triangles)
        for one in scene.instances
        if scene.meshes[one.mesh].shape == "triangles"
    )
    statistics = {
        "seconds": time.perf_counter() - begin,
        "accel": "embree",
        "bytes": None,
        "degenerate_triangles": baked - world.traced.triangles.first_shape,
    }
    return StartedJob(ReferenceJob(world, settings), statistics, None, 1)


class RenderJob:
    """A render under way: poll it, look at it, cancel it, and take its result."""

    def __init__(
        self, scene: SceneArrays, settings: RenderSettings, started: StartedJob, warnings: list[str]
    ) -> None:
        self._scene = scene
        self._settings = settings
        self._started = started
        self._warnings = warnings
        self._error = PictureError()
        self._history: list[HistoryEntry] = []
        self._next_error = FIRST_ERROR_SAMPLES

    def poll(self, timeout: float = POLL_SECONDS) -> Progress:
        """State after at most `timeout` seconds, at once when done."""
        state = self._started.job.poll(timeout)
        if state["samples"] >= self._next_error or state["done"]:
            self._measure(state)
        return self._progress(state)

    def cancel(self) -> None:
        """Asks the job to stop; `poll` says done within 0.2 s."""
        self._started.job.cancel()

    def picture(self) -> Float32:
        """(h, w, 4) as far as it has come."""
        return read_combined(self._started.job, self._scene, film_shape(self._settings))

    @property
    def build_seconds(self) -> float:
        """Seconds that making the accelerator took."""
        return float(self._started.build.get("seconds") or 0.0)

    def error(self) -> PictureError:
        """The error as far as the picture has come."""
        return estimate_error(self._started.job.error())

    def passes(self) -> dict[str, Float32]:
        """The passes asked for, as far as they have come."""
        return read_passes(self._started.job, self._scene, self._settings, film_shape(self._settings))

    def result(self) -> Result:
        """Waits for the end, then the pictures and the report."""
        while not self.poll(POLL_SECONDS).done:
            pass
        shape = film_shape(self._settings)
        sums, counts = np.zeros((8, *shape, 3)), np.zeros(8, dtype=np.int64)
        self._started.job.replicates(sums, counts)
        return Result(self.picture(), self.passes(), build_report(self._facts()), sums, counts)

    def sampled_frame(self) -> SampledFrame | None:
        """What `mfaa` carries over to the next frame; None for other methods and parts of pictures."""
        if self._settings.aa != "mfaa" or self._settings.border is not None:
            return None
        depth = np.zeros(film_shape(self._settings), np.float32)
        self._started.job.depth(depth)
        return SampledFrame(self.picture(), depth, self._scene.camera, self._settings.frame)

    def _measure(self, state: dict[str, Any]) -> None:
        """Measures the error and notes it, once for each number of samples."""
        if self._history and self._history[-1].samples == state["samples"]:
            return
        known = not is_deterministic(self._settings)
        self._error = estimate_error(self._started.job.error()) if known else PictureError()
        self._history.append(HistoryEntry(state["samples"], state["seconds"], self._error))
        while self._next_error <= state["samples"]:
            self._next_error = math.ceil(self._next_error * ERROR_STEP)

    def _progress(self, state: dict[str, Any]) -> Progress:
        rays = state["rays_camera"] + state["rays_shadow"] + state["rays_bounce"]
        rate = rays / state["seconds"] if state["seconds"] > 0.0 else 0.0
        return Progress(
            done=state["done"],
            cancelled=state["cancelled"],
            samples=state["samples"],
            target=state["target"],
            error=self._error,
            rays_per_second=rate,
            seconds=state["seconds"],
            seconds_left=seconds_left(state, self._settings, self._error),
            error_target=self._settings.rmse,
            seconds_to_target=seconds_to_target(state["seconds"], self._settings.rmse, self._error),
        )

    def _facts(self) -> RenderFacts:
        started = self._started
        return RenderFacts(
            self._scene,
            self._settings,
            started.job.poll(0.0),
            started.build,
            self._error,
            list(self._history),
            self._warnings,
            started.instruction_set,
            started.threads,
            self._evidence(),
            started.job.rejected_places(),
        )

    def _evidence(self) -> Evidence | None:
        """What the error is told from; None below two replicates."""
        shape = film_shape(self._settings)
        half_width, flags = np.zeros(shape, np.float32), np.zeros(shape, np.uint8)
        found = self._started.job.pixel_error(half_width, flags)
        if self._error.rmse is None:
            return None
        samples = self._started.job.poll(0.0)["samples"]
        hits = error_in_hits(self._scene, self._settings, self._error.rmse, samples)
        return Evidence(**found, chance_hits=hits)
