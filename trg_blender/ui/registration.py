"""Everything that Blender has to know of TRG, put in and taken out in order."""

from __future__ import annotations

import atexit

import bpy

from ..engine import render_engine, run_text
from . import (
    command,
    live_parameters,
    object_panel,
    operators,
    panels,
    preferences,
    properties,
    report_panel,
    run_on_load,
)
from .image_editor import parts as image_editor
from .text_editor import parts as text_editor

PARTS = (
    preferences,
    properties,
    render_engine,
    run_text,
    live_parameters,
    run_on_load,
    operators,
    report_panel,
    panels,
    object_panel,
    text_editor,
    image_editor,
    command,
)


def register() -> None:
    for part in PARTS:
        part.register()
    if getattr(bpy.app, "module", False):
        # A class that is still registered when the interpreter ends crashes or hangs the module.
        atexit.register(unregister)


def unregister() -> None:
    atexit.unregister(unregister)
    for part in reversed(PARTS):
        part.unregister()
