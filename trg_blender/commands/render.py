"""`trg render`: a TRG program or a .blend file to pictures, with Blender as a Python module.

The program runs through the same handlers, and the picture through the same engine and the same saving,
as in `blender -b FILE -E TRG -f N`: the pixels are the same.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import math
import re
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any, TextIO

from .. import cli
from ..engine.antialiasing import ANTIALIASINGS
from ..engine.devices import DEVICE_NAMES, INTEGRATORS, Unavailable, require_device
from ..engine.native import ACCELERATORS
from ..engine.report import ENDLESS_SAMPLES, with_source
from ..engine.scene_arrays import PIXEL_FILTERS
from ..lang import ProgramError
from .parameters import SetError, add_set, parameters_of
from .render_output import (
    ProgressPrinter,
    blender_chatter_off,
    describe_report,
    frame_path,
    repeat_rejected,
    write_report,
)

LIGHT_PATHS = {
    "max_bounces": "times that light may scatter after the first surface",
    "diffuse_bounces": "of these, diffuse ones",
    "glossy_bounces": "glossy ones",
    "transmission_bounces": "refractions and light through surfaces",
    "transparent_bounces": "surfaces that rays go straight through",
    "clamp_direct": "limit for a sample of direct light; 0: none",
    "clamp_indirect": "limit for a sample of indirect light; 0: none",
}
"""options that are properties of the scene -> what they limit"""
SOURCES, PICTURES = (".trg", ".blend"), (".png", ".exr")
EXIT_CODES = {
    "program": cli.WRONG,
    "scene": cli.WRONG,
    "internal": cli.WRONG,
    "budget": cli.CANCELLED,
    "cancelled": cli.CANCELLED,
    "unavailable": cli.UNAVAILABLE,
}


class RenderFailed(Exception):
    """A frame gave no picture; `code` is the command's exit code."""

    def __init__(self, message: str, code: int) -> None:
        super().__init__(message)
        self.code = code


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = subparsers.add_parser(
        "render",
        help=cli.COMMANDS["render"],
        description="Renders frames of a TRG program or a .blend file. EXR holds scene-linear float32, with "
        "depth and normal as layers; PNG is 8 bit through the scene's view transform.",
    )
    add = parser.add_argument
    add("file", type=source_path, help="FILE.trg or FILE.blend")
    add("-o", "--output", type=_path_with(PICTURES), metavar="OUT", help="picture (.png or .exr); FILE.png")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--frame", type=int, metavar="N", help="frame to render")
    which.add_argument("--frames", type=_frame_range, metavar="A-B", help="frames to render; numbered files")
    add("--size", type=size_of, metavar="WxH", help="picture size; else the program's or the file's")
    add("--pixel", type=pixel_of, metavar="X,Y", help="this pixel alone; 0,0 is the bottom left one")
    add("--device", choices=("auto", *DEVICE_NAMES), help="what traces the rays")
    add("--accel", choices=ACCELERATORS, help="structure that finds the nearest surface")
    add("--integrator", choices=INTEGRATORS, help="how light is gathered")
    add("--aa", choices=("auto", *ANTIALIASINGS), help="which points of a pixel are sampled")
    add("--aa-side", type=at_least(1), metavar="N", help="a pixel's grid of N x N cells for --aa")
    add("--samples", type=at_least(1), metavar="N", help="light paths for each pixel")
    add("--time", type=positive_number, metavar="S", help="stop after so many seconds of tracing")
    add("--error", type=positive_number, metavar="RMSE", help="stop at this estimated error of the picture")
    add("--no-adaptive", action="store_true", help="with --time or --error: all pixels get equal samples")
    add("--filter", choices=PIXEL_FILTERS, metavar="NAME", help="pixel filter: " + ", ".join(PIXEL_FILTERS))
    add("--filter-width", type=positive_number, metavar="PIXELS", help="width of filters but box; 1.5")
    add_light_paths(parser)
    add("--seed", type=at_least(0), metavar="N", help="changes the noise")
    add("--threads", type=at_least(0), metavar="N", help="0: all cores")
    add("--engine", choices=("TRG", "CYCLES"), default="TRG", help="engine that renders the scene")
    add("--report", type=Path, metavar="FILE", help="write the report as JSON; several frames give a list")
    add_set(parser)
    add("--quiet", action="store_true", help="no progress and no closing paragraph")


