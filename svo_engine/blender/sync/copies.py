# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a large mesh that Blender names as changed has changed: assigning a material names it, too. Comparing its
arrays with copies of them takes a fiftieth of the time in which they are read."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..extract.attributes import array, seen

# Below that reading is as quick
_FEWEST_CORNERS = 10_000

# Type of an attribute -> its elements' property, dtype, and numbers an element
_KINDS = {"FLOAT": ("value", "f4", 1), "INT": ("value", "i4", 1), "BOOLEAN": ("value", "?", 1),
          "INT8": ("value", "i1", 1), "FLOAT2": ("vector", "f4", 2), "FLOAT_VECTOR": ("vector", "f4", 3),
          "FLOAT_COLOR": ("color", "f4", 4), "BYTE_COLOR": ("color", "f4", 4), "QUATERNION": ("value", "f4", 4),
          "INT16_2D": ("value", "i2", 2), "INT32_2D": ("value", "i4", 2)}


@dataclass(frozen=True, eq=False)
class Copy:
    """All that can be drawn of a mesh, as Blender has it.

    marks   what costs nothing to ask for
    arrays  copies, in the order of _arrays
    """

    marks: tuple[object, ...]
    arrays: tuple[bytearray, ...]

    def is_of(self, mesh: Any) -> bool:
        """Whether `mesh`, which has these marks, has these arrays."""
        return all(mine == its.data for mine, its in zip(self.arrays, _arrays(mesh), strict=True))


def marks_of(mesh: Any) -> tuple[object, ...] | None:
    """Equal for evaluated meshes that may be the same; None if that cannot be known, or is not worth it."""
    if len(mesh.loops) < _FEWEST_CORNERS or mesh.is_editmode:
        return None
    attributes = _attributes(mesh)
    has_hidden_normals = mesh.has_custom_normals and "custom_normal" not in mesh.attributes  # before Blender 4.5
    if has_hidden_normals or any(a.data_type not in _KINDS for a in attributes):
        return None
    uv_map = next((layer.name for layer in mesh.uv_layers if layer.active_render), "")
    named = [(a.name, a.domain, a.data_type) for a in attributes]
    counts = len(mesh.vertices), len(mesh.loops), len(mesh.polygons)
    meant = uv_map, mesh.attributes.default_color_name, mesh.normals_domain
    return counts, meant, (*mesh.texspace_location, *mesh.texspace_size), *named


def copy_of(mesh: Any, marks: tuple[object, ...]) -> Copy:
    """A copy of `mesh`, which has these marks."""
    return Copy(marks, tuple(bytearray(values.data) for values in _arrays(mesh)))


def _attributes(mesh: Any) -> list[Any]:
    """Those of which triangles, normals or what is read of a mesh can depend. Normals depend on edges only where sharp
    and smooth ones meet; what else begins with a dot is of tools."""
    are_edges_seen = mesh.normals_domain == "CORNER"
    names = {".corner_vert"} | ({".edge_verts", ".corner_edge"} if are_edges_seen else set())
    return [a for a in mesh.attributes
            if a.name in names or (not a.name.startswith(".") and (are_edges_seen or a.domain != "EDGE"))]


def _arrays(mesh: Any) -> Iterator[np.ndarray]:
    """Each to be used before the next one is asked for. The faces of triangles say how many corners each face has."""
    for attribute in _attributes(mesh):
        name, dtype, width = _KINDS[attribute.data_type]
        shape = (len(attribute.data), width)
        yield (array if attribute.data_type == "BYTE_COLOR" else seen)(attribute.data, name, shape, dtype)
    if 3 * len(mesh.polygons) != len(mesh.loops):
        yield seen(mesh.loop_triangle_polygons, "value", (len(mesh.loop_triangles), 1), "i4")
