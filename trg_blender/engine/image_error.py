"""How far the picture is from the truth, told from the spread of its replicates.

The replicates are independent pictures of the same scene; their mean is the picture. Jackknife: Efron
and Tibshirani 1993, chapter 11, over replicates, on the logarithm of the mean squared error, which keeps
the interval positive and near symmetric.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .scene_arrays import Float64

RELATIVE_FLOOR = 0.01
"""Added to the squared picture below relMSE."""
STUDENT_95 = {1: 12.7062, 2: 4.3027, 3: 3.1824, 4: 2.7764, 5: 2.5706, 6: 2.4469, 7: 2.3646}
"""Two-sided 95 % points of Student's t by degrees of freedom."""


LONELY_ERROR_LIMIT = 0.9
"""From this share on the error cannot be told: benchmarks/calibration.py shows how it holds below."""
ERROR_PIXELS_LIMIT = 3.0
"""Below so many pixels the error hangs on what happened to befall these."""
HITS_LIMIT = 5.0
"""Below so many hits, those that were not met could make the error larger by more than a quarter (rule of
three: of what was never seen 3 may be expected with 95 %; the root of (5 + 3) / 5)."""


@dataclass(frozen=True, slots=True)
class Evidence:
    """What a picture's error is told from; shares from 0 to 1 (native/cpu/pixel_error.h)."""

    lit: float
    """of pixels: light somewhere in the five by five around them"""
    unseen: float
    """of lit pixels: no replicate has seen light"""
    lonely: float
    """of lit pixels: one replicate makes four fifths of the spread"""
    lonely_error: float
    """of the mean squared error: what lonely pixels make of it"""
    error_pixels: float
    """how many pixels make the error: the square of its sum over the sum of its squares"""
    chance_hits: float | None = None
    """how many hits of the brightest light that only chance meets would make it; None: there is none
    (chance_light.py)"""

    @property
    def is_enough(self) -> bool:
        return self.doubt is None

    @property
    def doubt(self) -> str | None:
        """Why the error cannot be told; None where it can (docs/decisions/reliable.md)."""
        if self.chance_hits is not None and self.chance_hits < HITS_LIMIT:
            return (
                f"the error is worth {self.chance_hits:.2g} hits of the brightest light that only chance "
                "meets, by sharp reflections: there may be such light that no sample has met"
            )
        if self.error_pixels < ERROR_PIXELS_LIMIT:
            return f"nearly all of the error lies in {max(round(self.error_pixels), 1)} of the pixels"
        if self.lonely_error >= LONELY_ERROR_LIMIT:
            return (
                f"{self.lonely_error:.0%} of the error lies in {self.lonely:.1%} of the lit pixels, "
                "whose noise one replicate alone has met: rare bright paths"
            )
        return None


@dataclass(frozen=True, slots=True)
class PictureError:
    """Over all pixels and linear RGB; None where too few replicates have samples to tell."""

    rmse: float | None = None
    ci95: tuple[float, float] | None = None
    relmse: float | None = None


def measure_error(sums: Float64, counts: NDArray[np.int64]) -> dict[str, Any]:
    """The error material of a job, from replicate sums (r, h, w, 3) and samples (r,).

    Keys: `replicates` that have samples; `mse`, the mean variance of the picture; `relmse`, the same over
    picture^2 + 0.01; `delete_one_mse`, the mse without each replicate; `normal_spread`, half the relative
    variance of the squared error of a picture, were its noise normal (native/cpu/picture_error.h). None
    below two replicates.
    """
    used = counts > 0
    sums, weights = sums[used], counts[used].astype(np.float64)
    replicates = len(weights)
    if replicates < 2:
        nothing = {"mse": None, "relmse": None, "normal_spread": 0.0, "delete_one_mse": ()}
        return {"replicates": replicates, **nothing}
    variance, mean = variance_of_mean(sums, weights)
    delete_one: tuple[float, ...] = ()
    if replicates > 2:
        rows = np.arange(replicates)
        delete_one = tuple(
            float(variance_of_mean(sums[rows != r], weights[rows != r])[0].mean()) for r in rows
        )
    relative = variance / (mean * mean + RELATIVE_FLOOR)
    return {
        "replicates": replicates,
        "mse": float(variance.mean()),
        "relmse": float(relative.mean()),
        "normal_spread": normal_spread(sums, weights),
        "delete_one_mse": delete_one,
    }


