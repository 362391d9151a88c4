# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles that stay until their object or its data is named as changed."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

from ...scene.types import Mesh
from ..extract.meshes import read_mesh
from .changes import Uid, uid_of
from .copies import Copy, copy_of, marks_of
from .same import is_same


@dataclass(eq=False)
class _Kept:
    """One evaluated mesh. sources: its objects and their original data; is_used: in the walk that is on its way.

    copy  of a large one
    """

    mesh: Mesh | None
    notes: tuple[str, ...]
    copy: Copy | None
    sources: set[Uid] = field(default_factory=set)
    is_used: bool = True


class KeptMeshes:
    """By address of the evaluated data, for their names are not unique. An address can come to hold another mesh, so
    one counts only for objects that had it before, or share its data, and are not named as changed."""

    def __init__(self) -> None:
        self.n_read = 0
        self._kept: dict[int, _Kept] = {}
        self._doubted: dict[tuple[object, ...], list[_Kept]] = {}  # by their marks
        self._before: dict[tuple[object, ...], list[Mesh]] = {}  # what may be the same when it is read again
        self._changed: set[Uid] = set()

    def forget(self) -> None:
        """Have all read again at the next walk, unless their arrays are what they were."""
        self._doubt(self._kept.values())
        self._kept = {}

    def begin(self, changed: set[Uid], before: Iterable[Mesh]) -> None:
        """Before a walk. changed: objects and data; before: what the last Scene has."""
        self._changed, self._before = changed, {}
        for mesh in before:
            self._before.setdefault(_likeness(mesh), []).append(mesh)
        self._doubt(kept for kept in self._kept.values() if kept.sources & changed)
        self._kept = {at: kept for at, kept in self._kept.items() if not kept.sources & changed}
        for kept in self._kept.values():
            kept.is_used = False

    def end(self) -> None:
        """After a walk: what it has not met is given up."""
        self._kept = {at: kept for at, kept in self._kept.items() if kept.is_used}
        self._before, self._doubted = {}, {}

    def read(self, owner: Any, warn: Callable[[str], object]) -> Mesh | None:
        """As `extract.meshes.read_mesh`."""
        kept = self.meet(owner)
        if kept is None:
            kept = self._kept[owner.data.as_pointer()] = self._read(owner)
            kept.sources |= _sources(owner)
        for note in kept.notes:
            warn(note)
        return kept.mesh

    def meet(self, owner: Any) -> _Kept | None:
        """What is kept of the mesh of `owner`, which stays so also if this walk does not show it."""
        kept = self._kept.get(owner.data.as_pointer())
        if kept is None:
            return None
        sources = _sources(owner)
        if not sources & kept.sources or (sources & self._changed and not kept.is_used):
            return None
        kept.sources |= sources
        kept.is_used = True
        return kept

    def _doubt(self, those: Iterable[_Kept]) -> None:
        for kept in those:
            if kept.copy:
                self._doubted.setdefault(kept.copy.marks, []).append(kept)

    def _read(self, owner: Any) -> _Kept:
        marks = marks_of(owner.data)
        for last in self._doubted.get(marks, ()) if marks else ():
            if last.copy and last.copy.is_of(owner.data):
                return _Kept(last.mesh, last.notes, last.copy)
        self.n_read += 1
        notes: dict[str, None] = {}
        mesh = read_mesh(owner, notes.setdefault)
        if mesh is not None:
            mesh = next((old for old in self._before.get(_likeness(mesh), ()) if is_same(old, mesh)), mesh)
        return _Kept(mesh, tuple(notes), copy_of(owner.data, marks) if marks else None)


def _sources(owner: Any) -> set[Uid]:
    original = owner.original
    return {uid_of(original), uid_of(original.data)} if original.data else {uid_of(original)}


def _likeness(mesh: Mesh) -> tuple[object, ...]:
    """Equal for meshes that are the same, and for few others."""
    n = len(mesh.positions)
    return n, len(mesh.triangles), mesh.positions[[0, n // 2, n - 1]].tobytes()
