"""What adaptive sampling saves: time to equal error, against equal samples everywhere.

    python -m benchmarks.adaptive [--seconds 1.5] [--rounds 5] [--size 160x120] [--examples NAME ...]

Method. Both ways render a scene for the same time, in turns, with other seeds each round. The error is
measured against a long reference. As the squared error falls with the time, the time to equal error is the
ratio of the squared errors. Median and spread are over the rounds.
"""

from __future__ import annotations

import argparse
import statistics
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from benchmarks.calibration_scenes import SCENES  # noqa: E402
from trg_blender.engine import session  # noqa: E402
from trg_blender.engine.error_curves import make_reference  # noqa: E402
from trg_blender.engine.image_error import rmse  # noqa: E402
from trg_blender.engine.report import ENDLESS_SAMPLES  # noqa: E402
from trg_blender.engine.scene_arrays import RenderSettings, SceneArrays  # noqa: E402

REFERENCE_FACTOR = 24


def scenes(args: argparse.Namespace, size: tuple[int, int]) -> Iterator[tuple[str, SceneArrays]]:
    if args.examples:
        from benchmarks.example_arrays import read_example, registered

        with registered():
            for name in args.examples:
                yield name, read_example(name, size)
        return
    for name, one in SCENES.items():
        yield name, one.build()


def compare(scene: SceneArrays, settings: RenderSettings, rounds: int) -> list[float]:
    """Squared error of adaptive over that of even sampling, a figure a round."""
    probe = session.render(scene, settings)
    truth = make_reference(scene, settings, REFERENCE_FACTOR * max(int(probe.report["samples"]), 16))
    ratios = []
    for number in range(rounds):
        errors = {}
        for adaptive in (False, True) if number % 2 else (True, False):
            one = replace(settings, seed=1 + number, adaptive=adaptive)
            errors[adaptive] = rmse(session.render(scene, one).pixels[..., :3].astype(np.float64), truth)
        ratios.append((errors[True] / errors[False]) ** 2)
    return ratios


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seconds", type=float, default=1.5)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--size", default="160x120")
    parser.add_argument("--examples", nargs="*", metavar="NAME", help="programs of examples/ (needs bpy)")
    args = parser.parse_args()
    width, height = (int(side) for side in args.size.split("x"))
    settings = RenderSettings(width, height, samples=ENDLESS_SAMPLES, seconds=args.seconds, max_bounces=8)
    print(f"{'scene':28} time to equal error, median [lowest, highest]")
    for name, scene in scenes(args, (width, height)):
        ratios = compare(scene, settings, args.rounds)
        print(f"{name:28} {statistics.median(ratios):.2f} [{min(ratios):.2f}, {max(ratios):.2f}]", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
