"""Native against reference, a line a scene with the worst z-scores and the time of each.

    python -m benchmarks.reference_agreement [--samples N] [--reference-samples N] [--examples] [NAME ...]

Exit code 1 when a scene disagrees. NAME is a part of a scene's name. --examples takes the programs of
examples/ through Blender (needs bpy) instead of the small scenes of the tests.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tests.engine.agreement import Agreement, compare
from tests.engine.agreement_scenes import Case, cases
from trg_blender.engine import session
from trg_blender.engine.scene_arrays import RenderSettings, SceneArrays

EXAMPLE_SETTINGS = RenderSettings(32, 24, samples=64, max_bounces=4)


def compare_devices(scene: SceneArrays, settings: RenderSettings, samples: int) -> tuple[Agreement, str]:
    """Native with `samples` against reference with `settings.samples`; the text tells the times."""
    native = session.render(scene, replace(settings, device="cpu", samples=samples))
    begin = time.perf_counter()
    reference = session.render(scene, replace(settings, device="embree"))
    seconds = time.perf_counter() - begin
    return compare(native, reference), f"{native.report['seconds']['trace']:.2f} s / {seconds:.1f} s"


def example_cases(parts: list[str]) -> Iterator[tuple[str, Case]]:
    """The examples whose names hold one of `parts` (all when there is none), read one at a time."""
    from benchmarks.example_arrays import example_names, read_example, registered

    with registered():
        for name in example_names():
            if is_wanted(name, parts):
                size = (EXAMPLE_SETTINGS.width, EXAMPLE_SETTINGS.height)
                yield name, (read_example(name, size), EXAMPLE_SETTINGS)


def is_wanted(name: str, parts: list[str]) -> bool:
    return not parts or any(part in name for part in parts)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--samples", type=int, default=4096, help="of the native core")
    parser.add_argument("--reference-samples", type=int, default=0, help="0: as the scene says")
    parser.add_argument("--examples", action="store_true")
    args = parser.parse_args()
    small = ((name, case) for name, case in cases().items() if is_wanted(name, args.names))
    chosen = example_cases(args.names) if args.examples else small
    failed = 0
    for name, (scene, settings) in chosen:
        if args.reference_samples:
            settings = replace(settings, samples=args.reference_samples)
        agreement, times = compare_devices(scene, settings, args.samples)
        failed += not agreement.agrees
        print(f"{'agrees' if agreement.agrees else 'DIFFERS':8} {name:32} {agreement}, {times}", flush=True)
    print(f"{failed} scenes disagree")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
