"""How far light is followed, laid out as Blender users know it from Cycles."""

from __future__ import annotations

from typing import ClassVar

import bpy

from .engine_panel import EnginePanel


class _LightPathPanel(EnginePanel):
    bl_context = "render"


class TRG_RENDER_PT_light_paths(_LightPathPanel, bpy.types.Panel):
    """Bounces, clamps and caustics."""

    bl_label = "Light Paths"
    bl_options: ClassVar[set[str]] = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Everything is in the panels below."""


class _SubPanel(_LightPathPanel):
    bl_parent_id = "TRG_RENDER_PT_light_paths"

    def draw_properties(self, context: bpy.types.Context, names: dict[str, str]) -> None:
        """Properties of `scene.trg` by name, each with its label."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        column = layout.column(align=True)
        for name, label in names.items():
            column.prop(context.scene.trg, name, text=label)


class TRG_RENDER_PT_light_paths_max_bounces(_SubPanel, bpy.types.Panel):
    """How often light may be scattered."""

    bl_label = "Max Bounces"

    def draw(self, context: bpy.types.Context) -> None:
        kinds = ("diffuse", "glossy", "transmission", "transparent")
        self.draw_properties(
            context, {"max_bounces": "Total", **{f"{kind}_bounces": kind.title() for kind in kinds}}
        )


class TRG_RENDER_PT_light_paths_clamping(_SubPanel, bpy.types.Panel):
    """Limits for what samples bring."""

    bl_label = "Clamping"

    def draw(self, context: bpy.types.Context) -> None:
        self.draw_properties(context, {"clamp_direct": "Direct Light", "clamp_indirect": "Indirect Light"})


class TRG_RENDER_PT_light_paths_caustics(_SubPanel, bpy.types.Panel):
    """Light by mirrors and glass onto diffuse surfaces."""

    bl_label = "Caustics"

    def draw(self, context: bpy.types.Context) -> None:
        self.draw_properties(
            context, {"caustics_reflective": "Reflective", "caustics_refractive": "Refractive"}
        )


CLASSES = (
    TRG_RENDER_PT_light_paths,
    TRG_RENDER_PT_light_paths_max_bounces,
    TRG_RENDER_PT_light_paths_clamping,
    TRG_RENDER_PT_light_paths_caustics,
)
