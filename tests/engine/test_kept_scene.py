"""Scenes kept from picture to picture: what is built anew, counted, and the same pixels as without."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine import session
from trg_blender.engine.devices import find_device
from trg_blender.engine.errors import SceneError
from trg_blender.engine.kept_scene import KeptScene
from trg_blender.engine.native import load_native
from trg_blender.engine.scene_arrays import (
    Environment,
    InstanceArrays,
    Material,
    RenderSettings,
    SceneArrays,
    Texture,
)

from .arrays import IDENTITY, ball, box, checker, light, look_at, quad

pytestmark = pytest.mark.skipif(not find_device("cpu").available, reason="no native core")

SETTINGS = RenderSettings(24, 18, samples=8, max_bounces=2)


def places(*offsets: tuple[float, float, float]) -> np.ndarray:
    rows = np.repeat(IDENTITY, len(offsets), axis=0).astype(np.float32)
    rows[:, :, 3] = offsets
    return rows


def copies(mesh: int, transforms: np.ndarray, material: int = 0) -> InstanceArrays:
    return InstanceArrays(mesh, transforms, np.array([material], np.int32))


def scene_now() -> SceneArrays:
    """A floor, a box that stands where its mesh is, and two balls; every call gives new arrays."""
    return SceneArrays(
        look_at((4, -5, 3), (0, 0, 0.5)),
        meshes=[quad(4.0), box(), ball(0.5)],
        instances=[
            copies(0, places((0, 0, -0.5))),
            copies(1, IDENTITY.copy()),
            copies(2, places((1, 0, 0), (-1, 0, 0)), 1),
        ],
        materials=[Material(0.8, 0.4, 0.2), Material(0.2, 0.5, 0.8, roughness=0.3)],
        lights=[light("sun", (3, 3, 3), direction=(0.3, -0.2, 0.9))],
        world=(0.2, 0.2, 0.25),
    )


def moved() -> SceneArrays:
    scene = scene_now()
    scene.instances[1].transforms[:, :, 3] = (0, 1, 0.3)
    scene.instances[2].transforms[1, :, 3] = (-1, 0.5, 0.2)
    return scene


def deformed() -> SceneArrays:
    scene = scene_now()
    mesh = scene.meshes[2]
    mesh.vertices = (mesh.vertices * np.float32([1.1, 1.0, 0.9])).astype(np.float32)
    return scene


def torn() -> SceneArrays:
    """A deformation that no tree can be fitted to."""
    scene = scene_now()
    vertices = scene.meshes[2].vertices
    scene.meshes[2].vertices = np.random.default_rng(1).permutation(vertices * 2.0)
    return scene


def remeshed() -> SceneArrays:
    scene = scene_now()
    scene.meshes[2] = ball(0.5, rings=7)
    return scene


def recoloured() -> SceneArrays:
    scene = scene_now()
    scene.materials[1] = Material(0.9, 0.1, 0.1, emission_r=0.5)
    scene.lights[0].color_r, scene.world = 1.0, (0.0, 0.1, 0.0)
    return scene


def reassigned() -> SceneArrays:
    scene = scene_now()
    scene.instances[1] = copies(1, IDENTITY.copy(), 1)
    return scene


def grown() -> SceneArrays:
    """One object more, before the others, and one copy less."""
    scene = scene_now()
    scene.meshes.insert(0, box(0.2, "Small"))
    for one in scene.instances:
        one.mesh += 1
    scene.instances[2].transforms = scene.instances[2].transforms[:1]
    scene.instances.insert(0, copies(0, places((0, -1, 0))))
    return scene


def under_a_sky() -> SceneArrays:
    scene = scene_now()
    pixels = np.random.default_rng(2).random((8, 16, 3)).astype(np.float32)
    scene.environment = Environment(pixels)
    return scene


def seen_elsewhere() -> SceneArrays:
    return replace(scene_now(), camera=look_at((-4, -3, 2), (0, 0, 0)))


def render(scene: SceneArrays, kept: KeptScene | None, settings: RenderSettings = SETTINGS) -> session.Result:
    return session.start(scene, settings, kept).result()


def built(scene: SceneArrays, kept: KeptScene) -> tuple[int, int, int, bool]:
    """Renders, holds the picture against one without `kept`, and gives what was built."""
    result = render(scene, kept)
    np.testing.assert_array_equal(result.pixels, render(scene, None).pixels)
    made = result.report["build"]
    return made["built_trees"], made["kept_trees"], made["fitted_trees"], made["top_level"]


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (scene_now, (0, 3, 0, False)),
        (moved, (0, 3, 0, True)),
        (deformed, (0, 2, 1, True)),
        (torn, (1, 2, 0, True)),
        (remeshed, (1, 2, 0, True)),
        (recoloured, (0, 3, 0, False)),
        (reassigned, (0, 3, 0, True)),
        (grown, (1, 3, 0, True)),
        (seen_elsewhere, (0, 3, 0, False)),
    ],
)
def test_only_what_changed_is_built(change, expected):
    kept = KeptScene()
    assert built(scene_now(), kept) == (3, 0, 0, True)
    assert built(change(), kept) == expected
    assert built(scene_now(), kept)[0] <= 1  # and back again


def test_an_animation_of_moving_copies_builds_the_top_level_alone():
    kept = KeptScene()
    built(scene_now(), kept)
    for frame in range(1, 5):
        scene = scene_now()
        for one in scene.instances:
            one.transforms[:, 2, 3] += 0.05 * frame
        assert built(scene, kept) == (0, 3, 0, True)


def test_the_very_same_arrays_are_not_compared(monkeypatch):
    kept, scene = KeptScene(), scene_now()
    built(scene, kept)
    monkeypatch.setattr("trg_blender.engine.kept_scene.same_mesh", lambda *_: pytest.fail("compared"))
    assert built(replace(scene, camera=look_at((0, -6, 2), (0, 0, 0))), kept) == (0, 3, 0, False)


def test_a_sky_and_pictures_come_and_go():
    kept = KeptScene()
    textured = scene_now()
    textured.images, textured.textures = [checker()], [Texture(0)]
    textured.materials[0].base_texture = 0
    for scene in (scene_now(), under_a_sky(), under_a_sky(), scene_now(), textured, textured, scene_now()):
        built(scene, kept)


def test_motion_while_the_shutter_is_open_comes_and_goes():
    kept = KeptScene()
    built(scene_now(), kept)
    blurred = scene_now()
    keys = np.stack([places((1, 0, 0), (-1, 0, 0)), places((1, 0, 0.5), (-1, 0, 0))], axis=1)
    blurred.instances[2].motion = keys
    assert built(blurred, kept)[:2] == (0, 3)
    assert built(scene_now(), kept)[:2] == (0, 3)


def test_other_accelerators_and_passes_may_be_asked_for():
    kept = KeptScene()
    for accel in ("bvh", "grid", "bvh", "tree"):
        for passes in ((), ("depth", "normal")):
            settings = replace(SETTINGS, accel=accel, passes=passes)
            ours, fresh = render(scene_now(), kept, settings), render(scene_now(), None, settings)
            np.testing.assert_array_equal(ours.pixels, fresh.pixels)
            assert ours.passes.keys() == set(passes)


def test_a_scene_in_use_is_left_alone():
    kept = KeptScene()
    job = session.start(scene_now(), replace(SETTINGS, samples=100_000), kept)
    other = render(moved(), kept)
    np.testing.assert_array_equal(other.pixels, render(moved(), None).pixels)
    job.cancel()
    job.result()


def test_a_refused_scene_does_no_harm():
    kept = KeptScene()
    built(scene_now(), kept)
    bad = scene_now()
    bad.instances[1].transforms[:] = 0.0
    with pytest.raises(SceneError):
        render(bad, kept)
    built(moved(), kept)


def test_meshes_that_cannot_be_taken_are_refused():
    native = load_native()
    source, other = native.Scene(), native.Scene()
    mesh = quad()
    source.add_mesh(mesh.vertices, mesh.triangles)
    for arguments, refusal in (
        ((source, 1), "mesh: index 1 of 1"),
        ((source, -1), "mesh: index -1"),
        ((other, 0), "another scene"),
        ((None, 0), "another scene"),
    ):
        with pytest.raises(ValueError, match=refusal):
            other.take_mesh(*arguments)
    assert other.take_mesh(source, 0) == 0
    assert other.take_mesh(source, 0) == 1  # what is left there is empty
    other.add_instances(0, IDENTITY)
    source.add_instances(0, IDENTITY)
    assert (other.build()["triangles"], source.build()["triangles"]) == (2, 0)
