"""Running the real Blender of tools/real_blender.sh."""

from __future__ import annotations

import json
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools" / "real_blender.sh"
INSIDE = Path(__file__).resolve().parent / "inside"
VERSIONS = ("sid", "trixie")


@dataclass(frozen=True, slots=True)
class Finished:
    """How a run of Blender ended; `text` is all that it printed."""

    status: int
    text: str


@dataclass(frozen=True, slots=True)
class RealBlender:
    """One installed Blender with preferences and extensions under `user_directory`."""

    version: str
    user_directory: Path

    def run(self, *arguments: str | Path, gui: bool = False, timeout_s: float = 300.0) -> Finished:
        """Runs `blender ARGUMENTS`; fails the test when it takes longer than `timeout_s`."""
        return self.command("blender", *arguments, gui=gui, timeout_s=timeout_s)

    def command(self, *words: str | Path, gui: bool = False, timeout_s: float = 300.0) -> Finished:
        """Runs any command where Blender is installed; otherwise as `run`."""
        window = ["--gui"] if gui else []
        command = [TOOL, "run", "--version", self.version, *window, "--", *words]
        environment = os.environ | {"BLENDER_USER_RESOURCES": str(self.user_directory)}
        done = subprocess.run(
            [str(part) for part in command],
            cwd=ROOT,
            env=environment,
            text=True,
            check=False,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=timeout_s,
        )
        return Finished(done.returncode, done.stdout)

    def script(self, name: str, *arguments: str | Path) -> Finished:
        """Runs a script of `inside/` without a window, with `arguments` after `--`."""
        return self.run("-b", "--python-exit-code", "9", "--python", INSIDE / name, "--", *arguments)


def drive_window(blender: RealBlender, script: str, *arguments: str | Path) -> dict[str, Any]:
    """Runs a script of `inside/` in Blender's window of 1600 x 900; the facts that it wrote into the file
    named last."""
    done = blender.run(
        *("--window-geometry", "0", "0", "1600", "900"),
        *("--python", INSIDE / script, "--", *arguments),
        gui=True,
    )
    assert done.status == 0, done.text
    assert "Traceback" not in done.text, done.text
    facts: dict[str, Any] = json.loads(Path(arguments[-1]).read_text(encoding="utf-8"))
    return facts


def pictures_of(blender: RealBlender) -> Path:
    """The folder for screenshots of this version."""
    pictures = ROOT / "build" / "screenshots" / blender.version
    pictures.mkdir(parents=True, exist_ok=True)
    return pictures


def is_installed(version: str) -> bool:
    """Whether `tools/real_blender.sh install` has finished for this version."""
    done = subprocess.run([str(TOOL), "path", "--version", version], capture_output=True, check=False)
    return done.returncode == 0


def installed_versions() -> list[str]:
    """The versions to test; one placeholder, which skips or fails, when there is none."""
    return [version for version in VERSIONS if is_installed(version)] or ["none"]
