"""The rows of the catalogue of stiff cases about leaving a surface and meeting the next one: S03 to S12.

Each row renders with a camera that is looking at the case, so that rays leave surfaces as they do in any
picture, and compares every pixel (or, where samples are drawn by chance, the mean) with the closed form.
A row takes an accelerator and a number of camera rays.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..engine import session
from ..engine.scene_arrays import Camera as ArraysCamera
from ..engine.scene_arrays import InstanceArrays, Light, Material, MeshArrays, RenderSettings, SceneArrays
from .case import ANY, CORE, ONCE, PICTURES, Case, Outcome, Row
from .meshes import INDICES, Mesh, icosphere, mesh_of, scene_of
from .stage import (
    GLOW,
    GREY,
    POINT,
    RECTANGLE,
    SUN,
    WHITE,
    Camera,
    Settings,
    add_object,
    make_floor,
    new_scene,
    picture,
    place,
)

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
MIRROR = Material(1.0, 1.0, 1.0, metallic=1.0, roughness=0.0)
SAMPLES = 16
LEAVING = (*INDICES, PICTURES)
TOUCHING, APART = [1.5, 1.5 / 1.33], [1.5, 1.5, 1.33]
"""What a ray meets on its way through glass into water that touches it, or that air is between."""


def glass(ior: float) -> Material:
    return Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.0, ior=ior)


def film(count: int, bounces: int, seed: int = 0) -> Settings:
    """Settings that shoot about `count` camera rays."""
    side = max(2, int(np.sqrt(count / SAMPLES)))
    return Settings(side, side, SAMPLES, 1 + seed, bounces, threads=0, passes=("alpha",))


def axes_towards(forward: Float64, seed: int) -> Float64:
    """A camera's axes as columns; it looks along `forward`, turned about it at random."""
    z = -forward / np.linalg.norm(forward)
    x = np.cross(np.random.default_rng(seed).normal(size=3), z)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z], axis=1)


def far_from(expected: float, pixels: Float32, tolerance: float) -> Outcome:
    """How many of the pixels that show something are farther from the closed form than the row allows."""
    shown = pixels[pixels[..., 3] > 0, :3]
    return Outcome(int((np.abs(shown - expected) > tolerance).any(axis=1).sum()), len(shown))


def mean_is(expected: float, pixels: Float32, tolerance: float) -> Outcome:
    """For noisy pixels: all fail when their mean is off by the relative tolerance and four deviations."""
    values = pixels[..., 0].astype(np.float64)
    noise = 4 * values.std() / np.sqrt(values.size)
    off = abs(values.mean() - expected) > tolerance * expected + noise
    return Outcome(
        values.size if off else 0, values.size, f"mean {values.mean():.4f} +-{noise:.4f}, due {expected:.4f}"
    )


def add_mesh(scene: object, mesh: Mesh, material: int = 0, transform: Float32 | None = None) -> None:
    add_object(scene, (mesh.vertices, mesh.triangles), material, transform)


