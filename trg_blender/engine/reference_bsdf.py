"""The lobes of the reference renderer: docs/architecture.md, section 4, in one place.

Seven lobes share out the light: metal and the reflections of glass and gloss go up by GGX, the glass
refraction goes down, the diffuse base goes up by cosine; a coat and a sheen lie above them all. Narrow GGX
(alpha below IDEAL_ALPHA) is a delta.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .reference_energy import EnergyTables, energy_factor
from .reference_fresnel import (
    MetalFresnel,
    build_metal_fresnel,
    fresnel_dielectric,
    fresnel_mean,
    fresnel_shift,
    scaled_ior,
    shifted,
)
from .reference_ggx import (
    ggx_distribution,
    pdf_visible_normal,
    sample_visible_normal,
    smith_shadowing,
)
from .reference_layers import Sheen, build_sheen, eval_sheen, rough_diffuse, sample_sheen
from .reference_math import Frame, build_frame, dot, normalize, sample_cosine
from .reference_surface import IDEAL_ALPHA, Material, Surface
from .scene_arrays import INTERFACES, Float64

METAL, GLASS_REFLECTION, GLASS_REFRACTION, GLOSS, DIFFUSE, COAT, SHEEN = range(7)
SAME_INDEX = 1e-4
"""A dielectric whose index differs less from its surroundings does not bend light."""


@dataclass(frozen=True, slots=True)
class Facets:
    """GGX facets that reflect by Fresnel's law: the opaque dielectric or the coat."""

    weight: Float64
    """(n, 3) with what lies above and the energy factor"""
    ior: Float64
    shift: Float64
    """(n, 3) reflectance is F + shift (1 - F)"""
    albedo: Float64
    """(n, 3) share of the light on the layer that it reflects"""


@dataclass(frozen=True, slots=True)
class Weights:
    """(n, 3) of each lobe, with what lies above it and what the facets' energy asks for."""

    metal: Float64
    glass: Float64
    diffuse: Float64
    sheen: Float64


@dataclass(frozen=True, slots=True)
class Bsdf:
    """The lobes at n points. Directions are local: z is the shading normal, wo.z > 0."""

    surface: Surface
    frame: Frame
    wo: Float64
    eta: Float64
    """glass: index behind the surface over index before it, seen from wo"""
    weights: Weights
    metal: MetalFresnel
    gloss: Facets
    coat: Facets
    coat_alpha: Float64
    sheen: Sheen
    ideal: NDArray[np.bool_]
    """GGX reflections are deltas"""
    straight: NDArray[np.bool_]
    """the refraction is a delta"""
    choice: Float64
    """(n, 7) probability of picking each lobe"""


@dataclass(frozen=True, slots=True)
class Scattered:
    """One continuation of each path."""

    wi: Float64
    """(n, 3) world"""
    weight: Float64
    """(n, 3) BSDF times cosine over density; 0 where the path ends"""
    pdf: Float64
    """(n,) per steradian; inf for a delta"""


def build_bsdf(surface: Surface) -> Bsdf:
    material = surface.material
    frame = build_frame(surface.ns)
    wo = frame.to_local(surface.wo)
    cosine = wo[:, 2]
    eta = np.where(surface.outside, material.ior, 1.0 / material.ior)
    if surface.ratio is not None:
        eta = np.where(surface.ratio > 0.0, surface.ratio, eta)
    ideal = material.alpha < IDEAL_ALPHA
    straight = ideal | (np.abs(eta - 1.0) < SAME_INDEX)
    # From the top down, each layer dims those below it.
    sheen = build_sheen(wo, material.column["sheen_roughness"])
    sheen_weight = material.color("sheen") * sheen.albedo[:, None]
    below = np.clip(1.0 - sheen_weight.max(axis=1), 0.0, 1.0)[:, None] * np.ones((1, 3))
    coat, below = build_coat(material, cosine, below)
    metallic, passing = material.metallic[:, None], material.transmission[:, None]
    metal = build_metal_fresnel(
        material.base, material.color("specular_tint"), material.column["metal_grazing"]
    )
    gloss = build_gloss(material, cosine, below * (1.0 - metallic) * (1.0 - passing))
    diffuse = below * (1.0 - metallic) * (1.0 - passing) * left_below(gloss.albedo) * material.base
    metal_weight = below * metallic * facets_factor(material, cosine, metal.mean())
    factor = np.where(straight[:, None], 1.0, glass_factor(material, eta, cosine))
    glass_weight = below * (1.0 - metallic) * passing * factor
    weights = Weights(metal_weight, glass_weight, diffuse, sheen_weight)
    choice = choose_lobes(material, (weights, gloss, coat), cosine, fresnel_dielectric(cosine, eta))
    return Bsdf(
        surface, frame, wo, eta, weights, metal, gloss, coat, material.column["coat_roughness"] ** 2,
        sheen, ideal, straight, choice,
    )  # fmt: skip


