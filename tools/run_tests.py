"""Runs every room of tests on every Python leg and closes with the counts.

A room is a directory of tests/ and gets a pytest process of its own, so that a crash inside Blender
names its room and the others still run. A room that ran no test has failed, whatever pytest's exit
status. With CI=true a missing leg and a missing real Blender fail as well; elsewhere they are said.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# Rooms that need one leg only: the newest, whose Blender is the one that the real program is held against.
ONE_LEG_ROOMS = ("rooms", "real_blender")
# Rooms whose tests share nothing and may run side by side.
PARALLEL_ROOMS = ("lang", "engine", "native")
# Rooms that may be skipped as a whole outside CI, because they need more than the project installs.
OPTIONAL_ROOMS = ("real_blender",)


@dataclass(frozen=True, slots=True)
class Counts:
    """What one pytest process did."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Counts) -> Counts:
        return Counts(self.passed + other.passed, self.failed + other.failed, self.skipped + other.skipped)


@dataclass(frozen=True, slots=True)
class Outcome:
    """One room on one leg: its counts, its time and, when it failed, why."""

    leg: str
    room: str
    counts: Counts
    seconds: float
    reason: str = ""


def find_rooms() -> list[str]:
    """Names of the directories of tests/ that hold test files, quick rooms first."""
    names = {path.relative_to(ROOT / "tests").parts[0] for path in (ROOT / "tests").rglob("test_*.py")}
    order = ("rooms", "lang", "native", "engine", "blender", "real_blender")
    return sorted(names, key=lambda name: (order.index(name) if name in order else len(order) - 1.5, name))


def read_counts(report: Path) -> Counts:
    """The counts of a JUnit report; zero when the process died before it wrote one."""
    if not report.exists():
        return Counts()
    suites = ET.parse(report).getroot().iter("testsuite")
    total = Counts()
    for suite in suites:
        number = {key: int(suite.get(key, 0)) for key in ("tests", "failures", "errors", "skipped")}
        failed = number["failures"] + number["errors"]
        total += Counts(number["tests"] - failed - number["skipped"], failed, number["skipped"])
    return total


def judge(room: str, status: int, counts: Counts, in_ci: bool) -> str:
    """Why the room failed, or an empty string."""
    if status < 0:
        return f"killed by signal {-status}"
    if counts.passed + counts.failed == 0:
        excused = room in OPTIONAL_ROOMS and not in_ci and counts.skipped > 0
        return "" if excused else f"no test ran ({counts.skipped} skipped)"
    return f"pytest ended with {status}" if status else ""


def run_room(leg: str, room: str, in_ci: bool) -> Outcome:
    """Runs one room with one leg's Python."""
    report = ROOT / "build" / "test-reports" / f"{leg}-{room}.xml"
    report.parent.mkdir(parents=True, exist_ok=True)
    report.unlink(missing_ok=True)
    python = ROOT / ".venv" / leg / "bin" / "python"
    command = [str(python), "-m", "pytest", "-q", "-ra", f"--junitxml={report}", f"tests/{room}"]
    if room in PARALLEL_ROOMS:
        command[4:4] = ["-n", str(min(os.cpu_count() or 1, 8))]
    write(f"\n== {room} on Python {leg}")
    start = time.monotonic()
    status = subprocess.run(command, cwd=ROOT, stdin=subprocess.DEVNULL, check=False).returncode
    counts = read_counts(report)
    return Outcome(leg, room, counts, time.monotonic() - start, judge(room, status, counts, in_ci))


def write(line: str) -> None:
    """One line for the reader, in order with what pytest prints."""
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


def summarise(outcomes: list[Outcome], complaints: list[str]) -> int:
    """Prints the table, the complaints and the closing counts; returns the exit status."""
    total = Counts()
    write("")
    for outcome in outcomes:
        counts = outcome.counts
        total += counts
        verdict = outcome.reason or "ok"
        write(
            f"{outcome.leg:>5}  {outcome.room:<14}{counts.passed:>6} passed {counts.failed:>4} failed"
            f" {counts.skipped:>4} skipped {outcome.seconds:>7.1f} s  {verdict}"
        )
    for complaint in complaints:
        write(complaint)
    bad = [f"{outcome.room} on {outcome.leg}: {outcome.reason}" for outcome in outcomes if outcome.reason]
    for line in bad:
        write(f"FAILED {line}")
    write(f"{total.passed} passed, {total.failed} failed, {total.skipped} skipped")
    return 1 if bad or total.failed else 0


def main() -> int:
    """Runs the rooms asked for; see the module's docstring for what counts as failure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--leg", action="append", default=[], help="a Python version with a ready .venv")
    parser.add_argument("--missing", action="append", default=[], help="a supported version not found here")
    parser.add_argument("--room", action="append", help="only these rooms")
    arguments = parser.parse_args()
    in_ci = os.environ.get("CI") == "true"
    outcomes: list[Outcome] = []
    for room in arguments.room or find_rooms():
        legs = arguments.leg[-1:] if room in ONE_LEG_ROOMS else arguments.leg
        outcomes += [run_room(leg, room, in_ci) for leg in legs]
    complaints = [
        f"Python {version} was found neither on PATH nor in pyenv nor in uv: its tests did not run"
        for version in arguments.missing
    ]
    status = summarise(outcomes, complaints)
    return 1 if complaints and in_ci else status


if __name__ == "__main__":
    sys.exit(main())
