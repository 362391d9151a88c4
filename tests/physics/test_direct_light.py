# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of lamp on a floor, through the whole pipeline, against closed forms.

The floor reflects one percent, so that whatever it might send back to itself is beyond the fourth digit.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi, sqrt

import numpy as np
import pytest

from svo_engine.scene.types import Camera, Light, Material, Scene
from tests import scenes
from tests.on_gpu import picture_of

METHODS = ["cones", "rays"]
RHO = 0.01
DIM = Material("Dim", (RHO, RHO, RHO), specular_level=0)
SIDE, PIXELS = 1.6, 16
ABOVE = Camera("Camera", scenes.look((0, 0, 3), (0, 0, 0), (0, 1, 0)), (PIXELS, PIXELS), is_orthographic=True,
               ortho_scale=SIDE)


def points() -> np.ndarray:
    """The floor's points (16, 16, 3) that the pixels' centres see."""
    x = (np.arange(PIXELS) + 0.5) / PIXELS * SIDE - SIDE / 2
    return np.stack([*np.meshgrid(x, x), np.zeros((PIXELS, PIXELS))], -1)


def irradiance(session, lamp: Light, method: str, samples: int = 1, scene: Scene | None = None) -> np.ndarray:
    """E (16, 16) [W m^-2] on the floor under `lamp`, each pixel a point."""
    scene = scene or scenes.scene(scenes.Thing(scenes.floor(4.0), DIM), camera=ABOVE)
    picture = picture_of(session, replace(scene, lights=(lamp,)), method=method, samples=samples, filter_width=0.01)
    assert np.allclose(picture[..., 0], picture[..., 1])
    return picture[..., 0] * pi / RHO


def geometry(at=(0.3, -0.2, 0.8)) -> tuple[np.ndarray, np.ndarray]:
    """Cosine at the floor and distance (16, 16) of a point at `at`."""
    to = np.array(at) - points()
    d = np.linalg.norm(to, axis=-1)
    return to[..., 2] / d, d


@pytest.mark.parametrize("method", METHODS)
def test_point(session, method):
    """E = I cos / d^2"""
    cosine, d = geometry()
    found = irradiance(session, scenes.lamp("POINT", (0.3, -0.2, 0.8), emitted=5.0), method)
    assert np.allclose(found, 5 * cosine / d**2, rtol=2e-3)


@pytest.mark.parametrize("method", METHODS)
def test_sphere(session, method):
    """The same, whatever the radius, while the floor sees all of it. 64 points a pixel: 1 %."""
    cosine, d = geometry()
    found = irradiance(session, scenes.lamp("POINT", (0.3, -0.2, 0.8), emitted=5.0, radius=0.3), method, 64)
    assert np.allclose(found, 5 * cosine / d**2, rtol=0.01)


@pytest.mark.parametrize("method", METHODS)
def test_soft_point(session, method):
    """Right under a disk that faces the floor E = I / (d^2 + r^2)."""
    lamp = scenes.lamp("POINT", (0.05, 0.05, 0.8), emitted=5.0, radius=0.5, soft_falloff=True)
    found = irradiance(session, lamp, method, 64)
    assert found[8, 8] == pytest.approx(5 / (0.64 + 0.25), rel=0.01)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("angle", [0.0, 0.2])
def test_sun(session, method, angle):
    """E = E0 cos; a small disk changes nothing."""
    found = irradiance(session, scenes.lamp("SUN", (1, 2, 2), emitted=3.0, angle=angle), method, 64 if angle else 1)
    assert np.allclose(found, 3 * 2 / 3, rtol=0.01 if angle else 1e-3)


@pytest.mark.parametrize("method", METHODS)
def test_spot(session, method):
    """A point inside its cone, smooth to 0 over the blend, nothing outside."""
    half, blend = 0.6, 0.4
    cosine, d = geometry((0, 0, 0.8))
    t = np.clip((cosine - cos(half)) / ((1 - cos(half)) * blend), 0, 1)
    lamp = scenes.lamp("SPOT", (0, 0, 0.8), emitted=5.0, spot_angle=2 * half, spot_blend=blend)
    assert np.allclose(irradiance(session, lamp, method), 5 * cosine / d**2 * t * t * (3 - 2 * t), rtol=5e-3, atol=1e-3)


def rectangle_irradiance(p: np.ndarray, half: tuple[float, float], height: float) -> np.ndarray:
    """pi F of a rectangle around the z axis that faces down on points (..., 3) of the floor, by Lambert's formula: the
    angle under which each edge is seen, times the cosine between its plane's normal and the floor's, summed and halved.
    """
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half
    total = np.zeros(p.shape[:-1])
    for a, b in zip(corners, np.roll(corners, -1, 0), strict=True):
        u, v = (np.array([*c, height]) - p for c in (a, b))
        u, v = (x / np.linalg.norm(x, axis=-1, keepdims=True) for x in (u, v))
        cross = np.cross(u, v)
        angle = np.arctan2(np.linalg.norm(cross, axis=-1), (u * v).sum(-1))
        total += angle * cross[..., 2] / np.linalg.norm(cross, axis=-1)
    return np.abs(total) / 2


