"""Runs hostile programs in a child process with hard limits of its own and says what they cost.

    python hostile_runner.py NAME [--steps N]

prints one JSON object: the codes of the diagnostics, CPU seconds of compiling and of running, and the
peak of the resident size above what the interpreter holds without a program, in megabytes.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
FAR_SECONDS = 120
"""Wall seconds after which a child is given up: far beyond what even a loaded machine needs."""
_ADDRESS_SPACE = 3 * 1024**3
_MAX_FRAMES = 3


def run_child(name: str, *options: str) -> dict[str, object]:
    """What program `name` costs; an `error` entry when the child did not end properly."""
    command = [sys.executable, str(Path(__file__).resolve()), name, *options]
    try:
        done = subprocess.run(command, capture_output=True, timeout=FAR_SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return {"name": name, "error": f"still running after {FAR_SECONDS} s"}
    if done.returncode != 0:
        return {"name": name, "error": done.stderr.decode("utf-8", "replace")[-500:]}
    return dict(json.loads(done.stdout))


def _peak_megabytes() -> float:
    import resource  # noqa: PLC0415 - not on Windows

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _fence_in() -> None:
    import resource  # noqa: PLC0415 - not on Windows

    resource.setrlimit(resource.RLIMIT_AS, (_ADDRESS_SPACE, _ADDRESS_SPACE))
    resource.setrlimit(resource.RLIMIT_CPU, (FAR_SECONDS, FAR_SECONDS))


def measure(name: str, steps: int | None) -> dict[str, object]:
    """Compile and run one program in this process."""
    sys.path[:0] = [str(ROOT), str(HERE)]
    from hostile_programs import ENDLESS, TEXTS  # noqa: PLC0415

    from trg_blender import lang  # noqa: PLC0415

    text = ENDLESS.get(name) or TEXTS[name]
    before, start = _peak_megabytes(), time.process_time()
    compiled = start
    try:
        program = lang.compile_source(text, "main.trg")
        compiled = time.process_time()
        limits = lang.Limits() if steps is None else lang.Limits(max_steps=steps)
        session = lang.Session(program, lang.HostOptions(limits=limits))
        frames = 0
        while frames < _MAX_FRAMES and isinstance(session.next_frame(), lang.FrameEvent):
            frames += 1
        codes = [d.code for d in session.diagnostics if d.severity == "error"]
    except lang.ProgramError as error:
        compiled = time.process_time()
        codes = [d.code for d in error.diagnostics]
    end = time.process_time()
    return {
        "name": name, "codes": codes, "compile_s": compiled - start, "run_s": end - compiled,
        "total_s": end - start, "megabytes": _peak_megabytes() - before,
    }  # fmt: skip


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("name")
    parser.add_argument("--steps", type=int)
    arguments = parser.parse_args()
    _fence_in()
    sys.stdout.write(json.dumps(measure(arguments.name, arguments.steps)) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
