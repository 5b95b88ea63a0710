"""Materials of the native renderer against closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from trg_blender.engine.reference_textures import srgb_to_linear
from trg_blender.engine.scene_arrays import (
    MATERIAL_FIELDS,
    TEXTURE_FIELDS,
    Light,
    Material,
    Texture,
    pack_table,
)

from .render_scenes import (
    GLOW,
    SUN,
    WHITE,
    Camera,
    Settings,
    add_object,
    make_floor,
    make_sphere,
    new_scene,
    picture,
    place,
    trg_native,
)

WITHIN = Camera(half_width=0.9)


def furnace(material: Material, bounces: int = 64, samples: int = 64) -> float:
    """Mean of a flat-shaded sphere in a world of radiance 1, seen face on."""
    scene = new_scene([material], world=1.0)
    add_object(scene, make_sphere())
    pixels = picture(scene, Settings(samples=samples, bounces=bounces), Camera(half_width=0.6))
    return float(pixels[..., :3].mean())


def test_white_diffuse_loses_no_light() -> None:
    assert furnace(WHITE) == pytest.approx(1.0, abs=1e-6)


def test_smooth_metal_loses_no_light() -> None:
    assert furnace(Material(1.0, 1.0, 1.0, metallic=1.0, roughness=0.0)) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("ior", [1.0, 1.0 + 1e-4, 1.5, 2.4, 0.7])
def test_smooth_glass_loses_no_light(ior: float) -> None:
    glass = Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.0, ior=ior)
    assert furnace(glass, bounces=256) == pytest.approx(1.0, abs=2e-3)


def test_white_plastic_never_gains_light() -> None:
    for roughness in (0.0, 0.2, 0.6, 1.0):
        assert 0.94 < furnace(Material(1.0, 1.0, 1.0, roughness=roughness), samples=256) < 1.002


def test_smooth_white_plastic_loses_only_what_the_coupling_says() -> None:
    # Albedo seen face on: F + (1 - F)(1 - mean F) / (1 - mean F) = 1 in the world of radiance 1.
    assert furnace(Material(1.0, 1.0, 1.0, roughness=0.0), samples=512) == pytest.approx(1.0, abs=2e-3)


def ggx_albedo(alpha: float, cosine: float) -> float:
    """Directional albedo of the single-scattering GGX conductor by quadrature over facets."""
    u, v = (np.arange(1000) + 0.5) / 1000, (np.arange(500) + 0.5) / 500
    u, v = np.meshgrid(u, v, indexing="ij")
    z = np.sqrt((1 - u) / (1 + (alpha**2 - 1) * u))
    r, phi = np.sqrt(1 - z * z), 2 * np.pi * v
    h = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1)
    wo = np.array([np.sqrt(1 - cosine**2), 0.0, cosine])
    c = h @ wo
    wi_z = 2 * c * z - wo[2]
    seen = (c > 0) & (wi_z > 0)
    wi_z = np.where(seen, wi_z, 1.0)

    def slope(w):
        return np.sqrt(w * w + alpha**2 * (1 - w * w)) / w

    return float(np.where(seen, 2 / (slope(cosine) + slope(wi_z)) * c / (cosine * z), 0.0).mean())


@pytest.mark.parametrize("roughness", [0.2, 0.5, 1.0])
@pytest.mark.parametrize("cosine", [1.0, 0.5])
@pytest.mark.parametrize("again", [0.0, 1.0])
def test_rough_metal_has_the_albedo_of_ggx(roughness: float, cosine: float, again: float) -> None:
    """Where facets pass light on (`again`), nothing is lost."""
    metal = Material(1.0, 1.0, 1.0, metallic=1.0, roughness=roughness, multiscatter=again)
    scene = new_scene([metal], world=1.0)
    add_object(scene, make_floor(100.0))
    sine = np.sqrt(1.0 - cosine**2)
    axes = np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
    pixels = picture(scene, Settings(16, 16, samples=512), Camera(eye=(3 * sine, 0, 3 * cosine), axes=axes))
    expected = 1.0 if again else ggx_albedo(roughness**2, cosine)
    assert pixels[..., :3].mean() == pytest.approx(expected, abs=2e-3)


def test_a_mirror_shows_a_sun_disc_that_the_camera_cannot_see() -> None:
    angle = 0.2
    sun = Light(SUN, 1.0, 1.0, 1.0, angle=angle)
    scene = new_scene([Material(1.0, 1.0, 1.0, metallic=1.0, roughness=0.0)], lights=[sun])
    add_object(scene, make_floor())
    pixels = picture(scene, Settings(8, 8, samples=8))
    assert pixels[..., :3] == pytest.approx(1.0 / (np.pi * np.sin(angle) ** 2), rel=1e-4)


def test_a_mirror_shows_the_world_tinted_by_its_colour() -> None:
    scene = new_scene([Material(0.9, 0.5, 0.25, metallic=1.0, roughness=0.0)], world=2.0)
    add_object(scene, make_floor())
    pixels = picture(scene, Settings(8, 8, samples=8))
    assert pixels[4, 4, :3] == pytest.approx([1.8, 1.0, 0.5], rel=1e-5)


def test_a_pane_of_glass_transmits_by_fresnel_at_both_faces() -> None:
    glass = Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.0, ior=1.5)
    scene = new_scene([glass, GLOW])
    add_object(scene, make_floor(50.0, 0.0))
    bottom = make_floor(50.0, -0.1)
    add_object(scene, (bottom[0], bottom[1][:, ::-1].copy()))
    add_object(scene, make_floor(50.0, -1.0), 1)
    pixels = picture(scene, Settings(32, 32, samples=512, bounces=40))
    once = 0.04
    assert pixels[..., :3].mean() == pytest.approx((1 - once) / (1 + once), rel=3e-3)


def test_rough_glass_keeps_nearly_all_light() -> None:
    glass = Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.3, ior=1.5)
    assert 0.975 < furnace(glass, bounces=64, samples=256) < 1.003


def test_an_image_shows_texel_by_texel_in_linear_light() -> None:
    scene = new_scene([])
    pixels = np.array([[[0, 64, 255], [128, 128, 128]], [[255, 0, 0], [10, 200, 30]]], np.uint8)
    scene.add_image(pixels, True)
    scene.set_textures(pack_table([Texture(0, wrap=1)], TEXTURE_FIELDS))
    scene.set_materials(pack_table([replace(GLOW, emission_texture=0)], MATERIAL_FIELDS))
    vertices, triangles = make_floor()
    uvs = np.ascontiguousarray((vertices[triangles][..., :2] + 1) / 2)
    scene.add_instance(scene.add_mesh(vertices, triangles, None, uvs, None), None, np.zeros(1, np.int32))
    # 2 x 2 texels over 64 x 64 pixels: the outer quarters are beyond the outer centres and constant.
    image = picture(scene, Settings(64, 64, samples=4))
    encoded = pixels / 255.0
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    for y, x in ((0, 0), (0, 1), (1, 0), (1, 1)):
        assert image[y * 63, x * 63, :3] == pytest.approx(linear[y, x], abs=2e-6)
    assert image[31:33, 31:33, :3].mean(axis=(0, 1)) == pytest.approx(
        srgb_to_linear(encoded.mean(axis=(0, 1))), abs=5e-3
    )


def test_a_mirrored_instance_keeps_its_outside() -> None:
    glass = Material(1.0, 1.0, 1.0, transmission=1.0, roughness=0.0, ior=1.5)
    means = []
    for sign in (1.0, -1.0):
        scene = new_scene([glass], world=0.0, lights=[Light(SUN, 1.0, 1.0, 1.0, angle=0.5)])
        transform = place(0.0, 0.0, 0.0)
        transform[0, 0] = sign
        add_object(scene, make_sphere(24), transform=transform)
        means.append(picture(scene, Settings(samples=256), WITHIN)[..., :3].mean())
    assert means[0] == pytest.approx(means[1], rel=0.02)


def test_normals_that_are_no_directions_give_flat_shading() -> None:
    vertices, triangles = make_floor()
    pictures = []
    for bad in (None, 0.0, np.nan, np.inf):
        scene = new_scene([Material()], world=1.0)
        normals = None if bad is None else np.full((2, 3, 3), bad, np.float32)
        add_object(scene, (vertices, triangles), normals=normals)
        pictures.append(picture(scene, Settings(8, 8, samples=16)))
    for other in pictures[1:]:
        assert np.array_equal(other, pictures[0])


def test_geometry_that_is_not_finite_leaves_no_trace() -> None:
    clean, dirty = new_scene([WHITE], world=1.0), new_scene([WHITE], world=1.0)
    vertices, triangles = make_sphere(16)
    add_object(clean, (vertices, triangles))
    worse = np.concatenate([vertices, [[np.nan, 0, 0], [np.inf, 0, 0], [0, 0, 0]]]).astype(np.float32)
    n = len(vertices)
    extra = np.array([[n, 0, 1], [n + 1, 1, 2], [n + 2, n + 2, n + 2]], np.int32)
    add_object(dirty, (worse, np.concatenate([triangles, extra])))
    assert np.array_equal(picture(clean, Settings(samples=8)), picture(dirty, Settings(samples=8)))


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1.0, 1e3, 1e6])
@pytest.mark.parametrize("shift", [0.0, 100.0])
def test_a_convex_surface_never_hides_itself(scale: float, shift: float) -> None:
    scene = new_scene([WHITE], world=1.0)
    add_object(scene, make_sphere(), transform=place(shift * scale, 0, 0, scale))
    camera = Camera(eye=(shift * scale, 0, 3 * scale), half_width=0.9 * scale, clip=(0.0, 1e30))
    pixels = picture(scene, Settings(samples=16, bounces=0), camera)
    assert pixels[..., :3].min() > 0.99
    assert pixels[..., :3].mean() == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("kind", [{"transmission": 1.0}, {"metallic": 1.0}])
def test_colours_beyond_one_keep_chances_of_directions_positive(kind: dict[str, float]) -> None:
    rng = np.random.default_rng(1)
    wo, wi = rng.normal(size=(2, 1000, 3))
    wo[:, 2], wi[:, 2] = np.abs(wo[:, 2]), np.abs(wi[:, 2])
    wo, wi = (np.float32(w / np.linalg.norm(w, axis=1, keepdims=True)) for w in (wo, wi))
    value, pdf = np.empty((1000, 3), np.float32), np.empty(1000, np.float32)
    for base in (1.5, 1.9, 4.0, 1e4):
        material = Material(base, base, base, roughness=1.0, multiscatter=1.0, **kind)
        trg_native.bsdf_eval(pack_table([material], MATERIAL_FIELDS)[0], wo, wi, True, value, pdf)
        assert (pdf > 0).all() and (value >= 0).all() and np.isfinite(value).all()


def tilted_floor(material: Material, tilt: float, side: float) -> np.ndarray:
    """Means of a white floor in a white world, normals tilted by `tilt` degrees, seen from `side` degrees."""
    scene = new_scene([material], world=1.0)
    vertices, triangles = make_floor(50.0)
    normal = [np.sin(np.radians(tilt)), 0.0, np.cos(np.radians(tilt))]
    add_object(scene, (vertices, triangles), normals=np.full((2, 3, 3), normal, np.float32))
    turn = np.radians(side)
    axes = np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]])
    camera = Camera(tuple(3 * axes[:, 2]), axes, 0.1)
    return picture(scene, Settings(8, 8, samples=512), camera)[..., :3].mean(axis=(0, 1))


@pytest.mark.parametrize(
    ("tilt", "side"), [(50, 0), (80, 0), (60, 60), (85, 85), (40, -45), (3, -86), (89, 89)]
)
@pytest.mark.parametrize("kind", [{"metallic": 1.0}, {"transmission": 1.0, "ior": 1.5}])
def test_normals_that_mirror_the_viewer_into_the_surface_lose_no_mirror(tilt, side, kind) -> None:
    """Row B13: the ideal mirror stays above the horizon, rough facets never give back too much."""
    mirror = tilted_floor(Material(1.0, 1.0, 1.0, metallic=1.0, roughness=0.0), tilt, side)
    assert mirror == pytest.approx(1.0, abs=1e-5)
    for roughness in (0.2, 1.0):
        rough = tilted_floor(Material(1.0, 1.0, 1.0, roughness=roughness, **kind), tilt, side)
        assert 0.0 < rough.max() <= 1.005
