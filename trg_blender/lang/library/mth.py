"""`mth::` - numbers, angles in radians, vectors, random numbers, noise."""

from __future__ import annotations

import math

from ..bind import HOST
from ..runtime import Runtime
from ..values import TrgError
from ..vector import Vec3

_PCG_MULTIPLIER = 6364136223846793005
_MASK64 = (1 << 64) - 1
_MASK32 = (1 << 32) - 1
_SMALLEST_LENGTH, _GREATEST_LENGTH = 1e-300, 1e300


class Pcg32:
    """PCG-XSH-RR 64/32: M. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically
    Good Algorithms for Random Number Generation", 2014."""

    def __init__(self, seed: int) -> None:
        self._state = 0
        self._increment = (54 << 1) | 1
        self.next()
        self._state = (self._state + seed) & _MASK64
        self.next()

    def next(self) -> int:
        """The next number of 32 bits."""
        old = self._state
        self._state = (old * _PCG_MULTIPLIER + self._increment) & _MASK64
        shifted = (((old >> 18) ^ old) >> 27) & _MASK32
        turn = old >> 59
        return ((shifted >> turn) | (shifted << (-turn & 31))) & _MASK32


def _pow(rt: Runtime, base: float, exponent: float) -> float:
    try:
        return math.pow(base, exponent)
    except OverflowError:
        return -math.inf if base < 0.0 and exponent % 2.0 == 1.0 else math.inf
    except ValueError:
        raise TrgError("E508", name="mth::pow", reason="the result is not a real number") from None


def _exp(x: float) -> float:
    try:
        return math.exp(x)
    except OverflowError:
        return math.inf


def _sign(x: float) -> float:
    return float((x > 0.0) - (x < 0.0))


def _mix(rt: Runtime, a: object, b: object, t: float) -> object:
    if type(a) is not type(b):
        raise TrgError("E508", name="mth::mix", reason="both ends must be of one type")
    return a * (1.0 - t) + b * t  # type: ignore[operator]


def _dot(a: Vec3, b: Vec3) -> float:
    return float(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def _cross(a: Vec3, b: Vec3) -> Vec3:
    return Vec3.of(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _length(v: Vec3) -> float:
    return math.hypot(*v)


def _normalize(rt: Runtime, v: Vec3) -> Vec3:
    length = math.hypot(*v)
    if length == 0.0:
        raise TrgError("E508", name="mth::normalize", reason="the vector has no length")
    if not _SMALLEST_LENGTH <= length <= _GREATEST_LENGTH:  # the length itself is inexact there
        largest = max(map(abs, v))
        v = Vec3.of(v[0] / largest, v[1] / largest, v[2] / largest)
        length = math.hypot(*v)
    return Vec3.of(v[0] / length, v[1] / length, v[2] / length)


def _lattice(x: int, y: int, z: int) -> float:
    """A fixed number in -1..1 for each point of the integer lattice."""
    h = (x * 0x9E3779B1 + y * 0x85EBCA77 + z * 0xC2B2AE3D) & _MASK32
    h = ((h ^ (h >> 15)) * 0x2C1B3C6D) & _MASK32
    h = ((h ^ (h >> 12)) * 0x297A2D39) & _MASK32
    return ((h ^ (h >> 15)) & _MASK32) / 2147483647.5 - 1.0


def value_noise(x: float, y: float, z: float) -> float:
    """Smooth noise in -1..1: lattice values, blended by the quintic of K. Perlin, 2002."""
    corner = [math.floor(c) for c in (x, y, z)]
    weights = []
    for c, base in zip((x, y, z), corner, strict=True):
        t = c - base
        weights.append(t * t * t * (t * (t * 6.0 - 15.0) + 10.0))
    total = 0.0
    for index in range(8):
        bits = (index & 1, index >> 1 & 1, index >> 2)
        share = 1.0
        for bit, weight in zip(bits, weights, strict=True):
            share *= weight if bit else 1.0 - weight
        total += share * _lattice(*(c + b for c, b in zip(corner, bits, strict=True)))
    return total


def _noise(rt: Runtime, p: object) -> float:
    if isinstance(p, Vec3):
        return value_noise(*p)
    return value_noise(float(p), 0.0, 0.0)  # type: ignore[arg-type]


def _rand(rt: Runtime, low: float, high: float) -> float:
    share = rt.random.next() / 4294967296.0
    reach = high - low
    if math.isinf(reach):
        return low * (1.0 - share) + high * share
    number = low + reach * share
    return math.nextafter(high, low) if number == high != low else number  # rounded up to the end


HOST.constant("mth::PI", math.pi, "The circle's circumference over its diameter.")
HOST.pure("mth::sin", "x: num", "Sine of an angle in radians.", math.sin)
HOST.pure("mth::cos", "x: num", "Cosine of an angle in radians.", math.cos)
HOST.pure("mth::tan", "x: num", "Tangent of an angle in radians.", math.tan)
HOST.pure("mth::asin", "x: num -1..1", "Angle in radians whose sine is x.", math.asin)
HOST.pure("mth::acos", "x: num -1..1", "Angle in radians whose cosine is x.", math.acos)
HOST.pure("mth::atan", "x: num", "Angle in radians whose tangent is x.", math.atan)
HOST.pure("mth::atan2", "y: num, x: num", "Angle of the point (x, y) in radians.", math.atan2)
HOST.pure("mth::sqrt", "x: num >= 0", "Square root.", math.sqrt)
HOST.pure("mth::exp", "x: num", "e to the power x.", _exp)
HOST.pure("mth::log", "x: num > 0", "Natural logarithm.", math.log)
HOST.pure("mth::floor", "x: num", "Greatest whole number not above x.", lambda x: float(math.floor(x)))
HOST.pure("mth::ceil", "x: num", "Least whole number not below x.", lambda x: float(math.ceil(x)))
HOST.pure("mth::abs", "x: num", "Absolute value.", abs)
HOST.pure("mth::sign", "x: num", "-1, 0 or 1.", _sign)
HOST.pure("mth::min", "a: num, b: num, ...rest: num", "The least of the numbers.", min)
HOST.pure("mth::max", "a: num, b: num, ...rest: num", "The greatest of the numbers.", max)
HOST.pure(
    "mth::clamp", "x: num, low: num, high: num", "x, but not outside low..high.",
    lambda x, low, high: min(max(x, low), high),
)  # fmt: skip
HOST.pure("mth::Degree2Radian", "angle: num", "Degrees to radians.", math.radians)
HOST.pure("mth::Radian2Degree", "angle: num", "Radians to degrees.", math.degrees)
HOST.pure("mth::dot", "a: vec3, b: vec3", "Scalar product.", _dot)
HOST.pure("mth::cross", "a: vec3, b: vec3", "Vector product.", _cross, "vec3")
HOST.pure("mth::length", "v: vec3", "Length of a vector.", _length)
HOST.function("mth::normalize", "v: vec3", "The vector at length 1.", "vec3")(_normalize)
HOST.function("mth::pow", "x: num, y: num", "x to the power y.", "num")(_pow)
HOST.function("mth::mix", "a: num|vec3, b: num|vec3, t: num", "a (1 - t) + b t.", "num|vec3")(_mix)
HOST.function("mth::noise", "p: num|vec3", "Smooth noise in -1..1, fixed for each place.", "num")(_noise)
HOST.function(
    "mth::rand", "low: num = 0, high: num = 1", "A random number; the same row in every run.", "num"
)(_rand)
