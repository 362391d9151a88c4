# SPDX-License-Identifier: GPL-3.0-or-later
"""Glass and rough mirrors under light from everywhere, and glass that bends light, against closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.scene.types import Camera, Material, World
from tests import scenes
from tests.rays import FLAT_WORLD, directions, glow, shot

BALL = scenes.sphere("Ball", 1.0, 32)
CAMERA = Camera("Camera", scenes.look((0.4, -5.0, 0.7), (0, 0, 0)), (32, 24), lens=60.0)
GLASS = Material("Glass", (1, 1, 1), roughness=0.0, transmission=1.0)
METAL = Material("Metal", (1, 1, 1), roughness=0.0, metallic=1.0)
VARNISH = Material("Varnish", (1, 1, 1), roughness=0.0)


def under_the_sky(session, material: Material, samples: int) -> np.ndarray:
    """Radiance of the pixels of a ball alone under a sky of radiance 1, those of its outline left out."""
    found = shot(session, scenes.scene(scenes.Thing(BALL, material), camera=CAMERA, world=FLAT_WORLD), samples=samples)
    d = directions(CAMERA)
    eye = CAMERA.world_from_camera[:3, 3]
    miss = np.linalg.norm(np.cross(np.broadcast_to(-eye, d.shape), d), axis=2)  # of the ball's centre
    assert np.allclose(found[miss > 1.05], 1)
    return found[miss < 0.95]


@pytest.mark.parametrize("roughness", [0.0, 0.2, 0.5, 1.0])
def test_a_white_metal_ball_cannot_be_seen(session, roughness):
    assert under_the_sky(session, replace(METAL, roughness=roughness), 16).mean() == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("roughness", [0.0, 0.2, 0.5, 1.0])
def test_a_varnished_white_ball_cannot_be_seen(session, roughness):
    assert under_the_sky(session, replace(VARNISH, roughness=roughness), 16).mean() == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("ior", [1.0, 1.33, 1.5, 2.4])
def test_a_clear_ball_cannot_be_seen(session, ior):
    """Not in one pixel: every path that a smooth ball reflects or bends ends in the sky and keeps all of its light."""
    found = under_the_sky(session, replace(GLASS, ior=ior), 4)
    assert found.mean() == pytest.approx(1, abs=0.01)
    assert np.median(found) == pytest.approx(1, abs=1e-4)


@pytest.mark.parametrize("roughness", [0.1, 0.3, 0.6])
def test_a_frosted_ball_cannot_be_seen(session, roughness):
    """2 % for paths that are still inside after 24 vertices: those that go round just beyond the critical angle."""
    assert under_the_sky(session, replace(GLASS, roughness=roughness), 32).mean() == pytest.approx(1, abs=0.02)


def test_a_tinted_sheet_takes_its_colour_at_two_faces(session):
    """Straight through a sheet of index 1: nothing but the root of the colour, twice."""
    sheet = scenes.box("Sheet", (-2, -0.1, -2), (2, 0.1, 2))
    tinted = replace(GLASS, ior=1.0, base_color=(0.8, 0.5, 0.1), specular_level=0)
    camera = Camera("Camera", scenes.look((0, -3, 0), (0, 0, 0)), (8, 6), lens=80.0)
    found = shot(session, scenes.scene(scenes.Thing(sheet, tinted), camera=camera, world=FLAT_WORLD))
    assert np.allclose(found, (0.8, 0.5, 0.1), rtol=1e-4)


SLAB, BEHIND = (0.0, 0.6), 1.5  # metres along y
SLANTED = Camera("Camera", scenes.look((-2.0, -2.0, 0.0), (0, 0.5, 0)), (64, 16), lens=50.0)


def crossing(d: np.ndarray, ior: float) -> np.ndarray:
    """x where rays from the camera along d (..., 3) meet the plane behind the slab, by Snell's law."""
    inside = d / ior
    inside[..., 1] = np.sqrt(1 - inside[..., 0] ** 2 - inside[..., 2] ** 2)
    eye = SLANTED.world_from_camera[:3, 3]
    free = SLAB[0] - eye[1] + BEHIND - SLAB[1]
    return eye[0] + d[..., 0] / d[..., 1] * free + inside[..., 0] / inside[..., 1] * (SLAB[1] - SLAB[0])


@pytest.mark.parametrize("ior", [1.0, 1.5, 2.0])
def test_a_slab_shifts_an_edge_as_snell_says(session, ior):
    """Behind it a wall glows where x > 0. Through two faces comes (1 - R)^2 of it, and more by reflections inside."""
    slab = scenes.box("Slab", (-9, SLAB[0], -9), (9, SLAB[1], 9))
    wall = scenes.quad("Wall", (0, BEHIND, -9), (9, 0, 0), (0, 0, 9 * 2))
    scene = scenes.scene(scenes.Thing(slab, replace(GLASS, ior=ior)), scenes.Thing(wall, glow(1.0)), camera=SLANTED)
    found = shot(session, scene, samples=64)[..., 0]
    x = crossing(directions(SLANTED), ior)
    pixel = np.abs(np.diff(x, axis=1)).max()
    lit, dark = found[(x > pixel) & (x < 1)], found[(x < -pixel) & (x > -0.5)]
    assert len(lit) > 50 and len(dark) > 50
    assert lit.min() > 0.5 and dark.max() < 0.25
    assert shot(session, replace(scene, world=World((1, 1, 1))), samples=64).mean() == pytest.approx(1, abs=0.01)


def test_glass_throws_a_full_shadow(session):
    """As in Cycles without caustics."""
    floor, sheet = scenes.Thing(scenes.floor(4.0)), scenes.box("Sheet", (-1, -1, 1), (1, 1, 1.1))
    sun = scenes.lamp("SUN", (0, 0, 1), emitted=3.0)
    camera = Camera("Low", scenes.look((0, -1.9, 0.5), (0, 0, 0)), (16, 12), lens=80.0)
    found = shot(session, scenes.scene(floor, scenes.Thing(sheet, GLASS), lights=(sun,), camera=camera), bounces=0,
                 gather_rays=1)
    assert found[4:8, 4:12].max() < 1e-3
