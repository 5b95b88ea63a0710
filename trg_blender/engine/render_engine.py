"""The engine class that Blender calls: sync in update(), tracing in render(), nothing else.

Blender runs these callbacks on the main thread without a window and in a job thread with one. An
exception that left them would be saved as a black picture, so each works inside `reported_errors`.
"""

from __future__ import annotations

import contextlib
import logging
import math
import time
import weakref
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import bpy

from . import run_text, session
from .antialiasing import FINEST_GRID
from .devices import DEVICE_NAMES, Unavailable, find_device
from .errors import SceneError
from .from_blender import SceneReader
from .kept_scene import KeptScene
from .mfaa import blend_frames
from .native import ACCELERATORS
from .pace import Pace
from .path_rules import PathRules
from .picture_stamp import stamp_fields
from .report import Progress, format_progress, with_source
from .result import Failure, border_of, records, register_passes, stamp_mattes, wanted_passes, write_pixels
from .run_text import ENGINE_ID
from .scene_arrays import Float32, RenderSettings, SceneArrays
from .shots import RESULT, shots
from .to_blender import requested_modes
from .viewport import Viewport, close_all, shown_errors, status_of

POLL_SECONDS = 0.03
BUDGET = 3
"""exit code of a program that a limit stopped"""

_log = logging.getLogger(__name__)


class RenderCancelled(Exception):
    """The user stopped the render."""


class ProgramFailed(Exception):
    """The scene's program ended in an error before this frame."""

    def __init__(self, failure: Failure) -> None:
        super().__init__(failure.message)
        self.failure = failure


@dataclass(slots=True)
class Frame:
    """What update() hands to render(): copies, so that the depsgraph is not touched while tracing."""

    scene_name: str
    arrays: SceneArrays
    settings: RenderSettings
    number: int
    file: str
    """the .blend file; empty while it was never saved"""
    seconds: dict[str, float]
    layer: str
    persistent: bool
    """whether the next frame may build upon this one"""


@contextlib.contextmanager
def reported_errors(engine: TRGRenderEngine, doing: str) -> Iterator[None]:
    """The border between Blender and us: whatever goes wrong inside becomes one line of report({'ERROR'}).

    A context manager, not a decorator: Blender counts the arguments of the callbacks themselves.
    """
    try:
        yield
    except RenderCancelled:
        engine.refuse(Failure("cancelled", "the render was cancelled"))
    except SceneError as error:
        engine.refuse(Failure("scene", str(error)))
    except Unavailable as error:
        engine.refuse(Failure("unavailable", str(error)))
    except ProgramFailed as error:
        engine.refuse(error.failure)
    except Exception as error:  # noqa: BLE001 - the border of every callback
        _log.debug("while %s", doing, exc_info=True)
        engine.refuse(Failure("internal", f"internal error while {doing}: {type(error).__name__}: {error}"))


