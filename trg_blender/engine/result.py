"""Blender's render result: which passes there are, how pixels get in, and what stays after a render."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np

from .cryptomatte import metadata
from .mfaa import SampledFrame
from .report import Progress
from .scene_arrays import Float32, SceneArrays

_LONG = bpy.app.version >= (5, 0)
"""Blender 5 spells names of passes out."""


@dataclass(frozen=True, slots=True)
class BlenderPass:
    """How Blender asks for a pass and what it calls it."""

    switch: str
    """property of the view layer, or of its `trg` where it begins with a dot"""
    name: str
    """without the two digits of a matte's layers"""
    channels: str
    kind: str
    """VALUE, VECTOR or COLOR"""


def _light(kind: str, part: str) -> BlenderPass:
    short = {"diffuse": "Diff", "glossy": "Gloss", "transmission": "Trans"}[kind] + {
        "direct": "Dir",
        "indirect": "Ind",
        "color": "Col",
    }[part]
    name = f"{kind} {part}".title() if _LONG else short
    return BlenderPass(f"use_pass_{kind}_{part}", name, "RGB", "COLOR")


def _named(long: str, short: str) -> str:
    return long if _LONG else short


PASSES = {
    "depth": BlenderPass("use_pass_z", "Depth", "Z", "VALUE"),
    "normal": BlenderPass("use_pass_normal", "Normal", "XYZ", "VECTOR"),
    "position": BlenderPass("use_pass_position", "Position", "XYZ", "VECTOR"),
    "uv": BlenderPass("use_pass_uv", "UV", "UVA", "VECTOR"),
    "mist": BlenderPass("use_pass_mist", "Mist", "Z", "VALUE"),
    "object_index": BlenderPass("use_pass_object_index", _named("Object Index", "IndexOB"), "X", "VALUE"),
    "material_index": BlenderPass(
        "use_pass_material_index", _named("Material Index", "IndexMA"), "X", "VALUE"
    ),
    **{
        f"{kind}_{part}": _light(kind, part)
        for kind in ("diffuse", "glossy", "transmission")
        for part in ("direct", "indirect", "color")
    },
    "emission": BlenderPass("use_pass_emit", _named("Emission", "Emit"), "RGB", "COLOR"),
    "environment": BlenderPass("use_pass_environment", _named("Environment", "Env"), "RGB", "COLOR"),
    "ambient_occlusion": BlenderPass(
        "use_pass_ambient_occlusion", _named("Ambient Occlusion", "AO"), "RGB", "COLOR"
    ),
    "cryptomatte_object": BlenderPass("use_pass_cryptomatte_object", "CryptoObject", "RGBA", "COLOR"),
    "cryptomatte_material": BlenderPass("use_pass_cryptomatte_material", "CryptoMaterial", "RGBA", "COLOR"),
    "cryptomatte_asset": BlenderPass("use_pass_cryptomatte_asset", "CryptoAsset", "RGBA", "COLOR"),
    "denoising_albedo": BlenderPass(".use_pass_denoising", "Denoising Albedo", "RGB", "COLOR"),
    "denoising_normal": BlenderPass(".use_pass_denoising", "Denoising Normal", "XYZ", "VECTOR"),
    "sample_count": BlenderPass(".use_pass_sample_count", "Sample Count", "X", "VALUE"),
    "standard_error": BlenderPass(".use_pass_standard_error", "Standard Error", "X", "VALUE"),
    "error_flags": BlenderPass(".use_pass_standard_error", "Error Flags", "X", "VALUE"),
}
"""Our name -> how Blender has it."""


def wanted_passes(layer: bpy.types.ViewLayer) -> tuple[str, ...]:
    """Passes besides combined that `layer` asks for."""
    own = getattr(layer, "trg", None)
    wanted = []
    for name, each in PASSES.items():
        holder, switch = (own, each.switch[1:]) if each.switch.startswith(".") else (layer, each.switch)
        if getattr(holder, switch, False):
            wanted.append(name)
    return tuple(wanted)


