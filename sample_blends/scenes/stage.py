# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials, placing, instances, modifiers and the camera: what every scene does with its meshes."""

from __future__ import annotations

from collections.abc import Sequence
from math import radians
from typing import Any

import bpy
from bpy.types import Collection, Material, Object
from mathutils import Vector

from . import shapes

Color = tuple[float, float, float]
Point = tuple[float, float, float]


def material(name: str, color: Color, *, roughness: float = 1.0, specular: float = 0.0,
             metallic: float = 0.0, transmission: float = 0.0) -> Material:
    """A Principled BSDF; diffuse as long as nothing else is asked for. `specular` 0.5 is ordinary varnish or glass."""
    shader, made = _principled(name)
    shader.inputs["Base Color"].default_value = (*color, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Specular IOR Level"].default_value = specular
    shader.inputs["Metallic"].default_value = metallic
    shader.inputs["Transmission Weight"].default_value = transmission
    made.diffuse_color = (*color, 1.0)
    return made


def emitter(name: str, color: Color, strength: float) -> Material:
    """A black surface that sends out the radiance color * strength [W m^-2 sr^-1]."""
    made = material(name, (0.0, 0.0, 0.0))
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Emission Color"].default_value = (*color, 1.0)
    shader.inputs["Emission Strength"].default_value = strength
    made.diffuse_color = (*color, 1.0)
    return made


def _principled(name: str) -> tuple[Any, Material]:
    made = bpy.data.materials.new(name)
    return nodes(made)["Principled BSDF"], made


def nodes(owner: Any) -> Any:
    """The nodes of a material or world. Blender 5 makes the tree at birth and warns of `use_nodes`, 4 waits for it."""
    if owner.node_tree is None:
        owner.use_nodes = True
    return owner.node_tree.nodes


def place(data: Any, at: Point = (0, 0, 0), turn: Point = (0, 0, 0), size: float | Point = 1.0,
          name: str = "") -> Object:
    """Show `data` (mesh, lamp, camera) in the scene: `turn` in radians about X, Y, Z; shared by as many as place it."""
    thing = bpy.data.objects.new(name or data.name, data)
    thing.location, thing.rotation_euler = at, turn
    thing.scale = (size, size, size) if isinstance(size, (int, float)) else size
    bpy.context.scene.collection.objects.link(thing)
    return thing


def dress(thing: Object, material: Material) -> Object:
    """Give `thing` its own `material` in the first slot, whatever the mesh that it shares with others has there."""
    thing.material_slots[0].link = "OBJECT"
    thing.material_slots[0].material = material
    return thing


def group(name: str, things: Sequence[Object]) -> Collection:
    """Take `things` out of the scene into a collection that is seen only where `place_group` shows it."""
    collection = bpy.data.collections.new(name)
    for thing in things:
        bpy.context.scene.collection.objects.unlink(thing)
        collection.objects.link(thing)
    return collection


def place_group(collection: Collection, at: Point, turn: float, size: float = 1.0) -> Object:
    """An instance of all of `collection`, turned by `turn` radians about Z."""
    empty = place(None, at, (0.0, 0.0, turn), size, collection.name)
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    return empty


def suzanne(material: Material, at: Point, size: float, turn: float) -> Object:
    """Suzanne, smooth, 2.7 * size m wide, resting at `at`, turned by `turn` radians from facing -Y.

    Tilted back by 36 degrees she lies on chin and nape; her origin is then 0.51 * size above them.
    """
    resting = (at[0], at[1], at[2] + 0.51 * size)
    return subdivide(place(shapes.monkey("Suzanne", material), resting, (radians(-36), 0.0, turn), size), 2)


def subdivide(thing: Object, levels: int) -> Object:
    """Catmull-Clark subdivision, equally deep in the viewport and in the render."""
    modifier = thing.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = levels
    return thing


def repeat(thing: Object, count: int, step: Point) -> Object:
    """`count` copies of `thing`, `step` metres apart in its own space, by an Array modifier."""
    modifier = thing.modifiers.new("Array", "ARRAY")
    modifier.count, modifier.use_relative_offset, modifier.use_constant_offset = count, False, True
    modifier.constant_offset_displace = step
    return thing


def aim(thing: Object, target: Point) -> Object:
    """Turn a lamp or camera so that it looks at `target`, upright."""
    thing.rotation_euler = (Vector(target) - thing.location).to_track_quat("-Z", "Y").to_euler()
    return thing


def camera(at: Point, target: Point, lens: float) -> Object:
    """The scene's camera; `lens` in millimetres on the 36 mm sensor."""
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    bpy.context.scene.camera = aim(place(data, at), target)
    return bpy.context.scene.camera
