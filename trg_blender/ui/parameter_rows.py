"""Sliders of a program's exported parameters, wherever they are shown."""

from __future__ import annotations

import bpy

from . import live_parameters


def draw_parameters(layout: bpy.types.UILayout, scene: bpy.types.Scene) -> None:
    """A slider for each parameter, and why the last run for one failed."""
    parameters = scene.trg.parameters
    layout.use_property_split = True
    for name in parameters.keys():  # noqa: SIM118 (not a dict)
        path = f'["{bpy.utils.escape_identifier(name)}"]'
        layout.prop(parameters, path, text=name.replace("_", " "), slider=True)
    for line in live_parameters.failure_of(scene).splitlines()[:1]:
        layout.label(text=line, icon="ERROR")