def add_light_paths(parser: argparse.ArgumentParser) -> None:
    """Options that cut paths short; what they take away is named in the report, apart from the error."""
    for option, what in LIGHT_PATHS.items():
        kind = non_negative_number if option.startswith("clamp") else at_least(0)
        shown = "LIGHT" if option.startswith("clamp") else "N"
        parser.add_argument("--" + option.replace("_", "-"), type=kind, metavar=shown, help=what)


def run(args: argparse.Namespace) -> int:
    """Renders what `args` ask for. Raises Unavailable without bpy or the asked device."""
    if not args.file.is_file():
        raise FileNotFoundError(f"there is no file {args.file}")
    bpy = load_bpy()
    if args.engine == "TRG" and args.device not in (None, "auto"):
        require_device(args.device)
    with blender_chatter_off() as out:
        job = RenderCommand(bpy, args, out)
        try:
            job.open()
            for frame in job.frames():
                job.render(frame)
        except RenderFailed as failure:
            sys.stderr.write(f"{failure}\n")
            return failure.code
        finally:
            job.close()
        if args.report is not None:
            write_report(args.report, job.reports)
    return cli.DONE


def load_bpy() -> ModuleType:
    """Blender as a module. Raises Unavailable with the way to get it."""
    try:
        return importlib.import_module("bpy")
    except ImportError as failure:
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        raise Unavailable(
            f"Blender's module bpy cannot be loaded in Python {version} ({failure}); "
            "pip install bpy==4.5.15 (Python 3.11) or bpy==5.2.3 (Python 3.13)"
        ) from failure


