"""The error of each pixel from replicate sums, as native/cpu/pixel_error.cpp measures it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .image_error import STUDENT_95
from .scene_arrays import LUMINANCE, Float32, Float64

REACH, WIDE_REACH = 2, 6
"""of the neighbourhoods, in pixels"""
LONELY_SHARE = 0.8
UNSEEN, LONELY = 1, 2


def measure_pixel_error(
    sums: Float64, counts: NDArray[np.int64], half_width: Float32, flags: NDArray[np.uint8]
) -> dict[str, float]:
    """Fills `half_width` (h, w), the 95 % half width of each pixel's luminance, and `flags` (h, w).

    `sums` is (r, h, w, 3), `counts` (r,). The variance is the largest of the pixel's own and the means over
    the five by five and the thirteen by thirteen pixels around it. Flags: 1 no replicate has seen light,
    2 one makes four fifths of the spread.
    Gives the fields of image_error.Evidence. All 0 below two replicates.
    """
    half_width[...], flags[...] = 0.0, 0
    used = counts > 0
    replicates = int(used.sum())
    if replicates < 2:
        return {"lit": 0.0, "unseen": 0.0, "lonely": 0.0, "lonely_error": 0.0, "error_pixels": 0.0}
    weights = counts[used].astype(np.float64)[:, None, None]
    means = (sums[used] @ LUMINANCE) / weights
    mean = (weights * means).sum(axis=0) / weights.sum()
    spread = (weights * (means - mean) ** 2).sum(axis=0)
    variance = spread / ((replicates - 1) * weights.sum())
    total = np.abs(means).sum(axis=0)
    flags[total == 0.0] = UNSEEN
    squares = (means - means.mean(axis=0)) ** 2
    alone = squares.max(axis=0) >= LONELY_SHARE * squares.sum(axis=0)
    if replicates > 2:
        flags[(total > 0.0) & (squares.sum(axis=0) > 0.0) & alone] = LONELY
    around = np.maximum(pooled(variance, REACH), pooled(variance, WIDE_REACH))
    half_width[...] = STUDENT_95[replicates - 1] * np.sqrt(np.maximum(variance, around))
    return evidence_of(pooled(total, REACH) > 0.0, flags, variance)


def evidence_of(lit: NDArray[np.bool_], flags: NDArray[np.uint8], variance: Float64) -> dict[str, float]:
    count, error, squares = (
        max(int(lit.sum()), 1),
        float(variance[lit].sum()),
        float((variance[lit] ** 2).sum()),
    )
    lonely = lit & (flags == LONELY)
    return {
        "lit": float(lit.mean()),
        "unseen": float((lit & (flags == UNSEEN)).sum()) / count,
        "lonely": float(lonely.sum()) / count,
        "lonely_error": float(variance[lonely].sum()) / error if error > 0.0 else 0.0,
        "error_pixels": error**2 / squares if squares > 0.0 else 0.0,
    }


def pooled(values: Float64, reach: int) -> Float64:
    """Mean over the neighbourhood of each pixel, cut at the borders."""
    height, width = values.shape
    total, count = np.zeros((height, width)), np.zeros((height, width))
    up, across = min(reach, height - 1), min(reach, width - 1)
    for dy in range(-up, up + 1):
        for dx in range(-across, across + 1):
            here = np.s_[max(-dy, 0) : height - max(dy, 0), max(-dx, 0) : width - max(dx, 0)]
            there = np.s_[max(dy, 0) : height - max(-dy, 0), max(dx, 0) : width - max(-dx, 0)]
            total[here] += values[there]
            count[here] += 1.0
    return total / count
