"""Pictures for a viewport: a thread that traces what the viewer asks for, and the newest picture.

The caller says what there is (`show`) and whence it is seen (`look`), and asks for the newest `picture`
whenever it draws; none of these waits for anything. After each change a coarse picture comes first, small
enough to be there at once, then the fine one from its first sample on. A scene that is refused leaves the
last good picture where it is.
"""

from __future__ import annotations

import math
import os
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from . import session
from .devices import Unavailable
from .errors import SceneError
from .kept_scene import KeptScene
from .report import ENDLESS_SAMPLES, format_progress
from .scene_arrays import Camera, Float32, RenderSettings, SceneArrays

POLL_SECONDS = 0.004
COARSE_SECONDS = 0.03
"""What a coarse picture may take; pictures that take less at full size are never coarse."""
COARSEST = 8
FIRST_SCALE = 4
"""Pixels of the viewport along a pixel of the picture, before anything is known of the scene's cost."""
PICTURE_SECONDS = 0.2
"""Between pictures of a job, once it has a few samples."""
LARGEST_VALUE = 65504.0
"""Textures of halves, which Blender draws into, end there."""
NICENESS = 5

Rect = tuple[int, int, int, int]


@dataclass(frozen=True, slots=True)
class View:
    """Whence a viewport looks and how large it is."""

    camera: Camera
    width: int
    height: int
    border: Rect | None = None
    """x_min, y_min, x_max, y_max in pixels of the viewport, maxima exclusive: only this part is wanted"""

    def key(self) -> tuple[object, ...]:
        """Equal for views that show the same."""
        camera = self.camera
        lens = (camera.aperture, camera.focus, camera.blades, camera.blade_turn, camera.squeeze)
        seen = (camera.kind, camera.matrix.tobytes(), camera.window, camera.clip_start, camera.clip_end)
        return (*seen, *lens, self.width, self.height, self.border)


@dataclass(frozen=True, slots=True)
class Picture:
    """Never changed once it is there."""

    number: int
    """rises from picture to picture"""
    pixels: Float32
    """(h, w, 4) linear, associated alpha, at most 65504; row 0 is the bottom row"""
    place: tuple[float, float, float, float]
    """x_min, y_min, x_max, y_max of where it belongs, in parts of the viewport"""
    samples: float
    scale: int
    """pixels of the viewport along a pixel of the picture"""
    change: int
    """how many changes of scene and view there had been"""


@dataclass(frozen=True, slots=True)
class Request:
    """All that a picture is made of."""

    change: int
    scene: SceneArrays
    settings: RenderSettings
    view: View


