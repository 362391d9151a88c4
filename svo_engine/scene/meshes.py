# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes from raw arrays: bad triangles are dropped, counted and reported by name, so that no pass ever meets one."""

from __future__ import annotations

import numpy as np

from .types import Mesh

# Blender's own meshes reach 1e5 m at most in practice; squares of lengths beyond this leave the range of f4
LARGEST_COORDINATE = 1e15


def make_mesh(name: str, positions: np.ndarray, triangles: np.ndarray, corner_normals: np.ndarray | None = None,
              corner_uvs: np.ndarray | None = None,
              material_slots: np.ndarray | None = None) -> tuple[Mesh, tuple[str, ...]]:
    """A Mesh and the warnings about what was dropped from it.

    positions  (n_vertices, 3), triangles (n_triangles, 3); optional arrays as in `Mesh`, default: the triangle's own
    normal, zero coordinates, slot 0. Triangles with a corner that is not finite or with no area are dropped; normals
    and coordinates that are not finite are replaced by the triangle's normal and by zero.
    """
    positions = np.ascontiguousarray(positions, "f4").reshape(-1, 3)
    triangles = np.ascontiguousarray(triangles, "u4").reshape(-1, 3)
    finite_vertex = (np.abs(positions) < LARGEST_COORDINATE).all(1)
    finite = finite_vertex[triangles].all(1)
    safe = np.where(finite_vertex[:, None], positions, 0).astype("f4")
    a, b, c = (safe[triangles[:, i]].astype("f8") for i in range(3))
    cross = np.cross(b - a, c - a)
    length = np.linalg.norm(cross, axis=1)
    keep = finite & (length > 0)
    flat = (cross[keep] / length[keep, None]).astype("f4")
    n = int(keep.sum())

    normals = np.repeat(flat[:, None], 3, 1)
    if corner_normals is not None:
        given = np.asarray(corner_normals, "f4").reshape(-1, 3, 3)[keep]
        lengths = np.linalg.norm(given, axis=2, keepdims=True)
        good = np.isfinite(lengths) & (lengths > 1e-6)
        normals = np.where(good, given / np.where(good, lengths, 1), normals)
    uvs = np.zeros((n, 3, 2), "f4")
    bad_uvs = 0
    if corner_uvs is not None:
        uvs = np.asarray(corner_uvs, "f4").reshape(-1, 3, 2)[keep]
        bad_uvs = int((~np.isfinite(uvs)).any((1, 2)).sum())
        uvs = np.where(np.isfinite(uvs), uvs, 0)
    slots = np.zeros(n, "u4") if material_slots is None else np.asarray(material_slots).astype("u4")[keep]

    counts = ((int((~finite).sum()), "triangles dropped: a corner is not a finite number"),
              (int((finite & ~(length > 0)).sum()), "triangles dropped: they have no area"),
              (bad_uvs, "triangles have UV coordinates that are not finite; zero is used"))
    warnings = tuple(f"Mesh '{name}': {count} {what}" for count, what in counts if count)
    mesh = Mesh(name, safe, triangles[keep], np.ascontiguousarray(normals, "f4"), np.ascontiguousarray(uvs, "f4"),
                np.ascontiguousarray(slots, "u4"))
    return mesh, warnings
