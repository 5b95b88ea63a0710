"""What a user does to a program in the text editor."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ... import lang
from ...engine import run_text
from ...engine.to_blender.program_runner import message_language
from ...lang.completion import complete
from ...lang.format import format_source
from ...lang.hover import define, describe
from .documents import documents, is_trg, redraw_editors
from .places import editor_space, show, text_named

_SHOWN_DOC = 90


class EditorOperator:
    """An operator on the program that the text editor shows."""

    bl_options: ClassVar[set[str]] = {"REGISTER"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.area is not None and is_trg(getattr(context.space_data, "text", None))


class TRG_OT_text_run(EditorOperator, bpy.types.Operator):
    """Build the scene from this program; an included file runs the program that includes it"""

    bl_idname = "trg.text_run"
    bl_label = "Run Program"

    def execute(self, context: bpy.types.Context) -> set[str]:
        text, settings = context.space_data.text, context.scene.trg
        if text.name not in included_by(context.scene):
            settings.program = text
        documents.recheck()
        try:
            return bpy.ops.trg.build("EXEC_DEFAULT", True)
        except RuntimeError as error:
            self.report({"ERROR"}, str(error).removeprefix("Error: ").strip())
            _go_to_failure(context)
            return {"CANCELLED"}
        finally:
            redraw_editors()


class TRG_OT_text_complete(EditorOperator, bpy.types.Operator):
    """Offer what fits at the cursor"""

    bl_idname = "trg.text_complete"
    bl_label = "Complete"
    bl_property = "choice"

    offered: ClassVar[list[tuple[str, str, str]]] = []
    """Blender keeps no copy of the strings of an enum that a function gives."""

    def offer(self, _context: bpy.types.Context | None) -> list[tuple[str, str, str]]:
        return TRG_OT_text_complete.offered

    choice: bpy.props.EnumProperty(name="Word", items=offer)  # type: ignore[valid-type]

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        text = context.space_data.text
        found = suggestions(text)
        TRG_OT_text_complete.offered = found
        if not found:
            self.report({"INFO"}, "nothing fits here")
            return {"CANCELLED"}
        if len(found) == 1:
            insert_word(text, found[0][0])
            return {"FINISHED"}
        context.window_manager.invoke_search_popup(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        insert_word(context.space_data.text, self.choice)
        return {"FINISHED"}


class TRG_OT_text_define(EditorOperator, bpy.types.Operator):
    """Go to where the name at the cursor is defined, or say what it is"""

    bl_idname = "trg.text_define"
    bl_label = "Go to Definition"

    def execute(self, context: bpy.types.Context) -> set[str]:
        space = context.space_data
        text = space.text
        analysis = documents.check(text).analysis
        line, column = text.current_line_index + 1, text.current_character + 1
        span = define(analysis, line, column)
        target = None if span is None else text_named(span.file, text)
        if span is not None and target is not None:
            show(space, target, span.line, span.col)
            return {"FINISHED"}
        told = describe(analysis, line, column)
        if told is None:
            self.report({"INFO"}, "no name at the cursor")
            return {"CANCELLED"}
        self.report({"INFO"}, " ".join(told[0].replace("```trg", "").replace("```", " - ").split()))
        return {"FINISHED"}


class TRG_OT_text_format(EditorOperator, bpy.types.Operator):
    """Put the program into the standard layout"""

    bl_idname = "trg.text_format"
    bl_label = "Format"

    def execute(self, context: bpy.types.Context) -> set[str]:
        text = context.space_data.text
        try:
            made = format_source(text.as_string(), text.name, message_language())
        except lang.ProgramError as error:
            first = error.diagnostics[0]
            self.report({"ERROR"}, f"{first.span}: {first.message}")
            show(context.space_data, text, first.span.line, first.span.col)
            return {"CANCELLED"}
        replace_all(context, text, made)
        return {"FINISHED"}


class TRG_OT_text_comment(EditorOperator, bpy.types.Operator):
    """Put // before the selected lines, or take it away"""

    bl_idname = "trg.text_comment"
    bl_label = "Toggle Comments"

    def execute(self, context: bpy.types.Context) -> set[str]:
        text = context.space_data.text
        first, last = sorted((text.current_line_index, text.select_end_line_index))
        lines = text.as_string().split("\n")
        lines[first : last + 1] = toggled(lines[first : last + 1])
        replace_all(context, text, "\n".join(lines))
        return {"FINISHED"}


