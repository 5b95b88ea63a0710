"""The chart and the page of `trg report`."""

from __future__ import annotations

import base64
import html
import importlib
import math
import platform
from pathlib import Path
from types import ModuleType
from typing import Any

from .. import __version__
from ..engine.devices import Unavailable
from ..engine.error_curves import CurvePoint, Fit, Variant, fit_curve, held_share

STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem }
table { border-collapse: collapse; margin: 1rem 0; font-variant-numeric: tabular-nums }
th, td { padding: .25rem .75rem; border-bottom: 1px solid #ddd; text-align: right }
th:first-child, td:first-child { text-align: left }
img { max-width: 100% }
"""


def load_matplotlib() -> ModuleType:
    """Raises Unavailable with the way to get it."""
    try:
        matplotlib = importlib.import_module("matplotlib")
    except ImportError as failure:
        raise Unavailable(f"the chart needs matplotlib ({failure}); pip install matplotlib") from failure
    matplotlib.use("Agg")
    return matplotlib


def by_variant(points: list[CurvePoint]) -> dict[Variant, list[CurvePoint]]:
    found: dict[Variant, list[CurvePoint]] = {}
    for point in points:
        found.setdefault(point.variant, []).append(point)
    return found


def write_chart(path: Path, measured: Any) -> None:
    """A log-log chart: measured errors as dots, the fit as a line, stated intervals as bars."""
    load_matplotlib()
    pyplot = importlib.import_module("matplotlib.pyplot")
    figure, axes = pyplot.subplots(figsize=(9.0, 6.0), dpi=100)
    for number, (variant, points) in enumerate(by_variant(measured.points).items()):
        draw_curve(axes, f"C{number % 10}", variant, points)
    if measured.target is not None:
        axes.axhline(measured.target, color="0.5", linestyle=":", label=f"target {measured.target:g}")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("seconds: build and trace")
    axes.set_ylabel("RMSE, linear RGB")
    axes.set_title(f"{measured.title}, {measured.size[0]} x {measured.size[1]}")
    axes.grid(True, which="both", color="0.9")
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path)
    pyplot.close(figure)


def draw_curve(axes: Any, color: str, variant: Variant, points: list[CurvePoint]) -> None:
    seconds = [point.seconds for point in points]
    axes.plot(
        seconds, [point.measured for point in points], "o", color=color, markersize=5, label=variant.name
    )
    told = [p for p in points if p.stated is not None and p.low is not None and p.high is not None]
    for shift, point in ((1.02, p) for p in told):
        at = point.seconds * shift
        axes.plot([at, at], [point.low, point.high], color=color, alpha=0.35, linewidth=1.5)
        axes.plot([at], [point.stated], "_", color=color, alpha=0.7)
    fit = fit_curve(points)
    if fit is not None:
        ends = (min(seconds), max(seconds))
        axes.plot(ends, [fit.at_one * end**fit.slope for end in ends], "-", color=color, linewidth=1.0)


def write_page(path: Path, measured: Any, chart: Path) -> None:
    """One file that needs no other: the chart is inside."""
    picture = base64.b64encode(chart.read_bytes()).decode("ascii")
    references = "; ".join(f"{name}: {origin}" for name, origin in measured.references.items())
    text = f"""<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Error against time: {html.escape(measured.title)}</title>
<style>{STYLE}</style></head><body>
<h1>Error against run time</h1>
<p>{html.escape(measured.title)}, {measured.size[0]} x {measured.size[1]} pixels. TRG {__version__},
{html.escape(platform.platform())}, Python {platform.python_version()}.</p>
<p>Reference: {html.escape(references)}. Dots are errors measured against it; bars are the 95&nbsp;% intervals
that the renders state of themselves; lines are fitted to the dots.</p>
<img alt="error against seconds, both logarithmic" src="data:image/png;base64,{picture}">
{summary_table(measured)}
<h2>All points</h2>
{point_table(measured.points)}
</body></html>
"""
    path.write_text(text, encoding="utf-8")


def summary_table(measured: Any) -> str:
    heads = ["what is compared", "slope", "RMSE after 1 s", "intervals that hold"]
    if measured.target is not None:
        heads.append(f"seconds to {measured.target:g}")
    rows = []
    for variant, points in by_variant(measured.points).items():
        fit, held = fit_curve(points), held_share(points)
        row = [variant.name, *fit_cells(fit), "-" if held is None else f"{held:.0%} of {len(points)}"]
        if measured.target is not None:
            row.append(target_cell(fit, measured.target))
        rows.append(row)
    return table(heads, rows)


def fit_cells(fit: Fit | None) -> list[str]:
    if fit is None:
        return ["too few points", "-"]
    return [f"{fit.slope:.2f} \u00b1 {fit.slope_error:.2f}", f"{fit.at_one:.4g}"]


def target_cell(fit: Fit | None, target: float) -> str:
    seconds = math.inf if fit is None else fit.seconds_to(target)
    return f"{seconds:.3g}" if math.isfinite(seconds) else "-"


def point_table(points: list[CurvePoint]) -> str:
    heads = ["variant", "seed", "seconds", "samples", "measured RMSE", "stated RMSE", "95 % interval"]
    rows = [
        [
            point.variant.name,
            str(point.seed),
            f"{point.seconds:.2f}",
            f"{point.samples:.0f}",
            f"{point.measured:.4g}",
            "-" if point.stated is None else f"{point.stated:.4g}",
            "-" if point.low is None else f"{point.low:.4g} to {point.high:.4g}",
        ]
        for point in points
    ]
    return table(heads, rows)


def table(heads: list[str], rows: list[list[str]]) -> str:
    def line(cells: list[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return "<table>" + line(heads, "th") + "".join(line(row, "td") for row in rows) + "</table>"
