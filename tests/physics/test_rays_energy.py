# SPDX-License-Identifier: GPL-3.0-or-later
"""Indirect light by rays against closed forms: what goes in comes out. `figures.py` has the furnaces."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.scene.types import Material, World
from tests import scenes
from tests.physics.figures import inside
from tests.rays import above, directions, floor_points, glow, rectangle_share, shot

FLAT = 0.8 / np.pi  # what white surfaces send back of the irradiance


def test_an_integrating_sphere(session):
    """Wherever the lamp: I cos / d^2 from itself and rho I / (R^2 (1 - rho)) from the sphere, everywhere the same."""
    rho, at = 0.6, np.array([0.3, -0.2, 0.4])
    camera = inside(scenes.look((0, 0, 0), (0, 1, 0.1)))
    scene = scenes.scene(scenes.Thing(scenes.sphere("Ball", 1.0, 40), glow(0.0, rho)), camera=camera,
                         lights=(scenes.lamp("POINT", at, emitted=2.0),))
    found = shot(session, scene, cache_rays=8, samples=16)[..., 0] * np.pi / rho
    p = directions(camera)
    to = at - p
    direct = 2 * -(to * p).sum(2) / np.linalg.norm(to, axis=2) ** 3
    indirect = 2 * rho / (1 - rho)
    assert (found - direct).mean() == pytest.approx(indirect, rel=0.01)


def check_share(found: np.ndarray, share: np.ndarray, n: int) -> None:
    """The share of n directions against its probability: evenly spread ones are no worse than random ones, of which one
    in two million is 5 sigma off; the mean of all pixels within 4 of its sigma.
    """
    sigma = np.sqrt(share * (1 - share) / n)
    assert (np.abs(found - share) < 5 * sigma + 1e-4).all()
    assert abs((found - share).mean()) < 4 * np.sqrt((sigma**2).mean() / share.size) + 1e-4


LOW, HIGH = (-0.3, -0.2), (0.5, 0.4)


def level(z: float, material: Material) -> scenes.Thing:
    return scenes.Thing(scenes.quad("Level", (*LOW, z), (0.8, 0, 0), (0, 0.6, 0)), material)


def seen_share(session, thing: scenes.Thing, unit: float, **more) -> np.ndarray:
    """Irradiance of the floor in units of pi times `unit`, seen from below the thing; 64 directions a pixel."""
    scene = scenes.scene(scenes.Thing(scenes.floor(4.0)), thing, camera=above(z=0.1), **more)
    return shot(session, scene, samples=16, gather_rays=4, bounces=0)[..., 0] / (FLAT * np.pi * unit)


POINTS = floor_points(above())


def test_emission_is_counted_once(session):
    """E = pi L F: of all directions the share F meets the lamp."""
    check_share(seen_share(session, level(0.5, glow(3.0)), 3), rectangle_share(POINTS, LOW, HIGH, 0.5), 64)


def test_the_sky_lights_what_a_roof_leaves_free(session):
    """E = pi L (1 - F)"""
    found = seen_share(session, level(0.2, scenes.BLACK), 2, world=World((2, 2, 2)))
    check_share(found, 1 - rectangle_share(POINTS, LOW, HIGH, 0.2), 64)


def test_half_a_roof_takes_half_of_its_share(session):
    """With alpha 1/2 every second ray goes through."""
    veil = Material("Veil", (0, 0, 0), specular_level=0, alpha=0.5)
    found = seen_share(session, level(0.2, veil), 2, world=World((2, 2, 2)))
    check_share(found, 1 - rectangle_share(POINTS, LOW, HIGH, 0.2) / 2, 64)


@pytest.mark.parametrize("thickness", [0.0, 0.01, 0.03, 0.1, 0.3])
def test_the_thickness_of_a_board_changes_nothing(session, thickness):
    """A sunlit floor, from a tenth of a voxel to four, lights the walls around it as a sheet does."""
    walls = [scenes.Thing(scenes.quad("Back", (-1, 1, 0), (2, 0, 0), (0, 0, 2))),
             scenes.Thing(scenes.quad("Side", (-1, -1, 0), (0, 2, 0), (0, 0, 2)))]
    floors = [scenes.Thing(scenes.floor()), scenes.Thing(scenes.box("Board", (-1, -1, -thickness), (1, 1, 0)))]
    sun = scenes.lamp("SUN", (1, -1, 2), emitted=3.0)
    sheet, board = (shot(session, scenes.scene(floor, *walls, camera=above(), lights=(sun,)), samples=4).mean()
                    for floor in floors)
    assert board == pytest.approx(sheet, rel=0.01)
