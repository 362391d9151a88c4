# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes whose materials move them -> meshes as they are moved, before anything else is made of them.

A mesh is moved once for all instances whose materials move it alike, as its first one says; a vertex as the first
triangle says that has it. As in Cycles, which has another mesh where objects have materials of their own.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..gpu.device import Device
from ..gpu.program import Resources
from ..gpu.scope import GpuScope
from ..nodes.moves import Moves
from ..scene import layouts
from ..scene.camera import make_view
from ..scene.geometry import chosen, with_fields
from ..scene.moved import moved_mesh, vertex_normals
from ..scene.types import Camera, Image, Instances, Mesh, Scene
from .upload.pictures import upload_pictures
from .upload.placing import Placing, place
from .upload.shading import upload_shading, view_uniforms
from .upload.shapes import upload_shapes
from .upload.trees import Trees, mover_pass

_NO_IMAGE = Image("", np.zeros((1, 1, 4), "u1"))


@dataclass(frozen=True, eq=False)
class Moving:
    """All that moved meshes depend on.

    meshes        as they are at rest
    instances     one of each, in their order; around the origin if the moves are the same wherever it stands
    images        those of the scene that `moves` read, with their tiles; in place of all others small ones
    pass_indices  (n_materials,) i4
    camera        if moves depend on it
    """

    meshes: tuple[Mesh, ...]
    instances: Instances
    moves: Moves
    images: tuple[Image, ...]
    pass_indices: np.ndarray
    camera: Camera | None


@dataclass(frozen=True, eq=False)
class Displaced:
    """meshes: those of Moving, moved."""

    scope: GpuScope
    meshes: tuple[Mesh, ...]


def displace(device: Device, moving: Moving) -> Displaced:
    """Move the vertices of the meshes."""
    moves = moving.moves
    with device.scope() as scratch:
        shapes = upload_shapes(device, moving.meshes, has_uvs=False)
        placing = place(device, shapes, moving.instances)
        shading = upload_shading(device, placing, moving.meshes, moving.instances, moves.attributes)
        pictures = upload_pictures(device, (), moving.images, moves.images)
        for part in (shapes, placing, shading, pictures):
            scratch.adopt(part.scope)
        view = None if moving.camera is None else make_view(moving.camera)
        materials = np.zeros(len(moving.pass_indices), layouts.dtype(layouts.MATERIAL))
        materials["pass_index"] = moving.pass_indices
        given = {**placing.geometry, **shading.read, **pictures.read, **view_uniforms(view, placing.centre_ws),
                 "Materials": scratch.buffer("pass indices", materials), "u_albedo": None,
                 "Values": scratch.buffer("values of moves", moves.values), "u_centre": placing.centre_ws,
                 "u_footprint": (0.0, 0.0), "u_place": np.eye(4)}
        meshes = tuple(_moved(device, placing, m, mesh, moves, given) for m, mesh in enumerate(moving.meshes))
    return Displaced(device.scope(), meshes)


