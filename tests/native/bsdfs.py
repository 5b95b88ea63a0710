"""One material's lobes, as the native core has them; those of `trg stability`."""

from __future__ import annotations

from trg_blender.stability.lobes import Samples, evaluate, packed, sample, view

__all__ = ["Samples", "evaluate", "packed", "sample", "view"]
