"""Error against run time, measured: one progressive render a variant and seed, looked at on the way.

The error measured is the root of the mean squared difference from a reference picture; the error stated is
what the render says of itself at the same moment (image_error.py). Times are seconds of wall clock since the
start of tracing plus those of building the accelerator.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from . import session
from .antialiasing import ANTIALIASINGS, FINEST_GRID
from .image_error import STUDENT_95, rmse
from .scene_arrays import PIXEL_FILTERS, Float64, RenderSettings, SceneArrays

POLL_SECONDS = 0.005
BELL_WIDTH = 1.5
"""pixels: Blender's width of filters other than the box"""
TRUTH_SEED = 0x7EF3
STUDENT_MANY = 1.96


@dataclass(frozen=True, slots=True)
class Variant:
    """What is compared; names are those of the command line."""

    device: str = "cpu"
    accel: str = "auto"
    integrator: str = "path"
    triangle_test: str = "watertight"
    aa: str = ""
    """antialiasing: METHOD, METHOD:SIDE, or a pixel filter; empty: the scene's own"""

    @property
    def name(self) -> str:
        parts = (self.device, self.accel, self.integrator, self.triangle_test, self.aa)
        return " / ".join(part for part in parts if part)

    def apply(self, settings: RenderSettings) -> RenderSettings:
        return replace(
            with_antialiasing(settings, self.aa),
            device=self.device,
            accel=self.accel,
            integrator=self.integrator,
            triangle_test=self.triangle_test,
        )


def with_antialiasing(settings: RenderSettings, choice: str) -> RenderSettings:
    """`choice` is a Variant's `aa`. Raises ValueError for what is none."""
    if not choice:
        return settings
    name, _, side = choice.partition(":")
    if side and not (side.isdecimal() and 1 <= int(side) <= FINEST_GRID):
        raise ValueError(f"{choice}: a pixel's side has 1 to {FINEST_GRID} cells")
    if name in PIXEL_FILTERS and not side:
        width = 1.0 if name == "box" else BELL_WIDTH
        return replace(settings, aa="sobol", pixel_filter=name, filter_width=width)
    if name not in ANTIALIASINGS:
        raise ValueError(f"{choice}: choose from {', '.join((*ANTIALIASINGS, *PIXEL_FILTERS))}")
    return replace(settings, aa=name, aa_side=int(side or settings.aa_side))


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """One look at one render."""

    variant: Variant
    seed: int
    seconds: float
    samples: float
    measured: float
    """RMSE against the reference"""
    stated: float | None
    """what the render said its RMSE was; None below two replicates"""
    low: float | None
    high: float | None
    """its 95 % interval"""


@dataclass(frozen=True, slots=True)
class Fit:
    """log(measured) = log(at_one) + slope log(seconds), by least squares over all points."""

    slope: float
    slope_error: float
    """half width of its 95 % interval"""
    at_one: float
    """RMSE at one second"""

    def seconds_to(self, target: float) -> float:
        """When the fitted error is `target`; infinite where the error does not fall."""
        if self.slope >= 0.0:
            return math.inf
        return math.exp(math.log(target / self.at_one) / self.slope)


def make_reference(scene: SceneArrays, settings: RenderSettings, samples: int) -> Float64:
    """(h, w, 3): the picture of `samples` samples on the CPU, with a seed that no curve uses.

    Its points are Sobol's through the pixel filter of `settings`, whatever their antialiasing.
    """
    long = replace(settings, samples=samples, seconds=0.0, rmse=0.0, adaptive=False)
    long = replace(long, seed=TRUTH_SEED, aa="sobol")
    return session.render(scene, replace(long, device="cpu")).pixels[..., :3].astype(np.float64)


def measure_curve(
    scene: SceneArrays, settings: RenderSettings, times: Sequence[float], truth: Float64, variant: Variant
) -> Iterator[CurvePoint]:
    """Points at each of `times` (seconds, rising); the seed is that of `settings`.

    A render that runs out of its samples ends the curve early. Raises what session.start raises.
    """
    job = session.start(scene, variant.apply(replace(settings, seconds=times[-1])))
    built = job.build_seconds
    for wanted in times:
        state = job.poll(POLL_SECONDS)
        while not state.done and state.seconds < wanted:
            state = job.poll(min(POLL_SECONDS, wanted - state.seconds))
        pixels, error = job.picture()[..., :3], job.error()
        seconds = state.seconds if state.done else 0.5 * (state.seconds + job.poll(0.0).seconds)
        if state.samples < 1:
            continue
        low, high = error.ci95 or (None, None)
        measured = rmse(pixels.astype(np.float64), truth)
        yield CurvePoint(
            variant, settings.seed, built + seconds, state.samples, measured, error.rmse, low, high
        )
        if state.done:
            return


def fit_curve(points: Sequence[CurvePoint]) -> Fit | None:
    """None with fewer than three points of an error above 0."""
    used = [point for point in points if point.measured > 0.0 and point.seconds > 0.0]
    if len(used) < 3 or len({point.seconds for point in used}) < 2:
        return None
    x = np.log([point.seconds for point in used])
    y = np.log([point.measured for point in used])
    centred = x - x.mean()
    slope = float((centred * y).sum() / (centred**2).sum())
    rest = y - y.mean() - slope * centred
    freedom = len(used) - 2
    spread = math.sqrt(float((rest**2).sum()) / freedom / float((centred**2).sum()))
    student = STUDENT_95.get(freedom, STUDENT_MANY if freedom > 30 else 2.3)
    return Fit(slope, student * spread, math.exp(float(y.mean() - slope * x.mean())))


def held_share(points: Sequence[CurvePoint]) -> float | None:
    """Share of points whose stated interval holds the measured error; None without intervals."""
    told = [point for point in points if point.low is not None and point.high is not None]
    if not told:
        return None
    return sum(point.low <= point.measured <= point.high for point in told) / len(told)  # type: ignore[operator]
