"""One material's lobes, as the native core has them and as the reference does: values, densities, samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..engine import reference_surface
from ..engine.native import load_native
from ..engine.reference_bsdf import build_bsdf, evaluate_bsdf
from ..engine.reference_energy import EnergyTables
from ..engine.reference_points import Points
from ..engine.reference_surface import Surface
from ..engine.scene_arrays import MATERIAL_FIELDS, Float32, Float64, Material, pack_table


def packed(material: Material) -> Float32:
    return pack_table([material], MATERIAL_FIELDS)[0]


def view(degrees: float, azimuth: float = 0.7) -> Float32:
    """Unit direction at `degrees` from the normal."""
    angle = np.radians(degrees)
    return np.array(
        [np.sin(angle) * np.cos(azimuth), np.sin(angle) * np.sin(azimuth), np.cos(angle)], np.float32
    )


BELOW_ONE = 1.0 - 2.0**-24
"""the largest uniform"""


@dataclass(frozen=True, slots=True)
class Samples:
    wi: Float64
    weight: Float64
    pdf: Float64


def evaluate(material: Material, wo: Float32, wi: Float32, outside: bool = True) -> tuple[Float64, Float64]:
    """Value times cosine (n, 3) and density (n,) for one `wo` (3,) or many (n, 3)."""
    wi = np.ascontiguousarray(wi, dtype=np.float32)
    wo = np.ascontiguousarray(np.broadcast_to(wo, wi.shape), dtype=np.float32)
    value, pdf = np.empty_like(wi), np.empty(len(wi), np.float32)
    load_native().bsdf_eval(packed(material), wo, wi, outside, value, pdf)
    return value.astype(np.float64), pdf.astype(np.float64)


def sample(material: Material, wo: Float32, count: int, outside: bool = True, seed: int = 1) -> Samples:
    """`count` draws seen from `wo` (3,), stratified in the lobe."""
    rng = np.random.default_rng(seed)
    uniforms = rng.random((count, 3))
    uniforms[:, 0] = (np.arange(count) + uniforms[:, 0]) / count
    return draw(material, wo, np.minimum(uniforms, BELOW_ONE).astype(np.float32), outside)


def draw(material: Material, wo: Float32, uniforms: Float32, outside: bool = True) -> Samples:
    """One sample for each row of `uniforms` (n, 3): the choice of the lobe, and two for the direction."""
    count = len(uniforms)
    many = np.ascontiguousarray(np.broadcast_to(wo, (count, 3)), dtype=np.float32)
    wi, weight, pdf = np.empty_like(many), np.empty_like(many), np.empty(count, np.float32)
    load_native().bsdf_sample(packed(material), many, uniforms, outside, wi, weight, pdf)
    return Samples(wi.astype(np.float64), weight.astype(np.float64), pdf.astype(np.float64))


def evaluate_reference(
    material: Material, wo: Float32, wi: Float32, outside: bool = True
) -> tuple[Float64, Float64]:
    """The same as `evaluate` in double precision, of the same single-precision numbers."""
    count = len(wi)
    column = {
        name: np.full(count, float(x)) for name, x in zip(MATERIAL_FIELDS, packed(material), strict=True)
    }
    colors = [np.stack([column[f"{name}_{c}"] for c in "rgb"], axis=1) for name in ("base", "emission")]
    values = reference_surface.Material(
        colors[0],
        column["metallic"],
        column["roughness"] ** 2,
        column["ior"],
        column["specular"],
        column["transmission"],
        colors[1],
        column,
        EnergyTables(),
    )
    seen = np.broadcast_to(wo, wi.shape).astype(np.float64)
    up, place, row, side = (
        np.tile([0.0, 0.0, 1.0], (count, 1)),
        np.zeros((count, 3)),
        np.zeros(count, np.int64),
        np.full(count, outside),
    )
    points = Points(row, row * 0.0, row * 0.0, place[:, :2], place, up, up, seen, side)
    surface = Surface(place, seen, up, up, side, values, np.full(count, 1e-6), row, points)
    return evaluate_bsdf(build_bsdf(surface), wi.astype(np.float64))
