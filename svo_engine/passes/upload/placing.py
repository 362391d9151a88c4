# SPDX-License-Identifier: GPL-3.0-or-later
"""Instances on the device: where each mesh is placed, with what materials."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...scene import layouts
from ...scene.bounds import bounds
from ...scene.types import Instances
from .shapes import Shapes

_OF_INSTANCES = ("Instances", "Triangles", "CornerUvs", "SlotMaterials")


@dataclass(frozen=True)
class Draw:
    """Instances of one mesh that lie one after another: what one draw call shows."""

    first_instance: int
    n_instances: int
    first_triangle: int
    n_triangles: int


@dataclass(frozen=True, eq=False)
class Placing:
    """geometry: the buffers of bind/geometry.glsl; instances: those of bind/instances.glsl among them.

    placed     what was placed, in the scene's order
    n_work     triangles with instances counted as often as placed
    centre_ws  (3,) f8, metres; subtracted from every position, so that f4 does far away
    extent     metres, the longest side of the box around everything
    order      (n_instances,) i8, the device's order: place i holds instance order[i], meshes one after another
    """

    scope: GpuScope
    shapes: Shapes
    placed: Instances
    geometry: Resources
    instances: Resources
    draws: tuple[Draw, ...]
    n_work: int
    centre_ws: np.ndarray
    extent: float
    order: np.ndarray

    @property
    def n_instances(self) -> int:
        """Placed meshes that have triangles."""
        return sum(draw.n_instances for draw in self.draws)


def place(device: Device, shapes: Shapes, instances: Instances) -> Placing:
    """Copy the instances in the order of their meshes."""
    scope = device.scope()
    low, high = bounds(shapes.boxes, instances)
    centre, order = (low + high) / 2, np.argsort(instances.mesh, kind="stable")
    mesh = instances.mesh[order]
    n_triangles = np.diff(shapes.first_triangle)
    work = np.concatenate([[0], np.cumsum(n_triangles[mesh])]).astype("i8")
    rows = np.zeros(len(instances), layouts.dtype(layouts.INSTANCE))
    matrices = instances.world_from_object[order].copy()
    matrices[:, :3, 3] -= centre
    rows["row_x"], rows["row_y"], rows["row_z"] = matrices[:, 0], matrices[:, 1], matrices[:, 2]
    rows["first_triangle"], rows["n_triangles"] = shapes.first_triangle[mesh], n_triangles[mesh]
    rows["first_work"] = work[:-1]
    slots, rows["first_slot"] = _slots(instances, shapes.n_slots, order)
    buffers = {"Instances": scope.buffer("instances", rows), "SlotMaterials": scope.buffer("slot materials", slots)}
    found, firsts, counts = np.unique(mesh, return_index=True, return_counts=True)
    draws = tuple(Draw(int(f), int(c), int(shapes.first_triangle[m]), int(n_triangles[m]))
                  for m, f, c in zip(found, firsts, counts, strict=True) if n_triangles[m])
    geometry = {**shapes.buffers, **buffers}
    return Placing(scope, shapes, instances, geometry, {name: geometry[name] for name in _OF_INSTANCES}, draws,
                   int(work[-1]), centre, float((high - low).max()), order)


def _slots(instances: Instances, n_slots: np.ndarray, order: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Material indices of all slots, and the first of each instance in `order`.

    Every instance gets as many entries as its mesh names slots; a triangle whose slot does not exist takes the last
    one, as in Blender.
    """
    entries: list[np.ndarray] = []
    for i in order:
        own = instances.slot_materials[instances.first_slot[i]:instances.first_slot[i + 1]]
        entries.append(own[np.minimum(np.arange(n_slots[instances.mesh[i]]), len(own) - 1)])
    firsts = np.cumsum([0] + [len(e) for e in entries])[:-1]
    return np.concatenate(entries) if entries else np.zeros(0, "u4"), firsts
