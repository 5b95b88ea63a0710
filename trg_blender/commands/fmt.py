"""`trg fmt`: programs in the standard layout."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from ..lang import ProgramError, SourceFile, render_diagnostic
from ..lang.format import format_source
from .language import add_language, chosen_language
from .run import DONE, WRONG

STANDARD_INPUT = "-"


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add `fmt` to the command line."""
    parser = subparsers.add_parser(
        "fmt",
        help="TRG programs in the standard layout",
        description="Rewrites programs in the standard layout; a program with errors is left as it is.",
    )
    parser.add_argument(
        "files", metavar="FILE.trg", nargs="+", help="- reads the input and writes the output"
    )
    parser.add_argument("--check", action="store_true", help="change nothing; exit code 1 if something would")
    add_language(parser)


def run(args: argparse.Namespace) -> int:
    """Exit code 1 when a program has errors, or with --check is not in the layout. OSError passes."""
    codes = [_format_file(file, args) for file in args.files]
    return max(codes)


def _format_file(file: str, args: argparse.Namespace) -> int:
    name, text = read_exactly(file)
    try:
        made = format_source(text, name, chosen_language(args.lang))
    except ProgramError as error:
        sources = {name: SourceFile.from_text(name, text)}
        sys.stderr.writelines(render_diagnostic(d, sources) + "\n" for d in error.diagnostics)
        return WRONG
    if "\r\n" in text:
        made = made.replace("\n", "\r\n")
    if args.check:
        if made != text:
            sys.stdout.write(f"{file}: would be changed\n")
        return DONE if made == text else WRONG
    if file == STANDARD_INPUT:
        sys.stdout.buffer.write(made.encode("utf-8"))
    elif made != text:
        replace_file(Path(file), made)
    return DONE


def read_exactly(file: str) -> tuple[str, str]:
    """The name for messages and the text with its line ends. OSError when it is no UTF-8 text."""
    if file == STANDARD_INPUT:
        name, content = "<input>", sys.stdin.buffer.read()
    else:
        name, content = Path(file).name, Path(file).read_bytes()
    try:
        return name, content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise OSError(f"{file} is not a text in UTF-8") from error


def replace_file(path: Path, text: str) -> None:
    """Write `text` beside `path`, then put it in its place: a full disk loses nothing."""
    target = path.resolve()
    beside = target.with_name(target.name + ".new")
    try:
        beside.write_bytes(text.encode("utf-8"))
        beside.chmod(target.stat().st_mode & 0o777)
        os.replace(beside, target)
    except OSError:
        beside.unlink(missing_ok=True)
        raise
