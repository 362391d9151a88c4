# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes with other positions, and the normals that go with them."""

from __future__ import annotations

import numpy as np

from .geometry import Attribute, Mesh, with_fields

# Positions before a mesh was moved, which its generated coordinates are of
REST = "\0rest"

_FLAT = 1e-4  # how far corners' normals may be from their triangle's for it to count as flat


def vertex_normals(mesh: Mesh) -> np.ndarray:
    """(n_vertices, 3) f4: means of the normals around each vertex, by the triangles' angles there."""
    weighted = face_normals(mesh)[:, None] * _angles(mesh)[..., None]
    return _unit(_sums(mesh.triangles.ravel(), weighted.reshape(-1, 3), len(mesh.positions))).astype("f4")


def moved_mesh(mesh: Mesh, moves: np.ndarray, keeps: np.ndarray) -> Mesh:
    """`mesh` with positions moved by (n_vertices, 3) f4. Corners that had one normal still have one; flat faces stay.

    keeps  (n_triangles,) bool: whose normals do not follow, for they will be bumped; these are all smooth, as in Cycles
    """
    moved = with_fields(mesh, positions=(mesh.positions + moves).astype("f4"))
    moved.__dict__.pop("plain", None)
    moved.__dict__.pop("shaded", None)
    own, faces = face_normals(mesh)[:, None], face_normals(moved)
    flat = (np.abs(mesh.corner_normals - own).max((1, 2)) < _FLAT)
    words = np.ascontiguousarray(mesh.corner_normals.reshape(-1, 3) + np.float32(0)).view("u4").astype("u8")
    keys = mesh.triangles.ravel().astype("u8")
    for i in range(3):
        keys = (keys ^ words[:, i]) * np.uint64(0x9E3779B97F4A7C15)
        keys ^= keys >> np.uint64(29)
    groups = np.unique(keys, return_inverse=True)[1].ravel()
    sums = _sums(groups, np.repeat(faces, 3, axis=0), int(groups.max(initial=-1)) + 1)  # as Cycles, not by angles
    normals = _unit(sums)[groups].reshape(-1, 3, 3)
    normals = np.where(keeps[:, None, None], vertex_normals(mesh)[mesh.triangles], normals)
    normals = np.where(((flat & ~keeps)[:, None, None] | ~normals.any(-1, keepdims=True)), faces[:, None], normals)
    attributes = (*mesh.attributes, Attribute(REST, "POINT", mesh.positions))
    return with_fields(moved, corner_normals=normals.astype("f4"), attributes=attributes)


def face_normals(mesh: Mesh) -> np.ndarray:
    """(n_triangles, 3) f8, unit."""
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype("f8") for i in range(3))
    normals = _unit(np.cross(b - a, c - a))
    normals[~normals.any(1)] = 0, 0, 1  # of what has no area any more
    return normals


def _angles(mesh: Mesh) -> np.ndarray:
    corners = mesh.positions[mesh.triangles].astype("f8")
    sides = [_unit(corners[:, (i + 1) % 3] - corners[:, i]) for i in range(3)]
    return np.stack([np.arccos(np.clip(-(sides[i] * sides[i - 1]).sum(1), -1, 1)) for i in range(3)], 1)


def _sums(places: np.ndarray, rows: np.ndarray, n: int) -> np.ndarray:
    return np.stack([np.bincount(places, rows[:, i], n) for i in range(3)], 1)


def _unit(v: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.divide(v, length, out=np.zeros_like(v), where=length > 0)
