"""Does the stated error hold as often as it claims?

    python -m benchmarks.calibration [--seeds 200] [--samples 8 32 128] [--size 32x24] [NAME ...]

Method. Each scene is rendered with many seeds at each number of samples. The truth is a render of 64 times
the most samples (512 times for the hard scenes), its own estimated variance taken off the squared
differences. Columns:

    covers   share of renders whose stated 95 % interval holds the error that the render truly has, the root
             of the mean squared difference from the truth; over those that call themselves reliable
    ratio    stated over true RMSE: roots of the means over the seeds
    pixels   share of pixels whose luminance lies within the stated half width of the truth
    below    of the pixels outside: share where the truth lies above
    reliable share of renders that call their error reliable

Criterion: covers 0.91 to 0.98 give or take three binomial standard errors of the seeds, ratio 0.95 to 1.05,
pixels at least 0.93 (0.90 for the hard scenes).
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from benchmarks.calibration_scenes import SCENES, CalibrationScene  # noqa: E402
from trg_blender.engine.image_error import Evidence, estimate_error  # noqa: E402
from trg_blender.engine.native import load_native  # noqa: E402
from trg_blender.engine.native_scene import build_native_scene  # noqa: E402
from trg_blender.engine.scene_arrays import LUMINANCE, RenderSettings  # noqa: E402

Float64 = NDArray[np.float64]
TRUTH_FACTOR, HARD_FACTOR = 64, 512
TRUTH_SEED = 1_000_003


@dataclass(frozen=True, slots=True)
class Rendered:
    """One render and what it says of itself."""

    pixels: Float64
    rmse: float
    interval: tuple[float, float]
    half_width: Float64
    reliable: bool


@dataclass(frozen=True, slots=True)
class Calibration:
    scene: str
    hard: bool
    samples: int
    seeds: int
    covers: float
    ratio: float
    pixels: float
    below: float
    reliable: float
    lonely_error: float
    holds: bool


def render(scene: Any, settings: RenderSettings) -> tuple[Rendered, Evidence]:
    job = scene.start_render(
        settings.width, settings.height, settings.samples, settings.seed, settings.max_bounces
    )
    while not job.poll(1.0)["done"]:
        pass
    shape = (settings.height, settings.width)
    pixels, half_width = np.zeros((*shape, 4), np.float32), np.zeros(shape, np.float32)
    job.combined(pixels)
    evidence = Evidence(**job.pixel_error(half_width, np.zeros(shape, np.uint8)))
    error = estimate_error(job.error())
    assert error.rmse is not None
    assert error.ci95 is not None
    found = Rendered(
        pixels[..., :3].astype(np.float64),
        error.rmse,
        error.ci95,
        half_width.astype(np.float64),
        evidence.is_enough,
    )
    return found, evidence


def settings_of(args: argparse.Namespace, samples: int, seed: int) -> RenderSettings:
    width, height = (int(side) for side in args.size.split("x"))
    return RenderSettings(width, height, samples=samples, seed=seed, max_bounces=8)


def calibrate(name: str, one: CalibrationScene, args: argparse.Namespace) -> list[Calibration]:
    factor = HARD_FACTOR if one.hard else TRUTH_FACTOR
    settings = settings_of(args, factor * max(args.samples), TRUTH_SEED)
    scene, _ = build_native_scene(load_native(), one.build(), settings)
    truth, _ = render(scene, settings)
    found = []
    for samples in args.samples:
        renders, evidence = zip(
            *(render(scene, settings_of(args, samples, seed)) for seed in range(args.seeds)), strict=True
        )
        found.append(judge((name, one.hard, samples), renders, truth, evidence))
    return found


def judge(
    what: tuple[str, bool, int],
    renders: tuple[Rendered, ...],
    truth: Rendered,
    evidence: tuple[Evidence, ...],
) -> Calibration:
    name, hard, samples = what
    own = truth.rmse**2
    true_mse = np.array([max(float(np.mean((r.pixels - truth.pixels) ** 2)) - own, 0.0) for r in renders])
    covered = np.array(
        [
            low <= math.sqrt(mse) <= high
            for mse, (low, high) in zip(true_mse, (r.interval for r in renders), strict=True)
        ]
    )
    reliable = np.array([r.reliable for r in renders])
    covers = float(covered[reliable].mean()) if reliable.any() else math.nan
    ratio = math.sqrt(np.mean([r.rmse**2 for r in renders]) / true_mse.mean())
    off = np.stack([(truth.pixels - r.pixels) @ LUMINANCE for r in renders])
    widths = np.stack([r.half_width for r in renders])
    outside = np.abs(off) > widths + 1e-7
    pixels, below = (
        1.0 - float(outside.mean()),
        float((off[outside] > 0).mean()) if outside.any() else math.nan,
    )
    slack = 3.0 * math.sqrt(0.05 * 0.95 / max(int(reliable.sum()), 1))
    holds = (
        (not reliable.any() or 0.91  <= covers <= 0.98 + slack)
        and (reliable.mean() < 0.5 or abs(ratio - 1.0) <= 0.05)
        and pixels >= (0.90 if hard else 0.93)
    )
    lonely = float(np.mean([e.lonely_error for e in evidence]))
    return Calibration(
        name,
        hard,
        samples,
        len(renders),
        covers,
        ratio,
        pixels,
        below,
        float(reliable.mean()),
        lonely,
        bool(holds),
    )


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="part of a scene's name")
    parser.add_argument("--seeds", type=int, default=200)
    parser.add_argument("--samples", type=int, nargs="+", default=[8, 32, 128])
    parser.add_argument("--size", default="32x24")
    parser.add_argument("--json", type=Path)
    args = parser.parse_args()
    results: list[Calibration] = []
    print(
        f"{'scene':26} {'spp':>4} {'covers':>7} {'ratio':>7} {'pixels':>7} {'below':>6} {'reliable':>8} "
        f"{'lonely':>7}"
    )
    for name, one in SCENES.items():
        if args.names and not any(part in name for part in args.names):
            continue
        for found in calibrate(name, one, args):
            results.append(found)
            print(
                f"{name:26} {found.samples:4} {found.covers:7.3f} {found.ratio:7.3f} {found.pixels:7.3f} "
                f"{found.below:6.2f} {found.reliable:8.2f} {found.lonely_error:7.3f}"
                f"{'' if found.holds else '   OUTSIDE'}",
                flush=True,
            )
    print(f"{sum(one.holds for one in results)} of {len(results)} hold")
    if args.json:
        args.json.write_text(json.dumps([asdict(one) for one in results], indent=1), encoding="utf-8")
    return 0 if all(one.holds for one in results) else 1


if __name__ == "__main__":
    sys.exit(main())
