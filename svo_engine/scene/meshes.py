# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes from raw arrays: bad triangles are dropped and reported by name, so that no pass ever meets one."""

from __future__ import annotations

import numpy as np

from ..errors import SceneError
from .types import Mesh

# Blender's own meshes reach 1e5 m at most in practice; squares of lengths beyond this leave the range of f4
LARGEST_COORDINATE = 1e15

# Normals as near to unit length as f4 gives them are kept to the bit
_UNIT_TOLERANCE = 1e-5
_SHORTEST_NORMAL = 1e-6

_PART = 1 << 14  # triangles


def make_mesh(name: str, positions: np.ndarray, triangles: np.ndarray, corner_normals: np.ndarray | None = None,
              corner_uvs: np.ndarray | None = None,
              material_slots: np.ndarray | None = None) -> tuple[Mesh, tuple[str, ...]]:
    """A Mesh and the warnings about what was dropped from it.

    positions  (n_vertices, 3), triangles (n_triangles, 3); optional arrays as in `Mesh`, default: the triangle's own
    normal, zero coordinates, slot 0. Triangles with a corner that is not finite are dropped; so are, without a word,
    those without area, for they cover nothing and Blender's own texts and spheres have them, and vertices that no
    triangle is left to use. Normals and coordinates that are not finite are replaced by the triangle's normal and by
    zero. SceneError if a triangle names a vertex that is not there.
    """
    positions = np.ascontiguousarray(positions, "f4").reshape(-1, 3)
    triangles = np.ascontiguousarray(triangles, "u4").reshape(-1, 3)
    if len(triangles) and triangles.max() >= len(positions):
        raise SceneError(f"Mesh '{name}': a triangle names vertex {triangles.max()} of {len(positions)}")
    finite = (np.abs(positions) < LARGEST_COORDINATE).all(1)[triangles].all(1)
    cross = _cross(positions, triangles, finite)
    keep = (cross != 0).any(1)

    normals, uvs, slots = (None if a is None else _kept(np.asarray(a, dtype).reshape(-1, *shape), keep)
                           for a, dtype, shape in ((corner_normals, "f4", (3, 3)), (corner_uvs, "f4", (3, 2)),
                                                   (material_slots, None, ())))
    n = int(keep.sum())
    normals, uvs, n_bad_uvs = _unit_normals(normals, _kept(cross, keep)), *_finite_uvs(uvs, n)
    slots = np.zeros(n, "u4") if slots is None else slots.astype("u4")
    counts = ((int((~finite).sum()), "triangles dropped: a corner is not a finite number"),
              (n_bad_uvs, "triangles have UV coordinates that are not finite; zero is used"))
    warnings = tuple(f"Mesh '{name}': {count} {what}" for count, what in counts if count)
    return Mesh(name, *_used(positions, _kept(triangles, keep)), normals, uvs, slots), warnings


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


def _finite_uvs(uvs: np.ndarray | None, n: int) -> tuple[np.ndarray, int]:
    """Coordinates (n, 3, 2) f4 with zeros for all that is not finite, and how many triangles that concerns."""
    if uvs is None:
        return np.zeros((n, 3, 2), "f4"), 0
    finite = np.isfinite(uvs)
    if finite.all():
        return np.ascontiguousarray(uvs), 0
    return np.where(finite, uvs, 0).astype("f4"), int((~finite).any((1, 2)).sum())


def _used(positions: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Only the vertices that triangles use, so that no other one counts for the bounds, and the triangles in them."""
    used = np.zeros(len(positions), bool)
    used[triangles] = True
    if used.all():
        return positions, triangles
    return positions[used], (np.cumsum(used) - 1).astype("u4")[triangles]
