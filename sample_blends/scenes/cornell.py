# SPDX-License-Identifier: GPL-3.0-or-later
"""The Cornell box, 2 m wide, with Suzanne: everything diffuse, one lamp."""

from __future__ import annotations

from math import radians

from . import lights, shapes, stage

WHITE, RED, GREEN = (0.73, 0.73, 0.73), (0.65, 0.05, 0.05), (0.12, 0.45, 0.15)


def with_point_lamp() -> None:
    """A small point lamp hangs in the box: hard shadows, and a ceiling that only its near light reaches."""
    _box_with_suzanne()
    lights.point_lamp((0.0, -0.2, 1.5), watts=20.0, radius=0.05)


def with_area_lamp() -> None:
    """A square lamp lies just under the ceiling: soft shadows, and a ceiling lit by nothing but bounces."""
    _box_with_suzanne()
    lights.area_lamp((0.0, 0.0, 1.98), (0.0, 0.0, 0.0), watts=30.0, size=(0.5, 0.5))


def _box_with_suzanne() -> None:
    white, red, green = (stage.material(n, c) for n, c in (("White", WHITE), ("Red", RED), ("Green", GREEN)))
    stage.place(_box(white, red, green))
    stage.suzanne(white, (0.0, 0.4, 0.0), 0.54, radians(-32))
    stage.camera((0.0, -3.3, 1.0), (0.0, 0.0, 1.0), lens=41.5)


def _box(white: shapes.Material, red: shapes.Material, green: shapes.Material) -> shapes.Mesh:
    """Five inner faces, open towards -Y: floor, ceiling and back white, left red, right green."""
    corners = shapes.box_corners((-1.0, -1.0, 0.0), (1.0, 1.0, 2.0))
    return shapes.mesh("Box", corners, shapes.OPEN_BOX_FACES, white, red, green, slots=[0, 0, 0, 1, 2])
