"""Saving the render as a PNG as it is shown, or as an EXR with all its passes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import bpy

from ...engine.shots import RESULT

FORMATS = (
    ("PNG", "PNG", "As it is shown, 16 bits a channel"),
    ("EXR", "EXR with all passes", "Linear, 32 bits a channel, every pass of every layer"),
)
_KEPT = ("media_type", "file_format", "color_mode", "color_depth")


@contextmanager
def file_settings(scene: bpy.types.Scene, kind: str) -> Iterator[None]:
    """The scene's image settings are those of `kind` for the length of a `with`."""
    image = scene.render.image_settings
    kept = {name: getattr(image, name) for name in _KEPT if hasattr(image, name)}
    wanted = {
        "PNG": {"media_type": "IMAGE", "file_format": "PNG", "color_mode": "RGBA", "color_depth": "16"},
        "EXR": {
            "media_type": "MULTI_LAYER_IMAGE",
            "file_format": "OPEN_EXR_MULTILAYER",
            "color_mode": "RGBA",
            "color_depth": "32",
        },
    }[kind]
    try:
        for name, value in wanted.items():
            if hasattr(image, name):
                setattr(image, name, value)
        yield
    finally:
        for name, value in kept.items():
            setattr(image, name, value)


class TRG_OT_save_picture(bpy.types.Operator):
    """Save the render"""

    bl_idname = "trg.save_picture"
    bl_label = "Save Picture"

    filepath: bpy.props.StringProperty(subtype="FILE_PATH")  # type: ignore[valid-type]
    kind: bpy.props.EnumProperty(name="Format", items=FORMATS)  # type: ignore[valid-type]

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return RESULT in bpy.data.images

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        stem = Path(bpy.data.filepath).stem or "picture"
        self.filepath = stem + self.suffix
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    @property
    def suffix(self) -> str:
        return ".png" if self.kind == "PNG" else ".exr"

    def execute(self, context: bpy.types.Context) -> set[str]:
        path = Path(bpy.path.abspath(self.filepath))
        if path.suffix.lower() != self.suffix:
            path = path.with_name(path.name + self.suffix)
        try:
            with file_settings(context.scene, self.kind):
                bpy.data.images[RESULT].save_render(str(path), scene=context.scene)
        except RuntimeError as error:
            self.report({"ERROR"}, str(error).strip())
            return {"CANCELLED"}
        if not path.is_file():  # Blender says nothing of a folder that cannot be
            self.report({"ERROR"}, f"{path} could not be written")
            return {"CANCELLED"}
        self.report({"INFO"}, f"saved {path}")
        return {"FINISHED"}


class TRG_IMAGE_PT_save(bpy.types.Panel):
    """Where the picture goes."""

    bl_label = "Save"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "TRG"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.scene.render.engine == "TRG" and TRG_OT_save_picture.poll(context)

    def draw(self, _context: bpy.types.Context) -> None:
        column = self.layout.column(align=True)
        for kind, name, _ in FORMATS:
            column.operator("trg.save_picture", text=name, icon="IMAGE_DATA").kind = kind


CLASSES: tuple[Any, ...] = (TRG_OT_save_picture, TRG_IMAGE_PT_save)
