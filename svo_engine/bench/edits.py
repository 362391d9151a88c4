# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user changes between two frames, each edit as a new Look that shares all else with the old one.

Every edit takes a number, and another number makes another change, so that no two frames are the same. Edits that add
or switch on something say what was there before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from ..scene.types import Camera, Instances, Scene
from ..settings import PASSES

_SMALL = 1e-3  # of a metre, a radian or a value, for each number

# What is made anew, as Session.forget takes it: no name means everything, None nothing. "light": all from voxels on
KINDS: dict[str, tuple[str, ...] | None] = {
    "all": (), "camera": None,
    "light": ("voxelize", "light", "octree", "colors", "sky table", "glow", "lights", "links", "found", "drawn",
              "cache")}

# The defaults of Blender's viewport, which has a denoiser of its own, and of F12
VIEWPORT = {"samples": 1, "denoiser": "automatic", "denoising_quality": "fast"}
FINAL = {"samples": 16, "denoiser": "openimagedenoise", "denoising_quality": "high"}


@dataclass(frozen=True, eq=False)
class Look:
    """What a frame shows. values: of RenderSettings, with defaults for all others."""

    scene: Scene
    camera: Camera
    values: Mapping[str, Any]


@dataclass(frozen=True)
class Edit:
    """change: the look after it; start: what it must be before; of: what the scene must have; anew: nothing is kept."""

    change: Callable[[Look, int], Look]
    start: Callable[[Look], Look] = lambda look: look
    of: str = ""
    anew: bool = False


def possible(scene: Scene) -> dict[str, Edit]:
    """The edits that the scene has something for."""
    there = {"": True, "lights": bool(scene.lights), "instances": len(scene.instances) > 0}
    return {name: edit for name, edit in EDITS.items() if there[edit.of]}


def _nothing(look: Look, _number: int) -> Look:
    return look


def _camera(look: Look, number: int) -> Look:
    """Moved sideways; it is no part of what Session is given as the scene."""
    camera = replace(look.camera, world_from_camera=_moved(look.camera.world_from_camera, number))
    return replace(look, camera=camera)


def _settings(look: Look, number: int, of: Callable[[int], Mapping[str, Any]]) -> Look:
    return replace(look, values={**look.values, **of(number)})


def _switched(name: str, before: Mapping[str, Any], after: Callable[[int], Mapping[str, Any]]) -> dict[str, Edit]:
    """An edit of settings."""
    return {name: Edit(partial(_settings, of=after), partial(_settings, number=0, of=lambda _: before))}


# Lamps


def _power(look: Look, number: int) -> Look:
    """The first lamp brighter."""
    first, *others = look.scene.lights
    red, green, blue = first.emitted
    factor = 1 + _SMALL * number
    return _with(look, lights=(replace(first, emitted=(red * factor, green * factor, blue * factor)), *others))


def _lamp_place(look: Look, number: int) -> Look:
    """The first lamp moved."""
    first, *others = look.scene.lights
    return _with(look, lights=(replace(first, world_from_light=_moved(first.world_from_light, number)), *others))


def _lamps(look: Look, n: int) -> Look:
    """With n lamps: the first ones, and copies of the first a little beside it."""
    first = look.scene.lights[0]
    copies = (replace(first, world_from_light=_moved(first.world_from_light, 50 * i)) for i in range(n))
    return _with(look, lights=(*look.scene.lights, *copies)[:n])


def _nth_lamp(n: int) -> Edit:
    def add(look: Look, number: int) -> Look:
        light = look.scene.lights[-1]
        return _with(look, lights=(*look.scene.lights,
                                   replace(light, world_from_light=_moved(light.world_from_light, 50 + number))))

    return Edit(add, partial(_lamps, n=n - 1), "lights")


# Materials: of the largest object, which are plain values before


def _material(name: str, before: Any, after: Callable[[int], Any], **also: Any) -> dict[str, Edit]:
    """An edit of one value; `also`: others that make it count."""
    return {name.replace("_", " "): Edit(
        lambda look, number: _with_material(look, {name: after(number)}),
        lambda look: _with_material(look, {**also, name: before}), "instances")}


def _color(look: Look, number: int) -> Look:
    """A little darker."""
    red, green, blue = look.scene.materials[_material_of(look.scene)].base_color
    factor = 1 - _SMALL * number
    return _with_material(look, {"base_color": (red * factor, green * factor, blue * factor)})


def _with_material(look: Look, values: Mapping[str, Any]) -> Look:
    materials = list(look.scene.materials)
    index = _material_of(look.scene)
    changed: Any = dict(values)
    materials[index] = replace(materials[index], **changed)
    return _with(look, materials=tuple(materials))


