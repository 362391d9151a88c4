# SPDX-License-Identifier: GPL-3.0-or-later
"""A ring of standing stones on a green hill under an open sky: no lamp, all light comes from the world's image."""

from __future__ import annotations

from math import cos, exp, pi, radians, sin

import numpy as np
from mathutils import Vector, noise

from . import lights, shapes, stage

RING_RADIUS, N_STONES = 5.2, 14
HILL_RADIUS = 17.0
LINTEL_HEIGHT = 2.62
GLOW_ELEVATION = radians(32)


def build() -> None:
    """All standing stones are placings of two meshes; the trilithons are instances of a collection."""
    stage.place(_hill(stage.material("Grass", (0.12, 0.2, 0.05)), stage.material("Earth", (0.28, 0.2, 0.12))))
    rock = stage.material("Rock", (0.36, 0.32, 0.26))
    _stones(shapes.smooth(_stone("Upright", (1.0, 0.5, 2.7), rock), 50), shapes.smooth(
        _stone("Lintel", (2.15, 0.55, 0.45), rock), 50))
    lights.world_image(lights.packed_image("Sky", 256, 128, _sky(256, 128)), turn=radians(-10))
    stage.camera((-5.6, -10.8, 1.9), (0.3, 0.4, 1.6), lens=32.0)


def _stones(upright: shapes.Mesh, lintel: shapes.Mesh) -> None:
    """A ring of uprights with lintels, with gaps; inside three trilithons and the altar; fallen stones and rubble."""
    step = 2 * pi / N_STONES
    for i in range(N_STONES):
        if i not in (9, 10):
            _stand(upright, RING_RADIUS, i * step, turn=pi * (i % 2))
        if i not in (1, 8, 9, 10, 11):
            _stand(lintel, RING_RADIUS * cos(step / 2), (i + 0.5) * step, lift=LINTEL_HEIGHT)
    trilithon = stage.group("Trilithon", [stage.place(upright, (-0.72, 0.0, -0.05)), stage.place(
        upright, (0.72, 0.0, -0.05), (0.0, 0.0, pi)), stage.place(lintel, (0.0, 0.0, LINTEL_HEIGHT))])
    for angle in (0.45, 1.75, 3.05):
        stage.place_group(trilithon, (2.6 * cos(angle), 2.6 * sin(angle), 0.0), angle - pi / 2, 1.3)
    stage.place(lintel, (0.2, -0.9, 0.05), (0.05, 0.0, 0.3), name="Altar")
    stage.place(upright, (-0.3, -5.6, 0.15), (radians(88), 0.0, radians(63)), name="Fallen upright")
    stage.place(lintel, (-5.2, -5.6, 0.0), (0.1, 0.12, radians(-28)), name="Fallen lintel")
    pebble = shapes.smooth(_stone("Rubble", (0.5, 0.35, 0.3), upright.materials[0], columns=16, rows=10))
    for i in range(24):
        radius, angle = 3.4 + 0.17 * i, 2.4 * i
        x, y = radius * cos(angle), radius * sin(angle)
        stage.place(pebble, (x, y, _height(x, y) - 0.05), (0.2, 0.3, angle), 0.5 + 0.25 * (i % 4))


def _stand(stone: shapes.Mesh, radius: float, angle: float, lift: float = -0.05, turn: float = 0.0) -> None:
    """Upright at (radius, angle) around the centre, its broad side towards it, its foot `lift` above the level.

    turn: about itself
    """
    stage.place(stone, (radius * cos(angle), radius * sin(angle), lift), (0.0, 0.0, angle - pi / 2 + turn))


