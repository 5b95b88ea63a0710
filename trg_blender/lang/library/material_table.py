"""The teapot materials: Silicon Graphics' teapots.c (M. J. Kilgard, 1994), blue_plastic added here.

A row is ambient, diffuse, specular, Phong power. `blue_plastic` stands in no published table; it is
red_plastic with the channels exchanged. Jade's diffuse is the corrected one.
"""

from __future__ import annotations

Triple = tuple[float, float, float]
Row = tuple[Triple, Triple, Triple, float]


def _grey(value: float) -> Triple:
    return (value, value, value)


METALS = frozenset(
    "brass bronze polished_bronze chrome copper polished_copper gold polished_gold pewter "
    "silver polished_silver".split()
)

TEAPOTS: dict[str, Row] = {
    "emerald": ((0.0215, 0.1745, 0.0215), (0.07568, 0.61424, 0.07568), (0.633, 0.727811, 0.633), 76.8),
    "jade": ((0.135, 0.2225, 0.1575), (0.54, 0.89, 0.63), _grey(0.316228), 12.8),
    "obsidian": ((0.05375, 0.05, 0.06625), (0.18275, 0.17, 0.22525), (0.332741, 0.328634, 0.346435), 38.4),
    "pearl": ((0.25, 0.20725, 0.20725), (1.0, 0.829, 0.829), _grey(0.296648), 11.264),
    "ruby": ((0.1745, 0.01175, 0.01175), (0.61424, 0.04136, 0.04136), (0.727811, 0.626959, 0.626959), 76.8),
    "turquoise": ((0.1, 0.18725, 0.1745), (0.396, 0.74151, 0.69102), (0.297254, 0.30829, 0.306678), 12.8),
    "brass": ((0.329412, 0.223529, 0.027451), (0.780392, 0.568627, 0.113725), (0.992157, 0.941176, 0.807843), 27.8974),
    "bronze": ((0.2125, 0.1275, 0.054), (0.714, 0.4284, 0.18144), (0.393548, 0.271906, 0.166721), 25.6),
    "polished_bronze": ((0.25, 0.148, 0.06475), (0.4, 0.2368, 0.1036), (0.774597, 0.458561, 0.200621), 76.8),
    "chrome": (_grey(0.25), _grey(0.4), _grey(0.774597), 76.8),
    "copper": ((0.19125, 0.0735, 0.0225), (0.7038, 0.27048, 0.0828), (0.256777, 0.137622, 0.086014), 12.8),
    "polished_copper": ((0.2295, 0.08825, 0.0275), (0.5508, 0.2118, 0.066), (0.580594, 0.223257, 0.0695701), 51.2),
    "gold": ((0.24725, 0.1995, 0.0745), (0.75164, 0.60648, 0.22648), (0.628281, 0.555802, 0.366065), 51.2),
    "polished_gold": ((0.24725, 0.2245, 0.0645), (0.34615, 0.3143, 0.0903), (0.797357, 0.723991, 0.208006), 83.2),
    "pewter": ((0.105882, 0.058824, 0.113725), (0.427451, 0.470588, 0.541176), (0.333333, 0.333333, 0.521569), 9.84615),
    "silver": (_grey(0.19225), _grey(0.50754), _grey(0.508273), 51.2),
    "polished_silver": (_grey(0.23125), _grey(0.2775), _grey(0.773911), 89.6),
    "black_plastic": (_grey(0.0), _grey(0.01), _grey(0.5), 32.0),
    "blue_plastic": (_grey(0.0), (0.0, 0.0, 0.5), (0.6, 0.6, 0.7), 32.0),
    "cyan_plastic": ((0.0, 0.1, 0.06), (0.0, 0.50980392, 0.50980392), _grey(0.50196078), 32.0),
    "green_plastic": (_grey(0.0), (0.1, 0.35, 0.1), (0.45, 0.55, 0.45), 32.0),
    "red_plastic": (_grey(0.0), (0.5, 0.0, 0.0), (0.7, 0.6, 0.6), 32.0),
    "white_plastic": (_grey(0.0), _grey(0.55), _grey(0.7), 32.0),
    "yellow_plastic": (_grey(0.0), (0.5, 0.5, 0.0), (0.6, 0.6, 0.5), 32.0),
    "black_rubber": (_grey(0.02), _grey(0.01), _grey(0.4), 10.0),
    "cyan_rubber": ((0.0, 0.05, 0.05), (0.4, 0.5, 0.5), (0.04, 0.7, 0.7), 10.0),
    "green_rubber": ((0.0, 0.05, 0.0), (0.4, 0.5, 0.4), (0.04, 0.7, 0.04), 10.0),
    "red_rubber": ((0.05, 0.0, 0.0), (0.5, 0.4, 0.4), (0.7, 0.04, 0.04), 10.0),
    "white_rubber": (_grey(0.05), _grey(0.5), _grey(0.7), 10.0),
    "yellow_rubber": ((0.05, 0.05, 0.0), (0.5, 0.5, 0.4), (0.7, 0.7, 0.04), 10.0),
}  # fmt: skip
