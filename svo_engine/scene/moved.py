# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that materials move: their normals before and after, as Cycles has them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .geometry import REST, Attribute, Mesh

_SAME = 1e-4  # normals as near as this are one


def vertex_normals(mesh: Mesh) -> np.ndarray:
    """(n_vertices, 3) f4, unit: what vertices move along. Those of smooth faces where all of these agree, else means of
    the faces around a vertex by their angles there, as Blender has it.
    """
    own, _ = face_normals(mesh.positions, mesh.triangles)
    weighted = own[:, None] * _angles(mesh.positions[mesh.triangles].astype("f8"))[..., None]
    made = _unit(_sums(mesh.triangles.ravel(), weighted.reshape(-1, 3), len(mesh.positions)))
    smooth = ~flat_faces(mesh)
    if not _is_split(mesh, smooth):
        made[mesh.triangles[smooth]] = mesh.corner_normals[smooth]
    return made.astype("f4")


def moved_mesh(mesh: Mesh, moves: np.ndarray, bends: np.ndarray, bumps: np.ndarray) -> Mesh:
    """`mesh` with its vertices moved. Triangles that have no area then are left out.

    Flat faces stay flat, smooth ones get means of the faces around a vertex, not by angles. Where sharp edges split the
    normals at a vertex, all of them turn as that mean does.

    moves  (n_vertices, 3) f4, metres, object space
    bends  (n_triangles,) bool: of which materials vertices get normals anew
    bumps  (n_triangles,) bool: whose normals do not follow, for they will be bumped; these are all smooth, as in Cycles
    """
    positions, corners = (mesh.positions + moves).astype("f4"), mesh.triangles
    flat, (own, has_area) = flat_faces(mesh), face_normals(positions, corners)
    if _is_split(mesh, ~flat):
        before, _ = face_normals(mesh.positions, corners)
        turn = _means(corners, own, len(positions)) - _means(corners, before, len(positions))
        normals = _unit(mesh.corner_normals + turn[corners])
    else:
        means = _means(corners[bends], own[bends], len(positions))[corners]
        normals = np.where(means.any(-1, keepdims=True), means, mesh.corner_normals)
    normals = np.where(flat[:, None, None] | ~normals.any(-1, keepdims=True), own[:, None], normals)
    normals = np.where(bumps[:, None, None], vertex_normals(mesh)[corners], normals).astype("f4")
    attributes = (*mesh.attributes, Attribute(REST, "POINT", mesh.positions))
    if has_area.all():
        return replace(mesh, positions=positions, corner_normals=normals, flat=flat, attributes=attributes)
    return replace(mesh, positions=positions, triangles=corners[has_area], corner_normals=normals[has_area],
                   material_slots=mesh.material_slots[has_area], flat=flat[has_area],
                   attributes=tuple(_kept(a, has_area) for a in attributes))


def flat_faces(mesh: Mesh) -> np.ndarray:
    """(n_triangles,) bool. Where nobody has said, those whose corners have their triangle's own normal."""
    if len(mesh.flat):
        return mesh.flat
    own, _ = face_normals(mesh.positions, mesh.triangles)
    return np.abs(mesh.corner_normals - own[:, None]).max((1, 2), initial=0) < _SAME


def face_normals(positions: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n_triangles, 3) f8, unit, and whether each has an area; along x where it has none."""
    a, b, c = positions[triangles.T].astype("f8")
    cross = np.cross(b - a, c - a)
    has_area = (cross != 0).any(1)
    normals = _unit(cross)
    normals[~has_area] = 1, 0, 0
    return normals, has_area


def _is_split(mesh: Mesh, smooth: np.ndarray) -> bool:
    """Whether two of the smooth triangles have different normals at one vertex."""
    vertices, normals = mesh.triangles[smooth].ravel(), mesh.corner_normals[smooth].reshape(-1, 3)
    of_vertex = np.zeros((len(mesh.positions), 3), "f4")
    of_vertex[vertices] = normals
    return bool(np.abs(of_vertex[vertices] - normals).max(initial=0) > _SAME)


def _means(triangles: np.ndarray, normals: np.ndarray, n: int) -> np.ndarray:
    """(n, 3) f8: at each vertex the unit mean of the normals (n_triangles, 3) around it; zero without any."""
    return _unit(_sums(triangles.ravel(), np.repeat(normals, 3, axis=0), n))


def _angles(corners: np.ndarray) -> np.ndarray:
    """(n_triangles, 3) f8, radians, of triangles (n_triangles, 3, 3)."""
    sides = [_unit(corners[:, (i + 1) % 3] - corners[:, i]) for i in range(3)]
    return np.stack([np.arccos(np.clip(-(sides[i] * sides[i - 1]).sum(1), -1, 1)) for i in range(3)], 1)


def _kept(attribute: Attribute, keep: np.ndarray) -> Attribute:
    """Without the rows of triangles that are not kept."""
    if attribute.domain == "POINT":
        return attribute
    return replace(attribute, values=attribute.values[keep if attribute.domain == "FACE" else np.repeat(keep, 3)])


def _sums(places: np.ndarray, rows: np.ndarray, n: int) -> np.ndarray:
    return np.stack([np.bincount(places, rows[:, i], n) for i in range(3)], 1).astype("f8")  # also of no rows


def _unit(v: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.divide(v, length, out=np.zeros_like(v), where=length > 0)
