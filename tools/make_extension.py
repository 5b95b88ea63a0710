"""Packs the extension: stage the package, the library and the wheels, then let Blender's own tool zip it.

The tool is the one behind `blender --command extension build`; the bpy wheel carries it as a script,
so packing needs no installed Blender.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PARTS = ("__init__.py", "LICENSE", "trg_blender", "stl", "examples")
PLATFORMS = {"linux": "linux", "manylinux": "linux", "win": "windows", "macosx": "macos"}
MACHINES = {"x86_64": "x64", "amd64": "x64", "aarch64": "arm64", "arm64": "arm64"}


def blender_platform(wheel: Path) -> str:
    """Blender's name of the platform that a wheel is for, such as `linux-x64`."""
    tag = wheel.stem.rpartition("-")[2]
    system = re.split(r"[_\d]", tag, maxsplit=1)[0]
    machine = next(machine for suffix, machine in MACHINES.items() if tag.endswith(suffix))
    return f"{PLATFORMS[system]}-{machine}"


def manifest_with_wheels(text: str, wheels: list[Path]) -> str:
    """`text` with its `wheels` and `platforms` replaced by those of `wheels`."""
    text = re.sub(r"(?ms)^(wheels|platforms)\s*=\s*\[.*?\]\n", "", text)
    table = re.search(r"(?m)^\[", text)
    cut = table.start() if table else len(text)
    paths = "".join(f'  "./wheels/{wheel.name}",\n' for wheel in wheels)
    platforms = ", ".join(f'"{name}"' for name in sorted({blender_platform(wheel) for wheel in wheels}))
    return f"{text[:cut].rstrip()}\nplatforms = [{platforms}]\nwheels = [\n{paths}]\n\n{text[cut:]}"


def stage(target: Path, wheels: list[Path]) -> None:
    """Lays the extension's source directory out in `target`, which is made anew."""
    shutil.rmtree(target, ignore_errors=True)
    (target / "wheels").mkdir(parents=True)
    for name in PARTS:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, target / name, ignore=shutil.ignore_patterns("__pycache__", "*.pyc"))
        else:
            shutil.copy2(source, target / name)
    for wheel in wheels:
        shutil.copy2(wheel, target / "wheels" / wheel.name)
    manifest = (ROOT / "blender_manifest.toml").read_text(encoding="utf-8")
    (target / "blender_manifest.toml").write_text(manifest_with_wheels(manifest, wheels), encoding="utf-8")


def extension_tool() -> Path:
    """Blender's packing script inside the installed bpy wheel."""
    pattern = "bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"
    for entry in sys.path:
        for script in Path(entry or ".").glob(pattern):
            return script
    raise SystemExit("make_extension: no bpy wheel in this Python, so Blender's packing tool is missing")


def main() -> int:
    """Stages and packs; the exit status is that of Blender's tool."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--wheels", type=Path, required=True, help="directory with trg_native's wheels")
    parser.add_argument("--out", type=Path, required=True, help="where the zip goes")
    arguments = parser.parse_args()
    wheels = sorted(arguments.wheels.glob("*.whl"))
    if not wheels:
        raise SystemExit(f"make_extension: no wheel in {arguments.wheels}")
    target = ROOT / "build" / "extension"
    stage(target, wheels)
    arguments.out.mkdir(parents=True, exist_ok=True)
    for old in arguments.out.glob("trg-*.zip"):
        old.unlink()
    tool = [sys.executable, str(extension_tool())]
    for command in (
        ["validate", str(target)],
        ["build", "--source-dir", str(target), "--output-dir", str(arguments.out)],
    ):
        status = subprocess.run([*tool, *command], check=False).returncode
        if status:
            return status
    return 0


if __name__ == "__main__":
    sys.exit(main())
