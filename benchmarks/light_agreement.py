"""This engine against Cycles, a line a light or camera: ratio of means and the worst block.

    python -m benchmarks.light_agreement [--samples N] [NAME ...]

Needs bpy. The scenes are those of tests/blender/cycles_scenes.py; a block is 8 x 8 pixels, its difference
told in percent of the picture's mean.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--samples", type=int, default=1024)
    args = parser.parse_args()
    from tests.blender.cycles_scenes import CAMERAS, LIGHTS, enable_cycles, new_scene, ratio_of_means

    enable_cycles()
    for name, build in (LIGHTS | CAMERAS).items():
        if args.names and not any(part in name for part in args.names):
            continue
        new_scene()
        build()
        ratio, worst = ratio_of_means(args.samples)
        print(f"{name:36} ratio {ratio:.4f}, worst block {100 * worst:.2f} %", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
