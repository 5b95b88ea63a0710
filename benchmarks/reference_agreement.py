"""Native against reference, a line a scene with the worst z-scores and the time of each.

    python -m benchmarks.reference_agreement [--samples 4096] [--reference-samples 512] [NAME ...]

Exit code 1 when a scene disagrees. NAME is a part of a scene's name.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tests.engine.agreement import Agreement, compare
from tests.engine.agreement_scenes import cases
from trg_blender.engine import session
from trg_blender.engine.scene_arrays import RenderSettings, SceneArrays


def compare_devices(scene: SceneArrays, settings: RenderSettings, samples: int) -> tuple[Agreement, str]:
    """Native with `samples` against reference with `settings.samples`; the text tells the times."""
    native = session.render(scene, replace(settings, device="cpu", samples=samples))
    begin = time.perf_counter()
    reference = session.render(scene, replace(settings, device="embree"))
    seconds = time.perf_counter() - begin
    return compare(native, reference), f"{native.report['seconds']['trace']:.2f} s / {seconds:.1f} s"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--samples", type=int, default=4096, help="of the native core")
    parser.add_argument("--reference-samples", type=int, default=0, help="0: as the scene says")
    args = parser.parse_args()
    failed = 0
    for name, (scene, settings) in cases().items():
        if args.names and not any(part in name for part in args.names):
            continue
        if args.reference_samples:
            settings = replace(settings, samples=args.reference_samples)
        agreement, times = compare_devices(scene, settings, args.samples)
        failed += not agreement.agrees
        print(f"{'agrees' if agreement.agrees else 'DIFFERS':8} {name:32} {agreement}, {times}", flush=True)
    print(f"{failed} scenes disagree")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
