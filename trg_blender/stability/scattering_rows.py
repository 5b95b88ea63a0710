"""Rows of the lobes of the native core, without any picture: B01 to B09."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from ..engine.reference_fresnel import fresnel_dielectric
from ..engine.scene_arrays import Float32, Float64, Material
from .case import CORE, Case, NotApplicable, Outcome, Row, within
from .chi_square import RINGS, SECTORS, chi_square_score, expected_shares, facet_bins
from .lobes import BELOW_ONE, draw, evaluate, sample, view

SMOOTH_ALPHA = 1e-3
"""Below it a surface is an ideal mirror: there is no distribution to be measured."""
IDEAL = "alpha below 1e-3 is an ideal mirror"
ANGLES = (0.0, 45.0, 80.0, 89.0)
WHITE = {"base_r": 1.0, "base_g": 1.0, "base_b": 1.0}


def bare_metal(alpha: float) -> tuple[Material, float]:
    """Facets that reflect everything, without what repeated scattering adds, and the alpha that they get."""
    if alpha < SMOOTH_ALPHA:
        raise NotApplicable(IDEAL)
    # A hair more, so that rounding does not make it a mirror.
    roughness = np.float32(min(np.sqrt(alpha) * (1 + 1e-6), 1.0))
    metal = Material(**WHITE, metallic=1.0, roughness=float(roughness), multiscatter=0.0, metal_grazing=0.0)
    return metal, float(roughness) ** 2


def density_of_normals(alpha: float) -> Row:
    """B01: D seen from straight above (a quarter of it is the density of the mirrored direction)."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        metal, a = bare_metal(alpha)
        rng = np.random.default_rng(seed)
        tan, turn = a * 10.0 ** rng.uniform(-3, 3, count), rng.uniform(0, 2 * np.pi, count)
        tan = np.minimum(tan, 0.99)
        scale = 1 / (1 + tan * tan)
        wi = (
            np.stack([2 * tan * np.cos(turn), 2 * tan * np.sin(turn), 1 - tan * tan], axis=1) * scale[:, None]
        )
        given = wi.astype(np.float32)
        _, pdf = evaluate(metal, np.float32([0, 0, 1]), given)
        x, y, z = given.astype(np.float64).T
        tan2 = (x * x + y * y) / (1 + z) ** 2
        exact = (1 + tan2) ** 2 / (np.pi * a * a * (1 + tan2 / (a * a)) ** 2)
        return within(float(np.abs(4 * pdf / exact - 1).max()), 1e-5)

    return row


def visible_normal(wo: Float64, alpha: float, u: Float64, v: Float64) -> Float64:
    """Of spherical caps (Dupuy and Benyoub 2023) in double precision."""
    stretched = wo * [alpha, alpha, 1.0]
    stretched /= np.linalg.norm(stretched, axis=1, keepdims=True)
    z = (1 - v) * (1 + stretched[:, 2]) - stretched[:, 2]
    r, phi = np.sqrt(np.maximum(0, (1 - z) * (1 + z))), 2 * np.pi * u
    h = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1) + stretched
    h *= [alpha, alpha, 1.0]
    return h / np.linalg.norm(h, axis=1, keepdims=True)