@dataclass(slots=True)
class RenderCommand:
    """One run of the command inside one Blender."""

    bpy: ModuleType
    args: argparse.Namespace
    out: TextIO
    reports: list[dict[str, Any]] = field(default_factory=list)
    _registered_here: bool = False

    def open(self) -> None:
        """Loads the scene or the program, and applies the options."""
        bpy, args = self.bpy, self.args
        if not hasattr(bpy.types.Scene, "trg"):
            self._registration().register()
            self._registered_here = True
        path = str(args.file.resolve())
        if args.file.suffix.lower() == ".blend":
            try:
                bpy.ops.wm.open_mainfile(filepath=path, load_ui=False)
            except RuntimeError as error:
                message = f"trg: error: {args.file}: {_operator_message(error)}"
                raise RenderFailed(message, cli.WRONG) from error
        else:
            bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
            bpy.context.scene.trg.program = bpy.data.texts.load(path)
        apply_options(bpy, bpy.context.scene, args)
        self._set_parameters()

    def _set_parameters(self) -> None:
        """Stores what --set asks for in the scene. Raises RenderFailed; a wrong program fails later."""
        from ..engine.run_text import read_program
        from ..engine.to_blender.parameters import store_parameters

        if not self.args.settings:
            return
        scene = self.bpy.context.scene
        try:
            program = read_program(scene)
            if program is None:
                raise SetError(f"--set {self.args.settings[0]}: the scene has no program")
            store_parameters(scene, program, parameters_of(program, self.args.settings))
        except SetError as error:
            raise RenderFailed(f"trg: error: {error}", cli.USAGE) from error
        except ProgramError:
            return

    def close(self) -> None:
        """Leaves Blender as it was found."""
        if self._registered_here:
            self._registration().unregister()

    def frames(self) -> range:
        """Frames to render: those asked for, else a program's first, else a file's current one."""
        if self.args.frames is not None:
            return self.args.frames
        frame = self.args.frame
        if frame is None:
            frame = 1 if self.args.file.suffix.lower() == ".trg" else self.bpy.context.scene.frame_current
        return range(frame, frame + 1)

    def render(self, frame: int) -> None:
        """One frame to one file. Raises RenderFailed; then no file was written."""
        from ..engine.result import records

        output = self.args.output or Path(self.args.file.stem + ".png")
        picture = frame_path(output, frame, self.args.frames is not None).resolve()
        picture.parent.mkdir(parents=True, exist_ok=True)
        scene = self.bpy.context.scene
        scene.frame_set(frame)
        scene.render.filepath = str(picture)
        script_seconds = self._run_program(scene)
        if self.args.pixel is not None:
            choose_pixel(scene.render, self.args.pixel)
        progress = ProgressPrinter(sys.stderr, f"frame {frame}", self.args.quiet)
        records.watcher = progress
        begin = time.perf_counter()
        try:
            self.bpy.ops.render.render(write_still=True)
        except RuntimeError as error:
            failure = records.failure_of(scene.name)
            if failure is None:
                raise RenderFailed(f"trg: error: {_operator_message(error)}", cli.WRONG) from error
            raise RenderFailed(f"trg: error: {failure.message}", EXIT_CODES[failure.kind]) from error
        finally:
            progress.close()
            records.watcher = None
        self._finish(picture, frame, {"script": script_seconds, "total": time.perf_counter() - begin})

    def read(self, frame: int) -> tuple[Any, Any]:
        """Arrays and settings of a frame, as the engine would read them. Raises RenderFailed."""
        from ..engine.from_blender import SceneReader
        from ..engine.render_engine import settings_of
        from ..engine.to_blender import requested_modes

        scene = self.bpy.context.scene
        scene.frame_set(frame)
        self._run_program(scene)
        self.bpy.context.view_layer.update()
        depsgraph = self.bpy.context.evaluated_depsgraph_get()
        render = scene.render
        share = render.resolution_percentage / 100.0
        size = (max(int(render.resolution_x * share), 1), max(int(render.resolution_y * share), 1))
        arrays = SceneReader().read(depsgraph.scene_eval, depsgraph, size)
        modes = requested_modes(scene)
        return arrays, settings_of(scene, self.bpy.context.view_layer, size, modes, arrays.warnings)

    def _run_program(self, scene: Any) -> float | None:
        """Runs the scene's program as the render's handlers will (who then find the frame ready).

        Gives its seconds, None without a program; writes what it printed. Raises RenderFailed with its
        diagnostics.
        """
        from ..engine.run_text import frame_of, program_log, run_program

        outcome = run_program(scene, frame_of(scene))
        if outcome is None:
            return None
        log = program_log(scene)
        lines = [line for line in log if outcome.failure is None or line != outcome.failure.text]
        log.clear()
        if not self.args.quiet:
            self.out.writelines(f"{line}\n" for line in lines)
            self.out.flush()
        if outcome.failure is not None:
            raise RenderFailed(outcome.failure.text, outcome.failure.exit_code)
        return float(outcome.seconds)

    def _finish(self, picture: Path, frame: int, seconds: dict[str, float | None]) -> None:
        from ..engine.result import records

        scene = self.bpy.context.scene
        report = records.report_of(scene.name)
        if report is None:
            size = [scene.render.resolution_x, scene.render.resolution_y]
            report = {"file": None, "frame": frame, "size": size, "engine": scene.render.engine}
            report["seconds"] = seconds
        elif seconds["script"] is not None:
            report = with_source(report, None, frame, {"script": seconds["script"]})
        report = {**report, "file": str(self.args.file)}
        self.reports.append(report)
        if self.args.quiet:
            return
        if "error" in report:
            self.out.write(describe_report(picture, report) + repeat_rejected(self.args, report) + "\n")
        else:
            self.out.write(f"{picture}: {scene.render.engine}, {seconds['total']:.2f} s\n")
        self.out.flush()

    def _registration(self) -> ModuleType:
        return importlib.import_module("..ui.registration", __package__)


def apply_options(bpy: ModuleType, scene: Any, args: argparse.Namespace) -> None:
    """Options of the command line over the settings of the scene."""
    if args.engine == "CYCLES":
        importlib.import_module("addon_utils").enable("cycles")
        for name, value in (("samples", args.samples), ("seed", args.seed)):
            if value is not None:
                setattr(scene.cycles, name, value)
    scene.render.engine = args.engine
    for name in ("device", "accel", "integrator", "aa", "aa_side", "samples", "seed", *LIGHT_PATHS):
        value = getattr(args, name)
        if value is not None:
            setattr(scene.trg, name, value)
    if args.filter is not None:
        scene.trg.filter_type = args.filter.upper()
    if args.filter_width is not None:
        scene.trg.filter_width = args.filter_width
    if args.engine == "TRG":
        set_stops(scene.trg, args)
    if args.threads:
        scene.render.threads_mode, scene.render.threads = "FIXED", args.threads
    elif args.threads == 0:
        scene.render.threads_mode = "AUTO"
    if args.size is not None:
        scene["trg_keep_size"] = True
        scene.render.resolution_x, scene.render.resolution_y = args.size
        scene.render.resolution_percentage = 100
    choose_format(scene, args)


