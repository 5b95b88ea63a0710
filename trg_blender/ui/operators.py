"""Operators of TRG."""

from __future__ import annotations

import bpy

from ..engine import run_text
from ..engine.to_blender.edits import attach_all, detach_all, detach_objects
from ..engine.to_blender.tags import DETACHED, KEY, collection_of
from .live_parameters import live


class TRG_OT_build(bpy.types.Operator):
    """Run the scene's program for the current frame, without rendering"""

    bl_idname = "trg.build"
    bl_label = "Build Scene"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.scene is not None and run_text.program_of(context.scene) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        outcome = run_text.run_program(context.scene, run_text.frame_of(context.scene))
        if outcome is not None and outcome.failure is not None:
            self.report({"ERROR"}, outcome.failure.text)
            return {"CANCELLED"}
        live.failures.pop(context.scene.name, None)
        return {"FINISHED"}


class TRG_OT_detach(bpy.types.Operator):
    """Make the selected objects ordinary ones: the program leaves them alone and does not make them again"""

    bl_idname = "trg.detach"
    bl_label = "Detach Selected"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return any(KEY in each for each in context.selected_objects)

    def execute(self, context: bpy.types.Context) -> set[str]:
        collection = collection_of(context.scene)
        count = 0 if collection is None else detach_objects(collection, context.selected_objects)
        self.report({"INFO"} if count else {"WARNING"}, f"{count} objects detached")
        return {"FINISHED"} if count else {"CANCELLED"}


class TRG_OT_detach_all(bpy.types.Operator):
    """Make all that the program built ordinary, and take the program from the scene"""

    bl_idname = "trg.detach_all"
    bl_label = "Detach All"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.scene is not None and collection_of(context.scene) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        count = detach_all(context.scene, collection_of(context.scene))
        context.scene.trg.program = None
        self.report({"INFO"}, f"{count} objects detached")
        return {"FINISHED"}


class TRG_OT_attach_all(bpy.types.Operator):
    """Let the program make the objects again that were detached from it; those detached stay as well"""

    bl_idname = "trg.attach_all"
    bl_label = "Forget Detached"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        collection = collection_of(context.scene) if context.scene is not None else None
        return collection is not None and DETACHED in collection

    def execute(self, context: bpy.types.Context) -> set[str]:
        self.report({"INFO"}, f"{attach_all(collection_of(context.scene))} objects will be made again")
        return {"FINISHED"}


CLASSES = (TRG_OT_build, TRG_OT_detach, TRG_OT_detach_all, TRG_OT_attach_all)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
