"""Scenes of benchmarks/agree.py where light is cut short, or where not every ray sees every object."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy

from .agree_stage import Stage, box, closure, empty_material, lit_stage, new_stage, principled

GOLD, WHITE = (0.9, 0.6, 0.2), (0.8, 0.8, 0.8)
FLAGS = ("visible_camera", "visible_diffuse", "visible_glossy", "visible_transmission", "visible_shadow")


def ruled(build: Callable[[], Stage], **rules: Any) -> Stage:
    """`build` with settings that both engines get."""
    stage = build()
    stage.scene["agree_rules"] = rules
    return stage


def mirrors() -> Stage:
    """Metal, plastic and glass over a floor that mirrors in part."""
    stage = new_stage()
    stage.add_floor(principled(base=WHITE, roughness=0.15))
    stage.set_world((0.4, 0.45, 0.5))
    stage.add_light("AREA", (2.5, -3.0, 4.0), 150.0, size=2.0)
    stage.add_spheres(
        [
            principled(base=GOLD, metallic=1.0, roughness=0.1),
            principled(base=(0.1, 0.3, 0.8), roughness=0.3),
            principled(base=(1.0, 1.0, 1.0), transmission=1.0, roughness=0.1),
            principled(base=GOLD, metallic=0.5, roughness=0.4, coat=0.8),
            principled(base=(0.8, 0.1, 0.05), transmission=0.5, roughness=0.3),
        ]
    )
    return stage


def sheets() -> Stage:
    """Spheres that are partly there before a wall."""
    stage = lit_stage()
    stage.add_spheres([principled(base=GOLD, specular=0.0, alpha=0.2 * k) for k in range(5)])
    return stage


def corner() -> Stage:
    """Diffuse boxes under a sun: what a clamp cuts does not depend on how lights are sampled."""
    stage = new_stage()
    stage.add_floor(principled(base=(0.7, 0.7, 0.7), specular=0.0))
    for k in range(3):
        stage.add_mesh(box(1.0), principled(base=(0.8, 0.3, 0.2), specular=0.0), (1.6 * k - 1.6, 0.6, 0.5))
    stage.add_light("SUN", (1.0, -3.0, 3.0), 6.0, angle=0.0)
    return stage


def unseen() -> Stage:
    """Each sphere is hidden from one kind of ray; there are a mirror, glass and a sun."""
    stage = new_stage()
    stage.add_floor(principled(base=WHITE, roughness=0.1))
    stage.set_world((0.4, 0.45, 0.5))
    stage.add_light("SUN", (2.5, -3.0, 4.0), 2.0, angle=0.1)
    colors = [(0.8, 0.1, 0.05), (0.1, 0.8, 0.1), (0.1, 0.1, 0.8), GOLD, WHITE]
    for placed, flag in zip(stage.add_spheres([principled(base=c) for c in colors]), FLAGS, strict=True):
        setattr(placed, flag, False)
    pane = stage.add_mesh(box(1.0), principled(base=WHITE, transmission=1.0, roughness=0.0), (0.0, -1.2, 0.3))
    pane.scale = (5.0, 0.1, 0.6)
    return stage


def holes() -> Stage:
    """Holdouts by object, by shader, by a shader in part, and by collection, on a mirroring floor."""
    stage = new_stage()
    stage.add_floor(principled(base=WHITE, roughness=0.1))
    stage.set_world((0.4, 0.45, 0.5))
    stage.add_light("AREA", (2.5, -3.0, 4.0), 150.0, size=2.0)
    part, tree, output = empty_material("in part")
    mixer, hole = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeHoldout")
    mixer.inputs[0].default_value = 0.4
    tree.links.new(hole.outputs[0], mixer.inputs[1])
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], mixer.inputs[2])
    tree.links.new(mixer.outputs[0], output.inputs["Surface"])
    plain = [principled(base=GOLD, roughness=0.3) for _ in range(3)]
    materials = [plain[0], closure("ShaderNodeHoldout"), part, plain[1], plain[2]]
    placed = stage.add_spheres(materials)
    placed[0].is_holdout = True
    for one, name in ((placed[3], "holdout"), (placed[4], "indirect_only")):
        kept = bpy.data.collections.new(name)
        stage.scene.collection.children.link(kept)
        stage.scene.collection.objects.unlink(one)
        kept.objects.link(one)
        setattr(stage.scene.view_layers[0].layer_collection.children[name], name, True)
    return stage


def limit_scenes(closed_box: Callable[[], Stage]) -> dict[str, Callable[[], Stage]]:
    return {
        "no diffuse bounce": lambda: ruled(closed_box, diffuse_bounces=0),
        "one glossy bounce": lambda: ruled(mirrors, glossy_bounces=1),
        "no transmission bounce": lambda: ruled(mirrors, transmission_bounces=0),
        "few bounces of each": lambda: ruled(
            closed_box, diffuse_bounces=1, glossy_bounces=1, transmission_bounces=2
        ),
        "no transparent bounce": lambda: ruled(sheets, transparent_bounces=0),
        "one transparent bounce": lambda: ruled(sheets, transparent_bounces=1),
        "clamp direct": lambda: ruled(corner, clamp_direct=0.5),
        "clamp indirect": lambda: ruled(corner, clamp_indirect=0.2, max_bounces=1),
        "no caustics": lambda: ruled(closed_box, caustics_reflective=False, caustics_refractive=False),
        "no refractive caustics": lambda: ruled(mirrors, caustics_refractive=False),
        "ray visibility": unseen,
        "holdouts": holes,
    }
