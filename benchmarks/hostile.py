"""What hostile programs cost: worst time and worst memory over the suite of tests/lang/hostile.

    python benchmarks/hostile.py [--only WORD] [--json FILE]

Every program runs in a child process of its own with the default limits of the language. Seconds are CPU
seconds of compiling and running together; megabytes are the growth of the peak resident size.
Ends with status 1 when a program fails inside, needs more than 10 s, or more than 500 MB.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "lang" / "hostile"))
from hostile_programs import ENDLESS, TEXTS  # noqa: E402
from hostile_runner import run_child  # noqa: E402

MAX_SECONDS = 10.0
MAX_MEGABYTES = 500.0


def is_within(row: dict[str, object]) -> bool:
    """Whether the program ended as it should."""
    if "error" in row or "E900" in row["codes"]:  # type: ignore[operator]
        return False
    return row["total_s"] <= MAX_SECONDS and row["megabytes"] <= MAX_MEGABYTES  # type: ignore[operator]


def main() -> int:
    """Measures, prints a line for each program and the worst of each, and writes JSON when asked."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--only", default="", help="programs whose names hold this word")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    rows = [run_child(name) for name in (*ENDLESS, *TEXTS) if arguments.only in name]
    good = [row for row in rows if "error" not in row]
    for row in sorted(good, key=lambda r: -float(r["total_s"])):  # type: ignore[arg-type]
        codes = ",".join(dict.fromkeys(row["codes"]))  # type: ignore[call-overload]
        print(f"{row['total_s']:7.2f} s {row['megabytes']:7.1f} MB  {codes[:24]:<24} {row['name']}")
    for row in rows:
        if "error" in row:
            print(f"FAILED {row['name']}: {row['error']}")
    if good:
        slowest = max(good, key=lambda r: float(r["total_s"]))  # type: ignore[arg-type]
        largest = max(good, key=lambda r: float(r["megabytes"]))  # type: ignore[arg-type]
        print(f"{len(rows)} programs; worst time {slowest['total_s']:.2f} s ({slowest['name']}),")
        print(f"worst memory {largest['megabytes']:.0f} MB ({largest['name']})")
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1), encoding="utf-8")
    return 0 if all(is_within(row) for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
