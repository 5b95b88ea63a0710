"""Runs in Blender: saves the default scene, with or without a TRG program, ready to be rendered by TRG.

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
scene.frame_end = 10
scene.render.filepath = "//frame_"
bpy.ops.wm.save_as_mainfile(filepath=out)