def _moved(device: Device, placing: Placing, m: int, mesh: Mesh, moves: Moves, given: Resources) -> Mesh:
    inst = placing.placed
    slots = inst.slot_materials[inst.first_slot[m]:inst.first_slot[m + 1]]
    material = slots[np.minimum(mesh.material_slots, len(slots) - 1)]
    structure = moves.structure_of[material]
    moving = np.flatnonzero(structure >= 0)
    vertices, first = np.unique(mesh.triangles[moving].ravel(), return_index=True)
    triangles = moving[first // 3]
    rows = np.zeros(len(vertices), layouts.dtype(layouts.MOVED_CORNER))
    rows["instance"], rows["corner"], rows["normal"] = m, first % 3, vertex_normals(mesh)[vertices]
    rows["triangle"] = triangles + placing.shapes.first_triangle[m]
    rows["first_value"] = moves.first_value[material[triangles]]
    by = np.zeros((len(mesh.positions), 3), "f4")
    for number in np.unique(structure[triangles]):
        those = structure[triangles] == number
        by[vertices[those]] = _evaluated(device, moves.structures[number], rows[those], given)
    bumps = moves.bumps[material]
    return moved_mesh(mesh, by, (structure >= 0) & ~bumps, bumps)


def _evaluated(device: Device, text: str, rows: np.ndarray, given: Resources) -> np.ndarray:
    """(n, 3) f4, metres in object space: how far these vertices move, rows of layout MOVED_CORNER."""
    pass_ = mover_pass(text)
    with device.scope() as scratch:
        moves = scratch.buffer("moves", 16 * len(rows))
        whole = {**given, "Corners": scratch.buffer("moved corners", rows), "Moves": moves}
        device.dispatch(pass_, len(rows), **{name: whole[name] for name in pass_.wanted})
        return np.frombuffer(moves.read(), "f4").reshape(-1, 4)[:, :3]


def moving_of(scene: Scene, trees: Trees) -> tuple[Moving, np.ndarray] | None:
    """What is to be moved of a scene, and (n_instances,) i8: which of the moved meshes each instance shows, -1 for one
    that nothing moves. None where that is all of them.
    """
    moves, inst = trees.moves, scene.instances
    if not moves.structures or not len(inst):
        return None
    alike = np.where(moves.structure_of < 0, -1, moves.first_value.astype("i8") << 1 | moves.bumps)
    alike = np.where(moves.structure_of < 0, -1, alike * len(moves.structures) + moves.structure_of)
    keys = np.full((len(inst), 1 + int(np.diff(inst.first_slot).max())), -1, "i8")
    keys[:, 0] = inst.mesh
    n_slots = np.diff(inst.first_slot).astype("i8")
    row = np.repeat(np.arange(len(inst)), n_slots)
    column = np.arange(len(row)) - np.repeat(inst.first_slot[:-1].astype("i8"), n_slots)
    keys[row, 1 + column] = alike[inst.slot_materials]
    moved = np.flatnonzero((keys[:, 1:] >= 0).any(1))
    if not len(moved):
        return None
    _, first, group = np.unique(keys[moved], axis=0, return_index=True, return_inverse=True)
    shown = np.full(len(inst), -1, "i8")
    shown[moved] = group.ravel()
    return _moving(scene, trees, moved[first]), shown


def _moving(scene: Scene, trees: Trees, firsts: np.ndarray) -> Moving:
    """firsts: the instance that says how each mesh is moved."""
    moves, inst = trees.moves, chosen(scene.instances, firsts)
    meshes = tuple(scene.meshes[m] for m in inst.mesh)
    is_placed = np.logical_or.reduceat(moves.is_placed[inst.slot_materials], inst.first_slot[:-1].astype("i8"))
    matrices = np.where(is_placed[:, None, None], inst.world_from_object, np.eye(4))
    inst = with_fields(inst, mesh=np.arange(len(inst), dtype="u4"), world_from_object=matrices)
    images = [_NO_IMAGE] * len(scene.images)
    for i in moves.images:
        tiles = slice(i, i + scene.images[i].n_tiles if i < len(images) else i)
        images[tiles] = scene.images[tiles]
    pass_indices = np.array([m.pass_index for m in scene.materials], "i4")
    return Moving(meshes, inst, moves, tuple(images), pass_indices,
                  scene.camera if trees.moves_want_view else None)


def with_moved(scene: Scene, meshes: tuple[Mesh, ...], shown: np.ndarray) -> Scene:
    """The scene with these meshes where instances show them. One that nobody shows at rest gives its place away."""
    made, mesh = list(scene.meshes), scene.instances.mesh.copy()
    resting = set(mesh[shown < 0].tolist())
    for i, moved in enumerate(meshes):
        number = int(scene.instances.mesh[shown == i][0])
        if number in resting:
            number = len(made)
            made.append(moved)
        made[number] = moved
        resting.add(number)
        mesh[shown == i] = number
    return with_fields(scene, meshes=tuple(made), instances=with_fields(scene.instances, mesh=mesh))