class TRG_OT_text_fix(EditorOperator, bpy.types.Operator):
    """Write what the message proposes"""

    bl_idname = "trg.text_fix"
    bl_label = "Fix"

    index: bpy.props.IntProperty(options={"HIDDEN"})  # type: ignore[valid-type]

    def execute(self, context: bpy.types.Context) -> set[str]:
        text = context.space_data.text
        found = documents.check(text).analysis.diagnostics
        fix = found[self.index].fix if self.index < len(found) else None
        if fix is None or fix[0].file != text.name:
            self.report({"INFO"}, "the text has changed")
            return {"CANCELLED"}
        span, replacement = fix
        text.select_set(span.line - 1, span.col - 1, span.end_line - 1, span.end_col - 1)
        text.write(replacement)
        return {"FINISHED"}


class TRG_OT_goto(bpy.types.Operator):
    """Go to this place in the text editor"""

    bl_idname = "trg.goto"
    bl_label = "Go to Place"

    file: bpy.props.StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    line: bpy.props.IntProperty(default=1, options={"HIDDEN"})  # type: ignore[valid-type]
    column: bpy.props.IntProperty(default=1, options={"HIDDEN"})  # type: ignore[valid-type]

    def execute(self, context: bpy.types.Context) -> set[str]:
        space = editor_space(context)
        near = run_text.program_of(context.scene) or (space.text if space is not None else None)
        text = text_named(self.file, near)
        if space is None or text is None:
            self.report({"WARNING"}, f"{self.file} is not here" if text is None else "no text editor is open")
            return {"CANCELLED"}
        show(space, text, self.line, self.column)
        redraw_editors()
        return {"FINISHED"}


def included_by(scene: bpy.types.Scene) -> set[str]:
    """Names of the texts that the scene's program includes."""
    program = run_text.program_of(scene)
    if program is None:
        return set()
    analysis = documents.check(program).analysis
    return set(analysis.sources) - {program.name}


def suggestions(text: bpy.types.Text) -> list[tuple[str, str, str]]:
    """Items of the completion's list: what begins as the word at the cursor does, else all that fits."""
    analysis = documents.check(text).analysis
    found = complete(analysis, text.current_line_index + 1, text.current_character + 1)
    start = word_start(text)
    begun = text.current_line.body[start : text.current_character].lower()
    fitting = [each for each in found if each.label.lower().lstrip('"').startswith(begun)] or found
    items = []
    for each in fitting:
        doc = " ".join(part for part in (each.detail, each.doc) if part)
        shown = f"{each.label}   {each.detail[:_SHOWN_DOC]}" if each.detail else each.label
        items.append((each.label, shown, doc.replace("`", "")))
    return items


def word_start(text: bpy.types.Text) -> int:
    """Column where the word before the cursor begins."""
    line, start = text.current_line.body, text.current_character
    while start > 0 and (line[start - 1].isalnum() or line[start - 1] == "_"):
        start -= 1
    return start


def insert_word(text: bpy.types.Text, word: str) -> None:
    """Put `word` in the place of the one before the cursor."""
    row, end = text.current_line_index, text.current_character
    text.select_set(row, word_start(text), row, end)
    text.write(word)


def replace_all(context: bpy.types.Context, text: bpy.types.Text, source: str) -> None:
    """Another content in one step that Ctrl-Z takes back; the cursor stays at its line."""
    if source == text.as_string():
        return
    row, column, top = text.current_line_index, text.current_character, context.space_data.top
    bpy.ops.text.select_all()
    bpy.ops.text.insert("EXEC_DEFAULT", True, text=source)
    row = min(row, len(text.lines) - 1)
    text.cursor_set(row, character=min(column, len(text.lines[row].body)))
    context.space_data.top = top


def toggled(lines: list[str]) -> list[str]:
    """Lines with // before their first character, or without it when all that hold text have it."""
    full = [line for line in lines if line.strip()]
    if full and all(line.lstrip().startswith("//") for line in full):
        return [_uncommented(line) for line in lines]
    indent = min((len(line) - len(line.lstrip()) for line in full), default=0)
    return [f"{line[:indent]}// {line[indent:]}" if line.strip() else line for line in lines]


def _uncommented(line: str) -> str:
    before, mark, after = line.partition("//")
    return before + after.removeprefix(" ") if mark else line


def _go_to_failure(context: bpy.types.Context) -> None:
    """Show the place of the first error."""
    diagnostics = run_text.last_diagnostics(context.scene)
    if not diagnostics:
        return
    span = diagnostics[0].span
    text = text_named(span.file, context.space_data.text)
    if text is not None:
        show(context.space_data, text, span.line, span.col)


CLASSES = (
    TRG_OT_text_run,
    TRG_OT_text_complete,
    TRG_OT_text_define,
    TRG_OT_text_format,
    TRG_OT_text_comment,
    TRG_OT_text_fix,
    TRG_OT_goto,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
