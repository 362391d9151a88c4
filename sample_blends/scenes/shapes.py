# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes made from numbers: every function returns a new `bpy.types.Mesh` in metres, object space, Z up."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from math import cos, pi, radians, sin

import bmesh
import bpy
from bpy.types import Material, Mesh
from mathutils import Matrix

Point = tuple[float, float, float]
Face = tuple[int, ...]

# The eight corners and the outward faces of a box, low corner first
BOX_FACES: tuple[Face, ...] = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))

# The inward faces of a box that is open towards -Y: floor, ceiling, back, left, right
OPEN_BOX_FACES: tuple[Face, ...] = ((0, 1, 2, 3), (4, 7, 6, 5), (2, 6, 7, 3), (0, 3, 7, 4), (1, 5, 6, 2))


def mesh(name: str, vertices: Sequence[Point], faces: Sequence[Face], *materials: Material,
         slots: Sequence[int] | None = None) -> Mesh:
    """Flat-shaded polygons; `slots` names the material of each face, default the first."""
    data = bpy.data.meshes.new(name)
    data.from_pydata(vertices, [], faces)
    for material in materials:
        data.materials.append(material)
    if slots is not None:
        data.polygons.foreach_set("material_index", slots)
    data.update()
    return data


def smooth(data: Mesh, crease: float = 180.0) -> Mesh:
    """Shade `data` smoothly except over edges that fold by more than `crease` degrees."""
    data.shade_smooth()
    data.set_sharp_from_angle(angle=radians(crease))
    return data


def box_corners(low: Point, high: Point) -> list[Point]:
    """The corners that `BOX_FACES` speaks of."""
    (a, b, c), (d, e, f) = low, high
    return [(a, b, c), (d, b, c), (d, e, c), (a, e, c), (a, b, f), (d, b, f), (d, e, f), (a, e, f)]


def boxes(name: str, corners: Sequence[tuple[Point, Point]], *materials: Material) -> Mesh:
    """Axis-aligned boxes from (low, high) corners, in one mesh."""
    vertices = [p for low, high in corners for p in box_corners(low, high)]
    faces = [tuple(i + 8 * n for i in face) for n in range(len(corners)) for face in BOX_FACES]
    return mesh(name, vertices, faces, *materials)


def lathe(name: str, profile: Sequence[tuple[float, float]], segments: int, *materials: Material,
          crease: float = 40.0) -> Mesh:
    """`profile` of (radius, height) from bottom to top, turned around Z; a radius of 0 closes an end."""
    vertices: list[Point] = []
    rings: list[list[int]] = []
    for radius, height in profile:
        first, n = len(vertices), segments if radius > 0 else 1
        angles = [2 * pi * i / segments for i in range(n)]
        vertices += [(radius * cos(a), radius * sin(a), height) for a in angles]
        rings.append([first + i % n for i in range(segments)])
    faces = [_distinct((low[i], low[j], high[j], high[i]))
             for low, high in pairwise(rings)
             for i, j in ((i, (i + 1) % segments) for i in range(segments))]
    return smooth(mesh(name, vertices, faces, *materials), crease)


def _distinct(face: Face) -> Face:
    """`face` without repeated corners, as where a ring has shrunk to its pole."""
    return tuple(dict.fromkeys(face))


def grid(name: str, columns: int, rows: int, point: Callable[[float, float], Point], *materials: Material,
         slot: Callable[[int, int], int] = lambda column, row: 0) -> Mesh:
    """`point(u, v)` for u and v over 0 to 1, as `columns` by `rows` quads; `slot(column, row)` names the material.

    Points that meet become one vertex, so that what is rolled up is closed.
    """
    places: dict[Point, int] = {}
    corner: dict[tuple[int, int], int] = {}
    for j in range(rows + 1):
        for i in range(columns + 1):
            x, y, z = point(i / columns, j / rows)
            corner[i, j] = places.setdefault((round(x, 6), round(y, 6), round(z, 6)), len(places))
    cells = [(i, j) for j in range(rows) for i in range(columns)]
    faces = [_distinct((corner[i, j], corner[i + 1, j], corner[i + 1, j + 1], corner[i, j + 1])) for i, j in cells]
    return mesh(name, list(places), faces, *materials, slots=[slot(i, j) for i, j in cells])


def sphere(name: str, radius: float, *materials: Material, segments: int = 48) -> Mesh:
    """A smooth ball around the origin, its poles on Z."""
    rings = segments // 2
    profile = [(radius * sin(pi * i / rings) if 0 < i < rings else 0.0, -radius * cos(pi * i / rings))
               for i in range(rings + 1)]
    return lathe(name, profile, segments, *materials, crease=180.0)


def torus(name: str, major: float, minor: float, *materials: Material, segments: int = 64) -> Mesh:
    """A smooth ring in the XY plane."""
    sides = segments // 4

    def point(u: float, v: float) -> Point:
        a, b = 2 * pi * u, 2 * pi * v
        return (major + minor * cos(b)) * cos(a), (major + minor * cos(b)) * sin(a), minor * sin(b)

    return smooth(grid(name, segments, sides, point, *materials))


def monkey(name: str, *materials: Material) -> Mesh:
    """Blender's Suzanne, about 2.7 m wide, facing -Y."""
    data = bpy.data.meshes.new(name)
    work = bmesh.new()
    bmesh.ops.create_monkey(work)
    work.to_mesh(data)
    work.free()
    for material in materials:
        data.materials.append(material)
    return smooth(data)


def joined(data: Mesh, other: Mesh, lift: float = 0.0) -> Mesh:
    """`data` with `other` added to it, `lift` metres higher, in the first material of `data`; `other` is gone."""
    other.transform(Matrix.Translation((0.0, 0.0, lift)))
    work = bmesh.new()
    work.from_mesh(data)
    work.from_mesh(other)
    work.to_mesh(data)
    work.free()
    bpy.data.meshes.remove(other)
    return data
