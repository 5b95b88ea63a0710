"""Whether two renderers agree: z-scores of pixel blocks and of the whole picture.

Each renderer gives 8 independent replicates; their spread tells how well its mean is known. Welch's t of
each difference is turned into a z of equal rarity, so that few replicates do not look like disagreement.
Blocks are held to the largest |z| of as many fair normals (Sidak), the whole picture to |z| < 3.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

PICTURE_LIMIT = 3.0
FAMILY_LEVEL = 0.01
"""Chance that fair noise fails the block rule of one scene."""
SINGLE_PRECISION = 2e-5
"""Relative rounding of a float32 path, counted as one standard error of each mean."""


@dataclass(frozen=True, slots=True)
class Agreement:
    """z-scores of first minus second, over standard errors of both."""

    picture: np.ndarray
    """(3,)"""
    blocks: np.ndarray
    """(blocks, 3)"""
    difference: np.ndarray
    """(3,) of the picture means, relative to the brighter one"""
    resolution: float
    """the relative difference of picture means that would make |z| = 3"""

    @property
    def block_limit(self) -> float:
        share = 1.0 - (1.0 - FAMILY_LEVEL) ** (1.0 / self.blocks.size)
        return NormalDist().inv_cdf(1.0 - 0.5 * share)

    @property
    def worst_picture(self) -> float:
        return float(np.abs(self.picture).max())

    @property
    def worst_block(self) -> float:
        return float(np.abs(self.blocks).max())

    @property
    def agrees(self) -> bool:
        return self.worst_picture < PICTURE_LIMIT and self.worst_block < self.block_limit

    def __str__(self) -> str:
        return (
            f"picture |z| {self.worst_picture:.2f} (< 3), block |z| {self.worst_block:.2f} "
            f"(< {self.block_limit:.2f}), difference {100 * np.abs(self.difference).max():.2f} %, "
            f"resolves {100 * self.resolution:.2f} %"
        )


def compare(first, second, block: int = 8) -> Agreement:
    """Compares two Results of the same scene and size (engine.session.Result)."""
    shape = first.replicate_sums.shape[1:3]
    picture = [_block_means(one, shape) for one in (first, second)]
    blocks = [_block_means(one, (block, block)) for one in (first, second)]
    picture_z, error = _scores(*picture)
    means = [one.mean(axis=0)[0] for one in picture]
    brighter = np.maximum(np.maximum(*means), 1e-6)
    return Agreement(
        picture_z[0],
        _scores(*blocks)[0],
        (means[0] - means[1]) / brighter,
        float((3.0 * error[0] / brighter).max()),
    )


def _block_means(result, size: tuple[int, int]) -> np.ndarray:
    """(replicates, blocks, 3) means over blocks of `size` (height, width) pixels."""
    used = result.replicate_counts > 0
    means = result.replicate_sums[used] / result.replicate_counts[used][:, None, None, None]
    count, height, width, _ = means.shape
    rows, columns = height // size[0], width // size[1]
    cut = means[:, : rows * size[0], : columns * size[1]].reshape(count, rows, size[0], columns, size[1], 3)
    return cut.mean(axis=(2, 4)).reshape(count, rows * columns, 3)


def _scores(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(z, standard error of the difference), from replicate means along axis 0."""
    variances = [one.var(axis=0, ddof=1) / len(one) for one in (first, second)]
    means = [one.mean(axis=0) for one in (first, second)]
    rounding = (SINGLE_PRECISION * np.maximum(np.abs(means[0]), np.abs(means[1]))) ** 2 + 1e-18
    error = np.sqrt(sum(variances) + rounding)
    degrees = (sum(variances) + rounding) ** 2 / sum(
        (variance + 0.5 * rounding) ** 2 / (len(one) - 1)
        for variance, one in zip(variances, (first, second), strict=True)
    )
    return student_to_normal((means[0] - means[1]) / error, degrees), error


def student_to_normal(t: np.ndarray, degrees: np.ndarray) -> np.ndarray:
    """The normal deviate as rare as Student's t (Wallace 1959, within 0.02 from three degrees on)."""
    size = np.sqrt(degrees * np.log1p(t * t / degrees))
    return np.sign(t) * size * (8.0 * degrees + 1.0) / (8.0 * degrees + 3.0)
