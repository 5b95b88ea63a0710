"""How long a rendered viewport takes from a change to its first picture: TRG beside Cycles, in one run.

    tools/real_blender.sh run --gui -- blender --factory-startup --window-geometry 0 0 960 540 \
        --python benchmarks/viewport.py -- OUT.json [CHANGES] [SIDE]

Method. A real Blender with its window (tools/real_blender.sh; the window is drawn in software there, for
both engines alike). A wavy grid of about 100 000 triangles (2 SIDE^2, SIDE is 224) fills the viewport
before a wall of another colour. Three kinds of change flip the colour in the middle of the viewport: the
grid's material, the place of the grid, and the turn of the view. The clock runs from the line that makes the
change to the first draw after which the pixel in the middle has the other colour, so that evaluation, reading
of the scene, tracing, drawing and Blender's own loop count. Engines take turns, CHANGES (20) of each kind,
there and back, in two halves; each waits until the one before has been there for 0.5 s. The first of each
kind after an engine was chosen, which loads code and builds the scene, is not counted.
"""

from __future__ import annotations

import json
import statistics
import sys
import time
from collections.abc import Generator
from pathlib import Path

import bpy
import gpu
import numpy as np
from mathutils import Euler, Quaternion

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "build" / "native"))
from benchmarks.engines import enable_engines  # noqa: E402

ENGINES = ("TRG", "CYCLES")
KINDS = ("material", "move", "view")
REST_S = 0.5
GIVE_UP_S = 20.0
RED, GREEN = (0.8, 0.02, 0.02, 1.0), (0.02, 0.8, 0.02, 1.0)

middle = {"red": 0.0, "green": 0.0, "drawn": 0.0}
"""of the last draw, and when it was"""


def look_at_middle(_mouse: object) -> None:
    """After every draw of the window, for the cursor: the colour in the middle of the viewport."""
    area = viewport()[1]
    x, y = area.x + area.width // 2, area.y + area.height // 2
    pixel = gpu.state.active_framebuffer_get().read_color(x, y, 1, 1, 4, 0, "FLOAT").to_list()[0][0]
    middle.update(red=pixel[0], green=pixel[1], drawn=time.perf_counter())


def add_mesh(name: str, side: int, height: float, material: bpy.types.Material) -> bpy.types.Object:
    """A grid of 2 side^2 triangles across z, 12 m wide, with waves of `height`."""
    steps = np.linspace(-6, 6, side + 1, dtype=np.float32)
    x, y = np.meshgrid(steps, steps)
    vertices = np.stack([x, y, height * np.sin(3 * x) * np.cos(2 * y)], axis=-1).reshape(-1, 3)
    index = np.arange((side + 1) ** 2).reshape(side + 1, side + 1)
    faces = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], -1).reshape(-1, 4)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    mesh.materials.append(material)
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def add_material(name: str, color: tuple[float, ...]) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0):
        material.use_nodes = True
    set_color(material, color)
    return material


def set_color(material: bpy.types.Material, color: tuple[float, ...]) -> None:
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = color


def viewport() -> tuple[bpy.types.Window, bpy.types.Area, bpy.types.SpaceView3D]:
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return window, area, area.spaces.active


