"""What cuts paths of the reference renderer short, or makes them bring less: path_rules.py."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from .path_rules import NO_LIMIT, PathRules
from .reference_bsdf import Bsdf, Scattered
from .reference_passes import split_bsdf
from .reference_surface import Material, Surface
from .scene_arrays import CAMERA_RAY, DIFFUSE_RAY, EVERY_RAY, GLOSSY_RAY, TRANSMISSION_RAY, Float64

KIND_BITS = np.array([DIFFUSE_RAY, GLOSSY_RAY, TRANSMISSION_RAY], dtype=np.uint8)


@dataclass(frozen=True, slots=True)
class Limits:
    """What n paths remember of their scatterings."""

    kind: NDArray[np.uint8]
    """(n,) bit of the ray that they came by"""
    used: NDArray[np.int64]
    """(n, 3) diffuse, glossy and transmitted scatterings"""
    sheets: NDArray[np.int64]
    """(n,) surfaces gone straight through"""
    ended: NDArray[np.bool_]
    """(n,) they only collect what shines from here on"""

    def take(self, rows: NDArray[np.bool_]) -> Limits:
        """Those of some paths."""
        return Limits(*(getattr(self, each.name)[rows] for each in fields(self)))


def new_limits(count: int) -> Limits:
    """Paths at the camera."""
    return Limits(
        np.full(count, CAMERA_RAY, np.uint8),
        np.zeros((count, 3), np.int64),
        np.zeros(count, np.int64),
        np.zeros(count, bool),
    )


def endless(limit: int) -> int:
    return 2**30 if limit >= NO_LIMIT else limit


def count_sheets(rules: PathRules, limits: Limits, passed: NDArray[np.int64]) -> Limits:
    """After `passed` (n,) more surfaces gone straight through."""
    sheets = limits.sheets + passed
    return replace(limits, sheets=sheets, ended=limits.ended | (sheets > endless(rules.transparent)))


def sheets_left(rules: PathRules, limits: Limits, extra: int) -> NDArray[np.int64]:
    """(n,) surfaces that rays may still pass: shadow rays with `extra` 0, the path itself with 1."""
    return np.maximum(endless(rules.transparent) + extra - limits.sheets, 0)


def clamp_light(rules: PathRules, light: Float64, scatterings: int) -> tuple[Float64, int]:
    """Contributions (n, 3) after so many scatterings, made smaller by the rules, and how many were."""
    clamp = rules.clamp_indirect if scatterings > 1 else rules.clamp_direct
    total = np.abs(light).sum(axis=1)
    over = total > 3.0 * clamp
    if clamp <= 0.0 or not over.any():
        return light, 0
    scale = np.where(over, 3.0 * clamp / np.where(over, total, 1.0), 1.0)
    return light * scale[:, None], int(over.sum())


def dark_ways(rules: PathRules, limits: Limits) -> NDArray[np.uint8]:
    """(n,) bits of the ways of scattering that bring no light to the paths here."""
    bits = (0 if rules.caustics_reflective else GLOSSY_RAY) | (
        0 if rules.caustics_refractive else TRANSMISSION_RAY
    )
    return np.where(limits.kind == DIFFUSE_RAY, np.uint8(bits), np.uint8(0))


def drop_caustics(surface: Surface, dark: NDArray[np.uint8]) -> tuple[Surface, Float64, NDArray[np.uint8]]:
    """The surface without coat, metal and gloss where reflections are dark, the share (n,) that is left, and
    what is dark still."""
    material = surface.material
    dark = np.where(material.column["translucent"] > 0.0, dark & ~np.uint8(TRANSMISSION_RAY), dark)
    rows = (dark & GLOSSY_RAY) != 0
    if not rows.any():
        return surface, np.ones(len(rows)), dark
    bare: Material = replace(
        material,
        metallic=np.where(rows, 0.0, material.metallic),
        specular=np.where(rows, 0.0, material.specular),
        column={**material.column, "coat": np.where(rows, 0.0, material.column["coat"])},
    )
    return replace(surface, material=bare), np.where(rows, 1.0 - material.metallic, 1.0), dark


def lit_share(bsdf: Bsdf, wi: Float64, kinds: NDArray[np.uint8]) -> Float64:
    """(n, 3) of the light from `wi` that is scattered in ways among `kinds` (n,)."""
    lit = (kinds[:, None] & KIND_BITS) != 0
    if lit.all():
        return np.ones((len(kinds), 3))
    shares = split_bsdf(bsdf, wi, np.zeros(len(kinds), bool))
    share: Float64 = (shares * lit[:, :, None]).sum(axis=1)
    return share


def count_scattering(
    rules: PathRules, limits: Limits, bsdf: Bsdf, scattered: Scattered, u: Float64
) -> Limits:
    """After the paths went on along `scattered`; which kind each was is drawn by the shares of its value."""
    shares = split_bsdf(bsdf, scattered.wi, np.isinf(scattered.pdf))
    parts = np.cumsum((shares * scattered.weight[:, None]).sum(axis=2), axis=1)
    kind = np.minimum((u[:, None] * parts[:, 2:] >= parts).sum(axis=1), 2)
    used = limits.used + (np.arange(3) == kind[:, None])
    most = np.array([endless(rules.diffuse), endless(rules.glossy), endless(rules.transmission)])
    ended = limits.ended | (used > most).any(axis=1)
    return replace(limits, kind=KIND_BITS[kind], used=used, ended=ended)


def all_kinds(count: int) -> NDArray[np.uint8]:
    return np.full(count, EVERY_RAY, np.uint8)
