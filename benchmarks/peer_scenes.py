"""The engine-neutral scenes of ../shared/peers as Blender files, for benchmarks/peers.py."""

from __future__ import annotations

import importlib.util
import os
import sys
from pathlib import Path
from typing import Any

import bpy
import mathutils
import numpy as np

SHARED = Path(os.environ.get("TRG_SHARED", Path(__file__).resolve().parents[2] / "shared"))
NAMES = ("cornell", "outdoor", "instances")


def describe(name: str) -> dict[str, Any]:
    """The description that ../shared/peers/scenes.py gives. Raises FileNotFoundError without it."""
    path = SHARED / "peers" / "scenes.py"
    if not path.is_file():
        raise FileNotFoundError(f"{path} is not there: the scenes of the comparison lie in ../shared")
    spec = importlib.util.spec_from_file_location("peer_scene_descriptions", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return dict(module.make(name))


def build(described: dict[str, Any], side: int) -> bpy.types.Scene:
    """An empty file with the scene in it, a square picture of `side` pixels."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    materials = {name: make_material(name, one) for name, one in described["materials"].items()}
    meshes: dict[tuple[str, str], Any] = {}
    for number, (mesh, material, matrix) in enumerate(described["objects"]):
        if (mesh, material) not in meshes:
            meshes[mesh, material] = make_mesh(mesh, described["meshes"][mesh], materials[material])
        placed = bpy.data.objects.new(f"object {number}", meshes[mesh, material])
        if matrix is not None:
            placed.matrix_world = mathutils.Matrix(np.asarray(matrix).tolist())
        scene.collection.objects.link(placed)
    for direction, irradiance in described["suns"]:
        add_sun(scene, direction, np.asarray(irradiance, dtype=float))
    set_world(scene, described["env"] or (0.0, 0.0, 0.0))
    set_camera(scene, described["camera"])
    scene.render.resolution_x = scene.render.resolution_y = side
    scene.render.resolution_percentage = 100
    return scene


def make_material(name: str, one: dict[str, Any]) -> Any:
    material = bpy.data.materials.new(name)
    if not material.node_tree:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    kinds = {
        "diffuse": "ShaderNodeBsdfDiffuse",
        "ggx": "ShaderNodeBsdfAnisotropic",
        "glass": "ShaderNodeBsdfGlass",
        "emit": "ShaderNodeEmission",
    }
    shader = tree.nodes.new(kinds[one["type"]])
    if one["type"] in ("ggx", "glass"):
        shader.distribution = "GGX"
    if one["type"] == "emit":
        radiance = np.asarray(one["radiance"], dtype=float)
        shader.inputs["Color"].default_value = (*(radiance / radiance.max()), 1.0)
        shader.inputs["Strength"].default_value = radiance.max()
    else:
        shader.inputs["Color"].default_value = (*one.get("color", (1.0, 1.0, 1.0)), 1.0)
        shader.inputs["Roughness"].default_value = one.get("alpha", 0.0) ** 0.5
    if one["type"] == "glass":
        shader.inputs["IOR"].default_value = one["ior"]
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material


def make_mesh(name: str, arrays: Any, material: Any) -> Any:
    vertices, triangles = arrays
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", vertices.ravel())
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.shade_flat()
    mesh.materials.append(material)
    return mesh


def add_sun(scene: Any, direction: Any, irradiance: Any) -> None:
    light = bpy.data.lights.new("sun", "SUN")
    light.angle, light.energy = 0.0, float(irradiance.max())
    light.color = tuple(irradiance / irradiance.max())
    placed = bpy.data.objects.new("sun", light)
    placed.rotation_euler = mathutils.Vector(direction).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(placed)


def set_world(scene: Any, color: Any) -> None:
    world = bpy.data.worlds.new("world")
    if not world.node_tree:
        world.use_nodes = True
    background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (*color, 1.0)
    background.inputs["Strength"].default_value = 1.0
    scene.world = world


def set_camera(scene: Any, described: dict[str, Any]) -> None:
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "HORIZONTAL", np.radians(described["fov"])
    placed = bpy.data.objects.new("camera", camera)
    eye = mathutils.Vector(described["eye"])
    placed.location = eye
    placed.rotation_euler = (mathutils.Vector(described["target"]) - eye).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(placed)
    scene.camera = placed
