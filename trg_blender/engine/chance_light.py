"""Light that only chance meets: what a picture may have missed without a trace in its replicates.

A path that leaves a surface by a sharp reflection or refraction cannot be aimed at a lamp. Whether it meets
one is chance, and one hit may be worth as much as the lamp's whole radiance. A picture that has met none
shows no noise of them (docs/decisions/reliable.md).
"""

from __future__ import annotations

import math

import numpy as np

from .scene_arrays import CHANNELS, LIGHT_KINDS, Color, Float32, Light, Material, RenderSettings, SceneArrays

SHARP_ROUGHNESS = 0.2
"""Below, a lobe is so narrow that sampling the lamp helps little."""


def brightest_chance_light(scene: SceneArrays, settings: RenderSettings) -> float:
    """Root of the mean square over channels of the largest radiance that only chance meets; 0: there is none.

    Times the root of the largest `sharp_share`, as the squares of what is met so add up. Of the integrator
    `path`; the constant world counts nowhere, it is met everywhere. An emission picture counts as white.
    """
    if settings.integrator != "path" or settings.max_bounces < 1:
        return 0.0
    share = max((sharp_share(material, scene) for material in scene.materials), default=0.0)
    if share <= 0.0:
        return 0.0
    found = [root_mean_square(radiance_of(light)) for light in scene.lights]
    found += [root_mean_square((m.emission_r, m.emission_g, m.emission_b)) for m in scene.materials]
    if scene.environment is not None:
        found.append(float(np.max(scene.environment.pixels, initial=0.0)))
    return math.sqrt(share) * max(found, default=0.0)


def sharp_share(material: Material, scene: SceneArrays) -> float:
    """How much of the light that meets this row it scatters within a narrow cone, about: 0 to 1.

    Of a roughness picture those texels count that are sharp, what a program gives counts as sharp; a
    mixture's rows speak for themselves.
    """
    if material.mix_count:
        return 0.0
    share = 0.0
    if material.coat_roughness < SHARP_ROUGHNESS:
        share = min(material.coat, 1.0) * normal_reflectance(material.coat_ior)
    smooth = 1.0 if material.roughness < SHARP_ROUGHNESS else 0.0
    if material.roughness_texture >= 0:
        values = texel_values(scene, material.roughness_texture)
        smooth = 1.0 if values is None else float((values < SHARP_ROUGHNESS).mean())
    metallic = material.metallic
    if material.metallic_texture >= 0:
        values = texel_values(scene, material.metallic_texture)
        metallic = 1.0 if values is None else float(values.mean())
    own = min(material.specular, 1.0) * normal_reflectance(material.ior)
    return min(max(share, smooth * max(own, metallic, material.transmission)), 1.0)


def texel_values(scene: SceneArrays, index: int) -> Float32 | None:
    """Red (or alpha) of all texels that a texture looks up, linear; None: a program gives it."""
    texture = scene.textures[index]
    if texture.image < 0:
        return None
    image = scene.images[texture.image]
    alpha = CHANNELS[texture.channel] == "alpha"
    values = np.asarray(image.pixels[..., -1 if alpha else 0])
    values = values / np.float32(255.0) if values.dtype == np.uint8 else values.astype(np.float32)
    return values**2.2 if image.srgb and not alpha else values


def normal_reflectance(ior: float) -> float:
    return ((ior - 1.0) / (ior + 1.0)) ** 2


def radiance_of(light: Light) -> Color:
    """The largest radiance of a light that bounce rays meet; 0 of one without extent."""
    color = (light.color_r, light.color_g, light.color_b)
    kind = LIGHT_KINDS[light.kind]
    if kind == "sun":
        extent = math.pi * math.sin(min(light.angle, 0.5 * math.pi)) ** 2
    elif kind in ("point", "spot"):
        physical = (light.falloff_constant, light.falloff_linear, light.falloff_quadratic) == (0.0, 0.0, 1.0)
        extent = math.pi * light.radius**2 if physical else 0.0
    else:
        half = 0.5 * light.spread
        tangent = math.tan(half) if half < 0.5 * math.pi - 1e-6 else math.inf
        extent = (tangent - half) / tangent if 0.0 < tangent < math.inf else 1.0
    scale = 1.0 / extent if extent > 0.0 else 0.0
    return (color[0] * scale, color[1] * scale, color[2] * scale)


def root_mean_square(color: Color) -> float:
    return math.sqrt(sum(channel * channel for channel in color) / 3.0)


def error_in_hits(scene: SceneArrays, settings: RenderSettings, rmse: float, samples: float) -> float | None:
    """How many hits of the brightest chance light make the squared error of a picture; None: no such light.

    A hit of radiance L in one of `samples` adds (L / samples)^2 to the squared error of its pixel.
    `settings` are those of the picture or, with a border, of its part.
    """
    radiance = brightest_chance_light(scene, settings)
    if radiance <= 0.0:
        return None
    border = settings.border
    pixels = settings.width * settings.height
    if border is not None:
        pixels = (border[2] - border[0]) * (border[3] - border[1])
    return pixels * (rmse * samples / radiance) ** 2
