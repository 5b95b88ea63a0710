"""Runs in Blender with its window: a rendered viewport is used as a user would; what happened goes to JSON.

Arguments after `--`: OUT.json. Pictures of the window lie beside it.
"""

import json
import os
import subprocess
import sys
import threading
import time
import traceback

import bpy
from mathutils import Euler

(OUT,) = sys.argv[sys.argv.index("--") + 1 :]
TICK_S = 0.02
GIVE_UP_S = 100.0
CHANGES = 200
FAULTY = "a = 1;\nScene = scene(;\n"

seen = {"timed_out": [], "draws": 0}


def tracers():
    """Those of the viewports that render."""
    (module,) = [each for name, each in sys.modules.items() if name.endswith("trg_blender.engine.viewport")]
    return [tracer for tracer in module.open_tracers if not tracer._closing]


def viewport():
    """The first 3D view as (window, area, space)."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return window, area, area.spaces.active


def shot(name):
    subprocess.run(["import", "-window", "root", OUT.replace(".json", f".{name}.png")], check=False)


def changes():
    return {id(each): each.changes for each in tracers()}


def wait(name, since=None, samples=2):
    """Steps of waiting until every viewport shows what it was told after `since`, with so many samples."""
    start = time.monotonic()
    first = None
    while time.monotonic() - start < GIVE_UP_S:
        newer = [each for each in tracers() if is_newer(each, since or {})]
        if newer and first is None:
            first = time.monotonic() - start
        done = [each for each in newer if each.picture().scale == 1 and each.picture().samples >= samples]
        if done and len(done) == len(tracers()):
            seen[name] = {"first_s": first, "status": newer[0].status(), "mean": mean_of(newer[0])}
            return
        yield TICK_S
    seen["timed_out"].append(name)


def is_newer(tracer, since):
    picture = tracer.picture()
    return picture is not None and picture.change == tracer.changes > since.get(id(tracer), 0)


def mean_of(tracer):
    return [float(part) for part in tracer.picture().pixels.mean(axis=(0, 1))]


def changed(name, change, samples=2):
    """Does `change` and waits until its picture is there."""
    before = changes()
    change()
    viewport()[1].tag_redraw()
    yield from wait(name, before, samples)
    yield 0.2  # drawn by then
    shot(name)


def memory():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def turn(angle=0.05):
    space = viewport()[2]
    rotation = space.region_3d.view_rotation.copy()
    rotation.rotate(Euler((0.0, 0.0, angle)))
    space.region_3d.view_rotation = rotation
    viewport()[1].tag_redraw()


def set_view(kind):
    viewport()[2].region_3d.view_perspective = kind


def set_border():
    render = bpy.context.scene.render
    render.use_border = True
    render.border_min_x, render.border_max_x = 0.25, 0.75
    render.border_min_y, render.border_max_y = 0.25, 0.75


def set_transparent():
    bpy.context.scene.render.use_border = False
    bpy.context.scene.render.film_transparent = True


def redden():
    shader = bpy.data.materials["Material"].node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (1.0, 0.02, 0.02, 1.0)


def move():
    bpy.data.objects["Cube"].location.x = 1.0


def steps():
    scene = bpy.context.scene
    scene.render.engine = "TRG"
    scene.trg.preview_samples = 8
    scene.render.film_transparent = False
    yield from changed("rendered", lambda: setattr(viewport()[2].shading, "type", "RENDERED"), samples=8)
    yield from changed("moved", move)
    before = tracers()[0].picture().number
    for _ in range(20):
        turn()
        yield 0.05
    yield from wait("orbited", {key: number - 1 for key, number in changes().items()})
    seen["pictures_while_orbiting"] = tracers()[0].picture().number - before
    yield from changed("red", redden)
    yield from program_steps(scene)
    yield from changed("orthographic", lambda: set_view("ORTHO"))
    yield from changed("camera", lambda: set_view("CAMERA"))
    yield from changed("border", set_border)
    seen["border"]["place"] = list(tracers()[0].picture().place)
    yield from changed("transparent", set_transparent)
    set_view("PERSP")
    yield from memory_steps()
    yield from second_viewport()
    yield from changed("emptied", lambda: bpy.data.batch_remove(list(bpy.data.objects)))
    for area in viewport()[0].screen.areas:
        if area.type == "VIEW_3D":
            area.spaces.active.shading.type = "SOLID"
    yield 1.0
    seen["threads_left"] = [each.name for each in threading.enumerate() if each.name.startswith("TRG")]


def program_steps(scene):
    """A program with a mistake, then its text deleted: the picture stays."""
    scene.trg.program = bpy.data.texts.new("scene.trg")
    scene.trg.program.write(FAULTY)
    picture = mean_of(tracers()[0])
    try:
        bpy.ops.trg.build()
    except RuntimeError as error:
        seen["build_error"] = str(error)
    viewport()[1].tag_redraw()
    yield 0.5
    seen["picture_stays"] = abs(mean_of(tracers()[0])[0] - picture[0]) < 0.01
    seen["faulty_status"] = viewport_status(scene)
    shot("faulty")
    bpy.data.texts.remove(scene.trg.program)
    yield from changed("text_deleted", move_back)


def viewport_status(scene):
    """What the viewport's line says, as its engine puts it together."""
    (module,) = [each for name, each in sys.modules.items() if name.endswith("trg_blender.engine.viewport")]
    return module.status_of(tracers()[0], scene)


def move_back():
    bpy.data.objects["Cube"].location.x = 0.0


def memory_steps():
    """Memory over the second and over the last fifth of the changes: the middle of each, as it swings."""
    readings = []
    for number in range(CHANGES):
        bpy.data.objects["Cube"].location.y = 0.01 * number
        turn(0.01)
        yield 0.01
        readings.append(memory())
    fifth = CHANGES // 5
    seen["memory_early_mb"] = sorted(readings[fifth : 2 * fifth])[fifth // 2]
    seen["memory_late_mb"] = sorted(readings[-fifth:])[fifth // 2]


def second_viewport():
    """The same scene in the place of the timeline, too."""
    window = viewport()[0]
    area = next(each for each in window.screen.areas if each.type == "DOPESHEET_EDITOR")
    area.type = "VIEW_3D"
    area.spaces.active.shading.type = "RENDERED"
    yield 0.5
    yield from changed("two_viewports", move)
    seen["viewports"] = len(tracers())


def count_draw():
    seen["draws"] += 1


def run(walk):
    def tick():
        try:
            return next(walk)
        except StopIteration:
            finish()
            return None
        except Exception:
            traceback.print_exc()
            sys.stdout.flush()
            os._exit(8)

    bpy.app.timers.register(tick, first_interval=2.0)


def finish():
    with open(OUT, "w", encoding="utf-8") as file:
        json.dump(seen, file)
    bpy.ops.wm.quit_blender()


bpy.types.SpaceView3D.draw_handler_add(count_draw, (), "WINDOW", "POST_PIXEL")
bpy.context.preferences.view.show_splash = False
run(steps())
