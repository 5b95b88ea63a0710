"""Runs in Blender: saves a scene that TRG renders: that of a program, or Blender's default cube.

Arguments after `--`: OUT.blend PROGRAM.trg|- SAMPLES PERCENT
"""

import sys

import bpy

out, program, samples, percent = sys.argv[sys.argv.index("--") + 1 :]
scene = bpy.context.scene
scene.render.engine = "TRG"
scene.render.resolution_percentage = int(percent)
scene.trg.samples = int(samples)
if program != "-":
    scene.trg.program = bpy.data.texts.load(program)
    # Blender's F12 wants a camera before any handler runs; the program's takes its place.
    bpy.data.batch_remove([thing for thing in bpy.data.objects if thing.type != "CAMERA"])
scene.frame_end = 10
scene.render.filepath = "//frame_"
bpy.ops.wm.save_as_mainfile(filepath=out)
