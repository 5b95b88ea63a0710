"""Arrays of the example programs, by the way that a render takes: program -> Blender -> arrays. Needs bpy."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import bpy

from trg_blender.engine.scene_arrays import SceneArrays

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def example_names() -> list[str]:
    return sorted(path.stem for path in EXAMPLES.glob("*.trg"))


@contextmanager
def registered() -> Iterator[None]:
    """The extension's properties in Blender, for the time of the block."""
    extension = importlib.import_module("trg_blender.ui.registration")
    known = hasattr(bpy.types.Scene, "trg")
    if not known:
        extension.register()
    try:
        yield
    finally:
        if not known:
            extension.unregister()


def read_example(name: str, size: tuple[int, int]) -> SceneArrays:
    """Frame 1 of an example for a picture of `size` pixels, inside `registered()`."""
    from trg_blender.engine.from_blender import SceneReader
    from trg_blender.engine.run_text import run_program

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.trg.program = bpy.data.texts.load(str(EXAMPLES / f"{name}.trg"))
    outcome = run_program(scene, 1)
    assert outcome is not None
    assert outcome.failure is None, outcome.failure
    scene["trg_keep_size"] = True
    scene.render.resolution_x, scene.render.resolution_y = size
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return SceneReader().read(depsgraph.scene_eval, depsgraph, size)
