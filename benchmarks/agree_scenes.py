"""Scenes of benchmarks/agree.py: materials at five parameter values, textures, lights, cameras, bounces."""

from __future__ import annotations

import math
from typing import Any

import bpy
import numpy as np

from .agree_limits import limit_scenes
from .agree_stage import (
    Build,
    Stage,
    box,
    closure,
    empty_material,
    image,
    lit_stage,
    new_stage,
    principled,
    quad,
    sphere,
    textured,
)

RED, GOLD, WHITE = (0.8, 0.1, 0.05), (0.9, 0.6, 0.2), (0.8, 0.8, 0.8)


def spheres(values: list[dict[str, Any]], maker: Any = principled) -> Stage:
    stage = lit_stage()
    stage.add_spheres([maker(**one) for one in values])
    return stage


def sweep(name: str, values: list[Any], **fixed: Any) -> Stage:
    """Five Principled spheres that differ in one input."""
    return spheres([{**fixed, name: value} for value in values])


def material_scenes() -> dict[str, Any]:
    steps = [0.0, 0.25, 0.5, 0.75, 1.0]
    return {
        "diffuse": lambda: sweep("base", [(s, s, s) for s in (0.0, 0.2, 0.5, 0.8, 1.0)], specular=0.0),
        "diffuse roughness": lambda: sweep("diffuse_roughness", steps, base=RED, specular=0.0),
        "metal roughness": lambda: sweep("roughness", steps, base=GOLD, metallic=1.0),
        "gloss roughness": lambda: sweep("roughness", steps, base=RED),
        "metallic": lambda: sweep("metallic", steps, base=GOLD, roughness=0.3),
        "specular level": lambda: sweep("specular", steps, base=RED, roughness=0.2),
        "specular tint": lambda: sweep(
            "specular_tint", [(1, 1, 1), (1, 0, 0), (0, 1, 0), (0.2, 0.2, 1), (0, 0, 0)], metallic=0.5
        ),
        "metal edge tint": lambda: sweep(
            "specular_tint", [(1, 1, 1), (1, 0, 0), (0, 1, 0), (0.2, 0.2, 1), (0, 0, 0)], metallic=1.0
        ),
        "gloss ior": lambda: sweep("ior", [1.0, 1.2, 1.5, 2.0, 3.0], base=RED, roughness=0.2),
        "glass roughness": lambda: sweep("roughness", steps, base=(1, 1, 1), transmission=1.0),
        "glass ior": lambda: sweep("ior", [1.0, 1.1, 1.33, 1.5, 2.4], transmission=1.0, roughness=0.0),
        "glass colour": lambda: sweep(
            "base", [(1, 1, 1), RED, GOLD, (0.1, 0.6, 0.9), (0, 0, 0)], transmission=1.0, roughness=0.1
        ),
        "transmission": lambda: sweep("transmission", steps, base=GOLD, roughness=0.2),
        "coat": lambda: sweep("coat", steps, base=RED, roughness=0.8),
        "coat roughness": lambda: sweep("coat_roughness", steps, base=RED, coat=1.0, roughness=0.5),
        "coat tint": lambda: sweep(
            "coat_tint", [(1, 1, 1), (1, 0.2, 0.2), (0.2, 1, 0.2), (0.2, 0.2, 1), (0, 0, 0)], coat=1.0
        ),
        "sheen": lambda: sweep("sheen", steps, base=RED, roughness=0.8, sheen_roughness=0.4),
        "sheen roughness": lambda: sweep("sheen_roughness", steps, base=RED, sheen=1.0),
        "alpha": lambda: sweep("alpha", steps, base=RED),
        "emission": lambda: sweep(
            "emission_strength", [0.0, 0.5, 1.0, 2.0, 5.0], base=RED, emission=(0.2, 0.5, 1.0)
        ),
        "node closures": node_closures,
        "mixed closures": mixed_closures,
        "textured mixtures": textured_mixtures,
    }


def node_closures() -> Stage:
    stage = lit_stage()
    stage.add_spheres(
        [
            closure("ShaderNodeBsdfDiffuse", Color=RED, Roughness=0.8),
            closure("ShaderNodeBsdfAnisotropic", Color=GOLD, Roughness=0.4),
            closure("ShaderNodeBsdfGlass", Color=(1.0, 1.0, 1.0), Roughness=0.2, IOR=1.45),
            closure("ShaderNodeBsdfRefraction", Color=(1.0, 1.0, 1.0), Roughness=0.2, IOR=1.3),
            closure("ShaderNodeBsdfTranslucent", Color=WHITE),
        ]
    )
    return stage


