"""Which devices can render here, and why the others cannot.

A missing device is a value with its reason, not an exception; `Unavailable` is raised only by whoever
was asked to use one all the same.
"""

from __future__ import annotations

import importlib
import importlib.util
from dataclasses import dataclass

from .native import NativeMissing, load_native

DEVICE_NAMES = ("cpu", "embree", "cuda", "glsl", "dxr")
INTEGRATORS = ("path", "classic")


class Unavailable(Exception):
    """The machine, or this version, lacks what was asked for; the message says what and why."""


@dataclass(frozen=True, slots=True)
class Device:
    name: str
    description: str
    reason: str | None = None
    """Why it is absent; None when it can be used."""

    @property
    def available(self) -> bool:
        return self.reason is None


def find_device(name: str) -> Device:
    """The device called `name`. Raises ValueError for a name that is not in DEVICE_NAMES."""
    if name == "cpu":
        return Device(name, "native core on all processor cores", native_missing())
    if name == "embree":
        return Device(name, "reference renderer: numpy on Embree's hits", embree_missing())
    if name in DEVICE_NAMES:
        return Device(name, "graphics processor", "not built yet in this version")
    raise ValueError(f"no device is called {name!r}; there are {', '.join(DEVICE_NAMES)}")


def list_devices() -> list[Device]:
    return [find_device(name) for name in DEVICE_NAMES]


def native_missing() -> str | None:
    """Why the native core cannot be used, or None."""
    try:
        load_native()
    except NativeMissing as missing:
        return str(missing)
    return None


def embree_missing() -> str | None:
    """Why the reference renderer cannot be used, or None."""
    if importlib.util.find_spec("embreex") is None:
        return "the Python package embreex is not installed (pip install embreex)"
    try:
        importlib.import_module("embreex.rtcore_scene")
    except ImportError as failure:
        return f"the Python package embreex cannot be loaded: {failure}"
    return None


def require_device(name: str) -> Device:
    """The device, ready for use. Raises Unavailable with the reason when it is absent."""
    device = find_device(name)
    if device.reason is not None:
        raise Unavailable(f"device {name}: {device.reason}")
    return device
