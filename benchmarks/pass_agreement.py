"""Every pass of one scene by TRG and by Cycles in one Blender.

    .venv/3.13/bin/python -m benchmarks.pass_agreement [--samples 256] [--out DIR]

Both write a multi-layer EXR; for each pass the script says the mean of each, and the largest difference of a
region of 16 x 16 pixels relative to the mean of Cycles' pass. Light passes are noisy: more samples, less.
"""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from benchmarks.agree import prepare  # noqa: E402
from trg_blender.ui import registration  # noqa: E402

REGION = 16
SIZE = 96
OWN = ("use_pass_denoising", "use_pass_sample_count", "use_pass_standard_error")
OTHER_NAMES = {"Sample Count": "Debug Sample Count"}
"""our name -> Cycles'"""


def add_material(name: str, **inputs: Any) -> Any:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    for socket, value in inputs.items():
        shader.inputs[socket.replace("_", " ")].default_value = value
    return material


def add_ball(name: str, x: float, material: Any, parent: Any) -> None:
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.8, location=(x, 0.0, 0.8), segments=48, ring_count=24)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.name, ball.pass_index, ball.parent = name, 1 + len(bpy.data.objects), parent
    ball.data.materials.append(material)


def build_scene() -> Any:
    """Balls of clay, plastic, gold, glass and glow on a floor, under an area light and a pale sky."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.2, 0.3, 0.5, 1.0)
    scene.world.mist_settings.start, scene.world.mist_settings.depth = 5.0, 8.0
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    floor = bpy.context.object
    floor.name, floor.pass_index = "Floor", 7
    floor.data.materials.append(add_material("floor", Base_Color=(0.6, 0.6, 0.55, 1), Roughness=0.6))
    floor.data.materials[0].pass_index = 3
    group = bpy.data.objects.new("Balls", None)
    scene.collection.objects.link(group)
    kinds = {
        "Clay": {"Base_Color": (0.8, 0.3, 0.2, 1), "Specular_IOR_Level": 0.0, "Roughness": 1.0},
        "Plastic": {"Base_Color": (0.1, 0.4, 0.8, 1), "Roughness": 0.3},
        "Gold": {"Base_Color": (1.0, 0.7, 0.3, 1), "Metallic": 1.0, "Roughness": 0.2},
        "Glass": {"Base_Color": (0.9, 1.0, 0.9, 1), "Transmission_Weight": 1.0, "Roughness": 0.1},
        "Glow": {"Emission_Color": (1.0, 0.8, 0.6, 1), "Emission_Strength": 1.5},
    }
    for k, (name, inputs) in enumerate(kinds.items()):
        material = add_material(name.lower(), **inputs)
        material.pass_index = 10 + k
        add_ball(name, 1.8 * (k - 2), material, group)
    bpy.ops.object.light_add(type="AREA", location=(-2.0, -4.0, 6.0), rotation=(0.6, -0.3, 0.0))
    bpy.context.object.data.energy, bpy.context.object.data.size = 600.0, 2.0
    bpy.ops.object.camera_add(location=(0.0, -11.0, 4.5), rotation=(1.22, 0.0, 0.0))
    scene.camera = bpy.context.object
    scene.camera.data.lens = 45.0
    return scene


def ask_for_all(scene: Any) -> None:
    layer = scene.view_layers[0]
    for each in layer.bl_rna.properties:
        name = each.identifier
        if name.startswith("use_pass_") and "subsurface" not in name and "grease" not in name:
            setattr(layer, name, True)
    for name in OWN:
        setattr(layer.trg, name, True)
    layer.cycles.denoising_store_passes = layer.cycles.pass_debug_sample_count = True


def render_layers(scene: Any, engine: str, folder: Path) -> dict[str, NDArray[np.float64]]:
    """Pass -> (h, w, channels), bottom row first."""
    import OpenEXR

    scene.render.engine = engine
    path = folder / f"{engine}.exr"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    found = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = {name: one for part in file.parts for name, one in part.channels.items()}
        for name in sorted({each.rsplit(".", 1)[0] for each in channels}):
            order = sorted(
                (each for each in channels if each.rsplit(".", 1)[0] == name),
                key=lambda each: "RGBAXYZUVW".find(each[-1]),
            )
            stack = [np.asarray(channels[each].pixels, dtype=np.float64)[::-1] for each in order]
            found[name.split(".", 1)[-1]] = np.stack(stack, axis=-1)
    return found


def region_means(values: NDArray[np.float64]) -> NDArray[np.float64]:
    height, width, channels = values.shape
    rows, columns = height // REGION, width // REGION
    cut = values[: rows * REGION, : columns * REGION].reshape(rows, REGION, columns, REGION, channels)
    return cut.mean(axis=(1, 3))


def compare(ours: NDArray[np.float64], theirs: NDArray[np.float64]) -> str:
    count = min(ours.shape[-1], theirs.shape[-1])
    near = (np.abs(ours[..., :count]) < 1e9).all(axis=-1) & (np.abs(theirs[..., :count]) < 1e9).all(axis=-1)
    a, b = (np.where(near[..., None], each[..., :count], 0.0) for each in (ours, theirs))
    scale = max(float(np.abs(b).mean()), 1e-12)
    worst = float(np.abs(region_means(a) - region_means(b)).max()) / scale
    return f"TRG {a.mean():10.5f}  Cycles {b.mean():10.5f}  worst region {100 * worst:7.2f} % of the mean"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--out", type=Path, default=None)
    options = parser.parse_args()
    folder = options.out or Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    registration.register()
    scene = build_scene()
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    prepare(scene, options.samples)
    if hasattr(scene.render.image_settings, "media_type"):
        scene.render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    ask_for_all(scene)
    ours, theirs = (render_layers(scene, engine, folder) for engine in ("TRG", "CYCLES"))
    for name, values in ours.items():
        if not math.isfinite(float(values.sum())):
            print(f"{name}: not finite")
            return 1
        other = theirs.get(OTHER_NAMES.get(name, name))
        print(f"{name:22} " + (compare(values, other) if other is not None else f"TRG {values.mean():10.5f}"))
    print("Cycles alone:", ", ".join(sorted(set(theirs) - {OTHER_NAMES.get(n, n) for n in ours})))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