def mix(first: str, second: str, share: float) -> Any:
    material, tree, output = empty_material("mix")
    mixer = tree.nodes.new("ShaderNodeMixShader")
    mixer.inputs[0].default_value = share
    for socket, kind in ((1, first), (2, second)):
        tree.links.new(tree.nodes.new(kind).outputs[0], mixer.inputs[socket])
    tree.links.new(mixer.outputs[0], output.inputs["Surface"])
    return material


def mixed_closures() -> Stage:
    stage = lit_stage()
    pairs = [
        ("ShaderNodeBsdfDiffuse", "ShaderNodeBsdfAnisotropic"),
        ("ShaderNodeBsdfDiffuse", "ShaderNodeBsdfGlass"),
    ]
    pairs += [
        ("ShaderNodeBsdfDiffuse", "ShaderNodeBsdfTransparent"),
        ("ShaderNodeBsdfGlass", "ShaderNodeEmission"),
    ]
    pairs += [("ShaderNodeBsdfTransparent", "ShaderNodeBsdfAnisotropic")]
    stage.add_spheres([mix(first, second, 0.4) for first, second in pairs])
    return stage


def textured_mix(first: str, second: str, kind: str = "ShaderNodeMixShader") -> Any:
    """Two shaders by a checker, or added."""
    material, tree, output = empty_material("textured mix")
    mixer = tree.nodes.new(kind)
    for socket, name in zip(list(mixer.inputs)[-2:], (first, second), strict=True):
        tree.links.new(tree.nodes.new(name).outputs[0], socket)
    if kind == "ShaderNodeMixShader":
        checker = tree.nodes.new("ShaderNodeTexChecker")
        checker.inputs["Scale"].default_value = 8.0
        checker.inputs["Color1"].default_value = (0.9, 0.9, 0.9, 1.0)
        checker.inputs["Color2"].default_value = (0.3, 0.3, 0.3, 1.0)
        coordinates = tree.nodes.new("ShaderNodeTexCoord")
        tree.links.new(coordinates.outputs["UV"], checker.inputs["Vector"])
        tree.links.new(checker.outputs["Color"], mixer.inputs[0])
    tree.links.new(mixer.outputs[0], output.inputs["Surface"])
    return material


def textured_mixtures() -> Stage:
    stage = lit_stage()
    pairs = [
        ("ShaderNodeBsdfDiffuse", "ShaderNodeBsdfAnisotropic"),
        ("ShaderNodeBsdfTransparent", "ShaderNodeBsdfDiffuse"),
        ("ShaderNodeEmission", "ShaderNodeBsdfTransparent"),
    ]
    materials = [textured_mix(first, second) for first, second in pairs]
    added = [
        ("ShaderNodeBsdfTranslucent", "ShaderNodeBsdfAnisotropic"),
        ("ShaderNodeBsdfTransparent", "ShaderNodeEmission"),
    ]
    materials += [textured_mix(first, second, "ShaderNodeAddShader") for first, second in added]
    stage.add_spheres(materials)
    return stage


def pattern(side: int = 64) -> Any:
    """Colours that differ everywhere, with alpha 1 and no symmetry."""
    x, y = np.meshgrid(np.linspace(0, 1, side), np.linspace(0, 1, side))
    check = ((np.floor(x * 8) + np.floor(y * 8)) % 2) * 0.5
    return np.stack([0.1 + 0.8 * x, 0.1 + 0.4 * y + check, 0.9 - 0.7 * x * y, np.ones_like(x)], axis=-1)


def with_image(**values: Any) -> Any:
    material = textured("ShaderNodeTexImage", **values)
    node = next(one for one in material.node_tree.nodes if one.type == "TEX_IMAGE")
    node.image = image("pattern", pattern())
    return material


