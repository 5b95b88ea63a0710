"""Does the stated error hold as often as it claims?

    python -m benchmarks.calibration [--seeds 200] [--samples 8 32 128] [--integrators path classic]
        [--size 32x24] [--markdown FILE] [--json FILE] [NAME ...]

Method. Each scene is rendered with many seeds at each number of samples. The truth is a render of 64 times
the most samples (512 times for the hard scenes), its own estimated variance taken off the squared
differences. Of the integrator `path` a last row has renders that stop by an error target with adaptive
sampling; the target is what the renders of the middle number of samples say. Columns:

    reliable share of renders that call their error reliable
    covers   share of these whose stated 95 % interval holds the error that the render truly has, the root
             of the mean squared difference from the truth
    ratio    stated over true RMSE: roots of the means over all seeds, reliable or not
    pixels   share of pixels whose luminance lies within the stated half width of the truth
    below    of the pixels outside: share where the truth lies above
    bias     mean of all renders and pixels over that of the truth, less 1, in its standard errors

Criterion: covers 0.91 to 0.98 give or take three binomial standard errors of the reliable renders, ratio
0.95 to 1.05, or within three standard errors of it over the seeds, pixels at least 0.93 (0.90 for the hard
scenes).

Biases that are declared stand apart, below the table: what the limit of bounces loses. There is no clamping,
and Russian roulette and stopping by error have none.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from benchmarks.calibration_scenes import SCENES, CalibrationScene  # noqa: E402
from trg_blender.engine.chance_light import error_in_hits  # noqa: E402
from trg_blender.engine.image_error import Evidence, estimate_error  # noqa: E402
from trg_blender.engine.native import load_native  # noqa: E402
from trg_blender.engine.native_scene import build_native_scene  # noqa: E402
from trg_blender.engine.scene_arrays import LUMINANCE, RenderSettings, SceneArrays  # noqa: E402

Float64 = NDArray[np.float64]
TRUTH_FACTOR, HARD_FACTOR = 64, 512
FIRST_SEED, TRUTH_SEED = 5_000, 1_000_003
BOUNCES, MANY_BOUNCES = 8, 64
HEAD = ("scene", "samples", "reliable", "covers", "ratio", "pixels", "below", "bias", "")


@dataclass(frozen=True, slots=True)
class Rendered:
    """One render and what it says of itself."""

    pixels: Float64
    rmse: float
    interval: tuple[float, float]
    half_width: Float64
    evidence: Evidence


@dataclass(frozen=True, slots=True)
class Series:
    """Renders of one scene that differ by their seeds alone."""

    scene: str
    hard: bool
    integrator: str
    samples: str
    renders: tuple[Rendered, ...]


@dataclass(frozen=True, slots=True)
class Calibration:
    scene: str
    hard: bool
    integrator: str
    samples: str
    seeds: int
    reliable: float
    covers: float
    ratio: float
    ratio_error: float
    """standard error of `ratio`"""
    pixels: float
    below: float
    bias: float
    holds: bool

    def cells(self) -> tuple[str, ...]:
        figures = (self.reliable, self.covers, self.ratio, self.pixels, self.below, self.bias)
        words = [f"{figure:.{digits}f}" for figure, digits in zip(figures, (2, 3, 3, 3, 2, 1), strict=True)]
        words = ["-" if word == "nan" else word for word in words]
        return (self.scene, self.samples, *words, "" if self.holds else "outside")


@dataclass(frozen=True, slots=True)
class Case:
    """A scene ready for rendering."""

    arrays: SceneArrays
    native: Any

    def render(self, settings: RenderSettings) -> Rendered:
        job = self.native.start_render(
            settings.width,
            settings.height,
            settings.samples,
            settings.seed,
            settings.max_bounces,
            rmse=settings.rmse,
            adaptive=settings.adaptive,
        )
        while not (state := job.poll(1.0))["done"]:
            pass
        shape = (settings.height, settings.width)
        pixels, half_width = np.zeros((*shape, 4), np.float32), np.zeros(shape, np.float32)
        job.combined(pixels)
        found = job.pixel_error(half_width, np.zeros(shape, np.uint8))
        error = estimate_error(job.error())
        assert error.rmse is not None
        assert error.ci95 is not None
        hits = error_in_hits(self.arrays, settings, error.rmse, state["samples"])
        return Rendered(
            pixels[..., :3].astype(np.float64),
            error.rmse,
            error.ci95,
            half_width.astype(np.float64),
            Evidence(**found, chance_hits=hits),
        )

    def render_seeds(self, settings: RenderSettings, seeds: int) -> tuple[Rendered, ...]:
        return tuple(self.render(replace(settings, seed=FIRST_SEED + seed)) for seed in range(seeds))


def calibrate(
    name: str, one: CalibrationScene, integrator: str, args: argparse.Namespace
) -> Iterator[Calibration]:
    width, height = (int(side) for side in args.size.split("x"))
    settings = RenderSettings(width, height, max_bounces=BOUNCES, integrator=integrator)
    factor = HARD_FACTOR if one.hard else TRUTH_FACTOR
    arrays = one.build()
    case = Case(arrays, build_native_scene(load_native(), arrays, settings)[0])
    truth = case.render(replace(settings, samples=factor * max(args.samples), seed=TRUTH_SEED))
    targets = {}
    for samples in args.samples:
        renders = case.render_seeds(replace(settings, samples=samples), args.seeds)
        targets[samples] = float(np.median([r.rmse for r in renders]))
        yield judge(Series(name, one.hard, integrator, str(samples), renders), truth)
    middle = sorted(args.samples)[len(args.samples) // 2]
    if integrator == "path" and targets[middle] > 0.0:
        stopping = replace(settings, samples=64 * middle, rmse=targets[middle], adaptive=True)
        renders = case.render_seeds(stopping, args.seeds)
        yield judge(Series(name, one.hard, integrator, f"to {targets[middle]:.2g}", renders), truth)


def judge(series: Series, truth: Rendered) -> Calibration:
    renders, own = series.renders, truth.rmse**2
    true_mse = np.array([max(float(np.mean((r.pixels - truth.pixels) ** 2)) - own, 0.0) for r in renders])
    stated_mse = np.array([r.rmse**2 for r in renders])
    covered = np.array(
        [
            low <= math.sqrt(mse) <= high
            for mse, (low, high) in zip(true_mse, (r.interval for r in renders), strict=True)
        ]
    )
    reliable = np.array([r.evidence.is_enough for r in renders])
    covers = float(covered[reliable].mean()) if reliable.any() else math.nan
    ratio, ratio_error = ratio_of_roots(stated_mse, true_mse)
    pixels, below = pixel_shares(renders, truth)
    slack = 3.0 * math.sqrt(0.05 * 0.95 / max(int(reliable.sum()), 1))
    holds = (
        (not reliable.any() or 0.91 - slack <= covers <= 0.98 + slack)
        and (not reliable.any() or abs(ratio - 1.0) <= max(0.05, 3.0 * ratio_error))
        and pixels >= (0.90 if series.hard else 0.93)
    )
    return Calibration(
        series.scene,
        series.hard,
        series.integrator,
        series.samples,
        len(renders),
        float(reliable.mean()),
        covers,
        ratio,
        ratio_error,
        pixels,
        below,
        bias_of(renders, truth),
        bool(holds),
    )


def ratio_of_roots(stated: Float64, true: Float64) -> tuple[float, float]:
    """Root of the ratio of the means, and its standard error by the delta method."""
    if not true.mean() > 0.0:
        return math.nan, math.nan
    ratio = float(stated.mean() / true.mean())
    rest = (stated - ratio * true) / true.mean()
    error = float(rest.std(ddof=1)) / math.sqrt(len(rest)) if len(rest) > 1 else math.inf
    return math.sqrt(ratio), 0.5 * error / math.sqrt(max(ratio, 1e-12))


def pixel_shares(renders: tuple[Rendered, ...], truth: Rendered) -> tuple[float, float]:
    """Share of pixels within their half width, and share of the others whose truth lies above."""
    off = np.stack([(truth.pixels - r.pixels) @ LUMINANCE for r in renders])
    outside = np.abs(off) > np.stack([r.half_width for r in renders]) + 1e-7
    return 1.0 - float(outside.mean()), float((off[outside] > 0).mean()) if outside.any() else math.nan


def bias_of(renders: tuple[Rendered, ...], truth: Rendered) -> float:
    """How many standard errors the mean of the renders' means lies from the truth's."""
    means = np.array([r.pixels.mean() for r in renders])
    error = means.std(ddof=1) / math.sqrt(len(means)) if len(means) > 1 else 0.0
    own = truth.rmse / math.sqrt(truth.pixels.size)
    spread = math.hypot(error, own)
    return float((means.mean() - truth.pixels.mean()) / spread) if spread > 0.0 else math.nan


def bounce_loss(one: CalibrationScene, args: argparse.Namespace) -> float:
    """Share of the picture's light that the limit of bounces leaves out, by equal seeds."""
    width, height = (int(side) for side in args.size.split("x"))
    settings = RenderSettings(width, height, samples=64 * max(args.samples) // 8, max_bounces=BOUNCES)
    arrays = one.build()
    case = Case(arrays, build_native_scene(load_native(), arrays, settings)[0])
    few = case.render(settings).pixels.mean()
    many = case.render(replace(settings, max_bounces=MANY_BOUNCES)).pixels.mean()
    return float(1.0 - few / many) if many > 0.0 else 0.0


def chosen(args: argparse.Namespace) -> dict[str, CalibrationScene]:
    return {
        name: one
        for name, one in SCENES.items()
        if not args.names or any(part in name for part in args.names)
    }


def write_markdown(
    path: Path, results: list[Calibration], losses: dict[str, float], args: argparse.Namespace
) -> None:
    """The tables as a page, written anew after each scene so that a run cut short leaves what it has."""
    lines = [
        "# Calibration of the stated error",
        "",
        f"{time.strftime('%d %B %Y')}: `python -m benchmarks.calibration --seeds {args.seeds} "
        f"--size {args.size}`, "
        "whose docstring says what the columns are. "
        f"{sum(one.holds for one in results)} of {len(results)} rows hold.",
    ]
    for integrator in args.integrators:
        lines += ["", f"## {integrator}", "", "| " + " | ".join(HEAD) + " |", "|---" * len(HEAD) + "|"]
        lines += ["| " + " | ".join(one.cells()) + " |" for one in results if one.integrator == integrator]
    lines += [
        "",
        f"## Declared: light that {BOUNCES} bounces leave out",
        "",
        "| scene | share |",
        "|---|---|",
    ]
    lines += [f"| {name} | {loss:.2%} |" for name, loss in losses.items()]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="part of a scene's name")
    parser.add_argument("--seeds", type=int, default=200)
    parser.add_argument("--samples", type=int, nargs="+", default=[8, 32, 128])
    parser.add_argument("--integrators", nargs="+", choices=("path", "classic"), default=["path", "classic"])
    parser.add_argument("--size", default="32x24")
    parser.add_argument("--markdown", type=Path, help="write the tables to a page")
    parser.add_argument("--json", type=Path)
    args = parser.parse_args()
    results: list[Calibration] = []
    losses: dict[str, float] = {}
    widths = (26, 9, *[8] * 6, 7)
    for integrator in args.integrators:
        print(
            f"{integrator}\n" + " ".join(word.ljust(width) for word, width in zip(HEAD, widths, strict=True))
        )
        for name, one in chosen(args).items():
            for found in calibrate(name, one, integrator, args):
                results.append(found)
                cells = zip(found.cells(), widths, strict=True)
                print(" ".join(word.ljust(width) for word, width in cells), flush=True)
            if integrator == "path":
                losses[name] = bounce_loss(one, args)
            if args.markdown:
                write_markdown(args.markdown, results, losses, args)
    print(f"{sum(one.holds for one in results)} of {len(results)} hold")
    for name, loss in losses.items():
        print(f"declared: {BOUNCES} bounces leave out {loss:.2%} of {name}")
    if args.json:
        args.json.write_text(json.dumps([asdict(one) for one in results], indent=1), encoding="utf-8")
    return 0 if all(one.holds for one in results) else 1


if __name__ == "__main__":
    sys.exit(main())
