"""The twelve scenes of benchmarks/calibration.py: easy light, and light that few paths find."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from tests.engine.agreement_scenes import GEOMETRY, KEY, LIGHTS, MATERIALS, studio
from tests.engine.arrays import ball, box, floor_scene, light, look_at, place, quad
from trg_blender.engine.scene_arrays import Material, SceneArrays

GREY = Material(0.7, 0.7, 0.7, specular=0.0)
SMALL_LAMP = light("point", (4.0, 4.0, 4.0), (0.6, -0.8, 1.8), radius=0.12)


@dataclass(frozen=True, slots=True)
class CalibrationScene:
    """`hard` scenes have caustics or light through a gap; the pixel level may hold less often there."""

    build: Callable[[], SceneArrays]
    hard: bool = False


def _area_over_floor() -> SceneArrays:
    return floor_scene(GREY, KEY)


def _wide_sun() -> SceneArrays:
    return studio(GREY, light("sun", (2.0, 1.8, 1.5), direction=(0.5, -0.6, 1.0), angle=0.4), world=(0, 0, 0))


def _slit() -> SceneArrays:
    """A lamp in a box with a gap: the room outside gets what comes out and bounces."""
    scene = floor_scene(GREY, light("point", (6.0, 6.0, 6.0), (0.0, 0.0, 1.0), radius=0.1))
    scene.camera = look_at((2.5, -2.5, 2.0), (0, 0, 0.4), 0.5)
    scene.meshes += [quad(0.6), box(0.1)]
    scene.instances += [place(1, 0, (0, 0, 1.35)), place(2, 0, (0.0, 0.0, 0.5))]
    return scene


def _glass_caustic() -> SceneArrays:
    scene = studio(MATERIALS["glass"], SMALL_LAMP, world=(0.02, 0.02, 0.02))
    scene.meshes[0] = quad(3.0)
    return scene


def _mirror_caustic() -> SceneArrays:
    return studio(MATERIALS["mirror"], SMALL_LAMP, world=(0.02, 0.02, 0.02))


def _lamp_in_glass() -> SceneArrays:
    """A small glowing ball inside a glass ball: found by bounces alone."""
    scene = floor_scene(GREY)
    scene.camera = look_at((0, -3, 1.2), (0, 0, 0.4), 0.4)
    scene.meshes += [ball(0.4), ball(0.12)]
    scene.materials += [
        MATERIALS["glass"],
        Material(0.0, 0.0, 0.0, emission_r=9.0, emission_g=8.0, emission_b=6.0),
    ]
    scene.instances += [place(1, 1, (0, 0, 0.5)), place(2, 2, (0, 0, 0.5))]
    return scene


SCENES: dict[str, CalibrationScene] = {
    "area light over a floor": CalibrationScene(_area_over_floor),
    "wide sun": CalibrationScene(_wide_sun),
    "diffuse studio": CalibrationScene(lambda: studio(MATERIALS["diffuse"], KEY)),
    "plastic under a spot": CalibrationScene(lambda: studio(MATERIALS["plastic"], LIGHTS["spot_sphere"])),
    "metal": CalibrationScene(lambda: studio(MATERIALS["metal"], KEY)),
    "textured": CalibrationScene(GEOMETRY["textured"]),
    "environment": CalibrationScene(GEOMETRY["environment"]),
    "many lights": CalibrationScene(GEOMETRY["many_lights"]),
    "lamp above a plate": CalibrationScene(_slit),
    "glass caustic": CalibrationScene(_glass_caustic, hard=True),
    "mirror caustic": CalibrationScene(_mirror_caustic, hard=True),
    "lamp in glass": CalibrationScene(_lamp_in_glass, hard=True),
}
