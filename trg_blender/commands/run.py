"""`trg run`: runs a program alone; prints its output, then its diagnostics."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from ..lang import (
    Diagnostic,
    DiskFiles,
    FrameEvent,
    HostOptions,
    Limits,
    ProgramError,
    Session,
    SourceFile,
    compile_source,
    render_diagnostic,
)
from ..lang.files import bundled_library
from ..lang.limits import change_limits
from .language import add_language, chosen_language
from .parameters import SetError, add_set, parameters_of, refuse

DONE, WRONG, OUT_OF_BUDGET = 0, 1, 3


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add `run` to the command line."""
    parser = subparsers.add_parser(
        "run", help="run a TRG program alone", description="Runs a program without Blender or tracing."
    )
    parser.add_argument("file", metavar="FILE.trg")
    parser.add_argument("--frames", type=positive, default=1, metavar="N", help="frames to run (1)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument(
        "--max-steps", type=positive, default=Limits().max_steps, metavar="N",
        help="steps allowed for one frame (%(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--limit", type=one_limit, action="append", default=[], metavar="NAME=VALUE",
        help="change a limit that an error named, for example max_shapes=2000000",
    )  # fmt: skip
    add_language(parser)
    add_set(parser)


def one_limit(text: str) -> str:
    """A setting that `change_limits` takes; argparse reports what it says of another."""
    try:
        change_limits(Limits(), [text])
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    return text


def positive(text: str) -> int:
    """A whole number above 0; ValueError otherwise, which argparse reports."""
    value = int(text)
    if value < 1:
        raise ValueError(text)
    return value


def run(args: argparse.Namespace) -> int:
    """Exit code 0 done, 1 the program is wrong, 2 a wrong --set, 3 out of budget.

    OSError when the file is not there.
    """
    name, text = read_program(args.file)
    language = chosen_language(args.lang)
    try:
        program = compile_source(text, name, DiskFiles(Path(args.file).resolve().parent), language)
    except ProgramError as error:
        _show(args.json, [], 0, error.diagnostics, error.sources)
        return WRONG
    try:
        parameters = parameters_of(program, args.settings, language)
    except SetError as error:
        return refuse(error)
    limits = change_limits(Limits(max_steps=args.max_steps), args.limit)
    options = HostOptions(limits=limits, frames=args.frames, language=language, parameters=parameters)
    session = Session(program, options)
    frames, out_of_budget = 0, False
    while frames < args.frames:
        event = session.next_frame()
        if not isinstance(event, FrameEvent):
            out_of_budget = bool(getattr(event, "out_of_budget", False))
            break
        frames += 1
    diagnostics = session.diagnostics
    _show(args.json, session.output, frames, diagnostics, program.sources)
    if out_of_budget:
        return OUT_OF_BUDGET
    return WRONG if any(d.severity == "error" for d in diagnostics) else DONE


def read_program(file: str) -> tuple[str, str]:
    """The name for messages and the text. OSError when it cannot be read as UTF-8 text."""
    path = Path(file)
    try:
        return program_name(path), path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise OSError(f"{file} is not a text in UTF-8") from error


def program_name(path: Path) -> str:
    """The file's name; of a text of the bundled library its canonical one, `stl/...`.

    Only texts under `stl/` may assign names in `stl::`, whichever way they are reached.
    """
    library, place = bundled_library(), path.resolve()
    if library is not None and place.is_relative_to((library / "stl").resolve()):
        return place.relative_to(library.resolve()).as_posix()
    return path.name


def _show(
    as_json: bool,
    output: list[str],
    frames: int,
    diagnostics: tuple[Diagnostic, ...],
    sources: dict[str, SourceFile],
) -> None:
    if as_json:
        found = [diagnostic_object(d) for d in diagnostics]
        whole = {"output": output, "frames": frames, "diagnostics": found}
        sys.stdout.write(json.dumps(whole, ensure_ascii=False) + "\n")
        return
    sys.stdout.writelines(f"{line}\n" for line in output)
    sys.stdout.flush()
    sys.stderr.writelines(render_diagnostic(d, sources) + "\n" for d in diagnostics)


def diagnostic_object(d: Diagnostic) -> dict[str, object]:
    """A diagnostic as the command line's JSON states it."""
    return {
        "severity": d.severity, "code": d.code, "file": d.span.file, "line": d.span.line,
        "col": d.span.col, "end_line": d.span.end_line, "end_col": d.span.end_col,
        "message": d.message, "hint": d.hint,
    }  # fmt: skip
