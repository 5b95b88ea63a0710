"""`trg report`: error against run time of a scene, by device, accelerator, integrator, test, antialiasing."""

from __future__ import annotations

import argparse
import csv
import itertools
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from .. import cli
from ..engine.devices import DEVICE_NAMES, INTEGRATORS, require_device
from ..engine.native import ACCELERATORS, TRIANGLE_TESTS
from ..engine.report import ENDLESS_SAMPLES
from ..engine.scene_arrays import RenderSettings
from .render import RenderCommand, RenderFailed, at_least, load_bpy, positive_number, size_of, source_path
from .render import add_parser as add_render_parser
from .render_output import blender_chatter_off

REFERENCE_FACTOR = 16
"""The reference has so many times the samples of the longest curve."""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = subparsers.add_parser(
        "report",
        help=cli.COMMANDS["report"],
        description="Renders a scene by every combination of choices, looks at each picture after the times "
        "given, and compares it with a long reference. Writes curves.csv, curves.png and report.html.",
    )
    add = parser.add_argument
    add("file", type=source_path, help="FILE.trg or FILE.blend")
    add("--devices", type=_list_of(DEVICE_NAMES), default=["cpu"], metavar="A,B")
    add("--accels", type=_list_of(ACCELERATORS), default=["auto"], metavar="A,B")
    add("--integrators", type=_list_of(INTEGRATORS), default=["path"], metavar="A,B")
    add(
        "--tests", type=_list_of(TRIANGLE_TESTS), default=["watertight"], metavar="A,B", help="triangle tests"
    )
    add(
        "--aas",
        type=_antialiasings,
        default=[""],
        metavar="A,B",
        help="none, supersampling, jittering, mfaa, sobol, each with :N for a grid of N x N cells, or the "
        "filters box, gaussian, blackman_harris with Sobol's points; else the scene's own",
    )
    add("--times", type=_times, default=[0.5, 1.0, 2.0, 4.0], metavar="S,S", help="seconds; 0.5,1,2,4")
    add("--seeds", type=at_least(1), default=3, metavar="N", help="renders of each combination; 3")
    add("--target", type=positive_number, metavar="RMSE", help="say when each combination reaches it")
    add("--reference", type=Path, metavar="FILE.exr", help="compare with this picture of the same size")
    add("--size", type=size_of, metavar="WxH", help="picture size; else the program's or the file's")
    add("--frame", type=int, metavar="N")
    add("--threads", type=at_least(0), default=0, metavar="N", help="0: all cores")
    add("--out", type=Path, default=Path("report"), metavar="DIR", help="where the three files go; report")


def run(args: argparse.Namespace) -> int:
    """Measures and writes. Raises Unavailable without bpy, matplotlib or an asked device."""
    from .report_page import load_matplotlib, write_chart, write_page

    if not args.file.is_file():
        raise FileNotFoundError(f"there is no file {args.file}")
    load_matplotlib()
    for device in args.devices:
        require_device(device)
    with blender_chatter_off() as out:
        try:
            measured = measure(args, out)
        except RenderFailed as failure:
            sys.stderr.write(f"{failure}\n")
            return failure.code
        args.out.mkdir(parents=True, exist_ok=True)
        write_table(args.out / "curves.csv", measured.points)
        write_chart(args.out / "curves.png", measured)
        write_page(args.out / "report.html", measured, args.out / "curves.png")
        out.write(f"{args.out / 'report.html'}\n")
        out.flush()
    return cli.DONE


@dataclass(frozen=True, slots=True)
class Measured:
    """What the page and the chart show."""

    title: str
    size: tuple[int, int]
    points: list[Any]
    references: dict[str, str]
    """integrator and pixel filter -> where their reference comes from"""
    target: float | None


def measure(args: argparse.Namespace, out: Any) -> Measured:
    from ..engine.error_curves import measure_curve

    scene, settings = read_scene(args)
    points: list[Any] = []
    references: dict[str, str] = {}
    truths: dict[str, Any] = {}
    for variant in variants_of(args):
        chosen = variant.apply(settings)
        wanted = f"{variant.integrator}, {chosen.pixel_filter}"
        if wanted not in truths:
            truths[wanted], references[wanted] = reference_for(args, scene, chosen, out)
        for seed in range(1, args.seeds + 1):
            seeded = replace(settings, seed=seed)
            curve = measure_curve(scene, seeded, args.times, truths[wanted], variant)
            for point in curve:
                points.append(point)
                out.write(
                    f"{variant.name}, seed {seed}: {point.seconds:.2f} s, {point.samples:.0f} samples, "
                    f"rmse {point.measured:.4g}"
                    + (f" (stated {point.stated:.4g})\n" if point.stated is not None else "\n")
                )
                out.flush()
    return Measured(str(args.file), (settings.width, settings.height), points, references, args.target)


