"""Blender's render result: which passes there are, how pixels get in, and what stays after a render."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np

from .report import Progress
from .scene_arrays import Float32

PASSES = {
    "depth": ("use_pass_z", "Depth", "Z", "VALUE"),
    "normal": ("use_pass_normal", "Normal", "XYZ", "VECTOR"),
}
"""Our name -> the view layer's switch, Blender's name, channels and type."""


def wanted_passes(layer: bpy.types.ViewLayer) -> tuple[str, ...]:
    """Passes besides combined that `layer` asks for."""
    return tuple(name for name, (switch, *_) in PASSES.items() if getattr(layer, switch))


def register_passes(
    engine: bpy.types.RenderEngine, scene: bpy.types.Scene, layer: bpy.types.ViewLayer
) -> None:
    """Announces the passes of `layer`, for the compositor's sockets and for files."""
    engine.register_pass(scene, layer, "Combined", 4, "RGBA", "COLOR")
    for name in wanted_passes(layer):
        _, blender_name, channels, kind = PASSES[name]
        engine.register_pass(scene, layer, blender_name, len(channels), channels, kind)


def border_of(
    scene: bpy.types.Scene, size: tuple[int, int], part: tuple[int, int]
) -> tuple[int, int, int, int] | None:
    """Where the part of `part` pixels that Blender asked for lies in the picture of `size` pixels."""
    if part == size:
        return None
    x_min = min(int(scene.render.border_min_x * size[0]), size[0] - part[0])
    y_min = min(int(scene.render.border_min_y * size[1]), size[1] - part[1])
    return (x_min, y_min, x_min + part[0], y_min + part[1])


def write_pixels(result: bpy.types.RenderResult, picture: Float32, passes: Mapping[str, Float32]) -> None:
    """Puts combined (h, w, 4) and the passes that `result` has into its first layer; row 0 is the bottom."""
    pixels = {"Combined": picture}
    pixels.update({PASSES[name][1]: values for name, values in passes.items() if name in PASSES})
    for each in result.layers[0].passes:
        if each.name in pixels:
            each.rect.foreach_set(np.ascontiguousarray(pixels[each.name], np.float32).reshape(-1))


FAILURE_KINDS = ("program", "scene", "budget", "cancelled", "unavailable", "internal")


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a render gave no picture."""

    kind: str
    """one of FAILURE_KINDS"""
    message: str


@dataclass(slots=True)
class RenderRecords:
    """What the renders of this process left behind, by scene name.

    Renders may run in other threads than the panels that read this.
    """

    watcher: Callable[[Progress], None] | None = None
    """called now and then by the thread that renders"""
    _reports: dict[str, dict[str, Any]] = field(default_factory=dict)
    _failures: dict[str, Failure] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def keep_report(self, scene_name: str, report: dict[str, Any]) -> None:
        """Remembers `report` as the last one of the scene."""
        with self._lock:
            self._reports[scene_name] = report

    def keep_failure(self, scene_name: str, failure: Failure) -> None:
        """Remembers why the scene's last render gave no picture."""
        with self._lock:
            self._failures[scene_name] = failure

    def report_of(self, scene_name: str) -> dict[str, Any] | None:
        """The last report of the scene, None before its first render."""
        with self._lock:
            return self._reports.get(scene_name)

    def failure_of(self, scene_name: str) -> Failure | None:
        """Why the scene's last render gave no picture; None when it gave one."""
        with self._lock:
            return self._failures.get(scene_name)

    def forget(self, scene_name: str) -> None:
        """Forgets both: a new render begins."""
        with self._lock:
            self._reports.pop(scene_name, None)
            self._failures.pop(scene_name, None)


records = RenderRecords()
"""The one store of this process: Blender gives engines no place that panels may read from."""
