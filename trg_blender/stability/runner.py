"""Runs cases of the catalogue, one finding after the other."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ..engine.devices import embree_missing, find_device
from .case import ANY, CORE, EMBREE, PICTURE_RAYS, PICTURES, Case, NotApplicable, Outcome
from .catalogue import CATALOGUE, Entry, cases
from .meshes import INDICES
from .stage import RejectedSamples

PASS, FAIL, NOT_APPLICABLE = "pass", "FAIL", "not applicable"


@dataclass(frozen=True, slots=True)
class Plan:
    """What to run."""

    rows: tuple[str, ...] = ()
    """ids or beginnings of ids; none: all"""
    accels: tuple[str, ...] = (*INDICES, "none")
    """the first one stands for all where a row is not about intersection"""
    embree: bool = True
    quick: bool = False
    rays: int | None = None
    """at most so many rays, samples or draws a case"""
    seed: int = 0


@dataclass(frozen=True, slots=True)
class Finding:
    """One case on one subject."""

    id: str
    name: str
    subject: str
    figure: str
    criterion: str
    verdict: str
    reason: str = ""
    """why not applicable"""
    count: int = 0
    seconds: float = 0.0

    @property
    def is_ours(self) -> bool:
        return self.subject != EMBREE


def unknown_rows(rows: Sequence[str]) -> list[str]:
    """Those of `rows` that no id begins with."""
    return [row for row in rows if not any(entry.id.startswith(row) for entry in CATALOGUE)]


def run(plan: Plan) -> Iterator[Finding]:
    """Findings in the order of the catalogue, each as soon as it is there."""
    chosen = {e.id: e for e in CATALOGUE if not plan.rows or e.id.startswith(plan.rows)}
    every = [case for case in cases() if case.id in chosen]
    for entry in chosen.values():
        if entry.absent:
            yield Finding(entry.id, entry.name, "cpu", "-", entry.criterion, NOT_APPLICABLE, entry.absent)
        for case in every:
            if case.id == entry.id:
                yield from run_case(entry, case, plan)


def run_case(entry: Entry, case: Case, plan: Plan) -> Iterator[Finding]:
    """One case on each of its subjects that the plan has."""
    for subject in case.subjects:
        accel = plan.accels[0] if subject == ANY and plan.accels else subject
        if subject in (EMBREE, PICTURES):
            if not plan.embree or embree_missing() is not None or (subject == PICTURES and plan.quick):
                continue
        elif subject != CORE and accel not in plan.accels:
            continue
        yield measure(entry, case, accel, plan)


def measure(entry: Entry, case: Case, accel: str, plan: Plan) -> Finding:
    count = case.quick if plan.quick else case.full
    count = count if plan.rays is None else min(count, plan.rays)
    if accel == PICTURES:
        accel, count = EMBREE, min(count, PICTURE_RAYS)
    begin = time.perf_counter()
    verdict, reason = PASS, ""
    try:
        outcome = case.row(accel, count, plan.seed)
        verdict = FAIL if outcome.failed else PASS
    except NotApplicable as absence:
        outcome, verdict, reason = Outcome(0, 0, "-"), NOT_APPLICABLE, str(absence)
    except RejectedSamples as rejected:
        outcome, verdict = Outcome(1, 1, str(rejected)), FAIL
    return Finding(
        id=entry.id,
        name=f"{entry.name}, {case.name}",
        subject=subject_name(accel),
        figure=outcome.figure or f"{outcome.failed} of {outcome.total}",
        criterion=entry.criterion,
        verdict=verdict,
        reason=reason,
        count=count,
        seconds=time.perf_counter() - begin,
    )


def subject_name(accel: str) -> str:
    if accel == EMBREE:
        return EMBREE
    return "cpu" if accel == CORE else f"cpu/{accel}"


def absent_subjects() -> list[str]:
    """A line on each subject that this machine or version lacks."""
    reasons = {EMBREE: embree_missing(), "cuda": find_device("cuda").reason}
    return [f"{name}: absent: {reason}" for name, reason in reasons.items() if reason is not None]
