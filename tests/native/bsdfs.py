"""One material's lobes, as the native core has them: values, densities, samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trg_native

from trg_blender.engine.scene_arrays import MATERIAL_FIELDS, Float64, Material, pack_table


def packed(material: Material) -> np.ndarray:
    return pack_table([material], MATERIAL_FIELDS)[0]


def view(degrees: float, azimuth: float = 0.7) -> np.ndarray:
    """Unit direction at `degrees` from the normal."""
    angle = np.radians(degrees)
    return np.array(
        [np.sin(angle) * np.cos(azimuth), np.sin(angle) * np.sin(azimuth), np.cos(angle)], np.float32
    )


@dataclass(frozen=True, slots=True)
class Samples:
    wi: Float64
    weight: Float64
    pdf: Float64


def evaluate(material: Material, wo: np.ndarray, wi: np.ndarray, outside: bool = True):
    """Value times cosine (n, 3) and density (n,) for one `wo` (3,) or many (n, 3)."""
    wi = np.ascontiguousarray(wi, dtype=np.float32)
    wo = np.ascontiguousarray(np.broadcast_to(wo, wi.shape), dtype=np.float32)
    value, pdf = np.empty_like(wi), np.empty(len(wi), np.float32)
    trg_native.bsdf_eval(packed(material), wo, wi, outside, value, pdf)
    return value.astype(np.float64), pdf.astype(np.float64)


def sample(material: Material, wo: np.ndarray, count: int, outside: bool = True, seed: int = 1) -> Samples:
    """`count` draws seen from `wo` (3,), stratified in the lobe."""
    rng = np.random.default_rng(seed)
    uniforms = rng.random((count, 3))
    uniforms[:, 0] = (np.arange(count) + uniforms[:, 0]) / count
    uniforms = np.minimum(uniforms, 1.0 - 2.0**-24).astype(np.float32)
    many = np.ascontiguousarray(np.broadcast_to(wo, (count, 3)), dtype=np.float32)
    wi, weight, pdf = np.empty_like(many), np.empty_like(many), np.empty(count, np.float32)
    trg_native.bsdf_sample(packed(material), many, uniforms, outside, wi, weight, pdf)
    return Samples(wi.astype(np.float64), weight.astype(np.float64), pdf.astype(np.float64))
