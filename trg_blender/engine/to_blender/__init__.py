"""From the records of a program to objects, materials, lights and camera of Blender (bpy).

`SceneMirror(scene).apply(description)` is all that the rest of the engine calls.
"""

from __future__ import annotations

from .errors import SceneError
from .mirror import MirrorCounts, SceneMirror, new_planner, requested_modes

__all__ = ["MirrorCounts", "SceneError", "SceneMirror", "new_planner", "requested_modes"]
