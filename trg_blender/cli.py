"""The command line `trg`: finds the subcommand and turns what went wrong into an exit code.

A subcommand is a module of `commands` with `add_parser(subparsers)` and `run(args) -> int`. Only the one
that was asked for is imported, so that `trg run` needs neither numpy nor bpy.
"""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from types import ModuleType
from typing import NoReturn

from . import __version__

DONE, WRONG, USAGE, CANCELLED, UNAVAILABLE = range(5)
"""Exit codes: done; the program or scene is wrong; usage; cancelled or out of budget; something missing."""

COMMANDS = {
    "render": "render a TRG program or a .blend file to a picture",
    "report": "error against run time: curves and a page",
    "stability": "stiff and extreme cases, each with its figure and verdict",
    "run": "run a TRG program alone: its output and diagnostics",
    "check": "diagnostics of a TRG program, one a line",
    "repl": "TRG line by line",
    "fmt": "TRG programs in the standard layout",
    "doc": "reference of the language and its library, generated",
    "lsp": "language server for editors",
    "info": "version, devices and why one is absent",
}


def main(arguments: list[str] | None = None) -> int:
    """Runs `trg` with `arguments` (sys.argv's when None) and returns its exit code."""
    words = sys.argv[1:] if arguments is None else arguments
    try:
        return dispatch(words)
    except KeyboardInterrupt:
        return fail("cancelled", CANCELLED)
    except BrokenPipeError:
        # Whoever read our output has seen enough; the interpreter must not complain at exit either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else USAGE


def dispatch(words: list[str]) -> int:
    name = words[0] if words else None
    if name not in COMMANDS:
        parse_without_command(words)
    module = importlib.import_module(f".commands.{name}", __package__)
    parser = build_parser()
    module.add_parser(parser.add_subparsers(dest="command", metavar="COMMAND"))
    return run_command(module, parser.parse_args(words))


def build_parser() -> argparse.ArgumentParser:
    lines = [f"  {name:<9} {text}" for name, text in COMMANDS.items()]
    parser = argparse.ArgumentParser(
        prog="trg",
        description="Scenes written as small programs, rendered with their error stated.",
        epilog="\n".join(["commands:", *lines, "", "trg COMMAND --help says more about one."]),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"trg {__version__}")
    return parser


def parse_without_command(words: list[str]) -> NoReturn:
    """Answers --help and --version, and says what is wrong with everything else (exit code 2)."""
    parser = build_parser()
    parser.usage = "trg [--help] [--version] COMMAND ..."
    _, rest = parser.parse_known_args(words)
    if not rest:
        parser.error(f"a command is missing: {', '.join(COMMANDS)}")
    parser.error(f"there is no command {rest[0]!r}: {', '.join(COMMANDS)}")


def run_command(module: ModuleType, args: argparse.Namespace) -> int:
    """Runs one subcommand; errors that are no bug of ours become a line and an exit code."""
    try:
        return int(module.run(args))
    except OSError as failure:
        if isinstance(failure, BrokenPipeError):
            raise
        named = failure.filename is not None and failure.strerror
        return fail(f"{failure.filename}: {failure.strerror}" if named else str(failure), WRONG)
    except Exception as failure:
        code = exit_code(failure)
        if code is None:
            raise
        return fail(str(failure), code)


def exit_code(failure: Exception) -> int | None:
    """The exit code of an error of the engine; None for a bug of ours.

    The engine is asked only if a command has loaded it: one that was not cannot have failed.
    """
    codes = {("errors", "SceneError"): WRONG, ("devices", "Unavailable"): UNAVAILABLE}
    for (module_name, class_name), code in codes.items():
        module = sys.modules.get(f"{__package__}.engine.{module_name}")
        if module is not None and isinstance(failure, getattr(module, class_name)):
            return code
    return None


def fail(message: str, code: int) -> int:
    sys.stderr.write(f"trg: error: {message}\n")
    return code
