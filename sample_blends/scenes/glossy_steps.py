# SPDX-License-Identifier: GPL-3.0-or-later
"""Two rows of balls on two steps, roughness 0 to 1 from left to right: metal behind, varnished colour in front."""

from __future__ import annotations

from math import pi, sin

from . import lights, shapes, stage

ROUGHNESSES = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
RADIUS, SPACING = 0.4, 0.95


def build() -> None:
    """A soft stage: a big lamp overhead, a warm and a cool one at the sides; a checkered floor to be mirrored."""
    _set()
    ball = shapes.sphere("Ball", RADIUS, stage.material("Bare", (0.5, 0.5, 0.5)), segments=64)
    _row(ball, "Metal", (0.92, 0.78, 0.5), y=0.55, z=0.7, metallic=1.0)
    _row(ball, "Varnish", (0.2, 0.02, 0.03), y=-0.55, z=0.15)
    lights.area_lamp((0.0, -1.6, 4.2), (0.0, 0.2, 0.0), watts=130.0, size=(4.5, 2.5), name="Overhead")
    lights.area_lamp((-4.6, -2.2, 2.2), (0.0, 0.0, 0.5), 45.0, (1.5, 2.0), (1.0, 0.72, 0.45), "Warm")
    lights.area_lamp((4.6, -2.2, 2.2), (0.0, 0.0, 0.5), 45.0, (1.5, 2.0), (0.45, 0.7, 1.0), "Cool")
    lights.world_color((0.18, 0.2, 0.23))
    stage.camera((0.0, -6.4, 2.7), (0.0, 0.0, 0.85), lens=38.5)


def _row(ball: shapes.Mesh, name: str, color: stage.Color, y: float, z: float, metallic: float = 0.0) -> None:
    for i, roughness in enumerate(ROUGHNESSES):
        label = f"{name} {roughness:.1f}"
        made = stage.material(label, color, roughness=roughness, specular=0.5, metallic=metallic)
        stage.dress(stage.place(ball, (SPACING * (i - 2.5), y, z + RADIUS), name=label), made)


def _set() -> None:
    """Floor and a backdrop that rises from it in a quarter circle; two steps."""
    light, dark = stage.material("Floor light", (0.6, 0.58, 0.55)), stage.material("Floor dark", (0.22, 0.22, 0.24))
    backdrop, step = stage.material("Backdrop", (0.35, 0.45, 0.5)), stage.material("Step", (0.62, 0.6, 0.57))
    stage.place(shapes.grid("Floor", 28, 18, lambda u, v: (14 * u - 7, 9 * v - 6.5, 0.0), light, dark,
                            slot=lambda i, j: (i + j) % 2))
    stage.place(shapes.smooth(shapes.grid("Backdrop", 1, 24, _sweep, backdrop)))
    stage.place(shapes.boxes("Steps", [((-3.1, -1.1, 0.0), (3.1, 0.0, 0.15)), ((-3.1, 0.0, 0.0), (3.1, 1.1, 0.7))],
                             step))


def _sweep(u: float, v: float) -> shapes.Point:
    """A quarter circle of 1.5 m, then straight up to 5 m."""
    angle = min(2 * v, 1.0) * pi / 2
    rise = max(2 * v - 1, 0.0) * 3.5
    return 14 * u - 7, 2.5 + 1.5 * sin(angle), 1.5 - 1.5 * sin(pi / 2 - angle) + rise
