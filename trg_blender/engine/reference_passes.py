"""Passes of the reference renderer: light by the first scattering, and the places that the camera sees.

Architecture.md, section 4, says what each pass holds. Not here: object index, mattes, occlusion and the
denoising features; the native renderer has them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .reference_bsdf import Bsdf, build_facets, evaluate_bsdf, evaluate_diffuse, glass_colors, reflects
from .reference_math import dot
from .scene_arrays import Float64, PassData

KINDS = ("diffuse", "glossy", "transmission")
REFERENCE_PASSES = {
    **{f"{kind}_{part}": 3 for kind in KINDS for part in ("direct", "indirect", "color")},
    "emission": 3,
    "environment": 3,
    "position": 3,
    "mist": 1,
    "sample_count": 1,
}
"""Passes that this renderer fills, with their channels."""
WAY_LEFT = 1e-3
"""Least share of either way of an interface in its colours: facets send light where the normal would not."""


@dataclass(slots=True)
class PassNotes:
    """What a batch of n paths brought home for passes."""

    values: dict[str, Float64]
    """(n, channels) by pass; means of all samples alone"""
    shares: Float64
    """(n, 3, 3): kind by channel, of the first scattering"""
    data: PassData = field(default_factory=PassData)


def make_notes(count: int, passes: tuple[str, ...], data: PassData | None) -> PassNotes | None:
    """None where no pass of this renderer is asked for."""
    wanted = set(passes) & set(REFERENCE_PASSES)
    if not wanted:
        return None
    # Lights are divided by their colours in the end.
    wanted |= {f"{kind}_color" for kind in KINDS if {f"{kind}_direct", f"{kind}_indirect"} & wanted}
    values = {
        name: np.zeros((count, REFERENCE_PASSES[name]))
        for name in sorted(wanted - {"position", "sample_count"})
    }
    if "mist" in values:
        values["mist"] += 1.0
    return PassNotes(values, np.zeros((count, 3, 3)), data or PassData())


def note_light(
    notes: PassNotes, index: NDArray[np.int64], light: Float64, shares: Float64, part: str
) -> None:
    """Adds `light` (k, 3) to the `part` (direct or indirect) of each kind by `shares` (k, 3, 3)."""
    for number, kind in enumerate(KINDS):
        name = f"{kind}_{part}"
        if name in notes.values:
            notes.values[name][index] += light * shares[:, number]


def note_source(
    notes: PassNotes, index: NDArray[np.int64], light: Float64, segment: int, source: str
) -> None:
    """Light from the end of segment `segment`: of a surface or lamp (emission) or the world (environment)."""
    if segment == 0:
        if source in notes.values:
            notes.values[source][index] += light
        return
    note_light(notes, index, light, notes.shares[index], "direct" if segment == 1 else "indirect")


def note_shadow(
    notes: PassNotes, index: NDArray[np.int64], light: Float64, direct_shares: Float64 | None
) -> None:
    """Light that a shadow ray brings; `direct_shares` are those of the first surface, None further on."""
    if direct_shares is not None:
        note_light(notes, index, light, direct_shares, "direct")
    else:
        note_light(notes, index, light, notes.shares[index], "indirect")


def split_bsdf(bsdf: Bsdf, wi_world: Float64, delta: NDArray[np.bool_]) -> Float64:
    """(n, 3, 3) shares of the kinds in what is scattered along `wi_world`."""
    up = dot(wi_world, bsdf.surface.ns) > 0.0
    whole = evaluate_bsdf(bsdf, wi_world)[0]
    part = evaluate_diffuse(bsdf, bsdf.frame.to_local(wi_world))[0]
    diffuse = np.clip(part / np.where(whole > 0.0, whole, np.inf), 0.0, 1.0)
    diffuse[delta | ~up] = 0.0
    glossy = np.where(up[:, None], 1.0 - diffuse, 0.0)
    return np.stack([diffuse, glossy, 1.0 - diffuse - glossy], axis=1)


def lobe_colors(bsdf: Bsdf) -> dict[str, Float64]:
    """(n, 3) albedo of each kind."""
    material, cosine, weights = bsdf.surface.material, bsdf.wo[:, 2], bsdf.weights
    index = (bsdf.gloss.ior, np.sqrt(material.alpha))
    bare = build_facets(material.energy, index, bsdf.gloss.shift, cosine, material.column["multiscatter"])
    gloss = bsdf.gloss.weight * bare.albedo / bare.weight
    gloss = np.where((bsdf.gloss.ior == 1.0)[:, None], 0.0, gloss)
    energy, column = material.energy, material.column
    coat = energy.albedo("gloss", bsdf.coat.ior, column["coat_roughness"], cosine)[0][:, None]
    mirrors = energy.albedo("facets", np.ones(len(cosine)), index[1], cosine)[0][:, None]
    reflected, passed = glass_colors(bsdf, cosine)
    tint, glass = np.sqrt(material.base), weights.glass * kept_by_glass(bsdf)
    glossy = weights.metal * bsdf.metal.at(cosine) * mirrors + gloss + bsdf.coat.weight * coat
    return {
        "diffuse": weights.diffuse + weights.sheen,
        "glossy": glossy + glass * np.maximum(reflected, WAY_LEFT),
        "transmission": glass * np.maximum(passed, WAY_LEFT * tint),
    }


def kept_by_glass(bsdf: Bsdf) -> Float64:
    """(n, 1) of light that single scattering keeps at the interface, where the energy factor adds to it."""
    material, kept = bsdf.surface.material, np.ones(len(bsdf.wo))
    scaled = (material.column["multiscatter"] > 0.0) & (material.transmission > 0.0) & reflects(material)
    if np.any(scaled):
        roughness, cosine = np.sqrt(material.alpha)[scaled], bsdf.wo[scaled, 2]
        kept[scaled] = material.energy.albedo("glass", bsdf.eta[scaled], roughness, cosine)[0]
    return kept[:, None]


def note_vertex(notes: PassNotes, index: NDArray[np.int64], bsdf: Bsdf, distance: Float64) -> None:
    """Colours and mist of the surfaces that camera rays met `distance` away."""
    if any(f"{kind}_color" in notes.values for kind in KINDS):
        for kind, color in lobe_colors(bsdf).items():
            if f"{kind}_color" in notes.values:
                notes.values[f"{kind}_color"][index] = color
    if "mist" in notes.values:
        start, depth, exponent = notes.data.mist
        notes.values["mist"][index, 0] = np.clip((distance - start) / depth, 0.0, 1.0) ** exponent


def read_reference_pass(name: str, sums: dict[str, Float64], samples: int) -> Float64:
    """(h, w, channels) of pass `name` from sums over samples; lights over their colours."""
    kind, _, part = name.rpartition("_")
    if part not in ("direct", "indirect"):
        return sums[name] / max(samples, 1)
    light, color = sums[name], sums[f"{kind}_color"]
    coloured = color > 0.0
    value = np.where(coloured, light / np.where(coloured, color, 1.0), 0.0)
    mean = value.sum(axis=-1, keepdims=True) / np.maximum(coloured.sum(axis=-1, keepdims=True), 1)
    return np.where(coloured, value, mean)
