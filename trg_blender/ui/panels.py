"""Render panels of TRG, and the standard panels that TRG lets Blender show."""

from __future__ import annotations

from collections.abc import Iterator

import bpy

from ..engine.run_text import ENGINE_ID
from . import light_path_panels, pass_panels, report_panel
from .engine_panel import EnginePanel
from .parameter_rows import draw_parameters

ADOPTED_BY_NAME = {
    "MATERIAL_PT_preview",
    "EEVEE_MATERIAL_PT_context_material",
    "EEVEE_MATERIAL_PT_surface",
    "DATA_PT_EEVEE_light",
    "EEVEE_WORLD_PT_surface",
    "WORLD_PT_context_world",
}
"""Panels that Blender writes for EEVEE and that fit TRG; the ones for every engine say BLENDER_RENDER."""


class _RenderPanel(EnginePanel):
    bl_context = "render"


class TRG_RENDER_PT_program(_RenderPanel, bpy.types.Panel):
    """Which program builds the scene."""

    bl_label = "TRG Program"

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.template_ID(context.scene.trg, "program", new="text.new", open="text.open")
        self.layout.operator("trg.build")
        self.layout.prop(context.scene.trg, "run_on_load")
        row = self.layout.row(align=True)
        row.operator("trg.detach_all")
        if bpy.ops.trg.attach_all.poll():
            row.operator("trg.attach_all")


class TRG_RENDER_PT_parameters(_RenderPanel, bpy.types.Panel):
    """The program's exported parameters."""

    bl_label = "Parameters"
    bl_parent_id = "TRG_RENDER_PT_program"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        settings = context.scene.trg
        return super().poll(context) and settings.program is not None and bool(settings.parameters.keys())

    def draw(self, context: bpy.types.Context) -> None:
        draw_parameters(self.layout, context.scene)


class TRG_RENDER_PT_sampling(_RenderPanel, bpy.types.Panel):
    """Samples, bounces and what traces them."""

    bl_label = "Sampling"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        own = context.scene.trg
        stops = own.use_time_limit or own.use_error_target
        layout.prop(own, "samples", text="Max Samples" if stops else "Samples")
        layout.prop(own, "preview_samples")
        for use, value in (("use_error_target", "error_target"), ("use_time_limit", "time_limit")):
            row = layout.row(heading=own.bl_rna.properties[use].name)
            row.prop(own, use, text="")
            sub = row.row()
            sub.enabled = getattr(own, use)
            sub.prop(own, value, text="")
        row = layout.row()
        row.enabled = stops
        row.prop(own, "use_adaptive")
        layout.prop(own, "filter_type")
        row = layout.row()
        row.enabled = own.filter_type != "BOX"
        row.prop(own, "filter_width")
        for name in ("seed", "device", "accel", "integrator"):
            layout.prop(own, name)
        _draw_antialiasing(layout, own)
        column = layout.column()
        column.prop(context.scene.render, "threads_mode", text="Threads")
        row = column.row()
        row.enabled = context.scene.render.threads_mode == "FIXED"
        row.prop(context.scene.render, "threads", text=" ")
        layout.prop(context.scene.render, "film_transparent", text="Transparent Film")


def _draw_antialiasing(layout: bpy.types.UILayout, own: bpy.types.PropertyGroup) -> None:
    """The method, and what of grid and filter it asks for."""
    layout.prop(own, "aa")
    if own.aa in ("supersampling", "jittering", "mfaa"):
        layout.prop(own, "aa_side")


def _adopted() -> Iterator[type]:
    """Panels of Blender that TRG shows."""
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", None)
        if engines is None or panel in CLASSES:
            continue
        if "BLENDER_RENDER" in engines or panel.__name__ in ADOPTED_BY_NAME:
            yield panel


CLASSES = (
    TRG_RENDER_PT_program,
    TRG_RENDER_PT_parameters,
    TRG_RENDER_PT_sampling,
    *light_path_panels.CLASSES,
    *report_panel.CLASSES,
    *pass_panels.CLASSES,
)


def register() -> None:
    for each in CLASSES:
        bpy.utils.register_class(each)
    for panel in _adopted():
        panel.COMPAT_ENGINES.add(ENGINE_ID)


def unregister() -> None:
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", None)
        if engines is not None and panel not in CLASSES:
            engines.discard(ENGINE_ID)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
