"""The pictures that a render gives: names, channels, and how they are read from a job."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from .scene_arrays import Float32, RenderSettings, SceneArrays

PASS_CHANNELS = {"combined": 4, "depth": 1, "normal": 3}
PASS_NAMES = ("depth", "normal")
"""What RenderSettings.passes may ask for; combined is always there."""


class PassSource(Protocol):
    """The part of a job that gives pictures; row 0 is the bottom row."""

    def combined(self, out: Float32, /) -> None: ...
    def depth(self, out: Float32, /) -> None: ...
    def normal(self, out: Float32, /) -> None: ...


def film_shape(settings: RenderSettings) -> tuple[int, int]:
    """(height, width) of the film: the border's where there is one."""
    if settings.border is None:
        return (settings.height, settings.width)
    x_min, y_min, x_max, y_max = settings.border
    return (y_max - y_min, x_max - x_min)


def job_passes(scene: SceneArrays, settings: RenderSettings) -> tuple[str, ...]:
    """What a job is asked for: the user's passes, and alpha where the film is transparent."""
    wanted = tuple(name for name in PASS_NAMES if name in settings.passes)
    return (*wanted, "alpha") if scene.transparent_film else wanted


def read_combined(job: PassSource, scene: SceneArrays, shape: tuple[int, int]) -> Float32:
    """(h, w, 4) with associated alpha: a transparent film does not show the world itself."""
    pixels = np.zeros((*shape, 4), dtype=np.float32)
    job.combined(pixels)
    if scene.transparent_film and scene.environment is None:
        seen_world = (1.0 - pixels[..., 3:]) * np.asarray(scene.world, dtype=np.float32)
        pixels[..., :3] = np.maximum(pixels[..., :3] - seen_world, 0.0)
    return pixels


def read_passes(job: PassSource, settings: RenderSettings, shape: tuple[int, int]) -> dict[str, Float32]:
    """The passes asked for: depth (h, w), normal (h, w, 3)."""
    found: dict[str, Float32] = {}
    if "depth" in settings.passes:
        found["depth"] = np.zeros(shape, dtype=np.float32)
        job.depth(found["depth"])
    if "normal" in settings.passes:
        found["normal"] = np.zeros((*shape, 3), dtype=np.float32)
        job.normal(found["normal"])
    return found
