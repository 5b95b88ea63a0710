"""The TRG language: compile a program, run it, take its frames. Needs the standard library only.

program = compile_source(text, "scene.trg", DiskFiles(folder))    # raises ProgramError
session = Session(program, HostOptions())
while isinstance(event := session.next_frame(), FrameEvent):
    use(event.scene)
session.output, session.diagnostics
"""

from __future__ import annotations

from . import library  # noqa: F401  (fills the host table)
from .bind import HOST
from .diagnostics import Diagnostic, ProgramError, render_diagnostic
from .exports import Export
from .files import DiskFiles, FileError, FileResolver, NoFiles
from .limits import HostOptions, Limits
from .parameters import ParameterError, parse_parameter, wrong_parameters
from .program import Program, compile_source
from .run import EndEvent, FrameEvent, PauseEvent, Session
from .scene import SceneDescription
from .source import SourceFile, Span

__all__ = [
    "HOST", "Diagnostic", "DiskFiles", "EndEvent", "Export", "FileError", "FileResolver", "FrameEvent",
    "HostOptions", "Limits", "NoFiles", "ParameterError", "PauseEvent", "Program", "ProgramError",
    "SceneDescription", "Session", "SourceFile", "Span", "compile_source", "parse_parameter",
    "render_diagnostic", "wrong_parameters",
]  # fmt: skip
