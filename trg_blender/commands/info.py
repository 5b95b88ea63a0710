"""`trg info`: version, devices and why one is absent, instruction sets, kernel sets."""

from __future__ import annotations

import argparse
import json
import platform
import sys
from typing import Any

from .. import __version__
from ..engine.devices import list_devices, native_missing
from ..engine.native import load_native


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = subparsers.add_parser(
        "info",
        help="version, devices and why one is absent",
        description="Prints the version and what this machine can render with.",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object instead of lines")


def run(args: argparse.Namespace) -> int:
    facts = collect_facts()
    text = json.dumps(facts, indent=2) if args.json else format_facts(facts)
    sys.stdout.write(text + "\n")
    return 0


def collect_facts() -> dict[str, Any]:
    """JSON-ready; `native` is None without the native core."""
    devices = [
        {
            "name": device.name,
            "description": device.description,
            "available": device.available,
            "reason": device.reason,
        }
        for device in list_devices()
    ]
    native = None
    if native_missing() is None:
        module = load_native()
        native = {"version": module.__version__, **module.info()}
    return {
        "version": __version__,
        "python": platform.python_version(),
        "platform": platform.platform(),
        "devices": devices,
        "native": native,
    }


def format_facts(facts: dict[str, Any]) -> str:
    lines = [f"trg {facts['version']}, Python {facts['python']}, {facts['platform']}", "devices:"]
    for device in facts["devices"]:
        state = "available" if device["available"] else f"absent: {device['reason']}"
        lines.append(f"  {device['name']:<7} {device['description']} - {state}")
    if facts["native"] is not None:
        lines.append("native core:")
        lines += [f"  {key}: {format_value(value)}" for key, value in facts["native"].items()]
    return "\n".join(lines)


def format_value(value: object) -> str:
    return ", ".join(str(item) for item in value) if isinstance(value, list | tuple) else str(value)
