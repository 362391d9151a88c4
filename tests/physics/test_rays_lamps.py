# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps with a size: their noise on a floor, and shadows, against closed forms. Each pixel sees the point in its
centre.
"""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.scene.types import Material
from tests import scenes
from tests.rays import above, floor_points, rectangle_share, shot

FLAT = 0.8 / np.pi  # what the white floor sends back of the irradiance
CAMERA = above()
POINTS = floor_points(CAMERA)
ROUNDING = 2e-4  # some hundred roundings of f4
SAMPLES = 16


def floor_light(session, lamp, *things, samples=1, camera=CAMERA) -> np.ndarray:
    """Irradiance (height, width) of the floor."""
    scene = scenes.scene(scenes.Thing(scenes.floor(4.0)), *things, lights=(lamp,), camera=camera)
    picture = shot(session, scene, samples=samples)
    assert np.array_equal(picture[..., 0], picture[..., 1]) and np.array_equal(picture[..., 0], picture[..., 2])
    return picture[..., 0] / FLAT


def to_lamp(position) -> tuple[np.ndarray, np.ndarray]:
    """Distance and unit direction (height, width, 3) from the floor's points to a lamp."""
    to = np.array(position) - POINTS
    d = np.linalg.norm(to, axis=2)
    return d, to / d[..., None]


def check_noisy(found: np.ndarray, expected: np.ndarray, variance: np.ndarray | float) -> None:
    """Points spread evenly are no worse than random ones: SAMPLES of these leave sigma^2 = variance / SAMPLES a pixel,
    and pixels are independent. 5 sigma is exceeded once in two million, and bias cannot hide in the mean.
    """
    sigma = np.sqrt(np.broadcast_to(variance, found.shape) / SAMPLES) + ROUNDING * expected
    assert (np.abs(found - expected) < 5 * sigma).all()
    assert abs((found - expected).mean()) < 4 * np.sqrt((sigma**2).mean() / found.size) + ROUNDING * expected.mean()


@pytest.mark.parametrize("radius", [0.1, 0.5])
def test_a_sphere_above_the_horizon_is_a_point(session, radius):
    """E = I cos / d^2 whatever the radius. The cosine over the cap that it covers has a variance below
    s^2 sin^2 / 4 + s^4 with s = r / d.
    """
    at = (0.1, 0.2, 0.9)
    d, wi = to_lamp(at)
    expected = 5 * wi[..., 2] / d**2
    spread = (radius / d) ** 2
    variance = (5 / d**2) ** 2 * (spread * (1 - wi[..., 2] ** 2) / 4 + spread**2)
    found = floor_light(session, scenes.lamp("POINT", at, emitted=5.0, radius=radius), samples=SAMPLES)
    check_noisy(found, expected, variance)


def area_terms(at, size) -> np.ndarray:
    """L A cos cos' / d^2 of each of 24^2 midpoints of a level rectangle of L = 1, (height, width, 24^2)."""
    local = (np.arange(24) + 0.5) / 24 - 0.5
    x, y = (part.ravel() for part in np.meshgrid(at[0] + local * size[0], at[1] + local * size[1]))
    d2 = (x - POINTS[..., :1]) ** 2 + (y - POINTS[..., 1:2]) ** 2 + at[2] ** 2
    return size[0] * size[1] * at[2] ** 2 / d2**2


@pytest.mark.parametrize("size", [(0.4, 0.4), (1.2, 0.3)])
def test_a_rectangle(session, size):
    """E = pi L F."""
    at = (0.2, 0.1, 0.6)
    low, high = [(at[0] + s * size[0] / 2, at[1] + s * size[1] / 2) for s in (-1, 1)]
    lamp = scenes.lamp("AREA", at, (0.2, 0.1, 0), emitted=2.0, size=size)
    expected = 2 * np.pi * rectangle_share(POINTS, low, high, at[2])
    terms = 2 * area_terms(at, size)
    assert np.allclose(terms.mean(2), expected, rtol=0.01), "the test's own two ways to say E"
    check_noisy(floor_light(session, lamp, samples=SAMPLES), expected, terms.var(2))


