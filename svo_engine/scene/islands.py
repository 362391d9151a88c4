# SPDX-License-Identifier: GPL-3.0-or-later
"""Connected parts of meshes, and how pointed their vertices are."""

from __future__ import annotations

import numpy as np

from .geometry import Mesh

_FULL = 0xFFFFFFFF


def islands(mesh: Mesh) -> np.ndarray:
    """(n_triangles,) f4: a random number from 0 to 1 for each connected part of the mesh."""
    lowest = np.arange(len(mesh.positions), dtype="i8")
    while True:  # each vertex takes the lowest number around it, and that one's
        of_triangles = lowest[mesh.triangles].min(1) if len(mesh.triangles) else np.zeros(0, "i8")
        found = lowest.copy()
        for i in range(3):
            np.minimum.at(found, mesh.triangles[:, i], of_triangles)
        found = found[found]
        if np.array_equal(found, lowest):
            break
        lowest = found
    return (_hashed(lowest[mesh.triangles[:, 0]].astype("u4")) / _FULL).astype("f4")


def pointiness(mesh: Mesh) -> np.ndarray:
    """(n_vertices,) f8: the angle between a vertex's normal and the mean of its edges, as a share of pi, blurred over
    its neighbours, as Cycles has it. Triangles' own edges stand for those of faces with more corners."""
    n = len(mesh.positions)
    _, first, merged = np.unique(mesh.positions, axis=0, return_index=True, return_inverse=True)
    merged = merged.ravel()
    triangles = merged[mesh.triangles]
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = np.unique(np.sort(sides, 1), axis=0)
    a, b = edges[edges[:, 0] != edges[:, 1]].T if len(edges) else np.zeros((2, 0), "i8")
    points = mesh.positions[first].astype("f8")
    along = _unit(points[b] - points[a])
    normals = _unit(_sums(triangles.ravel(), mesh.corner_normals.reshape(-1, 3).astype("f8"), len(first)))
    counts = np.bincount(np.concatenate([a, b]), minlength=len(first))
    mean = _sums(np.concatenate([a, b]), np.concatenate([along, -along]), len(first)) / np.maximum(counts, 1)[:, None]
    raw = np.where(counts > 0, np.arccos(np.clip((normals * mean).sum(1), -1, 1)) / np.pi, 0)
    around = np.bincount(a, raw[b], len(first)) + np.bincount(b, raw[a], len(first))
    return ((raw + around) / (counts + 1))[merged] if n else np.zeros(0)


def _sums(places: np.ndarray, rows: np.ndarray, n: int) -> np.ndarray:
    return np.stack([np.bincount(places, rows[:, i], n) for i in range(3)], 1)


def _unit(v: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.divide(v, length, out=np.zeros_like(v), where=length > 0)


def _hashed(x: np.ndarray) -> np.ndarray:
    """A permuted congruential hash of u4, as `hash` in shaders/lib/math.glsl."""
    x = x * np.uint32(747796405) + np.uint32(2891336453)
    x = ((x >> ((x >> np.uint32(28)) + np.uint32(4))) ^ x) * np.uint32(277803737)
    return (x >> np.uint32(22)) ^ x
