"""What the user set in the preferences of the extension, or its defaults where it runs as a module."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path

import bpy

from ...lang.limits import Limits

EXTENSION = __package__.removesuffix(".engine.to_blender").removesuffix(".trg_blender")
"""Name that Blender knows the extension by, `bl_ext.<repository>.trg`; `trg_blender` for the module."""


def _preferences() -> bpy.types.AddonPreferences | None:
    addon = bpy.context.preferences.addons.get(EXTENSION)
    return None if addon is None else addon.preferences


def program_limits() -> Limits:
    """The limits of programs. Preferences hold one property a limit that a user may raise."""
    preferences = _preferences()
    if preferences is None:
        return Limits()
    names = [f.name for f in fields(Limits) if hasattr(preferences, f.name)]
    return replace(Limits(), **{name: getattr(preferences, name) for name in names})


def wanted_language() -> str:
    """Language of messages that the user chose, `en` or `ru`; empty: that of Blender's interface."""
    chosen = getattr(_preferences(), "language", "AUTO")
    return "" if chosen == "AUTO" else str(chosen).lower()


def user_folders() -> list[Path]:
    """Folders that the user lets programs read, as they stand in the preferences."""
    preferences = _preferences()
    if preferences is None:
        return []
    paths = [bpy.path.abspath(entry.path) for entry in preferences.folders if entry.path]
    return [Path(path) for path in paths]
