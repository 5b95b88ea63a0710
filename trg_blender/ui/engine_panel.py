"""What all panels of TRG's own have in common."""

from __future__ import annotations

import bpy

from ..engine.run_text import ENGINE_ID


class EnginePanel:
    """A mix-in for panels of the properties editor that show for TRG alone; `bl_context` is the panel's."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {ENGINE_ID}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.engine in cls.COMPAT_ENGINES)