def layers_of(name: str, levels: int) -> list[str]:
    """Blender's names of a pass: a matte has one for every two ids of a pixel."""
    each = PASSES[name]
    if not name.startswith("cryptomatte"):
        return [each.name]
    return [f"{each.name}{number:02d}" for number in range((levels + 1) // 2)]


def register_passes(
    engine: bpy.types.RenderEngine, scene: bpy.types.Scene, layer: bpy.types.ViewLayer
) -> None:
    """Announces the passes of `layer`, for the compositor's sockets and for files."""
    engine.register_pass(scene, layer, "Combined", 4, "RGBA", "COLOR")
    for name in wanted_passes(layer):
        each = PASSES[name]
        for blender_name in layers_of(name, layer.pass_cryptomatte_depth):
            engine.register_pass(scene, layer, blender_name, len(each.channels), each.channels, each.kind)


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
    for name, values in passes.items():
        pixels.update(split_layers(name, values))
    for each in result.layers[0].passes:
        if each.name in pixels:
            each.rect.foreach_set(np.ascontiguousarray(pixels[each.name], np.float32).reshape(-1))


def split_layers(name: str, values: Float32) -> dict[str, Float32]:
    """Pictures by Blender's names; a matte (h, w, 2 ids) in layers of two ids, the last filled up."""
    if not name.startswith("cryptomatte"):
        return {PASSES[name].name: values}
    levels = values.shape[-1] // 2
    if levels % 2:
        values = np.concatenate([values, np.zeros_like(values[..., :2])], axis=-1)
    names = layers_of(name, levels)
    return {each: values[..., 4 * k : 4 * k + 4] for k, each in enumerate(names)}


def stamp_mattes(
    result: bpy.types.RenderResult, layer: str, arrays: SceneArrays, passes: Sequence[str]
) -> None:
    """Writes into `result` what the Cryptomatte passes of `layer` are called and whom their ids stand for."""
    if arrays.pass_data is None:
        return
    who = [each for instance in arrays.instances for each in instance.identities]
    names = {
        "cryptomatte_object": [each.name for each in who],
        "cryptomatte_asset": [each.asset for each in who],
        "cryptomatte_material": [each.name for each in arrays.pass_data.materials],
    }
    for name in sorted(names.keys() & set(passes)):
        for field_name, value in metadata(f"{layer}.{PASSES[name].name}", names[name]).items():
            result.stamp_data_add_field(field_name, value)


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
    _frames: dict[str, SampledFrame] = field(default_factory=dict)
    _progress: dict[str, Progress] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def keep_report(self, scene_name: str, report: dict[str, Any]) -> None:
        """Remembers `report` as the last one of the scene."""
        with self._lock:
            self._reports[scene_name] = report
            self._progress.pop(scene_name, None)

    def keep_failure(self, scene_name: str, failure: Failure) -> None:
        """Remembers why the scene's last render gave no picture."""
        with self._lock:
            self._failures[scene_name] = failure
            self._progress.pop(scene_name, None)

    def keep_progress(self, scene_name: str, progress: Progress) -> None:
        """Remembers how far the scene's running render has come, until it ends."""
        with self._lock:
            self._progress[scene_name] = progress

    def exchange_frame(self, scene_name: str, frame: SampledFrame) -> SampledFrame | None:
        """Remembers the frame that the scene's next one blends with; gives the one before."""
        with self._lock:
            before = self._frames.get(scene_name)
            self._frames[scene_name] = frame
            return before

    def report_of(self, scene_name: str) -> dict[str, Any] | None:
        """The last report of the scene, None before its first render."""
        with self._lock:
            return self._reports.get(scene_name)

    def progress_of(self, scene_name: str) -> Progress | None:
        """How far the scene's render has come; None while there is none."""
        with self._lock:
            return self._progress.get(scene_name)

    def is_rendering(self) -> bool:
        """Whether any scene's render is under way."""
        with self._lock:
            return bool(self._progress)

    def failure_of(self, scene_name: str) -> Failure | None:
        """Why the scene's last render gave no picture; None when it gave one."""
        with self._lock:
            return self._failures.get(scene_name)

    def forget(self, scene_name: str) -> None:
        """Forgets all of it: a new render begins."""
        with self._lock:
            self._progress.pop(scene_name, None)
            self._reports.pop(scene_name, None)
            self._failures.pop(scene_name, None)


records = RenderRecords()
"""The one store of this process: Blender gives engines no place that panels may read from."""