def choose_pixel(render: Any, pixel: tuple[int, int]) -> None:
    """A border of one pixel, to which the picture is cropped. Raises RenderFailed outside the picture."""
    share = render.resolution_percentage / 100.0
    size = [max(int(side * share), 1) for side in (render.resolution_x, render.resolution_y)]
    if any(at >= side for at, side in zip(pixel, size, strict=True)):
        raise RenderFailed(
            f"trg: error: --pixel {pixel[0]},{pixel[1]}: the picture has {size[0]} x {size[1]}", cli.USAGE
        )
    render.use_border = render.use_crop_to_border = True
    for axis, at, side in zip("xy", pixel, size, strict=True):
        # Blender rounds down: half a pixel more is safe.
        setattr(render, f"border_min_{axis}", (at + 0.5) / side)
        setattr(render, f"border_max_{axis}", min((at + 1.5) / side, 1.0))


def set_stops(own: Any, args: argparse.Namespace) -> None:
    """Time and error end the render; without --samples nothing else does."""
    if args.time is not None:
        own.use_time_limit, own.time_limit = True, args.time
    if args.error is not None:
        own.use_error_target, own.error_target = True, args.error
    if args.no_adaptive:
        own.use_adaptive = False
    if args.samples is None and (args.time is not None or args.error is not None):
        own.samples = ENDLESS_SAMPLES


def choose_format(scene: Any, args: argparse.Namespace) -> None:
    """PNG of 8 bit, or EXR of 32: with layers when passes are rendered, as they always are for a program."""
    image = scene.render.image_settings
    if args.output is None or args.output.suffix.lower() == ".png":
        _set_media_type(image, "IMAGE")
        image.file_format, image.color_depth = "PNG", "8"
        return
    if args.file.suffix.lower() == ".trg":
        for layer in scene.view_layers:
            layer.use_pass_z = layer.use_pass_normal = True
    layered = any(layer.use_pass_z or layer.use_pass_normal for layer in scene.view_layers)
    _set_media_type(image, "MULTI_LAYER_IMAGE" if layered else "IMAGE")
    image.file_format = "OPEN_EXR_MULTILAYER" if layered else "OPEN_EXR"
    image.color_depth = "32"


def _set_media_type(image: Any, kind: str) -> None:
    """Blender 5 wants the kind of file before its format; Blender 4 has no such setting."""
    if hasattr(image, "media_type"):
        image.media_type = kind


def _operator_message(error: RuntimeError) -> str:
    return str(error).strip().removeprefix("Error: ").strip()


def _path_with(suffixes: tuple[str, ...]) -> Any:
    def path(text: str) -> Path:
        if Path(text).suffix.lower() not in suffixes:
            raise argparse.ArgumentTypeError(f"{text!r} does not end in {' or '.join(suffixes)}")
        return Path(text)

    return path


source_path = _path_with(SOURCES)


def _frame_range(text: str) -> range:
    match = re.fullmatch(r"(-?\d+)-(-?\d+)", text)
    if match is None or int(match[2]) < int(match[1]):
        raise argparse.ArgumentTypeError(f"{text!r} is not a range of frames such as 1-24")
    return range(int(match[1]), int(match[2]) + 1)


def size_of(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d+)[xX](\d+)", text)
    if match is None or not int(match[1]) or not int(match[2]):
        raise argparse.ArgumentTypeError(f"{text!r} is not a size such as 640x480")
    return int(match[1]), int(match[2])


def pixel_of(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d+),(\d+)", text)
    if match is None:
        raise argparse.ArgumentTypeError(f"{text!r} is not a pixel such as 12,40")
    return int(match[1]), int(match[2])


def positive_number(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not (value > 0.0 and math.isfinite(value)):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number above 0")
    return value


def non_negative_number(text: str) -> float:
    return 0.0 if text.strip() in ("0", "0.0") else positive_number(text)


def at_least(lowest: int) -> Any:
    def number(text: str) -> int:
        if not text.isdigit() or int(text) < lowest:
            raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of at least {lowest}")
        return int(text)

    return number
