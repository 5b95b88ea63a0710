"""By what paths are cut short or made to bring less, in Cycles' words; each rule is a bias."""

from __future__ import annotations

from dataclasses import dataclass, fields

NO_LIMIT = 1024
"""Bounces of a kind from which on they are not limited: as many as Blender lets one ask for."""
LIMITED_KINDS = ("diffuse", "glossy", "transmission", "transparent")
NativeRules = tuple[int, int, int, int, float, float, bool, bool]


@dataclass(frozen=True, slots=True)
class PathRules:
    """Rules beside `max_bounces`; those that stand here limit nothing."""

    diffuse: int = NO_LIMIT
    """bounces: a path may be scattered so by one surface more"""
    glossy: int = NO_LIMIT
    transmission: int = NO_LIMIT
    transparent: int = NO_LIMIT
    """surfaces that rays go straight through"""
    clamp_direct: float = 0.0
    """mean of the channels to which a contribution after one scattering or none is scaled down; 0: none"""
    clamp_indirect: float = 0.0
    """the same after more"""
    caustics_reflective: bool = True
    """whether surfaces met after a diffuse scattering reflect as mirrors and facets do"""
    caustics_refractive: bool = True
    """whether they refract"""

    def bite(self, max_bounces: int) -> bool:
        """Whether any rule can change a picture of at most `max_bounces`."""
        limits = [getattr(self, kind) for kind in LIMITED_KINDS]
        return (
            min(limits[:3]) < min(max_bounces, NO_LIMIT)
            or limits[3] < NO_LIMIT
            or max(self.clamp_direct, self.clamp_indirect) > 0.0
            or not (self.caustics_reflective and self.caustics_refractive)
        )

    def packed(self, max_bounces: int) -> NativeRules | None:
        """What the native core takes; None where nothing bites."""
        if not self.bite(max_bounces):
            return None
        endless = 2**20
        diffuse, glossy, transmission, transparent = (
            endless if getattr(self, kind) >= NO_LIMIT else getattr(self, kind) for kind in LIMITED_KINDS
        )
        return (
            diffuse,
            glossy,
            transmission,
            transparent,
            self.clamp_direct,
            self.clamp_indirect,
            self.caustics_reflective,
            self.caustics_refractive,
        )

    def describe(self) -> list[str]:
        """A line for each rule that limits something, for the report."""
        lines = []
        for kind in LIMITED_KINDS:
            if getattr(self, kind) < NO_LIMIT:
                lines.append(f"{kind} bounces: {getattr(self, kind)}")
        for name in ("clamp_direct", "clamp_indirect"):
            if getattr(self, name) > 0.0:
                lines.append(f"{name.replace('_', ' ')}: {getattr(self, name):g}")
        for name in ("caustics_reflective", "caustics_refractive"):
            if not getattr(self, name):
                lines.append(f"no {name.removeprefix('caustics_')} caustics")
        return lines


NO_RULES = PathRules()


def wrong_rules(rules: PathRules) -> list[str]:
    """What no render can follow, one line each."""
    negative = [each.name for each in fields(rules) if not getattr(rules, each.name) >= 0]
    return [f"{name} is {getattr(rules, name)}: it must be 0 or more" for name in negative]
