# SPDX-License-Identifier: GPL-3.0-or-later
"""Indirect light by rays against closed forms: what goes in comes out, at every resolution of the light cache."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.scene.types import Camera, Material, World
from tests import scenes
from tests.rays import TURN, above, directions, floor_points, glow, rectangle_share, shot

FLAT = 0.8 / np.pi  # what white surfaces send back of the irradiance
EYE = scenes.look((-0.8, -0.7, -0.3), (0.5, 0.9, 0.2))


def inside(place: np.ndarray) -> Camera:
    return Camera("Inside", place, (32, 24), lens=20.0, clip_start=0.001)


def furnace(rho: float, turn: np.ndarray):
    """Walls of a closed box that send out 1 and reflect rho, seen from inside."""
    box = scenes.Thing(scenes.box("Box", (-1, -1, -1), (1, 1, 1)), glow(1.0, rho), (turn,))
    return scenes.scene(box, camera=inside(turn @ EYE))


@pytest.mark.parametrize(("resolution", "turn"), [
    ("32", np.eye(4)), ("64", np.eye(4)), ("128", np.eye(4)), ("256", np.eye(4)), ("32", TURN), ("64", TURN)])
def test_a_furnace_is_as_bright_everywhere(session, resolution, turn):
    """L = Le / (1 - rho) on the walls of a closed box, whatever the rays. The tolerance that ends bounces leaves out
    rho^3 TOLERANCE of it. Turned, every face cuts voxels askew and voxels at the edges hold two or three of them.
    """
    settings = {"cache_resolution": resolution, "cache_rays": 1, "gather_rays": 1, "bounces": 64}
    assert np.allclose(shot(session, furnace(0.5, turn), **settings), 2, rtol=2e-3)


def test_a_bright_furnace(session):
    assert np.allclose(shot(session, furnace(0.8, TURN), bounces=64), 5, rtol=5e-3)


def test_a_white_room_under_a_white_sky_cannot_be_seen(session):
    """Albedo 1 everywhere, radiance 1 from outside: all light gets out again, and all that is seen is 1. The tolerance
    ends the bounces at 0.5 % of what the first brought; with 1 / (1 - 0.85) bounces in a room with one side open, up to
    3 % of that is missing, in the corners of most.
    """
    white = Material("White", (1, 1, 1), specular_level=0)
    things = [replace(thing, material=white) for thing in scenes.room()]
    found = shot(session, scenes.scene(*things, camera=scenes.cornell().camera, world=World((1, 1, 1))), bounces=64)
    assert found.max() < 1 + 1e-5
    assert found.mean() > 0.99


def test_an_integrating_sphere(session):
    """Wherever the lamp: I cos / d^2 from itself and rho I / (R^2 (1 - rho)) from the sphere, everywhere the same."""
    rho, at = 0.6, np.array([0.3, -0.2, 0.4])
    camera = inside(scenes.look((0, 0, 0), (0, 1, 0.1)))
    scene = scenes.scene(scenes.Thing(scenes.sphere("Ball", 1.0, 24), glow(0.0, rho)), camera=camera,
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


def test_the_resolution_of_the_cache_changes_nothing(session):
    """A room with a lamp, colours and a block."""
    found = [shot(session, scenes.cornell(), samples=4, cache_resolution=n).mean() for n in ("32", "64", "128")]
    assert np.allclose(found, found[-1], rtol=0.02)


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


def test_a_wall_of_twenty_thousand_triangles_sends_what_one_of_two_sends(session):
    sun = scenes.lamp("SUN", (1, 0, 0.5), emitted=3.0)
    means = []
    for n in (1, 100):
        wall = scenes.Thing(scenes.quad("Wall", (-0.5, -1, 0), (0, 2, 0), (0.1, 0, 1.5), n), scenes.RED)
        scene = scenes.scene(scenes.Thing(scenes.floor()), wall, lights=(sun,), camera=above())
        means.append(shot(session, scene, samples=4).mean((0, 1)))
    assert np.allclose(means[0], means[1], rtol=0.01)
