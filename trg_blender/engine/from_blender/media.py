"""What fills bodies beside their materials' own volumes: media of programs, and priorities."""

from __future__ import annotations

from dataclasses import dataclass, replace

import bpy

from ..scene_arrays import Material
from ..to_blender.tags import MEDIUM_DECAY, MEDIUM_INDEX

PRIORITY = "trg_priority"
"""Custom property of a material: the priority of what its surface encloses, 0 for none."""


@dataclass(frozen=True, slots=True)
class Medium:
    """What a program's `enviroment(decay, index)` says of a shape."""

    decay: float = 0.0
    """per metre"""
    index: float = 1.0
    """1: the material's own"""


AIR = Medium()


def claimed_medium(owner: bpy.types.Object) -> Medium:
    """The medium in the tags of an object; air without them."""
    decay, index = owner.get(MEDIUM_DECAY, 0.0), owner.get(MEDIUM_INDEX, 1.0)
    if not all(isinstance(value, (int, float)) for value in (decay, index)):
        return AIR
    return Medium(min(max(float(decay), 0.0), 1e6), min(max(float(index), 1e-3), 1e6))


def fill_rows(
    row: Material, parts: list[Material], material: bpy.types.Material | None, medium: Medium
) -> tuple[Material, list[Material]]:
    """Rows of a material with its priority, and filled with `medium` where they let light pass.

    A program's medium has priority 1 unless the material names another: within it the innermost rules.
    """
    rows = parts or [row]
    passing = [one for one in rows if _passes(one)]
    own = 0.0 if material is None else material.get(PRIORITY, 0.0)
    priority = min(max(float(own), 0.0), 1e6) if isinstance(own, (int, float)) else 0.0
    if not passing:
        return replace(row, priority=priority), parts
    if medium.index != 1.0:
        parts = [_with_index(one, medium.index) for one in parts]
        row = _with_index(row, medium.index)
    if parts:
        row = replace(row, ior=medium.index if medium.index != 1.0 else passing[0].ior)
    if medium != AIR and priority == 0.0:
        priority = 1.0
    return replace(
        row,
        absorption_r=row.absorption_r + medium.decay,
        absorption_g=row.absorption_g + medium.decay,
        absorption_b=row.absorption_b + medium.decay,
        priority=priority,
    ), parts


def _with_index(row: Material, index: float) -> Material:
    return replace(row, ior=index) if _passes(row) else row


def _passes(row: Material) -> bool:
    return row.transmission > 0.0 or row.transmission_texture >= 0
