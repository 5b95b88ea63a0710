"""Runs in Blender with its window: renders two slots, looks behind a pixel, compares, and notes what came.

Arguments after `--`: PICTURES OUT.json, a folder for screenshots and the file for the facts.
"""

import json
import os
import subprocess
import sys
import traceback

import bpy

PICTURES, OUT = sys.argv[sys.argv.index("--") + 1 :]
STEP_S = 1.5
facts = {}


def module(ending):
    return next(m for name, m in sys.modules.items() if name.endswith(ending))


def xdotool(*arguments):
    return subprocess.run(["xdotool", *arguments], check=True, capture_output=True, text=True).stdout


def editor():
    window = bpy.context.window_manager.windows[0]
    area = max(window.screen.areas, key=lambda each: each.width * each.height)
    if area.type != "IMAGE_EDITOR":
        area.type = "IMAGE_EDITOR"
    return window, area, next(each for each in area.regions if each.type == "WINDOW"), area.spaces.active


def call(function, **arguments):
    window, area, region, _ = editor()
    with bpy.context.temp_override(window=window, area=area, region=region):
        return list(function(**arguments))


def prepare():
    scene = bpy.context.scene
    scene.render.engine = "TRG"
    scene.render.resolution_x, scene.render.resolution_y, scene.trg.samples = 160, 90, 16
    bpy.context.preferences.view.render_display_type = "NONE"
    xdotool("windowfocus", xdotool("search", "--onlyvisible", "--class", "blender").split()[0])


def render_first():
    bpy.ops.render.render("INVOKE_DEFAULT")


def render_second():
    bpy.data.images["Render Result"].render_slots.active_index = 1
    bpy.context.scene.trg.seed = 5
    bpy.ops.render.render("INVOKE_DEFAULT")


def show():
    _, area, _, space = editor()
    space.image = bpy.data.images["Render Result"]
    space.show_region_ui = True


def show_sidebar():
    _, area, region, _ = editor()
    next(each for each in area.regions if each.type == "UI").active_panel_category = "TRG"
    call(bpy.ops.image.view_all)


def begin_inspect():
    window, area, region, _ = editor()
    xdotool("mousemove", str(region.x + 40), str(900 - region.y - 40))
    with bpy.context.temp_override(window=window, area=area, region=region):
        facts["inspect"] = list(bpy.ops.trg.inspect("INVOKE_DEFAULT"))


def move_mouse():
    _, _, region, _ = editor()
    x, y = region.view2d.view_to_region(0.5, 0.5, clip=False)
    xdotool("mousemove", str(region.x + x), str(900 - region.y - y))


def note_inspected():
    looked = module("ui.image_editor.inspect").looked
    facts["pixel"] = [looked.facts.x, looked.facts.y] if looked.facts else None
    facts["names"] = [looked.object, looked.material]
    facts["standard_error"] = looked.facts.standard_error if looked.facts else None
    subprocess.run(["import", "-window", "root", os.path.join(PICTURES, "image_editor.png")], check=True)
    xdotool("key", "Escape")


def compare():
    facts["slots"] = module("engine.shots").shots.filled_slots()
    facts["compare"] = call(bpy.ops.trg.compare)
    own = bpy.context.window_manager.trg_compare
    facts["rmse"], facts["flip"] = own.rmse, own.flip


def note_compared():
    facts["shown"] = editor()[3].image.name
    subprocess.run(
        ["import", "-window", "root", os.path.join(PICTURES, "image_editor_compare.png")], check=True
    )


def leave():
    with open(OUT, "w", encoding="utf-8") as file:
        json.dump(facts, file)
    bpy.ops.wm.quit_blender()


STEPS = [
    prepare, render_first, render_second, show, show_sidebar, begin_inspect, move_mouse, note_inspected,
    compare, note_compared, leave,
]  # fmt: skip


def run_next():
    if bpy.app.is_job_running("RENDER"):
        return STEP_S
    try:
        STEPS.pop(0)()
    except Exception:
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(8)
    return STEP_S if STEPS else None


bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(run_next, first_interval=2.0)
