"""Light rows against Cycles: what section 4 of the architecture predicts for a Lambert plane.

The prediction integrates the light row over its extent on a fine grid of points; Cycles renders one
small picture of the plane. Both must agree within 1 % plus Cycles' noise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")
addon_utils = pytest.importorskip("addon_utils")

from trg_blender.engine import session  # noqa: E402
from trg_blender.engine.devices import find_device  # noqa: E402
from trg_blender.engine.from_blender import SceneReader  # noqa: E402
from trg_blender.engine.scene_arrays import LIGHT_KINDS, Light, RenderSettings  # noqa: E402

ALBEDO = 0.8
SAMPLES = 1024
DISTANCES = (0.7, 2.0, 5.0)


@dataclass(frozen=True)
class Case:
    kind: str
    energy: float
    settings: dict
    rotation: tuple[float, float, float] = (0.0, 0.0, 0.0)
    offset: float = 0.0
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)


CASES = {
    "sun": Case("SUN", 3.0, {"angle": 0.0}, rotation=(0.6, 0.0, 0.0)),
    "sun_wide": Case("SUN", 2.0, {"angle": 0.4}, rotation=(0.3, 0.2, 0.0)),
    "point": Case("POINT", 100.0, {"shadow_soft_size": 0.0}, offset=0.5),
    "point_sphere": Case("POINT", 60.0, {"shadow_soft_size": 0.3, "use_soft_falloff": False}, offset=0.3),
    "spot": Case("SPOT", 200.0, {"shadow_soft_size": 0.0, "spot_size": 1.2, "spot_blend": 0.5}),
    "spot_rim": Case(
        "SPOT",
        200.0,
        {"shadow_soft_size": 0.0, "spot_size": 1.2, "spot_blend": 0.7},
        rotation=(0.4, 0.0, 0.0),
    ),
    "square": Case("AREA", 50.0, {"shape": "SQUARE", "size": 0.8}),
    "rectangle": Case(
        "AREA",
        50.0,
        {"shape": "RECTANGLE", "size": 1.5, "size_y": 0.4},
        rotation=(0.5, 0.0, 0.0),
        offset=0.3,
    ),
    "disk": Case("AREA", 20.0, {"shape": "DISK", "size": 0.6}, offset=0.4),
    "ellipse_scaled": Case(
        "AREA", 20.0, {"shape": "ELLIPSE", "size": 0.6, "size_y": 1.0}, scale=(2.0, 0.5, 1.0)
    ),
}


@pytest.fixture(scope="module", autouse=True)
def cycles():
    addon_utils.enable("cycles")
    yield
    addon_utils.disable("cycles")


def build_plane_scene(case: Case, distance: float) -> bpy.types.Scene:
    """A small white plane at the origin, the light `distance` above it, an orthographic camera."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=0.02)
    material = bpy.data.materials.new("lambert")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (ALBEDO, ALBEDO, ALBEDO, 1.0)
    tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(material)
    light = bpy.data.lights.new("light", case.kind)
    light.energy, light.color = case.energy, (1.0, 0.5, 0.25)
    for name, value in case.settings.items():
        setattr(light, name, value)
    owner = bpy.data.objects.new("light", light)
    owner.location, owner.rotation_euler = (case.offset, 0.0, distance), case.rotation
    owner.scale = case.scale
    scene.collection.objects.link(owner)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 0.001
    camera.location = (0.0, 0.0, 0.5)
    scene.collection.objects.link(camera)
    scene.camera = camera
    return scene


