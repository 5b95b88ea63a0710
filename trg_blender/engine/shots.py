"""Finished pictures that the image editor may look behind: the last of each scene, and one a render slot.

Only where there is a window to look from. The last picture keeps the scene's arrays; the slots, for
comparing, keep pixels alone.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass, field

from .probe import Shot, standard_error_of
from .scene_arrays import Float32, RenderSettings, SceneArrays
from .session import Result

RESULT = "Render Result"


@dataclass(slots=True)
class ShotStore:
    """Written by the thread that renders, read by panels."""

    _last: dict[str, Shot] = field(default_factory=dict)
    _slots: dict[int, Float32] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def keep(
        self, scene_name: str, slot: int, made_of: tuple[SceneArrays, RenderSettings], result: Result
    ) -> None:
        """Remember a picture that went into a render slot, counted from 0."""
        samples = float(result.report["samples"])
        error = standard_error_of(result.replicate_sums, result.replicate_counts)
        shot = Shot(*made_of, result.pixels, error, samples)
        with self._lock:
            self._last[scene_name] = shot
            self._slots[slot] = result.pixels

    def last_of(self, scene_name: str) -> Shot | None:
        with self._lock:
            return self._last.get(scene_name)

    def slot(self, number: int) -> Float32 | None:
        """(h, w, 4) linear pixels of a render slot, counted from 0; None: TRG has not rendered into it."""
        with self._lock:
            return self._slots.get(number)

    def filled_slots(self) -> list[int]:
        with self._lock:
            return sorted(self._slots)

    def forget_all(self) -> None:
        """Give the memory back."""
        with self._lock:
            self._last.clear()
            self._slots.clear()


shots = ShotStore()
