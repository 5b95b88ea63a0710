"""The Blender extension: Blender calls `register` and `unregister`."""

from .trg_blender.ui.registration import register, unregister

__all__ = ["register", "unregister"]
