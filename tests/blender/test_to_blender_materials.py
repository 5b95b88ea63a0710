"""Materials of a program as node trees: sockets, textures, placeholders, models that bring their own."""

from __future__ import annotations

import os
import struct
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from trg_blender.engine.formats import Model, ModelMaterial, ModelTexture, Primitive, write_g3dm  # noqa: E402
from trg_blender.engine.to_blender import SceneMirror  # noqa: E402
from trg_blender.engine.to_blender.materials import socket_of  # noqa: E402
from trg_blender.lang.scene import MaterialRecord, SceneDescription, ShapeRecord, TextureRecord  # noqa: E402

SHARED = Path(os.environ.get("TRG_SHARED", Path(__file__).resolve().parents[3] / "shared"))
FULL = MaterialRecord(
    "m", 1, "full", base_color=(0.1, 0.2, 0.3), metallic=0.4, roughness=0.6, ior=1.7, transmission=0.25,
    emission_color=(1.0, 0.5, 0.0), emission_strength=2.0, phong_power=51.2,
)  # fmt: skip


@pytest.fixture
def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene


def sphere(material: MaterialRecord | None) -> ShapeRecord:
    return ShapeRecord("s", 1, "sphere", ((0.0, 0.0, 0.0), 1.0), "s", material)


def model(path: Path | str | None, material: MaterialRecord | None = None, **more) -> ShapeRecord:
    return ShapeRecord(
        "m", 1, "model", ("file",), "m", material, path=None if path is None else str(path), **more
    )


def applied(scene, material: MaterialRecord) -> bpy.types.Material:
    SceneMirror(scene).apply(SceneDescription(1, (sphere(material),)))
    (obj,) = scene.objects
    return obj.material_slots[0].material


def shader_of(material: bpy.types.Material) -> bpy.types.Node:
    return next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")


def image_nodes(material: bpy.types.Material) -> list[bpy.types.Node]:
    return [node for node in material.node_tree.nodes if node.type == "TEX_IMAGE"]


def write_g24(path: Path, rows: list[list[tuple[int, int, int]]]) -> Path:
    """Rows top first, colours r g b."""
    data = struct.pack("<HH", len(rows[0]), len(rows))
    path.write_bytes(data + bytes(c for row in rows for r, g, b in row for c in (b, g, r)))
    return path


def test_every_number_reaches_its_socket(scene):
    shader = shader_of(applied(scene, FULL))
    value = lambda slot: socket_of(shader, slot).default_value  # noqa: E731
    assert tuple(value("base_color")) == pytest.approx((0.1, 0.2, 0.3, 1.0))
    assert tuple(value("emission")) == pytest.approx((1.0, 0.5, 0.0, 1.0))
    numbers = [value(s) for s in ("metallic", "roughness", "ior", "transmission", "emission_strength")]
    assert numbers == pytest.approx([0.4, 0.6, 1.7, 0.25, 2.0])


def test_the_phong_row_is_kept_beside(scene):
    assert applied(scene, FULL)["trg_phong_power"] == pytest.approx(51.2)


def test_textures_are_tiled_and_linked_to_their_sockets(scene, tmp_path):
    path = str(write_g24(tmp_path / "a.g24", [[(255, 0, 0), (0, 255, 0)]]))
    slots = ("base_color", "roughness", "metallic", "normal", "emission")
    textures = tuple((slot, TextureRecord(f"t{slot}", "a.g24", path, 2.0)) for slot in slots)
    material = applied(scene, replace(FULL, textures=textures))
    shader = shader_of(material)
    assert len(image_nodes(material)) == 5
    for slot in slots:
        source = socket_of(shader, slot).links[0].from_node
        if slot == "normal":
            assert source.type == "NORMAL_MAP"
            source = source.inputs["Color"].links[0].from_node
        mapping = source.inputs["Vector"].links[0].from_node
        assert tuple(mapping.inputs["Scale"].default_value) == (2.0, 2.0, 1.0)
        assert mapping.inputs["Vector"].links[0].from_node.type == "UVMAP"
        is_color = slot in ("base_color", "emission")
        assert source.image.colorspace_settings.name == ("sRGB" if is_color else "Non-Color")
    assert len(bpy.data.images) == 2


