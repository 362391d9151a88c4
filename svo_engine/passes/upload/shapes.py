# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes on the device, each once however often it is placed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gpu.device import Device
from ...gpu.program import Resources
from ...gpu.scope import GpuScope
from ...scene.bounds import mesh_boxes
from ...scene.types import Mesh


@dataclass(frozen=True, eq=False)
class Shapes:
    """buffers: those of bind/geometry.glsl that know no instance; meshes: what they hold.

    first_vertex, first_triangle
                    (n_meshes + 1,) i8, ascending
    n_slots         (n_meshes,) i8, material slots that the triangles of each mesh name
    boxes           (n_meshes, 2, 3) f8, metres, object space: lowest and highest corner; not finite without a vertex
    """

    scope: GpuScope
    meshes: tuple[Mesh, ...]
    buffers: Resources
    first_vertex: np.ndarray
    first_triangle: np.ndarray
    n_slots: np.ndarray
    boxes: np.ndarray


def upload_shapes(device: Device, meshes: tuple[Mesh, ...], has_uvs: bool) -> Shapes:
    """Copy the meshes; texture coordinates only if anything reads them."""
    scope = device.scope()
    first_vertex = np.cumsum([0] + [len(m.positions) for m in meshes])
    first_triangle = np.cumsum([0] + [len(m.triangles) for m in meshes])
    triangles = np.zeros((int(first_triangle[-1]), 4), "u4")
    for i, mesh in enumerate(meshes):
        part = triangles[first_triangle[i]:first_triangle[i + 1]]
        part[:, :3] = mesh.triangles + np.uint32(first_vertex[i])
        part[:, 3] = mesh.material_slots

    def joined(name: str, width: int) -> np.ndarray:
        return np.concatenate([getattr(m, name).reshape(-1, width) for m in meshes] or [np.zeros((0, width), "f4")])

    buffers = {
        "Positions": scope.buffer("positions", joined("positions", 3)),
        "Triangles": scope.buffer("triangles", triangles),
        "CornerNormals": scope.buffer("corner normals", pack_units(joined("corner_normals", 3))),
        "CornerUvs": scope.buffer("corner uvs", joined("corner_uvs", 2) if has_uvs else np.zeros((1, 2), "f4"))}
    n_slots = np.array([int(m.material_slots.max()) + 1 if len(m.material_slots) else 1 for m in meshes], "i8")
    return Shapes(scope, meshes, buffers, first_vertex, first_triangle, n_slots, mesh_boxes(meshes))


def pack_units(vectors: np.ndarray) -> np.ndarray:
    """Unit vectors (n, 3) as octahedral words (n,) u4, which `unpack_unit` in shaders/lib/math.glsl reads [Meyer10]."""
    v = vectors / np.maximum(np.abs(vectors).sum(1, keepdims=True), 1e-30)
    folded = (1 - np.abs(v[:, 1::-1])) * np.where(v[:, :2] >= 0, 1, -1)
    xy = np.where(v[:, 2:] < 0, folded, v[:, :2])
    words = np.round(np.clip(xy, -1, 1) * 32767).astype("i2").view("u2").astype("u4")
    return (words[:, 0] | words[:, 1] << 16).astype("u4")
