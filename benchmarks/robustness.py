"""Robustness of every accelerator: the catalogue's rows with full counts, failures of each.

Usage: python -m benchmarks.robustness [--rays N] [--accels a,b] [--rows TEXT]. Status 1 when a ray failed;
the rows S03 to S12 render pictures and count pixels.
"""

from __future__ import annotations

import argparse
import sys
import time
from itertools import chain

from tests.native.meshes import INDICES

from . import leaving_rows, robustness_rows


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rays", type=int, default=10_000_000, help="rays a row; lone triangles: 20000")
    parser.add_argument("--accels", default=",".join(INDICES))
    parser.add_argument("--rows", default="", help="only rows whose name holds this text")
    arguments = parser.parse_args()
    failed = 0
    for name, row in chain(robustness_rows.rows(), leaving_rows.rows()):
        if arguments.rows not in name:
            continue
        for accel in arguments.accels.split(","):
            start = time.perf_counter()
            outcome = row(accel, arguments.rays)
            failed += outcome.failed
            sys.stdout.write(
                f"{name} [{accel}]: {outcome.failed} of {outcome.total} failed, "
                f"{time.perf_counter() - start:.1f} s\n"
            )
            sys.stdout.flush()
    sys.stdout.write(f"{failed} failures in all\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
