"""The language of messages on the command line: `--lang`, else the environment's."""

from __future__ import annotations

import argparse
import os
from collections.abc import Mapping

from ..lang.messages import LANGUAGES

_VARIABLES = ("LC_ALL", "LC_MESSAGES", "LANG")


def add_language(parser: argparse.ArgumentParser) -> None:
    """Add `--lang` to a subcommand."""
    parser.add_argument(
        "--lang", choices=LANGUAGES, help="language of messages (that of the environment, else en)"
    )


def chosen_language(wanted: str | None, environment: Mapping[str, str] = os.environ) -> str:
    """`wanted` if given, else the language of the locale when there are texts in it, else English."""
    if wanted is not None:
        return wanted
    locale = next((environment[name] for name in _VARIABLES if environment.get(name)), "")
    language = locale[:2].lower()
    return language if language in LANGUAGES else LANGUAGES[0]
