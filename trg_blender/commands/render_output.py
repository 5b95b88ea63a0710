"""What `trg render` writes and says besides pictures: file names, progress, the closing paragraph."""

from __future__ import annotations

import argparse
import json
import re
import shlex
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

from ..engine.report import Progress, format_progress

PLAIN_LINE_STEP = 0.1
"""Without a terminal a line is written each time this share of the samples is done."""


def frame_path(output: Path, frame: int, several: bool) -> Path:
    """`fence.png` -> `fence_0007.png`; a run of # in the name is where the number goes instead."""
    if "#" in output.name:
        name = re.sub(r"#+", lambda run: f"{frame:0{len(run.group())}d}", output.name, count=1)
        return output.with_name(name)
    return output.with_name(f"{output.stem}_{frame:04d}{output.suffix}") if several else output


@dataclass(slots=True)
class ProgressPrinter:
    """Shows the progress of one frame: a bar on a terminal, plain lines elsewhere, nothing when quiet."""

    stream: TextIO
    title: str
    quiet: bool = False
    _bar: Any = None
    _next_line: float = PLAIN_LINE_STEP

    def __call__(self, progress: Progress) -> None:
        """One more look at the running render."""
        if self.quiet:
            return
        if self.stream.isatty():
            self._draw(progress)
        elif progress.share >= self._next_line:
            self.stream.write(f"{self.title}: {format_progress(progress)}\n")
            self.stream.flush()
            self._next_line = progress.share + PLAIN_LINE_STEP

    def close(self) -> None:
        """Leaves the line of the bar."""
        if self._bar is not None:
            self._bar.close()
            self._bar = None

    def _draw(self, progress: Progress) -> None:
        if self._bar is None:
            from tqdm import tqdm

            self._bar = tqdm(
                total=100,
                file=self.stream,
                desc=self.title,
                bar_format="{desc} {percentage:3.0f}%|{bar}| {postfix}",
                leave=False,
            )
        self._bar.n = int(100 * progress.share)
        self._bar.set_postfix_str(format_progress(progress))


def describe_report(picture: Path, report: dict[str, Any]) -> str:
    """The closing paragraph: size, samples, seconds by part, RMSE with its 95 % interval."""
    width, height = report["size"]
    parts = ", ".join(
        f"{name} {seconds:.2f}"
        for name, seconds in report["seconds"].items()
        if seconds is not None and name != "total"
    )
    lines = [
        f"{picture}: {width} x {height}, {report['samples']:g} samples a pixel, "
        f"{report['device']} ({report['accel']}), {report['seconds']['total']:.2f} s ({parts})"
    ]
    error = report["error"]
    if error["rmse"] is not None and error["ci95"] is not None:
        low, high = error["ci95"]
        lines.append(f"rmse {error['rmse']:.4g} (95 % interval {low:.4g} to {high:.4g})")
    if error["note"]:
        lines.append(error["note"])
    lines += [f"warning: {warning}" for warning in report["warnings"]]
    return "\n".join(lines)


def repeat_rejected(args: argparse.Namespace, report: dict[str, Any]) -> str:
    """A line with the command that renders the first sample again that was not finite; empty without one."""
    places = report["numerics"]["rejected_places"]
    if not places:
        return ""
    first = places[0]
    words = ["trg", "render", str(args.file), "--frame", report["frame"], "-o", "out/pixel.exr"]
    words += ["--size", "{}x{}".format(*report["size"]), "--pixel", f"{first['x']},{first['y']}"]
    words += ["--samples", first["sample"] + 1, "--seed", report["seed"], "--device", report["device"]]
    words += ["--integrator", report["integrator"]]
    if report["device"] == "cpu":
        words += ["--accel", report["accel"]]
    words += [word for setting in args.settings for word in ("--set", setting)]
    return "\nrepeat: " + shlex.join(str(word) for word in words)


def write_report(path: Path, reports: list[dict[str, Any]]) -> None:
    """One frame is an object, several are a list of objects."""
    path.parent.mkdir(parents=True, exist_ok=True)
    content = reports[0] if len(reports) == 1 else reports
    path.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")


@contextmanager
def blender_chatter_off() -> Iterator[TextIO]:
    """Blender writes its own lines to the process's standard output; inside they go nowhere.

    Gives the real standard output; `print` of Python code inside reaches it too.
    """
    import contextlib
    import os

    sys.stdout.flush()
    kept = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    with os.fdopen(kept, "w", encoding="utf-8", closefd=False) as real, contextlib.redirect_stdout(real):
        os.dup2(nowhere, 1)
        try:
            yield real
        finally:
            real.flush()
            os.dup2(kept, 1)
            os.close(nowhere)
    os.close(kept)
