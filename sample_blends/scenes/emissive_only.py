# SPDX-License-Identifier: GPL-3.0-or-later
"""A gallery lit by three glowing sculptures and by nothing else: no lamp, a black world."""

from __future__ import annotations

from math import radians

from . import shapes, stage


def build() -> None:
    """A column, a halo and a ball glow in three colours; white Suzanne on her plinth shows where each comes from."""
    _room()
    stage.place(shapes.lathe("Column", [(0.0, 0.2), (0.2, 0.2), (0.2, 2.2), (0.0, 2.2)], 48,
                             stage.emitter("Glow amber", (1.0, 0.4, 0.08), 1.5)), (-1.4, 0.5, 0.0))
    stage.place(shapes.torus("Halo", 0.95, 0.1, stage.emitter("Glow blue", (0.12, 0.5, 1.0), 1.5), segments=96),
                (0.1, -0.1, 2.02), (radians(20), radians(-9), 0.0))
    stage.place(shapes.sphere("Ball", 0.38, stage.emitter("Glow rose", (1.0, 0.1, 0.3), 1.4)), (1.25, -0.35, 0.38))
    stage.camera((0.0, -4.1, 1.4), (0.0, 0.3, 1.2), lens=34.0)


def _room() -> None:
    """4 m wide, 3.2 m deep, 2.6 m high, open towards the camera; plinths and Suzanne."""
    wall, floor = stage.material("Wall", (0.8, 0.8, 0.8)), stage.material("Floor", (0.5, 0.5, 0.5))
    corners = shapes.box_corners((-2.0, -1.6, 0.0), (2.0, 1.6, 2.6))
    stage.place(shapes.mesh("Room", corners, shapes.OPEN_BOX_FACES, floor, wall, slots=[0, 1, 1, 1, 1]))
    stone = stage.material("Stone", (0.35, 0.35, 0.36))
    plinths = [((-1.65, 0.25, 0.0), (-1.15, 0.75, 0.2)), ((-0.42, -0.75, 0.0), (0.42, 0.1, 0.5))]
    stage.place(shapes.boxes("Plinths", plinths, stone))
    stage.suzanne(wall, (0.0, -0.28, 0.5), 0.48, radians(-14))