def grazing_samples(alpha: float) -> Row:
    """B02: directions seen at cosines down to 1e-12, the ends of the uniforms among them."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        metal, a = bare_metal(alpha)
        worst, bad = 0.0, 0
        for cosine in (1e-2, 1e-3, 1e-4, 1e-6, 1e-12):
            wo = np.float32([np.sqrt(1 - cosine * cosine), 0, cosine])
            uniforms = np.random.default_rng(1 + seed).random((count, 3))
            uniforms[: count // 2, 1:] = np.round(uniforms[: count // 2, 1:])
            uniforms = np.minimum(uniforms, BELOW_ONE).astype(np.float32)
            drawn = draw(metal, wo, uniforms)
            kept = drawn.pdf >= 0
            fine = np.isfinite(drawn.wi).all(axis=1) & np.isfinite(drawn.weight).all(axis=1)
            unit = np.abs(np.linalg.norm(drawn.wi, axis=1) - 1) < 1e-5
            bad += int((~fine | (kept & ~(unit & (drawn.pdf > 0)))).sum())
            seen = np.broadcast_to(wo.astype(np.float64), drawn.wi.shape)
            u, v = uniforms[:, 1].astype(np.float64), uniforms[:, 2].astype(np.float64)
            h = visible_normal(seen, a, u, v)
            exact = 2 * (seen * h).sum(axis=1)[:, None] * h - seen
            off = np.linalg.norm(drawn.wi - exact, axis=1) / a
            worst = max(worst, float(off[kept].max(initial=0.0)))
        return Outcome(bad + (worst > 1e-2), 5 * count, f"{bad} bad, angle/alpha {worst:.1e}")

    return row


def furnace(material: Material, outside: bool, low: float, high: float) -> Row:
    """B03, B04: mean weight of samples where nothing is absorbed, at every angle."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        found, failed = [], False
        for angle in ANGLES:
            weight = sample(material, view(angle), count, outside, seed=1 + seed).weight[:, 0]
            noise = 4 * weight.std() / np.sqrt(count)
            found.append(weight.mean())
            failed |= not (low - noise <= weight.mean() <= high + noise)
        return Outcome(int(failed), 1, f"{min(found):.5f} to {max(found):.5f}")

    return row


def weak_furnace(alpha: float, angle: float) -> Row:
    """B05: the density of mirrored visible normals over all of them: the native one where they mirror above
    the surface, the formula where below. Quadrature of slopes."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        metal, a = bare_metal(alpha)
        wo = view(angle).astype(np.float64)
        h, measure = slope_grid(a, count)
        along = h @ wo
        wi = 2 * along[:, None] * h - wo
        cosine4 = np.maximum(h[:, 2], 1e-300) ** 4
        density = a**2 / (np.pi * cosine4 * (a**2 + 1 / h[:, 2] ** 2 - 1) ** 2)
        masked = 2 / (1 + np.sqrt(1 + a**2 * (1 / wo[2] ** 2 - 1)))
        formula = masked * np.maximum(along, 0) * density / wo[2]
        above = (wi[:, 2] > 0) & (along > 0)
        pdf = np.zeros(len(h))
        pdf[above] = evaluate(metal, wo.astype(np.float32), wi[above].astype(np.float32))[1]
        shares = np.where(above, 4 * along * pdf, formula) * measure
        return within(abs(shares.sum() - 1), 1e-4, what="off by")

    return row


def slope_grid(alpha: float, count: int) -> tuple[Float64, Float64]:
    """About `count` unit normals (n, 3) that cover all slopes, and the solid angle of each (n,)."""
    rings, sectors = int(np.sqrt(2 * count)), int(np.sqrt(count / 2))
    ring, turn = (
        (np.arange(rings) + 0.5) / rings * 0.5 * np.pi,
        (np.arange(sectors) + 0.5) / sectors * 2 * np.pi,
    )
    ring, turn = (part.ravel() for part in np.meshgrid(ring, turn, indexing="ij"))
    slope = alpha * np.tan(ring) ** 2
    h = np.stack([slope * np.cos(turn), slope * np.sin(turn), np.ones_like(slope)], axis=1)
    h /= np.sqrt(1 + slope * slope)[:, None]
    measure = slope * alpha * 2 * np.tan(ring) / np.cos(ring) ** 2 * h[:, 2] ** 3
    return h, measure * (0.5 * np.pi / rings) * (2 * np.pi / sectors)


def directions_above(count: int, rng: np.random.Generator) -> Float32:
    """Half of them within a hundredth of grazing."""
    rows = rng.normal(size=(count, 3))
    rows[:, 2] = np.abs(rows[:, 2]) + 1e-3
    rows[: count // 2, 2] = rng.uniform(1e-4, 1e-2, count // 2)
    return (rows / np.linalg.norm(rows, axis=1, keepdims=True)).astype(np.float32)


def reciprocity(roughness: float) -> Row:
    """B06: single scattering of a metal over its cosine, both ways."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        metal = Material(0.9, 0.5, 0.3, metallic=1.0, roughness=roughness, multiscatter=0.0)
        rng = np.random.default_rng(3 + seed)
        a, b = directions_above(count, rng), rng.permutation(directions_above(count, rng))
        there = evaluate(metal, a, b)[0] / b[:, 2:].astype(np.float64)
        back = evaluate(metal, b, a)[0] / a[:, 2:].astype(np.float64)
        floor = 1e-6 * np.abs(there).max()
        return within(float((np.abs(there - back) / np.maximum(np.abs(there), floor)).max()), 1e-5)

    return row


