"""What stands behind one pixel of a finished picture: its numbers, and the surface at its middle."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .native import load_native
from .native_scene import add_instances, add_mesh
from .reference_camera import build_camera_rays
from .scene_arrays import (
    LUMINANCE,
    MATERIAL_FIELDS,
    Float32,
    Float64,
    InstanceArrays,
    Material,
    MeshArrays,
    RenderSettings,
    SceneArrays,
    pack_table,
)


@dataclass(frozen=True, slots=True)
class Surface:
    """The nearest surface along the ray through a pixel's middle."""

    mesh: str
    """name of the mesh in Blender"""
    instance: str
    """name of what placed it"""
    copy: int
    """which of the copies of that placement"""
    triangle: int
    """row of the mesh's triangles; 0 for a true sphere or plane"""
    slot: int
    """material slot"""
    distance: float
    """metres from the camera's clipping start"""
    position: tuple[float, float, float]
    uv: tuple[float, float] | None
    """None where the mesh has no texture coordinates"""


@dataclass(frozen=True, slots=True)
class PixelFacts:
    """All that is known of a pixel; x to the right, y up, both from 0."""

    x: int
    y: int
    linear: tuple[float, float, float, float]
    standard_error: float | None
    """of the luminance; None: not measured"""
    samples: float | None
    surface: Surface | None
    """None: the ray meets nothing"""
    texels: tuple[tuple[str, int, int], ...] = ()
    """(image, x, y) of the image textures of the surface's material, nearest texel, bottom row 0"""


@dataclass(slots=True)
class Shot:
    """A finished picture with what it was made of. Costs as much memory as the scene's arrays."""

    arrays: SceneArrays
    settings: RenderSettings
    pixels: Float32
    """(h, w, 4) linear"""
    standard_error: Float32 | None
    """(h, w)"""
    samples: float
    _scene: Any = field(default=None, repr=False)

    def facts_of(self, x: int, y: int) -> PixelFacts | None:
        """The facts of a pixel of the part that was rendered; None outside of it."""
        left, bottom = self.settings.border[:2] if self.settings.border else (0, 0)
        row, column = y - bottom, x - left
        height, width = self.pixels.shape[:2]
        if not (0 <= row < height and 0 <= column < width):
            return None
        error = None if self.standard_error is None else float(self.standard_error[row, column])
        surface = self.surface_at(x + 0.5, y + 0.5)
        red, green, blue, alpha = (float(value) for value in self.pixels[row, column])
        texels = () if surface is None else self._texels(surface)
        return PixelFacts(x, y, (red, green, blue, alpha), error, self.samples, surface, texels)

    def surface_at(self, x: float, y: float) -> Surface | None:
        """The surface through a place of the picture, in pixels from the bottom left.

        The lens is taken as a point and the shutter as its middle. Raises NativeMissing.
        """
        if self._scene is None:
            self._scene = _build(self.arrays)
        picture = (self.settings.width, self.settings.height)
        rays = build_camera_rays(self.arrays.camera, picture, np.array([x]), np.array([y])).rays
        hit = {name: np.empty(1, np.float32) for name in ("t", "u", "v")}
        ids = {name: np.empty(1, np.int32) for name in ("triangle", "instance")}
        self._scene.intersect(
            rays.origin.astype(np.float32),
            rays.direction.astype(np.float32),
            np.zeros(1, np.float32),
            rays.far.astype(np.float32),
            *hit.values(),
            *ids.values(),
            1,
        )
        if ids["instance"][0] < 0:
            return None
        place, copy = _placement(self.arrays.instances, int(ids["instance"][0]))
        mesh = self.arrays.meshes[place.mesh]
        triangle = int(ids["triangle"][0])
        weights = (float(hit["u"][0]), float(hit["v"][0]))
        position = rays.origin[0] + float(hit["t"][0]) * rays.direction[0]
        return Surface(
            mesh.origin,
            place.origin,
            copy,
            triangle,
            0 if mesh.slots is None or mesh.shape != "triangles" else int(mesh.slots[triangle]),
            float(hit["t"][0]),
            (float(position[0]), float(position[1]), float(position[2])),
            _uv(mesh, triangle, weights),
        )

    def _texels(self, surface: Surface) -> tuple[tuple[str, int, int], ...]:
        """Nearest texels of the plain image textures that the material looks up by the first UV map."""
        if surface.uv is None:
            return ()
        place = next((p for p in self.arrays.instances if p.origin == surface.instance), None)
        if place is None or surface.slot >= len(place.slot_materials):
            return ()
        material = self.arrays.materials[int(place.slot_materials[surface.slot])]
        rows = {
            getattr(material, name)
            for name in ("base_texture", "roughness_texture", "metallic_texture", "emission_texture")
        }
        found = []
        for row in sorted(rows - {-1}):
            texture = self.arrays.textures[row]
            if texture.image < 0 or texture.uv_map != 0:
                continue
            image = self.arrays.images[texture.image]
            u, v = surface.uv
            height, width = image.pixels.shape[:2]
            s = texture.scale_u * u + texture.skew_u * v + texture.offset_u
            t = texture.skew_v * u + texture.scale_v * v + texture.offset_v
            found.append((image.origin, int(np.floor(s * width)) % width, int(np.floor(t * height)) % height))
        return tuple(dict.fromkeys(found))


