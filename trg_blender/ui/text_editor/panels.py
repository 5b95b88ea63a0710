"""The sidebar of the text editor: the program, its mistakes, its files, its log."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ...engine import run_text
from ..parameter_rows import draw_parameters
from .documents import documents, is_trg
from .log import log_rows
from .project import TEXTS, project_rows

ICONS = {"error": "CANCEL", "warning": "ERROR", "lint": "INFO"}
MAX_MISTAKES = 20


class TextPanel:
    """A panel beside a program."""

    bl_space_type = "TEXT_EDITOR"
    bl_region_type = "UI"
    bl_category = "TRG"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return is_trg(context.space_data.text) or run_text.program_of(context.scene) is not None


class TRG_TEXT_PT_program(TextPanel, bpy.types.Panel):
    """Which program the scene has, and what to do with the one shown."""

    bl_label = "Program"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.prop(context.scene.trg, "program", text="Scene's")
        column = layout.column(align=True)
        column.operator("trg.text_run", icon="PLAY")
        row = column.row(align=True)
        row.operator("trg.text_format")
        row.operator("trg.text_define", text="Definition")


class TRG_TEXT_PT_parameters(TextPanel, bpy.types.Panel):
    """The program's exported parameters."""

    bl_label = "Parameters"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(run_text.program_of(context.scene) and context.scene.trg.parameters.keys())

    def draw(self, context: bpy.types.Context) -> None:
        draw_parameters(self.layout, context.scene)


class TRG_TEXT_PT_problems(TextPanel, bpy.types.Panel):
    """Mistakes in the text shown; a click goes there."""

    bl_label = "Problems"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return is_trg(context.space_data.text)

    def draw(self, context: bpy.types.Context) -> None:
        layout, text = self.layout, context.space_data.text
        document = documents.look(text)
        found = document.analysis.diagnostics if document.analysis is not None else ()
        layout.active = document.is_checked
        if not found:
            layout.label(text="None found" if document.is_checked else "Looking …", icon="CHECKMARK")
        column = layout.column(align=True)
        for index, diagnostic in enumerate(found[:MAX_MISTAKES]):
            row = column.row(align=True)
            span = diagnostic.span
            words = f"{span.line}:{span.col}  {diagnostic.message}"
            button = row.operator("trg.goto", text=words, icon=ICONS[diagnostic.severity], emboss=False)
            button.file, button.line, button.column = span.file, span.line, span.col
            if diagnostic.fix is not None and diagnostic.fix[0].file == text.name:
                row.operator("trg.text_fix", text="", icon="MODIFIER").index = index
            if diagnostic.hint:
                column.label(text=diagnostic.hint, icon="BLANK1")
        if len(found) > MAX_MISTAKES:
            column.label(text=f"and {len(found) - MAX_MISTAKES} more", icon="BLANK1")


class TRG_TEXT_PT_project(TextPanel, bpy.types.Panel):
    """The program, what it includes, its models and textures."""

    bl_label = "Project"
    bl_options: ClassVar[set[str]] = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return run_text.program_of(context.scene) is not None

    def draw(self, context: bpy.types.Context) -> None:
        column = self.layout.column(align=True)
        for entry in project_rows(context.scene):
            row = column.row(align=True)
            if entry.depth:
                row.separator(factor=2.0 * entry.depth)
            if entry.kind in TEXTS:
                button = row.operator("trg.goto", text=entry.name, icon=entry.icon, emboss=False)
                button.file = entry.name
            else:
                row.label(text=entry.name, icon=entry.icon)
            if entry.path:
                row.operator("trg.reload", text="", icon="FILE_REFRESH", emboss=False).name = entry.name
            if entry.kind in TEXTS and entry.is_open:
                row.operator("trg.text_remove", text="", icon="X", emboss=False).name = entry.name
        row = self.layout.row(align=True)
        row.operator("text.open", text="Open", icon="FILEBROWSER")
        row.operator("text.new", text="New", icon="ADD")


class TRG_TEXT_PT_log(TextPanel, bpy.types.Panel):
    """What the program printed and was warned about; a click on a place goes there."""

    bl_label = "Log"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, context.window_manager.trg_log
        row = layout.row(align=True)
        row.prop(settings, "filter", text="", icon="VIEWZOOM")
        row.prop(settings, "only_problems", text="", icon="ERROR")
        row.operator("trg.log_copy", text="", icon="COPYDOWN")
        row.operator("trg.log_clear", text="", icon="TRASH")
        found = log_rows(run_text.program_log(context.scene), settings.filter, settings.only_problems)
        column = layout.column(align=True)
        column.scale_y = 0.8
        for entry in found[-settings.shown :]:
            if entry.file:
                button = column.operator("trg.goto", text=entry.text, icon=entry.icon, emboss=False)
                button.file, button.line, button.column = entry.file, entry.line, entry.column
            else:
                column.label(text=entry.text)
        if not found:
            column.label(text="Nothing said", icon="INFO")
        elif len(found) > settings.shown:
            layout.label(text=f"{len(found) - settings.shown} earlier lines; Copy takes all")
        layout.prop(settings, "shown")


CLASSES = (
    TRG_TEXT_PT_program,
    TRG_TEXT_PT_parameters,
    TRG_TEXT_PT_problems,
    TRG_TEXT_PT_project,
    TRG_TEXT_PT_log,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
