"""The material mixture of the reference renderer: docs/architecture.md, section 4, in one place.

Five lobes share out the light: metal and the two reflections (glass, coat) go up by GGX, the glass
refraction goes down, the diffuse base goes up by cosine. Narrow GGX (alpha below IDEAL_ALPHA) is a delta.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .reference_fresnel import fresnel_dielectric, fresnel_mean, fresnel_schlick
from .reference_ggx import (
    ggx_distribution,
    pdf_visible_normal,
    sample_visible_normal,
    smith_lambda,
    smith_shadowing,
)
from .reference_math import Frame, build_frame, dot, normalize, sample_cosine
from .reference_surface import IDEAL_ALPHA, Surface
from .scene_arrays import Float64

METAL, GLASS_REFLECTION, GLASS_REFRACTION, COAT, DIFFUSE = range(5)
SAME_INDEX = 1e-4
"""A dielectric whose index differs less from its surroundings does not bend light."""


@dataclass(frozen=True, slots=True)
class Bsdf:
    """The mixture at n points. Directions are local: z is the shading normal, wo.z > 0."""

    surface: Surface
    frame: Frame
    wo: Float64
    eta: Float64
    """glass: index behind the surface over index before it, seen from wo"""
    metal: Float64
    glass: Float64
    opaque: Float64
    """shares of the three kinds, sum 1"""
    ideal: NDArray[np.bool_]
    """GGX reflections are deltas"""
    straight: NDArray[np.bool_]
    """the refraction is a delta"""
    choice: Float64
    """(n, 5) probability of picking each lobe"""


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
    eta = np.where(surface.outside, material.ior, 1.0 / material.ior)
    metal = material.metallic
    glass = (1.0 - metal) * material.transmission
    opaque = (1.0 - metal) * (1.0 - material.transmission)
    ideal = material.alpha < IDEAL_ALPHA
    straight = ideal | (np.abs(material.ior - 1.0) < SAME_INDEX)
    # Any choice above zero wherever light can go is right; near the reflected share is quiet.
    reflected = fresnel_dielectric(wo[:, 2], eta)
    reflected = np.where(ideal, reflected, np.clip(reflected, 0.1, 0.9))
    coat = np.clip(coat_fresnel(surface, wo[:, 2]), 0.1, 0.9)
    choice = np.stack(
        [metal, glass * reflected, glass * (1.0 - reflected), opaque * coat, opaque * (1.0 - coat)], axis=1
    )
    return Bsdf(surface, frame, wo, eta, metal, glass, opaque, ideal, straight, choice)


def coat_fresnel(surface: Surface, cosine: Float64) -> Float64:
    """Reflected share of the opaque dielectric's surface."""
    material = surface.material
    return np.minimum(1.0, material.specular * fresnel_dielectric(cosine, material.ior))


def evaluate_bsdf(bsdf: Bsdf, wi_world: Float64) -> tuple[Float64, Float64]:
    """BSDF times |wi.Ns| (n, 3) and density (n,) of all lobes that are no delta."""
    wi = bsdf.frame.to_local(wi_world)
    above_geometry = dot(wi_world, bsdf.surface.ng) > 0.0
    value, pdf = np.zeros((len(wi), 3)), np.zeros(len(wi))
    up = above_geometry & (wi[:, 2] > 0.0)
    down = ~above_geometry & (wi[:, 2] < 0.0)
    for rows, lobes in (
        (up & ~bsdf.ideal, evaluate_reflection),
        (up, evaluate_diffuse),
        (down & ~bsdf.straight, evaluate_refraction),
    ):
        lobe_value, lobe_pdf = lobes(bsdf, wi)
        value += np.where(rows[:, None], lobe_value, 0.0)
        pdf += np.where(rows, lobe_pdf, 0.0)
    return value, pdf


def evaluate_reflection(bsdf: Bsdf, wi: Float64) -> tuple[Float64, Float64]:
    """GGX reflection of metal, glass and coat: D G F / (4 cos cos), times cos."""
    alpha = np.maximum(bsdf.surface.material.alpha, IDEAL_ALPHA)
    m = normalize(bsdf.wo + wi)
    cosine = dot(bsdf.wo, m)
    facets = ggx_distribution(m, alpha) * smith_shadowing(bsdf.wo, wi, alpha) / (4.0 * bsdf.wo[:, 2])
    share = bsdf.choice[:, METAL] + bsdf.choice[:, GLASS_REFLECTION] + bsdf.choice[:, COAT]
    pdf = share * pdf_visible_normal(bsdf.wo, m, alpha) / (4.0 * np.maximum(cosine, 1e-300))
    return facets[:, None] * reflected_color(bsdf, cosine), pdf


def reflected_color(bsdf: Bsdf, cosine: Float64) -> Float64:
    """(n, 3) Fresnel factors of the three reflecting lobes at `cosine` to the facet, by their shares."""
    metal = bsdf.metal[:, None] * fresnel_schlick(cosine, bsdf.surface.material.base)
    glass = bsdf.glass * fresnel_dielectric(cosine, bsdf.eta)
    coat = bsdf.opaque * coat_fresnel(bsdf.surface, cosine)
    return metal + (glass + coat)[:, None]


