"""What a row of the catalogue is: something that is run on a subject and says what came out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .meshes import ACCELS, INDICES

ALL_RAYS = 10_000_000
"""Rays that the catalogue asks of a row of leaks."""
EMBREE = "embree"
TRACED = (*INDICES, EMBREE)
"""subjects of rows that are ray queries: our accelerators, and Embree"""
EVERY = (*ACCELS, EMBREE)
"""the same with brute force"""
PICTURES = "embree pictures"
"""pictures by the reference renderer: slow, hence fewer rays, and none in a quick run"""
PICTURE_RAYS = 20_000
ANY = "any"
ONCE = (ANY, PICTURES)
"""of rows that are about light: one accelerator stands for all"""
CORE = "core"
"""of rows about functions of the native core that trace nothing"""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a row found; `failed` of `total` tries were worse than the row allows."""

    failed: int
    total: int
    figure: str = ""
    """what was measured, where the share says too little"""


def within(worst: float, limit: float, total: int = 1, what: str = "worst error") -> Outcome:
    """A figure that must not exceed its limit; NaN does."""
    return Outcome(0 if worst <= limit else 1, total, f"{what} {worst:.3g}")


class NotApplicable(Exception):
    """A row has nothing to measure on this subject; the message says why."""


Row = Callable[[str, int, int], Outcome]
"""(accelerator, or `embree`; about how many rays, samples or draws; seed)"""


@dataclass(frozen=True, slots=True)
class Case:
    """One construction of a row of the catalogue."""

    id: str
    name: str
    """which construction: its scale, place, angle"""
    row: Row
    subjects: tuple[str, ...] = TRACED
    full: int = ALL_RAYS
    quick: int = 2000
