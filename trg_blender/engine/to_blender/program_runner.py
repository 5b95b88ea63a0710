"""One scene's program between its frames: compile it, run it on or anew, hand its scene to the mirror."""

from __future__ import annotations

import hashlib
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import bpy

from ... import lang
from .. import errors
from .mirror import MirrorCounts, SceneMirror, new_planner
from .parameters import offer_parameters, parameter_values
from .plan import Planner
from .text_files import TextFiles
from .user_settings import program_limits, wanted_language

RUN_AHEAD_SECONDS = 120.0
"""How long a jump to a later frame may take before the program counts as out of budget."""
MAX_LOG_LINES = 10_000

EXIT_WRONG = 1
EXIT_BUDGET = 3


@dataclass(frozen=True, slots=True)
class ProgramFailure:
    """Why there is no new frame. `text` is ready to be shown: file:line:col: error: ..., with the lines."""

    text: str
    exit_code: int = EXIT_WRONG
    diagnostics: tuple[lang.Diagnostic, ...] = ()

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True, slots=True)
class ProgramOutcome:
    """What came of running a program up to a frame."""

    frame: int
    """of the program: 1 is its first Render()"""
    failure: ProgramFailure | None = None
    counts: MirrorCounts | None = None
    """what was written to the scene; None: nothing was tried"""
    ended: bool = False
    """the program came to its end earlier: its last frame stays"""
    seconds: float = 0.0


