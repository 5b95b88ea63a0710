"""Scenes of test_agreement.py where paths are cut short, clamped, or meet only some surfaces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from trg_blender.engine.path_rules import PathRules
from trg_blender.engine.scene_arrays import (
    CAMERA_RAY,
    DIFFUSE_RAY,
    EVERY_RAY,
    GLOSSY_RAY,
    SHADOW_RAY,
    TRANSMISSION_RAY,
    Material,
    RenderSettings,
    SceneArrays,
)

from .arrays import light

Studio = Callable[..., SceneArrays]
COATED = Material(
    0.8, 0.4, 0.3, metallic=0.4, roughness=0.3, coat=0.6, coat_roughness=0.1, transmission=0.3, ior=1.4
)
SHEET = Material(0.9, 0.5, 0.4, alpha=0.4, through_g=0.6)
BULB = light("point", (40, 30, 20), (1.5, -1.0, 2.0))
RULES = {
    "no_diffuse_bounce": PathRules(diffuse=0),
    "one_glossy_bounce": PathRules(glossy=1),
    "no_transmission_bounce": PathRules(transmission=0),
    "few_of_each": PathRules(diffuse=1, glossy=2, transmission=1),
    "no_caustics": PathRules(caustics_reflective=False, caustics_refractive=False),
    "no_reflective_caustics": PathRules(caustics_reflective=False),
    "no_refractive_caustics": PathRules(caustics_refractive=False),
}
UNSEEN = {
    "camera": CAMERA_RAY,
    "diffuse": DIFFUSE_RAY,
    "glossy": GLOSSY_RAY,
    "transmission": TRANSMISSION_RAY,
    "shadow": SHADOW_RAY,
}


def hidden(studio: Studio, bit: int) -> SceneArrays:
    """The box is not met by some rays; the ball before it scatters in every way. The box glows, unless shadow
    rays pass it: then light sampling would see its far side through the near one, and bounces would not."""
    scene = studio(COATED)
    glow = 0.0 if bit == SHADOW_RAY else 1.0
    scene.materials.append(Material(0.5, 0.6, 0.7, specular=0.0, emission_r=2.0 * glow, emission_g=glow))
    scene.instances[2].slot_materials[:] = 2
    scene.instances[2].mask = EVERY_RAY & ~bit
    return scene


def held_out(studio: Studio) -> SceneArrays:
    """The ball is a hole; the box is made of a shader that is one in part."""
    scene = studio(COATED, world=(0.4, 0.5, 0.6))
    scene.instances[1].holdout = True
    parts = [replace(COATED, weight=0.6), Material(0.0, 0.0, 0.0, specular=0.0, holdout=1, weight=0.4)]
    scene.materials += [Material(0.0, 0.0, 0.0, specular=0.0, mix_first=3, mix_count=2), *parts]
    scene.instances[2].slot_materials[:] = 2
    return scene


def rule_cases(studio: Studio, settings: RenderSettings) -> dict[str, tuple[SceneArrays, RenderSettings]]:
    found = {}
    for name, rules in RULES.items():
        found[f"rules_{name}"] = (studio(COATED), replace(settings, rules=rules))
    for limit in (0, 1, 2):
        found[f"rules_transparent_{limit}"] = (
            studio(SHEET),
            replace(settings, rules=PathRules(transparent=limit)),
        )
    diffuse = studio(Material(0.8, 0.7, 0.6, specular=0.0), BULB, world=(0, 0, 0))
    clamps = {"direct": PathRules(clamp_direct=0.5), "indirect": PathRules(clamp_indirect=0.2)}
    for name, rules in clamps.items():
        # Without roulette, which would scale what is clamped, each renderer in its own way.
        found[f"rules_clamp_{name}"] = (diffuse, replace(settings, max_bounces=1, rules=rules))
    for name, bit in UNSEEN.items():
        found[f"unseen_by_{name}"] = (hidden(studio, bit), settings)
    found["held_out"] = (held_out(studio), settings)
    return found
