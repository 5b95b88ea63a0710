"""Everything of the image editor, put in and taken out in order."""

from __future__ import annotations

import bpy
from bpy.app.handlers import persistent

from ...engine.shots import shots
from . import compare, inspect, save

CLASSES = (*inspect.CLASSES, *compare.CLASSES, *save.CLASSES)


@persistent
def _on_load(*_: object) -> None:
    """Another file's pictures are not to be looked behind."""
    shots.forget_all()
    inspect.forget()


def register() -> None:
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.WindowManager.trg_compare = bpy.props.PointerProperty(type=compare.TRGCompareSettings)
    bpy.app.handlers.load_pre.append(_on_load)


def unregister() -> None:
    bpy.app.handlers.load_pre.remove(_on_load)
    _on_load()
    del bpy.types.WindowManager.trg_compare
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
