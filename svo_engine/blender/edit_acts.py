# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user does to a scene, as acts that can be repeated: what the benchmark edits in front of a viewport."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import bmesh
import bpy

_SMALL = 1e-3  # of a metre or a value, for each number


def _rest() -> None:
    """Nothing is to be done."""


@dataclass(frozen=True)
class Act:
    """start: makes the scene ready for it, as often as wanted; do(number): the act, each number another one;
    end: the scene is as it was before `start`."""

    do: Callable[[int], object]
    start: Callable[[], object] = _rest
    end: Callable[[], object] = _rest


def acts(scene: bpy.types.Scene) -> dict[str, Act]:
    """Those that the scene has something for."""
    lamps = [each for each in scene.objects if each.type == "LIGHT"]
    meshes = [each for each in scene.objects if each.type == "MESH"]
    return {**(_of_lamp(scene, lamps[0]) if lamps else {}),
            **(_of_object(scene, max(meshes, key=lambda each: len(each.data.polygons))) if meshes else {})}


def _of_lamp(scene: bpy.types.Scene, lamp: bpy.types.Object) -> dict[str, Act]:
    power, x = lamp.data.energy, lamp.location.x
    others = sum(each.type == "LIGHT" for each in scene.objects)

    def set_number(n: int, number: int = 0) -> None:
        """So many lamps, copies of the first."""
        _remove_copies()
        for i in range(n - others):
            _copy(scene, lamp, 0.05 * (i + 1) + _SMALL * number)

    return {
        "lamp's power": Act(lambda i: setattr(lamp.data, "energy", power * (1 + _SMALL * i)),
                            end=lambda: setattr(lamp.data, "energy", power)),
        "lamp moved": Act(lambda i: setattr(lamp.location, "x", x + _SMALL * i),
                          end=lambda: setattr(lamp.location, "x", x)),
        **{f"{n} lamp added": Act(lambda i, n=n: _copy(scene, lamp, 0.05 * int(n[:-2]) + _SMALL * i),  # type: ignore[misc]
                                  lambda n=n: set_number(int(n[:-2]) - 1), _remove_copies)  # type: ignore[misc]
           for n in ("2nd", "3rd", "10th")}}


def _of_object(scene: bpy.types.Scene, owner: bpy.types.Object) -> dict[str, Act]:
    x = owner.location.x
    made = {
        "object moved": Act(lambda i: setattr(owner.location, "x", x + _SMALL * i),
                            end=lambda: setattr(owner.location, "x", x)),
        "object added": Act(lambda i: _copy(scene, owner, 0.3 + _SMALL * i), _remove_copies, _remove_copies),
        "object deleted": Act(lambda _: _remove_copies(), lambda: _copy(scene, owner, 0.3), _remove_copies),
        "mesh edited": Act(lambda i: _edit_mesh(owner, i))}
    shader = _shader_of(owner)
    return {**(_of_material(shader) if shader else {}), **made}


def _of_material(shader: bpy.types.ShaderNode) -> dict[str, Act]:
    """One value after another; `also`: another one that makes it count."""

    def value(name: str, before: Any, after: Callable[[int], Any], **also: float) -> Act:
        owner, old = shader.inputs[name], _plain(shader.inputs[name].default_value)
        rest = {other.replace("_", " "): shader.inputs[other.replace("_", " ")].default_value for other in also}

        def put(values: dict[str, float]) -> None:
            for other, number in values.items():
                shader.inputs[other].default_value = number

        def start() -> None:
            put({other.replace("_", " "): number for other, number in also.items()})
            owner.default_value = before

        def end() -> None:
            put(rest)
            owner.default_value = old

        return Act(lambda i: setattr(owner, "default_value", after(i)), start, end)

    return {
        "colour": value("Base Color", (0.8, 0.8, 0.8, 1), lambda i: (0.8 - _SMALL * i, 0.8, 0.8, 1)),
        "roughness": value("Roughness", 0.5, lambda i: 0.5 - _SMALL * i, Specular_IOR_Level=0.5),
        "specular 0 to .5": value("Specular IOR Level", 0.0, lambda i: 0.5 + _SMALL * (i - 1)),
        "metallic": value("Metallic", 0.0, lambda i: 1 - _SMALL * i),
        "transmission": value("Transmission Weight", 0.0, lambda i: 1 - _SMALL * i),
        "alpha": value("Alpha", 1.0, lambda i: 0.5 - _SMALL * i),
        "emission": value("Emission Strength", 0.0, lambda i: 1 + _SMALL * i)}


def _shader_of(owner: bpy.types.Object) -> bpy.types.ShaderNode | None:
    """The Principled BSDF of its first material."""
    material = owner.active_material
    nodes = material.node_tree.nodes if material and material.node_tree else ()
    return next((node for node in nodes if node.type == "BSDF_PRINCIPLED"), None)


def _edit_mesh(owner: bpy.types.Object, number: int) -> None:
    """In edit mode move a vertex, and go back."""
    bpy.context.view_layer.objects.active = owner
    bpy.ops.object.mode_set(mode="EDIT")
    edited = bmesh.from_edit_mesh(owner.data)
    edited.verts.ensure_lookup_table()
    edited.verts[0].co.x += _SMALL * number
    bmesh.update_edit_mesh(owner.data)
    bpy.ops.object.mode_set(mode="OBJECT")


def _copy(scene: bpy.types.Scene, owner: bpy.types.Object, shift: float) -> None:
    """One more of it, its data its own if it is a lamp, beside it."""
    made = bpy.data.objects.new(_COPY, owner.data.copy() if owner.type == "LIGHT" else owner.data)
    made.matrix_world = owner.matrix_world
    made.location.x += shift
    scene.collection.objects.link(made)


def _remove_copies() -> None:
    for each in [each for each in bpy.data.objects if each.name.startswith(_COPY)]:
        bpy.data.objects.remove(each)


def _plain(value: Any) -> Any:
    return value if isinstance(value, float) else tuple(value)


_COPY = "SVO copy"
