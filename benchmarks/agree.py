"""The same scenes by TRG and by Cycles in one Blender: do the pictures agree?

    .venv/3.13/bin/python -m benchmarks.agree [--seeds 8] [--samples 64] [--out DIR] [--json FILE] [NAME ...]

Method. Each engine renders each scene with `seeds` seeds of `samples` samples: no denoiser, no clamping, no
adaptive sampling, caustics on, the same bounces, a box filter of one pixel unless the scene is about filters.
The spread of the seeds gives the noise of every figure. A scene agrees when the means of the pictures differ
by no more than 0.5 % and no region of 16 x 16 pixels by more than 2 %, both beyond the noise: the difference
less z standard errors, with z for 1 % of false alarms a scene over its regions (Bonferroni). FLIP (Andersson
et al. 2020) compares the two pictures tone-mapped by the sRGB curve, when the package flip_evaluator is
there; noise raises it.

Exit code 1 when a scene disagrees that EXCEPTIONS does not explain.
"""

from __future__ import annotations

import argparse
import importlib
import json
import math
import statistics
import sys
import tempfile
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from benchmarks.agree_scenes import scenes  # noqa: E402
from benchmarks.engines import enable_engines  # noqa: E402

Pictures = NDArray[np.float64]
REGION = 16
MEAN_LIMIT, REGION_LIMIT = 0.005, 0.02
BOUNCES = 12
SKY = "the sky is a model of our own; docs/decisions/sky.md says how near it is to Blender's"
CYCLES_NAMES = {
    "transparent_bounces": "transparent_max_bounces",
    "clamp_direct": "sample_clamp_direct",
    "clamp_indirect": "sample_clamp_indirect",
}
"""where Cycles calls a setting of scene.trg otherwise"""
EXCEPTIONS: dict[str, str] = {
    "no transparent bounce": "to Cycles 5 the area light that a ray crosses is a transparent bounce as well",
    "one transparent bounce": "Cycles 5 passes a surface fewer than the limit; TRG counts as 4.5",
    "sky single": SKY,
    "sky low": SKY,
    "sky multiple": SKY,
}
"""scene -> why its pictures may differ"""


@dataclass(frozen=True, slots=True)
class Agreement:
    """One scene; ratios are TRG over Cycles, errors one standard error."""

    scene: str
    ratio: float
    ratio_error: float
    worst_region: float
    """largest relative difference of a region beyond noise"""
    worst_at: tuple[int, int]
    """its column and row, from the bottom left"""
    noise: float
    """median relative standard error of a region's difference"""
    flip: float | None
    seconds: tuple[float, float]
    agrees: bool
    warnings: tuple[str, ...]


def prepare(scene: Any, samples: int) -> None:
    """Gives both engines the same work."""
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.use_compositing = scene.render.use_sequencer = False
    scene.trg.samples, scene.trg.max_bounces = samples, BOUNCES
    cycles = scene.cycles
    cycles.samples, cycles.device = samples, "CPU"
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.blur_glossy = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    name, width = scene.get("agree_filter", "BOX 1").split()
    cycles.pixel_filter_type = scene.trg.filter_type = name
    cycles.filter_width = scene.trg.filter_width = float(width)
    for name in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, f"{name}_bounces", BOUNCES)
    cycles.transparent_max_bounces = 64
    for name, value in dict(scene.get("agree_rules", {})).items():
        setattr(scene.trg, name, value)
        setattr(cycles, CYCLES_NAMES.get(name, name), value)


def render_once(scene: Any, engine: str, seed: int, folder: Path) -> Pictures:
    """(h, w, 3) linear, bottom row first."""
    import OpenEXR

    scene.render.engine = engine
    scene.cycles.seed = scene.trg.seed = seed
    path = folder / f"{engine}.exr"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    with OpenEXR.File(str(path)) as file:
        channels = file.channels()
        name = next(key for key in channels if key in ("RGBA", "RGB"))
        return np.asarray(channels[name].pixels[::-1, :, :3], dtype=np.float64)


def render_both(scene: Any, seeds: int, folder: Path) -> tuple[dict[str, Pictures], dict[str, float]]:
    """(seeds, h, w, 3) and seconds of each engine; the engines take turns."""
    pictures: dict[str, list[Pictures]] = {"TRG": [], "CYCLES": []}
    seconds = {"TRG": 0.0, "CYCLES": 0.0}
    for seed in range(seeds):
        for engine, found in pictures.items():
            begin = time.process_time()
            found.append(render_once(scene, engine, seed + 1, folder))
            seconds[engine] += time.process_time() - begin
    return {engine: np.stack(found) for engine, found in pictures.items()}, seconds


def region_means(pictures: Pictures) -> Pictures:
    """(seeds, rows, columns): mean of the channels over each region; edges that fill none are dropped."""
    seeds, height, width, _ = pictures.shape
    rows, columns = height // REGION, width // REGION
    cut = pictures[:, : rows * REGION, : columns * REGION].mean(axis=-1)
    return cut.reshape(seeds, rows, REGION, columns, REGION).mean(axis=(2, 4))


def standard_error(values: Pictures) -> Pictures:
    return values.std(axis=0, ddof=1) / math.sqrt(len(values))


