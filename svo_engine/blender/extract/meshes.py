# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of evaluated meshes, read by the quick ways: attributes, not properties of elements."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...scene.meshes import make_mesh
from ...scene.types import Color, Mesh
from .attributes import array, read_attributes, seen


def read_mesh(owner: Any, warn: Callable[[str], object]) -> Mesh | None:
    """The triangles of the evaluated object `owner`, whose data is a mesh; None without any."""
    if not owner.data.is_editmode:
        return _read(owner.data, owner.name, warn)
    try:  # only a copy has the UVs and attributes of a mesh that is being edited
        return _read(owner.to_mesh(), owner.name, warn)
    finally:
        owner.to_mesh_clear()


def uv_map_of(mesh: Any) -> Any:
    """The UV map that is active for rendering; None without any."""
    return next((layer for layer in mesh.uv_layers if layer.active_render), None)


def _read(mesh: Any, name: str, warn: Callable[[str], object]) -> Mesh | None:
    n_corners, n_triangles = len(mesh.loops), len(mesh.loop_triangles)
    if n_triangles == 0:
        return None
    positions = array(mesh.attributes["position"].data, "vector", (len(mesh.vertices), 3), "f4")
    vertex_of_corner = array(mesh.attributes[".corner_vert"].data, "value", (n_corners,), "i4")
    normals = array(mesh.corner_normals, "vector", (n_corners, 3), "f4")
    corners = _corners(mesh, n_triangles)
    low, size = _texture_space(mesh)
    color = mesh.attributes.default_color_name
    layer = uv_map_of(mesh)
    uv_map = layer.name if layer else ""
    raw = read_attributes(mesh, corners, (uv_map, color), lambda left_out: warn(f"Mesh '{name}': {left_out}"))
    made, warnings = make_mesh(
        name, positions, vertex_of_corner[corners], normals[corners], material_slots=_slots(mesh, n_triangles),
        flat=_flat(mesh, n_triangles), raw=raw, uv_map=uv_map, color=color if any(a.name == color for a in raw) else "",
        generated_low=low, generated_size=size)
    for warning in warnings:
        warn(warning)
    return made if len(made.triangles) else None


def _texture_space(mesh: Any) -> tuple[Color, Color]:
    """Lowest corner and size of the box in which generated coordinates go from 0 to 1."""
    (x, y, z), (a, b, c) = mesh.texspace_location, mesh.texspace_size
    return (x - a, y - b, z - c), (2 * a, 2 * b, 2 * c)


def _corners(mesh: Any, n_triangles: int) -> np.ndarray:
    """Corner indices (n_triangles, 3) i4; known without reading them if all faces are triangles."""
    if n_triangles == len(mesh.polygons) and len(mesh.loops) == 3 * n_triangles:
        return np.arange(3 * n_triangles, dtype="i4").reshape(-1, 3)
    return seen(mesh.loop_triangles, "loops", (n_triangles, 3), "i4").copy()  # else Blender asks each by itself


def _flat(mesh: Any, n_triangles: int) -> np.ndarray:
    """(n_triangles,) bool: those of flat faces."""
    attribute = mesh.attributes.get("sharp_face")
    if attribute is None or attribute.domain != "FACE" or attribute.data_type != "BOOLEAN":
        return np.zeros(n_triangles, bool)
    of_face = array(attribute.data, "value", (len(mesh.polygons),), "?")
    return of_face[array(mesh.loop_triangle_polygons, "value", (n_triangles,), "i4")]


def _slots(mesh: Any, n_triangles: int) -> np.ndarray | None:
    """Material slot (n_triangles,) i4 of each triangle; None if all are in the first one. Negative ones count as 0."""
    attribute = mesh.attributes.get("material_index")
    if attribute is None or attribute.domain != "FACE" or attribute.data_type != "INT":
        return None
    of_face = array(attribute.data, "value", (len(mesh.polygons),), "i4")
    faces = array(mesh.loop_triangle_polygons, "value", (n_triangles,), "i4")
    return np.maximum(of_face, 0)[faces]
