"""Settings of a scene: `scene.trg`."""

from __future__ import annotations

import contextlib

import bpy

from .. import lang
from ..engine import run_text
from ..engine.path_rules import NO_LIMIT

DEVICES = (
    ("auto", "Auto", "The fastest device of this machine"),
    ("cpu", "CPU", "The native renderer on all processor cores"),
    ("embree", "Embree Reference", "The slow reference renderer in Python, to check the native one against"),
)
ACCELERATORS = (
    ("auto", "Auto", "Chosen by estimated cost"),
    ("bvh", "BVH", "Bounding volume hierarchy built by the surface area heuristic"),
    ("grid", "Grid", "Regular grid walked by 3D-DDA"),
    ("grid2", "Divided Grid", "Regular grid whose full cells are divided again"),
    ("tree", "Paper's Tree", "Boxes halved along their longest axis, four triangles a leaf"),
    ("none", "None", "Every ray against every triangle: for tiny scenes and tests"),
)
FILTERS = (
    ("BOX", "Box", "Every point of the pixel counts equally; one pixel wide"),
    ("GAUSSIAN", "Gaussian", "A bell that is cut off at one and a half widths"),
    ("BLACKMAN_HARRIS", "Blackman-Harris", "A bell without a cut, that reaches one width: Cycles' default"),
)
INTEGRATORS = (
    ("path", "Path Tracing", "Unidirectional, with light sampling and Russian roulette"),
    ("classic", "Classic", "The paper's: direct light, coloured shadows, mirrored and refracted rays"),
)
ANTIALIASINGS = (
    ("auto", "Auto", "What the program asks for, else Sobol"),
    ("sobol", "Sobol", "Evenly random points, weighted by the pixel filter"),
    ("none", "None", "The middle of the pixel alone"),
    ("supersampling", "Supersampling", "The middles of a grid of cells in the pixel"),
    ("jittering", "Jittering", "Random points, one in each cell of a grid"),
    ("mfaa", "Multi-Frame", "Half of the cells in each frame, the frame before carried over"),
)


def _offer_parameters(settings: TRGSceneSettings, _context: bpy.types.Context) -> None:
    """Show the parameters of the program just chosen; what is wrong with it is said when it runs."""
    with contextlib.suppress(lang.ProgramError):
        run_text.read_program(settings.id_data)


class TRGParameters(bpy.types.PropertyGroup):
    """Values of the program's exported parameters, as custom properties: engine/to_blender/parameters.py."""


class TRGSceneSettings(bpy.types.PropertyGroup):
    """How TRG renders a scene."""

    program: bpy.props.PointerProperty(  # type: ignore[valid-type]
        name="Program",
        description="Text that builds the scene before each frame; without one the scene renders as it is",
        type=bpy.types.Text,
        update=_offer_parameters,
    )
    parameters: bpy.props.PointerProperty(type=TRGParameters)  # type: ignore[valid-type]
    run_on_load: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Run on Load",
        description="Build the scene when the file is opened, where Auto Run Python Scripts allows it",
        default=False,
    )
    samples: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Samples", description="Light paths traced for each pixel", default=64, min=1, soft_max=4096
    )
    preview_samples: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Viewport Samples",
        description="Light paths traced for each pixel of a rendered viewport; 0 is no limit",
        default=256,
        min=0,
        soft_max=4096,
    )
    use_time_limit: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Time Limit", description="Stop a frame after some seconds of tracing", default=False
    )
    time_limit: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Seconds",
        description="Wall-clock seconds of tracing for each frame",
        default=60.0,
        min=0.01,
        soft_max=3600.0,
        subtype="TIME_ABSOLUTE",
    )
    use_error_target: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Error Target",
        description="Stop a frame when its estimated error is small enough",
        default=False,
    )
    error_target: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="RMSE",
        description="Root of the mean squared error of the linear picture at which the render stops",
        default=0.01,
        min=1e-6,
        soft_max=1.0,
        precision=4,
        step=0.1,
    )
    use_adaptive: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Adaptive Sampling",
        description="With a time limit or an error target, spend more samples where there is more noise",
        default=True,
    )
    seed: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Seed", description="Changes the noise; equal seeds give equal pictures", default=0, min=0
    )
    max_bounces: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Max Bounces",
        description="Times that light may scatter after the first surface; 0 is direct light only",
        default=12,
        min=0,
        max=1024,
    )
    diffuse_bounces: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Diffuse",
        description="Diffuse bounces after the first; 1024 is no limit beside the total",
        default=NO_LIMIT,
        min=0,
        max=NO_LIMIT,
    )
    glossy_bounces: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Glossy",
        description="Glossy bounces after the first; 1024 is no limit beside the total",
        default=NO_LIMIT,
        min=0,
        max=NO_LIMIT,
    )
    transmission_bounces: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Transmission",
        description="Transmission bounces after the first; 1024 is no limit beside the total",
        default=NO_LIMIT,
        min=0,
        max=NO_LIMIT,
    )
    transparent_bounces: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Transparent",
        description="Surfaces that rays go straight through; 1024 is no limit",
        default=NO_LIMIT,
        min=0,
        max=NO_LIMIT,
    )
    clamp_direct: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Direct Light",
        description="Limit for what one sample of direct light brings, 0 is none: less noise, less light",
        default=0.0,
        min=0.0,
        soft_max=100.0,
    )
    clamp_indirect: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Indirect Light",
        description="Limit for what one sample of indirect light brings, 0 is none: less noise, less light",
        default=0.0,
        min=0.0,
        soft_max=100.0,
    )
    caustics_reflective: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Reflective", description="Light that surfaces reflect onto diffuse ones", default=True
    )
    caustics_refractive: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Refractive", description="Light that surfaces refract onto diffuse ones", default=True
    )
    filter_type: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Pixel Filter", description="How the light about a pixel makes its colour", items=FILTERS
    )
    filter_width: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Width",
        description="Width of the bell in pixels, as Cycles means it; a box is always one pixel wide",
        default=1.5,
        min=0.01,
        max=10.0,
        subtype="PIXEL",
    )
    device: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Device", description="What traces the rays", items=DEVICES, default="auto"
    )
    accel: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Accelerator", description="Structure that finds the nearest surface", items=ACCELERATORS
    )
    integrator: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Integrator", description="How light is gathered", items=INTEGRATORS
    )
    aa: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Antialiasing", description="Which points of a pixel are sampled", items=ANTIALIASINGS
    )
    aa_side: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Grid",
        description="Cells along the side of a pixel for supersampling, jittering and multi-frame",
        default=4,
        min=1,
        max=64,
    )


class TRGViewLayerSettings(bpy.types.PropertyGroup):
    """Passes that Blender itself has no switch for."""

    use_pass_denoising: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Denoising Data",
        description="Albedo and normal for the Denoise node of the compositor",
        default=False,
    )
    use_pass_sample_count: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Sample Count", description="Samples that each pixel got", default=False
    )
    use_pass_standard_error: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Standard Error",
        description="Standard error of each pixel's luminance, and where it is not to be believed "
        "(1: no light seen, 2: one replicate alone has it)",
        default=False,
    )


CLASSES = (TRGParameters, TRGSceneSettings, TRGViewLayerSettings)


def register() -> None:
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.trg = bpy.props.PointerProperty(type=TRGSceneSettings)
    bpy.types.ViewLayer.trg = bpy.props.PointerProperty(type=TRGViewLayerSettings)


def unregister() -> None:
    del bpy.types.ViewLayer.trg
    del bpy.types.Scene.trg
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
