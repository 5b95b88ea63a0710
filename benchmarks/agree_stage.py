"""Small Blender scenes for comparing engines: a stage, and the objects, materials and lights put on it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import mathutils
import numpy as np

Build = Callable[["Stage"], None]
SIZE = (160, 64)
"""pixels: ten by four regions of 16 x 16"""


@dataclass(frozen=True, slots=True)
class Stage:
    """A scene being set up; `add_*` put things into it."""

    scene: bpy.types.Scene

    @property
    def collection(self) -> bpy.types.Collection:
        return self.scene.collection

    def add_object(self, name: str, data: Any, location: Sequence[float] = (0.0, 0.0, 0.0)) -> Any:
        placed = bpy.data.objects.new(name, data)
        placed.location = location
        self.collection.objects.link(placed)
        return placed

    def add_mesh(self, mesh: Any, material: Any, location: Sequence[float] = (0.0, 0.0, 0.0)) -> Any:
        mesh.materials.append(material)
        return self.add_object(mesh.name, mesh, location)

    def add_floor(self, material: Any | None = None, z: float = 0.0, size: float = 20.0) -> Any:
        return self.add_mesh(
            quad(size), material or principled(base=(0.5, 0.5, 0.5), specular=0.0), (0, 0, z)
        )

    def add_spheres(self, materials: Sequence[Any], radius: float = 0.48) -> list[Any]:
        """One sphere a material, side by side along x, resting on z = 0."""
        left = -0.5 * (len(materials) - 1)
        return [
            self.add_mesh(sphere(radius), material, (left + k, 0.0, radius))
            for k, material in enumerate(materials)
        ]

    def add_light(self, kind: str, location: Sequence[float], energy: float, **values: Any) -> Any:
        """A light that looks at the origin's neighbourhood (0, 0, 0.4)."""
        light = bpy.data.lights.new(kind.lower(), kind)
        light.energy = energy
        for name, value in values.items():
            setattr(light, name, value)
        placed = self.add_object(light.name, light, location)
        placed.rotation_euler = look(location, (0.0, 0.0, 0.4))
        return placed

    def set_world(self, color: Sequence[float], strength: float = 1.0) -> Any:
        world = bpy.data.worlds.new("world")
        if not world.node_tree:
            world.use_nodes = True
        background = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
        background.inputs["Color"].default_value = (*color, 1.0)
        background.inputs["Strength"].default_value = strength
        self.scene.world = world
        return background

    def set_camera(self, location: Sequence[float] = (0.0, -6.0, 1.6), **values: Any) -> Any:
        camera = bpy.data.cameras.new("camera")
        camera.lens = 42.0
        for name, value in values.items():
            setattr(camera, name, value)
        placed = self.add_object("camera", camera, location)
        placed.rotation_euler = look(location, (0.0, 0.0, 0.45))
        self.scene.camera = placed
        return placed


def look(source: Sequence[float], target: Sequence[float]) -> mathutils.Euler:
    """Rotation that turns -Z from `source` towards `target`, Y up."""
    return (mathutils.Vector(target) - mathutils.Vector(source)).to_track_quat("-Z", "Y").to_euler()


def new_stage() -> Stage:
    """An empty file with a camera and the picture's size."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    stage = Stage(scene)
    stage.set_camera()
    return stage


def lit_stage() -> Stage:
    """With floor, a white sky and one soft area light: light from everywhere and from somewhere."""
    stage = new_stage()
    stage.add_floor()
    stage.set_world((0.4, 0.45, 0.5))
    stage.add_light("AREA", (2.5, -3.0, 4.0), 150.0, size=2.0)
    return stage


def mesh_of(name: str, vertices: Any, faces: Any, uvs: Any = None, smooth: bool = False) -> Any:
    """A mesh; `uvs` holds one (u, v) a corner."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, v)) for v in vertices], [], [tuple(map(int, f)) for f in faces])
    if uvs is not None:
        layer = mesh.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", np.asarray(uvs, dtype=np.float32).ravel())
    if smooth:
        mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.update()
    return mesh


def quad(size: float) -> Any:
    """A square of side `size` in z = 0, facing up, with coordinates 0 to 1."""
    h = 0.5 * size
    corners = [(-h, -h, 0.0), (h, -h, 0.0), (h, h, 0.0), (-h, h, 0.0)]
    return mesh_of("quad", corners, [(0, 1, 2, 3)], [(0, 0), (1, 0), (1, 1), (0, 1)])