def evaluate_diffuse(bsdf: Bsdf, wi: Float64) -> tuple[Float64, Float64]:
    """The base below the coat: what enters and leaves, both ways (Ashikhmin and Shirley 2000 in form)."""
    material = bsdf.surface.material
    enters = 1.0 - coat_fresnel(bsdf.surface, wi[:, 2])
    leaves = 1.0 - coat_fresnel(bsdf.surface, bsdf.wo[:, 2])
    mean = np.minimum(material.specular * fresnel_mean(material.ior), 1.0 - 1e-6)
    cosine = np.maximum(wi[:, 2], 0.0) / np.pi
    value = bsdf.opaque * enters * leaves / (1.0 - mean) * cosine
    return value[:, None] * material.base, bsdf.choice[:, DIFFUSE] * cosine


def evaluate_refraction(bsdf: Bsdf, wi: Float64) -> tuple[Float64, Float64]:
    """Rough glass (Walter et al. 2007, equation 21), radiance not scaled by eta^2 at the interface."""
    alpha = np.maximum(bsdf.surface.material.alpha, IDEAL_ALPHA)
    m = normalize(-(bsdf.wo + bsdf.eta[:, None] * wi))
    m = np.where(m[:, 2:3] < 0.0, -m, m)
    cos_o, cos_i = dot(bsdf.wo, m), dot(wi, m)
    denominator = cos_o + bsdf.eta * cos_i
    bends = (cos_o > 0.0) & (cos_i < 0.0) & (denominator != 0.0)
    jacobian = bsdf.eta**2 * np.abs(cos_i) / np.where(bends, denominator * denominator, 1.0)
    passed = bsdf.glass * (1.0 - fresnel_dielectric(cos_o, bsdf.eta))
    facets = ggx_distribution(m, alpha) * smith_shadowing(bsdf.wo, wi, alpha) * cos_o / bsdf.wo[:, 2]
    value = np.where(bends, passed * facets * jacobian, 0.0)[:, None] * np.sqrt(bsdf.surface.material.base)
    pdf = bsdf.choice[:, GLASS_REFRACTION] * pdf_visible_normal(bsdf.wo, m, alpha) * jacobian
    return value, np.where(bends, pdf, 0.0)


def sample_bsdf(bsdf: Bsdf, rng: np.random.Generator) -> Scattered:
    """Picks one lobe a path and goes on along it; weight and density are those of the whole mixture."""
    count = len(bsdf.wo)
    lobe = np.minimum((rng.random(count)[:, None] >= np.cumsum(bsdf.choice, axis=1)).sum(axis=1), DIFFUSE)
    # Directions of all kinds; ideal facets are the shading normal itself.
    alpha = np.maximum(bsdf.surface.material.alpha, IDEAL_ALPHA)
    m = np.where(bsdf.ideal[:, None], [[0.0, 0.0, 1.0]], sample_visible_normal(rng, bsdf.wo, alpha))
    cos_o = dot(bsdf.wo, m)
    reflected = 2.0 * cos_o[:, None] * m - bsdf.wo
    refracted = refract(bsdf, m, cos_o)
    wi = np.where((lobe == GLASS_REFRACTION)[:, None], refracted, reflected)
    wi = np.where((lobe == DIFFUSE)[:, None], sample_cosine(rng, count), wi)
    wi_world = normalize(bsdf.frame.to_world(wi))
    # Deltas carry their own weight, everything else that of the mixture.
    value, pdf = evaluate_bsdf(bsdf, wi_world)
    # A facet may send light through the surface: its lobe ends there, the density knows nothing of it.
    pdf = np.where(np.where(lobe == GLASS_REFRACTION, -wi[:, 2], wi[:, 2]) > 0.0, pdf, 0.0)
    weight = value / np.where(pdf > 0.0, pdf, np.inf)[:, None]
    delta = (bsdf.ideal & (lobe != DIFFUSE)) | (bsdf.straight & (lobe == GLASS_REFRACTION))
    weight = np.where(delta[:, None], delta_weight(bsdf, lobe, wi_world), weight)
    return Scattered(wi_world, weight, np.where(delta, np.inf, pdf))


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
    fresnel = fresnel_dielectric(cosine, bsdf.eta)
    ones = np.ones((len(cosine), 3))
    # Rough glass that does not bend light still masks it: the limit of evaluate_refraction.
    masked = masking_straight_on(bsdf)
    by_lobe = [
        bsdf.metal[:, None] * fresnel_schlick(cosine, surface.material.base),
        (bsdf.glass * fresnel)[:, None] * ones,
        (bsdf.glass * (1.0 - fresnel) * masked)[:, None] * np.sqrt(surface.material.base),
        (bsdf.opaque * coat_fresnel(surface, cosine))[:, None] * ones,
        0.0 * ones,
    ]
    rows = np.arange(len(cosine))
    chance = bsdf.choice[rows, lobe]
    weight = np.stack(by_lobe, axis=1)[rows, lobe] / np.where(chance > 0.0, chance, np.inf)[:, None]
    side = np.where(lobe == GLASS_REFRACTION, -1.0, 1.0)
    right_side = (side * dot(wi_world, surface.ng) > 0.0) & (side * dot(wi_world, surface.ns) > 0.0)
    return np.where(right_side[:, None], weight, 0.0)


def masking_straight_on(bsdf: Bsdf) -> Float64:
    """G2 / G1 of light that goes straight on through facets; 1 for an ideal interface."""
    hidden = smith_lambda(bsdf.wo, bsdf.surface.material.alpha)
    return np.where(bsdf.ideal, 1.0, (1.0 + hidden) / (1.0 + 2.0 * hidden))
