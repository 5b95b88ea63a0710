"""`trg doc`: the reference of the language and its library, generated."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ..lang.reference import reference_html, reference_markdown
from .run import DONE


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add `doc` to the command line."""
    parser = subparsers.add_parser(
        "doc",
        help="reference of the language and its library",
        description="Generates the reference from the tables that the language itself uses.",
    )
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--markdown", action="store_true", help="as Markdown (the default)")
    form.add_argument("--html", action="store_true", help="as one HTML page")
    parser.add_argument("--out", metavar="DIR", help="write reference.md or reference.html there")


def run(args: argparse.Namespace) -> int:
    """Writes the reference to the output, or with --out to a file. OSError when that fails."""
    text = reference_html() if args.html else reference_markdown()
    if args.out is None:
        sys.stdout.write(text)
        return DONE
    folder = Path(args.out)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / ("reference.html" if args.html else "reference.md")
    path.write_bytes(text.encode("utf-8"))
    sys.stdout.write(f"{path}\n")
    return DONE
