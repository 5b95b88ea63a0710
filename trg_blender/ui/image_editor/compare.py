"""Two render slots side by side in numbers, and as a picture of their difference."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ...engine.flip import flip
from ...engine.probe import display_values, rmse
from ...engine.scene_arrays import Float32
from ...engine.shots import shots

DIFFERENCE = "TRG Difference"


def differ(a: Float32, b: Float32, kind: str) -> tuple[Float32, float, float]:
    """(picture (h, w, 4), RMSE of linear colours, mean FLIP) of two pictures of one size.

    `kind` is ABSOLUTE, linear colours' distances, or FLIP, as a grey 0..1.
    """
    flips = flip(display_values(a[..., :3]), display_values(b[..., :3]))
    shown = np.ones((*a.shape[:2], 4), np.float32)
    shown[..., :3] = flips[..., None] if kind == "FLIP" else np.abs(a[..., :3] - b[..., :3])
    return shown, rmse(a, b), float(flips.mean())


def show_picture(name: str, pixels: Float32) -> bpy.types.Image:
    """An image of Blender with these linear pixels, made or filled anew."""
    height, width = pixels.shape[:2]
    image = bpy.data.images.get(name)
    if image is not None and tuple(image.size) != (width, height):
        bpy.data.images.remove(image)
        image = None
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=False, float_buffer=True)
    image.pixels.foreach_set(np.ascontiguousarray(pixels, np.float32).reshape(-1))
    image.update()
    return image


class TRG_OT_compare(bpy.types.Operator):
    """Compare two render slots that TRG filled"""

    bl_idname = "trg.compare"
    bl_label = "Compare Slots"

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return len(shots.filled_slots()) >= 2

    def execute(self, context: bpy.types.Context) -> set[str]:
        own = context.window_manager.trg_compare
        pictures = [shots.slot(number - 1) for number in (own.first, own.second)]
        for number, picture in zip((own.first, own.second), pictures, strict=True):
            if picture is None:
                self.report({"ERROR"}, f"TRG has not rendered into slot {number}")
                return {"CANCELLED"}
        a, b = pictures
        if a.shape != b.shape:
            self.report({"ERROR"}, f"sizes differ: {a.shape[1]}x{a.shape[0]}, {b.shape[1]}x{b.shape[0]}")
            return {"CANCELLED"}
        pixels, own.rmse, own.flip = differ(a, b, own.kind)
        image = show_picture(DIFFERENCE, pixels)
        if context.space_data is not None and context.space_data.type == "IMAGE_EDITOR":
            context.space_data.image = image
        self.report({"INFO"}, f"RMSE {own.rmse:.4g}, mean FLIP {own.flip:.4g}")
        return {"FINISHED"}


class TRGCompareSettings(bpy.types.PropertyGroup):
    """What is compared, and what came of it."""

    first: bpy.props.IntProperty(name="Slot", default=1, min=1, max=32)  # type: ignore[valid-type]
    second: bpy.props.IntProperty(name="With", default=2, min=1, max=32)  # type: ignore[valid-type]
    kind: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Shown",
        description="The picture that the comparison makes",
        items=(
            ("FLIP", "FLIP", "What the eye sees when it flips between the two, 0 to 1"),
            ("ABSOLUTE", "Absolute", "How far linear colours are from each other"),
        ),
    )
    rmse: bpy.props.FloatProperty(default=-1.0, options={"HIDDEN"})  # type: ignore[valid-type]
    flip: bpy.props.FloatProperty(default=-1.0, options={"HIDDEN"})  # type: ignore[valid-type]


class TRG_IMAGE_PT_compare(bpy.types.Panel):
    """Two render slots and their difference."""

    bl_label = "Compare"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "TRG"

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return bool(shots.filled_slots())

    def draw(self, context: bpy.types.Context) -> None:
        layout, own = self.layout, context.window_manager.trg_compare
        layout.use_property_split, layout.use_property_decorate = True, False
        for name in ("first", "second", "kind"):
            layout.prop(own, name)
        layout.operator("trg.compare")
        if own.rmse >= 0.0:
            layout.label(text=f"RMSE {own.rmse:.4g}, mean FLIP {own.flip:.4g}")


CLASSES: tuple[Any, ...] = (TRGCompareSettings, TRG_OT_compare, TRG_IMAGE_PT_compare)