KINDS = {
    "metal": {"metallic": 1.0},
    "plastic": {},
    "glass": {"transmission": 1.0},
    "glass from inside": {"transmission": 1.0},
    "coat": {"coat": 1.0, "coat_roughness": 0.3},
    "sheen": {"sheen_r": 1.0, "sheen_g": 1.0, "sheen_b": 1.0},
    "rough diffuse": {"specular": 0.0, "diffuse_roughness": 1.0},
    "all": {"metallic": 0.3, "transmission": 0.4, "coat": 0.5, "coat_roughness": 0.2, "sheen_g": 0.5},
}
WIDTHS = (0.1, 0.3, 1.0)
SEEN = (0.0, 30.0, 60.0, 80.0, 89.9)
LARGEST_SCORE = 3.76
"""Normal quantile of 0.01 shared out among the 120 tests of row B07 (Sidak): 3.76."""


def chi_square(kind: str) -> Row:
    """B07: the largest score of a chi-square test over roughness and angle, 89.9 degrees and total internal
    reflection among them."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        worst, where = -np.inf, ""
        for roughness, angle in product(WIDTHS, SEEN):
            material = Material(**WHITE, roughness=roughness, **KINDS[kind])
            outside, wo = "inside" not in kind, view(angle)
            drawn = sample(material, wo, count, outside, seed=1 + seed)
            kept = drawn.pdf > 0
            if kept.mean() < 1e-3:
                continue
            eta = material.ior if outside else 1 / material.ior
            bins = facet_bins(wo, drawn.wi[kept], eta, roughness**2)
            found = np.bincount(bins, minlength=2 * RINGS * SECTORS)
            expected = expected_shares(material, wo, outside, eta, roughness**2) * count
            score = chi_square_score(found, expected)
            if score > worst:
                worst, where = score, f"roughness {roughness:g}, {angle:g} deg"
        return Outcome(int(worst > LARGEST_SCORE), 1, f"score {worst:.2f} ({where})")

    return row


def reflectance(material: Material, wo: Float32, wi: Float32, outside: bool = True) -> Float64:
    """Fresnel's factor of a rough interface: its value over that of a white metal of the same facets."""
    metal = Material(**WHITE, metallic=1.0, roughness=material.roughness, multiscatter=0.0, metal_grazing=0.0)
    return evaluate(material, wo, wi, outside)[0][:, 0] / evaluate(metal, wo, wi)[0][:, 0]


def mirrored(cosines: Float64) -> tuple[Float32, Float32, Float64]:
    """Directions that mirror each other, and the cosines that they have in single precision."""
    sines = np.sqrt(1 - cosines**2)
    wo = np.stack([sines, 0 * sines, cosines], axis=1).astype(np.float32)
    return wo, (wo * np.float32([-1, 1, 1])).astype(np.float32), wo[:, 2].astype(np.float64)