def variants_of(args: argparse.Namespace) -> Iterator[Any]:
    """Every combination; the reference renderer has no accelerators of its own."""
    from ..engine.error_curves import Variant

    seen = set()
    for device, accel, integrator, test, aa in itertools.product(
        args.devices, args.accels, args.integrators, args.tests, args.aas
    ):
        variant = (
            Variant(device, accel, integrator, test, aa)
            if device != "embree"
            else Variant(device, "auto", integrator, aa=aa)
        )
        if variant not in seen:
            seen.add(variant)
            yield variant


def reference_for(args: argparse.Namespace, scene: Any, settings: Any, out: Any) -> tuple[Any, str]:
    """The picture to compare with and where it comes from. Raises RenderFailed for one that does not fit."""
    from ..engine import session
    from ..engine.error_curves import make_reference

    if args.reference is not None:
        return read_reference(args.reference, (settings.height, settings.width)), str(args.reference)
    longest = replace(settings, device="cpu", samples=ENDLESS_SAMPLES, seconds=args.times[-1], aa="sobol")
    probe = session.render(scene, longest)
    samples = max(REFERENCE_FACTOR * int(probe.report["samples"]), 256)
    out.write(f"reference of {settings.integrator}: {samples} samples\n")
    out.flush()
    return make_reference(scene, settings, samples), f"cpu, {samples} samples a pixel"


def read_reference(path: Path, shape: tuple[int, int]) -> Any:
    """(h, w, 3) float64, bottom row first, from an EXR or other float picture that Blender reads."""
    import numpy as np

    bpy = load_bpy()
    try:
        image = bpy.data.images.load(str(path.resolve()))
    except RuntimeError as error:
        raise RenderFailed(f"trg: error: {path}: it cannot be read as a picture", cli.WRONG) from error
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    if (height, width) != shape:
        raise RenderFailed(
            f"trg: error: {path}: it is {width} x {height}, the picture {shape[1]} x {shape[0]}", cli.WRONG
        )
    pixels = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)[..., :3].astype(np.float64)


def read_scene(args: argparse.Namespace) -> tuple[Any, Any]:
    """Arrays and settings of the frame, by the way that `trg render` takes. Raises RenderFailed."""
    words = argparse.ArgumentParser()
    add_render_parser(words.add_subparsers())
    asked = words.parse_args(["render", str(args.file)])
    asked.size, asked.frame, asked.threads = args.size, args.frame, args.threads
    asked.no_adaptive = asked.quiet = True
    with open_scene(asked) as command:
        arrays, settings = command.read(next(iter(command.frames())))
    return arrays, replace(settings, samples=ENDLESS_SAMPLES, threads=args.threads, passes=())


@contextmanager
def open_scene(args: argparse.Namespace) -> Iterator[RenderCommand]:
    """`args` are those of `trg render`."""
    command = RenderCommand(load_bpy(), args, sys.stderr)
    try:
        command.open()
        yield command
    finally:
        command.close()


def write_table(path: Path, points: list[Any]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(
            "device accel integrator triangle_test aa seed seconds samples rmse stated low high".split()
        )
        for p in points:
            v = p.variant
            table.writerow(
                [
                    v.device,
                    v.accel,
                    v.integrator,
                    v.triangle_test,
                    v.aa,
                    p.seed,
                    f"{p.seconds:.6g}",
                    f"{p.samples:g}",
                ]
                + ["" if x is None else f"{x:.6g}" for x in (p.measured, p.stated, p.low, p.high)]
            )


def _list_of(known: tuple[str, ...]) -> Any:
    def words(text: str) -> list[str]:
        found = [word.strip() for word in text.split(",") if word.strip()]
        unknown = [word for word in found if word not in known]
        if unknown or not found:
            raise argparse.ArgumentTypeError(f"{text!r}: choose from {', '.join(known)}")
        return found

    return words


def _antialiasings(text: str) -> list[str]:
    from ..engine.error_curves import with_antialiasing

    found = [word.strip() for word in text.split(",") if word.strip()]
    if not found:
        raise argparse.ArgumentTypeError(f"{text!r} names no method")
    for word in found:
        try:
            with_antialiasing(RenderSettings(1, 1), word)
        except ValueError as refusal:
            raise argparse.ArgumentTypeError(str(refusal)) from refusal
    return found


def _times(text: str) -> list[float]:
    times = sorted({positive_number(part) for part in text.split(",") if part.strip()})
    if not times:
        raise argparse.ArgumentTypeError(f"{text!r} holds no seconds")
    return times
