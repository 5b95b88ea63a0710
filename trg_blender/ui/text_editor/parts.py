"""Everything of the text editor, put in and taken out in order."""

from __future__ import annotations

from . import documents, log, menus, operators, overlay, panels, project

PARTS = (documents, log, project, operators, panels, menus, overlay)


def register() -> None:
    for part in PARTS:
        part.register()


def unregister() -> None:
    for part in reversed(PARTS):
        part.unregister()
