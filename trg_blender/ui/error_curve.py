"""The curve of the last render as an icon that panels can draw."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import bpy.utils.previews

from ..engine.curve_picture import SIDE, draw_curve

NAME = "error curve"


@dataclass(slots=True)
class CurveIcon:
    """One picture, drawn anew when another report is asked for. Panels alone use it, on the main thread."""

    collection: Any = None
    report: dict[str, Any] | None = None
    icon: int = 0

    def of(self, report: dict[str, Any]) -> int:
        """Number of the icon with the curve of `report`; 0 where there is none to draw."""
        if report is self.report:
            return self.icon
        self.report, self.icon = report, 0
        error = report["error"]
        pixels = draw_curve(error.get("history") or (), error.get("target"))
        if pixels is not None:
            preview = self._preview()
            preview.image_size = (SIDE, SIDE)
            preview.image_pixels_float.foreach_set(pixels.reshape(-1))
            self.icon = preview.icon_id
        return self.icon

    def forget(self) -> None:
        """Gives the picture back."""
        if self.collection is not None:
            bpy.utils.previews.remove(self.collection)
        self.collection, self.report, self.icon = None, None, 0

    def _preview(self) -> Any:
        if self.collection is None:
            self.collection = bpy.utils.previews.new()
        return self.collection[NAME] if NAME in self.collection else self.collection.new(NAME)


curve_icon = CurveIcon()
"""The one icon of this process: it belongs to Blender's store of icons, which is one as well."""