def compare(
    name: str, pictures: dict[str, Pictures], seconds: dict[str, float], warnings: tuple[str, ...]
) -> Agreement:
    ours, theirs = pictures["TRG"], pictures["CYCLES"]
    means = ours.mean(axis=(1, 2, 3)), theirs.mean(axis=(1, 2, 3))
    ratio = means[0].mean() / means[1].mean()
    ratio_error = math.hypot(
        float(standard_error(means[0])) / means[0].mean(), float(standard_error(means[1])) / means[1].mean()
    )
    a, b = region_means(ours), region_means(theirs)
    error = np.hypot(standard_error(a), standard_error(b))
    # A region that is nearly black counts against the picture's mean, not against itself.
    scale = np.maximum(b.mean(axis=0), 0.05 * b.mean())
    z = statistics.NormalDist().inv_cdf(1.0 - 0.005 / error.size)
    beyond = np.maximum(np.abs(a.mean(axis=0) - b.mean(axis=0)) - z * error, 0.0) / scale
    row, column = np.unravel_index(int(beyond.argmax()), beyond.shape)
    mean_beyond = max(abs(ratio - 1.0) - 2.6 * ratio_error, 0.0)
    return Agreement(
        name,
        float(ratio),
        float(ratio_error),
        float(beyond.max()),
        (int(column), int(row)),
        float(np.median(error / scale)),
        flip(ours.mean(axis=0), theirs.mean(axis=0)),
        (seconds["TRG"], seconds["CYCLES"]),
        bool(mean_beyond <= MEAN_LIMIT and beyond.max() <= REGION_LIMIT),
        warnings,
    )


def flip(ours: Pictures, theirs: Pictures) -> float | None:
    """Mean FLIP of the tone-mapped pictures; None without the package."""
    try:
        evaluator = importlib.import_module("flip_evaluator")
    except ImportError:
        return None
    shown = [np.ascontiguousarray(np.clip(p, 0.0, 1.0), dtype=np.float32) for p in (theirs, ours)]
    return float(evaluator.evaluate(shown[0], shown[1], "LDR", inputsRGB=False)[1])


def save_pair(pictures: dict[str, Pictures], path: Path) -> None:
    """A PNG: TRG above Cycles above ten times their difference."""
    ours, theirs = pictures["TRG"].mean(axis=0), pictures["CYCLES"].mean(axis=0)
    stack = np.concatenate([10.0 * np.abs(ours - theirs), theirs, ours])
    encoded = np.clip(stack, 0.0, 1.0) ** (1 / 2.2)
    made = bpy.data.images.new("pair", stack.shape[1], stack.shape[0])
    made.pixels.foreach_set(np.dstack([encoded, np.ones(stack.shape[:2])]).astype(np.float32).ravel())
    made.filepath_raw, made.file_format = str(path), "PNG"
    made.save()


def measure(name: str, args: argparse.Namespace, folder: Path) -> Agreement:
    stage = scenes()[name]()
    enable_engines()
    prepare(stage.scene, args.samples)
    pictures, seconds = render_both(stage.scene, args.seeds, folder)
    if args.out:
        save_pair(pictures, args.out / f"{name.replace(' ', '_')}.png")
    return compare(name, pictures, seconds, engine_warnings(stage.scene))


def engine_warnings(scene: Any) -> tuple[str, ...]:
    from trg_blender.engine.result import records

    report = records.report_of(scene.name)
    return tuple(report["warnings"]) if report else ()


def describe(one: Agreement) -> str:
    verdict = "agrees" if one.agrees else "EXCEPTION" if one.scene in EXCEPTIONS else "DIFFERS"
    shown = "    -" if one.flip is None else f"{one.flip:.3f}"
    return (
        f"{verdict:9} {one.scene:22} ratio {one.ratio:.4f} +- {one.ratio_error:.4f}, worst region "
        f"{100 * one.worst_region:5.2f} % at {one.worst_at} (noise {100 * one.noise:.2f} %), FLIP {shown}, "
        f"CPU s {one.seconds[0]:.1f} / {one.seconds[1]:.1f}"
    )


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="part of a scene's name")
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--out", type=Path, help="folder for a picture a scene: TRG, Cycles, difference x 10")
    parser.add_argument("--json", type=Path)
    args = parser.parse_args()
    if args.out:
        args.out.mkdir(parents=True, exist_ok=True)
    wanted = [name for name in scenes() if not args.names or any(part in name for part in args.names)]
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for name in wanted:
            results.append(measure(name, args, Path(folder)))
            print(describe(results[-1]), flush=True)
            for warning in results[-1].warnings:
                print(f"{'':10}{warning}")
    unexplained = [one.scene for one in results if not one.agrees and one.scene not in EXCEPTIONS]
    for one in results:
        if not one.agrees and one.scene in EXCEPTIONS:
            print(f"{one.scene}: {EXCEPTIONS[one.scene]}")
    print(
        f"{sum(one.agrees for one in results)} of {len(results)} scenes agree, {len(unexplained)} unexplained"
    )
    if args.json:
        args.json.write_text(json.dumps([asdict(one) for one in results], indent=1), encoding="utf-8")
    return 1 if unexplained else 0


if __name__ == "__main__":
    sys.exit(main())
