# SPDX-License-Identifier: GPL-3.0-or-later
"""One walk over everything that a depsgraph shows: meshes, where they stand, their materials, and lamps."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ...scene.types import Instances, Light, Mesh
from .identities import Identities
from .lights import read_light
from .lookups import Lookups, asked_for
from .materials import Collector
from .meshes import read_mesh, uv_map_of

# Evaluated geometry that Cycles draws and we do not
_LEFT_OUT = {"VOLUME": "a volume", "CURVES": "hair", "POINTCLOUD": "a point cloud", "GREASEPENCIL": "a grease pencil",
             "GPENCIL": "a grease pencil"}


# In place of a matrix with numbers that are not finite
LOST = np.zeros((4, 4))


def matrices_of(depsgraph: Any) -> np.ndarray:
    """(n, 4, 4) f4, those of all instances: read without making a Python object of each, but transposed, as Blender
    has them."""
    matrices = np.empty((len(depsgraph.object_instances), 4, 4), "f4")
    depsgraph.object_instances.foreach_get("matrix_world", matrices.ravel())
    return matrices


def visits(depsgraph: Any, matrices: np.ndarray) -> Iterator[tuple[Any, np.ndarray]]:
    """Each instance with its matrix (4, 4) f8, or LOST. It holds only until the next one is asked for."""
    is_finite = np.isfinite(matrices).all((1, 2)).tolist()
    matrices = matrices.transpose(0, 2, 1).astype("f8")
    for instance, matrix, is_there in zip(depsgraph.object_instances, matrices, is_finite, strict=True):
        yield instance, matrix if is_there else LOST


class Placing:
    """Collects what `visit` is given, one object instance of the depsgraph at a time."""

    def __init__(self, materials: Collector, depsgraph: Any, warn: Callable[[str], object],
                 read: Callable[..., Mesh | None] = read_mesh) -> None:
        self.meshes: list[Mesh] = []
        self.lights: list[Light] = []
        self._materials = materials
        self._override = depsgraph.view_layer_eval.material_override
        self._warn = warn
        self._read = read
        self._mesh_index: dict[int, int] = {}  # by address of the evaluated data: their names are not unique
        self._uv_maps: list[str] = []
        self._names: list[str] = []
        self._mesh: list[int] = []
        self._matrices: list[np.ndarray] = []
        self._slots: list[tuple[int, ...]] = []
        self._slots_of: dict[tuple[int, int], tuple[int, ...]] = {}  # by address of the original object and its data
        self._identities = Identities()
        self._lookups = Lookups(depsgraph.view_layer_eval, depsgraph.scene_eval)
        self._asked: dict[tuple[int, ...], frozenset[tuple[str, str]]] = {}  # by slots

    def visit(self, instance: Any, matrix: np.ndarray) -> None:
        """Add what `instance` shows at `matrix`, one of `matrices_of`."""
        owner = instance.object
        kind = owner.type
        if kind not in ("MESH", "LIGHT") and kind not in _LEFT_OUT:
            return
        if matrix is LOST:
            self._warn(f"Object '{owner.name}' is left out: its place is not a finite number")
        elif kind == "MESH":
            self._place(instance, owner, matrix)
        elif kind == "LIGHT":
            light = read_light(owner.data, owner.name, matrix, self._warn)
            self.lights += [] if light is None else [light]
        else:
            self._warn(f"Object '{owner.name}' is {_LEFT_OUT[kind]}, which is not supported; it is left out")

    @property
    def n_placed(self) -> int:
        """Instances so far."""
        return len(self._names)

    def instances(self) -> Instances:
        """Every visible placing of a mesh so far."""
        if not self._names:
            return Instances.empty()
        first_slot = np.cumsum([0, *map(len, self._slots)])
        slots = [material for materials in self._slots for material in materials]
        return Instances(
            tuple(self._names), np.array(self._mesh, "u4"), np.stack(self._matrices), first_slot.astype("u4"),
            np.array(slots, "u4"), **self._identities.arrays(), attributes=self._lookups.attributes(len(self._names)))

    def _place(self, instance: Any, owner: Any, matrix: np.ndarray) -> None:
        index = self._index(owner)
        if index < 0:
            return
        self._names.append(owner.name)
        self._mesh.append(index)
        self._matrices.append(matrix)
        self._identities.add(instance, owner)
        key = owner.original.as_pointer(), owner.data.as_pointer()
        if key not in self._slots_of:
            self._slots_of[key] = tuple(self._materials.index(m) for m in self._slot_materials(owner))
            for material in self._slots_of[key]:
                self._check_uv_map(material, index)
        slots = self._slots_of[key]
        self._slots.append(slots)
        if asked := self._asked_by(slots):
            self._lookups.note(len(self._slots) - 1, instance, owner, asked)

    def _asked_by(self, slots: tuple[int, ...]) -> frozenset[tuple[str, str]]:
        """What the materials in `slots` ask of an instance."""
        if slots not in self._asked:
            shown = [self._materials.found[i] for i in slots]
            self._asked[slots] = frozenset().union(*(asked_for(m.graph) for m in shown if not m.is_exact))
        return self._asked[slots]

    def _index(self, owner: Any) -> int:
        """Where the owner's mesh stands in `meshes`; -1 if it has no triangles."""
        pointer = owner.data.as_pointer()
        if pointer not in self._mesh_index:
            made = self._read(owner, self._warn)
            self._mesh_index[pointer] = -1 if made is None else len(self.meshes)
            if made is not None:
                layer = uv_map_of(owner.data)
                self.meshes.append(made)
                self._uv_maps.append(layer.name if layer else "")
            if any(p.settings.type == "HAIR" and p.settings.render_type == "PATH" for p in owner.particle_systems):
                self._warn(f"Object '{owner.name}' has hair strands, which are not supported; they are left out")
            if _is_adaptive(owner):
                self._warn(f"Object '{owner.name}': adaptive subdivision is not supported; the modifier's own levels "
                           "are used")
        return self._mesh_index[pointer]

    def _slot_materials(self, owner: Any) -> list[Any]:
        """The material (or None) of each slot, at least one: the object's where it has its own, else the mesh's."""
        if self._override is not None:
            return [self._override]
        materials = list(owner.data.materials)
        slots = owner.material_slots
        materials += [None] * (len(slots) - len(materials))
        for i, slot in enumerate(slots):
            materials[i] = slot.material or materials[i]
        return materials or [None]

    def _check_uv_map(self, material: int, mesh: int) -> None:
        others = self._materials.uv_maps[material] - {self._uv_maps[mesh], ""}
        if others:
            self._materials.differ(material)


def _is_adaptive(owner: Any) -> bool:
    """Whether Cycles would dice the surface by the size of pixels: Blender 5 asks the modifier, 4 the object."""
    last = owner.modifiers[-1] if owner.modifiers else None
    if last is None or last.type != "SUBSURF":
        return False
    of_object = getattr(getattr(owner, "cycles", None), "use_adaptive_subdivision", False)
    return bool(getattr(last, "use_adaptive_subdivision", of_object))
