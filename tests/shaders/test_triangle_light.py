# SPDX-License-Identifier: GPL-3.0-or-later
"""lib/triangle_light.glsl: directions towards triangles against the integrals that they stand for."""

from __future__ import annotations

import numpy as np
import pytest

from tests.compute import evaluate

INCLUDES = ("lib/triangle_light.glsl",)
SIDE = 32
MIDPOINTS = np.stack(np.meshgrid(*[(np.arange(SIDE) + 0.5) / SIDE] * 2), -1).reshape(-1, 2).astype("f4")

# As seen from the origin: far and small, near and large, a sliver, one that fills nearly a hemisphere
TRIANGLES = {
    "far": ((-0.5, -0.5, 40), (0.5, -0.3, 40), (0.1, 0.7, 41)),
    "small": ((-0.03, -0.02, 1), (0.04, -0.02, 1), (0, 0.05, 1.02)),
    "near": ((-1, -1, 0.8), (1.5, -1, 0.8), (0, 2, 0.5)),
    "sliver": ((-1, 0, 0.5), (1, 0, 0.5), (1, 0.02, 0.5)),
    "huge": ((-80, -50, 1), (90, -50, 1), (5, 80, 1))}


@pytest.fixture(params=TRIANGLES, ids=list(TRIANGLES))
def corners(request):
    return np.array(TRIANGLES[request.param], "f8")


def call(device, kind, expression, corners, u=MIDPOINTS):
    rows = {name: np.tile(corner.astype("f4"), (len(u), 1)) for name, corner in zip("abc", corners, strict=True)}
    return evaluate(device, kind, expression, INCLUDES, u=u, **rows).astype("f8")


def solid_angle(corners) -> float:
    """By the sum of the angles of the spherical triangle, in double precision."""
    a, b, c = corners / np.linalg.norm(corners, axis=1)[:, None]

    def angle(p, q, r):
        pq, pr = np.cross(p, q), np.cross(p, r)
        return np.arctan2(np.linalg.norm(np.cross(pq, pr)), pq @ pr)

    return angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - np.pi


def polygon_share(corners) -> np.ndarray:
    """Lambert's formula: the integral of the direction over the solid angle, (3,)."""
    unit = corners / np.linalg.norm(corners, axis=1)[:, None]
    total = np.zeros(3)
    for p, q in zip(unit, np.roll(unit, -1, 0), strict=True):
        n = np.cross(p, q)
        total += np.arctan2(np.linalg.norm(n), p @ q) * n / np.linalg.norm(n) / 2
    return total * np.sign(total @ unit.sum(0))


def test_the_solid_angle(device, corners):
    """Single precision: ten roundings of the volume, which is no less than a thousandth of its terms here."""
    found = call(device, "float", "solid_angle_of(normalize(a), normalize(b), normalize(c))", corners)
    assert np.allclose(found, solid_angle(corners), rtol=1e-3)


def test_directions_end_in_the_triangle_where_they_say(device, corners):
    wi = call(device, "vec3", "draw_triangle(mat3(a, b, c), u).wi", corners)
    distance = call(device, "float", "draw_triangle(mat3(a, b, c), u).distance", corners)
    bary = call(device, "vec2", "draw_triangle(mat3(a, b, c), u).bary", corners)
    on_triangle = corners[0] + bary @ (corners[1:] - corners[0])
    assert np.allclose(np.linalg.norm(wi, axis=1), 1, atol=1e-6)
    assert np.allclose(wi * distance[:, None], on_triangle, atol=1e-3 * np.abs(corners).max())
    assert bary.min() > -1e-3 and bary.sum(1).max() < 1 + 1e-3


def test_the_mean_is_lamberts(device, corners):
    """Light of radiance 1, on every orientation that sees all of it. Of midpoints, the triangle that fills the
    hemisphere has most of the error.
    """
    wi = call(device, "vec3", "draw_triangle(mat3(a, b, c), u).wi", corners)
    omega = call(device, "float", "draw_triangle(mat3(a, b, c), u).solid_angle", corners)
    expected = polygon_share(corners)
    assert np.allclose((wi * omega[:, None]).mean(0), expected, atol=5e-3 * np.linalg.norm(expected))


def test_a_ray_finds_the_density_of_the_draw(device, corners):
    draw = call(device, "float", "draw_triangle(mat3(a, b, c), u).solid_angle", corners)
    found = call(device, "float", "spread_towards(mat3(a, b, c), draw_triangle(mat3(a, b, c), u).wi)", corners)
    assert np.allclose(found, draw, rtol=1e-3)


def test_a_point_in_the_triangles_plane_sees_nothing_of_it(device):
    flat = np.array([[1, 0, 0], [2, 0, 0], [1, 1, 0]], "f8")
    omega = call(device, "float", "draw_triangle(mat3(a, b, c), u).solid_angle", flat)
    assert (omega == 0).all()
