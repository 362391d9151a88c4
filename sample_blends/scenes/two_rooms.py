# SPDX-License-Identifier: GPL-3.0-or-later
"""Two sealed rooms either side of a wall without thickness; only the left one has a lamp.

The rooms are one closed surface: the wall's edges are edges of the floor, the ceiling, the front and the back, so that
no ray can pass between them. The camera stands outside; its clip start lies behind the front wall, which so is hidden
from the camera and from nothing else.
"""

from __future__ import annotations

from . import lights, shapes, stage

WIDTH, DEPTH, HEIGHT = 2.0, 2.2, 3.0  # of one room, metres
CAMERA_DISTANCE = 7.0  # from the front wall


def build() -> None:
    """The right room is the left one mirrored: whatever can be seen in it is light that came through the wall."""
    plaster, floor = stage.material("Plaster", (0.75, 0.73, 0.7)), stage.material("Floor", (0.45, 0.3, 0.2))
    stage.place(_shell(plaster, floor))
    _furnish()
    lights.point_lamp((-1.0, 1.1, 2.45), watts=17.0, radius=0.08)
    camera = stage.camera((0.0, -CAMERA_DISTANCE, HEIGHT / 2), (0.0, 0.0, HEIGHT / 2), lens=64.0)
    camera.data.clip_start = CAMERA_DISTANCE + 0.05


def _shell(plaster: shapes.Material, floor: shapes.Material) -> shapes.Mesh:
    """Floor, ceiling, front and back of both rooms, the two ends and the wall between; the shell faces inward."""
    vertices = [(x, y, z) for x in (-WIDTH, 0.0, WIDTH) for y in (0.0, DEPTH) for z in (0.0, HEIGHT)]
    rooms = [(i, i + 4, i + 6, i + 2, i + 1, i + 5, i + 7, i + 3) for i in (0, 4)]
    sides = ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (2, 6, 7, 3))
    faces = [tuple(room[i] for i in side) for room in rooms for side in sides]
    faces += [(0, 2, 3, 1), (8, 9, 11, 10), (4, 5, 7, 6)]
    return shapes.mesh("Rooms", vertices, faces, plaster, floor, slots=[1, 0, 0, 0] * 2 + [0, 0, 0])


def _furnish() -> None:
    """A ball on a block and a jar in each room, mirrored about the wall."""
    red, blue, white = (stage.material(name, color) for name, color in
                        (("Red", (0.6, 0.08, 0.05)), ("Blue", (0.08, 0.2, 0.55)), ("White", (0.8, 0.8, 0.8))))
    block = shapes.boxes("Block", [((-0.3, -0.3, 0.0), (0.3, 0.3, 0.8))], white)
    ball = shapes.sphere("Ball", 0.28, red)
    profile = [(0.0, 0.0), (0.16, 0.0), (0.24, 0.12), (0.26, 0.3), (0.2, 0.48), (0.11, 0.58), (0.1, 0.66), (0.14, 0.72)]
    jar = shapes.lathe("Jar", profile, 48, blue, crease=60.0)
    for side in (-1, 1):
        stage.place(block, (side * 0.65, 1.2, 0.0), (0.0, 0.0, side * 0.4))
        stage.place(ball, (side * 0.65, 1.2, 1.08))
        stage.place(jar, (side * 1.35, 0.85, 0.0))