def _stone(name: str, size: shapes.Point, material: shapes.Material, columns: int = 32, rows: int = 24) -> shapes.Mesh:
    """A weathered block of `size` on the origin: a rounded box, bulging and pitted by noise."""
    seed = Vector((len(name) * 7.3, 1.7, 4.1))

    def point(u: float, v: float) -> shapes.Point:
        """Around the block with u, from the middle of its foot to the middle of its top with v."""
        a, b = 2 * pi * u, pi * (v - 0.5)
        square = Vector((_squared(cos(a)) * _squared(cos(b), 0.25), _squared(sin(a)) * _squared(cos(b), 0.25),
                         _squared(sin(b), 0.25)))
        place = Vector((square.x * size[0] / 2, square.y * size[1] / 2, (square.z + 1) * size[2] / 2))
        rough = 0.09 * noise.noise(place * 1.6 + seed) + 0.03 * noise.noise(place * 6 + seed)
        taper = 1.0 - 0.06 * square.z
        return place.x * taper + square.x * rough, place.y * taper + square.y * rough, place.z + square.z * rough / 2

    return shapes.grid(name, columns, rows, point, material)


def _squared(value: float, power: float = 0.3) -> float:
    """A sine drawn towards a square wave: a superellipsoid's coordinate."""
    return abs(value) ** power * (1 if value > 0 else -1) if abs(value) > 1e-9 else 0.0


def _height(x: float, y: float) -> float:
    """The ground's height: level inside the ring, soft waves outside, a ridge behind it that hides the rim."""
    distance = (x * x + y * y) ** 0.5
    waves = 0.25 * sin(0.55 * x + 1.0) * cos(0.45 * y) + 0.1 * sin(1.3 * x - 0.9 * y)
    ridge = exp(-(((distance - 13.0) / 3.2) ** 2)) * (2.35 + 0.35 * sin(0.35 * x + 0.6))
    return waves * _ramp((distance - 5.0) / 3.0) + ridge * _ramp((y + 4.0) / 4.0)


def _ramp(value: float) -> float:
    return min(max(value, 0.0), 1.0)


def _hill(grass: shapes.Material, earth: shapes.Material) -> shapes.Mesh:
    """A round piece of land; trodden earth in the ring's middle and on the way to it."""
    columns, rows = 128, 64

    def point(u: float, v: float) -> shapes.Point:
        radius, angle = HILL_RADIUS * v, -2 * pi * u  # clockwise, so that the faces look up
        x, y = radius * cos(angle), radius * sin(angle)
        return x, y, _height(x, y)

    def slot(i: int, j: int) -> int:
        x, y, _ = point((i + 0.5) / columns, (j + 0.5) / rows)
        wobble = 0.8 * noise.noise(Vector((x, y, 0.0)) * 0.7)
        return int((x * x + y * y) ** 0.5 < 3.0 + wobble or (y < 0 and abs(x + 0.45 * y * 0.55) < 0.7 + 0.5 * wobble))

    return shapes.smooth(shapes.grid("Hill", columns, rows, point, grass, earth, slot=slot))


def _sky(width: int, height: int) -> np.ndarray:
    """(height * width * 4) f4, scene-linear RGBA [W m^-2 sr^-1], row 0 straight down: a sky without a sun's disc.

    From a pale horizon to a deep blue zenith, a broad glow where a veiled sun stands, dull ground below.
    """
    elevation, azimuth = np.meshgrid(pi * ((np.arange(height) + 0.5) / height - 0.5),
                                     2 * pi * (np.arange(width) + 0.5) / width, indexing="ij")
    up = np.clip(np.sin(elevation), 0, 1)[..., None]
    horizon, zenith, ground = np.array([0.62, 0.72, 0.84]), np.array([0.16, 0.34, 0.75]), np.array([0.12, 0.11, 0.09])
    sky = zenith + (horizon - zenith) * np.exp(-4.0 * up)
    towards = np.sin(elevation) * sin(GLOW_ELEVATION) + np.cos(elevation) * cos(GLOW_ELEVATION) * np.cos(azimuth)
    glow = 9.0 * np.exp(-(np.arccos(np.clip(towards, -1, 1)) / 0.35) ** 2)[..., None] * np.array([1.0, 0.85, 0.6])
    color = np.where(elevation[..., None] > 0, sky + glow, ground)
    return np.concatenate([color, np.ones((height, width, 1))], 2).astype("f4").ravel()
