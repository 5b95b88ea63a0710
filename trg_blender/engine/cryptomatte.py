"""Names as Cryptomatte ids: Friedman and Jones 2015, "Fully automatic ID mattes with support for motion blur
and transparency", and the Cryptomatte specification 1.2.0."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable

_MASK = 0xFFFFFFFF


def murmur3(data: bytes) -> int:
    """MurmurHash3_x86_32 of `data` with seed 0 (Appleby 2011)."""
    value = 0
    whole = len(data) & ~3
    for first in range(0, whole, 4):
        value ^= _scramble(int.from_bytes(data[first : first + 4], "little"))
        value = (_rotate(value, 13) * 5 + 0xE6546B64) & _MASK
    if len(data) > whole:
        value ^= _scramble(int.from_bytes(data[whole:], "little"))
    value ^= len(data)
    value = ((value ^ (value >> 16)) * 0x85EBCA6B) & _MASK
    value = ((value ^ (value >> 13)) * 0xC2B2AE35) & _MASK
    return value ^ (value >> 16)


def _rotate(value: int, bits: int) -> int:
    return ((value << bits) | (value >> (32 - bits))) & _MASK


def _scramble(block: int) -> int:
    return (_rotate((block * 0xCC9E2D51) & _MASK, 15) * 0x1B873593) & _MASK


def id_bits(name: str) -> int:
    """The bits of the float that stands for `name`: its hash, kept from zeros, infinities and NaNs."""
    value = murmur3(name.encode())
    return value ^ (1 << 23) if (value >> 23) & 255 in (0, 255) else value


def id_of(name: str) -> float:
    """The float32 that stands for `name`."""
    return float(struct.unpack("<f", struct.pack("<I", id_bits(name)))[0])


def metadata(layer: str, names: Iterable[str]) -> dict[str, str]:
    """Fields of a picture that say what the passes called `layer` with two digits hold."""
    prefix = f"cryptomatte/{murmur3(layer.encode()):08x}"[: len("cryptomatte/") + 7]
    manifest = {name: f"{id_bits(name):08x}" for name in sorted(set(names))}
    return {
        f"{prefix}/name": layer,
        f"{prefix}/hash": "MurmurHash3_32",
        f"{prefix}/conversion": "uint32_to_float32",
        f"{prefix}/manifest": json.dumps(manifest, separators=(",", ":"), ensure_ascii=False),
    }