def relief(kind: str, strength: float) -> Any:
    """A Principled material whose normal comes from a normal map or a bump map."""
    material = principled(base=RED, roughness=0.3)
    tree = material.node_tree
    shader = next(one for one in tree.nodes if one.type == "BSDF_PRINCIPLED")
    map_node = tree.nodes.new(kind)
    texture = tree.nodes.new("ShaderNodeTexImage" if kind == "ShaderNodeNormalMap" else "ShaderNodeTexNoise")
    if kind == "ShaderNodeNormalMap":
        x, y = np.meshgrid(np.linspace(0, 1, 128), np.linspace(0, 1, 128))
        tilt = np.stack([0.4 * np.sin(40 * x), 0.4 * np.cos(30 * y), np.ones_like(x)], axis=-1)
        tilt /= np.linalg.norm(tilt, axis=-1, keepdims=True)
        stored = np.concatenate([0.5 + 0.5 * tilt, np.ones((128, 128, 1))], axis=-1)
        texture.image = image("tilt", stored, float_buffer=True, color_space="Non-Color")
        tree.links.new(texture.outputs["Color"], map_node.inputs["Color"])
    else:
        texture.inputs["Scale"].default_value = 8.0
        tree.links.new(texture.outputs[0], map_node.inputs["Height"])
    map_node.inputs["Strength"].default_value = strength
    tree.links.new(map_node.outputs["Normal"], shader.inputs["Normal"])
    return material


def texture_scenes() -> dict[str, Any]:
    def patterns() -> Stage:
        stage = lit_stage()
        stage.add_spheres(
            [
                textured("ShaderNodeTexChecker", Scale=8.0),
                textured("ShaderNodeTexNoise", Scale=6.0, Detail=3.0),
                textured("ShaderNodeTexBrick", Scale=8.0),
                textured("ShaderNodeTexGradient"),
                textured("ShaderNodeTexWave", Scale=3.0, Distortion=2.0),
            ]
        )
        return stage

    def images() -> Stage:
        stage = lit_stage()
        stage.add_spheres(
            [
                with_image(interpolation="Closest"),
                with_image(),
                with_image(interpolation="Cubic"),
                with_image(extension="EXTEND"),
                with_image(socket="Roughness"),
            ]
        )
        return stage

    def relieves() -> Stage:
        stage = lit_stage()
        kinds = ["ShaderNodeNormalMap", "ShaderNodeNormalMap", "ShaderNodeBump", "ShaderNodeBump"]
        strengths = [0.5, 1.0, 0.3, 1.0]
        stage.add_spheres([relief(kind, strength) for kind, strength in zip(kinds, strengths, strict=True)])
        return stage

    return {"procedural textures": patterns, "image textures": images, "normal and bump": relieves}


def plain_stage() -> Stage:
    """Floor and three grey shapes in the dark, for scenes about light."""
    stage = new_stage()
    stage.add_floor()
    grey = principled(base=WHITE, roughness=0.4)
    stage.add_spheres([grey, grey, grey], 0.4)
    stage.add_mesh(box(0.6), grey, (2.0, 0.4, 0.3))
    return stage


def light(kind: str, location: Any, energy: float, **values: Any) -> Stage:
    stage = plain_stage()
    stage.add_light(kind, location, energy, **values)
    return stage


def emissive_mesh() -> Stage:
    stage = plain_stage()
    glow = principled(emission=(1.0, 0.8, 0.5), emission_strength=20.0)
    stage.add_mesh(sphere(0.2, 24, 12), glow, (-2.0, -0.5, 1.0))
    lamp = stage.add_mesh(quad(0.8), glow, (2.0, -1.0, 2.0))
    lamp.rotation_euler = (math.pi, 0.2, 0.0)
    return stage


def sky_pixels() -> Any:
    """A sky with a small, strong sun and a coloured horizon, (64, 128, 4)."""
    height, width = 64, 128
    up = np.linspace(-1, 1, height)[:, None] * np.ones((1, width))
    pixels = np.stack([0.3 - 0.1 * up, 0.35 + 0.05 * up, 0.4 + 0.3 * up, np.ones_like(up)], axis=-1)
    pixels[44:46, 30:32, :3] = (300.0, 250.0, 200.0)
    return pixels


def hdri() -> Stage:
    stage = plain_stage()
    background = stage.set_world((1.0, 1.0, 1.0))
    tree = stage.scene.world.node_tree
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image("sky", sky_pixels(), float_buffer=True)
    tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    return stage


