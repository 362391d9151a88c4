# SPDX-License-Identifier: GPL-3.0-or-later
"""lib/light_sampling.glsl: means over a lamp's points against the integrals that they stand for."""

from __future__ import annotations

from math import atan, cos, pi, sqrt, tan

import numpy as np
import pytest

from svo_engine.passes import upload
from tests import scenes
from tests.compute import evaluate

SIDE = 48  # midpoints along each side of the unit square: the rule's error falls with the square of it
MIDPOINTS = np.stack(np.meshgrid(*[(np.arange(SIDE) + 0.5) / SIDE] * 2), -1).reshape(-1, 2).astype("f4")


def sampled(device, light, p=(0, 0, 0), u=MIDPOINTS):
    """wi (n, 3), distance (n,), E_perp (n,) of the red channel; p: one point, or one a row of u."""
    rows = np.repeat(upload.light_rows((light,), np.zeros(3)), len(u))
    points = np.broadcast_to(np.array(p, "f4"), (len(u), 3))

    def of(kind, field):
        call = f"sample_light(light, p, u).{field}"
        return evaluate(device, kind, call, ("lib/light_sampling.glsl",), light=rows, u=u, p=points).astype("f8")

    return of("vec3", "wi"), of("float", "distance"), of("vec3", "E_perp")[:, 0]


def irradiance(device, light, p=(0, 0, 0), n=(0, 0, 1)) -> float:
    """E [W m^-2] at p on a surface with normal n, the mean over the lamp's points."""
    wi, _, e_perp = sampled(device, light, p)
    return float((e_perp * np.maximum(wi @ np.array(n, "f8"), 0)).mean())


@pytest.mark.parametrize(("radius", "tilt"), [(0, 0), (0, 1.2), (0.1, 0), (0.1, 1.2), (1.0, 0.9), (1.9, 0), (1.9, 0.2)])
def test_a_sphere_brings_i_cos_over_d2_whatever_its_radius(device, radius, tilt):
    """Exact while all of the sphere is above the horizon. The cosine's mean is linear in u: midpoints are exact."""
    lamp = scenes.lamp("POINT", (0, 0, 2), emitted=3.0, radius=radius)
    assert irradiance(device, lamp, n=(np.sin(tilt), 0, cos(tilt))) == pytest.approx(3.0 * cos(tilt) / 4, rel=1e-4)


def test_the_rays_to_a_sphere_end_on_it(device):
    lamp = scenes.lamp("POINT", (0.5, -1, 2), radius=0.7)
    wi, distance, _ = sampled(device, lamp)
    on_sphere = wi * distance[:, None] - (0.5, -1, 2)
    assert np.allclose(np.linalg.norm(on_sphere, axis=1), 0.7, atol=2e-3)  # grazing rays: the root of a small number
    assert np.allclose(np.linalg.norm(wi, axis=1), 1, atol=1e-6)


@pytest.mark.parametrize("radius", [0, 0.1, 1.0, 3.0])
def test_a_soft_lamp_brings_i_over_d2_plus_r2(device, radius):
    """A disk that faces the point: E = I / (d^2 + r^2) on its axis. Midpoints on 48 rings: 1e-3."""
    lamp = scenes.lamp("POINT", (0, 0, 2), emitted=3.0, radius=radius, soft_falloff=True)
    assert irradiance(device, lamp) == pytest.approx(3.0 / (4 + radius**2), rel=1e-3)


def test_a_lamp_at_the_very_point_is_no_reason_for_nan(device):
    for more in ({}, {"radius": 0.5}, {"soft_falloff": True}, {"radius": 0.5, "soft_falloff": True}):
        for part in sampled(device, scenes.lamp("POINT", (0, 0, 1e-30), **more)):
            assert np.isfinite(part).all()


@pytest.mark.parametrize("angle", [0, 0.01, 0.5, 2.0])
def test_the_sun_brings_e_from_a_disk_around_its_axis(device, angle):
    lamp = scenes.lamp("SUN", (1, 2, 2), emitted=5.0, angle=angle)
    wi, distance, e_perp = sampled(device, lamp)
    axis = np.array([1, 2, 2]) / 3
    assert np.allclose(e_perp, 5)
    assert distance.min() > 1e20
    assert (wi @ axis).min() >= cos(angle / 2) - 1e-6
    assert np.allclose(np.cross(wi.mean(0), axis), 0, atol=1e-5)
    tangents = np.linalg.norm(wi / (wi @ axis)[:, None] - axis, axis=1)  # a flat disk, evenly filled
    assert (tangents**2).mean() == pytest.approx(tan(angle / 2) ** 2 / 2, rel=2e-3, abs=1e-9)


