"""How soon a render ends after it was told to: seconds from cancel() to done, on both devices.

    .venv/3.13/bin/python benchmarks/cancel.py [--rounds 11]
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from benchmarks.example_arrays import read_example, registered  # noqa: E402
from trg_blender.engine import session  # noqa: E402
from trg_blender.engine.scene_arrays import RenderSettings, SceneArrays  # noqa: E402

SIZE = (640, 360)
WARM_UP_S = 0.3


def measure_cancel(scene: SceneArrays, settings: RenderSettings) -> float:
    """Seconds from cancel() until the job says that it is done."""
    job = session.start(scene, settings)
    until = time.perf_counter() + WARM_UP_S
    while time.perf_counter() < until:
        job.poll(0.02)
    begin = time.perf_counter()
    job.cancel()
    while not job.poll(0.005).done:
        pass
    return time.perf_counter() - begin


def main() -> int:
    """Prints a line a device: median, least and most of the rounds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=11)
    rounds = parser.parse_args().rounds
    with registered():
        scene = read_example("fence", SIZE)
    for device in ("cpu", "embree"):
        settings = RenderSettings(*SIZE, samples=1 << 20, max_bounces=64, device=device)
        seconds = [measure_cancel(scene, settings) for _ in range(rounds)]
        sys.stdout.write(
            f"{device}: {1000 * statistics.median(seconds):.0f} ms"
            f" ({1000 * min(seconds):.0f} to {1000 * max(seconds):.0f}) from cancel to done\n"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
