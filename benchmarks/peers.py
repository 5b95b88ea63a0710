"""Error against time beside other engines, on the scenes of ../shared/peers.

    python -m benchmarks.peers [--scenes cornell,outdoor,instances] [--res 128] [--samples 4 16 64]
        [--seeds 3] [--reference 1024] [--peers DIR] [--out DIR]

Method. TRG and Cycles render the same Blender file in one process, in turns: same bounces, box filter of one
pixel, no denoiser, no clamping, no adaptive sampling, two threads. Times are CPU seconds of the process
around the render call. A line fitted through the numbers of samples tells the cost of a sample from the
fixed costs. Each engine is compared with its own long reference, the mean of two halves whose difference
gives the reference's noise, which is taken off. Error: root of relMSE, mean((x - ref)^2 / (ref^2 + 0.01))
without the worst 0.1 % of the pixels. The time to an error comes from a power law through the errors.

--peers DIR adds what ../shared/peers/run_mitsuba.py and run_lux.py have left there (--out DIR, the same
--res): other processes, other minutes, so their times are less comparable. --out DIR gets a chart a scene.
"""

from __future__ import annotations

import argparse
import json
import math
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from benchmarks.agree import prepare, render_once  # noqa: E402
from benchmarks.engines import enable_engines  # noqa: E402
from benchmarks.peer_scenes import NAMES, build, describe  # noqa: E402

Picture = NDArray[np.float64]
ENGINES = ("TRG", "CYCLES")
KEPT = 0.999
GOALS = (0.05, 0.02, 0.01)


@dataclass(frozen=True, slots=True)
class Look:
    """One render: what it cost and how wrong it was."""

    samples: int
    cpu: float
    error: float


@dataclass(frozen=True, slots=True)
class Engine:
    name: str
    looks: list[Look]

    def cost(self) -> tuple[float, float]:
        """(CPU seconds a sample a pixel of the whole picture, fixed seconds)."""
        n = np.array([look.samples for look in self.looks], dtype=float)
        t = np.array([look.cpu for look in self.looks])
        slope, fixed = np.polyfit(n, t, 1, w=1.0 / np.maximum(t, 0.05))
        return float(slope), float(fixed)

    def law(self) -> tuple[float, float]:
        """log error = a + b log samples."""
        n = np.log([look.samples for look in self.looks])
        b, a = np.polyfit(n, np.log([max(look.error, 1e-9) for look in self.looks]), 1)
        return float(a), float(b)

    def cpu_to(self, error: float) -> float:
        """CPU seconds of sampling until the error is met."""
        a, b = self.law()
        return math.exp((math.log(error) - a) / b) * self.cost()[0]


def relative_error(picture: Picture, halves: tuple[Picture, Picture]) -> float:
    truth, noise = 0.5 * (halves[0] + halves[1]), 0.25 * (halves[0] - halves[1]) ** 2
    below = truth**2 + 0.01
    each = ((picture - truth) ** 2 / below).mean(axis=-1).ravel()
    own = np.sort((noise / below).mean(axis=-1).ravel())
    kept = np.sort(each)[: int(len(each) * KEPT)]
    return math.sqrt(max(kept.mean() - own[: len(kept)].mean(), 1e-12))


def timed(scene: Any, engine: str, seed: int, folder: Path) -> tuple[Picture, float]:
    begin = time.process_time()
    picture = render_once(scene, engine, seed, folder)
    return picture, time.process_time() - begin


def measure(name: str, args: argparse.Namespace, folder: Path) -> list[Engine]:
    described = describe(name)
    scene = build(described, args.res)
    enable_engines()
    prepare(scene, args.reference)
    bounces = described["max_bounces"]
    scene.trg.max_bounces = bounces
    for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max"):
        setattr(scene.cycles, f"{kind}_bounces", bounces)
    scene.render.threads_mode, scene.render.threads = "FIXED", args.threads
    halves = {
        engine: (render_once(scene, engine, 9001, folder), render_once(scene, engine, 77, folder))
        for engine in ENGINES
    }
    looks: dict[str, list[Look]] = {engine: [] for engine in ENGINES}
    for seed in range(args.seeds):
        for samples in args.samples:
            scene.trg.samples = scene.cycles.samples = samples
            for engine in ENGINES if seed % 2 else reversed(ENGINES):
                picture, cpu = timed(scene, engine, 101 + seed, folder)
                looks[engine].append(Look(samples, cpu, relative_error(picture, halves[engine])))
    found = [Engine(engine, looks[engine]) for engine in ENGINES]
    ratio = np.mean(halves["TRG"]) / np.mean(halves["CYCLES"])
    print(f"\n{name}, {args.res} x {args.res}: means of the references, TRG over Cycles: {ratio:.4f}")
    return found + list(read_peers(args.peers, name))


