"""Holdouts: places where the camera sees a hole, and what they ask of a film."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .scene_arrays import EVERY_RAY, Environment, SceneArrays


def has_holes(scene: SceneArrays) -> bool:
    """Whether the camera may see a hole somewhere."""
    return any(one.holdout for one in scene.instances) or any(row.holdout for row in scene.materials)


def with_holes(scene: SceneArrays) -> SceneArrays:
    """The scene made ready for its holes: a constant world behind a transparent film, which is else taken out
    of the finished picture by the rays that missed, becomes an environment that is never put in."""
    if not (scene.transparent_film and scene.environment is None and has_holes(scene)):
        return scene
    pixels = np.tile(np.asarray(scene.world, np.float32), (1, 2, 1))
    return replace(scene, environment=Environment(pixels))


def classic_warnings(scene: SceneArrays) -> list[str]:
    """What of this the classic integrator leaves out."""
    unseen = any(one.mask != EVERY_RAY for one in scene.instances)
    if not unseen and not has_holes(scene):
        return []
    return ["holdouts and visibility by kind of ray: not with the classic integrator"]
