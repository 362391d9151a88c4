# SPDX-License-Identifier: GPL-3.0-or-later
"""Mirrors show what reflected rays meet, times Schlick's reflectance. Each pixel sees the one point in its centre."""

from __future__ import annotations

import numpy as np

from svo_engine.scene.types import Camera, Material, World
from tests import scenes
from tests.rays import directions, glow, shot

F0 = np.array([0.9, 0.6, 0.3])
METAL = Material("Metal", (0.9, 0.6, 0.3), roughness=0.0, metallic=1.0)
EYE = (0.3, -2.0, 1.2)
CAMERA = Camera("Camera", scenes.look(EYE, (0, 0, 0)), (64, 48), lens=50.0)
BLUR = 0.02  # metres. No roughness is taken as alpha = 1e-4: one in a thousand rays ends farther off, after 3 m

D = directions(CAMERA)
POINTS = np.array(EYE) - D * (EYE[2] / D[..., 2:])  # (48, 64, 3), in the plane z = 0
REFLECTED = D * (1, 1, -1)
FRESNEL = F0 + (1 - F0) * (1 + D[..., 2:]) ** 5
ON_FLOOR = np.abs(POINTS[..., :2]).max(2) < 1.29
FLOOR = scenes.Thing(scenes.floor(2.6), METAL)


def outside(y: float, middle: tuple[float, float], half: tuple[float, float]) -> np.ndarray:
    """How far (48, 64) outside of an upright rectangle at y, given by x and z, reflected rays pass; below 0 inside."""
    crossing = POINTS + REFLECTED * ((y - POINTS[..., 1]) / REFLECTED[..., 1])[..., None]
    return (np.abs(crossing[..., [0, 2]] - middle) - half).max(2)


def agree(found: np.ndarray, expected: np.ndarray) -> bool:
    """All but a few: the long tail of the distribution of normals turns one ray in a thousand by 0.2 degrees."""
    assert len(found) > 20
    return np.isclose(found, expected, rtol=2e-3, atol=1e-6).all(1).mean() > 0.99


def test_a_mirror_shows_a_lamp_where_it_is(session):
    """A glowing quad behind a metal floor: f0 of it, and more towards grazing angles, in exactly these pixels."""
    quad = scenes.Thing(scenes.quad("Lamp", (-0.4, 1.5, 0.3), (0.7, 0, 0), (0, 0, 0.6)), glow(5.0))
    found = shot(session, scenes.scene(FLOOR, quad, camera=CAMERA))
    distance = outside(1.5, (-0.05, 0.6), (0.35, 0.3))
    shown, dark = ON_FLOOR & (distance < -BLUR), ON_FLOOR & (distance > BLUR)
    assert agree(found[shown], 5 * FRESNEL[shown])
    assert agree(found[dark], 0 * FRESNEL[dark])


def test_a_mirror_shows_the_sky(session):
    sky = np.array([2, 1, 0.5])
    found = shot(session, scenes.scene(FLOOR, camera=CAMERA, world=World(tuple(sky))))
    assert agree(found[ON_FLOOR], (sky * FRESNEL)[ON_FLOOR])


def test_a_mirror_shows_a_lit_wall_with_its_shadow(session):
    """The wall's direct light is its own, not the light cache's: the shadow on it has an edge."""
    wall = scenes.Thing(scenes.quad("Wall", (-1.3, 1.3, 0), (2.6, 0, 0), (0, 0, 2)))
    shade = scenes.Thing(scenes.quad("Shade", (-0.2, 0.9, 0.4), (0.4, 0, 0), (0, 0, 0.5)), scenes.BLACK)
    sun = scenes.lamp("SUN", (0, -1, 0), emitted=3.0)
    found = shot(session, scenes.scene(FLOOR, wall, shade, lights=(sun,), camera=CAMERA), bounces=0)
    on_wall = ON_FLOOR & (outside(1.3, (0, 1), (1.29, 0.99)) < 0) & (outside(0.9, (0, 0.65), (0.2, 0.25)) > BLUR)
    in_shadow = outside(1.3, (0, 0.65), (0.2, 0.25))
    lit, dark = on_wall & (in_shadow > BLUR), on_wall & (in_shadow < -BLUR)
    assert agree(found[lit], 3 * 0.8 / np.pi * FRESNEL[lit])
    assert agree(found[dark], 0 * FRESNEL[dark])