def sky(repeated: bool, elevation: float) -> Stage:
    """Blender's Sky Texture with its sun; `repeated` scatters more than once where it can."""
    stage = plain_stage()
    background = stage.set_world((1.0, 1.0, 1.0), 0.1)
    tree = stage.scene.world.node_tree
    texture = tree.nodes.new("ShaderNodeTexSky")
    kinds = [item.identifier for item in texture.bl_rna.properties["sky_type"].enum_items]
    single = "SINGLE_SCATTERING" if "SINGLE_SCATTERING" in kinds else "NISHITA"
    texture.sky_type = "MULTIPLE_SCATTERING" if repeated and "MULTIPLE_SCATTERING" in kinds else single
    texture.sun_elevation, texture.sun_rotation, texture.altitude = elevation, 2.5, 100.0
    texture.sun_intensity = 0.5
    tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    return stage


def many_lights() -> Stage:
    stage = plain_stage()
    random = np.random.default_rng(5)
    for _ in range(200):
        at = (*random.uniform((-4, -3), (4, 3)), float(random.uniform(1.0, 2.5)))
        stage.add_light("POINT", at, 1.5, color=tuple(random.uniform(0.2, 1.0, 3)), shadow_soft_size=0.05)
    return stage


def world_only() -> Stage:
    stage = plain_stage()
    stage.set_world((0.5, 0.7, 1.0), 1.3)
    return stage


def light_scenes() -> dict[str, Any]:
    return {
        "sun": lambda: light("SUN", (3.0, -2.0, 5.0), 3.0, angle=0.01),
        "wide sun": lambda: light("SUN", (3.0, -2.0, 5.0), 3.0, angle=0.6),
        "point": lambda: light("POINT", (1.0, -2.0, 2.0), 200.0, shadow_soft_size=0.0),
        "large point": lambda: light("POINT", (1.0, -2.0, 2.0), 200.0, shadow_soft_size=0.5),
        "spot": lambda: light(
            "SPOT", (1.0, -2.0, 3.0), 800.0, spot_size=0.8, spot_blend=0.3, shadow_soft_size=0.1
        ),
        "area square": lambda: light("AREA", (1.0, -2.0, 2.0), 100.0, shape="SQUARE", size=1.0),
        "area rectangle": lambda: light(
            "AREA", (1.0, -2.0, 2.0), 100.0, shape="RECTANGLE", size=2.0, size_y=0.2
        ),
        "area disk": lambda: light("AREA", (1.0, -2.0, 2.0), 100.0, shape="DISK", size=1.0),
        "area ellipse": lambda: light("AREA", (1.0, -2.0, 2.0), 100.0, shape="ELLIPSE", size=2.0, size_y=0.5),
        "area spread": lambda: light("AREA", (1.0, -2.0, 2.0), 100.0, shape="SQUARE", size=1.0, spread=1.0),
        "emissive mesh": emissive_mesh,
        "world": world_only,
        "hdri": hdri,
        "sky single": lambda: sky(False, 0.6),
        "sky low": lambda: sky(False, 0.05),
        "sky multiple": lambda: sky(True, 0.6),
        "many lights": many_lights,
    }


def camera(**values: Any) -> Stage:
    stage = lit_stage()
    stage.add_spheres([principled(base=RED), principled(base=GOLD, metallic=1.0), principled(base=WHITE)])
    old = stage.scene.camera
    stage.scene.camera = None
    bpy.data.objects.remove(old)
    placed = stage.set_camera()
    for name, value in values.items():
        owner, _, attribute = name.rpartition("__")
        target = placed.data
        for part in filter(None, owner.split("__")):
            target = getattr(target, part)
        setattr(target, attribute, value)
    return stage


def filtered(name: str, width: float) -> Stage:
    """Edges and highlights by a pixel filter; agree.py gives it to both engines."""
    stage = camera()
    stage.scene["agree_filter"] = f"{name} {width}"
    return stage


def moving(what: str) -> Stage:
    """Linear motion over the shutter of half a frame, of a sphere or of the camera."""
    stage = camera()
    stage.scene.render.use_motion_blur = True
    stage.scene.render.motion_blur_shutter = 0.5
    stage.scene.frame_set(1)
    moved = stage.scene.camera if what == "camera" else stage.scene.objects["sphere"]
    base = moved.location.copy()
    for frame, shift in ((0, -0.8), (2, 0.8)):
        moved.location = (base.x + shift, base.y, base.z)
        moved.keyframe_insert("location", frame=frame)
    for curve in curves_of(moved):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    stage.scene.frame_set(1)
    return stage