class TRGRenderEngine(bpy.types.RenderEngine):
    """Final renders and rendered viewports by TRG; material previews are EEVEE's."""

    bl_idname = ENGINE_ID
    bl_label = "TRG"
    bl_use_preview = False
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False
    bl_use_gpu_context = False

    frame: Frame | None = None
    scene_name: str = ""
    kept: dict[str, KeptScene] | None = None
    """by view layer; only with persistent data, where Blender keeps the engine as well"""

    viewport: Viewport | None = None
    """of an engine that draws one"""

    def refuse(self, failure: Failure) -> None:
        """No picture: report() stops the render and the file; error_set() shows it in the image editor."""
        self.frame = None
        records.keep_failure(self.scene_name, failure)
        self.report({"ERROR"}, failure.message)
        if not bpy.app.background:
            self.error_set(failure.message)

    def update_render_passes(self, scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> None:
        """Called by Blender whenever passes may have changed."""
        with reported_errors(self, "listing passes"):
            register_passes(self, scene, layer)

    def update(self, data: bpy.types.BlendData, depsgraph: bpy.types.Depsgraph) -> None:
        """Called by Blender before each render(): copies what is to be rendered out of Blender."""
        self.frame = None
        self.scene_name = depsgraph.scene.name
        records.forget(self.scene_name)
        with reported_errors(self, "reading the scene"):
            self.frame = self._read(data, depsgraph)

    def render(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Called by Blender for each view layer: traces what update() copied."""
        frame, self.frame = self.frame, None
        if frame is None:
            return
        with reported_errors(self, "rendering"):
            self._render(frame, depsgraph)

    def view_update(self, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """Called by Blender when what the viewport shows has changed: copies it."""
        viewport = self._viewport()
        with shown_errors(viewport, "reading the scene"):
            viewport.update(depsgraph, preview_settings(depsgraph))

    def view_draw(self, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """Called by Blender to draw a viewport, also whenever it is turned."""
        viewport = self._viewport()
        with shown_errors(viewport, "drawing"):
            viewport.draw(context, depsgraph)
        self.update_stats("TRG", status_of(viewport.tracer, depsgraph.scene))

    def __del__(self) -> None:
        with contextlib.suppress(ReferenceError):  # Blender has freed its part first
            if self.viewport is not None:
                self.viewport.close()

    def _viewport(self) -> Viewport:
        if self.viewport is None:
            me = weakref.ref(self)

            def redraw() -> None:
                engine = me()
                if engine is not None:
                    with contextlib.suppress(ReferenceError):  # Blender has freed it
                        engine.tag_redraw()

            self.viewport = Viewport(redraw)
        return self.viewport

    def _read(self, data: bpy.types.BlendData, depsgraph: bpy.types.Depsgraph) -> Frame:
        scene = depsgraph.scene_eval
        pending = run_text.take_pending_error(depsgraph.scene)
        if pending is not None:
            raise ProgramFailed(Failure("budget" if pending.exit_code == BUDGET else "program", pending.text))
        begin = time.perf_counter()
        self.update_stats("TRG", "reading the scene")
        size = (self.resolution_x, self.resolution_y)
        passes = wanted_passes(depsgraph.view_layer)
        arrays = SceneReader(passes=passes, frame_set=self._move_to).read(scene, depsgraph, size)
        modes = requested_modes(depsgraph.scene)
        settings = settings_of(scene, depsgraph.view_layer, size, modes, arrays.warnings)
        for warning in arrays.warnings:
            self.report({"WARNING"}, warning)
        seconds = {"sync": time.perf_counter() - begin}
        return Frame(
            self.scene_name,
            arrays,
            settings,
            scene.frame_current,
            data.filepath,
            seconds,
            depsgraph.view_layer.name,
            scene.render.use_persistent_data,
        )

    def _move_to(self, frame: float) -> None:
        """Evaluates the scene at another time, for motion blur."""
        whole = math.floor(frame)
        self.frame_set(whole, frame - whole)

    def _render(self, frame: Frame, depsgraph: bpy.types.Depsgraph) -> None:
        """Fills the result of one view layer; Blender may ask for a part of the picture only."""
        size = (frame.settings.width, frame.settings.height)
        result = self.begin_result(0, 0, *size, layer=depsgraph.view_layer.name)
        if result is None:
            return
        cancelled = True
        try:
            part = (result.resolution_x, result.resolution_y)
            border = border_of(depsgraph.scene, size, part)
            frame.settings = replace(frame.settings, border=border)
            cancelled = self._trace(frame, result)
        finally:
            self.end_result(result, cancel=cancelled, do_merge_results=True)

    def _trace(self, frame: Frame, result: bpy.types.RenderResult) -> bool:
        """Runs the job to its end; True when the user cancelled it (what is there is kept)."""
        self.update_stats("TRG", "building the accelerator")
        job = session.start(frame.arrays, frame.settings, self._kept_scene(frame))
        interrupted = False
        try:
            self._follow(job, result)
        except KeyboardInterrupt:  # Blender as a module hands ^C to whatever Python code runs
            interrupted = True
            job.cancel()
        outcome = job.result()
        pixels, reused = blend_with_last(job, outcome, frame.scene_name)
        write_pixels(result, pixels, outcome.passes)
        outcome.report["numerics"]["reprojected_pixels"] = reused
        report = with_source(outcome.report, frame.file, frame.number, frame.seconds)
        self._stamp(frame, result.layers[0].name, report)
        records.keep_report(frame.scene_name, report)
        if not (self.is_preview or bpy.app.background):
            shots.keep(frame.scene_name, active_slot(), (frame.arrays, frame.settings), outcome)
        if interrupted:
            raise RenderCancelled
        return self.test_break()

    def _kept_scene(self, frame: Frame) -> KeptScene | None:
        """What the layer's next frame may build upon; None, and memory given back, where it may not."""
        if not frame.persistent:
            self.kept = None
            return None
        if self.kept is None:
            self.kept = {}
        return self.kept.setdefault(frame.layer, KeptScene())

    def _stamp(self, frame: Frame, layer: str, report: Mapping[str, Any]) -> None:
        """Into the whole render's result: Blender forgets the fields of the part that a layer fills."""
        whole = self.get_result()
        if whole is not None:
            for name, value in stamp_fields(report).items():
                whole.stamp_data_add_field(name, value)
            stamp_mattes(whole, layer, frame.arrays, frame.settings.passes)

    def _follow(self, job: session.RenderJob, result: bpy.types.RenderResult) -> None:
        """Polls until the job is done; shows progress and, with a window, the picture so far."""
        pace = Pace(bpy.app.background)
        while not (progress := job.poll(POLL_SECONDS)).done:
            if self.test_break():
                job.cancel()
            if pace.wants_line():
                self._say(progress)
            if pace.wants_picture():
                begin = time.perf_counter()
                write_pixels(result, job.picture(), {})
                self.update_result(result)
                pace.picture_took(time.perf_counter() - begin)
        self._say(progress)

    def _say(self, progress: Progress) -> None:
        self.update_progress(progress.share)
        self.update_stats("TRG", format_progress(progress))
        if not progress.done:
            records.keep_progress(self.scene_name, progress)
        if records.watcher is not None:
            records.watcher(progress)


def blend_with_last(
    job: session.RenderJob, outcome: session.Result, scene_name: str
) -> tuple[Float32, int]:
    """The picture, by `mfaa` together with the frame before, and how many pixels that gave to."""
    frame = job.sampled_frame()
    if frame is None:
        return outcome.pixels, 0
    return blend_frames(frame, records.exchange_frame(scene_name, frame))


def active_slot() -> int:
    """The slot that renders go into, counted from 0."""
    image = bpy.data.images.get(RESULT)
    return 0 if image is None else int(image.render_slots.active_index)


def choose_antialiasing(
    own: bpy.types.PropertyGroup, modes: Mapping[str, str | int], warnings: list[str]
) -> tuple[str, int]:
    """Method and cells a side: the user's, or with Auto what the program asked for, or Sobol's points."""
    if own.aa != "auto":
        return own.aa, own.aa_side
    if "antialiasing" not in modes:
        return "sobol", own.aa_side
    side = int(modes.get("antialiasing_n", 1))
    if side > FINEST_GRID:
        warnings.append(f"std::setaa: a grid of {side} x {side} is too fine, {FINEST_GRID} is used")
    return str(modes["antialiasing"]), min(side, FINEST_GRID)


def settings_of(
    scene: bpy.types.Scene,
    layer: bpy.types.ViewLayer,
    size: tuple[int, int],
    modes: Mapping[str, str | int],
    warnings: list[str],
) -> RenderSettings:
    """Render settings from `scene.trg`, what its program asked for (`modes`), and Blender's own.

    A program's wish that cannot be fulfilled here is a warning; the user's own is an error later.
    """
    own = scene.trg
    device, accel = own.device, own.accel
    if device == "auto":
        device = choose_device(modes.get("device"), warnings)
    if accel == "auto" and "accel" in modes:
        accel = str(modes["accel"])
        if accel not in ACCELERATORS:
            warnings.append(f"accelerator {accel}: not built yet in this version; auto is used")
            accel = "auto"
    aa, aa_side = choose_antialiasing(own, modes, warnings)
    return RenderSettings(
        width=size[0],
        height=size[1],
        samples=own.samples,
        seconds=own.time_limit if own.use_time_limit else 0.0,
        rmse=own.error_target if own.use_error_target else 0.0,
        adaptive=own.use_adaptive and (own.use_time_limit or own.use_error_target) and device != "embree",
        pixel_filter=own.filter_type.lower(),
        filter_width=1.0 if own.filter_type == "BOX" else own.filter_width,
        seed=own.seed,
        max_bounces=own.max_bounces,
        rules=rules_of(own),
        threads=scene.render.threads if scene.render.threads_mode == "FIXED" else 0,
        device=device,
        accel=accel,
        integrator=own.integrator,
        aa=aa,
        aa_side=aa_side,
        frame=scene.frame_current,
        passes=wanted_passes(layer),
    )


def preview_settings(depsgraph: bpy.types.Depsgraph) -> RenderSettings:
    """Settings of viewports: those of renders, but for the samples. The size is each view's own."""
    scene = depsgraph.scene_eval
    modes = requested_modes(depsgraph.scene)
    settings = settings_of(scene, depsgraph.view_layer, (1, 1), modes, [])
    return replace(settings, samples=scene.trg.preview_samples)


def rules_of(own: bpy.types.PropertyGroup) -> PathRules:
    """What of the panel "Light Paths" cuts paths short."""
    return PathRules(
        own.diffuse_bounces,
        own.glossy_bounces,
        own.transmission_bounces,
        own.transparent_bounces,
        own.clamp_direct,
        own.clamp_indirect,
        own.caustics_reflective,
        own.caustics_refractive,
    )


def choose_device(wish: str | int | None, warnings: list[str]) -> str:
    """The program's wish if it can be had, else the native core, else the reference on Embree."""
    if wish in DEVICE_NAMES:
        device = find_device(str(wish))
        if device.available:
            return device.name
        warnings.append(f"device {device.name}: {device.reason}; the default is used")
    native, embree = find_device("cpu"), find_device("embree")
    if not native.available and embree.available:
        warnings.append(f"device cpu: {native.reason}; the slow reference renderer is used")
        return embree.name
    return native.name


CLASSES = (TRGRenderEngine,)

register, _unregister = bpy.utils.register_classes_factory(CLASSES)


def unregister() -> None:
    close_all()
    _unregister()
