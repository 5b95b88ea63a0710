"""What stands behind a pixel of a finished picture."""

from __future__ import annotations

import numpy as np
import pytest

from trg_blender.engine import session
from trg_blender.engine.probe import Shot, display_values, rmse, standard_error_of
from trg_blender.engine.scene_arrays import (
    Camera,
    ImageArrays,
    Material,
    MeshArrays,
    RenderSettings,
    SceneArrays,
    Texture,
)

from .arrays import place, quad


def scene_of_two() -> SceneArrays:
    """A textured square below, a true sphere of radius 1 above its left half; seen from above."""
    matrix = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 10]], np.float64)
    pixels = np.arange(4 * 8 * 3, dtype=np.uint8).reshape(4, 8, 3)
    ball = MeshArrays(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32), shape="sphere", origin="Ball")
    return SceneArrays(
        camera=Camera(1, matrix, (-2.0, 2.0, -1.0, 1.0)),
        meshes=[quad(2.0), ball],
        instances=[place(0, 0), place(1, 1, at=(-1.0, 0.0, 3.0))],
        materials=[Material(base_texture=0), Material()],
        images=[ImageArrays(pixels, origin="squares")],
        textures=[Texture(image=0)],
        world=(1.0, 1.0, 1.0),
    )


def shot_of(border: tuple[int, int, int, int] | None = None) -> Shot:
    settings = RenderSettings(40, 20, samples=16, border=border)
    scene = scene_of_two()
    result = session.render(scene, settings)
    error = standard_error_of(result.replicate_sums, result.replicate_counts)
    return Shot(scene, settings, result.pixels, error, 16.0)


@pytest.fixture(scope="module")
def shot() -> Shot:
    return shot_of()


def test_a_pixel_knows_its_surface(shot: Shot):
    facts = shot.facts_of(30, 10)
    surface = facts.surface
    assert (surface.mesh, surface.triangle, surface.slot) == ("Quad", 0, 0)
    assert surface.position == pytest.approx((1.05, 0.05, 0.0), abs=1e-5)
    assert surface.uv == pytest.approx((3.05 / 4.0, 2.05 / 4.0), abs=1e-5)
    assert facts.texels == (("squares", 6, 2),)
    assert facts.linear == tuple(float(v) for v in shot.pixels[10, 30])
    assert facts.samples == 16.0


def test_a_true_sphere_is_met_exactly(shot: Shot):
    surface = shot.surface_at(10.0, 10.0)
    assert surface.mesh == "Ball"
    assert surface.position == pytest.approx((-1.0, 0.0, 4.0), abs=1e-5)
    assert surface.distance == pytest.approx(6.0, abs=1e-4)


def test_a_part_of_the_picture_counts_its_pixels_from_the_whole():
    part = shot_of(border=(20, 5, 40, 15))
    assert part.facts_of(30, 10).surface.position == pytest.approx((1.05, 0.05, 0.0), abs=1e-5)
    assert part.facts_of(19, 10) is None and part.facts_of(30, 4) is None
    assert part.facts_of(40, 10) is None and part.facts_of(-1, 10) is None


def test_the_standard_error_is_that_of_eight_replicates():
    rng = np.random.default_rng(3)
    counts = np.full(8, 4)
    sums = rng.normal(2.0, 0.5, (8, 50, 40, 3)) * 4
    error = standard_error_of(sums, counts)
    # Of luminance: 0.5 * norm of the weights / sqrt(8).
    expected = 0.5 * np.linalg.norm([0.2126, 0.7152, 0.0722]) / np.sqrt(8)
    assert error.shape == (50, 40)
    assert np.sqrt(np.mean(error.astype(float) ** 2)) == pytest.approx(expected, rel=0.02)
    assert standard_error_of(sums, np.array([4, 0, 0, 0, 0, 0, 0, 0])) is None


def test_display_values_are_those_of_srgb():
    assert display_values(np.array([0.0, 0.18, 1.0, 7.0])) == pytest.approx([0.0, 0.4613, 1.0, 1.0], abs=1e-4)
    assert display_values(np.array([0.25]), exposure=2.0)[0] == pytest.approx(1.0)


def test_rmse_leaves_alpha_out():
    a, b = np.zeros((2, 2, 4), np.float32), np.zeros((2, 2, 4), np.float32)
    b[..., 3], b[0, 0, 0] = 5.0, 2.0
    assert rmse(a, b) == pytest.approx(np.sqrt(4.0 / 12.0))