def normal_spread(sums: Float64, counts: Float64) -> float:
    """Sum over pixels and pairs of channels of the squared covariance over the square of all variance.

    0 below four replicates. The square is the product of what two halves of the replicates tell: a
    rare bright path is in one of them alone and does not swell it.
    """
    if len(counts) < 4:
        return 0.0
    middle = len(counts) // 2
    a, b = (
        channel_covariance(sums[half], counts[half]) for half in (slice(None, middle), slice(middle, None))
    )
    both = 0.5 * float(np.trace(a + b, axis1=-2, axis2=-1).sum())
    return float((a * b).sum()) / both**2 if both > 0.0 else 0.0


def channel_covariance(sums: Float64, counts: Float64) -> Float64:
    """(h, w, 3, 3): unbiased covariance of the channels of the mean of all samples."""
    off = sums / counts[:, None, None, None] - sums.sum(axis=0) / counts.sum()
    shares = counts / ((len(counts) - 1) * counts.sum())
    return np.einsum("r,rhwc,rhwd->hwcd", shares, off, off)


def variance_of_mean(sums: Float64, counts: Float64) -> tuple[Float64, Float64]:
    """Unbiased variance of the mean of all samples, and that mean, a value a pixel and channel.

    Replicate means have variance sigma^2 / n_r, hence the weights.
    """
    weights = counts[:, None, None, None]
    mean = sums.sum(axis=0) / counts.sum()
    spread = (weights * (sums / weights - mean) ** 2).sum(axis=0)
    return spread / ((len(counts) - 1) * counts.sum()), mean


def estimate_error(material: Mapping[str, Any]) -> PictureError:
    """Turns the error material of a job into RMSE with its 95 % interval, and relMSE."""
    mse = material["mse"]
    if mse is None:
        return PictureError()
    interval = error_interval(material)
    return PictureError(math.sqrt(max(mse, 0.0)), interval, material["relmse"])


def error_interval(material: Mapping[str, Any]) -> tuple[float, float] | None:
    """95 % interval of the error that the picture has; None below three replicates.

    Two doubts add up in the logarithm of the squared error: how well the replicates tell its mean over such
    pictures (a jackknife over them), and how far one picture lies from that mean. The second is twice
    `normal_spread`: of rare bright paths the picture's own error and its estimate hold the same ones, so they
    are no further doubt. Replicates that were drawn in `groups` apart have a mean and one degree of freedom
    less for each.
    """
    mse, delete_one = material["mse"], material["delete_one_mse"]
    groups, count = material.get("groups", 1), len(delete_one)
    if count < 3:
        return None
    if mse <= 0.0:
        return (0.0, 0.0)
    # One replicate that holds all the noise would have log 0: it is held at a share of the whole.
    logs = np.log(np.maximum(np.asarray(delete_one, dtype=np.float64), 1e-6 * mse))
    each = logs.reshape(groups, -1)
    size = each.shape[1]
    jackknife = (size - 1) / size * float(((each - each.mean(axis=1, keepdims=True)) ** 2).sum())
    spread = jackknife + 2.0 * material["normal_spread"]
    half_width = 0.5 * STUDENT_95[min(count - groups, 7)] * math.sqrt(spread)
    rmse = math.sqrt(mse)
    return (rmse * math.exp(-half_width), rmse * math.exp(half_width))


def rmse(picture: Float64, truth: Float64) -> float:
    """Root of the mean squared difference over all values."""
    return math.sqrt(float(np.mean((np.asarray(picture, dtype=np.float64) - truth) ** 2)))


def relmse(picture: Float64, truth: Float64) -> float:
    """Mean of (picture - truth)^2 / (truth^2 + 0.01)."""
    squared = (np.asarray(picture, dtype=np.float64) - truth) ** 2
    return float(np.mean(squared / (np.asarray(truth, dtype=np.float64) ** 2 + RELATIVE_FLOOR)))
