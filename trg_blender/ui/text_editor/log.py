"""The log of a program: filtered, copied, with places to go to."""

from __future__ import annotations

from dataclasses import dataclass

import bpy

from ...engine import run_text
from .places import PLACE


@dataclass(frozen=True, slots=True)
class LogRow:
    """A line of the log; `file` is empty without a place."""

    text: str
    file: str = ""
    line: int = 1
    column: int = 1
    icon: str = "NONE"


def log_rows(log: list[str], wanted: str, only_problems: bool) -> list[LogRow]:
    """The first lines of all messages that hold `wanted`, whatever its case; oldest first."""
    rows = []
    for message in log:
        if wanted and wanted.lower() not in message.lower():
            continue
        first = message.partition("\n")[0]
        found = PLACE.match(first)
        if found is None:
            if not only_problems:
                rows.append(LogRow(first))
            continue
        icon = "CANCEL" if first[found.end() :].startswith("error") else "ERROR"
        rows.append(LogRow(first, found["file"], int(found["line"]), int(found["column"]), icon))
    return rows


class TRGLogSettings(bpy.types.PropertyGroup):
    """How the log is shown."""

    filter: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Filter", description="Show messages that hold this", options={"TEXTEDIT_UPDATE"}
    )
    only_problems: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Problems Only", description="Show errors and warnings, not what the program printed"
    )
    shown: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Lines", description="How many of the newest lines to show", default=15, min=1, max=200
    )


class TRG_OT_log_copy(bpy.types.Operator):
    """Copy the whole log, as filtered, to the clipboard"""

    bl_idname = "trg.log_copy"
    bl_label = "Copy Log"

    def execute(self, context: bpy.types.Context) -> set[str]:
        wanted = context.window_manager.trg_log.filter.lower()
        kept = [line for line in run_text.program_log(context.scene) if wanted in line.lower()]
        context.window_manager.clipboard = "\n".join(kept)
        self.report({"INFO"}, f"{len(kept)} messages copied")
        return {"FINISHED"}


class TRG_OT_log_clear(bpy.types.Operator):
    """Forget what the program said so far"""

    bl_idname = "trg.log_clear"
    bl_label = "Clear Log"

    def execute(self, context: bpy.types.Context) -> set[str]:
        run_text.program_log(context.scene).clear()
        return {"FINISHED"}


CLASSES: tuple[type, ...] = (TRGLogSettings, TRG_OT_log_copy, TRG_OT_log_clear)


def register() -> None:
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.WindowManager.trg_log = bpy.props.PointerProperty(type=TRGLogSettings)


def unregister() -> None:
    del bpy.types.WindowManager.trg_log
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
