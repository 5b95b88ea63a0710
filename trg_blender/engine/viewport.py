"""One rendered 3D viewport: what Blender shows goes to a tracer, its pictures are drawn.

Everything here runs on the main thread and only copies: building and tracing are the tracer's thread's
(viewport_tracer.py). Pictures are drawn scene-linear; Blender applies the view transform itself.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from dataclasses import replace

import bpy
import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d

from . import run_text
from .devices import Unavailable
from .errors import SceneError
from .from_blender import SceneReader
from .from_blender.known_data import KnownData
from .from_blender.view import read_view
from .scene_arrays import Camera, RenderSettings
from .viewport_tracer import Picture, View, ViewportTracer

NO_CAMERA = Camera(0, np.eye(3, 4), (-1.0, 1.0, -1.0, 1.0))
"""stands in while the scene is read; every view brings its own"""

CLOSING_SECONDS = 0.02
"""What a thread is waited for that is building something."""

open_tracers: set[ViewportTracer] = set()
"""All whose threads may run: those that Blender does not close are closed with the add-on."""


class Viewport:
    """Belongs to one engine instance of Blender's."""

    def __init__(self, redraw: Callable[[], None]) -> None:
        self.tracer = ViewportTracer(redraw)
        self._known = KnownData()
        self._texture: gpu.types.GPUTexture | None = None
        self._drawn = 0
        open_tracers.add(self.tracer)

    def update(self, depsgraph: bpy.types.Depsgraph, settings: RenderSettings) -> None:
        """Reads the scene. Raises SceneError when there is nothing to render from."""
        reader = SceneReader(camera=NO_CAMERA, known=self._known)
        arrays = reader.read(depsgraph.scene_eval, depsgraph, (1, 1))
        aa = "sobol" if settings.aa == "mfaa" else settings.aa  # which needs the frame before
        self.tracer.show(arrays, replace(settings, passes=(), aa=aa))

    def draw(self, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """Asks for a picture of what `context` shows and draws the newest there is."""
        view = read_view(context.region, context.region_data, context.space_data, depsgraph)
        if view is None:
            return
        self.tracer.look(view)
        picture = self.tracer.picture()
        if picture is not None:
            self._draw_picture(picture, view)

    def close(self) -> None:
        """Stops tracing and gives memory back, without keeping anybody waiting."""
        self._known.clear()
        self._texture = None
        if self.tracer.close(CLOSING_SECONDS):
            open_tracers.discard(self.tracer)

    def _draw_picture(self, picture: Picture, view: View) -> None:
        if self._texture is None or self._drawn != picture.number:
            height, width = picture.pixels.shape[:2]
            buffer = gpu.types.Buffer("FLOAT", picture.pixels.size, picture.pixels.reshape(-1))
            self._texture = gpu.types.GPUTexture((width, height), format="RGBA32F", data=buffer)
            self._drawn = picture.number
        x_min, y_min, x_max, y_max = picture.place
        place = (x_min * view.width, y_min * view.height)
        gpu.state.blend_set("ALPHA_PREMULT")
        draw_texture_2d(self._texture, place, (x_max - x_min) * view.width, (y_max - y_min) * view.height)
        gpu.state.blend_set("NONE")


def status_of(tracer: ViewportTracer, scene: bpy.types.Scene) -> str:
    """What to say beside the picture: why the scene's program failed, if it did, before samples and error."""
    failure = run_text.last_failure(scene)
    status = tracer.status()
    return f"program: {failure.splitlines()[0]} | {status}" if failure else status


@contextlib.contextmanager
def shown_errors(viewport: Viewport, doing: str) -> Iterator[None]:
    """The border of Blender's viewport callbacks: what goes wrong is shown beside the last good picture."""
    try:
        yield
    except (SceneError, Unavailable) as error:
        viewport.tracer.refuse(str(error))
    except Exception as error:  # noqa: BLE001 - the border of both callbacks
        viewport.tracer.refuse(f"internal error while {doing}: {type(error).__name__}: {error}")


def close_all() -> None:
    """Ends every tracer and waits for it: at unregistering, which happens when Blender ends as well."""
    while open_tracers:
        open_tracers.pop().close()
