"""What a picture file says of itself: the figures of the report as text fields (PNG tEXt, EXR attributes)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

PREFIX = "trg/"
UNKNOWN = "unknown"


def stamp_fields(report: Mapping[str, Any]) -> dict[str, str]:
    """Fields of a picture by name, every one always there.

    `trg/rmse` and `trg/interval95` (two numbers, low and high) are over linear Rec.709 RGB, or `unknown`;
    `trg/reliable` is yes or no, `trg/note` says why not, empty where there is nothing to say.
    """
    error = report["error"]
    interval = error["ci95"]
    fields = {
        "version": report["version"],
        "device": f"{report['device']}/{report['accel']}",
        "integrator": report["integrator"],
        "seed": str(report["seed"]),
        "samples": f"{report['samples']:g}",
        "seconds": f"{report['seconds']['total']:.3f}",
        "stopped_by": error["stopped_by"],
        "rmse": UNKNOWN if error["rmse"] is None else f"{error['rmse']:.6g}",
        "interval95": UNKNOWN if interval is None else " ".join(f"{end:.6g}" for end in interval),
        "reliable": "yes" if error["reliable"] else "no",
        "note": error["note"] or "",
    }
    return {PREFIX + name: value for name, value in fields.items()}
