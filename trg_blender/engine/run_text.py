"""Running the program of a scene: frame k of the timeline is the program's k-th Scene.Render().

`run_program(scene, frame)` builds one frame and is what the command line calls. The handlers do the
same for every render with the TRG engine: `render_init` (once, the last moment at which a picture size
counts) and `render_pre` (each frame). A handler cannot stop a render, so what went wrong waits in
`take_pending_error` for the engine's update().
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import bpy
from bpy.app.handlers import persistent

from .. import lang
from .to_blender.main_thread import MainThread, MainThreadBusy
from .to_blender.program_runner import ProgramFailure, ProgramOutcome, ProgramRunner

ENGINE_ID = "TRG"


@dataclass(frozen=True, slots=True)
class _Pending:
    """A failure that waits for the engine."""

    frame: int
    failure: ProgramFailure


class ProgramTable:
    """The runners of all scenes, what went wrong in handlers, and the way to the main thread."""

    def __init__(self) -> None:
        self.main_thread = MainThread()
        self._runners: dict[str, ProgramRunner] = {}
        self._pending: dict[str, _Pending] = {}
        self._is_running = False
        self.last_failures: dict[str, str] = {}
        """by scene: why the last run of its program built nothing; not there when it did"""

    def runner_of(self, scene: bpy.types.Scene) -> ProgramRunner:
        return self._runners.setdefault(scene.name, ProgramRunner())

    def forget(self, scene: bpy.types.Scene) -> None:
        """Have the scene's program compiled and run from its start, its files read again."""
        self._runners.pop(scene.name, None)

    def forget_all(self) -> None:
        self._runners.clear()
        self._pending.clear()
        self.last_failures.clear()

    def run(self, scene: bpy.types.Scene, frame: int) -> ProgramOutcome | None:
        """See run_program. One program at a time: a second one, started from within, is refused."""
        text = program_of(scene)
        if text is None:
            return None
        if self._is_running:
            return ProgramOutcome(frame, ProgramFailure("another program is running"))
        self._is_running = True
        try:
            outcome = self.runner_of(scene).run(scene, text, frame)
        finally:
            self._is_running = False
        self.last_failures.pop(scene.name, None)
        if outcome.failure is not None:
            self.last_failures[scene.name] = outcome.failure.text
        return outcome

    def run_in_handler(self, scene: bpy.types.Scene) -> None:
        """Build the scene's current frame on the main thread; keep what goes wrong for the engine.

        A frame that failed is not tried again before the engine has taken the failure.
        """
        if scene.render.engine != ENGINE_ID or program_of(scene) is None:
            self.drop_pending(scene)
            return
        frame = frame_of(scene)
        pending = self._pending.pop(scene.name, None)
        if pending is not None and pending.frame == frame:
            self._pending[scene.name] = pending
            return

        def work() -> ProgramOutcome | None:
            outcome = self.run(scene, frame)
            _settle_view_layers()
            return outcome

        try:
            outcome = self.main_thread.call(work)
            failure = outcome.failure if outcome is not None else None
        except MainThreadBusy as error:
            failure = ProgramFailure(f"the program could not be run: {error}")
        except Exception as error:  # noqa: BLE001 - the border of both handlers
            failure = ProgramFailure(
                f"internal error while running the program: {type(error).__name__}: {error}"
            )
        if failure is not None:
            self._pending[scene.name] = _Pending(frame, failure)

    def take_pending(self, scene: bpy.types.Scene | None) -> ProgramFailure | None:
        name = scene.name if scene is not None else next(iter(self._pending), "")
        pending = self._pending.pop(name, None)
        return None if pending is None else pending.failure

    def drop_pending(self, scene: bpy.types.Scene) -> None:
        """Forget a failure of an earlier render."""
        self._pending.pop(scene.name, None)


programs = ProgramTable()


def run_program(scene: bpy.types.Scene, frame: int) -> ProgramOutcome | None:
    """Bring `scene` to the `frame`-th Render() (1 is the first) of its program; None when it has none.

    Call it on the main thread. What is wrong with the program or its scene is in the outcome, not raised.
    """
    return programs.run(scene, frame)


def read_program(scene: bpy.types.Scene) -> lang.Program | None:
    """Compile the scene's program and offer its parameters, without running it; None when it has none.

    Raises ProgramError.
    """
    text = program_of(scene)
    return None if text is None else programs.runner_of(scene).compile(scene, text)


def take_pending_error(scene: bpy.types.Scene | None = None) -> ProgramFailure | None:
    """What a handler could not say, once; without a scene, that of any."""
    return programs.take_pending(scene)


def last_failure(scene: bpy.types.Scene) -> str:
    """Why the last run of the scene's program built nothing; empty when it did, or never ran."""
    return programs.last_failures.get(scene.name, "") if program_of(scene) is not None else ""


def program_log(scene: bpy.types.Scene) -> list[str]:
    """What the scene's program printed and was warned about, oldest line first; the list itself."""
    return programs.runner_of(scene).log


def last_diagnostics(scene: bpy.types.Scene) -> tuple[lang.Diagnostic, ...]:
    """The errors for which the scene's program gave no frame when it ran last."""
    failure = programs.runner_of(scene).last_failure
    return () if failure is None else failure.diagnostics


def files_read(scene: bpy.types.Scene) -> dict[str, Path | None]:
    """Models and images that the scene's program asked for, by the name it wrote; None: not found."""
    return programs.runner_of(scene).files_read


def program_of(scene: bpy.types.Scene) -> bpy.types.Text | None:
    """The text that builds the scene."""
    return getattr(getattr(scene, "trg", None), "program", None)


def frame_of(scene: bpy.types.Scene) -> int:
    """The program's frame for the current one of the timeline; what lies before the start is frame 1."""
    return max(scene.frame_current - scene.frame_start + 1, 1)


def _settle_view_layers() -> None:
    """Evaluate what windows show now, on this thread, so that none does it while the render goes on."""
    manager = bpy.context.window_manager
    for window in manager.windows if manager is not None else ():
        window.view_layer.update()


@persistent
def _on_render_init(scene: bpy.types.Scene, *_: object) -> None:
    programs.drop_pending(scene)
    programs.run_in_handler(scene)


@persistent
def _on_render_pre(scene: bpy.types.Scene, *_: object) -> None:
    programs.run_in_handler(scene)


@persistent
def _on_load(*_: object) -> None:
    programs.forget_all()


def _handlers() -> tuple[tuple[list, Callable[..., None]], ...]:
    lists = bpy.app.handlers
    return (
        (lists.render_init, _on_render_init),
        (lists.render_pre, _on_render_pre),
        (lists.load_pre, _on_load),
    )


def register() -> None:
    programs.main_thread.start()
    for handlers, function in _handlers():
        handlers.append(function)


def unregister() -> None:
    for handlers, function in _handlers():
        if function in handlers:
            handlers.remove(function)
    programs.main_thread.stop()
    programs.forget_all()
