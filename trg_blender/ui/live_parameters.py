"""Moving a parameter's slider runs the scene's program again, when the slider has come to rest.

Custom properties have no update callback of their own; Blender tags their scene for the depsgraph when
one is changed in the interface. The handler compares the values with those seen last and lets a timer
run the program; a slider that still moves puts the run off. Renders and playback are left alone: they
take the values themselves.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import bpy
from bpy.app.handlers import persistent

from ..engine import run_text

REST_SECONDS = 0.15
"""How long a slider rests before the program runs."""

Values = dict[str, Any]


@dataclass(slots=True)
class LiveParameters:
    """Values of all scenes as they were seen last, by the scene's name, and what failed since."""

    seen: dict[str, Values] = field(default_factory=dict)
    waiting: dict[str, Values] = field(default_factory=dict)
    """scenes whose program is to run, with the values that it waits with"""
    failures: dict[str, str] = field(default_factory=dict)

    def look(self, scene: bpy.types.Scene) -> bool:
        """Note the scene's values; True when one differs from what was seen and a run is due."""
        if run_text.program_of(scene) is None:
            self.seen.pop(scene.name, None)
            return False
        values = values_of(scene)
        before = self.seen.setdefault(scene.name, values)
        self.seen[scene.name] = values
        if before.keys() != values.keys():  # another program, or another text of it
            return False
        if values != before:
            self.waiting[scene.name] = values
        return scene.name in self.waiting

    def settle(self) -> bool:
        """Run the programs whose values rest; True when some still move."""
        for name in tuple(self.waiting):
            scene = bpy.data.scenes.get(name)
            if scene is None or run_text.program_of(scene) is None:
                del self.waiting[name]
                continue
            values = values_of(scene)
            if values != self.waiting[name]:
                self.waiting[name] = values
                continue
            del self.waiting[name]
            self._run(scene)
        return bool(self.waiting)

    def _run(self, scene: bpy.types.Scene) -> None:
        outcome = run_text.run_program(scene, run_text.frame_of(scene))
        self.seen[scene.name] = values_of(scene)
        self.failures.pop(scene.name, None)
        if outcome is not None and outcome.failure is not None:
            self.failures[scene.name] = outcome.failure.text

    def forget_all(self) -> None:
        self.seen.clear()
        self.waiting.clear()
        self.failures.clear()


live = LiveParameters()


def values_of(scene: bpy.types.Scene) -> Values:
    """The properties as plain values that can be compared."""
    stored = scene.trg.parameters
    return {name: _plain(stored[name]) for name in stored.keys()}  # noqa: SIM118 (not a dict)


def failure_of(scene: bpy.types.Scene) -> str:
    """Why the last run for a slider gave no new scene; empty when it did."""
    return live.failures.get(scene.name, "")


def _plain(value: Any) -> Any:
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value


def _is_busy() -> bool:
    """Whether a render or playback is going on."""
    manager = bpy.context.window_manager
    playing = any(w.screen.is_animation_playing for w in (manager.windows if manager else ()))
    return playing or bpy.app.is_job_running("RENDER")


def run_when_settled() -> float | None:
    """The timer: seconds to its next call, None when nothing waits."""
    if _is_busy():
        return REST_SECONDS
    return REST_SECONDS if live.settle() else None


@persistent
def _on_update(scene: bpy.types.Scene, *_: object) -> None:
    if live.look(scene) and not bpy.app.timers.is_registered(run_when_settled):
        bpy.app.timers.register(run_when_settled, first_interval=REST_SECONDS)


@persistent
def _on_frame(scene: bpy.types.Scene, *_: object) -> None:
    """Keys move sliders too, without anybody's hand: see the values, run nothing."""
    if run_text.program_of(scene) is not None:
        live.seen[scene.name] = values_of(scene)


@persistent
def _on_load(*_: object) -> None:
    live.forget_all()


def register() -> None:
    bpy.app.handlers.depsgraph_update_post.append(_on_update)
    bpy.app.handlers.frame_change_post.append(_on_frame)
    bpy.app.handlers.load_pre.append(_on_load)


def unregister() -> None:
    handlers = bpy.app.handlers
    handlers.depsgraph_update_post.remove(_on_update)
    handlers.frame_change_post.remove(_on_frame)
    handlers.load_pre.remove(_on_load)
    if bpy.app.timers.is_registered(run_when_settled):
        bpy.app.timers.unregister(run_when_settled)
    live.forget_all()
