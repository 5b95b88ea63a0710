"""Which passes a view layer asks for, laid out as Blender users know it from Cycles."""

from __future__ import annotations

import bpy

from .engine_panel import EnginePanel

DATA = ("z", "mist", "position", "normal", "uv", "object_index", "material_index")
LIGHT = ("diffuse", "glossy", "transmission")
OTHER_LIGHT = ("emit", "environment", "ambient_occlusion")
MATTES = ("object", "material", "asset")


class _PassPanel(EnginePanel):
    bl_context = "view_layer"


class TRG_VIEWLAYER_PT_passes(_PassPanel, bpy.types.Panel):
    """Passes besides Combined."""

    bl_label = "Passes"

    def draw(self, context: bpy.types.Context) -> None:
        """Everything is in the panels below."""


class _SubPanel(_PassPanel):
    bl_parent_id = "TRG_VIEWLAYER_PT_passes"


class TRG_VIEWLAYER_PT_passes_data(_SubPanel, bpy.types.Panel):
    """Places, directions and numbers of what the camera sees."""

    bl_label = "Data"

    def draw(self, context: bpy.types.Context) -> None:
        layout, layer = self.layout, context.view_layer
        layout.use_property_split, layout.use_property_decorate = True, False
        column = layout.column(heading="Include", align=True)
        for name in DATA:
            column.prop(layer, f"use_pass_{name}")
        column = layout.column(heading="Error", align=True)
        column.prop(layer.trg, "use_pass_sample_count")
        column.prop(layer.trg, "use_pass_standard_error")
        layout.column(heading="Denoising", align=True).prop(layer.trg, "use_pass_denoising")


class TRG_VIEWLAYER_PT_passes_light(_SubPanel, bpy.types.Panel):
    """Light by the kind of surface that sends it to the camera."""

    bl_label = "Light"

    def draw(self, context: bpy.types.Context) -> None:
        layout, layer = self.layout, context.view_layer
        layout.use_property_split, layout.use_property_decorate = True, False
        for kind in LIGHT:
            row = layout.row(heading=kind.title(), align=True)
            for part in ("direct", "indirect", "color"):
                row.prop(layer, f"use_pass_{kind}_{part}", text=part.title(), toggle=True)
        column = layout.column(heading="Other", align=True)
        for name in OTHER_LIGHT:
            column.prop(layer, f"use_pass_{name}")


class TRG_VIEWLAYER_PT_passes_cryptomatte(_SubPanel, bpy.types.Panel):
    """Mattes of objects, materials and assets."""

    bl_label = "Cryptomatte"

    def draw(self, context: bpy.types.Context) -> None:
        layout, layer = self.layout, context.view_layer
        layout.use_property_split, layout.use_property_decorate = True, False
        column = layout.column(heading="Include", align=True)
        for name in MATTES:
            column.prop(layer, f"use_pass_cryptomatte_{name}", text=name.title())
        row = layout.row()
        row.active = any(getattr(layer, f"use_pass_cryptomatte_{name}") for name in MATTES)
        row.prop(layer, "pass_cryptomatte_depth", text="Levels")


CLASSES = (
    TRG_VIEWLAYER_PT_passes,
    TRG_VIEWLAYER_PT_passes_data,
    TRG_VIEWLAYER_PT_passes_light,
    TRG_VIEWLAYER_PT_passes_cryptomatte,
)
