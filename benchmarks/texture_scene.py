"""A plane of small squares, each with one texture coordinate, that glows with what a node graph gives."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import numpy as np

SIDE = 96
"""squares, and pixels, along each side: jitter within a pixel changes nothing"""
Build = Callable[[bpy.types.NodeTree, bpy.types.NodeSocket], bpy.types.NodeSocket]
"""nodes, the socket of the coordinates -> the socket to show"""


def build_stage(span: float = 1.0, start: float = 0.0) -> bpy.types.Material:
    """An empty file with the plane before an orthographic camera; coordinates run from `start` over
    `span`."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    step = np.arange(SIDE)
    x, y = (axis.ravel() for axis in np.meshgrid(step, step))
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    places = (np.stack([x, y], axis=1)[:, None, :] + corners) / SIDE - 0.5
    vertices = np.concatenate([places, np.zeros((*places.shape[:2], 1))], axis=2).reshape(-1, 3)
    faces = np.arange(4 * SIDE * SIDE).reshape(-1, 4)
    mesh = bpy.data.meshes.new("squares")
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    uv = (np.stack([x, y], axis=1) + 0.5) / SIDE * span + start
    mesh.uv_layers.new(name="UVMap").uv.foreach_set("vector", np.repeat(uv, 4, axis=0).ravel())
    plane = bpy.data.objects.new("plane", mesh)
    material = bpy.data.materials.new("stuff")
    material.use_nodes = True
    mesh.materials.append(material)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", 1.0, (0.0, 0.0, 2.0)
    for each in (plane, camera):
        bpy.context.scene.collection.objects.link(each)
    scene = bpy.context.scene
    scene.camera = camera
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    scene.render.resolution_percentage = 100
    return material


def show(material: bpy.types.Material, build: Build) -> None:
    """Makes the plane glow with what `build` gives at the texture coordinates."""
    tree = material.node_tree
    tree.nodes.clear()
    coordinates = tree.nodes.new("ShaderNodeTexCoord")
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(build(tree, coordinates.outputs["UV"]), emission.inputs["Color"])
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
