"""Passes of the native renderer: what they hold, how they add up, and that only those asked for are kept."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from trg_blender.engine.cryptomatte import id_of
from trg_blender.engine.passes import KERNEL_PASSES
from trg_blender.engine.scene_arrays import Light, Material

from .render_scenes import (
    GREY,
    POINT,
    Camera,
    Settings,
    add_object,
    finish,
    make_floor,
    make_sphere,
    new_scene,
    place,
    start,
    trg_native,
)

KINDS = ("diffuse", "glossy", "transmission")
LIGHTS = tuple(f"{kind}_{part}" for kind in KINDS for part in ("direct", "indirect", "color"))
SUM = (*LIGHTS, "emission", "environment")


def mixed_scene() -> Any:
    """Four balls (plastic, rough gold, rough glass, glow) over a floor under a point light and a sky."""
    materials = [
        Material(0.5, 0.6, 0.4, roughness=0.4),
        Material(0.2, 0.5, 0.8, roughness=0.2),
        Material(1.0, 0.7, 0.3, metallic=1.0, roughness=0.3),
        Material(0.9, 1.0, 0.9, transmission=1.0, roughness=0.3, ior=1.4),
        Material(0.3, 0.3, 0.3, emission_r=0.5, emission_g=0.4, emission_b=0.3),
    ]
    light = Light(POINT, 20.0, 18.0, 15.0, position_x=0.3, position_y=0.2, position_z=2.5, radius=0.2)
    scene = new_scene(materials, 0.2, [light])
    add_object(scene, make_floor(0.9), 0)
    for k, (x, y) in enumerate([(-0.4, -0.4), (0.4, -0.4), (-0.4, 0.4), (0.4, 0.4)]):
        add_object(scene, make_sphere(12), k + 1, place(x, y, 0.3, 0.3))
    return scene


def render(scene: Any, passes: tuple[str, ...], **changes: Any) -> tuple[Any, dict[str, Any]]:
    """The finished job and its pictures by pass."""
    settings = Settings(width=24, height=24, samples=32, passes=passes, **changes)
    Camera().apply(scene)
    scene.build(1)
    job = start(scene, settings)
    assert finish(job)["rejected_samples"] == 0
    combined = np.zeros((24, 24, 4), np.float32)
    job.combined(combined)
    pictures = {"combined": combined[..., :3]}
    for name in passes:
        if name in KERNEL_PASSES:
            out = np.full((24, 24, KERNEL_PASSES[name] or 12), np.nan, np.float32)
            job.read_pass(name, out)
            assert np.isfinite(out).all(), name
            pictures[name] = out
    return job, pictures


def test_both_sides_know_the_same_passes() -> None:
    assert set(trg_native.PASSES) == set(KERNEL_PASSES)


def test_light_passes_add_up_to_combined() -> None:
    _, found = render(mixed_scene(), SUM)
    total = found["emission"] + found["environment"]
    for kind in KINDS:
        light = found[f"{kind}_direct"] + found[f"{kind}_indirect"]
        assert light.max() > 0.0
        total = total + found[f"{kind}_color"] * light
    np.testing.assert_allclose(total, found["combined"], rtol=2e-5, atol=1e-6)


def test_passes_do_not_change_the_picture() -> None:
    plain, _ = render(mixed_scene(), ())[1]["combined"], None
    asked = render(mixed_scene(), (*SUM, "ambient_occlusion", "uv"))[1]["combined"]
    np.testing.assert_allclose(asked, plain, rtol=1e-4, atol=1e-5)


def test_a_job_without_passes_runs_kernels_without_them() -> None:
    scene = new_scene([GREY], 1.0)
    add_object(scene, make_floor())
    job, _ = render(scene, ("normal", "position", "sample_count"))
    assert job.poll(0.0)["kernel_set"] == "plain"
    with pytest.raises(RuntimeError, match="not asked for"):
        job.read_pass("uv", np.zeros((24, 24, 3), np.float32))


def test_diffuse_color_of_a_lambertian_floor_is_its_base_and_all_its_light_is_direct() -> None:
    scene = new_scene([GREY], 1.0)
    add_object(scene, make_floor(2.0))
    _, found = render(scene, LIGHTS)
    np.testing.assert_allclose(found["diffuse_color"], 0.5, rtol=1e-6)
    np.testing.assert_allclose(found["diffuse_direct"], 1.0, rtol=1e-5)
    for name in LIGHTS:
        if name not in ("diffuse_color", "diffuse_direct"):
            assert not found[name].any(), name


def test_an_open_floor_is_not_occluded_and_a_closed_one_is() -> None:
    scene = new_scene([GREY], 1.0)
    add_object(scene, make_floor(2.0))
    _, found = render(scene, ("ambient_occlusion",))
    assert (found["ambient_occlusion"] == 1.0).all()
    scene = new_scene([GREY], 1.0)
    add_object(scene, make_floor(2.0))
    add_object(scene, make_sphere(16), 0, place(0.0, 0.0, 0.0, 9.0))
    scene.set_pass_data(np.zeros((2, 3), np.float32), np.zeros((1, 2), np.float32), 6, (0.0, 1.0, 1.0), 1e30)
    _, found = render(scene, ("ambient_occlusion",))
    assert not found["ambient_occlusion"].any()


def test_data_passes_say_who_and_where() -> None:
    scene = new_scene([GREY, GREY], 0.0)
    add_object(scene, make_floor(2.0))
    add_object(scene, make_sphere(24), 1, place(0.0, 0.0, 0.0, 0.5))
    ids = np.array([[7, id_of("Floor"), id_of("Set")], [9, id_of("Ball"), id_of("Set")]], np.float32)
    materials = np.array([[1, id_of("grey")], [2, id_of("paint")]], np.float32)
    scene.set_pass_data(ids, materials, 6, (2.0, 2.0, 2.0), 1.0)
    names = (
        "position", "object_index", "material_index", "mist",
        "cryptomatte_object", "cryptomatte_material", "cryptomatte_asset", "sample_count",
    )  # fmt: skip
    _, found = render(scene, names)
    assert found["object_index"][0, 0] == 7.0 and found["object_index"][12, 12] == 9.0
    assert found["material_index"][0, 0] == 1.0 and found["material_index"][12, 12] == 2.0
    np.testing.assert_allclose(found["position"][0, 0], (-23 / 24, -23 / 24, 0.0), atol=1e-6)
    np.testing.assert_allclose(found["mist"][0, 0], 0.25, rtol=1e-5)
    assert (found["sample_count"] == 32.0).all()
    asset = found["cryptomatte_asset"]
    assert (asset[..., 0] == np.float32(id_of("Set"))).all() and (asset[..., 1] == 1.0).all()
    matte = found["cryptomatte_object"]
    np.testing.assert_allclose(matte[..., 1::2].sum(axis=-1), 1.0, rtol=1e-6)
    assert (np.diff(matte[..., 1::2], axis=-1) <= 0.0).all()
    edge = (matte[..., 3] > 0.0).sum()
    assert edge > 10 and set(np.unique(matte[..., 0])) == set(np.float32([id_of("Floor"), id_of("Ball")]))


def test_denoising_features_look_through_mirrors() -> None:
    mirror = Material(0.5, 0.6, 0.7, metallic=1.0, roughness=0.0)
    scene = new_scene([mirror, Material(0.2, 0.4, 0.8, specular=0.0)], 0.0)
    add_object(scene, make_floor(4.0))
    add_object(scene, make_floor(50.0, 9.0), 1)
    _, found = render(scene, ("denoising_albedo", "denoising_normal"))
    np.testing.assert_allclose(found["denoising_albedo"][0, 0], (0.1, 0.24, 0.56), rtol=1e-4)


def test_unequal_tables_are_refused() -> None:
    scene = new_scene([GREY], 0.0)
    add_object(scene, make_floor())
    with pytest.raises(ValueError, match="instance_ids"):
        scene.set_pass_data(
            np.zeros((2, 3), np.float32), np.zeros((1, 2), np.float32), 6, (0.0, 1.0, 1.0), 1.0
        )
    with pytest.raises(ValueError, match="there is no nonsense"):
        render(scene, ("nonsense",))
