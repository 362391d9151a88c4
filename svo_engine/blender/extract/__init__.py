# SPDX-License-Identifier: GPL-3.0-or-later
"""From Blender's evaluated depsgraph to the core's Scene. Nothing of the user's is changed, nothing is kept."""

from __future__ import annotations

from typing import Any

import bpy

from ...errors import SceneError
from ...scene.types import Camera, Scene
from .camera import border, read_camera
from .images import Images
from .materials import Materials
from .placing import Placing, matrices_of, visits
from .textures import Textures
from .visibility import is_seen
from .world import read_world

__all__ = ["border", "extract", "scene_camera"]


def extract(depsgraph: bpy.types.Depsgraph, *, space: bpy.types.SpaceView3D | None = None,
            needs_camera: bool | None = None) -> Scene:
    """All that `depsgraph` shows, copied. What could not be taken as it is has a sentence in the Scene's warnings.

    space         the 3D viewport that is drawn: what is hidden in it alone is left out
    needs_camera  raise SceneError if there is no camera; default: for a final render
    """
    notes: dict[str, None] = {}
    warn = notes.setdefault
    scene, layer = depsgraph.scene_eval, depsgraph.view_layer_eval
    images = Images(warn)
    textures = Textures(images)
    materials = Materials(textures, images, warn)
    placing = Placing(materials, depsgraph, warn)
    for instance, matrix in visits(depsgraph, matrices_of(depsgraph)):
        if instance.show_self and is_seen(instance, space):
            placing.visit(instance, matrix)
    for light in placing.lights:
        images.add_named(light.graph)
    world = read_world(getattr(layer, "world_override", None) or scene.world, images, warn)
    return Scene(
        meshes=tuple(placing.meshes), instances=placing.instances(), materials=tuple(materials.found),
        textures=tuple(textures.found), images=tuple(images.found), lights=tuple(placing.lights), world=world,
        camera=scene_camera(depsgraph, warn, depsgraph.mode == "RENDER" if needs_camera is None else needs_camera),
        film_transparent=scene.render.film_transparent, warnings=tuple(notes))


def scene_camera(depsgraph: Any, warn: Any, is_needed: bool) -> Camera | None:
    """The scene's camera; without any None, or SceneError if it is needed."""
    scene = depsgraph.scene_eval
    if scene.camera is not None:
        return read_camera(scene.camera.evaluated_get(depsgraph), scene.render, warn)
    if is_needed:
        raise SceneError(f"Scene '{scene.name}' has no camera")
    return None
