# SPDX-License-Identifier: GPL-3.0-or-later
"""Twenty-four materials, each on a ball: six a row, four rows on steps."""

from __future__ import annotations

from math import atan2, cos, pi, sin

from . import lights, shapes, stage
from .ball_materials import MATERIALS
from .trees import Tree

COLUMNS = 6
RADIUS, SPACING, DEPTH, RISE = 0.42, 1.05, 1.0, 0.62
_SEGMENTS = 64


def build() -> None:
    """Balls on feet in front of a backdrop; a big lamp overhead, a warm and a cool one at the sides."""
    _set()
    ball = _ball(stage.material("Bare", (0.5, 0.5, 0.5)))
    for i, make in enumerate(MATERIALS):
        name = make.__name__.replace("_", " ").capitalize()
        stage.dress(stage.place(ball, place_of(i), name=name), make(Tree(name))).color = (0.1, 0.2, 0.5, 1.0)
    lights.area_lamp((0.0, -2.5, 6.5), (0.0, 0.5, 1.0), watts=330.0, size=(5.5, 3.0), name="Overhead")
    lights.area_lamp((-6.0, -2.5, 3.6), (0.0, 0.0, 1.2), 110.0, (1.5, 2.5), (1.0, 0.75, 0.5), "Warm")
    lights.area_lamp((6.0, -2.5, 3.6), (0.0, 0.0, 1.2), 110.0, (1.5, 2.5), (0.5, 0.72, 1.0), "Cool")
    lights.world_color((0.22, 0.24, 0.27))
    stage.camera((0.0, -9.6, 4.3), (0.0, 0.0, 1.42), lens=52.0)


def place_of(i: int) -> stage.Point:
    """Where ball `i` stands: its lowest point, metres."""
    row, column = divmod(i, COLUMNS)
    back = 3 - row
    return SPACING * (column - (COLUMNS - 1) / 2), DEPTH * (back - 1.5), RISE * back + 0.1


def _ball(material: shapes.Material) -> shapes.Mesh:
    """A ball with a groove around it on a foot, closed, with coordinates around and up."""
    profile = [(0.0, 0.0), (0.26, 0.0), (0.26, 0.05), (0.17, 0.09)]
    steps = range(5, 33)
    for angle in (pi * i / 32 for i in steps):
        groove = 0.035 if abs(angle - 0.62 * pi) < 0.07 else 0.0
        radius = RADIUS - groove
        profile.append((radius * sin(angle) if angle < pi - 1e-6 else 0.0, 0.09 + RADIUS - radius * cos(angle)))
    made = shapes.lathe("Ball", profile, _SEGMENTS, material, crease=50.0)
    layer = made.uv_layers.new(name="UVMap")
    height = 0.09 + 2 * RADIUS
    for face in made.polygons:
        corners = [made.vertices[made.loops[i].vertex_index].co for i in face.loop_indices]
        middle = sum(_turn(c) for c in corners if c.x or c.y) / max(sum(1 for c in corners if c.x or c.y), 1)
        for i, c in zip(face.loop_indices, corners, strict=True):
            u = _turn(c) if c.x or c.y else middle
            layer.data[i].uv = u + round(middle - u), c.z / height
    return made


def _turn(point: shapes.Point) -> float:
    """The angle around Z as a part of a turn."""
    return atan2(point[1], point[0]) / (2 * pi) % 1.0


def _set() -> None:
    """Steps, a floor before them, and a wall behind."""
    step, floor = stage.material("Step", (0.5, 0.49, 0.47)), stage.material("Floor", (0.4, 0.4, 0.42))
    width = SPACING * COLUMNS / 2 + 0.4
    steps = [((-width, DEPTH * (i - 2), 0.0), (width, DEPTH * (i - 1), RISE * i + 0.1)) for i in range(4)]
    stage.place(shapes.boxes("Steps", steps, step))
    stage.place(shapes.grid("Floor", 1, 1, lambda u, v: (24 * u - 12, 16 * v - 12, 0.0), floor))
    stage.place(shapes.grid("Wall", 1, 1, lambda u, v: (24 * u - 12, 3.2, 8 * v), stage.material(
        "Wall", (0.33, 0.38, 0.42))))