def test_g24_pixels_arrive_unchanged_with_the_last_row_at_the_bottom(scene, tmp_path):
    rows = [[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (10, 20, 30)]]
    path = write_g24(tmp_path / "a.g24", rows)
    record = replace(FULL, textures=(("base_color", TextureRecord("t", "a.g24", str(path))),))
    image = image_nodes(applied(scene, record))[0].image
    pixels = np.array(image.pixels[:]).reshape(2, 2, 4)
    expected = np.array([rows[1], rows[0]]) / 255.0
    np.testing.assert_allclose(pixels[..., :3], expected, atol=1e-6)
    assert image.packed_file is not None


def test_a_changed_picture_is_read_again(scene, tmp_path):
    path = write_g24(tmp_path / "a.g24", [[(255, 0, 0)]])
    record = replace(FULL, textures=(("base_color", TextureRecord("t", "a.g24", str(path))),))
    mirror = SceneMirror(scene)
    mirror.apply(SceneDescription(1, (sphere(record),)))
    write_g24(path, [[(0, 0, 255), (0, 0, 255)]])
    mirror.apply(SceneDescription(2, (sphere(record),)))
    material = scene.objects[0].material_slots[0].material
    assert image_nodes(material)[0].image.size[0] == 2


def test_a_missing_texture_is_a_magenta_check(scene):
    record = replace(FULL, textures=(("base_color", TextureRecord("t", "chess.g24", None, 2.0)),))
    image = image_nodes(applied(scene, record))[0].image
    colors = {tuple(c) for c in np.array(image.pixels[:]).reshape(-1, 4).round(3)}
    assert colors == {(1.0, 0.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)}


def test_png_goes_through_blender(scene, tmp_path):
    picture = bpy.data.images.new("p", 3, 2)
    picture.filepath_raw, picture.file_format = str(tmp_path / "p.png"), "PNG"
    picture.save()
    bpy.data.images.remove(picture)
    record = replace(FULL, textures=(("base_color", TextureRecord("t", "p.png", str(tmp_path / "p.png"))),))
    assert tuple(image_nodes(applied(scene, record))[0].image.size) == (3, 2)


def test_a_value_edit_keeps_the_node_tree(scene):
    mirror = SceneMirror(scene)
    mirror.apply(SceneDescription(1, (sphere(FULL),)))
    material = scene.objects[0].material_slots[0].material
    note = material.node_tree.nodes.new("NodeFrame")
    note.label = "mine"
    mirror.apply(SceneDescription(2, (sphere(replace(FULL, version=2, roughness=0.125)),)))
    assert [n.label for n in material.node_tree.nodes if n.bl_idname == "NodeFrame"] == ["mine"]
    assert socket_of(shader_of(material), "roughness").default_value == 0.125


def quad_model() -> Model:
    vertices = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dtype=np.float32)
    uvs = vertices[:, :2].copy()
    normals = np.tile(np.float32((0, 0, 1)), (4, 1))
    colors = np.ones((4, 4), dtype=np.float32)
    triangles = np.array([(0, 1, 2), (0, 2, 3)], dtype=np.int32)
    part = Primitive(vertices, uvs, normals, colors, triangles, 0)
    bare = replace(part, vertices=vertices + np.float32((0, 0, 1)), material=-1)
    texture = ModelTexture("leaf.png", np.full((2, 2, 3), 128, dtype=np.uint8))
    painted = ModelMaterial("paint", diffuse=(0.5, 0.25, 0.125), phong_power=30.0, textures=(0,) + (-1,) * 7)
    return Model((part, bare), (painted,), (texture,))


def test_a_model_without_a_material_of_the_program_brings_its_own(scene, tmp_path):
    write_g3dm(tmp_path / "quad.g3dm", quad_model())
    SceneMirror(scene).apply(SceneDescription(1, (model(tmp_path / "quad.g3dm"),)))
    (obj,) = scene.objects
    assert [m.name for m in obj.data.materials] == ["paint", "none"]
    slots = np.empty(4, dtype=np.int32)
    obj.data.attributes["material_index"].data.foreach_get("value", slots)
    assert slots.tolist() == [0, 0, 1, 1]
    shader = shader_of(obj.data.materials[0])
    assert socket_of(shader, "roughness").default_value == pytest.approx(0.25)
    assert tuple(image_nodes(obj.data.materials[0])[0].image.size) == (2, 2)