def curves_of(moved: Any) -> list[Any]:
    """The animation curves of an object, by Blender 4's or 5's way."""
    action = moved.animation_data.action
    if hasattr(action, "fcurves"):
        return list(action.fcurves)
    bag = action.layers[0].strips[0].channelbag(moved.animation_data.action_slot)
    return list(bag.fcurves)


def camera_scenes() -> dict[str, Any]:
    return {
        "orthographic": lambda: camera(type="ORTHO", ortho_scale=5.0),
        "panorama": lambda: camera(type="PANO", panorama_type="EQUIRECTANGULAR"),
        "depth of field": lambda: camera(
            dof__use_dof=True, dof__focus_distance=5.0, dof__aperture_fstop=0.1, dof__aperture_blades=6
        ),
        "shift": lambda: camera(shift_x=0.1, shift_y=-0.2),
        "filter box": lambda: filtered("BOX", 1.0),
        "filter gaussian": lambda: filtered("GAUSSIAN", 3.0),
        "filter blackman-harris": lambda: filtered("BLACKMAN_HARRIS", 6.0),
        "motion blur": lambda: moving("object"),
        "camera motion blur": lambda: moving("camera"),
    }


def closed_box() -> Stage:
    """A box of coloured walls with a lamp, a metal and a glass thing in it: many bounces."""
    stage = new_stage()
    walls = [
        (WHITE, (0, 0, 0), (0, 0, 0)),
        (WHITE, (0, 0, 2), (math.pi, 0, 0)),
        (WHITE, (0, 2, 1), (math.pi / 2, 0, 0)),
    ]
    walls += [(RED, (-2, 0, 1), (0, math.pi / 2, 0)), ((0.1, 0.6, 0.1), (2, 0, 1), (0, -math.pi / 2, 0))]
    for color, place, turn in walls:
        stage.add_mesh(quad(4.0), principled(base=color, specular=0.0), place).rotation_euler = turn
    lamp = principled(base=(0.0, 0.0, 0.0), emission=(1.0, 0.9, 0.8), emission_strength=12.0, specular=0.0)
    stage.add_mesh(quad(0.8), lamp, (0, 0, 1.99)).rotation_euler = (math.pi, 0, 0)
    stage.add_mesh(sphere(0.45), principled(base=GOLD, metallic=1.0, roughness=0.3), (-0.8, 0.3, 0.45))
    stage.add_mesh(
        sphere(0.45), principled(base=(1, 1, 1), transmission=1.0, roughness=0.0), (0.8, -0.2, 0.45)
    )
    return stage


def absorbing() -> Stage:
    """Glass with absorption by a volume of one colour."""
    stage = lit_stage()
    materials = []
    for density in (0.0, 0.5, 1.0, 2.0, 4.0):
        material = principled(base=(1, 1, 1), transmission=1.0, roughness=0.0)
        tree = material.node_tree
        volume = tree.nodes.new("ShaderNodeVolumeAbsorption")
        volume.inputs["Color"].default_value = (0.9, 0.3, 0.1, 1.0)
        volume.inputs["Density"].default_value = density
        output = next(one for one in tree.nodes if one.type == "OUTPUT_MATERIAL")
        tree.links.new(volume.outputs["Volume"], output.inputs["Volume"])
        materials.append(material)
    stage.add_spheres(materials)
    return stage


def instances() -> Stage:
    """One mesh many times, some mirrored and stretched."""
    stage = lit_stage()
    shared = sphere(0.15, 16, 8)
    shared.materials.append(principled(base=GOLD, roughness=0.3, metallic=1.0))
    for k in range(60):
        placed = stage.add_object(f"copy {k}", shared, (-2.7 + 0.6 * (k % 10), 0.5 * (k // 10) - 0.5, 0.15))
        placed.scale = (-1.0 if k % 3 == 0 else 1.0, 1.0, 0.5 + 0.1 * (k % 7))
    return stage


def whole_scenes() -> dict[str, Any]:
    return {"closed box": closed_box, "absorption": absorbing, "instances": instances}


def scenes() -> dict[str, Build]:
    """Name -> a function that sets up the open file and gives its stage."""
    return {
        **material_scenes(),
        **texture_scenes(),
        **light_scenes(),
        **camera_scenes(),
        **whole_scenes(),
        **limit_scenes(closed_box),
    }
