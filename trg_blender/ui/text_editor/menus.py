"""Entries in the text editor's menus and header, templates, and the keys."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy

from ...lang.files import bundled_library
from .documents import is_trg

KEYS = (
    ("trg.text_run", "P", {"alt": True}),
    ("trg.text_complete", "SPACE", {"ctrl": True}),
    ("trg.text_define", "D", {"alt": True}),
    ("trg.text_format", "F", {"alt": True, "shift": True}),
    ("trg.text_comment", "SLASH", {"ctrl": True}),
)
"""Operators whose poll asks for a TRG text: elsewhere the key goes on to Blender's own."""


def templates() -> list[Path]:
    """The example programs that come with TRG, by name."""
    library = bundled_library()
    return sorted((library / "examples").glob("*.trg")) if library is not None else []


class TRG_OT_template(bpy.types.Operator):
    """Start from this example"""

    bl_idname = "trg.template"
    bl_label = "New from Example"

    path: bpy.props.StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]

    def execute(self, context: bpy.types.Context) -> set[str]:
        path = Path(self.path)
        if path not in templates():
            self.report({"ERROR"}, f"{path.name} is no example of TRG")
            return {"CANCELLED"}
        text = bpy.data.texts.load(str(path))
        text.name = path.name
        context.space_data.text = text
        return {"FINISHED"}


class TRG_MT_templates(bpy.types.Menu):
    """Example programs."""

    bl_label = "TRG"

    def draw(self, _context: bpy.types.Context) -> None:
        for path in templates():
            name = path.stem.replace("_", " ").title()
            self.layout.operator("trg.template", text=name).path = str(path)


def _draw_templates(self: Any, _context: bpy.types.Context) -> None:
    self.layout.menu("TRG_MT_templates")


def _draw_header(self: Any, context: bpy.types.Context) -> None:
    if is_trg(context.space_data.text):
        self.layout.operator("trg.text_run", text="", icon="PLAY")


def _draw_context_menu(self: Any, context: bpy.types.Context) -> None:
    if not is_trg(context.space_data.text):
        return
    self.layout.separator()
    for operator in ("text_run", "text_complete", "text_define", "text_format", "text_comment"):
        self.layout.operator(f"trg.{operator}")


ADDITIONS = (
    ("TEXT_MT_templates", _draw_templates),
    ("TEXT_HT_header", _draw_header),
    ("TEXT_MT_context_menu", _draw_context_menu),
)
CLASSES = (TRG_OT_template, TRG_MT_templates)
_keys: list[tuple[Any, Any]] = []


def register() -> None:
    for each in CLASSES:
        bpy.utils.register_class(each)
    for name, function in ADDITIONS:
        getattr(bpy.types, name).append(function)
    configuration = bpy.context.window_manager.keyconfigs.addon
    if configuration is None:  # no window, no keys
        return
    keymap = configuration.keymaps.new("Text", space_type="TEXT_EDITOR")
    for operator, key, held in KEYS:
        _keys.append((keymap, keymap.keymap_items.new(operator, key, "PRESS", **held)))


def unregister() -> None:
    for keymap, item in _keys:
        keymap.keymap_items.remove(item)
    _keys.clear()
    for name, function in reversed(ADDITIONS):
        getattr(bpy.types, name).remove(function)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
