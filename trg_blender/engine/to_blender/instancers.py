"""Many copies of one mesh and material as one object: points, and a geometry-nodes tree that puts the
mesh on each. Ten thousand copies cost milliseconds so, and seconds as objects.
"""

from __future__ import annotations

import bpy
import numpy as np

from .tags import OWNER
from .transforms import Decomposition

ROTATION = "trg_rot"
SCALE = "trg_scale"
MODIFIER_NAME = "TRG copies"


def write_points(mesh: bpy.types.Mesh, poses: Decomposition) -> None:
    """One point a copy, with its rotation and scale; all in Blender's world."""
    count = len(poses.locations)
    if len(mesh.vertices) != count:
        mesh.clear_geometry()
        mesh.vertices.add(count)
    mesh.vertices.foreach_set("co", _flat(poses.locations))
    rotation = mesh.attributes.get(ROTATION) or mesh.attributes.new(ROTATION, "QUATERNION", "POINT")
    rotation.data.foreach_set("value", _flat(poses.rotations))
    # Adding a layer may move the others: look the second one up only now.
    scale = mesh.attributes.get(SCALE) or mesh.attributes.new(SCALE, "FLOAT_VECTOR", "POINT")
    scale.data.foreach_set("vector", _flat(poses.scales))
    mesh.update()


def source_of(instancer: bpy.types.Object) -> bpy.types.Object | None:
    """The object that the instancer copies: it stands in no collection, so that it is not seen itself."""
    modifier = instancer.modifiers.get(MODIFIER_NAME)
    if modifier is None or modifier.node_group is None:
        return None
    node = next((n for n in modifier.node_group.nodes if n.bl_idname == "GeometryNodeObjectInfo"), None)
    return None if node is None else node.inputs["Object"].default_value


def attach_source(instancer: bpy.types.Object, source: bpy.types.Object, owner: str) -> None:
    """Give the instancer its node tree; `owner` is the scene's id, for `remove_leftovers`."""
    modifier = instancer.modifiers.get(MODIFIER_NAME) or instancer.modifiers.new(MODIFIER_NAME, "NODES")
    old = modifier.node_group
    modifier.node_group = _new_tree(instancer.name, source)
    modifier.node_group[OWNER] = source[OWNER] = owner
    if old is not None and old.users == 0:
        bpy.data.node_groups.remove(old)


def remove_leftovers(owner: str) -> None:
    """Remove sources and trees whose instancer is gone."""
    trees = [tree for tree in bpy.data.node_groups if tree.get(OWNER) == owner and tree.users == 0]
    if trees:
        bpy.data.batch_remove(trees)
    sources = [obj for obj in bpy.data.objects if obj.get(OWNER) == owner and obj.users == 0]
    if sources:
        bpy.data.batch_remove(sources)


def _new_tree(name: str, source: bpy.types.Object) -> bpy.types.NodeTree:
    tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    nodes, link = tree.nodes, tree.links.new
    points, result = nodes.new("NodeGroupInput"), nodes.new("NodeGroupOutput")
    info = nodes.new("GeometryNodeObjectInfo")
    info.inputs["Object"].default_value = source
    info.inputs["As Instance"].default_value = True
    put = nodes.new("GeometryNodeInstanceOnPoints")
    link(put.inputs["Points"], points.outputs[0])
    link(put.inputs["Instance"], info.outputs["Geometry"])
    link(put.inputs["Rotation"], _attribute(tree, ROTATION, "QUATERNION"))
    link(put.inputs["Scale"], _attribute(tree, SCALE, "FLOAT_VECTOR"))
    link(result.inputs[0], put.outputs["Instances"])
    for column, node in enumerate((points, info, put, result)):
        node.location = (250 * column, 0)
    return tree


def _attribute(tree: bpy.types.NodeTree, name: str, data_type: str) -> bpy.types.NodeSocket:
    node = tree.nodes.new("GeometryNodeInputNamedAttribute")
    node.data_type = data_type
    node.inputs["Name"].default_value = name
    node.location = (250, -250 if name == ROTATION else -450)
    return next(socket for socket in node.outputs if socket.enabled and socket.name == "Attribute")


def _flat(values: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(values, dtype=np.float32).reshape(-1)
