"""Runs in Blender with its window: does one thing as a user would, and writes what happened as JSON.

Arguments after `--`: MODE OUT.json, where MODE is one of
    still       press F12 and wait for the end of the render
    animation   render the animation while the viewport is turned all the time
    cancel      press F12, then Esc once the picture is being traced
"""

import json
import os
import subprocess
import sys
import time
import traceback

import bpy
from mathutils import Euler

MODE, OUT = sys.argv[sys.argv.index("--") + 1 :]
# A key code: by its name xdotool finds F12 on a level of the key that wants Alt held.
F12, ESCAPE = "96", "Escape"
TICK_S = 0.05
ESCAPE_AFTER_S = 3.0
GIVE_UP_S = 120.0

seen = {"mode": MODE, "frames": 0, "completed": False, "cancelled": False, "draws": 0, "timed_out": False}
clock = {"start": 0.0, "escape": 0.0, "break": 0.0}


def note(**facts):
    """Keeps facts; called from Blender's render thread too, where nothing else may be touched."""
    seen.update(facts)


def note_cancel(*_):
    now = time.monotonic()
    note(cancelled=True, escape_to_end_s=now - clock["escape"], break_to_end_s=now - clock["break"])


def watch_break():
    """Notes when the engine reacts to Esc; before that it is Blender's time, its window drawn in software."""
    session = next(
        module for name, module in sys.modules.items() if name.endswith("trg_blender.engine.session")
    )
    cancel = session.RenderJob.cancel

    def noted_cancel(job):
        clock["break"] = clock["break"] or time.monotonic()
        cancel(job)

    session.RenderJob.cancel = noted_cancel


def later(step, seconds):
    """Runs `step` by a timer; a step that fails ends Blender, which would wait for ever else."""

    def run():
        try:
            return step()
        except Exception:
            traceback.print_exc()
            sys.stdout.flush()
            os._exit(8)

    bpy.app.timers.register(run, first_interval=seconds)


def count_frame(*_):
    seen["frames"] += 1


def count_draw():
    if clock["start"]:
        seen["draws"] += 1


def viewport():
    """The first 3D view as (window, area, region, space)."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return window, area, region, area.spaces.active


def xdotool(*arguments):
    """Real input: X server, window events and keymap take part."""
    return subprocess.run(["xdotool", *arguments], check=True, capture_output=True, text=True).stdout


def point_at_viewport():
    """Gives the window the keyboard, as no window manager does it, and puts the mouse over the 3D view."""
    window = xdotool("search", "--onlyvisible", "--class", "blender").split()[0]
    xdotool("windowfocus", window)
    xdotool("mousemove", "500", "450")
    later(begin, 1.0)


def begin():
    window, area, region, _ = viewport()
    clock["start"] = time.monotonic()
    if MODE == "cancel":
        watch_break()
    if MODE == "animation":
        with bpy.context.temp_override(window=window, area=area, region=region):
            bpy.ops.render.render("INVOKE_DEFAULT", animation=True)
    else:
        xdotool("key", F12)
    later(watch, TICK_S)


def turn_viewport():
    _, area, _, space = viewport()
    rotation = space.region_3d.view_rotation.copy()
    rotation.rotate(Euler((0.0, 0.0, 0.05)))
    space.region_3d.view_rotation = rotation
    area.tag_redraw()


def watch():
    passed = time.monotonic() - clock["start"]
    if MODE == "animation":
        turn_viewport()
    if MODE == "cancel" and not clock["escape"] and passed > ESCAPE_AFTER_S:
        note(running_before_escape=bpy.app.is_job_running("RENDER"))
        clock["escape"] = time.monotonic()
        xdotool("key", ESCAPE)
    over = (seen["completed"] or seen["cancelled"]) and not bpy.app.is_job_running("RENDER")
    if not over and passed < GIVE_UP_S:
        return TICK_S
    note(timed_out=not over, seconds=passed)
    later(finish, 1.0)
    return None


def finish():
    """Saves picture and facts, then leaves as File > Quit does."""
    if MODE == "still":
        bpy.data.images["Render Result"].save_render(OUT.replace(".json", ".png"))
    subprocess.run(["import", "-window", "root", OUT.replace(".json", ".window.png")], check=False)
    with open(OUT, "w", encoding="utf-8") as file:
        json.dump(seen, file)
    bpy.ops.wm.quit_blender()


bpy.app.handlers.render_post.append(count_frame)
bpy.app.handlers.render_complete.append(lambda *_: note(completed=True))
bpy.app.handlers.render_cancel.append(note_cancel)
bpy.types.SpaceView3D.draw_handler_add(count_draw, (), "WINDOW", "POST_PIXEL")
bpy.context.preferences.view.show_splash = False
bpy.context.preferences.view.render_display_type = "WINDOW" if MODE == "still" else "NONE"
later(point_at_viewport, 2.0)
