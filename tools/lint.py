"""Runs the formatters, the type checker and the size limits, all of them, then says which failed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PYTHON_PATHS = ("trg_blender", "tests", "tools", "benchmarks", "__init__.py")
MAX_FILE_LINES = 500
MAX_FUNCTION_LINES = 60
MAX_PARAMETERS = 5


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


def check_file_lengths(names: list[str]) -> bool:
    """Whether every source file keeps to the limit."""
    sys.stdout.write("== file lengths\n")
    lengths = {name: len((ROOT / name).read_text(encoding="utf-8").splitlines()) for name in names}
    too_long = {name: count for name, count in lengths.items() if count > MAX_FILE_LINES}
    for name, count in too_long.items():
        sys.stdout.write(f"{name}: {count} lines, the limit is {MAX_FILE_LINES}\n")
    return not too_long


def main() -> int:
    """Runs every check; the exit status is 1 when one of them failed."""
    module = (sys.executable, "-m")
    cpp = tracked("native/*.cpp", "native/*.h")
    python = tracked("*.py")
    paths = [path for path in PYTHON_PATHS if (ROOT / path).exists()]
    verdicts = {
        "ruff": check("ruff", *module, "ruff", "check", *paths),
        "mypy": check("mypy", *module, "mypy"),
        "sizes": check(
            "lizard",
            *module,
            "lizard",
            "-w",
            "-l",
            "python",
            "-l",
            "cpp",
            "-C",
            "1000",
            "-T",
            f"length={MAX_FUNCTION_LINES}",
            "-T",
            f"parameter_count={MAX_PARAMETERS}",
            "trg_blender",
            "native",
            "tools",
        ),
        "lengths": check_file_lengths(cpp + python),
    }
    if cpp:
        tool = str(Path(sys.executable).parent / "clang-format")
        verdicts["clang-format"] = check("clang-format", tool, "--dry-run", "--Werror", *cpp)
    failed = [name for name, content in verdicts.items() if not content]
    sys.stdout.write(f"lint: {', '.join(failed)} failed\n" if failed else "lint: clean\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