@pytest.mark.parametrize("method", METHODS)
def test_rectangle(session, method):
    """E = pi L F at every point of the floor. 256 points a pixel: 2 % at the worst of 256 pixels, 0.2 % on average."""
    lamp = scenes.lamp("AREA", (0, 0, 0.7), emitted=2.0, size=(0.8, 0.4))
    expected = 2 * rectangle_irradiance(points(), (0.4, 0.2), 0.7)
    found = irradiance(session, lamp, method, 256)
    assert np.allclose(found, expected, rtol=0.02)
    assert found.mean() == pytest.approx(expected.mean(), rel=2e-3)


@pytest.mark.parametrize("method", METHODS)
def test_disk(session, method):
    """E = pi L r^2 / (r^2 + d^2) below its middle."""
    lamp = scenes.lamp("AREA", (0.05, 0.05, 0.7), emitted=2.0, size=(0.6, 0.6), is_ellipse=True)
    assert irradiance(session, lamp, method, 256)[8, 8] == pytest.approx(2 * pi * 0.09 / (0.09 + 0.49), rel=0.01)


@pytest.mark.parametrize("method", METHODS)
def test_narrow_spread(session, method):
    """A small lamp with spread 2h at angle a: L A cos^4 a (tan h - tan a) / (tan h - h) / z^2."""
    side, h, z = 0.01, 0.5, 0.8
    lamp = scenes.lamp("AREA", (0, 0, z), emitted=200.0, size=(side, side), spread=2 * h)
    cosine, _ = geometry((0, 0, z))
    lobe = np.maximum(np.tan(h) - np.sqrt(1 - cosine**2) / cosine, 0) / (np.tan(h) - h)
    expected = 200 * side * side * cosine**4 * lobe / z**2
    assert np.allclose(irradiance(session, lamp, method), expected, rtol=0.03, atol=0.02 * expected.max())


@pytest.mark.parametrize("method", METHODS)
def test_lamps_add_up(session, method):
    lamps = (scenes.lamp("POINT", (0.3, -0.2, 0.8), emitted=2.0), scenes.lamp("SUN", (1, 2, 2), emitted=3.0))
    scene = scenes.scene(scenes.Thing(scenes.floor(4.0), DIM), camera=ABOVE, lights=lamps)
    both = picture_of(session, scene, method=method, filter_width=0.01)[..., 0] * pi / RHO
    assert np.allclose(both, sum(irradiance(session, lamp, method) for lamp in lamps), rtol=1e-3)


@pytest.mark.parametrize("method", METHODS)
def test_the_shadow_of_a_roof(session, method):
    """Dark below it, and as bright as without it beside it. Rays are exact; the shadow of cones through filtered voxels
    fades over three voxels on either side, and up to a tenth of the light comes through.
    """
    roof = scenes.Thing(scenes.quad("Roof", (-1.5, -1, 0.4), (1.5, 0, 0), (0, 2, 0)), scenes.BLACK)
    camera = replace(ABOVE, world_from_camera=scenes.look((0, 0, 0.35), (0, 0, 0), (0, 1, 0)), clip_start=0.01)
    scene = scenes.scene(scenes.Thing(scenes.floor(4.0), DIM), roof, camera=camera)
    found = irradiance(session, scenes.lamp("SUN", (0, 0, 1)), method, scene=replace(scene, camera=camera))
    voxel = 4.0 / 27 if method == "cones" else 0.0
    x = points()[..., 0]
    assert np.allclose(found[x > 3 * voxel], 1, rtol=0.03)
    assert found[x < -3 * voxel].max() < (0.1 if method == "cones" else 1e-6)


def test_both_sides_of_a_sheet_are_lit(session):
    lamp = scenes.lamp("SUN", (0, 0, -1))
    below = replace(ABOVE, world_from_camera=scenes.look((0, 0, -3), (0, 0, 0), (0, 1, 0)))
    scene = scenes.scene(scenes.Thing(scenes.floor(4.0), DIM), camera=below)
    assert np.allclose(irradiance(session, lamp, "cones", scene=scene), 1, rtol=1e-3)


def test_smooth_normals_shade_smoothly(session):
    """A coarse ball under a sun from the camera: L = rho / pi E cos, and the cosine at radius r is sqrt(1 - r^2).

    8 degrees between the mesh's corners leave 2 %.
    """
    camera = Camera("Camera", scenes.look((0, -3, 0)), (33, 33), is_orthographic=True, ortho_scale=2.2)
    scene = scenes.scene(scenes.Thing(scenes.sphere("Ball", 1.0, 24), DIM), camera=camera,
                         lights=(scenes.lamp("SUN", (0, -1, 0), casts_shadow=False),))
    row = picture_of(session, scene, filter_width=0.01)[16, :, 0] * pi / RHO
    x = (np.arange(33) - 16) / 33 * 2.2
    inside = np.abs(x) < 0.9
    assert np.allclose(row[inside], np.sqrt(1 - x[inside] ** 2), atol=0.02)
    assert sqrt(1 - 0.9**2) > 0.4  # far enough to the edge to mean something
