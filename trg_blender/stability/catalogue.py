"""The 67 rows of the catalogue of stiff and extreme cases: name, criterion, and the cases of each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain

from .case import Case


@dataclass(frozen=True, slots=True)
class Entry:
    """One row of the catalogue."""

    id: str
    name: str
    criterion: str
    absent: str = ""
    """why TRG has nothing of the kind; such a row has no cases"""


TESSELLATED = "TRG makes triangles of this shape: there is no analytic one to be met"
CATALOGUE = (
    Entry("G01", "edge-aim", "0 leak"),
    Entry("G02", "vertex-aim", "0 leak"),
    Entry("G03", "random-far", "0 leak"),
    Entry("G04", "fma-twin", "same hits, 0 leak with each"),
    Entry("G05", "spiky", "0 leak"),
    Entry("G06", "needle-fan", "0 leak"),
    Entry("G07", "sliver", "wrong <= 1e-6, t <= 4 ulp"),
    Entry("G08", "tiny", "all hit, uv <= 1e-6"),
    Entry("G09", "huge", "all hit to 1e15; rejected above 1e18"),
    Entry("G10", "dir-length", "all hit"),
    Entry("G11", "grazing", "wrong <= 1e-6"),
    Entry("G12", "far-eye", "wrong <= 1e-6"),
    Entry("G13", "horizon", "no hole, t <= 1e-6"),
    Entry("G14", "planet", "wrong <= 1e-6, dip 0.0418 deg +-1 %"),
    Entry("G15", "garbage", "as the clean mesh, counted"),
    Entry("G16", "bad-rays", "no hit, <= 1.1 x time of a miss"),
    Entry("G17", "parity", "exactly one hit"),
    Entry("A01", "box-corner", "0 culled"),
    Entry("A02", "flat-box", "0 culled"),
    Entry("A03", "zero-comp-on-face", "0 lost on either face"),
    Entry("A04", "cube-equals-grid", "0 lost"),
    Entry("A05", "dda-drift", "no cell skipped: 0 lost"),
    Entry("A06", "grid-far", "0 lost"),
    Entry("A07", "spanning", "0 differ from brute force"),
    Entry("A08", "grid-planes", "0 lost"),
    Entry("A09", "teapot-stadium", "grid2 >= 20 x grid; same hits"),
    Entry("A10", "sliver-cliff", ">= 1/5 of the ball's rate"),
    Entry("A11", "same-centroid", "< 2 s, lowest hit"),
    Entry("A12", "empty-scene", "no hit, no NaN"),
    Entry("S01", "acne-scale", "|mean - 1| <= 1e-6, pixels >= 0.99"),
    Entry("S02", "acne-far", "error <= 1e-5"),
    Entry("S03", "far-camera", "0 dark"),
    Entry("S04", "grazing-exit", "0 dark"),
    Entry("S05", "thin-gap", "light >= 0.999"),
    Entry("S06", "coplanar-dup", "1.000 and a warning"),
    Entry("S07", "coincident-glass", "0.9567 +-1e-3"),
    Entry("S08", "nested", "0.9567 with priorities"),
    Entry("S09", "instances", "as baked to 1e-5; 0 leak"),
    Entry("S10", "terminator", "<= 2 % of lit pixels black; white <= 1"),
    Entry("S11", "light-on-surface", "form factor +-0.5 %"),
    Entry("S12", "alpha-stack", "0.99^1000 +-1 %"),
    Entry("P01", "sphere-far", "wrong <= 1e-6, t <= 1e-6"),
    Entry("P02", "torus-far", "wrong <= 1e-6", TESSELLATED),
    Entry("P03", "cone-apex", "one hit, unit normal", TESSELLATED),
    Entry("B01", "ggx-D", "relative error <= 1e-5"),
    Entry("B02", "vndf-grazing", "finite, pdf > 0, angle/alpha <= 1e-2"),
    Entry("B03", "furnace-metal", "0.995 to 1.005"),
    Entry("B04", "furnace-glass", "0.98 to 1.01; smooth 1 +-1e-5"),
    Entry("B05", "weak-furnace", "1 +-1e-4"),
    Entry("B06", "reciprocity", "relative <= 1e-5"),
    Entry("B07", "chi2", "p > 0.01 (Sidak)"),
    Entry("B08", "ior-one", "R <= 1e-5 relative; as no object"),
    Entry("B09", "critical", "|dR| <= 1e-4, unit directions"),
    Entry("B10", "intensity", "linear to 1e-5 in 1e-25..1e25"),
    Entry("B11", "tiny-light", "point light +-0.5 %"),
    Entry("B12", "env-sun", "mean +-0.1 %, no firefly"),
    Entry("B13", "bad-frame", "finite, white <= 1"),
    Entry("B14", "far-texture", "period error <= 1 texel at 1e6"),
    Entry("B15", "long-path", "1/(1 - albedo) +-1 %"),
    Entry("E01", "sum-1e8", "<= 1e-7"),
    Entry("E02", "coverage-easy", "pixels 0.93 or more"),
    Entry("E03", "coverage-caustic", "pixels 0.90 or more"),
    Entry("E04", "image-mse", "ratio 0.9 to 1.1, interval >= 90 %"),
    Entry("E05", "stop-bias", "|bias| <= 0.1 % and inside its interval"),
    Entry("E06", "zero-variance", "flag `unseen`, no early stop"),
    Entry("E07", "pooled-mean", "1 % found at 2e6 samples"),
    Entry("E08", "repeat", "CPU bit-identical"),
)


def cases() -> Iterator[Case]:
    """Every case in the order of the catalogue."""
    from . import (
        estimate_rows,
        instance_rows,
        leaving_rows,
        ray_rows,
        scattering_rows,
        shading_rows,
        shape_rows,
        structure_rows,
        triangle_rows,
    )

    rooms = (
        ray_rows,
        triangle_rows,
        structure_rows,
        leaving_rows,
        instance_rows,
        shape_rows,
        scattering_rows,
        shading_rows,
        estimate_rows,
    )
    order = [entry.id for entry in CATALOGUE]
    found = chain.from_iterable(room.cases() for room in rooms)
    return iter(sorted(found, key=lambda case: order.index(case.id)))