def nearly_one(excess: float) -> Row:
    """B08: reflectance of a rough interface of index 1 + `excess` against the exact one."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        glass = Material(**WHITE, transmission=1.0, roughness=0.5, ior=1 + excess, multiscatter=0.0)
        wo, wi, cosines = mirrored(np.random.default_rng(seed).uniform(0.05, 1, count))
        eta = np.full(count, float(np.float32(glass.ior)))
        exact = fresnel_dielectric(cosines, eta)
        return within(float(np.abs(reflectance(glass, wo, wi) / exact - 1).max()), 1e-5)

    return row


CRITICAL = np.sqrt(1 - 1 / 1.5**2)
"""cosine within glass"""


def around_critical(count: int, seed: int) -> tuple[Float32, Float32, Float64]:
    """Mirrored directions 1e-1 to 1e-7 to both sides of the critical one, and their cosines."""
    rng = np.random.default_rng(seed)
    return mirrored(CRITICAL * (1 + 10.0 ** rng.uniform(-7, -1, count) * rng.choice([-1, 1], count)))


def from_within(cosines: Float64) -> Float64:
    return fresnel_dielectric(cosines, np.full(len(cosines), 1 / 1.5))


def rough_critical(accel: str, count: int, seed: int = 0) -> Outcome:
    """B09: the reflectance of facets."""
    glass = Material(**WHITE, transmission=1.0, roughness=0.5, multiscatter=0.0)
    wo, wi, cosines = around_critical(count, seed)
    off = np.abs(reflectance(glass, wo, wi, False) - from_within(cosines))
    return within(float(off.max()), 1e-4, count, "|dR|")


def smooth_critical(accel: str, count: int, seed: int = 0) -> Outcome:
    """B09: the uniform at which a smooth interface begins to refract, which is its reflectance."""
    glass = Material(**WHITE, transmission=1.0, roughness=0.0)
    wo, _, cosines = around_critical(count, seed)
    low, high, bad = np.zeros(count), np.full(count, BELOW_ONE), np.zeros(count, bool)
    for _ in range(26):
        middle = np.stack([0.5 * (low + high), 0.5 + 0 * low, 0.5 + 0 * low], axis=1).astype(np.float32)
        drawn = draw(glass, wo, middle, False)
        bad |= ~(np.abs(np.linalg.norm(drawn.wi, axis=1) - 1) < 1e-5)
        reflected = drawn.wi[:, 2] > 0
        low, high = np.where(reflected, middle[:, 0], low), np.where(reflected, high, middle[:, 0])
    off = float(np.abs(0.5 * (low + high) - from_within(cosines)).max())
    return Outcome(int(bad.sum()) + int(not off <= 1e-4), count, f"|dR| {off:.1e}, {int(bad.sum())} not unit")


def cases() -> Iterator[Case]:
    """B01 to B09 without pictures."""
    alphas = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
    for alpha in alphas:
        yield Case("B01", f"alpha {alpha:g}", density_of_normals(alpha), (CORE,), 1_000_000, 10_000)
    for alpha in (1.0, *alphas[:4]):
        yield Case("B02", f"alpha {alpha:g}", grazing_samples(alpha), (CORE,), 1_000_000, 2000)
    for roughness in (0.0, 1e-5, 1e-3, 1e-2, 0.05, 0.1, 0.2, 0.5, 0.8, 1.0):
        metal = Material(**WHITE, metallic=1.0, roughness=roughness)
        yield Case(
            "B03", f"roughness {roughness:g}", furnace(metal, True, 0.995, 1.005), (CORE,), 1_000_000, 4000
        )
    for ior, roughness in product(
        (1.0, 1 + 1e-7, 1 + 1e-4, 1.5, 3.0, 10.0, 100.0, 0.5), (0.0, 0.1, 0.5, 1.0)
    ):
        glass = Material(**WHITE, transmission=1.0, roughness=roughness, ior=ior)
        limits = (1 - 1e-5, 1 + 1e-5) if roughness == 0 else (0.98, 1.01)
        for outside in (True, False):
            name = f"index {ior:.8g}, roughness {roughness:g}, {'outside' if outside else 'inside'}"
            yield Case("B04", name, furnace(glass, outside, *limits), (CORE,), 1_000_000, 2000)
    for alpha, angle in product((1.0, 0.25, 1e-2, 1e-3), (0.0, 60.0, 85.0)):
        yield Case(
            "B05", f"alpha {alpha:g}, {angle:g} deg", weak_furnace(alpha, angle), (CORE,), 4_000_000, 250_000
        )
    for roughness in (0.1, 0.5, 1.0):
        yield Case("B06", f"metal, roughness {roughness:g}", reciprocity(roughness), (CORE,), 100_000, 2000)
    for kind in KINDS:
        yield Case("B07", kind, chi_square(kind), (CORE,), 1_000_000, 20_000)
    for excess in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7):
        yield Case("B08", f"index 1 + {excess:g}", nearly_one(excess), (CORE,), 100_000, 2000)
    yield Case("B09", "smooth glass from inside", smooth_critical, (CORE,), 100_000, 2000)
    yield Case("B09", "rough glass from inside", rough_critical, (CORE,), 1_000_000, 2000)