def cycles_radiance(scene: bpy.types.Scene, tmp_path) -> np.ndarray:
    """Mean linear colour that Cycles gives the plane."""
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = SAMPLES, False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.sample_clamp_indirect = 0.0
    scene.render.resolution_x = scene.render.resolution_y = 4
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(tmp_path / "cycles.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.empty(4 * 4 * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(16, -1)[:, :3].mean(axis=0)


def light_points(light: Light) -> tuple[np.ndarray, np.ndarray, float]:
    """Points of an area or sphere light, unit normals there, and the area of all of them."""
    grid = (np.arange(400) + 0.5) / 400
    s, t = np.meshgrid(grid, grid)
    centre = np.array([light.position_x, light.position_y, light.position_z])
    if LIGHT_KINDS[light.kind] in ("point", "spot"):
        z, phi = 2 * s.ravel() - 1, 2 * math.pi * t.ravel()
        rim = np.sqrt(1 - z * z)
        normals = np.stack([rim * np.cos(phi), rim * np.sin(phi), z], axis=1)
        return centre + light.radius * normals, normals, 4 * math.pi * light.radius**2
    u = np.array([light.axis_u_x, light.axis_u_y, light.axis_u_z])
    v = np.array([light.axis_v_x, light.axis_v_y, light.axis_v_z])
    a, b = 2 * s.ravel() - 1, 2 * t.ravel() - 1
    area = 4 * np.linalg.norm(np.cross(u, v))
    if LIGHT_KINDS[light.kind] == "area_ellipse":
        r, phi = np.sqrt(s.ravel()), 2 * math.pi * t.ravel()
        a, b, area = r * np.cos(phi), r * np.sin(phi), area * math.pi / 4
    normal = np.array([light.direction_x, light.direction_y, light.direction_z])
    return centre + a[:, None] * u + b[:, None] * v, np.broadcast_to(normal, (a.size, 3)), area


def predicted_irradiance(light: Light) -> float:
    """Irradiance at the origin, facing +Z, per unit of the row's colour."""
    kind = LIGHT_KINDS[light.kind]
    if kind == "sun":
        return sun_irradiance(light)
    if kind in ("point", "spot") and light.radius == 0:
        return delta_irradiance(light)
    points, normals, area = light_points(light)
    d2 = (points**2).sum(axis=1)
    towards = points / np.sqrt(d2)[:, None]
    cos_light = np.clip((-towards * normals).sum(axis=1), 0, None)
    geometry = np.clip(towards[:, 2], 0, None) * cos_light / d2
    radiance = 1.0 / (math.pi * light.radius**2) if kind == "point" else 1.0
    return float(radiance * geometry.mean() * area)


def sun_irradiance(light: Light) -> float:
    """A disc of directions of even radiance, 1 when it faces the surface squarely."""
    axis = np.array([light.direction_x, light.direction_y, light.direction_z])
    return float(axis[2])


def delta_irradiance(light: Light) -> float:
    position = np.array([light.position_x, light.position_y, light.position_z])
    distance = float(np.linalg.norm(position))
    irradiance = position[2] / distance / distance**2
    if LIGHT_KINDS[light.kind] == "spot":
        axis = np.array([light.direction_x, light.direction_y, light.direction_z])
        cosine = float(-position @ axis / distance)
        x = min(max((cosine - light.cos_outer) / (light.cos_inner - light.cos_outer), 0.0), 1.0)
        irradiance *= x * x * (3 - 2 * x)
    return irradiance


@pytest.mark.parametrize("distance", DISTANCES)
@pytest.mark.parametrize("name", CASES)
def test_light_row_predicts_what_cycles_renders(name, distance, tmp_path):
    """Radiance of a Lambert plane under one light, per channel."""
    scene = build_plane_scene(CASES[name], distance)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    (light,) = SceneReader().read(depsgraph.scene_eval, depsgraph, (4, 4)).lights
    color = np.array([light.color_r, light.color_g, light.color_b])
    expected = ALBEDO / math.pi * predicted_irradiance(light) * color
    assert expected.min() > 0
    np.testing.assert_allclose(cycles_radiance(scene, tmp_path), expected, rtol=0.01)


@pytest.mark.skipif(not find_device("cpu").available, reason="trg_native is not built")
@pytest.mark.parametrize("name", CASES)
def test_the_native_renderer_agrees_with_cycles(name, tmp_path):
    """The whole way: Blender's light, the row, the sampled light of trg_native."""
    scene = build_plane_scene(CASES[name], 2.0)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    arrays = SceneReader().read(depsgraph.scene_eval, depsgraph, (4, 4))
    result = session.render(arrays, RenderSettings(4, 4, samples=4 * SAMPLES, max_bounces=0))
    ours = result.pixels[..., :3].reshape(-1, 3).mean(axis=0)
    np.testing.assert_allclose(ours, cycles_radiance(scene, tmp_path), rtol=0.01)


def test_a_light_object_keeps_the_falloff_that_a_program_stored():
    """trg_falloff makes the light the paper's: a delta with its three coefficients."""
    scene = build_plane_scene(CASES["point_sphere"], 2.0)
    owner = scene.objects["light"]
    owner["trg_falloff"] = (1.0, 0.5, 0.25)
    owner.update_tag()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    (light,) = SceneReader().read(depsgraph.scene_eval, depsgraph, (4, 4)).lights
    assert (light.falloff_constant, light.falloff_linear, light.falloff_quadratic) == (1.0, 0.5, 0.25)
    assert light.radius == 0.0
