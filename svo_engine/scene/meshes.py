# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes from raw arrays: bad triangles are dropped and reported by name, so that no pass ever meets one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..errors import SceneError
from .geometry import Domain
from .types import Attribute, Mesh

# Blender's own meshes reach 1e5 m at most in practice; squares of lengths beyond this leave the range of f4
LARGEST_COORDINATE = 1e15

# Normals as near to unit length as f4 gives them are kept to the bit
_UNIT_TOLERANCE = 1e-5
_SHORTEST_NORMAL = 1e-6

_PART = 1 << 14  # triangles


class Raw(NamedTuple):
    """As an Attribute, with values that nobody has looked at yet."""

    name: str
    domain: Domain
    values: np.ndarray


def make_mesh(name: str, positions: np.ndarray, triangles: np.ndarray, corner_normals: np.ndarray | None = None,
              corner_uvs: np.ndarray | None = None, material_slots: np.ndarray | None = None,
              flat: np.ndarray | None = None, raw: Sequence[Raw] = (), **more: Any) -> tuple[Mesh, tuple[str, ...]]:
    """A Mesh and the warnings about what was dropped from it.

    positions  (n_vertices, 3), triangles (n_triangles, 3); optional arrays as in `Mesh`, default: the triangle's own
    normal, slot 0, flat where normals say so. raw: attributes before anything is dropped; corner_uvs is short for an
    active UV map among them; `more` are fields of Mesh. Triangles with a corner that is not finite are dropped; so are,
    without a word, those without area, for they cover nothing and Blender's own texts and spheres have them, and
    vertices that no triangle is left to use. Normals and values that are not finite are replaced by the triangle's
    normal and by zero. SceneError if a triangle names a vertex that is not there.
    """
    positions = np.ascontiguousarray(positions, "f4").reshape(-1, 3)
    triangles = np.ascontiguousarray(triangles, "u4").reshape(-1, 3)
    if len(triangles) and triangles.max() >= len(positions):
        raise SceneError(f"Mesh '{name}': a triangle names vertex {triangles.max()} of {len(positions)}")
    if corner_uvs is not None:
        raw, more = (*raw, Raw("UVMap", "CORNER", np.reshape(corner_uvs, (-1, 2)))), {**more, "uv_map": "UVMap"}
    finite = (np.abs(positions) < LARGEST_COORDINATE).all(1)[triangles].all(1)
    cross = _cross(positions, triangles, finite)
    keep = (cross != 0).any(1)

    normals, slots = (None if a is None else _kept(np.asarray(a, dtype).reshape(-1, *shape), keep)
                      for a, dtype, shape in ((corner_normals, "f4", (3, 3)), (material_slots, None, ())))
    normals = _unit_normals(normals, _kept(cross, keep))
    slots = np.zeros(len(normals), "u4") if slots is None else slots.astype("u4")
    if flat is not None:
        more["flat"] = _kept(np.asarray(flat, bool), keep)
    used = np.zeros(len(positions), bool)
    triangles = _kept(triangles, keep)
    used[triangles] = True
    attributes, warnings = _attributes(raw, {"POINT": used, "FACE": keep, "CORNER": keep})
    if not finite.all():
        warnings = (f"{int((~finite).sum())} triangles dropped: a corner is not a finite number", *warnings)
    made = Mesh(name, *_used(positions, triangles, used), normals, slots, attributes, **more)
    return made, tuple(f"Mesh '{name}': {warning}" for warning in warnings)


def _attributes(raw: Sequence[Raw], keep: dict[str, np.ndarray]) -> tuple[tuple[Attribute, ...], tuple[str, ...]]:
    """The attributes' rows to keep, zeros for all that is not finite, and warnings about that."""
    made, warnings = [], []
    for name, domain, values in raw:
        rows = np.asarray(values, "f4")
        rows = _kept(rows.reshape(-1, 3, rows.shape[1]) if domain == "CORNER" else rows, keep[domain])
        finite = np.isfinite(rows)
        if not finite.all():
            n_bad = int((~finite.reshape(len(rows), -1).all(1)).sum())
            whose = {"POINT": "vertices", "FACE": "triangles", "CORNER": "triangles"}[domain]
            warnings.append(f"{n_bad} {whose} have values of '{name}' that are not finite; zero is used")
            rows = np.where(finite, rows, np.float32(0))
        made.append(Attribute(name, domain, np.ascontiguousarray(rows).reshape(-1, values.shape[1])))
    return tuple(made), tuple(warnings)


def _kept(rows: np.ndarray, keep: np.ndarray) -> np.ndarray:
    """The rows to keep; without a copy if that is all of them."""
    return rows if keep.all() else rows[keep]


def _cross(positions: np.ndarray, triangles: np.ndarray, finite: np.ndarray) -> np.ndarray:
    """Normals (n, 3) f8 as long as twice the area; doubles hold products of coordinates without loss.

    Zero for triangles that are not `finite`. Done in parts that fit into the processor's cache.
    """
    cross = np.empty((len(triangles), 3))
    with np.errstate(invalid="ignore", over="ignore"):
        for part in (slice(i, i + _PART) for i in range(0, len(triangles), _PART)):
            a, b, c = positions[triangles[part].T].astype("f8")
            u, v = (b - a).T, (c - a).T
            for i in range(3):
                j, k = (i + 1) % 3, (i + 2) % 3
                cross[part, i] = u[j] * v[k] - u[k] * v[j]
    return cross if finite.all() else np.where(finite[:, None], cross, 0)


def _unit_normals(normals: np.ndarray | None, cross: np.ndarray) -> np.ndarray:
    """Unit corner normals (n, 3, 3) f4; the triangle's own, along `cross` (n, 3), where there is none to normalise."""
    if normals is None:
        return np.repeat(_unit(cross).astype("f4")[:, None], 3, 1)
    with np.errstate(invalid="ignore", over="ignore"):
        lengths = np.sqrt(np.einsum("ijk,ijk->ij", normals, normals))
        off = ~(np.abs(lengths - 1) < _UNIT_TOLERANCE)
    if not off.any():
        return np.ascontiguousarray(normals)
    normals = normals.copy()
    missing = ~np.isfinite(lengths) | (lengths < _SHORTEST_NORMAL)
    normals[off & ~missing] = _unit(normals[off & ~missing].astype("f8"))
    normals[missing] = _unit(cross[missing.nonzero()[0]])
    return normals


def _unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) at length 1; scaled first so that the square of no small one is lost."""
    vectors = vectors / np.abs(vectors).max(1, keepdims=True)
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def _used(positions: np.ndarray, triangles: np.ndarray, used: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Only the vertices that triangles use, so that no other one counts for the bounds, and the triangles in them."""
    if used.all():
        return positions, triangles
    return positions[used], (np.cumsum(used) - 1).astype("u4")[triangles]