def left_below(albedo: Float64) -> Float64:
    """(n, 1) of the light that a layer of `albedo` (n, 3) leaves: its largest channel counts for all."""
    return np.clip(1.0 - albedo.max(axis=1, keepdims=True), 0.0, 1.0)


def build_coat(material: Material, cosine: Float64, above: Float64) -> tuple[Facets, Float64]:
    """The coat, and the colour (n, 3) by which it and all `above` it dim what lies below."""
    column = material.column
    weight, ior = column["coat"][:, None], column["coat_ior"]
    shift = np.zeros((len(cosine), 3))
    if not np.any(weight):
        return Facets(shift, ior, shift, shift), above
    coat = build_facets(material.energy, (ior, column["coat_roughness"]), shift, cosine)
    # Beer's law along the ray bent into a coat of thickness 1.
    way = 1.0 / np.sqrt(1.0 - (1.0 - cosine * cosine) / ior**2)
    stain = weight * material.color("coat_tint") ** way[:, None] + 1.0 - weight
    below = above * left_below(weight * coat.albedo) * stain
    return Facets(above * weight * coat.weight, ior, shift, coat.albedo), below


def build_gloss(material: Material, cosine: Float64, weight: Float64) -> Facets:
    ior = scaled_ior(material.ior, material.specular)
    shift = fresnel_shift(ior, material.color("specular_tint"))
    roughness = np.sqrt(material.alpha)
    found = build_facets(material.energy, (ior, roughness), shift, cosine, material.column["multiscatter"])
    return Facets(weight * found.weight, ior, shift, found.albedo)


def build_facets(
    energy: EnergyTables,
    index_and_roughness: tuple[Float64, Float64],
    shift: Float64,
    cosine: Float64,
    again: Float64 | float = 1.0,
) -> Facets:
    """Facets of weight 1; where `again` is 0 the light between them is lost."""
    ior, roughness = index_and_roughness
    everything, mean = energy.albedo("facets", np.ones(len(cosine)), roughness, cosine)
    reflected, _ = energy.albedo("gloss", ior, roughness, cosine)
    factor = energy_factor(everything, mean, shifted(fresnel_mean(ior), shift))
    factor = np.where(np.broadcast_to(again, cosine.shape)[:, None] > 0.0, factor, 1.0)
    albedo = (reflected[:, None] + shift * (everything - reflected)[:, None]) * factor
    return Facets(factor, ior, shift, albedo)


def facets_factor(material: Material, cosine: Float64, reflectance: Float64) -> Float64:
    """(n, 3) energy factor of metal whose mean reflectance is `reflectance`."""
    at, mean = material.energy.albedo("facets", np.ones(len(cosine)), np.sqrt(material.alpha), cosine)
    factor = energy_factor(at, mean, reflectance)
    return np.where(material.column["multiscatter"][:, None] > 0.0, factor, 1.0)


def glass_factor(material: Material, eta: Float64, cosine: Float64) -> Float64:
    """(n, 3) energy factor of the interface, whose tint stands for its mean reflectance."""
    scaled = material.column["multiscatter"] > 0.0
    scaled = scaled & (material.transmission > 0.0) & reflects(material)
    at, mean = np.ones(len(cosine)), np.ones(len(cosine))
    if np.any(scaled):
        roughness = np.sqrt(material.alpha)[scaled]
        at[scaled], mean[scaled] = material.energy.albedo("glass", eta[scaled], roughness, cosine[scaled])
    return energy_factor(at, mean, np.sqrt(material.base))


def reflects(material: Material) -> NDArray[np.bool_]:
    """Whether the interface reflects."""
    return material.column["interface"] != INTERFACES.index("refraction_only")


