# SPDX-License-Identifier: GPL-3.0-or-later
"""Tangents along u, as normal maps are baked against them [Mikkelsen08], without its rules for odd meshes."""

from __future__ import annotations

import numpy as np

from .geometry import Mesh

_MIXERS = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], "u8")


def tangents(mesh: Mesh, uvs: np.ndarray) -> np.ndarray:
    """(3 n_triangles, 4) f4: at each corner the unit tangent in object space, and 1, or -1 where the UVs are mirrored.

    Triangles that share a corner's position, normal and UVs share its tangent: the mean of theirs in the normal's
    plane, by the angles that they have there.

    uvs  (n_triangles, 3, 2) f4
    """
    corners = mesh.positions[mesh.triangles].astype("f8")
    d1, d2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    t1, t2 = (uvs[:, i].astype("f8") - uvs[:, 0] for i in (1, 2))
    area = t1[:, 0] * t2[:, 1] - t1[:, 1] * t2[:, 0]
    sign = np.where(area > 0, 1.0, -1.0)
    along = _unit((t2[:, 1:] * d1 - t1[:, 1:] * d2) * sign[:, None])
    along[area == 0] = 0
    normals = mesh.corner_normals.astype("f8")
    flat = _unit(along[:, None] - normals * (normals * along[:, None]).sum(-1, keepdims=True))
    weighted = (flat * _angles(corners, normals)[..., None]).reshape(-1, 3)
    groups = _groups(corners.astype("f4"), mesh.corner_normals, uvs, sign)
    sums = np.stack([np.bincount(groups, weighted[:, i]) for i in range(3)], 1)
    made = np.empty((3 * len(corners), 4), "f4")
    made[:, :3] = _unit(sums)[groups]
    made[:, 3] = np.repeat(sign, 3)
    return made


def _angles(corners: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """(n, 3) angle of each corner in the plane of its normal."""
    found = np.empty(corners.shape[:2])
    for i in range(3):
        n = normals[:, i]
        a, b = (corners[:, (i + k) % 3] - corners[:, i] for k in (1, 2))
        a, b = (_unit(v - n * (n * v).sum(1, keepdims=True)) for v in (a, b))
        found[:, i] = np.arccos(np.clip((a * b).sum(1), -1, 1))
    return found


def _groups(corners: np.ndarray, normals: np.ndarray, uvs: np.ndarray, sign: np.ndarray) -> np.ndarray:
    """(3 n,) number of the group of each corner: equal in all that is given."""
    rows = np.concatenate([corners, normals, uvs, np.broadcast_to(sign[:, None, None], (*corners.shape[:2], 1))], 2)
    words = np.ascontiguousarray(rows.astype("f4").reshape(-1, 9) + np.float32(0)).view("u4").astype("u8")
    keys = np.zeros(len(words), "u8")
    for i in range(words.shape[1]):
        keys = (keys ^ words[:, i]) * _MIXERS[i % 3]
        keys ^= keys >> np.uint64(29)
    return np.unique(keys, return_inverse=True)[1].ravel()


def _unit(v: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.divide(v, length, out=np.zeros_like(v), where=length > 0)
