# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender says has changed. It names too much rather than too little; where it says nothing, others look."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import Any

import bpy

Uid = Hashable

# Objects that show nothing themselves: what hangs on them is named too
_SHOW_NOTHING = {"CAMERA", "SPEAKER", "LIGHT_PROBE", "ARMATURE", "LATTICE"}

def _types(*names: str) -> tuple[type, ...]:
    """Those of Blender's types that this version has."""
    return tuple(getattr(bpy.types, name) for name in names if hasattr(bpy.types, name))


_GEOMETRY = _types("Mesh", "Curve", "MetaBall", "Curves", "PointCloud", "Volume", "GreasePencil", "GreasePencilv3")

# Named along with the objects that they change, or of no effect on the picture
_NOT_READ = _types("Light", "Camera", "Armature", "Lattice", "Key", "ParticleSettings", "VectorFont", "Speaker",
                   "LightProbe", "GeometryNodeTree", "Action", "Text", "Brush", "Sound", "Library", "WindowManager",
                   "WorkSpace", "Screen", "Palette", "PaintCurve", "Mask", "MovieClip", "Texture",
                   "FreestyleLineStyle", "CacheFile", "Annotation", "CompositorNodeTree", "TextureNodeTree")


def uid_of(original: Any) -> Uid:
    """What an original datablock keeps for life, also over undo, which an address or a name is not."""
    return getattr(original, "session_uid", 0) or (type(original).__name__, original.name_full)


@dataclass
class Changes:
    """Evaluated datablocks by uid; those of `geometry` and `images` by uid alone.

    moved            objects of which nothing but their place has changed
    lamps            lamps of which anything has
    geometry         objects and their data, whose triangles are others
    materials        materials with other values
    reloaded         materials of which nothing has changed, unless they are named because an image was loaded anew
    has_scene        the scene or a view layer: objects may have been hidden or shown, selected, or nothing at all
    has_collections  what they instance may stand elsewhere
    has_placing      objects may show other things than they did
    is_unclear       all must be read
    """

    moved: dict[Uid, Any] = field(default_factory=dict)
    lamps: dict[Uid, Any] = field(default_factory=dict)
    geometry: set[Uid] = field(default_factory=set)
    materials: dict[Uid, Any] = field(default_factory=dict)
    reloaded: dict[Uid, Any] = field(default_factory=dict)
    images: set[Uid] = field(default_factory=set)
    has_world: bool = False
    has_scene: bool = False
    has_collections: bool = False
    has_placing: bool = False
    is_unclear: bool = False


def changes_of(depsgraph: Any) -> Changes:
    """All that `depsgraph.updates` names, sorted."""
    found, shaded, has_trees, has_lights, has_actions = Changes(), False, False, False, False
    for update in depsgraph.updates:
        thing = update.id
        if isinstance(thing, bpy.types.Object):
            shaded |= _note_object(found, thing, update)
        elif isinstance(thing, bpy.types.ShaderNodeTree):
            has_trees = True
        else:
            has_lights |= isinstance(thing, bpy.types.Light)
            has_actions |= isinstance(thing, bpy.types.Action)
            _note_data(found, thing, update)
    if found.has_scene:  # undo may bring back what a frame change has made of a material, and names it as nothing
        found.materials.update(found.reloaded)
    has_shaders = bool(found.materials or found.reloaded or found.images)
    # An object is named as shaded with each of its materials, and for its own settings. A script that changes both at
    # once, and moves nothing, has the latter seen at the next walk
    is_of_materials = has_shaders and not (found.has_scene or found.moved or has_actions)
    found.has_placing |= shaded and not is_of_materials
    found.is_unclear |= has_trees and not (has_shaders or found.has_world or has_lights)
    return found


def _note_object(found: Changes, thing: Any, update: Any) -> bool:
    """Note an object; whether it is named for its materials, or for settings of its own."""
    is_moved, is_reshaped = update.is_updated_transform, update.is_updated_geometry
    kind = thing.type
    if kind == "LIGHT":
        is_place = is_moved and not (is_reshaped or update.is_updated_shading)
        (found.moved if is_place else found.lamps)[uid_of(thing.original)] = thing
        return False
    if is_moved:
        found.moved[uid_of(thing.original)] = thing
    if kind in _SHOW_NOTHING:
        return False
    if is_reshaped:
        found.geometry.add(uid_of(thing.original))
        found.has_placing = True
    found.has_placing |= not (is_moved or update.is_updated_shading)
    return update.is_updated_shading


def _note_data(found: Changes, thing: Any, update: Any) -> None:
    uid = uid_of(thing.original)
    if isinstance(thing, bpy.types.Scene):
        found.has_scene = True
    elif isinstance(thing, bpy.types.Collection):
        found.has_scene = found.has_collections = True
    elif isinstance(thing, bpy.types.Material):
        if update.is_updated_shading:
            found.materials[uid] = thing
        else:
            found.reloaded[uid] = thing
    elif isinstance(thing, bpy.types.World):
        found.has_world = True
    elif isinstance(thing, bpy.types.Image):
        found.images.add(uid)
    elif isinstance(thing, _GEOMETRY):
        if update.is_updated_geometry:
            found.geometry.add(uid)
            found.has_placing = True
    elif not isinstance(thing, _NOT_READ):
        found.is_unclear = True