def _material_of(scene: Scene) -> int:
    """The first one of the largest object."""
    inst = scene.instances
    return int(inst.slot_materials[inst.first_slot[_largest(scene)]])


# Objects


def _largest(scene: Scene) -> int:
    """The instance with the most triangles."""
    return int(np.argmax([len(scene.meshes[m].triangles) for m in scene.instances.mesh]))


def _object_place(look: Look, number: int) -> Look:
    """The largest object moved."""
    inst, largest = look.scene.instances, _largest(look.scene)
    matrices = inst.world_from_object.copy()
    matrices[largest] = _moved(matrices[largest], number)
    return _with(look, instances=replace(inst, world_from_object=matrices))


def _object_added(look: Look, number: int) -> Look:
    """A copy of the largest object, small, a little beside it."""
    inst, largest = look.scene.instances, _largest(look.scene)
    matrix = _moved(inst.world_from_object[largest], 300 + number)
    matrix[:3, :3] *= 0.5
    slots = inst.slot_materials[inst.first_slot[largest]:inst.first_slot[largest + 1]]
    added = Instances(
        (*inst.names, "Added"), np.append(inst.mesh, inst.mesh[largest]).astype("u4"),
        np.concatenate([inst.world_from_object, matrix[None]]),
        np.append(inst.first_slot, inst.first_slot[-1] + len(slots)).astype("u4"),
        np.concatenate([inst.slot_materials, slots]))
    return _with(look, instances=added)


def _object_deleted(look: Look, number: int) -> Look:
    """The copy gone; what stays is elsewhere each time, so that nothing is known from the time before."""
    inst = look.scene.instances
    n, n_slots = len(inst) - 1, int(inst.first_slot[-2])
    left = Instances(inst.names[:n], inst.mesh[:n], inst.world_from_object[:n], inst.first_slot[:n + 1],
                     inst.slot_materials[:n_slots])
    return _object_place(_with(look, instances=left), number)


def _mesh(look: Look, number: int) -> Look:
    """One vertex of the largest object moved."""
    index = int(look.scene.instances.mesh[_largest(look.scene)])
    meshes, mesh = list(look.scene.meshes), look.scene.meshes[index]
    positions = mesh.positions.copy()
    positions[0] += np.float32(_SMALL * number)
    meshes[index] = replace(mesh, positions=positions)
    return _with(look, meshes=tuple(meshes))


def _moved(matrix: np.ndarray, number: int) -> np.ndarray:
    moved = matrix.copy()
    moved[0, 3] += _SMALL * number
    return moved


def _with(look: Look, **fields: Any) -> Look:
    """The look with other parts of its scene."""
    return replace(look, scene=replace(look.scene, **fields))


_PASSES = tuple(PASSES)

EDITS: dict[str, Edit] = {
    "nothing": Edit(_nothing),
    "camera": Edit(_camera),
    "lamp's power": Edit(_power, of="lights"),
    "lamp moved": Edit(_lamp_place, of="lights"),
    **{f"{n} lamp added": _nth_lamp(int(n[:-2])) for n in ("2nd", "3rd", "10th")},
    "colour": Edit(_color, of="instances"),
    **_material("roughness", 0.5, lambda i: 0.5 - _SMALL * i, specular_level=0.5),
    "specular 0 to .5": _material("specular_level", 0.0, lambda i: 0.5 + _SMALL * (i - 1))["specular level"],
    **_material("metallic", 0.0, lambda i: 1 - _SMALL * i),
    **_material("transmission", 0.0, lambda i: 1 - _SMALL * i),
    **_material("alpha", 1.0, lambda i: 0.5 - _SMALL * i),
    **_material("emission", (0.0, 0.0, 0.0), lambda i: (1 + _SMALL * i,) * 3),
    "object moved": Edit(_object_place, of="instances"),
    "object added": Edit(_object_added, of="instances"),
    "object deleted": Edit(_object_deleted, partial(_object_added, number=0), "instances"),
    "mesh edited": Edit(_mesh, of="instances"),
    **_switched("a pass switched on", {}, lambda i: {"passes": (_PASSES[i % len(_PASSES)],)}),
    **_switched("F12's samples after a viewport's", VIEWPORT, lambda _: FINAL),
    **_switched("rays to cones", {"method": "rays"}, lambda _: {"method": "cones"}),
    **_switched("cones to rays", {"method": "cones"}, lambda _: {"method": "rays"}),
    "everything": Edit(_nothing, anew=True)}