class ViewportTracer:
    """`redraw` is called, by the tracing thread, whenever there is something new to draw or say."""

    def __init__(self, redraw: Callable[[], None]) -> None:
        self._redraw = redraw
        self._wake = threading.Condition()
        self._shown: tuple[SceneArrays, RenderSettings] | None = None
        self._view: View | None = None
        self._generation = 0
        self._closing = False
        self._picture: Picture | None = None
        self._status = ""
        self._error = ""
        self._kept = KeptScene()
        self._pixel_seconds = 0.0
        self._thread: threading.Thread | None = None

    def show(self, scene: SceneArrays, settings: RenderSettings) -> None:
        """From now on `scene` is to be seen; size, border, samples of coarse pictures are the view's own."""
        with self._wake:
            self._shown = (scene, settings)
            self._error = ""
            self._change()

    def look(self, view: View) -> None:
        """From now on it is seen so; nothing happens when it already is."""
        with self._wake:
            if self._view is None or self._view.key() != view.key():
                self._view = view
                self._change()

    def refuse(self, error: str) -> None:
        """The scene cannot be shown: the last picture stays."""
        with self._wake:
            is_new, self._error = error != self._error, error
        if is_new:
            self._redraw()

    def picture(self) -> Picture | None:
        """The newest one; None before the first."""
        return self._picture

    def status(self) -> str:
        """One line: samples and error so far, or what is wrong."""
        return f"error: {self._error.splitlines()[0]}" if self._error else self._status

    @property
    def changes(self) -> int:
        """How many changes of scene and view there were."""
        return self._generation

    @property
    def error(self) -> str:
        """What is wrong with the scene; empty when it is shown."""
        return self._error

    def close(self, wait_seconds: float | None = None) -> bool:
        """Stops tracing and gives all memory back; may be called again.

        Waits at most so long for the thread, which ends by itself; False when it has not yet.
        """
        with self._wake:
            self._closing = True
            self._generation += 1
            self._shown = None
            self._wake.notify_all()
        thread = self._thread
        if thread is None or thread is threading.current_thread():
            return True
        thread.join(wait_seconds)
        return not thread.is_alive()

    def _change(self) -> None:
        """Wakes the thread, which is started at the first change; the lock is held."""
        self._generation += 1
        if self._thread is None and not self._closing:
            self._thread = threading.Thread(target=self._run, name="TRG viewport", daemon=True)
            self._thread.start()
        self._wake.notify_all()

    def _run(self) -> None:
        if sys.platform == "linux":
            # On Linux of this thread and those that it starts alone: the interface goes first.
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICENESS)
        try:
            self._serve()
        finally:
            self._kept.forget()

    def _serve(self) -> None:
        done = 0
        while True:
            with self._wake:
                self._wake.wait_for(lambda seen=done: self._closing or self._is_wanted(seen))
                if self._closing:
                    return
                done = self._generation
                assert self._shown is not None and self._view is not None
                request = Request(done, *self._shown, self._view)
            try:
                self._trace(request)
            except (SceneError, Unavailable) as error:
                self._fail(done, str(error))
            except Exception as error:  # noqa: BLE001 - the border of the thread
                self._fail(done, f"internal error: {type(error).__name__}: {error}")

    def _is_wanted(self, done: int) -> bool:
        return self._generation != done and self._shown is not None and self._view is not None

    def _fail(self, generation: int, error: str) -> None:
        self._kept.forget()
        if generation == self._generation:
            self.refuse(error)

    def _trace(self, request: Request) -> None:
        scale = self._coarse_scale(request.view)
        if scale > 1:
            coarse = replace(request.settings, samples=1, aa="sobol")
            self._follow(request, coarse, scale, lambda: False)
        if request.change == self._generation:
            self._follow(request, request.settings, 1, lambda: request.change != self._generation)

    def _coarse_scale(self, view: View) -> int:
        if self._pixel_seconds <= 0.0:
            return FIRST_SCALE
        x_min, y_min, x_max, y_max = view.border or (0, 0, view.width, view.height)
        needed = math.sqrt((x_max - x_min) * (y_max - y_min) * self._pixel_seconds / COARSE_SECONDS)
        return min(max(math.ceil(needed), 1), COARSEST)

    def _follow(
        self, request: Request, wish: RenderSettings, scale: int, is_over: Callable[[], bool]
    ) -> None:
        """Traces one job to its end or until `is_over`, publishing what it has now and then."""
        settings = settings_for(request.view, wish, scale)
        scene = replace(request.scene, camera=request.view.camera)
        job = session.start(scene, settings, self._kept)
        published, due = 0.0, 0.0
        while not self._closing:
            progress = job.poll(POLL_SECONDS)
            if is_over():
                break
            now = time.monotonic()
            is_due = progress.samples >= 2 * published or now >= due
            if progress.samples >= 1 and progress.samples > published and (is_due or progress.done):
                self._learn(progress.seconds, progress.samples, settings)
                self._status = format_progress(progress)
                self._publish(job.picture(), settings, (progress.samples, scale, request.change))
                published, due = progress.samples, time.monotonic() + PICTURE_SECONDS
            if progress.done:
                break
        job.cancel()

    def _learn(self, seconds: float, samples: float, settings: RenderSettings) -> None:
        """What a sample of a pixel costs, to choose how coarse the next picture must be."""
        x_min, y_min, x_max, y_max = settings.border or (0, 0, settings.width, settings.height)
        self._pixel_seconds = seconds / (samples * (x_max - x_min) * (y_max - y_min))

    def _publish(self, pixels: Float32, settings: RenderSettings, made: tuple[float, int, int]) -> None:
        number = 1 if self._picture is None else self._picture.number + 1
        np.clip(pixels, -LARGEST_VALUE, LARGEST_VALUE, out=pixels)
        width, height = settings.width, settings.height
        x_min, y_min, x_max, y_max = settings.border or (0, 0, width, height)
        place = (x_min / width, y_min / height, x_max / width, y_max / height)
        self._picture = Picture(number, pixels, place, *made)
        self._redraw()


def settings_for(view: View, wish: RenderSettings, scale: int) -> RenderSettings:
    """Settings of a picture of `view` whose pixels are `scale` of the viewport's along a side."""
    width, height = (max(math.ceil(side / scale), 1) for side in (view.width, view.height))
    border = view.border
    if border is not None:
        x_min, y_min = min(border[0] // scale, width - 1), min(border[1] // scale, height - 1)
        x_max, y_max = (math.ceil(side / scale) for side in border[2:])
        border = (x_min, y_min, min(max(x_max, x_min + 1), width), min(max(y_max, y_min + 1), height))
    samples = wish.samples if wish.samples > 0 else ENDLESS_SAMPLES
    return replace(
        wish,
        width=width,
        height=height,
        border=border,
        samples=samples,
        passes=(),
        seconds=0.0,
        rmse=0.0,
        adaptive=False,
    )
