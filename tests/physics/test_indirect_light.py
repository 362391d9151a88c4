# SPDX-License-Identifier: GPL-3.0-or-later
"""Light from the world and from surfaces. Rays must be right; of cones it is stated how far they are off."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.scene.types import Camera, Material, World
from tests import scenes
from tests.on_gpu import picture_of
from tests.physics.test_direct_light import points, rectangle_irradiance

SKY = World((1, 1, 1))


@pytest.mark.parametrize("size", [(64, 48), (7, 5)])
def test_a_world_seen_directly_is_what_it_is(session, size):
    camera = Camera("Camera", scenes.look((0, -4, 1)), size)
    picture = picture_of(session, scenes.scene(camera=camera, world=World((0.3, 2, 40))), samples=5)
    assert np.allclose(picture[..., :3].mean((0, 1), dtype="f8"), (0.3, 2, 40), rtol=1e-6)


def sheet(facing, world=None, lights=()):
    """A white square through the origin, seen head on from the side that it faces, filling the picture."""
    z = np.array(facing, "f8") / np.linalg.norm(facing)
    up = (0, 1, 0) if abs(z[2]) > 0.9 else (0, 0, 1)
    place = scenes.look(3 * z, (0, 0, 0), up)
    x, y = place[:3, 0], place[:3, 1]
    camera = Camera("Camera", place, (16, 16), is_orthographic=True, ortho_scale=1.6)
    return scenes.scene(scenes.Thing(scenes.quad("Sheet", -2 * x - 2 * y, 4 * x, 4 * y)), camera=camera,
                        world=world or World(), lights=lights)


FACINGS = [(0, 0, 1), (0, 0, -1), (-1, 0, 0), (1, 0, 1), (0.48, 0.6, 0.64)]


@pytest.mark.parametrize("facing", FACINGS)
@pytest.mark.parametrize(("method", "resolution", "error"),
                         [("rays", "32", 1e-3), ("cones", "32", 0.06), ("cones", "64", 0.12)])
def test_a_flat_sheet_under_a_white_sky_is_as_bright_as_its_albedo(session, facing, method, resolution, error):
    """L = rho. Cones that start on the side on which most of the voxel lies shadow themselves: measured 0.045 at 32 and
    0.097 at 64, nothing on the other side.
    """
    picture = picture_of(session, sheet(facing, SKY), method=method, resolution=resolution, samples=2)
    assert np.allclose(picture[..., :3], 0.8, rtol=error)


@pytest.mark.parametrize("facing", FACINGS)
@pytest.mark.parametrize(("method", "resolution", "error"),
                         [("rays", "32", 1e-3), ("cones", "32", 0.05), ("cones", "64", 0.09)])
def test_a_flat_sheet_does_not_light_itself(session, facing, method, resolution, error):
    """L = rho E / pi and nothing more. Cones on that side gather some: measured 0.036 at 32, 0.077 at 64."""
    scene = sheet(facing, lights=(scenes.lamp("SUN", facing, emitted=np.pi),))
    picture = picture_of(session, scene, method=method, resolution=resolution, samples=2)
    assert np.allclose(picture[..., :3], 0.8, rtol=error)
    assert picture.min() > 0.8 * (1 - 0.01)


def under_a_glowing_ceiling():
    """A floor 1 m below a square of 2 m that radiates 1 W m^-2 sr^-1, seen from between them."""
    glow = Material("Glow", (0, 0, 0), emission=(1, 1, 1), specular_level=0)
    ceiling = scenes.Thing(scenes.quad("Glow", (-1, -1, 1), (0, 2, 0), (2, 0, 0)), glow)
    camera = Camera("Camera", scenes.look((0, 0, 0.9), (0, 0, 0), (0, 1, 0)), (16, 16), is_orthographic=True,
                    ortho_scale=1.6, clip_start=0.01)
    return scenes.scene(scenes.Thing(scenes.floor(4.0)), ceiling, camera=camera)


@pytest.mark.parametrize(("method", "resolution", "samples", "error"), [
    ("rays", "32", 64, 0.02), ("cones", "32", 1, 0.25), ("cones", "64", 1, 0.15)])
def test_a_glowing_ceiling_lights_the_floor(session, method, resolution, samples, error):
    """L = rho F; on average over the picture, where noise and the edges of cones even out. Measured for cones: 0.17 too
    bright at 32, 0.07 at 64: filtered voxels are thicker than a sheet.
    """
    found = picture_of(session, under_a_glowing_ceiling(), method=method, resolution=resolution, samples=samples)
    expected = 0.8 * rectangle_irradiance(points(), (1, 1), 1.0) / np.pi
    assert found[..., 0].mean() == pytest.approx(expected.mean(), rel=error)


@pytest.mark.parametrize("method", ["cones", "rays"])
def test_emission_is_linear_and_keeps_its_colour(session, method):
    scene = under_a_glowing_ceiling()
    bright = tuple(replace(m, emission=(30, 3, 0.3)) if m.name == "Glow" else m for m in scene.materials)
    one, other = (picture_of(session, s, method=method)[..., :3] for s in (scene, replace(scene, materials=bright)))
    assert np.allclose(other, one * (30, 3, 0.3), rtol=0.01, atol=1e-3)


@pytest.mark.parametrize(("method", "error"), [("rays", 0.01), ("cones", 0.02)])
def test_tessellation_changes_nothing(session, method, error):
    """A lit wall beside a floor, as 2 and as 20,000 triangles: the same light on the floor, pixel by pixel."""
    pictures = []
    for n in (1, 100):
        wall = scenes.Thing(scenes.quad("Wall", (0.7, -1, 0), (0, 0, 1.1), (0, 2, 0), n), scenes.RED)
        sun = scenes.lamp("SUN", (-1, 0, 0.1), emitted=5.0)
        scene = scenes.scene(scenes.Thing(scenes.floor()), wall, lights=(sun,),
                             camera=Camera("Camera", scenes.look((-1.5, -1.5, 2), (0, 0, 0)), (32, 24)))
        pictures.append(picture_of(session, scene, method=method, samples=4))
    same = np.isclose(*pictures, rtol=error, atol=2e-3).all(2)
    assert same.mean() > 0.97  # edges of triangles decide about single pixels on the outline


def test_a_voxel_view_of_a_wall_is_as_bright_as_the_wall(session):
    """What the voxels send out is what the surface sends out: the sun on a floor, by both."""
    scene = sheet((0, 0, 1), lights=(scenes.lamp("SUN", (0, 0, 1), emitted=np.pi),))
    voxels = picture_of(session, scene, view="voxel_radiance")[..., 0].max()
    assert voxels == pytest.approx(picture_of(session, scene)[8, 8, 0], rel=5e-3)
