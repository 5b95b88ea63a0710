"""A program's scene in a scene of Blender: built once, then changed where the program changed it.

Everything the mirror must remember stands in the .blend, as custom properties; what `SceneMirror` keeps
besides only saves work, so that undo, redo and loading need no care.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import bpy
from mathutils import Matrix

from ...lang.scene import CameraRecord, LightRecord, SceneDescription, ShapeRecord, TextureRecord
from . import instancers
from .camera import camera_matrix, write_camera, write_picture_size
from .images import ImageStore
from .lights import light_matrix, new_light, write_falloff, write_light
from .materials import MaterialStore
from .meshes import build_mesh, meshes_by_key
from .model_files import model_key, read_contents
from .objects import ObjectStore, pose_of_matrix, set_material, set_pose, write_shape_properties
from .placement import MeshRecipe
from .plan import CopyGroup, FramePlan, PlannedShape, Planner, poses_of
from .tags import KIND, MESH, ORIGIN, OWNER, fingerprint, mirror_collection
from .world import write_world

CAMERA_KEY = "camera"
INSTANCER_KIND = "copies"


@dataclass(frozen=True, slots=True)
class MirrorCounts:
    """What one `apply` wrote."""

    made: int = 0
    updated: int = 0
    deleted: int = 0
    """objects: shapes, instancers, lights, camera"""
    meshes_made: int = 0
    materials_made: int = 0
    materials_updated: int = 0
    worlds_updated: int = 0

    @property
    def total(self) -> int:
        objects = self.made + self.updated + self.deleted
        return objects + self.meshes_made + self.materials_made + self.materials_updated + self.worlds_updated


@dataclass(frozen=True, slots=True)
class _Frame:
    """What the writers of one frame share."""

    owner: str
    plan: FramePlan
    meshes: dict[str, bpy.types.Mesh]
    materials: MaterialStore
    objects: ObjectStore

    def material_of(self, planned: PlannedShape) -> bpy.types.Material | None:
        record = self.plan.material_of(planned)
        return None if record is None else self.materials.material_of(record)


class SceneMirror:
    """Keeps the TRG collection of one scene equal to what its program describes."""

    def __init__(self, scene: bpy.types.Scene, planner: Planner | None = None) -> None:
        """`planner`: one from `new_planner`, to go on from; it holds nothing of Blender's, so that it may
        outlive an undo, where the mirror itself may not."""
        self._scene = scene
        self._planner = planner if planner is not None else new_planner()
        self.warnings: list[str] = []
        """what the last `apply` had to mend in files, and where it used a placeholder"""

    def apply(self, description: SceneDescription) -> MirrorCounts:
        """Make the scene equal to the description, touching only what differs.

        Raises SceneError before anything is changed when the description or a file it names is wrong.
        """
        scene = self._scene
        meshes = meshes_by_key()
        images = ImageStore()
        try:
            plan = self._planner.plan(description, meshes)
            _prepare_images(plan, description, images)
        except BaseException:
            images.roll_back()
            raise
        self.warnings = [text for contents in plan.new_meshes.values() for text in contents.warnings]
        collection = mirror_collection(scene)
        owner = collection[OWNER]
        materials = MaterialStore(owner, images)
        frame = _Frame(owner, plan, meshes, materials, ObjectStore(scene, collection))
        _write_objects(frame, description)
        if description.camera is not None:
            write_picture_size(scene, description.camera)
            camera = frame.objects.get(CAMERA_KEY)
            if camera is not None and scene.camera != camera:
                scene.camera = camera
        worlds_updated = int(write_world(scene, owner, description, images))
        _keep_modes(collection, description)
        _remove_unused(frame)
        objects = frame.objects
        self.warnings += [*objects.warnings, *materials.warnings]
        return MirrorCounts(
            objects.made,
            objects.updated,
            objects.deleted,
            len(plan.new_meshes),
            materials.made,
            materials.updated,
            worlds_updated,
        )


def new_planner() -> Planner:
    """What a mirror works out once and may remember over frames."""
    return Planner(_model_recipe)


def requested_modes(scene: bpy.types.Scene) -> dict[str, str | int]:
    """What the scene's program asked for by std::set...: those of device, accel, antialiasing and
    antialiasing_n that it named. A user's own choice in the panel comes first."""
    for collection in scene.collection.children:
        if OWNER in collection:
            names = ("device", "accel", "antialiasing", "antialiasing_n")
            return {name: collection[f"trg_{name}"] for name in names if f"trg_{name}" in collection}
    return {}


def _model_recipe(shape: ShapeRecord) -> MeshRecipe:
    return MeshRecipe(model_key(shape), partial(read_contents, shape))


def _prepare_images(plan: FramePlan, description: SceneDescription, images: ImageStore) -> None:
    """Read every picture of the frame; raise SceneError for a damaged one."""
    records = list(plan.materials.values())
    for contents in plan.new_meshes.values():
        images.embedded.update(contents.images)
        records += contents.materials
    for record in {record.key: record for record in records}.values():
        images.prepare_all(record)
    if isinstance(description.background, TextureRecord):
        images.prepare(description.background, is_color=True)


