# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user changes between two frames, each edit as a new Scene that shares all else with the old one.

Every edit takes a number, and another number makes another change, so that no two frames are the same. A moved camera
leaves the scene as it is: it is another view of it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ..scene.types import Camera, Scene

Edit = Callable[[Scene, int], Scene]

_SMALL = 1e-3  # of a metre, a radian or a value, for each number


def nothing(scene: Scene, _number: int) -> Scene:
    """The very same scene."""
    return scene


def camera(scene: Scene, number: int) -> Camera:
    """The scene's camera, moved sideways by a number; it is no part of what Session is given as the scene."""
    assert scene.camera is not None
    return replace(scene.camera, world_from_camera=_moved(scene.camera.world_from_camera, number))


def lamp_power(scene: Scene, number: int) -> Scene:
    """The first lamp brighter."""
    red, green, blue = scene.lights[0].emitted
    factor = 1 + _SMALL * number
    return _with_first(scene, "lights", emitted=(red * factor, green * factor, blue * factor))


def lamp_place(scene: Scene, number: int) -> Scene:
    """The first lamp moved."""
    return _with_first(scene, "lights", world_from_light=_moved(scene.lights[0].world_from_light, number))


def material_color(scene: Scene, number: int) -> Scene:
    """The first material darker."""
    red, green, blue = scene.materials[0].base_color
    factor = 1 - _SMALL * number
    return _with_first(scene, "materials", base_color=(red * factor, green * factor, blue * factor))


def object_place(scene: Scene, number: int) -> Scene:
    """The object with the most triangles moved."""
    inst = scene.instances
    largest = int(np.argmax([len(scene.meshes[m].triangles) for m in inst.mesh]))
    matrices = inst.world_from_object.copy()
    matrices[largest] = _moved(matrices[largest], number)
    return replace(scene, instances=replace(inst, world_from_object=matrices))


# What is made anew, as Session.forget takes it: no name means everything, None nothing. "light": all from voxels on
KINDS: dict[str, tuple[str, ...] | None] = {
    "all": (), "light": ("voxelize", "light", "octree", "glow", "lights", "links", "cache"), "camera": None}
EDITS: dict[str, Edit] = {
    "nothing": nothing, "camera": nothing, "lamp's power": lamp_power, "lamp moved": lamp_place,
    "material's colour": material_color, "object moved": object_place, "everything": nothing}


def possible(scene: Scene) -> dict[str, Edit]:
    """The edits that the scene has something for."""
    lacking = {name for name, there in (("lamp's power", scene.lights), ("lamp moved", scene.lights),
                                        ("material's colour", scene.materials),
                                        ("object moved", len(scene.instances))) if not there}
    return {name: edit for name, edit in EDITS.items() if name not in lacking}


def _moved(matrix: np.ndarray, number: int) -> np.ndarray:
    moved = matrix.copy()
    moved[0, 3] += _SMALL * number
    return moved


def _with_first(scene: Scene, name: str, **values: Any) -> Scene:
    """The scene with the first of its lights or materials changed."""
    first, *others = getattr(scene, name)
    changed: Any = {name: (replace(first, **values), *others)}
    return replace(scene, **changed)
