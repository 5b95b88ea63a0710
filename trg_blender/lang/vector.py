"""`vec3`: an immutable value of three numbers."""

from __future__ import annotations

from operator import itemgetter

from .values import TrgError, Value, compare, compute, format_number

_new = tuple.__new__


class Vec3(tuple, Value):  # type: ignore[misc]
    """Three floats. Made by `Vec3.of`; a tuple underneath, because that is immutable and fast."""

    __slots__ = ()
    kind = "vec3"

    T_x = property(itemgetter(0))
    T_y = property(itemgetter(1))
    T_z = property(itemgetter(2))

    @staticmethod
    def of(x: float, y: float, z: float) -> Vec3:
        return _new(Vec3, (x, y, z))

    def __setattr__(self, name: str, value: object) -> None:
        raise TrgError("E423", "new_vector", name=name.removeprefix("T_"))

    def __add__(self, other: object) -> object:  # type: ignore[override]
        if type(other) is Vec3:
            return _new(Vec3, (self[0] + other[0], self[1] + other[1], self[2] + other[2]))
        return compute("+", self, other)

    def __sub__(self, other: object) -> object:
        if type(other) is Vec3:
            return _new(Vec3, (self[0] - other[0], self[1] - other[1], self[2] - other[2]))
        return compute("-", self, other)

    def __mul__(self, other: object) -> object:  # type: ignore[override]
        if type(other) is float:
            return _new(Vec3, (self[0] * other, self[1] * other, self[2] * other))
        if type(other) is Vec3:
            return _new(Vec3, (self[0] * other[0], self[1] * other[1], self[2] * other[2]))
        return compute("*", self, other)

    def __rmul__(self, other: object) -> object:  # type: ignore[override]
        if type(other) is float:
            return _new(Vec3, (other * self[0], other * self[1], other * self[2]))
        return compute("*", other, self)

    def __truediv__(self, other: object) -> object:
        if type(other) is float:
            return _new(Vec3, (self[0] / other, self[1] / other, self[2] / other))
        return compute("/", self, other)

    def __neg__(self) -> object:
        return _new(Vec3, (-self[0], -self[1], -self[2]))

    def __pos__(self) -> object:
        return self

    def __lt__(self, other: object) -> object:  # type: ignore[override]
        return compare("<", self, other)

    def __gt__(self, other: object) -> object:  # type: ignore[override]
        return compare(">", self, other)

    def __le__(self, other: object) -> object:  # type: ignore[override]
        return compare("<=", self, other)

    def __ge__(self, other: object) -> object:  # type: ignore[override]
        return compare(">=", self, other)

    def __eq__(self, other: object) -> bool:
        if type(other) is not Vec3:
            return False
        # Not tuple's: that takes a nan for equal to itself.
        return bool(self[0] == other[0] and self[1] == other[1] and self[2] == other[2])

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = tuple.__hash__

    def shown(self) -> str:
        return f"vec3({', '.join(map(format_number, self))})"
