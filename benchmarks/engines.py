"""Both engines of a comparison, in Blender as a module."""

from __future__ import annotations

import bpy

from trg_blender.ui import registration


def enable_engines() -> None:
    """TRG and Cycles registered; reading a factory file may have dropped Cycles."""
    if "cycles" not in bpy.context.preferences.addons:
        bpy.ops.preferences.addon_enable(module="cycles")
    if not hasattr(bpy.types.Scene, "trg"):
        registration.register()
