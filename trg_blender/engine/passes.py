"""The pictures that a render gives: names, channels, and how they are read from a job."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .holes import has_holes
from .image_error import STUDENT_95
from .scene_arrays import Float32, PassData, RenderSettings, SceneArrays

LIGHT_PASSES = {
    f"{kind}_{part}": 3
    for kind in ("diffuse", "glossy", "transmission")
    for part in ("direct", "indirect", "color")
}
"""Light of one kind of scattering, divided by its colour: colour * (direct + indirect) is its part."""
KERNEL_PASSES = {
    **LIGHT_PASSES,
    "emission": 3,
    "environment": 3,
    "uv": 3,
    "mist": 1,
    "ambient_occlusion": 3,
    "denoising_albedo": 3,
    "denoising_normal": 3,
    "position": 3,
    "object_index": 1,
    "material_index": 1,
    "cryptomatte_object": 0,
    "cryptomatte_material": 0,
    "cryptomatte_asset": 0,
    "sample_count": 1,
}
"""Channels of what Job.read_pass gives; 0: two for each level of the mattes."""
ERROR_PASSES = {"standard_error": 1, "error_flags": 1}
PASS_CHANNELS = {"combined": 4, "depth": 1, "normal": 3, **KERNEL_PASSES, **ERROR_PASSES}
PASS_NAMES = tuple(name for name in PASS_CHANNELS if name != "combined")
"""What RenderSettings.passes may ask for; combined is always there."""


class PassSource(Protocol):
    """The part of a job that gives pictures; row 0 is the bottom row."""

    def combined(self, out: Float32, /) -> None: ...
    def depth(self, out: Float32, /) -> None: ...
    def normal(self, out: Float32, /) -> None: ...
    def read_pass(self, name: str, out: Float32, /) -> None: ...
    def error(self) -> dict[str, Any]: ...
    def pixel_error(self, half_width: Float32, flags: NDArray[np.uint8], /) -> dict[str, float]: ...


def film_shape(settings: RenderSettings) -> tuple[int, int]:
    """(height, width) of the film: the border's where there is one."""
    if settings.border is None:
        return (settings.height, settings.width)
    x_min, y_min, x_max, y_max = settings.border
    return (y_max - y_min, x_max - x_min)


def job_passes(scene: SceneArrays, settings: RenderSettings) -> tuple[str, ...]:
    """What a job is asked for: the user's passes, and alpha where the film is transparent."""
    wanted = tuple(name for name in PASS_NAMES if name in settings.passes and name not in ERROR_PASSES)
    if settings.aa == "mfaa" and "depth" not in wanted:
        wanted = (*wanted, "depth")
    return (*wanted, "alpha") if scene.transparent_film or has_holes(scene) else wanted


def read_combined(job: PassSource, scene: SceneArrays, shape: tuple[int, int]) -> Float32:
    """(h, w, 4) with associated alpha: a transparent film does not show the world itself."""
    pixels = np.zeros((*shape, 4), dtype=np.float32)
    job.combined(pixels)
    if scene.transparent_film and scene.environment is None:
        seen_world = (1.0 - pixels[..., 3:]) * np.asarray(scene.world, dtype=np.float32)
        pixels[..., :3] = np.maximum(pixels[..., :3] - seen_world, 0.0)
    return pixels


def read_passes(
    job: PassSource, scene: SceneArrays, settings: RenderSettings, shape: tuple[int, int]
) -> dict[str, Float32]:
    """The passes asked for, (h, w) where they have one channel, else (h, w, channels)."""
    found: dict[str, Float32] = {}
    if "depth" in settings.passes:
        found["depth"] = np.zeros(shape, dtype=np.float32)
        job.depth(found["depth"])
    if "normal" in settings.passes:
        found["normal"] = np.zeros((*shape, 3), dtype=np.float32)
        job.normal(found["normal"])
    for name in KERNEL_PASSES:
        if name in settings.passes:
            found[name] = read_kernel_pass(job, name, (*shape, channels_of(scene, name)))
    if scene.transparent_film and "environment" in found:
        found["environment"][...] = 0.0  # the world is not in the picture then
    if any(name in settings.passes for name in ERROR_PASSES):
        errors = read_errors(job, shape)
        found.update({name: errors[name] for name in ERROR_PASSES if name in settings.passes})
    return found


def channels_of(scene: SceneArrays, name: str) -> int:
    """Channels of pass `name`; those of mattes depend on how many levels the scene asks for."""
    levels = scene.pass_data.matte_levels if scene.pass_data is not None else PassData.matte_levels
    return PASS_CHANNELS[name] or 2 * levels


def read_kernel_pass(job: PassSource, name: str, shape: tuple[int, int, int]) -> Float32:
    pixels = np.zeros(shape, dtype=np.float32)
    job.read_pass(name, pixels)
    return pixels[..., 0] if shape[2] == 1 else pixels


def read_errors(job: PassSource, shape: tuple[int, int]) -> dict[str, Float32]:
    """Standard error of each pixel's luminance (0 below two replicates), and flags of pixel_error.py."""
    half_width, flags = np.zeros(shape, np.float32), np.zeros(shape, np.uint8)
    job.pixel_error(half_width, flags)
    state = job.error()
    freedom = min(state["replicates"], 8) - state.get("groups", 1)
    scale = 1.0 / STUDENT_95[freedom] if freedom > 0 else 0.0
    return {"standard_error": half_width * np.float32(scale), "error_flags": flags.astype(np.float32)}
