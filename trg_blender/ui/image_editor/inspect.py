"""Looking behind the pixel under the mouse."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ...engine.native import NativeMissing
from ...engine.probe import PixelFacts, Shot, Surface, display_values
from ...engine.shots import RESULT, shots


@dataclass(slots=True)
class _Looked:
    """What was looked at last."""

    facts: PixelFacts | None = None
    material: str = ""
    object: str = ""


looked = _Looked()


def look_at(scene: bpy.types.Scene, shot: Shot, x: int, y: int) -> None:
    """Find out about a pixel of the scene's last picture. Raises NativeMissing."""
    looked.facts = shot.facts_of(x, y)
    surface = looked.facts.surface if looked.facts is not None else None
    looked.object, looked.material = names_of(scene, surface) if surface is not None else ("", "")


def names_of(scene: bpy.types.Scene, surface: Surface) -> tuple[str, str]:
    """Names of the object and of the material of a surface, as far as they still are in the scene."""
    obj = scene.objects.get(surface.instance) or bpy.data.objects.get(surface.instance)
    if obj is None:
        return surface.instance or surface.mesh, ""
    slots = obj.material_slots
    material = slots[surface.slot].material if surface.slot < len(slots) else None
    return obj.name, "" if material is None else material.name


def fact_lines(facts: PixelFacts, exposure: float, gamma: float) -> list[tuple[str, str]]:
    """(name, value) pairs for the panel."""
    linear = np.array(facts.linear[:3])
    lines = [
        ("Pixel", f"{facts.x}, {facts.y}"),
        ("Linear", "  ".join(f"{value:.4g}" for value in linear)),
        ("Alpha", f"{facts.linear[3]:.4g}"),
        ("sRGB", "  ".join(f"{value:.3f}" for value in display_values(linear, exposure, gamma))),
    ]
    if facts.samples is not None:
        lines.append(("Samples", f"{facts.samples:g}"))
    if facts.standard_error is not None:
        lines.append(("Standard Error", f"{facts.standard_error:.3g}"))
    surface = facts.surface
    if surface is None:
        return [*lines, ("Surface", "none")]
    lines += [
        ("World Position", "  ".join(f"{value:.3f}" for value in surface.position)),
        ("Distance", f"{surface.distance:.4f} m"),
        ("Object", looked.object + (f" (copy {surface.copy + 1})" if surface.copy else "")),
        ("Material", looked.material or "none"),
        ("Triangle", str(surface.triangle)),
    ]
    if surface.uv is not None:
        lines.append(("UV", f"{surface.uv[0]:.4f}  {surface.uv[1]:.4f}"))
    lines += [("Texel", f"{x}, {y} of {name}") for name, x, y in facts.texels]
    return lines


class TRG_OT_inspect(bpy.types.Operator):
    """Show what stands behind the pixel under the mouse; a click or Esc ends it"""

    bl_idname = "trg.inspect"
    bl_label = "Inspect"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        space = context.space_data
        shown = getattr(space, "image", None)
        return shown is not None and shown.name == RESULT and shots.last_of(context.scene.name) is not None

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        context.window_manager.modal_handler_add(self)
        context.window.cursor_modal_set("EYEDROPPER")
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in ("ESC", "RIGHTMOUSE") or (event.type == "LEFTMOUSE" and event.value == "PRESS"):
            context.window.cursor_modal_restore()
            return {"FINISHED"}
        if event.type == "MOUSEMOVE" and not self._look(context, event):
            context.window.cursor_modal_restore()
            return {"CANCELLED"}
        return {"PASS_THROUGH"} if event.type in ("WHEELUPMOUSE", "WHEELDOWNMOUSE") else {"RUNNING_MODAL"}

    def _look(self, context: bpy.types.Context, event: bpy.types.Event) -> bool:
        """False when there is nothing more to look at."""
        area, shot = context.area, shots.last_of(context.scene.name)
        region = next((each for each in area.regions if each.type == "WINDOW"), None) if area else None
        if shot is None or region is None:
            return False
        u, v = region.view2d.region_to_view(event.mouse_x - region.x, event.mouse_y - region.y)
        width, height = shot.settings.width, shot.settings.height
        try:
            look_at(context.scene, shot, int(np.floor(u * width)), int(np.floor(v * height)))
        except NativeMissing as error:
            self.report({"ERROR"}, str(error))
            return False
        area.tag_redraw()
        return True


class TRG_IMAGE_PT_inspect(bpy.types.Panel):
    """The pixel under the mouse."""

    bl_label = "Pixel"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "TRG"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return shots.last_of(context.scene.name) is not None

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.operator("trg.inspect", icon="EYEDROPPER")
        if looked.facts is None:
            return
        view = context.scene.view_settings
        grid = layout.grid_flow(row_major=True, columns=2, align=True)
        for name, value in fact_lines(looked.facts, view.exposure, view.gamma):
            grid.label(text=name)
            grid.label(text=value)


def forget() -> None:
    looked.facts = None
    looked.object = looked.material = ""


CLASSES: tuple[Any, ...] = (TRG_OT_inspect, TRG_IMAGE_PT_inspect)
