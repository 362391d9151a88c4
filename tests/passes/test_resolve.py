# SPDX-License-Identifier: GPL-3.0-or-later
"""What leaves towards the eye: emission, world, diffuse and specular parts, the mean over the samples."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.scene.types import Camera, Image, Material, World
from tests import scenes
from tests.on_gpu import picture_of

CAMERA = Camera("Camera", scenes.look((0, -3, 0)), (32, 24), is_orthographic=True, ortho_scale=1.0)


def wall(material: Material) -> scenes.Thing:
    """It fills the picture."""
    return scenes.Thing(scenes.quad("Wall", (-1, 0, -1), (2, 0, 0), (0, 0, 2)), material)


def test_emission_is_seen_as_it_is(session):
    scene = scenes.scene(wall(Material("Lamp", (0, 0, 0), emission=(1, 20, 300), specular_level=0)), camera=CAMERA)
    assert np.allclose(picture_of(session, scene, samples=3), (1, 20, 300, 1), rtol=1e-6)


@pytest.mark.parametrize("samples", [1, 7])
def test_the_mean_over_the_samples_of_a_constant_is_the_constant(session, samples):
    scene = scenes.scene(camera=CAMERA, world=World((0.1, 0.2, 0.3)))
    assert np.allclose(picture_of(session, scene, samples=samples), (0.1, 0.2, 0.3, 1), rtol=1e-6)


def test_a_transparent_film_leaves_the_world_out_and_keeps_its_light(session):
    scene = scenes.scene(scenes.Thing(scenes.sphere("Ball", 0.3, 8)), camera=CAMERA, world=World((1, 1, 1)))
    filled, clear = picture_of(session, scene), picture_of(session, replace(scene, film_transparent=True))
    on_ball = clear[..., 3] == 1
    assert 0.1 < on_ball.mean() < 0.5
    assert np.array_equal(filled[on_ball], clear[on_ball])
    assert not clear[~on_ball].any()


def brightness(session, material: Material, **settings) -> np.ndarray:
    """RGB of a wall that the sun lights from 45 degrees above the camera, whose mirror direction is elsewhere."""
    scene = scenes.scene(wall(material), camera=CAMERA, lights=(scenes.lamp("SUN", (0, -1, 1), emitted=np.pi),))
    return picture_of(session, scene, **settings)[12, 16, :3]


COSINE = np.cos(np.pi / 4)
SELF_LIGHT = 0.06  # cones gather a little of the wall's own light: 0.037 of it at this resolution, none in truth


def test_the_diffuse_part_is_albedo_over_pi(session):
    assert np.allclose(brightness(session, scenes.RED), np.array([0.8, 0.1, 0.1]) * COSINE, rtol=SELF_LIGHT)


@pytest.mark.parametrize("more", [{"metallic": 1.0}, {"transmission": 1.0}])
def test_metal_and_glass_have_no_diffuse_part(session, more):
    smooth = Material("Smooth", (0.8, 0.8, 0.8), roughness=0.05, **more)
    assert brightness(session, smooth, specular_cone=False).max() < 0.02


def test_half_a_metal_has_half_of_it(session):
    mixed = Material("Mixed", (0.8, 0.8, 0.8), roughness=0.05, metallic=0.5, specular_level=0.0)
    assert np.allclose(brightness(session, mixed, specular_cone=False), 0.4 * COSINE, rtol=SELF_LIGHT)


def test_a_reflecting_layer_takes_from_the_diffuse_light_under_it(session):
    """Glass of index 1.5 head on: about 4 % of the light does not reach the base."""
    layered = Material("Layered", (0.8, 0.8, 0.8), roughness=0.05)
    share = brightness(session, layered, specular_cone=False)[0] / brightness(session, scenes.WHITE)[0]
    assert 0.94 < share < 0.97


def test_a_mirror_shows_the_sky_behind_the_camera(session):
    """Its cone sees the world's image in the mirror direction: +y is reflected to -y."""
    image = np.zeros((16, 32, 4), "f4")
    image[:, 20:28] = (0, 1, 0, 1)  # around -y
    mirror = Material("Mirror", (1, 1, 1), roughness=0.0, metallic=1.0)
    scene = scenes.scene(wall(mirror), camera=CAMERA, images=(Image("Sky", image),), world=World((1, 1, 1), 0))
    seen = picture_of(session, scene)[12, 16]
    assert seen[1] > 0.9
    assert seen[0] < 0.05
