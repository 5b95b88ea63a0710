"""Preferences of the extension: which folders programs may read, and their limits."""

from __future__ import annotations

import bpy

from ..engine.devices import list_devices
from ..engine.to_blender.user_settings import EXTENSION
from ..lang.limits import Limits

DEFAULTS = Limits()
SHOWN_LIMITS = (
    "max_steps",
    "max_seconds",
    "max_shapes",
    "max_elements",
    "max_blocks",
    "max_bytes",
    "max_string",
    "max_text_bytes",
    "output_lines",
)


class TRG_PG_folder(bpy.types.PropertyGroup):
    """A folder that programs may read."""

    path: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Folder", description="Programs may read files below this folder", subtype="DIR_PATH"
    )


class TRG_OT_folder_add(bpy.types.Operator):
    """Let programs read another folder"""

    bl_idname = "trg.folder_add"
    bl_label = "Add Folder"

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.preferences.addons[EXTENSION].preferences.folders.add()
        return {"FINISHED"}


class TRG_OT_folder_remove(bpy.types.Operator):
    """No longer let programs read this folder"""

    bl_idname = "trg.folder_remove"
    bl_label = "Remove Folder"

    index: bpy.props.IntProperty(options={"HIDDEN"})  # type: ignore[valid-type]

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.preferences.addons[EXTENSION].preferences.folders.remove(self.index)
        return {"FINISHED"}


class TRGPreferences(bpy.types.AddonPreferences):
    """Settings that hold for every file."""

    bl_idname = EXTENSION

    language: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Messages",
        description="Language of what programs are told",
        items=(
            ("AUTO", "As Blender's Interface", "Russian where Blender is, else English"),
            ("EN", "English", ""),
            ("RU", "Русский", ""),
        ),
    )
    folders: bpy.props.CollectionProperty(type=TRG_PG_folder)  # type: ignore[valid-type]
    max_steps: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Steps a Frame",
        description="Turns of loops and calls that a program may make between two Scene.Render()",
        default=DEFAULTS.max_steps,
        min=1000,
    )
    max_seconds: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Seconds a Frame",
        description="Processor time that a program may take between two Scene.Render()",
        default=DEFAULTS.max_seconds,
        min=0.1,
    )
    max_shapes: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Shapes", description="Shapes and lights of a run", default=DEFAULTS.max_shapes, min=1
    )
    max_elements: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="List Elements", description="Elements of all lists", default=DEFAULTS.max_elements, min=1
    )
    max_blocks: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Memory Blocks",
        description="Values, objects and fields alive at one time",
        default=DEFAULTS.max_blocks,
        min=10_000,
    )
    max_bytes: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Memory",
        description="Bytes by which Blender may grow while a program runs",
        default=DEFAULTS.max_bytes,
        min=1 << 20,
    )
    max_string: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="String Length", description="Characters of one string", default=DEFAULTS.max_string, min=256
    )
    max_text_bytes: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Text Memory", description="Bytes of all strings", default=DEFAULTS.max_text_bytes, min=1 << 16
    )
    output_lines: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Output Lines",
        description="Lines that print() gives in a run",
        default=DEFAULTS.output_lines,
        min=1,
    )

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        column = layout.column(align=True)
        column.label(text="Devices:")
        for device in list_devices():
            row = column.row()
            row.active = device.available
            row.label(text=device.name, icon="CHECKMARK" if device.available else "X")
            row.label(text=device.description if device.reason is None else device.reason)
        layout.prop(self, "language")
        layout.label(text="Programs may read the folders of their text and of the .blend, and these:")
        for index, folder in enumerate(self.folders):
            row = layout.row(align=True)
            row.prop(folder, "path", text="")
            row.operator("trg.folder_remove", text="", icon="X").index = index
        layout.operator("trg.folder_add", icon="ADD")
        layout.use_property_split = True
        layout.label(text="Limits of a program:")
        for name in SHOWN_LIMITS:
            layout.prop(self, name)


CLASSES = (TRG_PG_folder, TRG_OT_folder_add, TRG_OT_folder_remove, TRGPreferences)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
