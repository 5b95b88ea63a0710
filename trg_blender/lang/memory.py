"""How much memory the process holds, and how often Python looks for garbage."""

from __future__ import annotations

import gc
import os
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from types import ModuleType

_STATM = "/proc/self/statm"
_PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096


def _resource() -> ModuleType | None:
    """The module of the system's accounts; Windows has none."""
    try:
        return import_module("resource")
    except ImportError:
        return None


def resident_bytes() -> int:
    """Resident size now; where the system does not tell, the peak so far; 0 where it tells neither."""
    try:
        with open(_STATM, "rb") as statm:
            return int(statm.read().split()[1]) * _PAGE
    except OSError:
        pass
    resource = _resource()
    return 0 if resource is None else int(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss) * 1024


@contextmanager
def collecting_seldom(after: int) -> Iterator[None]:
    """Search for cycles only after so many new objects; Python's own 700 costs half of the time of a
    program that makes many objects that stay."""
    thresholds = gc.get_threshold()
    gc.set_threshold(max(after, thresholds[0]), *thresholds[1:])
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
