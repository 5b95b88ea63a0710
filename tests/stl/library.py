"""The files of the library and the examples, and ways to run them without Blender."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from trg_blender.lang import (
    Diagnostic,
    DiskFiles,
    FrameEvent,
    HostOptions,
    NoFiles,
    SceneDescription,
    Session,
    compile_source,
)
from trg_blender.lang.files import FileResolver
from trg_blender.lang.scene import ShapeRecord, Vec3

ROOT = Path(__file__).resolve().parents[2]
LIBRARY = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "stl").rglob("*.trg"))
EXAMPLES = sorted(path.name for path in (ROOT / "examples").glob("*.trg"))


@dataclass
class Outcome:
    """What came of a program: lines of output, diagnostics of any kind, the first frames."""

    output: list[str] = field(default_factory=list)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    frames: list[SceneDescription] = field(default_factory=list)

    @property
    def shapes(self) -> tuple[ShapeRecord, ...]:
        """The shapes of the last frame."""
        return self.frames[-1].shapes


def run_text(text: str, frames: int = 1, resolver: FileResolver | None = None) -> Outcome:
    """Run `text` to its end or to `frames` frames. ProgramError when it does not compile."""
    program = compile_source(text, "main.trg", resolver or NoFiles())
    session = Session(program, HostOptions())
    taken: list[SceneDescription] = []
    while len(taken) < frames and isinstance(event := session.next_frame(), FrameEvent):
        taken.append(event.scene)
    return Outcome(list(session.output), [*program.diagnostics, *session.diagnostics], taken)


def run_example(name: str, frames: int = 1) -> Outcome:
    """Run a file of `examples/`."""
    text = (ROOT / "examples" / name).read_text(encoding="utf-8")
    return run_text(text, frames, DiskFiles(ROOT / "examples"))


def build(expression: str, include: str) -> tuple[ShapeRecord, ...]:
    """The shapes of the group that `expression` makes."""
    outcome = run_text(f'include("{include}"); Scene = scene(); {expression}.AddTo(Scene); Scene.Render();')
    assert outcome.diagnostics == []
    return outcome.shapes


def head_of(file: str) -> str:
    """The comment that a library file opens with, its stars taken off."""
    text = (ROOT / file).read_text(encoding="utf-8")
    assert text.startswith("/*\n")
    lines = text[: text.index("*/")].splitlines()[1:]
    return "\n".join(line.removeprefix(" *").removeprefix(" ") for line in lines)


def use_of(file: str) -> str:
    """The program that stands under "Use:" in the head of a library file."""
    _, _, behind = head_of(file).partition("\nUse:\n")
    lines: list[str] = []
    for line in behind.splitlines():
        if line.strip() and not line.startswith("  "):
            break
        lines.append(line.removeprefix("  "))
    return "\n".join(lines).strip() + "\n"


def world_points(shape: ShapeRecord) -> list[Vec3]:
    """Points that a shape reaches, in the world: corners of a box, of a triangle, of a bounding box."""
    matrix = shape.transform
    return [
        tuple(sum(matrix[4 * row + k] * p[k] for k in range(3)) + matrix[4 * row + 3] for row in range(3))
        for p in _local_points(shape)
    ]  # type: ignore[misc]


def _local_points(shape: ShapeRecord) -> list[Vec3]:
    values = shape.parameters
    if shape.kind == "triangle":
        return list(values)  # type: ignore[arg-type]
    if shape.kind == "box":
        low, high = values
    elif shape.kind == "sphere":
        (x, y, z), r = values  # type: ignore[misc]
        low, high = (x - r, y - r, z - r), (x + r, y + r, z + r)
    elif shape.kind in ("cylinder", "conus"):
        (x, y, z), r, h = values  # type: ignore[misc]
        low, high = (x - r, y, z - r), (x + r, y + h, z + r)
    else:
        raise ValueError(f"no bounds known for a {shape.kind}")
    return [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]


def bounds(shapes: tuple[ShapeRecord, ...]) -> tuple[Vec3, Vec3]:
    """The lowest and the highest coordinates of shapes."""
    points = [point for shape in shapes for point in world_points(shape)]
    return (
        tuple(min(p[k] for p in points) for k in range(3)),
        tuple(max(p[k] for p in points) for k in range(3)),
    )  # type: ignore[return-value]