def sphere(radius: float, columns: int = 64, rows: int = 32, smooth: bool = True) -> Any:
    """A sphere of quads with triangles at the poles."""
    polar = np.linspace(0.0, math.pi, rows + 1)
    around = np.linspace(0.0, 2.0 * math.pi, columns + 1)
    vertices = [(0.0, 0.0, radius), (0.0, 0.0, -radius)]
    for angle in polar[1:-1]:
        ring = radius * math.sin(angle)
        vertices += [(ring * math.cos(a), ring * math.sin(a), radius * math.cos(angle)) for a in around[:-1]]
    faces: list[tuple[int, ...]] = []
    uvs: list[tuple[float, float]] = []
    for row in range(rows):
        for column in range(columns):
            far = (column + 1) % columns
            top = [2 + (row - 1) * columns + column, 2 + (row - 1) * columns + far]
            low = [2 + row * columns + column, 2 + row * columns + far]
            u0, u1 = column / columns, (column + 1) / columns
            v0, v1 = 1.0 - row / rows, 1.0 - (row + 1) / rows
            if row == 0:
                faces.append((0, low[0], low[1]))
                uvs += [(u0, v0), (u0, v1), (u1, v1)]
            elif row == rows - 1:
                faces.append((top[0], 1, top[1]))
                uvs += [(u0, v0), (u0, v1), (u1, v0)]
            else:
                faces.append((top[0], low[0], low[1], top[1]))
                uvs += [(u0, v0), (u0, v1), (u1, v1), (u1, v0)]
    return mesh_of("sphere", vertices, faces, uvs, smooth)


def box(size: float) -> Any:
    """A cube of side `size` around the origin."""
    h = 0.5 * size
    corners = [(x, y, z) for z in (-h, h) for y in (-h, h) for x in (-h, h)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    return mesh_of("box", corners, faces, [(0, 0), (1, 0), (1, 1), (0, 1)] * 6)


SOCKETS = {
    "base": "Base Color",
    "metallic": "Metallic",
    "roughness": "Roughness",
    "ior": "IOR",
    "alpha": "Alpha",
    "specular": "Specular IOR Level",
    "specular_tint": "Specular Tint",
    "transmission": "Transmission Weight",
    "coat": "Coat Weight",
    "coat_roughness": "Coat Roughness",
    "coat_ior": "Coat IOR",
    "coat_tint": "Coat Tint",
    "sheen": "Sheen Weight",
    "sheen_roughness": "Sheen Roughness",
    "sheen_tint": "Sheen Tint",
    "diffuse_roughness": "Diffuse Roughness",
    "emission": "Emission Color",
    "emission_strength": "Emission Strength",
}


def empty_material(name: str) -> tuple[Any, Any, Any]:
    """A material with an output node only: (material, tree, output)."""
    material = bpy.data.materials.new(name)
    if not material.node_tree:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    return material, tree, tree.nodes.new("ShaderNodeOutputMaterial")


def principled(**values: Any) -> Any:
    """A material of one Principled BSDF; keys are those of SOCKETS."""
    material, tree, output = empty_material("principled")
    shader = tree.nodes.new("ShaderNodeBsdfPrincipled")
    tree.links.new(shader.outputs["BSDF"], output.inputs["Surface"])
    for name, value in values.items():
        shader.inputs[SOCKETS[name]].default_value = (*value, 1.0) if isinstance(value, tuple) else value
    return material


def closure(kind: str, **values: Any) -> Any:
    """A material of one shader node `kind`; keys are socket names with _ for a space."""
    material, tree, output = empty_material(kind)
    shader = tree.nodes.new(kind)
    socket = next(out for out in shader.outputs if out.type == "SHADER")
    tree.links.new(socket, output.inputs["Surface"])
    for name, value in values.items():
        if hasattr(shader, name):
            setattr(shader, name, value)
        else:
            wanted = shader.inputs[name.replace("_", " ")]
            wanted.default_value = (*value, 1.0) if isinstance(value, tuple) else value
    return material


def textured(kind: str, socket: str = "Base Color", output: str = "Color", **values: Any) -> Any:
    """A Principled material (no specular) with one texture node `kind` in `socket`, by UV coordinates."""
    material = principled(roughness=1.0, specular=0.0)
    tree = material.node_tree
    node = tree.nodes.new(kind)
    for name, value in values.items():
        if hasattr(node, name):
            setattr(node, name, value)
        else:
            node.inputs[name.replace("_", " ")].default_value = value
    coordinates = tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(coordinates.outputs["UV"], node.inputs["Vector"])
    shader = next(one for one in tree.nodes if one.type == "BSDF_PRINCIPLED")
    tree.links.new(node.outputs[output], shader.inputs[socket])
    return material


def image(name: str, pixels: Any, float_buffer: bool = False, color_space: str | None = None) -> Any:
    """A generated image of (h, w, 4) pixels, row 0 at the bottom."""
    height, width = pixels.shape[:2]
    made = bpy.data.images.new(name, width, height, alpha=True, float_buffer=float_buffer)
    if color_space:
        # A new colour space makes Blender generate the image anew: it comes before the pixels.
        made.colorspace_settings.name = color_space
    made.pixels.foreach_set(np.ascontiguousarray(pixels, dtype=np.float32).ravel())
    made.update()
    return made
