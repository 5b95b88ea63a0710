"""What a path finds where it lands: position, normals turned to the viewer, and the material there."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .errors import SceneError
from .reference_energy import EnergyTables
from .reference_math import dot, normalize
from .reference_ggx import IDEAL_ALPHA as IDEAL_ALPHA
from .reference_scene import Hits, Triangles
from .reference_shapes import shape_points
from .reference_textures import Picture, look_up, prepare_image
from .scene_arrays import MATERIAL_FIELDS, Float64, SceneArrays, pack_table

GRAZING = 1e-4
"""A shading normal that the viewer sees at a smaller cosine gives way to the geometric one."""


@dataclass(frozen=True, slots=True)
class MaterialTable:
    """The material rows as columns, and the images they look into."""

    columns: dict[str, Float64]
    scene: SceneArrays
    images: list[Picture]
    energy: EnergyTables = field(default_factory=EnergyTables)


@dataclass(frozen=True, slots=True)
class Material:
    """Material values at n points, textures applied."""

    base: Float64
    """(n, 3)"""
    metallic: Float64
    alpha: Float64
    """GGX width"""
    ior: Float64
    specular: Float64
    transmission: Float64
    emission: Float64
    """(n, 3) radiance"""
    column: dict[str, Float64]
    """(n,) the other columns of scene_arrays.Material"""
    energy: EnergyTables

    def color(self, name: str) -> Float64:
        """(n, 3) of the columns `name`_r, `name`_g, `name`_b"""
        return np.stack([self.column[f"{name}_{channel}"] for channel in "rgb"], axis=1)


@dataclass(frozen=True, slots=True)
class Surface:
    """n points on surfaces, each seen from `wo`."""

    position: Float64
    wo: Float64
    """unit, towards the viewer"""
    ng: Float64
    """geometric normal, on the side of wo"""
    ns: Float64
    """shading normal, on the side of wo"""
    outside: NDArray[np.bool_]
    """whether wo is on the side that the artist sees as outside"""
    material: Material
    epsilon: Float64
    """(n,) distance by which rays start off the surface"""

    def leave(self, wi: Float64) -> Float64:
        """Where a ray along `wi` starts: just off the surface, on the side it goes to."""
        side = np.where(dot(wi, self.ng) < 0.0, -self.epsilon, self.epsilon)
        return self.position + side[:, None] * self.ng


def build_material_table(scene: SceneArrays) -> MaterialTable:
    """Raises SceneError for texture programs and further UV maps, which this renderer has not."""
    if any(texture.program >= 0 or texture.uv_map > 0 for texture in scene.textures):
        raise SceneError(
            "the reference renderer (device embree) shows plain images at the mesh's own UV map alone: "
            "render node textures on the device cpu"
        )
    rows = pack_table(scene.materials, MATERIAL_FIELDS).astype(np.float64)
    columns = {name: rows[:, column] for column, name in enumerate(MATERIAL_FIELDS)}
    return MaterialTable(columns, scene, [prepare_image(image) for image in scene.images])


def evaluate_material(table: MaterialTable, index: NDArray[np.int64], uv: Float64) -> Material:
    """Rows `index` (n,) of the table at the texture places `uv` (n, 2)."""
    column = {name: values[index] for name, values in table.columns.items()}
    base = np.stack([column["base_r"], column["base_g"], column["base_b"]], axis=1)
    emission = np.stack([column["emission_r"], column["emission_g"], column["emission_b"]], axis=1)
    # A float image may hold anything; what a surface reflects lies between nothing and all.
    base = np.clip(textured(table, column["base_texture"], uv, base), 0.0, 1.0)
    emission = emission * textured(table, column["emission_texture"], uv, np.ones_like(emission))
    roughness = textured_number(table, "roughness", column, uv)
    metallic = textured_number(table, "metallic", column, uv)
    column["present"] = textured_number(table, "alpha", column, uv)
    return Material(
        base,
        metallic,
        roughness * roughness,
        column["ior"],
        column["specular"],
        column["transmission"],
        emission,
        column,
        table.energy,
    )


def textured_number(table: MaterialTable, name: str, column: dict[str, Float64], uv: Float64) -> Float64:
    """A share between 0 and 1; a texture's red channel replaces it."""
    plain = np.repeat(column[name][:, None], 3, axis=1)
    return np.clip(textured(table, column[f"{name}_texture"], uv, plain)[:, 0], 0.0, 1.0)


def textured(table: MaterialTable, textures: Float64, uv: Float64, plain: Float64) -> Float64:
    """`plain` (n, 3), replaced by the texture's value in the rows where `textures` names one."""
    value = plain.copy()
    for number in np.unique(textures[textures >= 0]).astype(int):
        rows = textures == number
        texture = table.scene.textures[number]
        value[rows] = look_up(table.images[texture.image], texture, uv[rows])
    return value


def interpolate(corners: Float64, u: Float64, v: Float64) -> Float64:
    """Values of three corners (n, 3, k) at barycentric (u, v)."""
    return (1.0 - u - v)[:, None] * corners[:, 0] + u[:, None] * corners[:, 1] + v[:, None] * corners[:, 2]


def build_surface(triangles: Triangles, table: MaterialTable, hits: Hits, wo: Float64) -> Surface:
    """The surface at `hits`, which must all have hit."""
    index = hits.triangle
    position = interpolate(triangles.corners[index], hits.u, hits.v)
    outside_normal = triangles.outside[index]
    smooth_normal = interpolate(triangles.normals[index], hits.u, hits.v)
    uv = interpolate(triangles.uvs[index], hits.u, hits.v)
    for row in np.unique(index[index >= triangles.first_shape]):
        rows = index == row
        shape = triangles.shapes[row - triangles.first_shape]
        points = shape_points(shape, hits.u[rows], hits.v[rows])
        position[rows] = points.position
        outside_normal[rows] = smooth_normal[rows] = points.outside
        uv[rows] = np.stack([hits.u[rows], hits.v[rows]], axis=1)
    outside = dot(wo, outside_normal) >= 0.0
    turn = np.where(outside, 1.0, -1.0)[:, None]
    ng = outside_normal * turn
    ns = normalize(smooth_normal) * turn
    ns = np.where((dot(wo, ns) > GRAZING)[:, None], ns, ng)
    material = evaluate_material(table, triangles.material[index], uv)
    # Embree works in float32: its error grows with the coordinates and with the size of the triangle.
    corners = triangles.corners[index]
    edge = np.max(np.abs(corners[:, 1:] - corners[:, :1]), axis=(1, 2))
    epsilon = 1e-7 + 2e-6 * np.max(np.abs(position), axis=1) + 4e-7 * edge
    return Surface(position, wo, ng, ns, outside, material, epsilon)
