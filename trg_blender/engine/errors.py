"""The one exception for a scene that cannot be rendered."""

from __future__ import annotations


class SceneError(Exception):
    """The scene is impossible; the message says what is wrong and names the Blender object."""
