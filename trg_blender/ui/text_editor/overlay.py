"""Colours over the text that Blender draws plain, and lines under mistakes with their message behind.

Blender knows no colours for `.trg` and has no registration for more. The text is drawn on a grid of whole
pixels; a font advances by fractions, so long words are drawn piece by piece.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import blf
import bpy
import gpu
from gpu_extras.batch import batch_for_shader

from ...lang.diagnostics import Diagnostic
from .documents import Document, documents, is_trg, start_timer

EDITOR_FONT = 1
ERROR_COLOUR = (1.0, 0.32, 0.28, 1.0)
WARNING_COLOUR = (1.0, 0.75, 0.2, 1.0)
THEME_NAMES = {
    "keyword": "syntax_builtin",
    "builtin": "syntax_special",
    "number": "syntax_numbers",
    "string": "syntax_string",
    "comment": "syntax_comment",
    "symbol": "syntax_symbols",
}
DRIFT = 0.5
"""Pixels by which a piece may end beside its place on the grid."""


@dataclass(frozen=True, slots=True)
class Grid:
    """Where the editor draws its characters, in pixels of the region."""

    space: Any
    cell: int
    """width of a character"""
    piece: int
    """characters that may be drawn at once"""
    left: int
    """the first pixel of the text, behind the line numbers"""
    width: int
    height: int
    size: float

    def place(self, line: int, column: int) -> tuple[int, int] | None:
        """The corner of a character, None where it is not in view. Line and column from 0."""
        x, y = self.space.region_location_from_cursor(line, column)
        inside = self.left <= x < self.width and -self.size <= y < self.height
        return (x, y) if inside else None


def draw() -> None:
    """The draw handler of text editors. A mistake of its own must not break Blender's drawing."""
    context = bpy.context
    space = context.space_data
    if not is_trg(space.text):
        return
    document = documents.look(space.text)
    if not document.is_checked:
        start_timer()
    grid = _grid_of(context, space)
    if grid is None:
        return
    lines = range(space.top, min(space.top + space.visible_lines + 1, len(space.text.lines)))
    if space.show_syntax_highlight:
        _draw_runs(grid, document, lines, context.preferences.themes[0].text_editor)
    if document.is_checked:
        _draw_mistakes(grid, document, lines)


def _grid_of(context: bpy.types.Context, space: Any) -> Grid | None:
    """None when the region is too narrow for text."""
    size = space.font_size * context.preferences.system.ui_scale
    blf.size(EDITOR_FONT, size)
    advance = blf.dimensions(EDITOR_FONT, "0" * 64)[0] / 64
    cell = _cell_of(space) or max(int(advance), 1)
    piece = 256 if abs(cell - advance) * 256 < DRIFT else max(int(DRIFT / abs(cell - advance)), 1)
    digits = len(str(len(space.text.lines)))
    left = cell * (digits + 2) if space.show_line_numbers else 0
    region = context.region
    if region.width < 2 * cell:
        return None
    return Grid(space, cell, piece, left, region.width, region.height, size)


def _cell_of(space: Any) -> int:
    """Width of a character as the editor draws it, read from the longest line in view; 0 without one."""
    lines = space.text.lines
    shown = range(space.top, min(space.top + max(space.visible_lines, 1), len(lines)))
    number = max(shown, key=lambda n: len(lines[n].body) if lines[n].body.isascii() else 0, default=-1)
    columns = min(len(lines[number].body), 8) if number >= 0 else 0
    if columns == 0 or "\t" in lines[number].body[:columns]:
        return 0
    first = space.region_location_from_cursor(number, 0)
    last = space.region_location_from_cursor(number, columns)
    return int((last[0] - first[0]) / columns) if last[1] == first[1] else 0


def _pieces(line: str, start: int, end: int, grid: Grid) -> Iterator[tuple[int, str]]:
    """(column, characters) as long as may be drawn at once; wide characters and tabs stand alone."""
    whole = line.isascii() and "\t" not in line and not grid.space.show_word_wrap
    step = grid.piece if whole else 1
    for column in range(start, end, step):
        yield column, line[column : min(column + step, end)]


def _draw_runs(grid: Grid, document: Document, lines: range, theme: Any) -> None:
    colours = {kind: (*getattr(theme, name), 1.0) for kind, name in THEME_NAMES.items()}
    text = grid.space.text
    for number in lines:
        line = text.lines[number].body
        for run in document.runs[number] if number < len(document.runs) else ():
            blf.color(EDITOR_FONT, *colours[run.kind])
            for column, characters in _pieces(line, run.start, run.end, grid):
                place = grid.place(number, column)
                if place is not None:
                    blf.position(EDITOR_FONT, place[0], place[1] + 0.25 * grid.size, 0)
                    blf.draw(EDITOR_FONT, characters)


def mistakes_by_line(document: Document, name: str) -> dict[int, Diagnostic]:
    """The worst finding of each line of the text itself; lines from 0."""
    found: dict[int, Diagnostic] = {}
    for diagnostic in document.analysis.diagnostics if document.analysis is not None else ():
        line = diagnostic.span.line - 1
        if diagnostic.span.file == name and (line not in found or diagnostic.severity == "error"):
            found.setdefault(line, diagnostic)
            if found[line].severity != "error":
                found[line] = diagnostic
    return found


def _draw_mistakes(grid: Grid, document: Document, lines: range) -> None:
    text = grid.space.text
    for number, diagnostic in mistakes_by_line(document, text.name).items():
        if number not in lines:
            continue
        colour = ERROR_COLOUR if diagnostic.severity == "error" else WARNING_COLOUR
        line = text.lines[number].body
        span = diagnostic.span
        last = span.end_col - 1 if span.end_line == span.line else len(line)
        begin = grid.place(number, min(span.col - 1, len(line)))
        if begin is not None:
            _draw_line(begin, max(last - span.col + 1, 1) * grid.cell, grid, colour)
        behind = grid.place(number, len(line))
        if behind is not None:
            _draw_message(diagnostic.message, behind, grid, colour)


def _draw_line(place: tuple[int, int], length: int, grid: Grid, colour: tuple[float, ...]) -> None:
    x, y = place
    right, thick = min(x + length, grid.width), max(round(grid.size / 9), 1)
    corners = ((x, y), (right, y), (right, y + thick), (x, y), (right, y + thick), (x, y + thick))
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    batch = batch_for_shader(shader, "TRIS", {"pos": [(a, b, 0.0) for a, b in corners]})
    gpu.state.blend_set("ALPHA")
    shader.bind()
    shader.uniform_float("color", colour)
    batch.draw(shader)
    gpu.state.blend_set("NONE")


def _draw_message(message: str, place: tuple[int, int], grid: Grid, colour: tuple[float, ...]) -> None:
    x = place[0] + 3 * grid.cell
    room = (grid.width - x) // grid.cell - 1
    if room < 4:
        return
    shown = message if len(message) <= room else message[: room - 1] + "…"
    blf.color(EDITOR_FONT, *colour[:3], 0.85)
    blf.position(EDITOR_FONT, x, place[1] + 0.25 * grid.size, 0)
    blf.draw(EDITOR_FONT, shown)


@dataclass(slots=True)
class _Handler:
    handle: Any = None


_handler = _Handler()


def register() -> None:
    if not bpy.app.background:
        _handler.handle = bpy.types.SpaceTextEditor.draw_handler_add(draw, (), "WINDOW", "POST_PIXEL")


def unregister() -> None:
    if _handler.handle is not None:
        bpy.types.SpaceTextEditor.draw_handler_remove(_handler.handle, "WINDOW")
        _handler.handle = None
