"""Where an object comes from, in its properties: the program's line, and the way out of the program."""

from __future__ import annotations

import bpy

from ..engine.to_blender.tags import KEY, KIND, ORIGIN


class TRG_OBJECT_PT_program(bpy.types.Panel):
    """The line of the program that made the object."""

    bl_label = "TRG Program"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.object is not None and KEY in context.object

    def draw(self, context: bpy.types.Context) -> None:
        layout, obj = self.layout, context.object
        origin = str(obj.get(ORIGIN, ""))
        file, line, column = place_of(origin)
        row = layout.row()
        row.label(text=str(obj.get(KIND, "object")).capitalize(), icon="FILE_SCRIPT")
        if file:
            button = row.operator("trg.goto", text=f"{file}, line {line}", icon="LINENUMBERS_ON")
            button.file, button.line, button.column = file, line, column
        layout.operator("trg.detach")


def place_of(origin: str) -> tuple[str, int, int]:
    """File, line and column of an origin as the mirror writes it; an empty file when it is none."""
    file, _, place = origin.rpartition(":")
    file, _, line = file.rpartition(":")
    return (file, int(line), int(place)) if line.isdigit() and place.isdigit() else ("", 1, 1)


CLASSES = (TRG_OBJECT_PT_program,)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
