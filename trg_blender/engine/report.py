"""The report of a render: what was done, how long it took, how wrong the picture is (docs/report.md)."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from numpy.typing import NDArray

from .. import __version__
from .antialiasing import NO_RANDOMNESS, is_deterministic
from .features import find_features
from .image_error import Evidence, PictureError
from .scene_arrays import RenderSettings, SceneArrays


@dataclass(frozen=True, slots=True)
class HistoryEntry:
    """The error at one moment; recorded whenever the samples have doubled."""

    samples: float
    seconds: float
    error: PictureError


@dataclass(frozen=True, slots=True)
class Progress:
    """A running render at one moment."""

    done: bool
    cancelled: bool
    samples: float
    target: int
    error: PictureError
    rays_per_second: float
    seconds: float
    seconds_left: float | None
    error_target: float = 0.0
    """RMSE at which the render stops; 0: no such stop"""
    seconds_to_target: float | None = None
    """None where there is no target, or the error is not known yet"""

    @property
    def share(self) -> float:
        """How much of the render is done, 0 to 1, by the limit that will be met first."""
        if self.done:
            return 1.0
        if self.seconds_left is None:
            return min(self.samples / max(self.target, 1), 1.0)
        return self.seconds / max(self.seconds + self.seconds_left, 1e-9)


@dataclass(frozen=True, slots=True)
class RenderFacts:
    """What a finished or stopped render knows about itself."""

    scene: SceneArrays
    settings: RenderSettings
    job: dict[str, Any]
    """the last poll of the job, from which also comes `kernel_set`"""
    build: dict[str, Any]
    """build statistics; `reason` of the accelerator and the like stay out of the report"""
    error: PictureError
    history: list[HistoryEntry] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    instruction_set: str | None = None
    threads: int = 1
    evidence: Evidence | None = None
    rejected_places: list[tuple[int, int, int]] = field(default_factory=list)
    """(x, y, sample) of the first samples that were no numbers"""


def build_report(facts: RenderFacts) -> dict[str, Any]:
    """The report as JSON-ready values; `file`, `frame`, `script` and `sync` wait for `with_source`."""
    scene, settings, job = facts.scene, facts.settings, facts.job
    seconds = {"script": None, "sync": None, "build": facts.build.get("seconds"), "trace": job["seconds"]}
    return {
        "version": __version__,
        "file": None,
        "frame": None,
        "size": [settings.width, settings.height],
        "device": settings.device,
        "accel": facts.build.get("accel"),
        "integrator": settings.integrator,
        "aa": settings.aa,
        "seed": settings.seed,
        "threads": facts.threads,
        "kernel_set": job.get("kernel_set"),
        "instruction_set": facts.instruction_set,
        "samples": job["samples"],
        "seconds": {**seconds, "total": total_seconds(seconds)},
        "build": build_section(facts.build),
        "rays": ray_section(job),
        "error": error_section(facts),
        "memory": {
            "geometry_bytes": geometry_bytes(scene),
            "accel_bytes": facts.build.get("bytes"),
            "peak_bytes": peak_bytes(),
        },
        "scene": scene_section(scene),
        "features": feature_section(scene, settings),
        "numerics": {
            "rejected_samples": job["rejected_samples"],
            "rejected_places": [
                {"x": x, "y": y, "sample": sample} for x, y, sample in facts.rejected_places
            ],
            "cut_rays": job.get("cut_rays", 0),
            "reprojected_pixels": 0,
            "degenerate_triangles": facts.build.get("degenerate_triangles"),
            "clamped": job.get("clamped", 0),
        },
        "warnings": [*scene.warnings, *facts.warnings, *unmet_target(facts), *rejections(facts)],
    }


def with_source(
    report: dict[str, Any], file: str | None, frame: int | None, seconds: dict[str, float] | None = None
) -> dict[str, Any]:
    """A copy that names its file and frame; `seconds` may give `script` and `sync`."""
    merged = {**report["seconds"], **(seconds or {})}
    merged["total"] = total_seconds({key: value for key, value in merged.items() if key != "total"})
    return {**report, "file": file, "frame": frame, "seconds": merged}


def total_seconds(parts: dict[str, float | None]) -> float:
    return sum(value for value in parts.values() if value is not None)


def build_section(build: dict[str, Any]) -> dict[str, Any]:
    """What of the index was made for this picture, and what was left from the one before."""
    whole = {
        "built_trees": build.get("built_trees"),
        "kept_trees": build.get("kept_trees", 0),
        "fitted_trees": 0,
        "top_level": True,
    }
    return {**whole, **build.get("changes", {})}


def ray_section(job: dict[str, Any]) -> dict[str, Any]:
    total = job["rays_camera"] + job["rays_shadow"] + job["rays_bounce"]
    per_second = total / job["seconds"] if job["seconds"] > 0.0 else None
    return {
        "camera": job["rays_camera"],
        "shadow": job["rays_shadow"],
        "bounce": job["rays_bounce"],
        "total": total,
        "per_second": per_second,
    }


def error_section(facts: RenderFacts) -> dict[str, Any]:
    history = [
        {
            "samples": entry.samples,
            "seconds": entry.seconds,
            "rmse": entry.error.rmse,
            "ci95": interval_list(entry.error),
        }
        for entry in facts.history
    ]
    return {
        "rmse": facts.error.rmse,
        "ci95": interval_list(facts.error),
        "relmse": facts.error.relmse,
        "reliable": is_reliable(facts),
        "note": error_note(facts),
        "evidence": None if facts.evidence is None else asdict(facts.evidence),
        "target": facts.settings.rmse or None,
        "stopped_by": facts.job["stopped_by"],
        "adaptive": facts.settings.adaptive,
        "biases": biases(facts.settings),
        "history": history,
    }


def biases(settings: RenderSettings) -> list[str]:
    """What makes the picture's expectation another than that of all light: not part of `rmse`."""
    return [f"max bounces: {settings.max_bounces}", *settings.rules.describe()]