def choose_lobes(
    material: Material, lobes: tuple[Weights, Facets, Facets], cosine: Float64, reflected: Float64
) -> Float64:
    """(n, 7) any choice above zero wherever light can go is right; near the reflected share is quiet."""
    weights, gloss, coat = lobes
    ideal = material.alpha < IDEAL_ALPHA
    share = np.where(ideal, reflected, np.clip(reflected, 0.1, 0.9))
    metal, glass, diffuse, sheen = (
        part.max(axis=1) for part in (weights.metal, weights.glass, weights.diffuse, weights.sheen)
    )
    top, bottom = (
        facets.weight.max(axis=1) * np.clip(fresnel_dielectric(cosine, facets.ior), 0.05, 1.0)
        for facets in (coat, gloss)
    )
    bottom = np.where(gloss.ior == 1.0, 0.0, bottom)
    parts = [metal, glass * share, glass * (1.0 - share), bottom, diffuse, top, sheen]
    choice = np.stack(parts, axis=1)
    total = choice.sum(axis=1, keepdims=True)
    return choice / np.where(total > 0.0, total, 1.0)


def glass_colors(bsdf: Bsdf, cosine: Float64) -> tuple[Float64, Float64]:
    """(n, 3) what the interface reflects and passes at `cosine` to the facet, tints included."""
    material = bsdf.surface.material
    fresnel = fresnel_dielectric(cosine, bsdf.eta)
    tint = np.sqrt(material.base)
    shift = fresnel_shift(material.ior, material.color("specular_tint"))
    stained = material.column["interface"] == INTERFACES.index("stained")
    reflected = shifted(fresnel, shift) * np.where(stained[:, None], tint, 1.0)
    passed = (1.0 - fresnel)[:, None] * (1.0 - shift) * tint
    alone = ~reflects(material)
    whole = (fresnel < 1.0)[:, None] * (1.0 - shift) * tint
    return np.where(alone[:, None], 0.0, reflected), np.where(alone[:, None], whole, passed)


def evaluate_bsdf(bsdf: Bsdf, wi_world: Float64) -> tuple[Float64, Float64]:
    """BSDF times |wi.Ns| (n, 3) and density (n,) of all lobes that are no delta."""
    wi = bsdf.frame.to_local(wi_world)
    above_geometry = dot(wi_world, bsdf.surface.ng) > 0.0
    value, pdf = np.zeros((len(wi), 3)), np.zeros(len(wi))
    up = above_geometry & (wi[:, 2] > 0.0)
    down = ~above_geometry & (wi[:, 2] < 0.0)
    turned = is_turned(bsdf)
    for rows, lobes in (
        (up & ~bsdf.ideal, evaluate_reflection),
        (up & (bsdf.coat_alpha >= IDEAL_ALPHA), evaluate_coat),
        (np.where(turned, down, up), evaluate_diffuse),
        (down & ~bsdf.straight, evaluate_refraction),
    ):
        lobe_value, lobe_pdf = lobes(bsdf, wi)
        value += np.where(rows[:, None], lobe_value, 0.0)
        pdf += np.where(rows, lobe_pdf, 0.0)
    return value, pdf


def evaluate_reflection(bsdf: Bsdf, wi: Float64) -> tuple[Float64, Float64]:
    """GGX reflection of metal, glass and gloss: D G F / (4 cos cos), times cos."""
    alpha = np.maximum(bsdf.surface.material.alpha, IDEAL_ALPHA)
    share = bsdf.choice[:, METAL] + bsdf.choice[:, GLASS_REFLECTION] + bsdf.choice[:, GLOSS]
    facets, density, cosine = evaluate_facets(bsdf, wi, alpha)
    return facets[:, None] * reflected_color(bsdf, cosine), share * density


def evaluate_facets(bsdf: Bsdf, wi: Float64, alpha: Float64) -> tuple[Float64, Float64, Float64]:
    """D G / (4 cos), the density of the mirrored visible normal, and the cosine to it; all (n,)."""
    m = normalize(bsdf.wo + wi)
    cosine = dot(bsdf.wo, m)
    facets = ggx_distribution(m, alpha) * smith_shadowing(bsdf.wo, wi, alpha) / (4.0 * bsdf.wo[:, 2])
    return facets, pdf_visible_normal(bsdf.wo, m, alpha) / (4.0 * np.maximum(cosine, 1e-300)), cosine


