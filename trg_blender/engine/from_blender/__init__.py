"""Blender's evaluated depsgraph -> SceneArrays: the only way a Blender scene reaches a renderer."""

from .sync import SceneReader

__all__ = ["SceneReader"]
