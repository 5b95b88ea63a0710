"""The reference renderer behind the interface of a native job (docs/architecture.md, 3.3)."""

from __future__ import annotations

import threading
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .image_error import measure_error
from .pixel_error import measure_pixel_error
from .reference import add_estimate, expose, make_film
from .reference_passes import REFERENCE_PASSES, read_reference_pass
from .reference_path import World
from .scene_arrays import Float32, Float64, RenderSettings


class ReferenceJob:
    """Renders in a thread of its own; all methods may be called while it runs."""

    def __init__(self, world: World, settings: RenderSettings) -> None:
        self._settings = settings
        self._film = make_film(world, settings)
        self._lock = threading.Lock()
        self._cancel = threading.Event()
        self._done = threading.Event()
        self._failure: Exception | None = None
        self._start = time.perf_counter()
        self._seconds = 0.0
        self._late = False
        threading.Thread(target=self._work, args=(world,), daemon=True).start()

    def _work(self, world: World) -> None:
        try:
            for step, batch in expose(world, self._settings, self._should_stop):
                with self._lock:
                    add_estimate(self._film, step, batch)
        except Exception as failure:  # the thread's border: poll() raises it again
            self._failure = failure
        self._seconds = time.perf_counter() - self._start
        self._done.set()

    def _should_stop(self) -> bool:
        """Cancelled, or out of time once every pixel has a sample."""
        limit = self._settings.seconds
        if limit > 0.0 and self._film.samples >= 1 and time.perf_counter() - self._start >= limit:
            self._late = True
        return self._late or self._cancel.is_set()

    def _stopped_by(self) -> str:
        if self._late:
            return "time"
        return "cancel" if self._cancel.is_set() else "samples"

    def poll(self, timeout_s: float) -> dict[str, Any]:
        """State of the job: at once when done, else after `timeout_s`. Raises what the thread raised."""
        done = self._done.wait(timeout_s)
        if self._failure is not None:
            raise self._failure
        seconds = self._seconds if done else time.perf_counter() - self._start
        with self._lock:
            film = self._film
            return {
                "done": done,
                "cancelled": self._cancel.is_set(),
                "stopped_by": self._stopped_by() if done else None,
                "samples": film.samples,
                "target": self._settings.samples,
                "seconds": seconds,
                "rays_camera": film.rays.camera,
                "rays_shadow": film.rays.shadow,
                "rays_bounce": film.rays.bounce,
                "rejected_samples": film.rejected_samples,
                "clamped": film.rays.clamped,
                "kernel_set": "numpy",
            }

    def rejected_places(self) -> list[tuple[int, int, int]]:
        """(x, y, sample) of the first samples that were not finite, in pixels of the whole picture."""
        left, bottom = (self._settings.border or (0, 0))[:2]
        with self._lock:
            return [(x + left, y + bottom, sample) for x, y, sample in self._film.rejected_places]

    def cancel(self) -> None:
        """Asks the thread to stop; it does within a fraction of a second."""
        self._cancel.set()

    def combined(self, out: Float32) -> None:
        """Mean colour and alpha into `out` (h, w, 4)."""
        with self._lock:
            out[..., :3] = self._film.mean(self._film.sums.sum(axis=0))
            out[..., 3] = self._film.mean(self._film.coverage) if "alpha" in self._settings.passes else 1.0

    def depth(self, out: Float32) -> None:
        out[...] = self._film.depth

    def normal(self, out: Float32) -> None:
        with self._lock:
            out[...] = self._film.mean(self._film.normals)

    def read_pass(self, name: str, out: Float32) -> None:
        """Pass `name` into `out` (h, w, channels); 0 for those that this renderer does not have."""
        out[...] = 0.0
        with self._lock:
            if name == "position":
                out[...] = self._film.position
            elif name == "sample_count":
                out[...] = self._film.samples
            elif name in REFERENCE_PASSES and name in self._film.passes:
                out[...] = read_reference_pass(name, self._film.passes, self._film.samples)

    def replicates(self, sums: Float64, counts: NDArray[np.int64]) -> None:
        """Sums (8, h, w, 3) and samples (8,) of the replicates."""
        with self._lock:
            sums[...] = self._film.sums
            counts[...] = self._film.counts

    def error(self) -> dict[str, Any]:
        with self._lock:
            return measure_error(self._film.sums, self._film.counts)

    def pixel_error(self, half_width: Float32, flags: NDArray[np.uint8]) -> dict[str, float]:
        """Half widths and flags of pixels (h, w), and the evidence of the picture."""
        with self._lock:
            return measure_pixel_error(self._film.sums, self._film.counts, half_width, flags)