def reflected_color(bsdf: Bsdf, cosine: Float64) -> Float64:
    """(n, 3) Fresnel factors of the three reflecting lobes of the base at `cosine`, by their weights."""
    gloss = bsdf.gloss.weight * shifted(fresnel_dielectric(cosine, bsdf.gloss.ior), bsdf.gloss.shift)
    return (
        bsdf.weights.metal * bsdf.metal.at(cosine)
        + bsdf.weights.glass * glass_colors(bsdf, cosine)[0]
        + np.where((bsdf.gloss.ior == 1.0)[:, None], 0.0, gloss)
    )


def evaluate_coat(bsdf: Bsdf, wi: Float64) -> tuple[Float64, Float64]:
    if not np.any(bsdf.coat.weight):
        return np.zeros((len(wi), 3)), np.zeros(len(wi))
    facets, density, cosine = evaluate_facets(bsdf, wi, np.maximum(bsdf.coat_alpha, IDEAL_ALPHA))
    value = facets * fresnel_dielectric(cosine, bsdf.coat.ior)
    return value[:, None] * bsdf.coat.weight, bsdf.choice[:, COAT] * density


def evaluate_diffuse(bsdf: Bsdf, wi: Float64) -> tuple[Float64, Float64]:
    """The diffuse base, and the sheen over everything."""
    material = bsdf.surface.material
    wi = flipped(wi, is_turned(bsdf))
    base = rough_diffuse(material.base, material.column["diffuse_roughness"], bsdf.wo, wi)
    fibres = eval_sheen(bsdf.sheen, wi) if np.any(bsdf.weights.sheen) else np.zeros(len(wi))
    value = bsdf.weights.diffuse * base + bsdf.weights.sheen * fibres[:, None]
    cosine = np.maximum(wi[:, 2], 0.0) / np.pi
    return value, bsdf.choice[:, DIFFUSE] * cosine + bsdf.choice[:, SHEEN] * fibres


def evaluate_refraction(bsdf: Bsdf, wi: Float64) -> tuple[Float64, Float64]:
    """Rough glass (Walter et al. 2007, equation 21), radiance not scaled by eta^2 at the interface."""
    alpha = np.maximum(bsdf.surface.material.alpha, IDEAL_ALPHA)
    m = normalize(-(bsdf.wo + bsdf.eta[:, None] * wi))
    m = np.where(m[:, 2:3] < 0.0, -m, m)
    cos_o, cos_i = dot(bsdf.wo, m), dot(wi, m)
    denominator = cos_o + bsdf.eta * cos_i
    bends = (cos_o > 0.0) & (cos_i < 0.0) & (denominator != 0.0)
    jacobian = bsdf.eta**2 * np.abs(cos_i) / np.where(bends, denominator * denominator, 1.0)
    passed = bsdf.weights.glass * glass_colors(bsdf, cos_o)[1]
    facets = ggx_distribution(m, alpha) * smith_shadowing(bsdf.wo, wi, alpha) * cos_o / bsdf.wo[:, 2]
    value = np.where(bends, facets * jacobian, 0.0)[:, None] * passed
    pdf = bsdf.choice[:, GLASS_REFRACTION] * pdf_visible_normal(bsdf.wo, m, alpha) * jacobian
    return value, np.where(bends, pdf, 0.0)


def is_turned(bsdf: Bsdf) -> NDArray[np.bool_]:
    """(n,) whether the diffuse base shines on the far side."""
    return bsdf.surface.material.column["translucent"] > 0.0


def flipped(wi: Float64, rows: NDArray[np.bool_]) -> Float64:
    """Local directions, those of `rows` mirrored to the other side."""
    return wi * np.where(rows[:, None], (1.0, 1.0, -1.0), 1.0)


