"""Runs formatters and type checker, all of them, then says which failed. Sizes: see tests/rooms."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PYTHON_PATHS = ("trg_blender", "tests", "tools", "benchmarks", "__init__.py")


def tracked(*patterns: str) -> list[str]:
    """Tracked files that match the patterns, and new ones that git does not ignore."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", *patterns]
    names = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
    return [name for name in names if (ROOT / name).is_file()]


def check(label: str, *command: str) -> bool:
    """Whether a tool is content; what it says goes to the terminal."""
    sys.stdout.write(f"== {label}\n")
    sys.stdout.flush()
    return subprocess.run(command, cwd=ROOT, check=False).returncode == 0


def main() -> int:
    """Runs every check; the exit status is 1 when one of them failed."""
    module = (sys.executable, "-m")
    cpp = tracked("native/*.cpp", "native/*.h")
    paths = [path for path in PYTHON_PATHS if (ROOT / path).exists()]
    verdicts = {
        "ruff": check("ruff", *module, "ruff", "check", *paths),
        "mypy": check("mypy", *module, "mypy"),
    }
    if cpp:
        tool = str(Path(sys.executable).parent / "clang-format")
        verdicts["clang-format"] = check("clang-format", tool, "--dry-run", "--Werror", *cpp)
    failed = [name for name, content in verdicts.items() if not content]
    sys.stdout.write(f"lint: {', '.join(failed)} failed\n" if failed else "lint: clean\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