def test_a_wide_sun(session):
    """Directions fill a flat disk of tan(angle / 2) around the axis evenly."""
    angle, steps = 0.6, (np.arange(200) + 0.5) / 200
    r, phi = np.meshgrid(np.sqrt(steps) * np.tan(angle / 2), 2 * np.pi * steps)
    cosine = (0.8 + 0.6 * r * np.cos(phi)) / np.sqrt(1 + r * r)
    lamp = scenes.lamp("SUN", (3, 0, 4), emitted=2.0, angle=angle)
    found = floor_light(session, lamp, samples=SAMPLES)
    check_noisy(found, np.full(found.shape, 2 * cosine.mean()), 4 * cosine.var())


def roof(half: float, z: float, material: Material = scenes.BLACK) -> scenes.Thing:
    return scenes.Thing(scenes.quad("Roof", (-half, -half, z), (2 * half, 0, 0), (0, 2 * half, 0)), material)


def test_the_shadow_of_a_point_has_an_edge(session):
    """Pixels whose centre is nearer to the edge than rounding of the shadow ray's start may fall on either side."""
    at, under = np.array([0.2, 0.1, 0.8]), above(z=0.3)
    found = floor_light(session, scenes.lamp("POINT", at, emitted=5.0), roof(0.3, 0.4), camera=under)
    d, wi = to_lamp(at)
    crossing = POINTS + wi * (0.4 / wi[..., 2])[..., None]
    beyond = np.abs(crossing[..., :2]).max(2) - 0.3
    lit, dark = beyond > 1e-4, beyond < -1e-4
    assert not found[dark].any()
    assert np.allclose(found[lit], (5 * wi[..., 2] / d**2)[lit], rtol=ROUNDING)
    assert lit.sum() > 100 and dark.sum() > 100


def test_the_shadow_of_a_rectangle_has_an_umbra(session):
    """No light where no point of the lamp is seen, all of it where every point is, less in between."""
    at, size, half, under = (0.0, 0.0, 0.8), (0.3, 0.3), 0.4, above(z=0.3)
    lamp = scenes.lamp("AREA", at, (0, 0, 0), emitted=2.0, size=size)
    found = floor_light(session, lamp, roof(half, 0.4), samples=SAMPLES, camera=under)
    # The roof lies half way: it hides the lamp's corner c from floor points nearer to 2 (+-half) - c than that
    distance = np.abs(POINTS[..., :2]).max(2)
    umbra, lit = distance < 2 * half - 0.15 - 1e-3, distance > 2 * half + 0.15 + 1e-3
    expected = 2 * np.pi * rectangle_share(POINTS, (-0.15, -0.15), (0.15, 0.15), 0.8)
    assert not found[umbra].any()
    assert umbra.sum() > 100 and lit.sum() > 20
    sigma = 2 * area_terms(at, size).std(2) / np.sqrt(SAMPLES) + ROUNDING * expected
    assert (np.abs(found - expected)[lit] < 5 * sigma[lit]).all()
    partly = ~umbra & ~lit
    assert (found[partly] <= (expected + 5 * sigma)[partly]).all()
    assert 0 < found[partly].mean() < expected[partly].mean()


def test_what_casts_no_shadow_lights_all(session):
    lamp = scenes.lamp("POINT", (0.2, 0.1, 0.8), emitted=5.0, casts_shadow=False)
    d, wi = to_lamp((0.2, 0.1, 0.8))
    found = floor_light(session, lamp, roof(0.3, 0.4), camera=above(z=0.3))
    assert np.allclose(found, 5 * wi[..., 2] / d**2, rtol=ROUNDING)


def test_a_veil_lets_its_part_of_the_light_through(session):
    """Every shadow ray is let through with the probability 1 - alpha, anew in each sample."""
    veil = Material("Veil", (0, 0, 0), specular_level=0, alpha=0.3)
    found = floor_light(session, scenes.lamp("SUN", (0, 0, 1), emitted=2.0), roof(2.0, 0.4, veil), samples=SAMPLES,
                        camera=above(z=0.3))
    check_noisy(found, np.full(found.shape, 2 * 0.7), 4 * 0.3 * 0.7)
