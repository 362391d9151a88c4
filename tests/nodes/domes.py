# SPDX-License-Identifier: GPL-3.0-or-later
"""Worlds as pictures of all directions, by this engine and by Cycles."""

from __future__ import annotations

import math
from pathlib import Path

import bpy
import numpy as np

from svo_engine.blender.extract import extract
from svo_engine.gpu.device import Device
from svo_engine.nodes.sources import told, world_trees
from svo_engine.passes.sources import light_of_image
from svo_engine.scene.layouts import CONSTANTS
from svo_engine.scene.types import Scene
from tests.blender import cycles

SIZE = 64, 32


def look_around() -> None:
    """A camera that sees every direction, where `environment.py` has it."""
    data = bpy.data.cameras.new("Camera")
    data.type = "PANO"
    (data if hasattr(data, "panorama_type") else data.cycles).panorama_type = "EQUIRECTANGULAR"
    made = bpy.data.objects.new("Camera", data)
    made.rotation_euler = math.pi / 2, 0, -math.pi / 2
    bpy.context.scene.collection.objects.link(made)
    bpy.context.scene.camera = made


def by_cycles(folder: Path) -> np.ndarray:
    """(height, width, 3) f4 of the open file's world."""
    look_around()
    return cycles.render(folder, size=SIZE, samples=1, filter_width=0.01)[..., :3]


def extracted() -> Scene:
    """The open file, all of it by compiled trees, without a word of what is left out."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    depsgraph.update()
    scene = extract(depsgraph, needs_camera=False)
    assert told(scene) == []
    return scene


def by_us(device: Device) -> np.ndarray:
    """The same by the compiled tree, as the camera sees it, with the sun's disc."""
    scene = extracted()
    assert scene.world.graph
    seen = world_trees(scene.world.graph).seen
    if seen.color is not None:
        return np.broadcast_to(np.array(seen.color, "f4"), (SIZE[1], SIZE[0], 3))
    rays = CONSTANTS["RAY_CAMERA"] | CONSTANTS["RAY_DISC"]
    return light_of_image(device, seen.tree, scene.images, SIZE, rays)
