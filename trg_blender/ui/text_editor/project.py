"""The tree of a project: the program, what it includes, the models and textures it asked for."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy

from ...engine import run_text
from .documents import documents, redraw_editors
from .places import text_named

MODEL_SUFFIXES = (".g3dm", ".g3d", ".obj", ".glb", ".gltf", ".ply", ".stl")
TEXTS = ("program", "include")


@dataclass(frozen=True, slots=True)
class ProjectRow:
    """A file of the project."""

    name: str
    kind: str
    """program, include, model or texture"""
    depth: int
    icon: str
    path: str = ""
    """where it lies; empty: in the .blend alone, or nowhere"""
    is_open: bool = False
    """a text of the .blend"""


def project_rows(scene: bpy.types.Scene) -> list[ProjectRow]:
    """The program and its files, each below what asked for it."""
    program = run_text.program_of(scene)
    if program is None:
        return []
    document = documents.look(program)
    rows = [_text_row(program.name, "program", 0)]
    sources = document.analysis.sources if document.analysis is not None else {}
    rows += [_text_row(name, "include", 1) for name in sources if name != program.name]
    for name, path in run_text.files_read(scene).items():
        kind = "model" if name.lower().endswith(MODEL_SUFFIXES) else "texture"
        icon = ("MESH_DATA" if kind == "model" else "TEXTURE") if path is not None else "ERROR"
        rows.append(ProjectRow(name, kind, 1, icon, "" if path is None else str(path)))
    return rows


def _text_row(name: str, kind: str, depth: int) -> ProjectRow:
    text = bpy.data.texts.get(name)
    path = bpy.path.abspath(text.filepath) if text is not None and text.filepath else ""
    icon = "FILE_SCRIPT" if kind == "program" else "FILE_TEXT"
    return ProjectRow(name, kind, depth, icon, path, text is not None)


class TRG_OT_reload(bpy.types.Operator):
    """Read the file again; what was edited in Blender and not saved is lost"""

    bl_idname = "trg.reload"
    bl_label = "Reload"

    name: bpy.props.StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]

    def execute(self, context: bpy.types.Context) -> set[str]:
        text = bpy.data.texts.get(self.name)
        if text is not None and text.filepath:
            path = Path(bpy.path.abspath(text.filepath))
            try:
                text.from_string(path.read_text(encoding="utf-8"))
            except (OSError, UnicodeDecodeError) as error:
                self.report({"ERROR"}, f"{self.name}: {error}")
                return {"CANCELLED"}
        else:
            for image in bpy.data.images:
                if image.filepath and Path(image.filepath).name == Path(self.name).name:
                    image.reload()
            run_text.programs.forget(context.scene)
        documents.recheck()
        redraw_editors()
        return {"FINISHED"}


class TRG_OT_text_remove(bpy.types.Operator):
    """Take the text out of the .blend; its file stays"""

    bl_idname = "trg.text_remove"
    bl_label = "Remove Text"
    bl_options = {"REGISTER", "UNDO"}

    name: bpy.props.StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]

    def execute(self, _context: bpy.types.Context) -> set[str]:
        text = bpy.data.texts.get(self.name)
        if text is None:
            return {"CANCELLED"}
        bpy.data.texts.remove(text)
        documents.known.pop(self.name, None)
        return {"FINISHED"}

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        text = text_named(self.name)
        if text is not None and (text.is_dirty or text.is_in_memory):
            return set(context.window_manager.invoke_confirm(self, event))
        return self.execute(context)


CLASSES = (TRG_OT_reload, TRG_OT_text_remove)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
