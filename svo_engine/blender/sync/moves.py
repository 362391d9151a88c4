# SPDX-License-Identifier: GPL-3.0-or-later
"""What a walk found, moved along: the rows of what stands elsewhere, and the lamps that are others."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...scene.types import Light
from ..extract.lights import read_light
from .changes import Changes, Uid, uid_of
from .same import keep
from .walk import Walk


@dataclass
class _Moves:
    """By position: matrices as Walk has them, and lamps to be read, with their names."""

    matrices: dict[int, np.ndarray] = field(default_factory=dict)
    lamps: dict[int, tuple[Any, str]] = field(default_factory=dict)


def follow(found: Walk, depsgraph: Any, changes: Changes) -> tuple[Walk, int] | None:
    """`found` after `changes` that move objects and edit lamps, and how many rows were written; None: walk again."""
    places = found.places
    if any(map(places.is_woven, changes.lamps)):
        return None
    moves = None if changes.has_collections else _named_moves(found, changes.moved)
    if moves is None:
        moves = _all_moves(found, depsgraph)
    if moves is None:
        return None
    for uid, lamp in changes.lamps.items():
        position = places.plain.get(uid)
        if position is not None and places.shown[position]:
            moves.lamps[position] = lamp.data, lamp.name
    is_lost = any(not np.isfinite(matrix).all() for i, matrix in moves.matrices.items() if places.shown[i])
    if is_lost or (moves.matrices.keys() | moves.lamps.keys()) & places.left_out:
        return None
    return _written(found, moves)


def _named_moves(found: Walk, moved: dict[Uid, Any]) -> _Moves | None:
    """Those of plain objects and of what they instance, each read by itself; None if more must be looked at."""
    moves, places = _Moves(), found.places
    for uid, owner in moved.items():
        if places.is_woven(uid) and not _note_instances(moves, found, uid, owner):
            return None
        position = places.plain.get(uid)
        if position is None:
            continue
        matrix = _matrix(owner)
        if np.array_equal(matrix, found.matrices[position]):
            continue
        moves.matrices[position] = matrix
        if places.lamps[position] >= 0:
            moves.lamps[position] = owner.data, owner.name
    return moves


def _note_instances(moves: _Moves, found: Walk, uid: Uid, holder: Any) -> bool:
    """Note where the collection that `holder` shows stands now, as Blender computes it, to the bit; whether that is how
    it stood so far, too: if not, there is more to it."""
    places = found.places
    shown = holder.instance_collection if holder.instance_type == "COLLECTION" else None
    if shown is None or uid in places.placed or uid not in places.plain:
        return False
    offset = np.eye(4, dtype="f4")
    offset[3, :3] -= np.array(shown.instance_offset, "f4")
    before = _product(found.matrices[places.plain[uid]], offset)
    now = _product(_matrix(holder), offset)
    inside = {uid_of(each.original): each for each in shown.all_objects}
    for position in places.held.get(uid, ()):
        each = inside.get(places.owners[position])
        if each is None or not np.array_equal(_product(before, _matrix(each)), found.matrices[position]):
            return False
        moves.matrices[position] = _product(now, _matrix(each))
        if places.lamps[position] >= 0:
            moves.lamps[position] = each.data, each.name
    return True


def _matrix(owner: Any) -> np.ndarray:
    """As `Walk.matrices` has it."""
    return np.array(owner.matrix_world, "f4").T


def _product(outer: np.ndarray, inner: np.ndarray) -> np.ndarray:
    """outer @ inner of transposed matrices, summed in Blender's order."""
    return (inner[:, 0:1] * outer[0] + inner[:, 1:2] * outer[1]) + (inner[:, 2:3] * outer[2] + inner[:, 3:] * outer[3])


def _all_moves(found: Walk, depsgraph: Any) -> _Moves | None:
    """Those of all instances; None if there are more or fewer than before."""
    matrices = np.empty_like(found.matrices)
    try:
        depsgraph.object_instances.foreach_get("matrix_world", matrices.ravel())
    except TypeError:  # Blender counts before it reads
        return None
    changed = (matrices != found.matrices).any((1, 2)).nonzero()[0].tolist()
    moves = _Moves({i: matrices[i] for i in changed})
    lamps = {i for i in changed if found.places.lamps[i] >= 0}
    if lamps:
        for position, instance in enumerate(depsgraph.object_instances):
            if position in lamps:
                moves.lamps[position] = instance.object.data, instance.object.name
    return moves


def _written(found: Walk, moves: _Moves) -> tuple[Walk, int] | None:
    if not moves.matrices and not moves.lamps:
        return found, 0
    matrices = found.matrices
    if moves.matrices:
        matrices = matrices.copy()
        matrices[list(moves.matrices)] = list(moves.matrices.values())
    lights = list(found.lights)
    for position, (lamp, name) in moves.lamps.items():
        light, notes = _read_light(lamp, name, matrices[position].T.astype("f8"))
        if light is None or found.places.lamps[position] < 0 or notes != found.places.lamp_notes[position]:
            return None
        lights[found.places.lamps[position]] = light
    positions = [i for i in moves.matrices if found.places.rows[i] >= 0]
    instances = found.instances
    if positions:
        placed = instances.world_from_object.copy()
        placed[found.places.rows[positions]] = matrices[positions].transpose(0, 2, 1)
        instances = replace(instances, world_from_object=placed)
    moved = replace(found, instances=instances, lights=keep(found.lights, tuple(lights)), matrices=matrices)
    return moved, len(positions)


def _read_light(lamp: Any, name: str, matrix: np.ndarray) -> tuple[Light | None, tuple[str, ...]]:
    notes: list[str] = []
    return read_light(lamp, name, matrix, notes.append), tuple(notes)
