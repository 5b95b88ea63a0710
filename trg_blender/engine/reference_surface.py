"""What a path finds where it lands: position, normals turned to the viewer, and the material there."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from .reference_energy import EnergyTables
from .reference_ggx import IDEAL_ALPHA as IDEAL_ALPHA
from .reference_math import dot, normalize
from .reference_point_ops import PointMachine
from .reference_points import Points, PointSpace, build_copies
from .reference_programs import Programs
from .reference_scene import Hits, Triangles
from .reference_shapes import shape_points
from .reference_textures import Picture, look_up, prepare_image
from .scene_arrays import MATERIAL_FIELDS, Float64, SceneArrays, pack_table

GRAZING = 1e-4
"""A shading normal that the viewer sees at a smaller cosine gives way to the geometric one."""


HORIZON = 0.01
"""Cosine to the geometric normal that a mirrored direction keeps, where the viewer has twice it."""


@dataclass(frozen=True, slots=True)
class MaterialTable:
    """The material rows as columns, and the images and programs they ask."""

    columns: dict[str, Float64]
    space: PointSpace
    images: list[Picture]
    programs: Programs
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
    row: NDArray[np.int64]
    """(n,) row of the material table, where it is a mixture that of the whole"""
    points: Points
    ratio: Float64 | None = None
    """(n,) index behind over index before, where media with priorities meet; 0: by the material alone"""
    behind: NDArray[np.int64] | None = None
    """(n, MOST_MEDIA) media behind the surface where `ratio` is not 0"""

    def leave(self, wi: Float64) -> Float64:
        """Where a ray along `wi` starts: just off the surface, on the side it goes to."""
        side = np.where(dot(wi, self.ng) < 0.0, -self.epsilon, self.epsilon)
        return self.position + side[:, None] * self.ng


def build_material_table(scene: SceneArrays, triangles: Triangles, width: int) -> MaterialTable:
    """For a picture `width` pixels wide."""
    rows = pack_table(scene.materials, MATERIAL_FIELDS).astype(np.float64)
    columns = {name: rows[:, column] for column, name in enumerate(MATERIAL_FIELDS)}
    left, right = scene.camera.window[:2]
    space = PointSpace(scene, triangles, build_copies(scene), abs(right - left) / width)
    images = [prepare_image(image) for image in scene.images]
    return MaterialTable(columns, space, images, Programs(scene.programs))


def evaluate_material(
    table: MaterialTable, points: Points, index: NDArray[np.int64] | None = None
) -> Material:
    """The material at each point; that of rows `index` (n,) where they are given."""
    if index is None:
        index = table.space.triangles.material[points.triangle]
    column = {name: values[index] for name, values in table.columns.items()}
    base = np.stack([column["base_r"], column["base_g"], column["base_b"]], axis=1)
    emission = np.stack([column["emission_r"], column["emission_g"], column["emission_b"]], axis=1)
    # A float image may hold anything; what a surface reflects lies between nothing and all.
    base = np.clip(textured(table, column["base_texture"], points, base), 0.0, 1.0)
    emission = emission * textured(table, column["emission_texture"], points, np.ones_like(emission))
    roughness = textured_number(table, "roughness", column, points)
    metallic = textured_number(table, "metallic", column, points)
    column["present"] = textured_number(table, "alpha", column, points)
    for name in ("transmission", "coat", "sheen_roughness", "diffuse_roughness"):
        if np.any(column[f"{name}_texture"] >= 0):
            column[name] = textured_number(table, name, column, points)
    if np.any(column["sheen_texture"] >= 0):
        plain = np.ones((len(points.b1), 3))
        sheen = np.clip(textured(table, column["sheen_texture"], points, plain)[:, 0], 0.0, 1.0)
        for channel in "rgb":
            column[f"sheen_{channel}"] = column[f"sheen_{channel}"] * sheen
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


def textured_number(table: MaterialTable, name: str, column: dict[str, Float64], points: Points) -> Float64:
    """A share between 0 and 1; a texture's red channel replaces it."""
    plain = np.repeat(column[name][:, None], 3, axis=1)
    return np.clip(textured(table, column[f"{name}_texture"], points, plain)[:, 0], 0.0, 1.0)


def textured(table: MaterialTable, textures: Float64, points: Points, plain: Float64) -> Float64:
    """`plain` (n, 3), replaced by the texture's value in the rows where `textures` names one."""
    value = plain.copy()
    for number in np.unique(textures[textures >= 0]).astype(int):
        rows = textures == number
        value[rows] = texture_value(table, number, points.take(rows))
    return value


