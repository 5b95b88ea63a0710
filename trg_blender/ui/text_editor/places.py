"""Going to a place of a text: one of the .blend, of a folder that programs may read, or of the library."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import bpy

from ...engine.to_blender.text_files import allowed_folders
from ...lang.files import bundled_library

PLACE = re.compile(r"^(?P<file>[^\s:][^:\n]*):(?P<line>\d+):(?P<column>\d+): ")
"""How a line of the log begins that has a place."""


def text_named(name: str, near: bpy.types.Text | None = None) -> bpy.types.Text | None:
    """The text that diagnostics call `name`; a file is opened, found from the folders `near` may read."""
    found = bpy.data.texts.get(name)
    if found is not None:
        return found
    library = bundled_library()
    folders = allowed_folders(near) if near is not None else []
    for folder in (*folders, *(() if library is None else (library,))):
        path = folder / name
        if path.is_file():
            return opened(path)
    return None


def opened(path: Path) -> bpy.types.Text:
    """The text of a file, loaded once. Raises RuntimeError when Blender cannot read it."""
    for text in bpy.data.texts:
        if text.filepath and Path(bpy.path.abspath(text.filepath)) == path:
            return text
    return bpy.data.texts.load(str(path))


def show(space: Any, text: bpy.types.Text, line: int, column: int) -> None:
    """Put the cursor of an editor to a place (from 1) and bring it into view."""
    space.text = text
    row = min(max(line, 1), len(text.lines)) - 1
    text.cursor_set(row, character=min(max(column, 1) - 1, len(text.lines[row].body)))
    if not space.top <= row < space.top + max(space.visible_lines - 1, 1):
        space.top = max(row - space.visible_lines // 3, 0)


def editor_space(context: bpy.types.Context) -> Any | None:
    """The text editor of the context, else the first one of its window."""
    area = context.area
    if area is not None and area.type == "TEXT_EDITOR":
        return area.spaces.active
    areas = context.window.screen.areas if context.window is not None else ()
    return next((area.spaces.active for area in areas if area.type == "TEXT_EDITOR"), None)
