# SPDX-License-Identifier: GPL-3.0-or-later
"""A lit box with a clear glass ball, a tinted glass block and a frosted pane with things behind it. No caustics."""

from __future__ import annotations

from math import radians

import bpy

from . import lights, shapes, stage

WHITE, RED, BLUE = (0.73, 0.73, 0.73), (0.65, 0.08, 0.06), (0.1, 0.2, 0.6)


def build() -> None:
    """The pane stands in front of a row of pegs that lean away from it: the farther one is, the less it shows."""
    bpy.context.scene.cycles.caustics_reflective = bpy.context.scene.cycles.caustics_refractive = False
    _box()
    clear = stage.material("Clear glass", (1.0, 1.0, 1.0), roughness=0.0, specular=0.5, transmission=1.0)
    tinted = stage.material("Tinted glass", (0.25, 0.75, 0.45), roughness=0.0, specular=0.5, transmission=1.0)
    frosted = stage.material("Frosted glass", (1.0, 1.0, 1.0), roughness=0.4, specular=0.5, transmission=1.0)
    stage.place(shapes.sphere("Ball", 0.34, clear, segments=96), (-0.5, -0.25, 0.34))
    stage.place(shapes.boxes("Block", [((-0.16, -0.16, 0.0), (0.16, 0.16, 0.5))], tinted), (-0.02, 0.25, 0.0),
                (0.0, 0.0, radians(25)))
    stage.place(shapes.boxes("Pane", [((-0.36, -0.015, 0.0), (0.36, 0.015, 0.85))], frosted), (0.52, -0.2, 0.0),
                (0.0, 0.0, radians(-8)))
    _pegs()
    lights.area_lamp((0.0, -0.1, 1.98), (0.0, -0.1, 0.0), watts=32.0, size=(0.6, 0.6))
    stage.camera((0.0, -3.6, 1.15), (0.0, 0.0, 0.78), lens=42.0)


def _pegs() -> None:
    """From 3 cm behind the pane at the left to 60 cm at the right."""
    red, blue = stage.material("Red peg", (0.7, 0.1, 0.05)), stage.material("Blue peg", (0.08, 0.15, 0.6))
    for i, peg in enumerate((red, blue, red, blue)):
        step = 0.16 * i
        mesh = shapes.boxes(f"Peg {i}", [((-0.04, -0.04, 0.0), (0.04, 0.04, 0.7))], peg)
        stage.place(mesh, (0.28 + step, -0.06 + 0.18 * i, 0.0))


def _box() -> None:
    """Five inner faces, open towards -Y: a checkered floor, ceiling and back white, left red, right blue."""
    white, red, blue = (stage.material(n, c) for n, c in (("White", WHITE), ("Red", RED), ("Blue", BLUE)))
    dark = stage.material("Dark tile", (0.15, 0.15, 0.16))
    corners = shapes.box_corners((-1.0, -1.0, 0.0), (1.0, 1.0, 2.0))
    stage.place(shapes.mesh("Walls", corners, shapes.OPEN_BOX_FACES[1:], white, red, blue, slots=[0, 0, 1, 2]))
    stage.place(shapes.grid("Floor", 10, 10, lambda u, v: (2 * u - 1, 2 * v - 1, 0.0), white, dark,
                            slot=lambda i, j: (i + j) % 2))
