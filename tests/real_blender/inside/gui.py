"""Runs in Blender with its window: does one thing as a user would, and writes what happened as JSON.

Arguments after `--`: MODE OUT.json, where MODE is one of
    still       press F12 and wait for the end of the render
    animation   render the animation while the viewport is turned all the time
    cancel      press F12, then Esc once the picture is being traced
"""

import json
import subprocess
import sys
import time

import bpy
from mathutils import Euler

MODE, OUT = sys.argv[sys.argv.index("--") + 1 :]
# A key code: by its name xdotool finds F12 on a level of the key that wants Alt held.
F12, ESCAPE = "96", "Escape"
TICK_S = 0.05
ESCAPE_AFTER_S = 3.0
GIVE_UP_S = 120.0

seen = {"mode": MODE, "frames": 0, "completed": False, "cancelled": False, "draws": 0, "timed_out": False}
clock = {"start": 0.0, "escape": 0.0}


def note(**facts):
    """Keeps facts; called from Blender's render thread too, where nothing else may be touched."""
    seen.update(facts)


def note_cancel(*_):
    note(cancelled=True, seconds_after_escape=time.monotonic() - clock["escape"])


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
    """Gives the window the keyboard, which no window manager does here, and puts the mouse over the 3D view."""
    window = xdotool("search", "--onlyvisible", "--class", "blender").split()[0]
    xdotool("windowfocus", window)
    xdotool("mousemove", "500", "450")
    bpy.app.timers.register(begin, first_interval=1.0)


def begin():
    window, area, region, _ = viewport()
    clock["start"] = time.monotonic()
    if MODE == "animation":
        with bpy.context.temp_override(window=window, area=area, region=region):
            bpy.ops.render.render("INVOKE_DEFAULT", animation=True)
    else:
        xdotool("key", F12)
    bpy.app.timers.register(watch, first_interval=TICK_S)


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
    bpy.app.timers.register(finish, first_interval=1.0)
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
bpy.app.timers.register(point_at_viewport, first_interval=2.0)
