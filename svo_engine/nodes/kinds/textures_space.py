# SPDX-License-Identifier: GPL-3.0-or-later
"""Where textures are looked up: their coordinates, and the mapping that each texture's node has of its own."""

from __future__ import annotations

from collections.abc import Callable
from math import copysign, cos, sin

import numpy as np

from ..expr import Expr
from ..reader import Reader
from . import Outputs

_LEAST_SCALE = 1e-5
_AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def place(n: Reader, unlinked: Callable[[], Expr] | None = None) -> Expr:
    """The point at which the node's texture is looked up. unlinked: what it is without a link, generated if None."""
    return mapped(n, n.vector("Vector", unlinked or n.generated))


def grey(value: Expr) -> Outputs:
    """The outputs of a texture of one number."""
    return {"Color": value, "Fac": value}


def dimensions(n: Reader, name: str) -> int:
    """How many the texture has, 1 to 4, of a setting such as "3D"."""
    return int(n.setting(name, "3D")[0])


def mapped(n: Reader, vector: Expr) -> Expr:
    """`vector` after the node's own "Texture Mapping", which hardly any file has."""
    rows, moved = _mapping(n)
    if np.array_equal(rows, np.eye(3)) and not moved.any():
        return vector
    values = [n.value(tuple(row)) for row in rows]
    if n.setting("texture_mapping.vector_type", "POINT") == "NORMAL":
        return n.call("texture_mapped_normal", vector, *values)
    return n.call("texture_mapped", vector, *values, n.value(tuple(moved)))


def _mapping(n: Reader) -> tuple[np.ndarray, np.ndarray]:
    """A matrix (3, 3) and what is added after it (3,), as Cycles makes them of the settings."""
    kind = n.setting("texture_mapping.vector_type", "POINT")
    scale = np.array(n.setting("texture_mapping.scale", (1.0, 1.0, 1.0)))
    if kind in ("TEXTURE", "NORMAL"):  # these are inverted
        scale = np.array([copysign(max(abs(s), _LEAST_SCALE), s) for s in scale])
    matrix = _turned(*n.setting("texture_mapping.rotation", (0.0, 0.0, 0.0))) * scale
    moved = np.array(n.setting("texture_mapping.translation", (0.0, 0.0, 0.0)))
    if kind == "TEXTURE":
        matrix = np.linalg.inv(matrix)
        moved = -matrix @ moved
    elif kind == "NORMAL":
        matrix = np.linalg.inv(matrix).T
    if kind in ("VECTOR", "NORMAL"):
        moved = np.zeros(3)
    axes = np.array([_AXES.get(n.setting(f"texture_mapping.mapping_{a}", a.upper()), (0.0, 0.0, 0.0)) for a in "xyz"])
    return matrix @ axes, moved


def _turned(x: float, y: float, z: float) -> np.ndarray:
    """The rotation by Euler's angles in radians, around x first."""
    around_x = np.array([[1, 0, 0], [0, cos(x), -sin(x)], [0, sin(x), cos(x)]])
    around_y = np.array([[cos(y), 0, sin(y)], [0, 1, 0], [-sin(y), 0, cos(y)]])
    around_z = np.array([[cos(z), -sin(z), 0], [sin(z), cos(z), 0], [0, 0, 1]])
    return around_z @ around_y @ around_x
