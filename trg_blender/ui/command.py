"""`blender --command trg ...`: the command line inside Blender."""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from typing import Any

import bpy


@dataclass(slots=True)
class _Registered:
    handle: Any = None


_command = _Registered()


def run_command(words: list[str]) -> int:
    """Runs `trg` with the words after `--command trg`; gives the exit code."""
    # Loaded by name when asked for: the command line stands above this room.
    cli = importlib.import_module(f"{__package__.rpartition('.')[0]}.cli")
    return int(cli.main(list(words)))


def register() -> None:
    _command.handle = bpy.utils.register_cli_command("trg", run_command)


def unregister() -> None:
    if _command.handle is not None:
        bpy.utils.unregister_cli_command(_command.handle)
        _command.handle = None