def test_a_material_of_the_program_covers_the_whole_model(scene, tmp_path):
    write_g3dm(tmp_path / "quad.g3dm", quad_model())
    SceneMirror(scene).apply(SceneDescription(1, (model(tmp_path / "quad.g3dm", FULL),)))
    assert [slot.material.name for slot in scene.objects[0].material_slots] == ["full", "full"]


def test_stored_normals_of_a_model_are_kept(scene, tmp_path):
    tilted = quad_model()
    leaning = np.tile(np.float32((0.6, 0.0, 0.8)), (4, 1))
    first = replace(tilted.primitives[0], normals=leaning)
    write_g3dm(tmp_path / "quad.g3dm", replace(tilted, primitives=(first,)))
    SceneMirror(scene).apply(SceneDescription(1, (model(tmp_path / "quad.g3dm"),)))
    normals = np.array([n.vector for n in scene.objects[0].data.corner_normals])
    np.testing.assert_allclose(normals, np.tile((0.6, -0.8, 0.0), (6, 1)), atol=1e-3)


@pytest.mark.skipif(not (SHARED / "data/models/cow.g3dm").exists(), reason="shared/data/models is not here")
def test_the_papers_cow_stands_unscaled_on_the_ground(scene):
    SceneMirror(scene).apply(SceneDescription(1, (model(SHARED / "data/models/cow.g3dm"),)))
    bpy.context.view_layer.update()
    corners = np.array([tuple(c) for c in scene.objects[0].bound_box])
    assert (corners[:, 2].min(), corners[:, 2].max()) == pytest.approx((-0.11, 13.22), abs=0.01)


TETRAHEDRON = np.array([(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)], dtype=np.float32)
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def write_tetrahedron(path: Path) -> None:
    if path.suffix == ".obj":
        lines = [f"v {x} {y} {z}" for x, y, z in TETRAHEDRON] + [
            f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES
        ]
        path.write_text("\n".join(lines))
    elif path.suffix == ".ply":
        head = (
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        )
        head += "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        rows = [" ".join(map(str, v)) for v in TETRAHEDRON] + [f"3 {a} {b} {c}" for a, b, c in FACES]
        path.write_text(head + "\n".join(rows) + "\n")
    else:
        mesh = bpy.data.meshes.new("t")
        # Blender's exporter turns Z up to Y up: hand it TRG's axes turned.
        mesh.from_pydata([(x, -z, y) for x, y, z in TETRAHEDRON.tolist()], [], FACES)
        obj = bpy.data.objects.new("t", mesh)
        bpy.context.scene.collection.objects.link(obj)
        if path.suffix == ".glb":
            bpy.ops.export_scene.gltf(filepath=str(path), export_format="GLB")
        else:
            bpy.ops.wm.stl_export(filepath=str(path), forward_axis="NEGATIVE_Z", up_axis="Y")
        bpy.data.objects.remove(obj)
        bpy.data.meshes.remove(mesh)


@pytest.mark.parametrize("suffix", [".obj", ".ply", ".stl", ".glb"])
def test_models_of_other_formats_come_in_unscaled_with_y_up_and_leave_nothing_else(scene, tmp_path, suffix):
    path = tmp_path / f"t{suffix}"
    write_tetrahedron(path)
    SceneMirror(scene).apply(SceneDescription(1, (model(path, FULL),)))
    (obj,) = bpy.data.objects
    points = np.unique(np.array([tuple(v.co) for v in obj.data.vertices]).round(5), axis=0)
    expected = np.unique(np.array([(x, -z, y) for x, y, z in TETRAHEDRON]) + 0.0, axis=0)
    np.testing.assert_allclose(points, expected, atol=1e-5)
    assert len(bpy.data.meshes) == len(bpy.data.materials) == 1
    obj.data.calc_loop_triangles()
    volume = sum(
        np.linalg.det([tuple(obj.data.vertices[i].co) for i in t.vertices]) for t in obj.data.loop_triangles
    )
    assert volume / 6.0 == pytest.approx(1.0)
