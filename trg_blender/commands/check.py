"""`trg check`: the diagnostics of a program that is not run."""

from __future__ import annotations

import argparse
import dataclasses
import json
import sys
from pathlib import Path

from ..lang import (
    Diagnostic,
    DiskFiles,
    ProgramError,
    compile_source,
    render_diagnostic,
)
from .language import add_language, chosen_language
from .parameters import SetError, add_set, parameters_of, refuse
from .run import DONE, WRONG, diagnostic_object, read_program


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add `check` to the command line."""
    parser = subparsers.add_parser(
        "check", help="diagnostics of a TRG program", description="Finds errors without running."
    )
    parser.add_argument("file", metavar="FILE.trg")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    add_language(parser)
    add_set(parser)


def run(args: argparse.Namespace) -> int:
    """Exit code 1 when there is an error, 2 for a wrong --set, else 0. OSError: the file cannot be read."""
    name, text = read_program(args.file)
    files = DiskFiles(Path(args.file).resolve().parent)
    try:
        language = chosen_language(args.lang)
        program = compile_source(text, name, files, language)
        parameters_of(program, args.settings, language)
        diagnostics, sources = program.diagnostics, program.sources
    except SetError as error:
        return refuse(error)
    except ProgramError as error:
        diagnostics, sources = error.diagnostics, error.sources
    shown = [_shown(d) for d in diagnostics]
    if args.json:
        found = {"diagnostics": [diagnostic_object(d) for d in shown]}
        sys.stdout.write(json.dumps(found, ensure_ascii=False) + "\n")
    else:
        sys.stdout.writelines(render_diagnostic(d, sources) + "\n" for d in shown)
    return WRONG if any(d.severity == "error" for d in diagnostics) else DONE


def _shown(d: Diagnostic) -> Diagnostic:
    """The command line knows errors and warnings only: a lint is shown as a warning."""
    return dataclasses.replace(d, severity="warning") if d.severity == "lint" else d
