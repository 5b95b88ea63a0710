"""Handing work to Blender's main thread, and waiting for it.

With a window, Blender calls render handlers in a job thread; scene data that is changed there crashes it
sooner or later. A timer on the main thread takes the jobs from a queue. In background mode everything
runs on the main thread already, and timers never do.
"""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

import bpy

BUSY_INTERVAL_S = 0.01
IDLE_INTERVAL_S = 0.1
IDLE_AFTER_S = 2.0
GIVE_UP_S = 5.0
"""A main thread whose timer has not run for so long is blocked, most likely by quitting: then it waits for
the very thread that waits for it."""


class MainThreadBusy(RuntimeError):
    """The main thread did not take the job."""


@dataclass(slots=True)
class _Job:
    work: Callable[[], object]
    done: threading.Event = field(default_factory=threading.Event)
    lock: threading.Lock = field(default_factory=threading.Lock)
    taken: bool = False
    dropped: bool = False
    result: object = None
    error: BaseException | None = None

    def run(self) -> None:
        with self.lock:
            if self.dropped:
                return
            self.taken = True
        try:
            self.result = self.work()
        except BaseException as error:  # noqa: BLE001 - handed to the thread that waits
            self.error = error
        finally:
            self.done.set()

    def drop(self) -> bool:
        """Keep the job from being started; False when it already was."""
        with self.lock:
            self.dropped = not self.taken
            return self.dropped


class MainThread:
    """The way to the main thread. `start` and `stop` belong to registering and unregistering."""

    def __init__(self) -> None:
        self._jobs: queue.SimpleQueue[_Job] = queue.SimpleQueue()
        self._beat = 0.0
        self._busy_until = 0.0
        self._timer = self._pump

    def start(self) -> None:
        self._beat = time.monotonic()
        if not bpy.app.background and not bpy.app.timers.is_registered(self._timer):
            bpy.app.timers.register(self._timer, persistent=True)

    def stop(self) -> None:
        if bpy.app.timers.is_registered(self._timer):
            bpy.app.timers.unregister(self._timer)

    def call(self, work: Callable[[], object]) -> object:
        """Run `work` on the main thread and return what it returns, or raise what it raises.

        Raises MainThreadBusy when the main thread does not come round to it.
        """
        if bpy.app.background or threading.current_thread() is threading.main_thread():
            return work()
        job = _Job(work)
        self._jobs.put(job)
        while not job.done.wait(0.05):
            if time.monotonic() - self._beat > GIVE_UP_S and job.drop():
                raise MainThreadBusy("Blender's main thread is busy")
        if job.error is not None:
            raise job.error
        return job.result

    def _pump(self) -> float:
        """Timer: run what is queued, and say when to come back."""
        now = self._beat = time.monotonic()
        while True:
            try:
                job = self._jobs.get_nowait()
            except queue.Empty:
                break
            job.run()
            self._busy_until = time.monotonic() + IDLE_AFTER_S
        return BUSY_INTERVAL_S if now < self._busy_until else IDLE_INTERVAL_S