def sample_bsdf(bsdf: Bsdf, rng: np.random.Generator) -> Scattered:
    """Picks one lobe a path and goes on along it; weight and density are those of the whole mixture."""
    count = len(bsdf.wo)
    lobe = np.minimum((rng.random(count)[:, None] >= np.cumsum(bsdf.choice, axis=1)).sum(axis=1), SHEEN)
    wi = draw_directions(bsdf, lobe, rng)
    wi = flipped(wi, (lobe == DIFFUSE) & is_turned(bsdf))
    wi_world = normalize(bsdf.frame.to_world(wi))
    # Deltas carry their own weight, everything else that of the mixture.
    value, pdf = evaluate_bsdf(bsdf, wi_world)
    # A facet may send light through the surface: its lobe ends there, the density knows nothing of it.
    down = (lobe == GLASS_REFRACTION) | ((lobe == DIFFUSE) & is_turned(bsdf))
    pdf = np.where(np.where(down, -wi[:, 2], wi[:, 2]) > 0.0, pdf, 0.0)
    weight = value / np.where(pdf > 0.0, pdf, np.inf)[:, None]
    delta = bsdf.ideal & (lobe < DIFFUSE) | (bsdf.straight & (lobe == GLASS_REFRACTION))
    delta |= (lobe == COAT) & (bsdf.coat_alpha < IDEAL_ALPHA)
    weight = np.where(delta[:, None], delta_weight(bsdf, lobe, wi_world), weight)
    return Scattered(wi_world, weight, np.where(delta, np.inf, pdf))


def draw_directions(bsdf: Bsdf, lobe: NDArray[np.int64], rng: np.random.Generator) -> Float64:
    """(n, 3) local directions of the picked lobes; ideal facets are the shading normal itself."""
    alpha = np.where(lobe == COAT, bsdf.coat_alpha, bsdf.surface.material.alpha)
    m = sample_visible_normal(rng, bsdf.wo, np.maximum(alpha, IDEAL_ALPHA))
    m = np.where((alpha < IDEAL_ALPHA)[:, None], [[0.0, 0.0, 1.0]], m)
    cos_o = dot(bsdf.wo, m)
    wi = 2.0 * cos_o[:, None] * m - bsdf.wo
    wi = np.where((lobe == GLASS_REFRACTION)[:, None], refract(bsdf, m, cos_o), wi)
    wi = np.where((lobe == DIFFUSE)[:, None], sample_cosine(rng, len(lobe)), wi)
    if not np.any(lobe == SHEEN):
        return wi
    return np.where((lobe == SHEEN)[:, None], sample_sheen(bsdf.sheen, rng), wi)


def refract(bsdf: Bsdf, m: Float64, cos_o: Float64) -> Float64:
    """Snell's law at the facet; 0 where everything is reflected; straight on where no index changes."""
    bend_squared = 1.0 - (1.0 - cos_o * cos_o) / bsdf.eta**2
    cos_t = np.sqrt(np.maximum(bend_squared, 0.0))
    wi = -bsdf.wo / bsdf.eta[:, None] + (cos_o / bsdf.eta - cos_t)[:, None] * m
    wi = np.where((bend_squared > 0.0)[:, None], wi, 0.0)
    return np.where((bsdf.straight & ~bsdf.ideal)[:, None], -bsdf.wo, wi)


def delta_weight(bsdf: Bsdf, lobe: NDArray[np.int64], wi_world: Float64) -> Float64:
    """Weight of the picked delta lobe over the chance of picking it; 0 on the wrong side."""
    surface, cosine = bsdf.surface, bsdf.wo[:, 2]
    reflected, passed = glass_colors(bsdf, cosine)
    gloss = bsdf.gloss.weight * shifted(fresnel_dielectric(cosine, bsdf.gloss.ior), bsdf.gloss.shift)
    by_lobe = [
        bsdf.weights.metal * bsdf.metal.at(cosine),
        bsdf.weights.glass * reflected,
        # An interface that does not bend light is as good as not there, rough or not.
        bsdf.weights.glass * passed,
        gloss,
        0.0 * gloss,
        bsdf.coat.weight * fresnel_dielectric(cosine, bsdf.coat.ior)[:, None],
        0.0 * gloss,
    ]
    rows = np.arange(len(cosine))
    chance = bsdf.choice[rows, lobe]
    weight = np.stack(by_lobe, axis=1)[rows, lobe] / np.where(chance > 0.0, chance, np.inf)[:, None]
    side = np.where(lobe == GLASS_REFRACTION, -1.0, 1.0)
    right_side = (side * dot(wi_world, surface.ng) > 0.0) & (side * dot(wi_world, surface.ns) > 0.0)
    return np.where(right_side[:, None], weight, 0.0)
