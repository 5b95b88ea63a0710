"""`trg stability`: the catalogue of stiff and extreme cases, one line a case with figure and verdict."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from .. import __version__, cli
from ..engine.devices import require_device
from ..stability.catalogue import CATALOGUE
from ..stability.digits import Digits, measure_digits
from ..stability.meshes import ACCELS
from ..stability.runner import (
    FAIL,
    NOT_APPLICABLE,
    PASS,
    Finding,
    Plan,
    absent_subjects,
    unknown_rows,
)
from ..stability.runner import (
    run as run_rows,
)
from .render import at_least

SUBJECTS = (*ACCELS, "embree")


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = subparsers.add_parser(
        "stability",
        help=cli.COMMANDS["stability"],
        description="Runs the catalogue of stiff and extreme cases (docs/stability.md) and prints what each "
        "case measured, what it may measure, and whether it passes. Exit status 1 when a case of TRG's own "
        "engine fails.",
    )
    add = parser.add_argument
    add("--rows", "--case", type=words, default=(), metavar="G01,A,S", help="ids, or beginnings of ids; all")
    add("--accel", type=words, default=SUBJECTS, metavar="A,B", help="subjects: " + ", ".join(SUBJECTS))
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="few rays and samples: a minute in all")
    size.add_argument("--rays", type=at_least(1), metavar="N", help="at most so many a case")
    add("--seed", type=at_least(0), default=0, metavar="N", help="other rays and samples")
    add("--json", type=Path, metavar="FILE", help="write the findings as JSON")


def words(text: str) -> tuple[str, ...]:
    return tuple(word for word in text.split(",") if word)


def run(args: argparse.Namespace) -> int:
    """Prints findings as they come. Raises Unavailable without the native core."""
    for name, unknown in (
        ("rows", unknown_rows(args.rows)),
        ("accel", [accel for accel in args.accel if accel not in SUBJECTS]),
    ):
        if unknown:
            return cli.fail(f"--{name}: there is no {', '.join(unknown)}", cli.USAGE)
    require_device("cpu")
    begin = time.perf_counter()
    for line in absent_subjects():
        say(line)
    accels = tuple(sorted((a for a in args.accel if a in ACCELS), key=lambda a: a == "none"))
    plan = Plan(args.rows, accels, "embree" in args.accel, args.quick, args.rays, args.seed)
    findings = []
    for finding in run_rows(plan):
        findings.append(finding)
        say(format_finding(finding))
    digits = [] if args.rows else measure_digits(20_000 if args.quick else 1_000_000, args.seed)
    for line in format_digits(digits):
        say(line)
    say(summarise(findings) + f"; {time.perf_counter() - begin:.0f} s")
    if args.json is not None:
        write_json(args.json, args, findings, digits)
    return cli.WRONG if any(one.is_ours and one.verdict == FAIL for one in findings) else cli.DONE


def say(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


def format_finding(one: Finding) -> str:
    verdict = f"{one.verdict}: {one.reason}" if one.reason else one.verdict
    return f"{one.id} {one.name:<44} {one.subject:<9} {one.figure:<30} [{one.criterion}] {verdict}"


def format_digits(digits: Sequence[Digits]) -> list[str]:
    """The table of what single precision costs, a stage a line."""
    if not digits:
        return []
    lines = ["", "float32 against float64, relative error", f"{'stage':<64} {'p99.9':>9} {'max':>9}"]
    lines += [f"{one.stage + ': ' + one.quantity:<64} {one.most:9.1e} {one.worst:9.1e}" for one in digits]
    return [*lines, ""]


def verdicts(findings: Sequence[Finding]) -> dict[str, str]:
    """Of each row of the catalogue that was run: FAIL when a case of our own fails."""
    found: dict[str, list[str]] = defaultdict(list)
    for one in findings:
        if one.is_ours:
            found[one.id].append(one.verdict)
    return {
        row: next((v for v in (FAIL, PASS) if v in given), NOT_APPLICABLE) for row, given in found.items()
    }


def summarise(findings: Sequence[Finding]) -> str:
    rows = verdicts(findings)
    failed = [row for row, verdict in rows.items() if verdict == FAIL]
    absent = [row for row, verdict in rows.items() if verdict == NOT_APPLICABLE]
    parts = [f"{len(findings)} cases of {len(rows)} of {len(CATALOGUE)} rows"]
    parts.append(f"{len(rows) - len(failed) - len(absent)} rows pass")
    parts.append(f"{len(failed)} FAIL{': ' if failed else ''}{' '.join(failed)}")
    parts.append(f"{len(absent)} not applicable{': ' if absent else ''}{' '.join(absent)}")
    return ", ".join(parts)


def write_json(
    path: Path, args: argparse.Namespace, findings: Sequence[Finding], digits: Sequence[Digits]
) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    content = {
        "version": __version__,
        "quick": args.quick,
        "rays": args.rays,
        "seed": args.seed,
        "rows": verdicts(findings),
        "cases": [asdict(one) for one in findings],
        "digits": [asdict(one) for one in digits],
    }
    path.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
