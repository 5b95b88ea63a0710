"""What is known of the texts that editors show: their colours at once, their mistakes after a pause.

Blender calls nobody when a key is typed. Drawing compares the text with the one seen last; a timer looks
for mistakes when the text has rested, and longer when looking took long. Nothing of Blender's is kept.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import bpy

from ...engine.to_blender.program_runner import message_language
from ...engine.to_blender.text_files import TextFiles
from ...lang.analysis import Analysis, analyse_source
from ...lang.highlight import Run, highlight

REST_SECONDS = 0.3
REST_FOR_COST = 5.0
"""A text rests at least so many times the seconds that its last analysis took."""
MAX_COLOURED = 1 << 19
"""Longer texts are drawn without colours; no program may be so long."""


@dataclass(slots=True)
class Document:
    """One text as it was seen last."""

    source: str
    runs: tuple[tuple[Run, ...], ...]
    changed: float
    analysis: Analysis | None = None
    """of the last text that was analysed, perhaps an older one: see is_checked"""
    is_checked: bool = False
    cost: float = 0.0


@dataclass(slots=True)
class Documents:
    """Documents by the name of their text."""

    known: dict[str, Document] = field(default_factory=dict)

    def look(self, text: bpy.types.Text) -> Document:
        """The document of a text, with the colours of what it holds now."""
        source = text.as_string()
        kept = self.known.get(text.name)
        if kept is not None and kept.source == source:
            return kept
        runs = highlight(source) if len(source) <= MAX_COLOURED else ()
        made = Document(source, runs, time.monotonic())
        if kept is not None:
            made.analysis, made.cost = kept.analysis, kept.cost
        self.known[text.name] = made
        return made

    def check(self, text: bpy.types.Text) -> Document:
        """The document with the analysis of what the text holds now."""
        document = self.look(text)
        if not document.is_checked:
            begin = time.perf_counter()
            document.analysis = analyse_source(
                document.source, text.name, TextFiles(text), message_language()
            )
            document.is_checked = True
            document.cost = time.perf_counter() - begin
        return document

    def check_rested(self) -> bool:
        """Analyse one text that has rested; True when some text waits still."""
        waiting = False
        for name, document in tuple(self.known.items()):
            if document.is_checked:
                continue
            text = bpy.data.texts.get(name)
            if text is None:
                del self.known[name]
            elif time.monotonic() - document.changed >= max(REST_SECONDS, REST_FOR_COST * document.cost):
                self.check(text)
                return True
            else:
                waiting = True
        return waiting

    def recheck(self) -> None:
        """What a text includes may have changed: analyse all again."""
        for document in self.known.values():
            document.is_checked = False


documents = Documents()


def is_trg(text: bpy.types.Text | None) -> bool:
    """Whether a text is a TRG program, by its name or its file."""
    return text is not None and (text.name.endswith(".trg") or text.filepath.endswith(".trg"))


def redraw_editors() -> None:
    """Have every text editor drawn again."""
    manager = bpy.context.window_manager
    for window in manager.windows if manager is not None else ():
        for area in window.screen.areas:
            if area.type == "TEXT_EDITOR":
                area.tag_redraw()


def _on_timer() -> float | None:
    """Analyse what has rested; ends when nothing waits."""
    counted = sum(document.is_checked for document in documents.known.values())
    waits = documents.check_rested()
    if sum(document.is_checked for document in documents.known.values()) != counted:
        redraw_editors()
    return REST_SECONDS / 3 if waits else None


def start_timer() -> None:
    """Let the timer run when a text waits for its analysis."""
    if not bpy.app.timers.is_registered(_on_timer):
        bpy.app.timers.register(_on_timer, first_interval=REST_SECONDS)


def register() -> None:
    documents.known.clear()


def unregister() -> None:
    if bpy.app.timers.is_registered(_on_timer):
        bpy.app.timers.unregister(_on_timer)
    documents.known.clear()
