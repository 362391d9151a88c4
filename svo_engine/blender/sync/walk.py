# SPDX-License-Identifier: GPL-3.0-or-later
"""A walk over everything that a depsgraph shows, as `extract` does it, which notes where each thing stands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...scene.types import Instances, Light, Mesh
from ..extract.placing import Placing, matrices_of, visits
from ..extract.visibility import is_seen, sees
from .changes import Uid, uid_of
from .materials import KeptMaterials
from .meshes import KeptMeshes

Seen = list[tuple[int, bool]]


class Places:
    """What stands where. A position is a place in the order of the depsgraph's instances.

    shown       (n,) bool, whether a position is shown
    rows        (n,) i4, position -> row of the Scene's instances, or -1
    lamps       (n,) i4, position -> index in its lights, or -1
    left_out    positions of what is shown but could not be taken: another place may change that
    plain       uid of each object that stands for itself -> its position
    owners      position -> uid of the object
    placed      uids of objects that others place, by instancing
    held        uid of each object that places others -> their positions
    lamp_notes  warnings on a lamp by its position
    """

    def __init__(self, n: int) -> None:
        self.shown = np.zeros(n, bool)
        self.rows, self.lamps = np.full(n, -1, "i4"), np.full(n, -1, "i4")
        self.left_out: set[int] = set()
        self.plain: dict[Uid, int] = {}
        self.owners: list[Uid] = []
        self.placed: set[Uid] = set()
        self.held: dict[Uid, list[int]] = {}
        self.lamp_notes: dict[int, tuple[str, ...]] = {}
        self._holder: tuple[int, Uid] = 0, 0

    def is_woven(self, uid: Uid) -> bool:
        """Whether an object does not stand for itself alone."""
        return uid in self.placed or uid in self.held

    def note_object(self, position: int, instance: Any, owner: Any) -> None:
        """Note whose `instance` is."""
        uid = uid_of(owner.original)
        self.owners.append(uid)
        if not instance.is_instance:
            self.plain[uid] = position
            return
        self.placed.add(uid)
        holder = instance.parent
        if self._holder[0] != (address := holder.as_pointer()):
            self._holder = address, uid_of(holder.original)
        self.held.setdefault(self._holder[1], []).append(position)


@dataclass(frozen=True, eq=False)
class Walk:
    """What was found.

    matrices  (n, 4, 4) f4 of all positions, as `extract.placing.matrices_of` gives them
    seen      the objects that the depsgraph shows, by their addresses, and whether the viewport does
    """

    meshes: tuple[Mesh, ...]
    instances: Instances
    lights: tuple[Light, ...]
    notes: tuple[str, ...]
    matrices: np.ndarray
    seen: Seen
    places: Places


class _Notes:
    """Warnings in their order, and apart for each position."""

    def __init__(self) -> None:
        self.all: dict[str, None] = {}
        self.last: list[str] = []

    def warn(self, sentence: str) -> None:
        self.all.setdefault(sentence)
        self.last.append(sentence)


def walk(depsgraph: Any, space: Any, materials: KeptMaterials, meshes: KeptMeshes) -> Walk:
    """Visit all instances. `begin` and `end` of what is kept are the caller's."""
    notes = _Notes()
    materials.begin(notes.warn)
    placing = Placing(materials, depsgraph, notes.warn, meshes.read)
    matrices = matrices_of(depsgraph)
    places = Places(len(matrices))
    for position, (instance, matrix) in enumerate(visits(depsgraph, matrices)):
        owner = instance.object
        kind = owner.type
        places.note_object(position, instance, owner)
        if not (instance.show_self and is_seen(instance, space)):
            if kind == "MESH":
                meshes.meet(owner)
            continue
        n_rows, n_lamps = placing.n_placed, len(placing.lights)
        notes.last = []
        placing.visit(instance, matrix)
        places.shown[position] = True
        if placing.n_placed > n_rows:
            places.rows[position] = n_rows
        elif kind in ("MESH", "LIGHT"):
            places.lamps[position] = n_lamps if len(placing.lights) > n_lamps else -1
            places.left_out |= {position} if places.lamps[position] < 0 else set()
            places.lamp_notes[position] = tuple(notes.last)
    return Walk(tuple(placing.meshes), placing.instances(), tuple(placing.lights), tuple(notes.all), matrices,
                seen_of(depsgraph, space), places)


def seen_of(depsgraph: Any, space: Any) -> Seen:
    """`Walk.seen` as it is now. An object at the address of another one would be named as new."""
    return [(owner.as_pointer(), sees(owner, space)) for owner in depsgraph.objects]