def _write_objects(frame: _Frame, description: SceneDescription) -> None:
    for key, contents in frame.plan.new_meshes.items():
        mesh = build_mesh(key.partition(":")[0], key, contents.mesh)
        for slot, record in enumerate(contents.materials[: len(mesh.materials)]):
            mesh.materials[slot] = frame.materials.material_of(record)
        frame.meshes[key] = mesh
    for planned in frame.plan.singles:
        _write_single(frame, planned)
    for group in frame.plan.groups:
        _write_group(frame, group)
    for light in description.lights:
        _write_light(frame, light)
    if description.camera is not None:
        _write_camera(frame, description.camera)
    frame.objects.finish()


def _write_single(frame: _Frame, planned: PlannedShape) -> None:
    shape = planned.shape
    material = frame.material_of(planned)
    record = frame.plan.material_of(planned)
    digest = fingerprint(planned.digest, None if record is None else record.key)
    if frame.objects.unchanged(shape.key, digest):
        return
    obj = frame.objects.write(shape.key, digest, shape.name or shape.key, frame.meshes[planned.recipe.key])
    set_pose(obj, pose_of_matrix(Matrix(planned.matrix.tolist())))
    write_shape_properties(obj, shape, planned.recipe)
    set_material(obj, material)


def _write_group(frame: _Frame, group: CopyGroup) -> None:
    """One object for all copies; its source stands in no collection."""
    first = group.copies[0].shape
    material = frame.material_of(group.copies[0])
    digest = fingerprint([planned.digest for planned in group.copies])
    if frame.objects.unchanged(group.key, digest):
        return
    old = frame.objects.get(group.key)
    points = old.data if old is not None else bpy.data.meshes.new(group.key)
    points[OWNER] = frame.owner
    instancers.write_points(points, poses_of(group))
    obj = frame.objects.write(group.key, digest, group.key, points)
    obj[KIND], obj[ORIGIN] = INSTANCER_KIND, str(first.origin or "")
    mesh = frame.meshes[group.mesh_key]
    source = instancers.source_of(obj)
    if source is None or source.data != mesh:
        source = bpy.data.objects.new(f"source of {group.key}", mesh)
        instancers.attach_source(obj, source, frame.owner)
    write_shape_properties(source, first, group.copies[0].recipe)
    set_material(source, material)
    obj.update_tag()


def _write_light(frame: _Frame, record: LightRecord) -> None:
    digest = fingerprint(replace(record, version=0))
    if frame.objects.unchanged(record.key, digest):
        return
    old = frame.objects.get(record.key)
    light = write_light(old.data if old is not None else new_light(record), record)
    light[OWNER] = frame.owner
    obj = frame.objects.write(record.key, digest, record.name or record.key, light)
    obj[KIND], obj[ORIGIN] = record.kind, str(record.origin or "")
    write_falloff(obj, record)
    set_pose(obj, pose_of_matrix(light_matrix(record)))


def _write_camera(frame: _Frame, record: CameraRecord) -> None:
    digest = fingerprint(record)
    if frame.objects.unchanged(CAMERA_KEY, digest):
        return
    old = frame.objects.get(CAMERA_KEY)
    camera = old.data if old is not None else bpy.data.cameras.new("TRG camera")
    camera[OWNER] = frame.owner
    write_camera(camera, record)
    obj = frame.objects.write(CAMERA_KEY, digest, "TRG camera", camera)
    obj[KIND], obj[ORIGIN] = "camera", str(record.origin or "")
    set_pose(obj, pose_of_matrix(camera_matrix(record)))


def _keep_modes(collection: bpy.types.Collection, description: SceneDescription) -> None:
    """Keep what the program asked for where `requested_modes` finds it."""
    modes = description.modes
    wanted = {"device": modes.device, "accel": modes.accel, "antialiasing": modes.antialiasing}
    numbers = {"antialiasing_n": modes.antialiasing_n if modes.antialiasing is not None else None}
    for name, value in {**wanted, **numbers}.items():
        key = f"trg_{name}"
        if value is None:
            if key in collection:
                del collection[key]
        elif collection.get(key) != value:
            collection[key] = value


def _remove_unused(frame: _Frame) -> None:
    """Remove what the mirror made and nothing uses any more."""
    instancers.remove_leftovers(frame.owner)
    unused: list[bpy.types.ID] = [mesh for mesh in bpy.data.meshes if mesh.users == 0 and MESH in mesh]
    for blocks in (bpy.data.meshes, bpy.data.lights, bpy.data.cameras):
        unused += [block for block in blocks if block.users == 0 and block.get(OWNER) == frame.owner]
    if unused:
        bpy.data.batch_remove(unused)
    frame.materials.remove_unused()