def rectangle_form_factor(a: float, b: float) -> float:
    """From a small surface to a parallel rectangle of 2a by 2b, both in units of the distance along the common axis."""
    def corner(a, b):
        return a / sqrt(1 + a * a) * atan(b / sqrt(1 + a * a)) + b / sqrt(1 + b * b) * atan(a / sqrt(1 + b * b))

    return 4 * corner(a, b) / (2 * pi)


@pytest.mark.parametrize("size", [(0.01, 0.01), (1.0, 1.0), (2.0, 0.5), (6.0, 6.0)])
def test_a_rectangle_on_its_axis_has_its_form_factor(device, size):
    lamp = scenes.lamp("AREA", (0, 0, 2), emitted=7.0, size=size)
    expected = 7.0 * pi * rectangle_form_factor(size[0] / 4, size[1] / 4)
    assert irradiance(device, lamp) == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("diameter", [0.01, 1.0, 6.0])
def test_a_disk_on_its_axis_has_its_form_factor(device, diameter):
    """F = r^2 / (r^2 + d^2)"""
    lamp = scenes.lamp("AREA", (0, 0, 2), emitted=7.0, size=(diameter, diameter), is_ellipse=True)
    r2 = diameter**2 / 4
    assert irradiance(device, lamp) == pytest.approx(7.0 * pi * r2 / (r2 + 4), rel=2e-3)


def test_an_ellipse_has_the_area_of_an_ellipse(device):
    lamp = scenes.lamp("AREA", (0, 0, 100), emitted=7.0, size=(2.0, 0.5), is_ellipse=True)
    assert irradiance(device, lamp) == pytest.approx(7.0 * pi * 1.0 * 0.25 / 100**2, rel=1e-3)


def test_an_area_lamp_is_dark_behind(device):
    lamp = scenes.lamp("AREA", (0, 0, 2), size=(1.0, 1.0))
    _, _, e_perp = sampled(device, lamp, p=(0.2, 0.1, 3))
    assert (e_perp == 0).all()


@pytest.mark.parametrize("degrees", [0, 0.1, 1, 5, 30, 90, 179, 180])
def test_every_spread_sends_out_the_same_flux(device, degrees):
    """A lamp of area A and radiance L sends out pi L A: the sum of E_perp r^2 dw over a sphere far around it.

    Spread 0 is one of 2e-4 rad. 4000 rings: their sum is off by less than 1e-3, f4 adds as much to the narrowest.
    """
    side, h = 1e-3, max(np.radians(degrees) / 2, 1e-4)
    lamp = scenes.lamp("AREA", (0, 0, 0), (0, 0, 1), emitted=2.0, size=(side, side), spread=np.radians(degrees))
    angle = (np.arange(4000) + 0.5) / 4000 * min(h, pi / 2)
    p = np.stack([np.sin(angle), 0 * angle, np.cos(angle)], 1).astype("f4")
    _, _, e_perp = sampled(device, lamp, p, np.full((len(p), 2), 0.5, "f4"))
    flux = (e_perp * 2 * pi * np.sin(angle)).sum() * (angle[1] - angle[0])
    assert flux == pytest.approx(2.0 * pi * side * side, rel=2e-3)


def spot_brightness(device, cosines, spot_angle, blend):
    lamp = scenes.lamp("SPOT", (0, 0, 0), (0, 0, 1), spot_angle=spot_angle, spot_blend=blend)
    sines = np.sqrt(1 - np.array(cosines) ** 2)
    p = np.stack([sines, 0 * sines, cosines], 1).astype("f4")
    return sampled(device, lamp, p, np.full((len(p), 2), 0.5, "f4"))[2]


def test_a_hard_spot_is_as_bright_as_a_point_inside_and_dark_outside(device):
    found = spot_brightness(device, [1.0, 0.9, 0.71, 0.70, 0.5], pi / 2, 0.0)
    assert np.allclose(found, [1, 1, 1, 0, 0], atol=1e-5)


@pytest.mark.parametrize("blend", [0.2, 1.0])
def test_a_soft_spot_follows_its_formula(device, blend):
    cosines = np.linspace(0.5, 1.0, 41)
    edge = cos(pi / 4)
    t = np.clip((cosines - edge) / ((1 - edge) * blend), 0, 1)
    assert np.allclose(spot_brightness(device, cosines, pi / 2, blend), t * t * (3 - 2 * t), atol=1e-4)


def test_the_widest_spot_shines_forward_only(device):
    found = spot_brightness(device, [1.0, 0.01, -0.01, -1.0], pi, 0.0)
    assert np.allclose(found, [1, 1, 0, 0], atol=1e-5)
