"""Tiny scenes that Cycles and this engine render in one process, a light or camera each."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np

from trg_blender.engine import session
from trg_blender.engine.from_blender import SceneReader
from trg_blender.engine.scene_arrays import RenderSettings, SceneArrays

SIZE = 32
BOUNCES = 2


def enable_cycles() -> None:
    import addon_utils

    addon_utils.enable("cycles")


def diffuse(name: str, color: tuple[float, float, float]) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Color"].default_value = (*color, 1.0)
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material


def new_scene() -> bpy.types.Scene:
    """A floor and a cube of diffuse grey, seen from above at a slant; no light yet."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=6.0)
    bpy.context.object.data.materials.append(diffuse("floor", (0.7, 0.6, 0.5)))
    bpy.ops.mesh.primitive_cube_add(size=0.8, location=(0.3, 0.2, 0.4), rotation=(0.0, 0.0, 0.5))
    bpy.context.object.data.materials.append(diffuse("cube", (0.3, 0.5, 0.8)))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (0.0, -4.0, 3.0), (math.radians(53.0), 0.0, 0.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    return scene


def add_light(kind: str, energy: float, place=(0.8, -0.6, 2.0), turn=(0.3, 0.2, 0.0), **fields) -> None:
    data = bpy.data.lights.new("light", kind)
    data.energy, data.color = energy, (1.0, 0.8, 0.6)
    for name, value in fields.items():
        setattr(data, name, value)
    owner = bpy.data.objects.new("light", data)
    owner.location, owner.rotation_euler = place, turn
    bpy.context.scene.collection.objects.link(owner)


def add_world(color: float = 0.3) -> bpy.types.World:
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (color, color, 1.3 * color, 1.0)
    bpy.context.scene.world = world
    return world


def add_environment(sun: float = 40.0, rotation=(0.3, -0.2, 0.7), kind: str = "POINT") -> None:
    """A coarse float picture of noise with one bright texel, behind a Mapping node."""
    world = add_world()
    tree = world.node_tree
    pixels = np.ones((16, 32, 4), np.float32)
    pixels[..., :3] = np.random.default_rng(3).random((16, 32, 3))
    pixels[12, 20, :3] = (sun, 0.9 * sun, 0.8 * sun)
    image = bpy.data.images.new("sky", 32, 16, float_buffer=True)
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    image.pack()
    node, mapping = tree.nodes.new("ShaderNodeTexEnvironment"), tree.nodes.new("ShaderNodeMapping")
    coordinate = tree.nodes.new("ShaderNodeTexCoord")
    node.image = image
    mapping.vector_type = kind
    mapping.inputs["Rotation"].default_value = rotation
    tree.links.new(coordinate.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
    tree.links.new(node.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    tree.nodes["Background"].inputs["Strength"].default_value = 0.8


def set_camera(**fields: object) -> None:
    """Fields of the camera, those of its depth of field as dof_NAME, and light from all around."""
    add_environment()
    data = bpy.context.scene.camera.data
    for name, value in fields.items():
        if name.startswith("dof_"):
            data.dof.use_dof = True
            setattr(data.dof, name[4:], value)
        else:
            setattr(data, name, value)


def set_panorama() -> None:
    set_camera(type="PANO", panorama_type="EQUIRECTANGULAR", longitude_min=-2.0, longitude_max=2.8,
               latitude_min=-1.2, latitude_max=0.6)


CAMERAS: dict[str, Callable[[], object]] = {
    "camera_shift_portrait": lambda: set_camera(shift_x=0.2, shift_y=-0.1, sensor_fit="VERTICAL", lens=35.0),
    "camera_orthographic": lambda: set_camera(type="ORTHO", ortho_scale=3.0),
    "camera_clipped": lambda: set_camera(clip_start=3.8, clip_end=5.2),
    "camera_lens": lambda: set_camera(dof_aperture_fstop=0.05, dof_focus_distance=4.0),
    "camera_lens_blades": lambda: set_camera(
        dof_aperture_fstop=0.03,
        dof_focus_distance=3.0,
        dof_aperture_blades=3,
        dof_aperture_rotation=0.4,
        dof_aperture_ratio=2.0,
    ),
    "camera_lens_orthographic": lambda: set_camera(
        type="ORTHO", ortho_scale=3.0, dof_aperture_fstop=1.0, dof_focus_distance=3.0, dof_aperture_blades=5
    ),
    "camera_panorama": set_panorama,
}

LIGHTS: dict[str, Callable[[], object]] = {
    "sun": lambda: add_light("SUN", 2.0, angle=0.0),
    "sun_angle": lambda: add_light("SUN", 2.0, angle=0.5),
    "point": lambda: add_light("POINT", 100.0, shadow_soft_size=0.0),
    "point_sphere": lambda: add_light("POINT", 100.0, shadow_soft_size=0.4, use_soft_falloff=False),
    "point_soft_falloff": lambda: add_light("POINT", 100.0, shadow_soft_size=0.4, use_soft_falloff=True),
    "spot": lambda: add_light("SPOT", 200.0, shadow_soft_size=0.0, spot_size=1.2, spot_blend=0.4),
    "spot_sphere": lambda: add_light(
        "SPOT", 200.0, shadow_soft_size=0.3, spot_size=1.2, spot_blend=0.4, use_soft_falloff=False
    ),
    "spot_soft_falloff": lambda: add_light(
        "SPOT", 200.0, shadow_soft_size=0.3, spot_size=1.2, spot_blend=0.4, use_soft_falloff=True
    ),
    "area_rectangle": lambda: add_light("AREA", 60.0, shape="RECTANGLE", size=1.2, size_y=0.4),
    "area_ellipse": lambda: add_light("AREA", 60.0, shape="ELLIPSE", size=1.2, size_y=0.4),
    "area_temperature": lambda: add_light(
        "AREA", 60.0, shape="SQUARE", size=0.5, use_temperature=True, temperature=3500.0, exposure=0.5
    ),
    "area_not_normalised": lambda: add_light("AREA", 60.0, shape="DISK", size=0.5, normalize=False),
    "area_spread_wide": lambda: add_light("AREA", 60.0, shape="SQUARE", size=0.8, spread=2.2),
    "area_spread_thin": lambda: add_light("AREA", 60.0, shape="SQUARE", size=0.8, spread=0.5),
    "world_constant": add_world,
    "world_environment": add_environment,
    "world_environment_texture_mapping": lambda: add_environment(kind="TEXTURE"),
}


def cycles_picture(samples: int) -> np.ndarray:
    """(SIZE, SIZE, 4) of the scene at hand by Cycles, row 0 at the bottom."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = samples, False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.sample_clamp_indirect = 0.0
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = BOUNCES
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 1.0
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "cycles.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        flat = np.empty(SIZE * SIZE * image.channels, np.float32)
        image.pixels.foreach_get(flat)
    return flat.reshape(SIZE, SIZE, -1)


def read_arrays() -> SceneArrays:
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return SceneReader().read(depsgraph.scene_eval, depsgraph, (SIZE, SIZE))


def our_picture(samples: int) -> np.ndarray:
    """The same by the native core."""
    settings = RenderSettings(SIZE, SIZE, samples=samples, max_bounces=BOUNCES, threads=2)
    return session.render(read_arrays(), settings).pixels


def ratio_of_means(samples: int) -> tuple[float, float]:
    """(ours over Cycles' mean, largest difference of 8 x 8 block means over the picture's mean)."""
    ours, theirs = (picture(samples)[..., :3] for picture in (our_picture, cycles_picture))
    blocks = [one.reshape(4, 8, 4, 8, 3).mean(axis=(1, 3)) for one in (ours, theirs)]
    worst = np.abs(blocks[0] - blocks[1]).max() / theirs.mean()
    return float(ours.mean(dtype=np.float64) / theirs.mean(dtype=np.float64)), float(worst)
