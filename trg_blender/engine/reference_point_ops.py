"""Instructions of texture programs that ask the point, in the reference renderer."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .reference_colors import Operands
from .reference_fresnel import fresnel_dielectric
from .reference_math import dot, normalize
from .reference_points import Points, PointSpace
from .reference_programs import PointOp
from .reference_textures import Picture, look_up_texels
from .scene_arrays import Float64
from .texture_ops import INFOS, NORMAL_SPACES, NORMALS


def tangents(n: Float64) -> tuple[Float64, Float64]:
    """Two unit vectors across each of `n` (Duff et al. 2017); bumps look along them."""
    x, y, z = n.T
    sign = np.copysign(1.0, z)
    a = -1.0 / (sign + z)
    b = x * y * a
    s = np.stack([1.0 + sign * x * x * a, sign * b, -sign * x], axis=1)
    return s, np.stack([b, sign + y * y * a, -y], axis=1)


def box_weights(n: Float64, blend: Float64) -> Float64:
    """(n, 3) shares of the three axes in box projection for object normals (n, 3)."""
    a, limit = np.abs(n), 0.5 * (1.0 + blend)
    x, y, z = a.T
    sums = {"xy": x + y, "xz": x + z, "yz": y + z}
    only = [
        (x > limit * sums["xy"]) & (x > limit * sums["xz"]),
        (y > limit * sums["xy"]) & (y > limit * sums["yz"]),
        (z > limit * sums["xz"]) & (z > limit * sums["yz"]),
        blend <= 0.0,
        z < (1.0 - limit) * sums["xy"],
        x < (1.0 - limit) * sums["yz"],
        y < (1.0 - limit) * sums["xz"],
    ]
    safe = np.where(blend > 0.0, blend, 1.0)

    def share(one: Float64, two: Float64) -> Float64:
        shares: Float64 = np.clip((one / (one + two) - 0.5 * (1.0 - blend)) / safe, 0.0, 1.0)
        return shares

    zero, one = np.zeros_like(x), np.ones_like(x)
    xy, yz, xz = share(x, y), share(y, z), share(x, z)
    two_sided = [(xy, 1.0 - xy, zero), (zero, yz, 1.0 - yz), (xz, zero, 1.0 - xz)]
    cases = [(one, zero, zero), (zero, one, zero), (zero, zero, one), (one, zero, zero), *two_sided]
    scale = 1.0 / np.where(blend > 0.0, 2.0 * limit - 1.0, 1.0)
    middle = ((2.0 - limit[:, None]) * a / (x + y + z)[:, None] + limit[:, None] - 1.0) * scale[:, None]
    columns = [np.select(only, [case[k] for case in cases], middle[:, k]) for k in range(3)]
    return np.stack(columns, axis=1)


def facing_weight(cosine: Float64, blend: Float64) -> Float64:
    f = np.abs(cosine)
    b = np.clip(blend, 0.0, 1.0 - 1e-5)
    power = np.where(b < 0.5, 2.0 * b, 0.5 / (1.0 - b))
    return 1.0 - np.where(blend == 0.5, f, f**power)


@dataclass(slots=True)
class PointMachine:
    """Runs such instructions at `home`, and at `here` while a bump looks beside it."""

    space: PointSpace
    images: list[Picture]
    home: Points
    here: Points = field(init=False)

    def __post_init__(self) -> None:
        self.here = self.home

    def ops(self) -> dict[str, PointOp]:
        return {
            "attribute": lambda o: self.space.attribute(self.here, o.mode),
            "generated": lambda o: self.space.generated(self.here),
            "object": lambda o: self.space.local(self.here),
            "position": lambda o: self.here.position,
            "normal": self._normal,
            "info": self._info,
            "shift": self._shift,
            "image": self._image,
            "box": self._box,
            "fresnel": self._fresnel,
            "layer_weight": self._layer_weight,
            "bump": self._bump,
            "normal_map": self._normal_map,
        }

    def _normal(self, o: Operands) -> Float64:
        here, kind = self.here, NORMALS[o.mode]
        if kind == "reflection":
            return here.normal * (2.0 * dot(here.wo, here.normal))[:, None] - here.wo
        if kind == "object":
            return self.space.normals_into(here, here.normal)
        return {"shading": here.normal, "flat": here.flat, "incoming": here.wo}[kind]

    def _info(self, o: Operands) -> Float64:
        copy, kind = self.space.copy_of(self.here), INFOS[o.mode]
        if kind == "location":
            return self.space.copies.translation[copy]
        value = self.space.copies.random[copy] if kind == "random" else ~self.here.outside
        return value.astype(np.float64)[:, None]

    def _shift(self, o: Operands) -> Float64:
        if o.mode == 0:
            self.here = self.home
        else:
            along = tangents(self.home.flat)[o.mode - 1]
            step = self.space.step(self.home) * o.number(0)
            self.here = self.space.move(self.home, along * step[:, None])
        return np.zeros((len(self.home.b1), 0))

    def _texels(self, number: int, x: Float64, y: Float64) -> Float64:
        texture = self.space.scene.textures[number]
        return look_up_texels(self.images[texture.image], texture, x, y)

    def _image(self, o: Operands) -> Float64:
        at = o.vector(0)
        return self._texels(o.mode, at[:, 0], at[:, 1])

    def _box(self, o: Operands) -> Float64:
        at, n = o.vector(0), self.space.normals_into(self.here, self.here.normal)
        weights, (x, y, z) = box_weights(n, o.number(1)), at.T
        sides = [
            (np.where(n[:, 0] < 0.0, 1.0 - y, y), z),
            (np.where(n[:, 1] > 0.0, 1.0 - x, x), z),
            (np.where(n[:, 2] > 0.0, 1.0 - y, y), x),
        ]
        shown = [self._texels(o.mode, *side) * weights[:, k, None] for k, side in enumerate(sides)]
        total: Float64 = np.sum(shown, axis=0)
        return total

    def _fresnel(self, o: Operands) -> Float64:
        cosine = np.abs(dot(self.here.wo, o.vector(1)))
        return self._reflected(cosine, np.maximum(o.number(0), 1e-5))

    def _reflected(self, cosine: Float64, ior: Float64) -> Float64:
        return fresnel_dielectric(cosine, np.where(self.here.outside, ior, 1.0 / ior))[:, None]

    def _layer_weight(self, o: Operands) -> Float64:
        blend, cosine = o.number(0), dot(self.here.wo, o.vector(1))
        if o.mode != 0:
            return facing_weight(cosine, blend)[:, None]
        return self._reflected(np.abs(cosine), 1.0 / np.maximum(1.0 - blend, 1e-5))

    def _bump(self, o: Operands) -> Float64:
        """Mikkelsen 2010, from the heights here and along both tangents."""
        here, along_s, along_t = o.number(0), o.number(1), o.number(2)
        strength, distance, n = np.maximum(o.number(3), 0.0)[:, None], o.number(4), o.vector(5)
        s, t = tangents(self.home.flat)
        step = self.space.step(self.home) * o.number(6)
        rs, rt = np.cross(t, n), np.cross(n, s)
        gradient = (rs * (along_s - here)[:, None] + rt * (along_t - here)[:, None]) / step[:, None]
        det = dot(s, rs)
        height = np.where(det < 0.0, -distance, distance)[:, None]
        bumped = normalize(n * np.abs(det)[:, None] - gradient * height)
        mixed = normalize(bumped * strength + n * (1.0 - strength))
        return np.where(np.any(bumped != 0.0, axis=1)[:, None], mixed, n)

    def _normal_map(self, o: Operands) -> Float64:
        p, kind = self.here, NORMAL_SPACES[o.mode]
        c, strength = o.vector(0) * 2.0 - 1.0, o.number(1)
        side = np.where(p.outside, 1.0, -1.0)[:, None]
        if kind == "TANGENT":
            n = self._tangent_normal(c, strength, o.table(2, 4), side)
        else:
            if kind.startswith("BLENDER"):
                c = c * [1.0, -1.0, -1.0]
            n = (self.space.normals_out_of(p, c) if kind.endswith("OBJECT") else normalize(c)) * side
            n = normalize(p.normal + (n - p.normal) * np.maximum(strength, 0.0)[:, None])
        return np.where(np.any(n != 0.0, axis=1)[:, None], n, p.normal)

    def _tangent_normal(self, c: Float64, strength: Float64, tangent: Float64, side: Float64) -> Float64:
        """Null where the mesh has no tangent."""
        tangent = np.broadcast_to(tangent, (len(c), 4))
        t = tangent[:, :3]
        normal = self.space.normals_into(self.here, self.here.normal * side)
        z = 1.0 + (c[:, 2] - 1.0) * np.clip(strength, 0.0, 1.0)
        across = np.cross(normal, t) * (tangent[:, 3] * c[:, 1] * strength)[:, None]
        n = t * (c[:, 0] * strength)[:, None] + across + normal * z[:, None]
        n = self.space.normals_out_of(self.here, n) * side
        return np.where(np.any(t != 0.0, axis=1)[:, None], n, 0.0)