def far_camera(distance: float, scale: float) -> Row:
    """S03: a white ball in a white world, seen from `distance` radii: a ray that meets it again is dark."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        scene = new_scene([WHITE], world=1.0, accel=accel)
        add_mesh(scene, icosphere(4, scale))
        axes = axes_towards(np.array([0.3, -0.5, -0.8]), 1)
        eye = tuple(axes[:, 2] * distance * scale)
        camera = Camera(eye, axes, 1.1 / distance, kind=0, clip=(0.0, 1e30))
        return far_from(1.0, picture(scene, film(count, 0, seed), camera), 1e-5)

    return row


def grazing_exit(cosine: float, shift: float, baked: bool) -> Row:
    """S04: mirror facets of a ball, seen so flat that rays leave at `cosine` to the normal."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        mesh = icosphere(1)
        corners = mesh.vertices[mesh.triangles].astype(np.float64)
        failed = total = 0
        for k in range(0, len(corners), 10):
            centre = corners[k].mean(axis=0)
            normal = np.cross(corners[k][1] - corners[k][0], corners[k][2] - corners[k][0])
            normal *= np.sign(normal @ centre) / np.linalg.norm(normal)
            along = corners[k][1] - corners[k][0]
            forward = along / np.linalg.norm(along) - cosine * normal
            scene = new_scene([MIRROR], world=1.0, accel=accel)
            moved = mesh_of(mesh.vertices.astype(np.float64) + shift, mesh.triangles)
            add_mesh(scene, moved if baked else mesh, 0, None if baked else place(shift, shift, shift))
            eye = tuple(centre + shift - 3 * forward)
            camera = Camera(eye, axes_towards(forward, k), 0.1 * cosine, clip=(0.0, 1e30))
            outcome = far_from(1.0, picture(scene, film(count // 8, 4, seed), camera), 1e-5)
            failed, total = failed + outcome.failed, total + outcome.total
        return Outcome(failed, total)

    return row


def thin_gap(gap: float, shell: Material) -> Row:
    """S05: a glowing ball within a shell that lets all light straight through, `gap` above it."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        scene = new_scene([shell, GLOW], accel=accel)
        add_mesh(scene, icosphere(3, 1.0 + gap))
        add_mesh(scene, icosphere(3), 1)
        return far_from(1.0, picture(scene, film(count, 2, seed), Camera(half_width=0.5)), 1e-3)

    return row


def coplanar(second: list[tuple[int, int, int]], size: float, turned: bool) -> Row:
    """S06: two white squares in one plane, the second with its own triangles and size."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        scene = new_scene([WHITE], world=1.0, accel=accel)
        vertices, triangles = make_floor()
        axes = axes_towards(np.array([0.3, -0.5, -0.8]), 2) if turned else np.eye(3)
        for corners, faces in ((vertices, triangles), (vertices * size, second)):
            add_mesh(scene, mesh_of(corners.astype(np.float64) @ axes.T, np.array(faces)))
        camera = Camera(tuple(3 * axes[:, 2]), axes, 0.9)
        return far_from(1.0, picture(scene, film(count, 0, seed), camera), 1e-5)

    return row


def box(half: float, low: float, high: float, turned: bool = False) -> Mesh:
    """A closed box of height `low` to `high` about the z axis, its outside counter-clockwise; `turned`: the
    other diagonals."""
    corners = np.array([(x, y, z) for x in (-half, half) for y in (-half, half) for z in (low, high)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    if turned:
        quads = [quad[1:] + quad[:1] for quad in quads]
    return mesh_of(corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]))


def through_slabs(interfaces: list[float]) -> float:
    """Share of light that goes straight through parallel interfaces of these indices, all reflections in."""
    passed, reflected = 1.0, 0.0
    for ior in interfaces:
        r = ((ior - 1) / (ior + 1)) ** 2
        between = 1 - reflected * r
        passed, reflected = passed * (1 - r) / between, reflected + passed**2 * r / between
    return passed


def nested_glass(overlap: float, met: list[float], glass_first: bool = True, ranked: bool = True) -> Row:
    """S07, S08: glass 1.5 over water 1.33, lit from within the water; glass comes before water when
    `ranked`, else every interface is one to air. `met` are the indices that a ray meets one by one."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        media = [replace(glass(1.5), priority=2.0 * ranked), replace(glass(1.33), priority=1.0 * ranked)]
        scene = new_scene([*media, GLOW], accel=accel)
        parts = [(box(1e3, 0.0, 1.0), 0), (box(1e3, -2.0, overlap), 1)]
        for mesh, material in parts if glass_first else parts[::-1]:
            add_mesh(scene, mesh, material)
        add_mesh(scene, mesh_of(*make_floor(900.0, -1.0)), 2)
        return mean_is(
            through_slabs(met), picture(scene, film(count, 32, seed), Camera(half_width=0.5)), 1e-3
        )

    return row


def standing_form_factor(width: float, height: float, distance: float) -> float:
    """Of a floor point and a standing rectangle on the floor, straight in front of its middle (Siegel and
    Howell, configuration factors, a plane element normal to a rectangle)."""
    half, slant = 0.5 * width, np.hypot(height, distance)
    return float((np.arctan(half / distance) - distance / slant * np.arctan(half / slant)) / np.pi)


def standing_light(gap: float, distance: float, of_mesh: bool) -> Row:
    """S11: a floor in front of a square light that stands on it, `gap` above it."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        light = Light(RECTANGLE, 1.0, 1.0, 1.0, position_z=0.5 + gap, direction_x=1.0, direction_z=0.0,
                      axis_u_y=0.5, axis_v_z=0.5)  # fmt: skip
        scene = new_scene([GREY, GLOW], lights=[] if of_mesh else [light], accel=accel)
        add_object(scene, make_floor(10.0))
        if of_mesh:
            corners = [(0, -0.5, gap), (0, 0.5, gap), (0, 0.5, 1 + gap), (0, -0.5, 1 + gap)]
            add_mesh(scene, mesh_of(np.array(corners), np.array([(0, 1, 2), (0, 2, 3)])), 1)
        camera = Camera(eye=(distance, 0.0, 0.5), half_width=1e-3 * distance)
        expected = 0.5 * standing_form_factor(1.0, 1.0, distance)
        return mean_is(expected, picture(scene, film(count, 0, seed), camera), 5e-3)

    return row


def lying_light(gap: float) -> Row:
    """S11: a floor under a light that lies on it, face down: nothing but the light is above the floor."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        light = Light(RECTANGLE, 1.0, 1.0, 1.0, position_z=gap, direction_z=-1.0, axis_u_x=0.5, axis_v_y=0.5)
        scene = new_scene([GREY], lights=[light], accel=accel)
        add_object(scene, make_floor(10.0))
        camera = Camera(eye=(0.0, 0.0, 0.5), half_width=0.3)
        return mean_is(0.5, picture(scene, film(count, 0, seed), camera), 5e-3)

    return row


def sheets(count: int) -> Mesh:
    """`count` squares one above the other, 1e-3 apart."""
    vertices, triangles = make_floor()
    levels = np.arange(count)[:, None]
    corners = np.tile(vertices.astype(np.float64), (count, 1))
    corners[:, 2] = np.repeat(1e-3 * levels.ravel(), 4) + 1e-3
    faces = (triangles[None] + 4 * levels[:, :, None]).reshape(-1, 3)
    return mesh_of(corners, faces)


def sheets_seen_through(accel: str, count: int, seed: int = 0) -> Outcome:
    """S12: a glowing floor through 1000 sheets that each pass 0.99."""
    veil = Material(alpha=0.0, through_r=0.99, through_g=0.99, through_b=0.99)
    scene = new_scene([veil, GLOW], accel=accel)
    add_mesh(scene, sheets(1000))
    add_object(scene, make_floor(5.0), 1)
    expected = 0.99**1000
    return far_from(expected, picture(scene, film(count, 0, seed), Camera(half_width=0.9)), 0.01 * expected)


def sheets_lit_through(light: Light) -> Row:
    """S12: a floor lit through 1000 sheets that are there to a hundredth; the camera is below them."""

    def row(accel: str, count: int, seed: int = 0) -> Outcome:
        scene = new_scene(
            [Material(0.0, 0.0, 0.0, specular=0.0, alpha=0.01), WHITE], lights=[light], accel=accel
        )
        add_mesh(scene, sheets(1000))
        add_object(scene, make_floor(5.0), 1)
        camera = Camera(eye=(0.0, 0.0, 5e-4), half_width=1e-2)
        expected = 0.99**1000
        return far_from(expected, picture(scene, film(count, 0, seed), camera), 0.01 * expected)

    return row


def sheets_met(accel: str, count: int, seed: int = 0) -> Outcome:
    """S12: rays that start anew just past every hit meet all 1000 sheets, in their order."""
    mesh = sheets(1000)
    scene = scene_of(mesh, accel)
    rng = np.random.default_rng(1 + seed)
    rays = max(1, count // 1000)
    origins = np.column_stack([rng.uniform(-0.5, 0.5, (rays, 2)), np.full(rays, 3.0)]).astype(np.float32)
    directions = np.column_stack([rng.uniform(-0.1, 0.1, (rays, 2)), np.full(rays, -1.0)]).astype(np.float32)
    start = np.zeros(rays, np.float32)
    failed = 0
    for sheet in range(1000)[::-1]:
        hits = scene.intersect(origins, directions, tmin=start)
        failed += int((hits.triangle // 2 != sheet).sum())
        start = hits.t * np.float32(1.0000002)
    return Outcome(
        failed + int((scene.intersect(origins, directions, tmin=start).triangle >= 0).sum()), 1000 * rays
    )


def rows() -> Iterator[tuple[str, Row]]:
    """Name and row, in the order of the catalogue."""
    for distance in (1e2, 1e4, 1e5):
        for scale in (1e-3, 1.0, 1e3):
            yield f"S03 far-camera, {distance:g} radii of {scale:g}", far_camera(distance, scale)
    for cosine in (1e-3, 1e-2):
        for shift in (0.0, 1e2, 1e4, 1e5):
            yield (
                f"S04 grazing-exit, cosine {cosine:g}, placed at {shift:g}",
                grazing_exit(cosine, shift, False),
            )
            yield (
                f"S04 grazing-exit, cosine {cosine:g}, vertices at {shift:g}",
                grazing_exit(cosine, shift, True),
            )
    for gap in (1e-2, 1e-4, 1e-5, 1e-6):
        yield f"S05 thin-gap, {gap:g}, refracting shell", thin_gap(gap, glass(1.0))
        yield f"S05 thin-gap, {gap:g}, shell that is not there", thin_gap(gap, Material(alpha=0.0))
    for turned in (False, True):
        where = "turned" if turned else "level"
        yield f"S06 coplanar-dup, identical, {where}", coplanar([(0, 1, 2), (0, 2, 3)], 1.0, turned)
        yield f"S06 coplanar-dup, other diagonal, {where}", coplanar([(0, 1, 3), (1, 2, 3)], 1.0, turned)
        yield f"S06 coplanar-dup, larger, {where}", coplanar([(0, 1, 2), (0, 2, 3)], 1.7, turned)
    for gap in (0.0, 1e-6):
        for distance in (1e-3, 0.1, 1.0):
            yield f"S11 standing lamp, gap {gap:g}, {distance:g} away", standing_light(gap, distance, False)
            yield f"S11 standing mesh, gap {gap:g}, {distance:g} away", standing_light(gap, distance, True)
    yield "S11 lying lamp, gap 1e-6", lying_light(1e-6)
    yield "S12 alpha-stack, seen through", sheets_seen_through
    sun = Light(SUN, np.pi, np.pi, np.pi, direction_z=1.0)
    yield "S12 alpha-stack, lit by a sun", sheets_lit_through(sun)
    lamp = Light(POINT, 1e6 * np.pi, 1e6 * np.pi, 1e6 * np.pi, position_z=1e3)
    yield "S12 alpha-stack, lit by a lamp", sheets_lit_through(lamp)
    yield "S12 alpha-stack, met one by one", sheets_met


def warned_of(accel: str, count: int, seed: int = 0) -> Outcome:
    """S06: a scene with two identical squares is rendered with a warning."""
    vertices, triangles = make_floor()
    scene = SceneArrays(ArraysCamera(1, np.eye(3, 4), (-1.0, 1.0, -1.0, 1.0)), materials=[WHITE])
    scene.meshes = [MeshArrays(vertices, triangles), MeshArrays(vertices.copy(), triangles.copy())]
    still = np.eye(3, 4, dtype=np.float32)[None]
    scene.instances = [InstanceArrays(mesh, still, np.zeros(1, np.int32)) for mesh in (0, 1)]
    warnings = session.render(scene, RenderSettings(4, 4, samples=1, seed=seed)).report["warnings"]
    return Outcome(int(not warnings), 1, f"{len(warnings)} warnings")


def cases() -> Iterator[Case]:
    """S03 to S08, S11, S12."""
    for name, row in rows():
        number, _, rest = name.partition(" ")
        # The row's name in the catalogue is in front.
        what = rest.partition(" ")[2] if number != "S11" else rest
        subjects = {"S11": ONCE, "S12": (ANY,)}.get(number, LEAVING)
        yield Case(number, what, row, subjects, 1_000_000, 16_000 if number == "S11" else 1600)
    for first in (True, False):
        what = "glass first" if first else "water first"
        yield Case("S07", what, nested_glass(0.0, TOUCHING, first), ONCE, 1_000_000, 16_000)
    for overlap in (0.1, 1e-3, 1e-5):
        yield Case("S08", f"overlap {overlap:g}", nested_glass(overlap, TOUCHING), ONCE, 1_000_000, 16_000)
        row = nested_glass(overlap, APART, ranked=False)
        yield Case("S08", f"overlap {overlap:g}, no priorities (0.905)", row, ONCE, 1_000_000, 16_000)
    for gap in (1e-6, 1e-4, 1e-2):
        row = nested_glass(-gap, APART)
        yield Case("S08", f"air gap {gap:g} (0.905)", row, ONCE, 1_000_000, 16_000)
    yield Case("S06", "warning", warned_of, (CORE,), 1, 1)