def texture_value(table: MaterialTable, number: int, points: Points) -> Float64:
    """(n, 3) of texture `number` at the points."""
    texture = table.space.scene.textures[number]
    if texture.program >= 0:
        machine = PointMachine(table.space, table.images, points)
        return table.programs.run(texture.program, len(points.b1), machine.ops())
    uv = table.space.attribute(points, texture.uv_map)[:, :2]
    return look_up(table.images[texture.image], texture, uv)


def interpolate(corners: Float64, u: Float64, v: Float64) -> Float64:
    """Values of three corners (n, 3, k) at barycentric (u, v)."""
    return (1.0 - u - v)[:, None] * corners[:, 0] + u[:, None] * corners[:, 1] + v[:, None] * corners[:, 2]


def build_points(triangles: Triangles, hits: Hits, wo: Float64) -> Points:
    """The places at `hits`, which must all have hit."""
    index, b1, b2 = hits.triangle, hits.u, hits.v
    position = interpolate(triangles.corners[index], b1, b2)
    outside_normal = triangles.outside[index]
    smooth_normal = interpolate(triangles.normals[index], b1, b2)
    uv = interpolate(triangles.uvs[index], b1, b2)
    for row in np.unique(index[index >= triangles.first_shape]):
        rows = index == row
        shape = triangles.shapes[row - triangles.first_shape]
        points = shape_points(shape, hits.u[rows], hits.v[rows])
        position[rows] = points.position
        outside_normal[rows] = smooth_normal[rows] = points.outside
        uv[rows] = np.stack([hits.u[rows], hits.v[rows]], axis=1)
    on_shape = index >= triangles.first_shape
    b1, b2 = np.where(on_shape, 0.0, b1), np.where(on_shape, 0.0, b2)
    outside = dot(wo, outside_normal) >= 0.0
    turn = np.where(outside, 1.0, -1.0)[:, None]
    flat, normal = outside_normal * turn, normalize(smooth_normal) * turn
    normal = np.where(np.any(normal != 0.0, axis=1)[:, None], normal, flat)
    return Points(index, b1, b2, uv, position, normal, flat, wo, outside)


def bent_normals(table: MaterialTable, points: Points, row: NDArray[np.int64]) -> Float64:
    """(n, 3) shading normals: those that materials `row` (n,) ask for where they can be seen, else the smooth
    ones, else the geometric ones."""
    ns = np.where((dot(points.wo, points.normal) > GRAZING)[:, None], points.normal, points.flat)
    wanted = table.columns["normal_texture"][row]
    bent = normalize(textured(table, wanted, points, np.zeros_like(ns)))
    return np.where((dot(points.wo, bent) > GRAZING)[:, None], bent, ns)


def bend_to_horizon(surface: Surface) -> Surface:
    """`surface` with shading normals of facets bent towards the geometric ones just until the mirrored view
    is at the horizon: normals that halve the angle between `wo` and such a direction."""
    material, wo, ng = surface.material, surface.wo, surface.ng
    index = material.ior - 1.0
    has_facets = (material.metallic > 0.0) | (material.transmission > 0.0) | (material.column["coat"] > 0.0)
    has_facets |= (material.specular > 0.0) & (index != 0.0)
    cosine, flat, tilt = dot(wo, surface.ns), dot(wo, ng), dot(surface.ns, ng)
    horizon = np.minimum(HORIZON, 0.5 * flat)
    sunk = has_facets & (2.0 * cosine * tilt < flat + horizon)
    # In the plane of both normals, with ng as the second axis, wo is (along, flat). About a normal at the
    # angle x from ng its image has the height |.| cos(2 x - a), a being the angle of wo's own projection.
    side = normalize(surface.ns - tilt[:, None] * ng)
    along = dot(wo, side)
    angle = np.arctan2(along, flat)
    reach = np.hypot(along, flat)
    height = np.divide(horizon, reach, out=np.ones_like(reach), where=reach > 0.0)
    turn = 0.5 * (angle + np.arccos(np.clip(height, -1.0, 1.0)))
    bent = np.cos(turn)[:, None] * ng + np.sin(turn)[:, None] * side
    return replace(surface, ns=np.where(sunk[:, None], bent, surface.ns))


def build_surface(table: MaterialTable, hits: Hits, wo: Float64) -> Surface:
    """The surface at `hits`, which must all have hit."""
    triangles = table.space.triangles
    points = build_points(triangles, hits, wo)
    row = triangles.material[hits.triangle]
    ns, material = bent_normals(table, points, row), evaluate_material(table, points, row)
    # Embree works in float32: its error grows with the coordinates and with the size of the triangle.
    corners = triangles.corners[hits.triangle]
    edge = np.max(np.abs(corners[:, 1:] - corners[:, :1]), axis=(1, 2))
    epsilon = 1e-7 + 2e-6 * np.max(np.abs(points.position), axis=1) + 4e-7 * edge
    return Surface(points.position, wo, points.flat, ns, points.outside, material, epsilon, row, points)
