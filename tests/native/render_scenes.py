"""Little scenes for the tests of the native renderer: those of `trg stability`, skipped without the core."""

from __future__ import annotations

import pytest

from trg_blender.stability.stage import (
    BLACK,
    ELLIPSE,
    GLOW,
    GREY,
    POINT,
    RECTANGLE,
    SPOT,
    SUN,
    WHITE,
    Camera,
    Float32,
    Float64,
    Settings,
    add_object,
    film_size,
    finish,
    make_floor,
    make_sphere,
    new_scene,
    picture,
    place,
    start,
)

trg_native = pytest.importorskip("trg_native", reason="the native module is not built")

__all__ = [
    "BLACK",
    "ELLIPSE",
    "GLOW",
    "GREY",
    "POINT",
    "RECTANGLE",
    "SPOT",
    "SUN",
    "WHITE",
    "Camera",
    "Float32",
    "Float64",
    "Settings",
    "add_object",
    "film_size",
    "finish",
    "make_floor",
    "make_sphere",
    "new_scene",
    "picture",
    "place",
    "start",
    "trg_native",
]
