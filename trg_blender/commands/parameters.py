"""`--set NAME=VALUE`: values for a program's exported parameters on the command line."""

from __future__ import annotations

import argparse
import sys

from ..lang import ParameterError, Program, parse_parameter
from ..lang.exports import ParameterValue

USAGE = 2


class SetError(Exception):
    """A `--set` that the program has no use for; the text is a line for the user."""


def add_set(parser: argparse.ArgumentParser) -> None:
    """Add `--set` to a subcommand."""
    parser.add_argument(
        "--set", dest="settings", action="append", default=[], metavar="NAME=VALUE", type=_setting,
        help="value of an exported parameter, such as radius=4 or tint=1,0,0; may be repeated",
    )  # fmt: skip


def _setting(text: str) -> str:
    if not text.partition("=")[1]:
        raise argparse.ArgumentTypeError(f"{text!r} is not NAME=VALUE")
    return text


def parameters_of(program: Program, settings: list[str], language: str = "en") -> dict[str, ParameterValue]:
    """The values of `settings` by name; the last of a name counts. Raises SetError."""
    found: dict[str, ParameterValue] = {}
    for setting in settings:
        try:
            name, value = parse_parameter(program, setting, language)
        except (ParameterError, ValueError) as error:
            raise SetError(f"--set {setting}: {error}") from error
        found[name] = value
    return found


def refuse(error: SetError) -> int:
    """Say what is wrong with a `--set`; the exit code of wrong usage."""
    sys.stderr.write(f"trg: error: {error}\n")
    return USAGE
