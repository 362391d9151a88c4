# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed forms of the radiometry; `tests/blender/test_radiometry.py` holds it against Cycles."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from svo_engine.scene import units

COLOR = (1.0, 0.5, 0.25)


@pytest.mark.parametrize("radius", [0.0, 0.1, 2.0])
def test_point_sends_its_watts_in_all_directions(radius):
    intensity = units.point_intensity(100, COLOR, radius)
    np.testing.assert_allclose(np.multiply(intensity, 4 * pi), np.multiply(COLOR, 100))


@pytest.mark.parametrize("radius", [0.1, 2.0])
def test_point_that_is_not_normalised_has_a_fixed_exitance(radius):
    """Intensity I of a sphere is pi r^2 L; the watts are its exitance pi L."""
    radiance = np.array(units.point_intensity(100, COLOR, radius, normalize=False)) / (pi * radius**2)
    np.testing.assert_allclose(pi * radiance, np.multiply(COLOR, 100))


def test_sun_does_not_depend_on_its_angle():
    assert units.sun_irradiance(3, COLOR, angle=0.5) == units.sun_irradiance(3, COLOR) == (3.0, 1.5, 0.75)


@pytest.mark.parametrize("angle", [0.01, 1.0, pi])
def test_sun_that_is_not_normalised_has_a_fixed_radiance(angle):
    """E is L times the integral of cos over the disk, here summed over rings."""
    rings = (np.arange(4000) + 0.5) / 4000 * angle / 2
    solid_angles = 2 * pi * np.sin(rings) * angle / 2 / 4000
    expected = 3 * (np.cos(rings) * solid_angles).sum()
    assert units.sun_irradiance(3, COLOR, angle, normalize=False)[0] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(("is_ellipse", "area"), [(False, 6.0), (True, 6.0 * pi / 4)])
def test_area_sends_its_watts_from_its_front(is_ellipse, area):
    """The flux of a Lambertian emitter is pi L A."""
    assert units.area_of((2, 3), is_ellipse) == pytest.approx(area)
    radiance = units.area_radiance(100, COLOR, area)
    np.testing.assert_allclose(np.multiply(radiance, pi * area), np.multiply(COLOR, 100))


def test_area_that_is_not_normalised_has_a_fixed_exitance():
    small, large = (units.area_radiance(100, COLOR, area, normalize=False) for area in (0.1, 10.0))
    assert small == large
    np.testing.assert_allclose(np.multiply(small, pi), np.multiply(COLOR, 100))