def is_reliable(facts: RenderFacts) -> bool:
    """Whether `rmse` and its interval may be believed."""
    return (
        facts.error.rmse is not None
        and facts.error.rmse > 0.0
        and facts.evidence is not None
        and facts.evidence.is_enough
    )


def error_note(facts: RenderFacts) -> str | None:
    """Why the error is not known, is 0, or cannot be relied on; None where it says enough itself."""
    error, evidence = facts.error, facts.evidence
    if is_deterministic(facts.settings):
        return NO_RANDOMNESS
    if error.rmse is None or evidence is None:
        return "fewer than two replicates have samples: there is no spread to tell the error from"
    if error.rmse == 0.0:
        if evidence.lit == 0.0:
            return "no sample has met any light: an error of 0 says nothing about light that was missed"
        return "every replicate gave the same picture: it has no noise"
    return None if evidence.doubt is None else f"not reliable: {evidence.doubt}; render longer"


def unmet_target(facts: RenderFacts) -> list[str]:
    """A warning when the render ended before the error that was asked for."""
    target, rmse = facts.settings.rmse, facts.error.rmse
    if target <= 0.0 or facts.job["stopped_by"] == "error" or rmse is None or rmse <= target:
        return []
    return [f"error target {target:g} was not met: rmse {rmse:.3g} when {facts.job['stopped_by']} ended it"]


def rejections(facts: RenderFacts) -> list[str]:
    """A warning when samples were dropped, with the first of them."""
    count = facts.job["rejected_samples"]
    if not count:
        return []
    where = [f"; the first: pixel {x},{y}, sample {sample}" for x, y, sample in facts.rejected_places[:1]]
    return [f"{count} samples were no finite numbers and were left out{''.join(where)}"]


