# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with their attributes, and where they are placed."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal, TypeVar

import numpy as np

from ..errors import SceneError
from .checks import check

Domain = Literal["POINT", "FACE", "CORNER", "INSTANCE"]

T = TypeVar("T")

# The name of the attribute that positions are before materials move them, where they do
REST = "\0rest"

# Bits of Instances.visibility: the rays that see it, as in Cycles
VISIBLE = {"camera": 1, "diffuse": 2, "glossy": 4, "transmission": 8, "volume": 16, "shadow": 32}
ALL_VISIBLE = 63
IS_HOLDOUT, IS_SHADOW_CATCHER = 64, 128

_NOT_SET, _NO_FLAGS = np.zeros(0, "u1"), np.zeros(0, "?")

# Arrays that each instance has a row of: (dtype, the rest of the shape, what it is if nobody says)
_ROWS: dict[str, tuple[str, tuple[int, ...], Any]] = {
    "ids": ("i8", (), 0), "random": ("f4", (), 0), "object_index": ("i4", (), 0), "color": ("f4", (4,), 1),
    "generated": ("f4", (3,), 0), "uv": ("f4", (2,), 0), "visibility": ("u4", (), ALL_VISIBLE),
    "light_set": ("u8", (), 2**64 - 1), "shadow_set": ("u8", (), 2**64 - 1)}

# Those that no material asks for
_NOT_SHADED = "ids", "visibility", "light_set", "shadow_set"


def _not_set() -> np.ndarray:
    return _NOT_SET


def _no_flags() -> np.ndarray:
    return _NO_FLAGS


