# SPDX-License-Identifier: GPL-3.0-or-later
"""Voxelization slow and obvious: every voxel of a triangle's bounding box is tried, every area is cut out exactly.

Everything is in voxel units and f8: `triangle` is (3, 3), a cell is its lowest corner, (3,) integers.
"""

from __future__ import annotations

import numpy as np


def touched(triangle: np.ndarray, n: int, slack: float) -> np.ndarray:
    """Cells (k, 3) of an n^3 grid that the triangle meets when each is made larger by `slack` on every side.

    Thirteen separating axes: three of the box, the triangle's normal, nine products of their edges.
    """
    low = np.clip(np.floor(triangle.min(0)).astype(int) - 1, 0, n - 1)
    high = np.clip(np.floor(triangle.max(0)).astype(int) + 1, 0, n - 1)
    axes = [np.arange(a, b + 1) for a, b in zip(low, high, strict=True)]
    cells = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    edges = np.roll(triangle, -1, 0) - triangle
    tried = [*np.eye(3), np.cross(edges[0], edges[1]), *(np.cross(e, x) for e in edges for x in np.eye(3))]
    meets = np.ones(len(cells), bool)
    for axis in tried:
        length = np.abs(axis).sum()
        if length < 1e-300:
            continue
        axis = axis / length  # so that the box's half extent along it is its half side
        shadow, middle = triangle @ axis, (cells + 0.5) @ axis
        meets &= (shadow.min() <= middle + 0.5 + slack) & (shadow.max() >= middle - 0.5 - slack)
    return cells[meets]


def clipped(triangle: np.ndarray, cell: np.ndarray) -> np.ndarray:
    """Corners (k, 3) of the triangle's part inside the cell, cut off by one side after another [Sutherland74]."""
    polygon = list(triangle)
    for axis in range(3):
        for side, limit in ((-1.0, -float(cell[axis])), (1.0, float(cell[axis] + 1))):
            kept = []
            for p, q in zip(polygon, polygon[1:] + polygon[:1], strict=True):
                dp, dq = side * p[axis] - limit, side * q[axis] - limit
                if dp <= 0:
                    kept.append(p)
                if dp * dq < 0:
                    kept.append(p + (q - p) * (dp / (dp - dq)))
            polygon = kept
    return np.array(polygon).reshape(-1, 3)


def clipped_area(triangle: np.ndarray, cell: np.ndarray) -> float:
    """Area of the triangle's part inside the cell."""
    polygon = clipped(triangle, cell)
    return float(np.linalg.norm(fan(polygon).sum(0))) if len(polygon) > 2 else 0.0


def clipped_moment(triangle: np.ndarray, cell: np.ndarray) -> np.ndarray:
    """The area of that part times its centroid, (3,)."""
    polygon = clipped(triangle, cell)
    if len(polygon) < 3:
        return np.zeros(3)
    middles = (polygon[0] + polygon[1:-1] + polygon[2:]) / 3
    return (np.linalg.norm(fan(polygon), axis=1)[:, None] * middles).sum(0)


def fan(polygon: np.ndarray) -> np.ndarray:
    """Areas as vectors (k - 2, 3) of the triangles that make up a convex polygon (k, 3)."""
    return np.cross(polygon[1:-1] - polygon[0], polygon[2:] - polygon[0]) / 2


def unit_normal(triangle: np.ndarray) -> np.ndarray:
    """As the triangle is wound."""
    n = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    return n / np.linalg.norm(n)


def is_blocked(occupied: np.ndarray, o: np.ndarray, d: np.ndarray, t_max: float, slack: float) -> bool:
    """Does the ray from o along d meet one of the `occupied` cells (k, 3), made larger by `slack`, before t_max?"""
    inverse = 1 / np.where(d == 0, 1e-300, d)
    near, far = (occupied - slack - o) * inverse, (occupied + 1 + slack - o) * inverse
    enter, leave = np.minimum(near, far).max(1), np.maximum(near, far).min(1)
    return bool(((enter <= leave) & (leave >= 0) & (enter < t_max)).any())
