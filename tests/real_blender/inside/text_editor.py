"""Runs in Blender with its window: works on a program in the text editor by real keys, as a user would.

Arguments after `--`: PICTURES OUT.json, a folder for screenshots and the file for the facts.
"""

import json
import os
import subprocess
import sys
import traceback

import bpy

PICTURES, OUT = sys.argv[sys.argv.index("--") + 1 :]
PROGRAM = """include("stl/rt/trg_raytrace.trg");
Scene = scene();
export count = 7 ~ "num" ~ range(1, 40);
/* a ring
   of balls */
for (i = 0; i < count; i++)
    Scene.Add(shpere(vec3(mth::cos(i) * 3, 1, mth::sin(i) * 3), 0.5, material::gold()));
Scene.CamSet(640, 360, vec3(0, 4, 9), vec3(0, 1, 0), vec3(0, 1, 0)); // above
print("balls", count);
Scene.Render();
"""
STEP_S = 1.5
facts = {}


def editor():
    """(window, area, region, space) of the text editor; the largest area becomes it."""
    window = bpy.context.window_manager.windows[0]
    area = max(window.screen.areas, key=lambda each: each.width * each.height)
    if area.type != "TEXT_EDITOR":
        area.type = "TEXT_EDITOR"
    return window, area, next(each for each in area.regions if each.type == "WINDOW"), area.spaces.active


def xdotool(*arguments):
    return subprocess.run(["xdotool", *arguments], check=True, capture_output=True, text=True).stdout


def picture(name):
    subprocess.run(["import", "-window", "root", os.path.join(PICTURES, f"{name}.png")], check=True)


def documents():
    return next(m for n, m in sys.modules.items() if n.endswith("ui.text_editor.documents")).documents


def program():
    return bpy.data.texts["ring.trg"]


def findings():
    analysis = documents().known["ring.trg"].analysis
    return [[d.severity, d.span.line, d.span.col] for d in analysis.diagnostics]


def open_text():
    _, _, region, space = editor()
    text = bpy.data.texts.new("ring.trg")
    text.from_string(PROGRAM)
    text.cursor_set(0)
    space.text, space.top = text, 0
    space.show_region_ui = space.show_syntax_highlight = True
    bpy.context.scene.render.engine = "TRG"
    xdotool("windowfocus", xdotool("search", "--onlyvisible", "--class", "blender").split()[0])
    xdotool("mousemove", str(region.x + region.width // 2), str(900 - region.y - region.height // 2))


def show_sidebar():
    _, area, _, _ = editor()
    next(each for each in area.regions if each.type == "UI").active_panel_category = "TRG"


def see_mistake():
    facts["before"] = findings()
    picture("text_editor_mistake")


def run_wrong():
    """Called, not typed: the message that a key would bring takes the keys after it."""
    window, area, region, _ = editor()
    with bpy.context.temp_override(window=window, area=area, region=region):
        try:
            bpy.ops.trg.text_run()
        except RuntimeError as error:
            facts["error"] = str(error)


def note_wrong():
    facts["cursor_after_wrong_run"] = [program().current_line_index, program().current_character]
    facts["objects_after_wrong_run"] = len(bpy.data.collections)


def fix():
    window, area, region, _ = editor()
    with bpy.context.temp_override(window=window, area=area, region=region):
        facts["fix"] = list(bpy.ops.trg.text_fix(index=0))


def run_right():
    facts["after"] = findings()
    xdotool("key", "alt+p")


def note_right():
    scene = bpy.context.scene
    facts["program"] = scene.trg.program.name if scene.trg.program else ""
    facts["meshes"] = sum(each.type == "MESH" and each.name != "Cube" for each in scene.objects)
    facts["parameters"] = list(scene.trg.parameters.keys())
    picture("text_editor")


def comment():
    program().cursor_set(1)
    xdotool("key", "ctrl+slash")


def note_comment():
    facts["commented"] = program().lines[1].body
    xdotool("key", "ctrl+z")


def complete():
    facts["after_undo"] = program().lines[1].body
    program().cursor_set(8, character=3)
    xdotool("key", "ctrl+space")


def note_completion():
    picture("text_editor_completion")
    xdotool("key", "Escape")


def leave():
    with open(OUT, "w", encoding="utf-8") as file:
        json.dump(facts, file)
    bpy.ops.wm.quit_blender()


STEPS = [
    open_text, show_sidebar, lambda: None, see_mistake, run_wrong, note_wrong, fix, lambda: None, run_right,
    lambda: None, note_right, comment, note_comment, complete, note_completion, leave,
]  # fmt: skip


def run_next():
    try:
        STEPS.pop(0)()
    except Exception:
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(8)
    return STEP_S if STEPS else None


bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(run_next, first_interval=2.0)
