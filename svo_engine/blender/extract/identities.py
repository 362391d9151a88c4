# SPDX-License-Identifier: GPL-3.0-or-later
"""What tells one instance from another: identity, random number, index, colour, place on its instancer, visibility."""

from __future__ import annotations

from collections.abc import Sequence
from hashlib import blake2b
from typing import Any

import numpy as np

from ...scene.geometry import ALL_VISIBLE, IS_HOLDOUT, IS_SHADOW_CATCHER, VISIBLE

_FULL = 0xFFFFFFFF


class Identities:
    """Collects one instance after another. There may be many, so little is done and kept for each."""

    def __init__(self) -> None:
        self._keys: list[str] = []
        self._names: list[str] = []
        self._indices: list[int] = []
        self._colors: list[float] = []
        self._visibility: list[int] = []
        self._placed: dict[int, tuple[int, tuple[float, ...], tuple[float, ...]]] = {}
        self._of_parents: dict[str, int] = {}

    def add(self, instance: Any, owner: Any) -> None:
        """The next one: `instance` of the depsgraph, which shows the evaluated object `owner`."""
        key, visibility = owner.name_full, _visibility(owner)
        if instance.is_instance:
            parent = instance.parent
            name = parent.name_full
            if name not in self._of_parents:
                self._of_parents[name] = _visibility(parent) | ~ALL_VISIBLE
            key = f"{key}\0{name}\0{instance.persistent_id[:]}"
            visibility &= self._of_parents[name]
            self._placed[len(self._keys)] = instance.random_id & _FULL, instance.orco[:], instance.uv[:]
        self._keys.append(key)
        self._names.append(owner.name)
        self._indices.append(owner.pass_index)
        self._colors += owner.color[:]
        self._visibility.append(visibility)

    def arrays(self) -> dict[str, Any]:
        """Fields of Instances."""
        n = len(self._keys)
        numbers = _hashes(self._names)
        generated, uv = np.zeros((n, 3), "f4"), np.zeros((n, 2), "f4")
        if self._placed:
            rows = list(self._placed)
            ids, orcos, uvs = zip(*self._placed.values(), strict=True)
            numbers[rows], uv[rows] = ids, uvs
            generated[rows] = np.array(orcos, "f4") * 0.5 - 0.5  # as Cycles has it
        return {
            "ids": _digests(self._keys), "random": (numbers / _FULL).astype("f4"),
            "object_index": np.array(self._indices, "i4"), "color": np.array(self._colors, "f4").reshape(n, 4),
            "generated": generated, "uv": uv, "visibility": np.array(self._visibility, "u4")}


def _visibility(owner: Any) -> int:
    """Bits of Instances.visibility; written out because it is read for each instance."""
    bits: int = (
        VISIBLE["camera"] * owner.visible_camera | VISIBLE["diffuse"] * owner.visible_diffuse
        | VISIBLE["glossy"] * owner.visible_glossy | VISIBLE["transmission"] * owner.visible_transmission
        | VISIBLE["volume"] * owner.visible_volume_scatter | VISIBLE["shadow"] * owner.visible_shadow
        | IS_HOLDOUT * owner.is_holdout | IS_SHADOW_CATCHER * owner.is_shadow_catcher)
    return bits


def _digests(keys: Sequence[str]) -> np.ndarray:
    """(n,) i8, 64 bits of each key, the same in every process."""
    return np.frombuffer(b"".join(blake2b(_encoded(key), digest_size=8).digest() for key in keys), "<i8").astype("i8")


def _hashes(names: Sequence[str]) -> np.ndarray:
    """(n,) u4, what Cycles makes of objects' names: `hash_uint2(hash_string(name), 0)`, Jenkins' lookup3."""
    start = (0xDEADBEEF + (2 << 2) + 13) & _FULL
    a, b, c = (np.full(len(names), start, "u4") for _ in range(3))
    columns = np.array([_encoded(name) for name in names], "S")
    number = np.zeros(len(names), "u4")
    for byte in columns.view("u1").reshape(len(names), -1).T:
        number = np.where(byte, number * np.uint32(37) + byte, number)
    a += number
    c = (c ^ b) - _turned(b, 14)
    a = (a ^ c) - _turned(c, 11)
    b = (b ^ a) - _turned(a, 25)
    c = (c ^ b) - _turned(b, 16)
    a = (a ^ c) - _turned(c, 4)
    b = (b ^ a) - _turned(a, 14)
    return (c ^ b) - _turned(b, 24)


def _encoded(name: str) -> bytes:
    """The bytes that Blender holds."""
    return name.encode(errors="surrogateescape")


def _turned(x: np.ndarray, n: int) -> np.ndarray:
    return x << np.uint32(n) | x >> np.uint32(32 - n)
