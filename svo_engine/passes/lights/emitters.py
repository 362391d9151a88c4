# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangles that send out light, as lights that can be drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...scene.types import Instances, Mesh
from ..upload.emission import Emission
from ..upload.placing import Placing

MOST = 1 << 17  # triangles; what goes beyond is large enough to be found by rays alone
EASY = 0.25  # of the area of all surfaces: rays find more than that often enough by themselves, with less noise


@dataclass(frozen=True, eq=False)
class Emitters:
    """n emissive triangles, in the order of `work`: their number when the triangles of all instances are counted.

    instance, triangle  (n,) u4, in the device's order
    low, high           (n, 3) f8, metres, relative to the scene's centre: their boxes
    intensity           (n,) f8, [W sr^-1], about what they send out along their normal
    """

    work: np.ndarray
    instance: np.ndarray
    triangle: np.ndarray
    low: np.ndarray
    high: np.ndarray
    intensity: np.ndarray


def emitters_of(placing: Placing, emission: Emission) -> Emitters:
    """The emissive triangles that rays would not find: of materials that are not EASY, and of as many instances as MOST
    allows, those with the fewest triangles first.
    """
    inst, meshes = placing.placed, placing.shapes.meshes
    radiance = emission.means.copy()
    if radiance.any():
        radiance[_area_shares(inst, meshes, len(radiance)) > EASY] = 0.0
    order, first_triangle = placing.order, placing.shapes.first_triangle
    first_work = np.cumsum([0, *np.diff(first_triangle)[inst.mesh[order]]])
    glowing = [(number, i) for number, i in enumerate(order) if radiance[_slots(inst, i)].any()]
    found = {number: _radiances(inst, meshes, i, radiance) for number, i in _smallest(inst, meshes, glowing)}
    if emission.of_trees is not None:
        for number, sent in found.items():
            own = _radiances(inst, meshes, order[number], emission.is_tree)
            found[number] = np.where(own, emission.of_trees[first_work[number]:first_work[number] + len(sent)], sent)
    parts = []
    for number, sent in sorted(found.items()):
        i = order[number]
        mesh, m, own = meshes[inst.mesh[i]], inst.world_from_object[i], np.flatnonzero(sent)
        corners = _corners(mesh, m, own) - placing.centre_ws
        area = _areas(corners)
        columns = (first_work[number] + own, np.full(len(own), number), first_triangle[inst.mesh[i]] + own,
                   corners.min(1), corners.max(1), sent[own] * area)
        parts.append([column[area > 0] for column in columns])
    empty = [np.zeros(0, "u4")] * 3 + [np.zeros((0, 3))] * 2 + [np.zeros(0)]
    return Emitters(*(np.concatenate(column) for column in zip(empty, *parts, strict=True)))


def _area_shares(inst: Instances, meshes: tuple[Mesh, ...], n_materials: int) -> np.ndarray:
    """(n_materials,) f8: each material's part of the area of all surfaces, which is about the part of all rays that hit
    it. An instance's scale counts as if it were the same along all axes.
    """
    areas = np.zeros(n_materials)
    of_slots = [np.bincount(mesh.material_slots, _areas(mesh.positions[mesh.triangles])) for mesh in meshes]
    scales = np.abs(np.linalg.det(inst.world_from_object[:, :3, :3])) ** (2 / 3)
    for i, mesh in enumerate(inst.mesh):
        slots = _slots(inst, i)
        np.add.at(areas, slots[np.minimum(np.arange(len(of_slots[mesh])), len(slots) - 1)], scales[i] * of_slots[mesh])
    return areas / max(areas.sum(), 1e-30)


def _areas(corners: np.ndarray) -> np.ndarray:
    """(n,) of triangles (n, 3, 3)."""
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2


def _slots(inst: Instances, i: int) -> np.ndarray:
    """Materials of instance i, one a slot."""
    return inst.slot_materials[inst.first_slot[i]:inst.first_slot[i + 1]]


def _smallest(inst: Instances, meshes: tuple[Mesh, ...], instances: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """As many of the instances, (number on the device, index), as have MOST triangles together."""
    sizes = np.array([len(meshes[inst.mesh[i]].triangles) for _, i in instances], "i8")
    order = np.argsort(sizes, kind="stable")
    return [instances[k] for k in order[np.cumsum(sizes[order]) <= MOST]]


def _radiances(inst: Instances, meshes: tuple[Mesh, ...], i: int, radiance: np.ndarray) -> np.ndarray:
    """What each triangle of instance i sends out; the last slot stands for those that do not exist."""
    slots, mesh = _slots(inst, i), meshes[inst.mesh[i]]
    return radiance[slots[np.minimum(mesh.material_slots, len(slots) - 1)]]


def _corners(mesh: Mesh, world_from_object: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """(n, 3, 3) f8, metres, world space."""
    positions = mesh.positions[mesh.triangles[triangles]].astype("f8")
    return positions @ world_from_object[:3, :3].T + world_from_object[:3, 3]