def standard_error_of(sums: Float64, counts: NDArray[np.int64]) -> Float32 | None:
    """(h, w) standard error of each pixel's luminance from replicate sums (8, h, w, 3) and samples a pixel
    (8,); None with fewer than two replicates.
    """
    used = counts > 0
    if used.sum() < 2:
        return None
    means = (sums[used] @ LUMINANCE) / counts[used, None, None]
    return np.asarray(means.std(axis=0, ddof=1) / np.sqrt(used.sum()), dtype=np.float32)


def rmse(a: Float32, b: Float32) -> float:
    """Root of the mean squared difference of two pictures' linear colours (h, w, >= 3)."""
    difference = a[..., :3].astype(np.float64) - b[..., :3]
    return float(np.sqrt(np.mean(difference**2)))


def display_values(linear: Float32, exposure: float = 0.0, gamma: float = 1.0) -> Float64:
    """sRGB-encoded values 0..1 of linear colours (..., 3), as Blender's view "Standard" shows them."""
    scaled = np.clip(linear.astype(np.float64) * 2.0**exposure, 0.0, 1.0)
    encoded = np.where(scaled <= 0.0031308, 12.92 * scaled, 1.055 * scaled ** (1 / 2.4) - 0.055)
    return np.asarray(encoded ** (1.0 / gamma))


def _build(arrays: SceneArrays) -> Any:
    """Geometry alone."""
    scene = load_native().Scene(accel="auto", triangle_test="watertight")
    for mesh in arrays.meshes:
        add_mesh(scene, mesh)
    add_instances(scene, arrays)
    scene.set_materials(pack_table([Material()] * len(arrays.materials), MATERIAL_FIELDS))
    scene.build(0, 1000, False)
    return scene


def _placement(instances: list[InstanceArrays], number: int) -> tuple[InstanceArrays, int]:
    """What the native scene's instance `number` stands for, and which copy of it."""
    for place in instances:
        if number < len(place.transforms):
            return place, number
        number -= len(place.transforms)
    raise IndexError(f"instance {number} beyond the last")


def _uv(mesh: MeshArrays, triangle: int, weights: tuple[float, float]) -> tuple[float, float] | None:
    """Texture coordinates at barycentric weights of the second and third corner."""
    u, v = weights
    if mesh.shape != "triangles":
        return (u, v)
    if mesh.uvs is None:
        return None
    first, second, third = mesh.uvs[triangle].astype(np.float64)
    at = (1.0 - u - v) * first + u * second + v * third
    return (float(at[0]), float(at[1]))