@dataclass(slots=True)
class ProgramRunner:
    """One scene's program between its frames. Holds nothing of Blender's, so undo cannot break it."""

    log: list[str] = field(default_factory=list)
    """what the program printed and was warned about, oldest first"""
    last_failure: ProgramFailure | None = None
    """why the last run gave no frame"""
    _digest: str = ""
    _files: TextFiles | None = None
    _own_source: lang.SourceFile | None = None
    _program: lang.Program | None = None
    _session: lang.Session | None = None
    _frame: int = 0
    _last: lang.SceneDescription | None = None
    _ended: bool = False
    _output_taken: int = 0
    _diagnostics_taken: int = 0
    _parameters: dict[str, Any] = field(default_factory=dict)
    """values that the session runs with"""
    _planner: Planner = field(default_factory=new_planner)

    def run(self, scene: bpy.types.Scene, text: bpy.types.Text, frame: int) -> ProgramOutcome:
        """Bring the scene to the program's frame (1 is the first), restarting to go back."""
        begin = time.perf_counter()
        failure = None
        counts = None
        try:
            self.compile(scene, text)
            self._advance(scene, frame)
            mirror = SceneMirror(scene, self._planner)
            counts = mirror.apply(self._scene_to_show(text))
            self._say(mirror.warnings)
        except _Failed as failed:
            failure = failed.failure
        except lang.ProgramError as error:
            failure = self._failure_of(error.diagnostics)
        except errors.SceneError as error:
            failure = ProgramFailure(str(error))
        finally:
            self._take_output()
        self.last_failure = failure
        if failure is not None:
            self._say([failure.text])
            self._restart()
        return ProgramOutcome(frame, failure, counts, self._ended, time.perf_counter() - begin)

    @property
    def files_read(self) -> dict[str, Path | None]:
        """Models and images that the program asked for, by the name it wrote; None: not found."""
        return {} if self._files is None else dict(self._files.read)

    def compile(self, scene: bpy.types.Scene, text: bpy.types.Text) -> lang.Program:
        """Compile when the text or anything it includes is not what it was; offer its parameters.

        Raises ProgramError.
        """
        self._compile(text)
        offer_parameters(scene, self._program)
        return self._program

    def _compile(self, text: bpy.types.Text) -> None:
        source = text.as_string()
        digest = hashlib.blake2b(f"{text.name}\0{source}".encode()).hexdigest()
        if self._program is not None and digest == self._digest and self._files.is_current(text):
            return
        self._restart()
        self._program = None
        self._digest = digest
        self._files = TextFiles(text)
        self._own_source = lang.SourceFile.from_text(text.name, source)
        self._program = lang.compile_source(source, text.name, self._files, message_language())
        self._say([self._shown(lint) for lint in self._program.diagnostics])

    def _advance(self, scene: bpy.types.Scene, frame: int) -> None:
        """Let the program run to its `frame`-th Render() or to its end. Raises _Failed."""
        parameters = parameter_values(scene, self._program)
        if self._session is None or frame < self._frame or parameters != self._parameters:
            self._restart()
            self._parameters = parameters
            options = replace(host_options(scene), parameters=parameters)
            self._session = lang.Session(self._program, options)
        deadline = time.monotonic() + RUN_AHEAD_SECONDS
        while self._frame < frame and not self._ended:
            event = self._session.next_frame()
            if isinstance(event, lang.FrameEvent):
                self._frame += 1
                self._last = event.scene
            elif isinstance(event, lang.EndEvent):
                self._ended = True
                if event.error is not None:
                    raise _Failed(self._failure_of((event.error,), event.out_of_budget))
            if self._frame < frame and time.monotonic() > deadline:
                late = (
                    f"frame {frame} was not reached within {RUN_AHEAD_SECONDS:g} s, only frame {self._frame}"
                )
                raise _Failed(ProgramFailure(f"{self._program.main}: error: {late}", EXIT_BUDGET))

    def _scene_to_show(self, text: bpy.types.Text) -> lang.SceneDescription:
        """The program's last frame. Raises _Failed when it ended without one."""
        if self._last is None:
            message = "error: the program ended before its first Scene.Render()"
            raise _Failed(ProgramFailure(f"{text.name}: {message}"))
        return self._last

    def _restart(self) -> None:
        self._session = None
        self._frame, self._last, self._ended = 0, None, False
        self._output_taken = self._diagnostics_taken = 0

    def _take_output(self) -> None:
        """Move what the session printed and warned about since the last time into the log."""
        if self._session is None:
            return
        printed = self._session.output[self._output_taken :]
        found = self._session.diagnostics[self._diagnostics_taken :]
        self._output_taken += len(printed)
        self._diagnostics_taken += len(found)
        self._say([*printed, *(self._shown(d) for d in found if d.severity != "error")])

    def _say(self, lines: list[str]) -> None:
        self.log += lines
        del self.log[:-MAX_LOG_LINES]

    def _shown(self, diagnostic: lang.Diagnostic) -> str:
        sources = dict(self._files.sources) if self._files is not None else {}
        if self._own_source is not None:
            sources[self._own_source.name] = self._own_source
        return lang.render_diagnostic(diagnostic, sources)

    def _failure_of(
        self, diagnostics: tuple[lang.Diagnostic, ...], out_of_budget: bool = False
    ) -> ProgramFailure:
        found = tuple(d for d in diagnostics if d.severity == "error")
        text = "\n".join(self._shown(d) for d in found)
        return ProgramFailure(text, EXIT_BUDGET if out_of_budget else EXIT_WRONG, found)


class _Failed(Exception):
    """Carries a failure to the one place that keeps it."""

    def __init__(self, failure: ProgramFailure) -> None:
        super().__init__(failure.text)
        self.failure = failure


def message_language() -> str:
    """Language of diagnostics: the user's choice, else that of Blender's interface where TRG speaks it."""
    return wanted_language() or ("ru" if bpy.app.translations.locale.startswith("ru") else "en")


def host_options(scene: bpy.types.Scene) -> lang.HostOptions:
    """std::frames() counts the timeline, std::fps() is the scene's."""
    frames = max(scene.frame_end - scene.frame_start + 1, 1)
    return lang.HostOptions(
        limits=program_limits(),
        frames=frames,
        fps=scene.render.fps / scene.render.fps_base,
        language=message_language(),
    )
