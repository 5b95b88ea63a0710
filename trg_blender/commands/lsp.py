"""`trg lsp`: the language server for editors, over standard input and output."""

from __future__ import annotations

import argparse
import sys

from .language import add_language, chosen_language
from .run import DONE

UNAVAILABLE = 4


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add `lsp` to the command line."""
    parser = subparsers.add_parser(
        "lsp",
        help="language server for editors",
        description="Speaks the Language Server Protocol over standard input and output.",
    )
    parser.add_argument("--stdio", action="store_true", help="accepted, since editors pass it: the only way")
    add_language(parser)


def run(args: argparse.Namespace) -> int:
    """Serves until the client ends it. Exit code 4 when pygls is not installed."""
    try:
        from .lsp_server import make_server
    except ModuleNotFoundError as missing:
        if (missing.name or "").partition(".")[0] not in ("pygls", "lsprotocol"):
            raise
        sys.stderr.write("trg: error: trg lsp needs pygls: pip install 'trg-blender[lsp]'\n")
        return UNAVAILABLE
    make_server(chosen_language(args.lang)).start_io()
    return DONE
