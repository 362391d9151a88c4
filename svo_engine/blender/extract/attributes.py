# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes of meshes by name: UV maps, colours, and whatever modifiers and geometry nodes leave."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Collection
from math import prod
from typing import Any

import numpy as np

from ...scene.meshes import Raw

MOST = 16

# Type of attribute -> (property of an element, numbers in it, Blender's own dtype, so that all are copied at once)
_TYPES = {"FLOAT": ("value", 1, "f4"), "INT": ("value", 1, "i4"), "BOOLEAN": ("value", 1, "?"),
          "INT8": ("value", 1, "i1"), "FLOAT2": ("vector", 2, "f4"), "FLOAT_VECTOR": ("vector", 3, "f4"),
          "FLOAT_COLOR": ("color", 4, "f4"), "BYTE_COLOR": ("color", 4, "f4"), "INT32_2D": ("value", 2, "i4"),
          "QUATERNION": ("value", 4, "f4")}

# Blender's own, beside those that begin with a dot
_OWN = {"position", "material_index", "sharp_face", "custom_normal", "crease_vert", "bevel_weight_vert",
        "freestyle_face"}


def read_attributes(mesh: Any, corners: np.ndarray, first: Collection[str],
                    warn: Callable[[str], object]) -> list[Raw]:
    """At most MOST attributes of `mesh`, those of the names `first` before all others.

    corners  (n_triangles, 3) i4, the mesh's corners of each triangle
    """
    found = [a for a in mesh.attributes
             if a.domain in ("POINT", "FACE", "CORNER") and a.data_type in _TYPES
             and a.name not in _OWN and not a.name.startswith(".")]
    found.sort(key=lambda a: a.name not in first)  # stable
    if len(found) > MOST:
        warn(f"only {MOST} of its {len(found)} attributes are read")
    faces = None
    made = []
    for attribute in found[:MOST]:
        name, width, dtype = _TYPES[attribute.data_type]
        values = array(attribute.data, name, (len(attribute.data), width), dtype)
        if attribute.domain == "CORNER":
            values = values.take(corners.ravel(), 0)
        elif attribute.domain == "FACE":
            if faces is None:
                faces = array(mesh.loop_triangle_polygons, "value", (len(corners),), "i4")
            values = values[faces]
        made.append(Raw(attribute.name, attribute.domain, values))
    return made


def array(elements: Any, name: str, shape: tuple[int, ...], dtype: str) -> np.ndarray:
    """Property `name` of all elements. Blender copies at once if `dtype` is its own, else one by one."""
    values = np.empty(shape, dtype)
    elements.foreach_get(name, values.ravel())
    return values


def seen(elements: Any, name: str, shape: tuple[int, ...], dtype: str) -> np.ndarray:
    """As `array`, but Blender's own memory where that holds nothing else: for a look, and before anything is done to
    what has the elements."""
    size = np.dtype(dtype).itemsize * prod(shape)
    if shape[0] > 1:
        first, last = elements[0], elements[shape[0] - 1]
        start = first.as_pointer()
        if (last.as_pointer() - start) * shape[0] == size * (shape[0] - 1):
            values = np.frombuffer(memoryview((ctypes.c_char * size).from_address(start)), dtype).reshape(shape)
            ends = (first, values[0]), (last, values[-1])
            if all(_bytes_of(element, name, dtype) == row.tobytes() for element, row in ends):
                return values
    return array(elements, name, shape, dtype)


def _bytes_of(element: Any, name: str, dtype: str) -> bytes:
    return np.array(getattr(element, name), dtype).tobytes()
