"""What the panel says of the render under way, and of the last one: error, time and their curve."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from typing import Any

import bpy

from ..engine.report import format_progress
from ..engine.result import records
from .engine_panel import EnginePanel
from .error_curve import curve_icon

REDRAW_SECONDS = 0.5
CURVE_SCALE = 12.0
"""sides of an icon"""
NOTE_COLUMNS = 56


class TRG_RENDER_PT_report(EnginePanel, bpy.types.Panel):
    """Error and time of the render under way, and of the last one."""

    bl_label = "Error and Time"
    bl_context = "render"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        name = context.scene.name
        return super().poll(context) and (records.report_of(name) or records.progress_of(name)) is not None

    def draw(self, context: bpy.types.Context) -> None:
        progress = records.progress_of(context.scene.name)
        if progress is not None:
            for part in format_progress(progress).split(", "):
                self.layout.label(text=part)
            return
        report = records.report_of(context.scene.name)
        for line in report_lines(report):
            self.layout.label(text=line)
        for warning in report["warnings"]:
            self.layout.label(text=warning, icon="ERROR")
        icon = curve_icon.of(report)
        if icon:
            self.layout.template_icon(icon_value=icon, scale=CURVE_SCALE)
            self.layout.label(text="RMSE against seconds, 95 % band" + target_words(report))


def target_words(report: dict[str, Any]) -> str:
    return ", dashed: target" if report["error"].get("target") else ""


def report_lines(report: dict[str, Any]) -> list[str]:
    """The figures of a report that an artist asks for first."""
    error, seconds = report["error"], report["seconds"]
    lines = [f"{report['samples']:g} samples in {seconds['total']:.2f} s"]
    if error.get("rmse") is not None:
        lines.append(f"RMSE {error['rmse']:.4g}")
        if error["ci95"] is not None:
            low, high = error["ci95"]
            lines[-1] += f" (95 %: {low:.4g} to {high:.4g})"
    return lines + textwrap.wrap(error.get("note") or "", NOTE_COLUMNS)


@dataclass(slots=True)
class Redrawing:
    """A timer of the main thread: the panel shows what the thread that renders has told meanwhile."""

    was_rendering: bool = False

    def __call__(self) -> float:
        rendering = records.is_rendering()
        if rendering or self.was_rendering:
            for window in bpy.context.window_manager.windows:
                for area in window.screen.areas:
                    if area.type == "PROPERTIES":
                        area.tag_redraw()
        self.was_rendering = rendering
        return REDRAW_SECONDS


redrawing = Redrawing()
"""The one timer of this process: Blender tells its functions apart by identity."""

CLASSES = (TRG_RENDER_PT_report,)


def register() -> None:
    """Starts the timer; the panel itself is registered with the others."""
    if not bpy.app.background:
        bpy.app.timers.register(redrawing, first_interval=REDRAW_SECONDS, persistent=True)


def unregister() -> None:
    if bpy.app.timers.is_registered(redrawing):
        bpy.app.timers.unregister(redrawing)
    curve_icon.forget()
