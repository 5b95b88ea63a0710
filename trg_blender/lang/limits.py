"""The limits of a running program; every error that comes from one names it and its value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace

MAX_SOURCE = 262_144
MAX_INCLUDES = 32
MAX_INCLUDE_DEPTH = 8
MAX_CALL_DEPTH = 200
MAX_OPERATOR_DEPTH = 50


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits that the host may change. Steps and seconds count from one Render() to the next."""

    max_steps: int = 20_000_000
    """Turns of loops, calls, and blocks of straight statements."""
    max_seconds: float = 5.0
    """CPU seconds of the thread that runs the program."""
    max_string: int = 65_536
    """Characters of one string."""
    max_text_bytes: int = 32 * 1024 * 1024
    """Bytes of all live strings longer than 64 characters; shorter ones count as blocks."""
    max_blocks: int = 1_500_000
    """Python memory blocks: values, objects, fields."""
    max_bytes: int = 384 * 1024 * 1024
    """Growth of the process while the program runs, shapes and lights not counted."""
    max_shapes: int = 1_000_000
    """Shapes and lights made in one run."""
    max_elements: int = 1_000_000
    """Elements of all living lists together."""
    output_lines_frame: int = 200
    output_lines: int = 10_000
    output_columns: int = 4_096


@dataclass(frozen=True, slots=True)
class HostOptions:
    """What the host tells a session."""

    limits: Limits = field(default_factory=Limits)
    frames: int = 1
    """std::frames(): how many frames the host means to take."""
    fps: float = 24.0
    language: str = "en"
    """Language of messages: `en` or `ru`."""
    parameters: Mapping[str, object] = field(default_factory=dict)
    """Values of exported parameters by name: numbers, texts, triples of numbers."""
    strict_files: bool = False
    """A missing texture or model is an error instead of a warning."""


def change_limits(limits: Limits, settings: list[str]) -> Limits:
    """`limits` with `name=value` settings, names as in Limits. ValueError says what is wrong with one."""
    known = {f.name: type(getattr(limits, f.name)) for f in fields(Limits)}
    for setting in settings:
        name, separator, text = setting.partition("=")
        if name not in known or not separator:
            raise ValueError(f"{setting!r} is no limit; write NAME=VALUE, NAME one of {', '.join(known)}")
        try:
            value = known[name](text)
        except ValueError:
            raise ValueError(f"{setting!r}: {text!r} is not a number") from None
        if not 0 < value < float("inf"):
            raise ValueError(f"{setting!r}: a limit is greater than 0")
        limits = replace(limits, **{name: value})
    return limits
