"""Arguments for `fuzz_native.py`: mostly right, often odd, sometimes wrong."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Float32 = NDArray[np.float32]
Item = TypeVar("Item")
ODD = np.array(
    [0.0, -0.0, 1e-45, -1e-38, 1e-20, 1e-7, 1e7, 1e18, -2e18, 3e38, np.inf, -np.inf, np.nan], np.float32
)
WHOLE_MATERIAL = {
    "interface": 3,
    "multiscatter": 2,
    "metal_grazing": 2,
    "translucent": 2,
    "mix_first": 2,
    "mix_count": 2,
}
WHOLE_TEXTURE = {"wrap": 4, "filter": 3, "channel": 3, "unassociate": 2, "uv_map": 3}
"""columns that hold one of so many whole numbers, from 0"""


class Values:
    """Random arguments; `random` and `seed` decide them all."""

    def __init__(self, choices: random.Random, seed: int) -> None:
        self.random = choices
        self.numbers = np.random.default_rng(seed)

    def flip(self, chance: float = 0.5) -> bool:
        return self.random.random() < chance

    def pick(self, items: Sequence[Item]) -> Item:
        return self.random.choice(items)

    def maybe(self, value: Item) -> Item | None:
        return value if self.flip() else None

    def index(self, count: int) -> int:
        """Mostly below `count`."""
        return self.random.randrange(count) if self.flip(0.9) else self.pick((-1, 99, 1 << 31, -(1 << 40)))

    def threads(self) -> int:
        return self.pick((1, 1, 2, 2, 3, 0)) if self.flip(0.95) else self.pick((-1, 64, 5000, 1 << 33))

    def floats(self, shape: tuple[int, ...]) -> Float32:
        """Small numbers; in one array of eight some are odd."""
        array = self.numbers.normal(size=shape).astype(np.float32)
        if self.flip(0.125) and array.size:
            places = self.numbers.random(shape) < self.pick((0.05, 0.5))
            array[places] = self.numbers.choice(ODD, int(places.sum()))
        return array

    def vertices(self) -> tuple[Float32, int]:
        count = self.pick((0, 1, 3, 4, 8, 30, 300))
        array = self.floats((count, 3)) * np.float32(self.pick((1, 1, 1, 1e-6, 1e6, 1e15)))
        if self.flip(0.1):
            array[:, self.random.randrange(3)] = 1
        if self.flip(0.1):
            array[: count // 2] = array[:1]
        return array + np.float32(self.pick((0, 0, 0, 1e4))), count

    def triangles(self, vertex_count: int) -> NDArray[np.int32]:
        rows = self.pick((0, 1, 2, 12, 100, 500)) if vertex_count else 0
        array = self.numbers.integers(0, max(vertex_count, 1), (rows, 3)).astype(np.int32)
        if self.flip(0.05) and rows:
            array[self.random.randrange(rows)] = self.pick((-1, vertex_count, 2**31 - 1, -(2**31)))
        return array

    def slots(self, count: int) -> NDArray[np.int32]:
        high = 3 if self.flip(0.95) else 2**31 - 1
        return self.numbers.integers(0 if self.flip(0.95) else -1, high, count).astype(np.int32)

    def transforms(self, count: int) -> Float32:
        array = np.tile(np.eye(3, 4, dtype=np.float32), (count, 1, 1))
        kind = self.random.randrange(6)
        if kind == 1:
            array[:, :, 3] = self.floats((count, 3))
        elif kind > 1:
            array += self.floats((count, 3, 4)) * np.float32(self.pick((1, 0.1, 1e-6, 1e6)))
        if self.flip(0.03):
            array[:, 0] = 0
        return array

    def rays(self) -> list[Float32]:
        count = self.pick((0, 1, 5, 16, 40, 300)) if self.flip(0.997) else 9000
        t_max = np.full(count, np.inf, np.float32) if self.flip() else np.abs(self.floats((count,)))
        origins, directions = self.floats((count, 3)), self.floats((count, 3))
        if self.flip(0.3) and count:
            origins[:] = origins[0]
            directions = directions[:1] + np.float32(0.01) * directions
        if self.flip(0.1):
            directions[:, self.random.randrange(3)] = 0
        t_min = np.zeros(count, np.float32) if self.flip() else self.floats((count,))
        return [origins, np.ascontiguousarray(directions), t_min, t_max]

    def size(self) -> int:
        """Of a picture's side."""
        return self.pick((1, 2, 3, 9, 16, 33)) if self.flip(0.95) else self.pick((0, -1, 1 << 21, 1 << 40))

    def passes(self) -> object:
        right = ((), ("depth",), ("normal", "alpha"), ("depth", "normal", "alpha"))
        return self.pick(right) if self.flip(0.95) else self.pick((("gold",), 3, (1,), "depth"))

    def window(self) -> NDArray[np.float64]:
        return np.array([-1.0, 1, -1, 1]) * self.pick((1, 1, 1, 0.1, 0, 1e30, np.nan))

    def pixels(self) -> NDArray[Any]:
        shape = (self.pick((1, 2, 7, 0)), self.pick((1, 3, 8)), self.pick((1, 3, 4, 2)))
        if self.flip():
            return self.numbers.integers(0, 256, shape).astype(np.uint8)
        return np.abs(self.floats(shape))

    def textures(self, names: tuple[str, ...]) -> Float32:
        table = self.floats((self.random.randrange(3), len(names)))
        self.set_whole(table, names, WHOLE_TEXTURE)
        for name in ("image", "program"):
            table[:, names.index(name)] = self.numbers.integers(-1, 1, len(table))
        return table

    def set_whole(self, table: Float32, names: tuple[str, ...], columns: dict[str, int]) -> None:
        """Fills columns that hold whole numbers, now and then with one too large."""
        beyond = int(self.flip(0.05))
        for name, choices in columns.items():
            table[:, names.index(name)] = self.numbers.integers(0, choices + beyond, len(table))

    def programs(self) -> tuple[NDArray[Any], ...]:
        """Instructions, constants and programs, mostly of small numbers."""
        count = self.pick((0, 1, 3, 10))
        ops = self.numbers.integers(-2, 12, (count, 16)).astype(np.int32)
        ops[:, 0] = self.numbers.integers(0, 40, count)
        if self.flip(0.1) and count:
            ops[0, self.random.randrange(16)] = self.pick((2**31 - 1, -(2**31), 1000))
        rows = np.array([[0, count, 0]] * self.random.randrange(3), np.int32).reshape(-1, 3)
        return ops, self.floats((self.pick((0, 4, 30)),)), rows + self.pick((0, 0, 1))

    def materials(self, names: tuple[str, ...]) -> Float32:
        table = np.abs(self.floats((self.random.randrange(1, 4), len(names))))
        table[:, 3:] = np.minimum(table[:, 3:], 1)
        table[:, names.index("ior")] = self.pick((0.5, 1, 1.5, 1e6))
        table[:, names.index("coat_ior")] = self.pick((1, 1.5, 1e6)) if self.flip(0.95) else 0.5
        table[:, names.index("priority")] = self.pick((0, 0, 1, 2, 1e6))
        table[:, names.index("holdout")] = self.pick((0, 0, 0, 1)) if self.flip(0.95) else 0.5
        if self.flip():
            table[:, names.index("alpha")] = 1
        self.set_whole(table, names, WHOLE_MATERIAL)
        high = 1 if self.flip(0.2) else 0
        textured = [k for k, name in enumerate(names) if name.endswith("_texture")]
        table[:, textured] = self.numbers.integers(-1, high, (len(table), len(textured)))
        return table

    def lens(self) -> tuple[float, ...]:
        """The rest of a camera: aperture, focus, blades, turn, squeeze; mostly none."""
        if self.flip():
            return ()
        aperture, focus = self.pick((0.0, 0.1, 1e30, -1.0)), self.pick((1.0, 1e-30, 0.0, np.inf))
        return aperture, focus, self.pick((0, 3, 7, -1)), 0.3, self.pick((1.0, 2.0, 0.0))

    def stops(self) -> tuple[object, ...]:
        """When a render ends besides its samples: seconds, error, and whether it adapts; mostly never."""
        if self.flip():
            return ()
        return self.pick((0, 0, 0.01, -1, np.nan)), self.pick((0, 0.1, 1e30, np.inf)), self.flip()

    def rules(self) -> object:
        """Bounces by kind, clamps, caustics; mostly none."""
        if self.flip():
            return None
        bounces = [self.pick((0, 1, 3, 1 << 20)) for _ in range(4)]
        clamps = [self.pick((0.0, 0.0, 1.0, 1e-6, 1e30)) for _ in range(2)]
        wrong = (
            (-1, *bounces[1:], *clamps, True, True),
            (1, 2),
            (*bounces, np.nan, -1.0, True, True),
            "rules",
        )
        return (*bounces, *clamps, self.flip(), self.flip()) if self.flip(0.9) else self.pick(wrong)

    def lights(self, names: tuple[str, ...]) -> Float32:
        table = self.floats((self.random.randrange(4), len(names)))
        table[:, 0] = self.numbers.integers(0, 5, len(table))
        for name in ("radius", "angle", "spread"):
            table[:, names.index(name)] = np.abs(table[:, names.index(name)])
        if self.flip(0.9):
            table[:, names.index("angle")] = np.minimum(table[:, names.index("angle")], 1.5)
            table[:, names.index("spread")] = np.minimum(table[:, names.index("spread")], 3.14)
            for name in ("soft", "seen"):
                table[:, names.index(name)] = self.numbers.integers(0, 2, len(table))
        return table

    def spoil(self, array: Any, always: bool = False) -> Any:
        """`array`, or one time in twenty something else in its place."""
        if array is None or array.ndim == 0 or not (always or self.flip(0.05)):
            return array
        wrong = (
            array.astype(np.float64 if array.dtype != np.float64 else np.int8),
            array.reshape(-1),
            array[None],
            array[..., None],
            np.repeat(array, 2, axis=-1)[..., ::2],
            array[1:],
            frozen(array),
            shifted(array),
            array.tolist(),
            bytes(array.tobytes()),
            array.byteswap().view(array.dtype.newbyteorder()),
            None,
            "text",
            7,
            np.array(3.0, np.float32),
        )
        return self.pick(wrong)


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """A copy that cannot be written."""
    copy = array.copy()
    copy.flags.writeable = False
    return copy


def shifted(array: NDArray[Any]) -> NDArray[Any]:
    """A copy whose items lie at odd addresses."""
    raw = np.zeros(array.nbytes + 1, np.uint8)[1:]
    raw[:] = np.frombuffer(array.tobytes(), np.uint8)
    return raw.view(array.dtype).reshape(array.shape)