class Stage:
    """The scene, and its changes: each has a state that shows red and one that shows green."""

    def __init__(self, side: int) -> None:
        bpy.data.batch_remove(list(bpy.data.objects))
        self.material = add_material("grid", RED)
        self.grid = add_mesh("grid", side, 0.15, self.material)
        wall = add_mesh("wall", 1, 0.0, add_material("wall", GREEN))
        wall.location.z = -3.0
        ceiling = add_mesh("ceiling", 1, 0.0, wall.data.materials[0])
        ceiling.location.z = 40.0
        ceiling.scale = (5.0, 5.0, 5.0)
        light = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
        light.data.energy = 3.0
        other = light.copy()
        other.rotation_euler = Euler((3.14159, 0.0, 0.0))
        for each in (light, other):
            bpy.context.scene.collection.objects.link(each)
        space = viewport()[2]
        space.region_3d.view_perspective = "PERSP"
        space.region_3d.view_location = (0.0, 0.0, 8.0)
        space.region_3d.view_distance = 0.1
        space.region_3d.view_rotation = Quaternion((1.0, 0.0, 0.0, 0.0))
        space.overlay.show_overlays = False
        space.show_gizmo = False

    def change(self, kind: str, to_green: bool) -> None:
        if kind == "material":
            set_color(self.material, GREEN if to_green else RED)
        elif kind == "move":
            self.grid.location.x = 20.0 if to_green else 0.0
        else:
            turned = Euler((3.14159, 0.0, 0.0)).to_quaternion()
            still = Quaternion((1.0, 0.0, 0.0, 0.0))
            viewport()[2].region_3d.view_rotation = turned if to_green else still
            viewport()[1].tag_redraw()


def is_shown(green: bool) -> bool:
    """Whether the last draw had that colour in the middle."""
    low, high = (middle["red"], middle["green"]) if green else (middle["green"], middle["red"])
    return high > 0.02 and high > 2.0 * low


def measure(changes: int, side: int, times: dict[str, list[float]]) -> Generator[float, None, None]:
    """Steps of a timer; fills milliseconds by `ENGINE kind`."""
    window, area, space = viewport()
    with bpy.context.temp_override(window=window, area=area):
        bpy.ops.screen.screen_full_area(use_hide_panels=True)
    yield 1.0
    space = viewport()[2]
    stage = Stage(side)
    scene = bpy.context.scene
    scene.trg.preview_samples = scene.cycles.preview_samples = 256
    scene.cycles.use_preview_denoising = False
    for _ in range(2):
        for engine in ENGINES:
            space.shading.type = "SOLID"
            scene.render.engine = engine
            space.shading.type = "RENDERED"
            yield 2.0
            for number in range(-1, changes):
                for kind in KINDS:
                    for to_green in (True, False):
                        took = yield from time_change(stage, kind, to_green)
                        if number >= 0:
                            times.setdefault(f"{engine} {kind}", []).append(1000.0 * took)
    space.shading.type = "SOLID"
    yield 1.0


def time_change(stage: Stage, kind: str, to_green: bool) -> Generator[float, None, float]:
    """Makes one change, waits for its picture and a while more; seconds until it was drawn."""
    begin = time.perf_counter()
    stage.change(kind, to_green)
    while not is_shown(to_green):
        if time.perf_counter() - begin > GIVE_UP_S:
            break
        yield 0.001
    took = max(middle["drawn"] - begin, 0.0)
    yield REST_S
    return took


def summarise(times: dict[str, list[float]]) -> list[dict[str, object]]:
    """Median and 95th percentile of each."""
    return [
        {
            "what": name,
            "median_ms": round(statistics.median(values), 1),
            "p95_ms": round(float(np.percentile(values, 95)), 1),
            "changes": len(values),
        }
        for name, values in times.items()
    ]


def main() -> None:
    arguments = sys.argv[sys.argv.index("--") + 1 :]
    out = Path(arguments[0])
    changes = int(arguments[1]) if len(arguments) > 1 else 20
    side = int(arguments[2]) if len(arguments) > 2 else 224
    enable_engines()
    bpy.context.preferences.view.show_splash = False
    bpy.types.WindowManager.draw_cursor_add(look_at_middle, (), "VIEW_3D", "WINDOW")
    times: dict[str, list[float]] = {}
    walk = measure(max(changes // 4, 1), side, times)

    def tick() -> float | None:
        try:
            return next(walk)
        except StopIteration:
            region = viewport()[1].regions[-1]
            facts = {"blender": bpy.app.version_string, "region": [region.width, region.height]}
            out.write_text(json.dumps({**facts, "rows": summarise(times)}, indent=1), encoding="utf-8")
            bpy.ops.wm.quit_blender()
            return None

    bpy.app.timers.register(tick, first_interval=2.0)


main()