def seconds_left(state: Mapping[str, Any], settings: RenderSettings, error: PictureError) -> float | None:
    """Predicted by the limit that comes first; the error falls with the root of the samples."""
    seconds, samples = state["seconds"], state["samples"]
    guesses = []
    if samples > 0:
        guesses.append(seconds * (state["target"] / samples - 1.0))
    if settings.seconds > 0.0:
        guesses.append(settings.seconds - seconds)
    to_target = seconds_to_target(seconds, settings.rmse, error)
    if to_target is not None:
        guesses.append(to_target)
    return max(min(guesses), 0.0) if guesses else None


def seconds_to_target(seconds: float, target: float, error: PictureError) -> float | None:
    """Until the error is `target`, as it falls with the root of the time; None where that is not known."""
    if target <= 0.0 or error.rmse is None:
        return None
    return max(seconds * ((error.rmse / target) ** 2 - 1.0), 0.0)


def interval_list(error: PictureError) -> list[float] | None:
    return None if error.ci95 is None else list(error.ci95)


def scene_section(scene: SceneArrays) -> dict[str, int]:
    triangles = sum(
        len(one.transforms) * len(scene.meshes[one.mesh].triangles)
        for one in scene.instances
        if scene.meshes[one.mesh].shape == "triangles"
    )
    return {
        "triangles": triangles,
        "instances": sum(len(one.transforms) for one in scene.instances),
        "lights": len(scene.lights),
        "materials": len(scene.materials),
        "textures": len(scene.textures),
    }


def feature_section(scene: SceneArrays, settings: RenderSettings) -> dict[str, Any]:
    used, left_out = find_features(scene, settings)
    return {"used": used, "left_out": left_out, "saved_bytes": None}


def geometry_bytes(scene: SceneArrays) -> int:
    """Bytes of the scene's arrays: meshes, transforms, images."""
    arrays: list[NDArray[Any]] = [
        array
        for mesh in scene.meshes
        for array in (mesh.vertices, mesh.triangles, mesh.normals, mesh.uvs, mesh.slots)
        if array is not None
    ]
    arrays += [instance.transforms for instance in scene.instances]
    arrays += [image.pixels for image in scene.images]
    return sum(array.nbytes for array in arrays)


def peak_bytes() -> int | None:
    """The largest resident size of this process so far; None where the system does not tell."""
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return int(peak) if sys.platform == "darwin" else int(peak) * 1024


ENDLESS_SAMPLES = 2**20
"""As many samples stand for no limit, where time or error end the render."""


def format_progress(progress: Progress) -> str:
    """One line: `sample 12/64, rmse 0.021 (0.019 to 0.023), 3.4 Mrays/s, 00:04 left`; no unknown parts.

    With an error target also `target 0.01 in 00:09`, which may be later than another limit.
    """
    endless = progress.target >= ENDLESS_SAMPLES
    parts = [f"sample {int(progress.samples)}" + ("" if endless else f"/{progress.target}")]
    error = progress.error
    if error.rmse is not None:
        parts.append(f"rmse {error.rmse:.2g}")
    if error.ci95 is not None:
        parts[-1] += f" ({error.ci95[0]:.2g} to {error.ci95[1]:.2g})"
    if progress.seconds_to_target is not None and not progress.done:
        parts.append(f"target {progress.error_target:.2g} in {format_clock(progress.seconds_to_target)}")
    if progress.rays_per_second > 0.0:
        parts.append(f"{format_rate(progress.rays_per_second)}rays/s")
    if progress.seconds_left is not None and not progress.done:
        parts.append(f"{format_clock(progress.seconds_left)} left")
    return ", ".join(parts)


def format_rate(per_second: float) -> str:
    """Two or more digits with a decimal prefix: `3.4 M`, `120 k`."""
    for factor, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if per_second >= factor:
            scaled = per_second / factor
            return f"{scaled:.1f} {prefix}" if scaled < 100.0 else f"{scaled:.0f} {prefix}"
    return f"{per_second:.0f} "


def format_clock(seconds: float) -> str:
    """`mm:ss`, or `h:mm:ss` from an hour on."""
    whole = max(0, round(seconds))
    hours, minutes = divmod(whole // 60, 60)
    tail = f"{minutes:02d}:{whole % 60:02d}"
    return f"{hours}:{tail}" if hours else tail
