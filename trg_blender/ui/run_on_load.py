"""Running a scene's program when its file is opened, where its user asked for it and trusts the file.

Programs cannot harm, but they take time and change the scene: so the same preference rules as for Python,
Auto Run Python Scripts, with its excluded folders.
"""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy.app.handlers import persistent

from ..engine import run_text


def may_run(path: str) -> bool:
    """Whether the preferences let a file of `path` run what it brings."""
    files = bpy.context.preferences.filepaths
    if not files.use_scripts_auto_execute:
        return False
    folders = [entry.path for entry in bpy.context.preferences.autoexec_paths if entry.path]
    return not any(Path(path).is_relative_to(bpy.path.abspath(folder)) for folder in folders)


def run_all() -> list[str]:
    """Run the programs that wish it; gives what went wrong."""
    failures = []
    for scene in bpy.data.scenes:
        if scene.trg.run_on_load and run_text.program_of(scene) is not None:
            outcome = run_text.run_program(scene, run_text.frame_of(scene))
            if outcome is not None and outcome.failure is not None:
                failures.append(outcome.failure.text)
    return failures


@persistent
def _on_load(*_: object) -> None:
    if may_run(bpy.data.filepath):
        run_all()


def register() -> None:
    bpy.app.handlers.load_post.append(_on_load)


def unregister() -> None:
    bpy.app.handlers.load_post.remove(_on_load)
