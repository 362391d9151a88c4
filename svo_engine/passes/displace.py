# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes whose materials move them -> meshes as they are moved, before trees of boxes are built of them.

As in Cycles a mesh moves once, as its first instance says; a vertex as the first triangle says that has it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..gpu.device import Device
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from ..scene import layouts
from ..scene.moved import moved_mesh, vertex_normals
from ..scene.types import Mesh
from .upload.placing import Placing
from .upload.shading import Shading, view_uniforms
from .upload.surfaces import Surfaces
from .upload.trees import Trees


@dataclass(frozen=True, eq=False)
class Displaced:
    """meshes: all of the scene, in their order; those that nothing moves are the same objects."""

    scope: GpuScope
    meshes: tuple[Mesh, ...]


def displace(device: Device, placing: Placing, shading: Shading, surfaces: Surfaces, trees: Trees,
             meshes: tuple[Mesh, ...]) -> Displaced:
    """Move the vertices of all meshes that materials move."""
    made = list(meshes)
    given = {**placing.geometry, **surfaces.materials, **shading.read, **view_uniforms(None, placing.centre_ws),
             "Values": trees.values, "u_centre": placing.centre_ws, "u_place": np.eye(4), "u_footprint": (1e-3, 0.0)}
    movers = trees.compiled.mover_of
    for m, instance in _first_instances(placing, movers):
        material = _materials(placing, meshes[m], instance)
        corners = _corners(placing, meshes[m], m, instance, material, trees)
        moves = np.zeros((len(meshes[m].positions), 3), "f4")
        for number in np.unique(corners["mover"]):
            chosen = corners[corners["mover"] == number]
            moves[chosen["vertex"]] = _moves(device, trees, int(number), chosen["row"], given)
        made[m] = moved_mesh(meshes[m], moves, trees.compiled.keeps_normals[material])
    return Displaced(device.scope(), tuple(made))


def _first_instances(placing: Placing, movers: np.ndarray) -> list[tuple[int, int]]:
    """(mesh, the device's number of the first instance) of each mesh that shows a material that moves it."""
    inst, found = placing.placed, {}
    place_of = np.argsort(placing.order)
    for i in range(len(inst)):
        if int(inst.mesh[i]) not in found and (movers[inst.slot_materials[inst.first_slot[i]:inst.first_slot[i + 1]]]
                                               >= 0).any():
            found[int(inst.mesh[i])] = int(place_of[i])
    return list(found.items())


def _materials(placing: Placing, mesh: Mesh, instance: int) -> np.ndarray:
    """(n_triangles,) the material that each triangle has on that instance, by the device's number."""
    inst, i = placing.placed, placing.order[instance]
    materials = inst.slot_materials[inst.first_slot[i]:inst.first_slot[i + 1]]
    return materials[np.minimum(mesh.material_slots, len(materials) - 1)]


def _corners(placing: Placing, mesh: Mesh, m: int, instance: int, material: np.ndarray, trees: Trees) -> np.ndarray:
    """Of each vertex that moves: its number, which structure moves it, and its row of layout MOVED_CORNER."""
    mover = trees.compiled.mover_of[material]
    moving = np.flatnonzero(mover >= 0)
    vertices, first = np.unique(mesh.triangles[moving].ravel(), return_index=True)
    triangles = moving[first // 3]
    row = layouts.dtype(layouts.MOVED_CORNER)
    corners = np.zeros(len(vertices), [("vertex", "u4"), ("mover", "i4"), ("row", row)])
    corners["vertex"], corners["mover"] = vertices, mover[triangles]
    rows = corners["row"]
    rows["instance"], rows["corner"], rows["normal"] = instance, first % 3, vertex_normals(mesh)[vertices]
    rows["triangle"] = triangles + placing.shapes.first_triangle[m]
    rows["first_value"] = trees.compiled.first_moving[material[triangles]]
    return corners


def _moves(device: Device, trees: Trees, number: int, rows: np.ndarray, given: Resources) -> np.ndarray:
    """(n, 3) f4, metres in object space, of these corners."""
    pass_ = trees.movers[number]
    with device.scope() as scratch:
        moves = scratch.buffer("moves", 16 * len(rows))
        whole = {**given, "Corners": scratch.buffer("moved corners", np.ascontiguousarray(rows)), "Moves": moves}
        device.dispatch(pass_, len(rows), **{name: whole[name] for name in pass_.wanted})
        return np.frombuffer(moves.read(), "f4").reshape(-1, 4)[:, :3]