def read_peers(folder: Path | None, scene: str) -> Iterator[Engine]:
    """What the scripts of ../shared/peers have left."""
    if folder is None or not (folder / scene).is_dir():
        return
    for path in sorted((folder / scene).iterdir()):
        if not (path / "refB.npy").is_file():
            continue
        halves = tuple(np.load(path / f"ref{half}.npy").astype(np.float64) for half in "AB")
        rows = [json.loads(line) for line in (path / "log.jsonl").read_text().splitlines()]
        looks = [
            Look(
                row["actual"],
                row["cpu"],
                relative_error(np.load(path / f"spp{row['spp']}.npy").astype(np.float64), halves),  # type: ignore[arg-type]
            )
            for row in rows
            if row["kind"] == "render" and row["spp"] >= 4
        ]
        yield Engine(path.name, looks)


def tell(engines: list[Engine], args: argparse.Namespace) -> float:
    """Prints the table; gives TRG's time over the best peer's at the error of Cycles at 32 samples."""
    cycles = next(one for one in engines if one.name == "CYCLES")
    a, b = cycles.law()
    goal = math.exp(a + b * math.log(32.0))
    print(
        f"{'engine':18} {'ns/sample':>9} {'fixed s':>8} {'slope':>6}  CPU us/pixel to {goal:.3f}  "
        "CPU s to 5 %, 2 %, 1 %"
    )
    pixels = args.res**2
    times = {}
    for one in engines:
        cost, fixed = one.cost()
        times[one.name] = one.cpu_to(goal)
        to_goals = ", ".join(f"{one.cpu_to(error):.2f}" for error in GOALS)
        print(
            f"{one.name:18} {cost / pixels * 1e9:9.0f} {fixed:8.2f} {one.law()[1]:6.2f}  "
            f"{times[one.name] / pixels * 1e6:20.1f}  {to_goals}"
        )
    best = min(seconds for name, seconds in times.items() if name != "TRG")
    print(
        f"TRG needs {times['TRG'] / best:.2f} of the best peer's time, "
        f"{times['TRG'] / times['CYCLES']:.2f} of Cycles'"
    )
    return times["TRG"] / best


def draw(name: str, engines: list[Engine], folder: Path) -> None:
    from trg_blender.commands.report_page import load_matplotlib

    load_matplotlib()
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(8, 5.5))
    for one in engines:
        axes.plot([k.cpu for k in one.looks], [k.error for k in one.looks], "o", label=one.name)
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="CPU seconds",
        ylabel="root of relMSE, worst 0.1 % left out",
        title=name,
    )
    axes.grid(True, which="both", color="0.9")
    axes.legend()
    figure.tight_layout()
    figure.savefig(folder / f"{name}.png", dpi=100)
    pyplot.close(figure)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scenes", default=",".join(NAMES))
    parser.add_argument("--res", type=int, default=128)
    parser.add_argument("--samples", type=int, nargs="+", default=[4, 16, 64])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--reference", type=int, default=1024, help="samples of each half")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--peers", type=Path)
    parser.add_argument("--out", type=Path)
    args = parser.parse_args()
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        for name in args.scenes.split(","):
            engines = measure(name, args, Path(folder))
            ratios.append(tell(engines, args))
            if args.out:
                args.out.mkdir(parents=True, exist_ok=True)
                draw(name, engines, args.out)
    print(
        f"\ngeometric mean over {len(ratios)} scenes: "
        f"{statistics.geometric_mean(ratios):.2f} of the best peer's time"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
