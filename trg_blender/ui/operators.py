"""Operators of TRG."""

from __future__ import annotations

import bpy

from ..engine import run_text
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


CLASSES = (TRG_OT_build,)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
