"""Pixel blocks of the CGSG formats (grey, BGR, BGRA) and the project's own (RGB, bottom row first)."""

from __future__ import annotations

import numpy as np

from .model import Pixels

RGB_FROM_BGR = {1: (0,), 3: (2, 1, 0), 4: (2, 1, 0, 3)}
"""channel order by number of channels; its own inverse"""


def swap_red_blue(pixels: Pixels) -> Pixels:
    """(h, w, c) BGR(A) from RGB(A) or back, contiguous."""
    return np.ascontiguousarray(pixels[:, :, RGB_FROM_BGR[pixels.shape[2]]])


def check_pixels(pixels: Pixels) -> None:
    """Raises ValueError unless `pixels` is uint8 (h, w, c) with 1, 3 or 4 channels and not empty."""
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] not in RGB_FROM_BGR or not pixels.size:
        raise ValueError(f"uint8 pixels (h, w, 1, 3 or 4) are needed, got {pixels.dtype} {pixels.shape}")