@dataclass(frozen=True, eq=False)
class Attribute:
    """Numbers with a name, as shader nodes ask for it.

    domain  POINT: a row for each of the mesh's positions; FACE: for each triangle; CORNER: for each corner of each
            triangle, three one after another; INSTANCE: for each instance
    values  (n, 1 to 4) f4; colours are scene-linear RGBA, integers and booleans numbers
    """

    name: str
    domain: Domain
    values: np.ndarray

    def __post_init__(self) -> None:
        owner = f"Attribute '{self.name}'"
        if self.domain not in ("POINT", "FACE", "CORNER", "INSTANCE"):
            raise SceneError(f"{owner}: there is no domain '{self.domain}'")
        check(owner, "values", self.values, "f4", (None, None))
        if not 1 <= self.values.shape[1] <= 4:
            raise SceneError(f"{owner}: it has {self.values.shape[1]} numbers in a row, not 1 to 4")


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles of one evaluated mesh, stored once however many instances show it. Build with `meshes.make_mesh`.

    positions       (n_vertices, 3) f4, metres, object space
    triangles       (n_triangles, 3) u4, indices into positions
    corner_normals  (n_triangles, 3, 3) f4, unit shading normals, object space
    material_slots  (n_triangles,) u4, the slot of each triangle; an instance says which material sits in a slot
    attributes      those that there are, UV maps and colours among them
    uv_map, color   the attributes that are meant where a material names none; '' without any
    generated_low, generated_size
                    metres, object space: generated coordinates are (position - low) / size
    motion          positions at other times, each as `positions`
    flat            (n_triangles,) bool, those of flat faces; empty where their normals alone say that
    """

    name: str
    positions: np.ndarray
    triangles: np.ndarray
    corner_normals: np.ndarray
    material_slots: np.ndarray
    attributes: tuple[Attribute, ...] = ()
    uv_map: str = ""
    color: str = ""
    generated_low: tuple[float, float, float] = (0.0, 0.0, 0.0)
    generated_size: tuple[float, float, float] = (1.0, 1.0, 1.0)
    motion: tuple[np.ndarray, ...] = ()
    flat: np.ndarray = field(default_factory=_no_flags)

    def __post_init__(self) -> None:
        owner = f"Mesh '{self.name}'"
        n = len(self.triangles)
        check(owner, "positions", self.positions, "f4", (None, 3))
        check(owner, "triangles", self.triangles, "u4", (None, 3))
        check(owner, "corner_normals", self.corner_normals, "f4", (n, 3, 3))
        check(owner, "material_slots", self.material_slots, "u4", (n,))
        if n and self.triangles.max() >= len(self.positions):
            raise SceneError(f"{owner}: a triangle names vertex {self.triangles.max()} of {len(self.positions)}")
        for positions in self.motion:
            check(owner, "motion", positions, "f4", self.positions.shape)
        if len(self.flat):
            check(owner, "flat", self.flat, "?", (n,))
        _check_attributes(owner, self.attributes, {"POINT": len(self.positions), "FACE": n, "CORNER": 3 * n})
        for name in filter(None, (self.uv_map, self.color)):
            if self.attribute(name) is None:
                raise SceneError(f"{owner}: there is no attribute '{name}'")
        self._check_uv_map(owner)

    def _check_uv_map(self, owner: str) -> None:
        uv_map = self.attribute(self.uv_map)
        if uv_map is not None and (uv_map.domain, uv_map.values.shape[1]) != ("CORNER", 2):
            raise SceneError(f"{owner}: attribute '{self.uv_map}' is no UV map")

    def attribute(self, name: str) -> Attribute | None:
        """The attribute called `name`; None without it."""
        return next((a for a in self.attributes if a.name == name), None)

    @cached_property
    def corner_uvs(self) -> np.ndarray:
        """(n_triangles, 3, 2) f4: coordinates of the active UV map, zeros without one."""
        uv_map = self.attribute(self.uv_map)
        return np.zeros((len(self.triangles), 3, 2), "f4") if uv_map is None else uv_map.values.reshape(-1, 3, 2)

    @cached_property
    def shaded(self) -> Mesh:
        """As `Scene.plain` has it where materials may ask for all that there is."""
        return with_fields(self, name="", motion=())

    @cached_property
    def plain(self) -> Mesh:
        """As `Scene.plain`."""
        uv_map = self.attribute(self.uv_map)
        return with_fields(self, name="", attributes=() if uv_map is None else (uv_map,), color="", motion=(),
                           generated_low=(0.0, 0.0, 0.0), generated_size=(1.0, 1.0, 1.0),
                           flat=_NO_FLAGS)


@dataclass(frozen=True, eq=False)
class Instances:
    """Every visible placing of a mesh. Instance i has the materials `slot_materials[first_slot[i]:first_slot[i + 1]]`.

    names              n strings, the object's name, for messages
    mesh               (n,) u4, index into Scene.meshes
    world_from_object  (n, 4, 4) f8, metres
    first_slot         (n + 1,) u4, ascending
    slot_materials     (k,) u4, indices into Scene.materials

    ids                (n,) i8, the same for the same thing in all frames; 0 where nobody has said
    random             (n,) f4, 0 to 1, what Cycles' Object Info node gives as Random
    object_index       (n,) i4, pass index of the object
    color              (n, 4) f4, colour of the object, scene-linear RGBA
    generated, uv      (n, 3) f4 and (n, 2) f4, where on its instancer it stands, as Texture Coordinate "From Instancer"
    visibility         (n,) u4, bits VISIBLE, IS_HOLDOUT, IS_SHADOW_CATCHER
    light_set, shadow_set
                       (n,) u8, bits of the sets of light linking that it is in, as receiver and as blocker
    attributes         of domain INSTANCE
    motion             matrices at other times, each as `world_from_object`
    """

    names: tuple[str, ...]
    mesh: np.ndarray
    world_from_object: np.ndarray
    first_slot: np.ndarray
    slot_materials: np.ndarray
    ids: np.ndarray = field(default_factory=_not_set)
    random: np.ndarray = field(default_factory=_not_set)
    object_index: np.ndarray = field(default_factory=_not_set)
    color: np.ndarray = field(default_factory=_not_set)
    generated: np.ndarray = field(default_factory=_not_set)
    uv: np.ndarray = field(default_factory=_not_set)
    visibility: np.ndarray = field(default_factory=_not_set)
    light_set: np.ndarray = field(default_factory=_not_set)
    shadow_set: np.ndarray = field(default_factory=_not_set)
    attributes: tuple[Attribute, ...] = ()
    motion: tuple[np.ndarray, ...] = ()

    def __post_init__(self) -> None:
        n = len(self.names)
        check("Instances", "mesh", self.mesh, "u4", (n,))
        check("Instances", "world_from_object", self.world_from_object, "f8", (n, 4, 4))
        check("Instances", "first_slot", self.first_slot, "u4", (n + 1,))
        check("Instances", "slot_materials", self.slot_materials, "u4", (int(self.first_slot[-1]),))
        if (np.diff(self.first_slot.astype("i8")) < 1).any():
            raise SceneError("Instances: every instance needs a material slot")
        for name, (dtype, shape, default) in _ROWS.items():
            if getattr(self, name) is _NOT_SET:
                object.__setattr__(self, name, np.full((n, *shape), default, dtype))
            check("Instances", name, getattr(self, name), dtype, (n, *shape))
        for matrices in self.motion:
            check("Instances", "motion", matrices, "f8", (n, 4, 4))
        _check_attributes("Instances", self.attributes, {"INSTANCE": n})

    def __len__(self) -> int:
        return len(self.names)

    @staticmethod
    def empty() -> Instances:
        """No instance at all."""
        return Instances((), np.zeros(0, "u4"), np.zeros((0, 4, 4)), np.zeros(1, "u4"), np.zeros(0, "u4"))

    @cached_property
    def shaded(self) -> Instances:
        """As `Mesh.shaded`."""
        return with_fields(self, names=("",) * len(self), motion=(), **dict.fromkeys(_NOT_SHADED, _NOT_SET))

    @cached_property
    def plain(self) -> Instances:
        """As `Scene.plain`."""
        return with_fields(self, names=("",) * len(self), attributes=(), motion=(), **dict.fromkeys(_ROWS, _NOT_SET))


def chosen(instances: Instances, rows: np.ndarray) -> Instances:
    """The instances of these numbers, without motion."""
    first = instances.first_slot.astype("i8")
    n_slots = np.diff(first)[rows]
    ends = np.cumsum(n_slots)
    slots = np.arange(n_slots.sum()) + np.repeat(first[rows] - ends + n_slots, n_slots)
    values = {name: row[rows] for name in _ROWS if len(row := getattr(instances, name))}
    return with_fields(
        instances, names=tuple(instances.names[i] for i in rows), mesh=instances.mesh[rows],
        world_from_object=instances.world_from_object[rows], first_slot=np.concatenate([[0], ends]).astype("u4"),
        slot_materials=instances.slot_materials[slots], motion=(),
        attributes=tuple(with_fields(a, values=a.values[rows]) for a in instances.attributes), **values)


def with_fields(record: T, **values: Any) -> T:
    """A copy with other values, without the checks that `replace` makes: for values that are known to be right."""
    made = copy(record)
    for name, value in values.items():
        object.__setattr__(made, name, value)
    return made


def _check_attributes(owner: str, attributes: tuple[Attribute, ...], lengths: dict[str, int]) -> None:
    """Raise SceneError unless each attribute has a domain of `lengths`, as many rows, and a name of its own."""
    for attribute in attributes:
        if attribute.domain not in lengths or len(attribute.values) != lengths[attribute.domain]:
            raise SceneError(f"{owner}: attribute '{attribute.name}' has {len(attribute.values)} rows of domain "
                             f"{attribute.domain}")
    if len({attribute.name for attribute in attributes}) < len(attributes):
        raise SceneError(f"{owner}: two attributes have one name")
