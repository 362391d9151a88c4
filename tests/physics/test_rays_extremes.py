# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays in scenes that are hard on numbers: far away, huge, bright, and the same bits in every run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.gpu import device as device_module
from svo_engine.render import Session
from svo_engine.scene.types import Camera, Material, Scene, World
from tests import scenes
from tests.passes.test_hard_scenes import HARD, lamps_in_odd_places
from tests.rays import shot

GLASSY = Material("Glassy", (0.7, 0.5, 0.3), roughness=0.2, metallic=0.5, emission=(0.1, 0, 0))


def placed_anew(scene: Scene, change: np.ndarray, gain: float = 1.0) -> Scene:
    """The whole scene under a similarity, its grey lamps `gain` times as bright."""
    scale = np.cbrt(np.linalg.det(change[:3, :3]))

    camera = scene.camera
    assert camera

    def rigid(m: np.ndarray) -> np.ndarray:
        return change @ m @ np.diag([1 / scale] * 3 + [1])

    lights = tuple(replace(light, world_from_light=rigid(light.world_from_light), radius=light.radius * scale,
                           emitted=(gain * light.emitted[0],) * 3) for light in scene.lights)
    camera = replace(camera, world_from_camera=rigid(camera.world_from_camera), clip_start=camera.clip_start * scale,
                     clip_end=camera.clip_end * scale)
    placed = replace(scene.instances, world_from_object=change @ scene.instances.world_from_object)
    return replace(scene, instances=placed, lights=lights, camera=camera)


def rich_scene() -> Scene:
    """Every kind of lamp, a metal ball twice, a sky."""
    balls = (scenes.moved(0.5, 0.2, 0.25), scenes.moved(0.6, -0.4, 0.25))
    return scenes.cornell(
        scenes.lamp("POINT", (0.4, -0.3, 1.7), emitted=2.0, radius=0.1),
        scenes.lamp("SPOT", (-0.5, -0.9, 1.5), (0, 0, 0), emitted=3.0, spot_angle=1.0, spot_blend=0.3, radius=0.05),
        scenes.lamp("AREA", (0, 0, 1.9), emitted=4.0, size=(0.5, 0.3), spread=2.0),
        scenes.lamp("SUN", (1, -3, 2), emitted=0.5, angle=0.01),
        things=(scenes.Thing(scenes.sphere("Ball", 0.25, 8), GLASSY, balls),), world=World((0.1, 0.2, 0.3)))


def test_far_from_the_origin_is_as_near(session):
    """Doubles keep 1e-10 m at 1e6 m, and all f4 numbers are relative to the scene's centre. A ray that passes an edge
    may pass it on the other side.
    """
    scene = scenes.cornell(world=World((0.1, 0.2, 0.3)))
    near, far = (shot(session, s) for s in (scene, placed_anew(scene, scenes.moved(1e6, -2e6, 5e5))))
    same = np.isclose(near, far, rtol=2e-3, atol=2e-4).all(2)
    assert same.mean() > 0.98
    assert far.mean() == pytest.approx(near.mean(), rel=2e-3)


@pytest.mark.parametrize("scale", [2.0**-10, 2.0**10])
def test_size_does_not_matter(session, scale):
    """A room of 2 km with a lamp of 10^6 times the power is the room of 2 m: powers of two leave no room for rounding,
    so that what differs would be a length somebody wrote down.
    """
    scene = scenes.cornell()
    usual, scaled = (shot(session, s) for s in (scene, placed_anew(scene, np.diag([scale] * 3 + [1]), scale**2)))
    assert np.allclose(usual, scaled, rtol=1e-4)


def test_a_kilometre_lit_by_a_megawatt_is_finite(session):
    """A lamp of 10^6 W one metre over the ground and a sun of 10^6 W m^-2: no number overflows."""
    lights = (scenes.lamp("POINT", (0, 0, 81), emitted=1e6 / (4 * np.pi)), scenes.lamp("SUN", (1, 0, 3), emitted=1e6))
    camera = Camera("Camera", scenes.look((0, -900, 300)), (64, 48), clip_end=5000.0)
    tower = scenes.Thing(scenes.box("Tower", (-50, -50, 0), (50, 50, 80)))
    scene = scenes.scene(scenes.Thing(scenes.floor(1000.0)), tower, lights=lights, camera=camera)
    found = shot(session, scene)
    assert np.isfinite(found).all()
    assert found.max() > 0.8 / np.pi * 1e6 * 0.94
    assert found.max() < 1e6


def test_two_renders_are_equal_to_the_bit(session, monkeypatch):
    """Again, in a fresh session, and with the work cut otherwise."""
    scene, other = rich_scene(), Session()
    first = shot(session, scene, samples=2)
    assert np.isfinite(first).all() and first.min() >= 0
    fresh = shot(other, rich_scene(), samples=2)
    other.close()
    assert np.array_equal(first, fresh)
    assert np.array_equal(first, shot(session, scene, samples=2))
    monkeypatch.setattr(device_module, "FIRST_SLICE", 512)
    monkeypatch.setattr(device_module, "SLICE_SECONDS", 1e-9)
    monkeypatch.setattr(session._opened()[0].call(lambda device: device), "_per_second", {})
    assert np.array_equal(first, shot(session, rich_scene(), samples=2))


def test_another_seed_gives_other_noise_of_the_same_mean(session):
    scene = scenes.cornell()
    first, second = (shot(session, scene, seed=seed, samples=4) for seed in (0, 1))
    assert not np.array_equal(first, second)
    assert first.mean() == pytest.approx(second.mean(), rel=0.02)


CAMERA = Camera("Camera", scenes.look((0, -4, 1)), (32, 24))


@pytest.mark.parametrize("things", HARD.values(), ids=HARD.keys())
def test_scenes_of_odd_shape_are_finite(session, things):
    scene = scenes.scene(*things, camera=CAMERA, world=World((0.2, 0.2, 0.2)),
                         lights=(scenes.lamp("POINT", (1, -1, 3), emitted=10.0),))
    found = shot(session, scene)
    assert np.isfinite(found).all()
    assert found.min() >= 0


@pytest.mark.parametrize("lamp", lamps_in_odd_places(), ids=lambda lamp: lamp.kind)
def test_no_lamp_gives_nan(session, lamp):
    shiny = Material("Shiny", (0.8, 0.8, 0.8), roughness=0.0, metallic=1.0)
    scene = replace(scenes.cornell(lamp), materials=(shiny, *scenes.cornell().materials[1:]))
    found = shot(session, scene)
    assert np.isfinite(found).all()
    assert found.min() >= 0


@pytest.mark.parametrize("material", [
    Material("Mirror", (1, 1, 1), roughness=0.0, metallic=1.0),
    Material("Rough metal", (1, 1, 1), roughness=1.0, metallic=1.0),
    Material("Diamond", (0.5, 0.5, 0.5), roughness=0.0, ior=9.0, specular_level=1.0),
    Material("Glass", (1, 1, 1), transmission=1.0, roughness=0.0),
], ids=lambda material: material.name)
def test_no_material_makes_light_negative_or_not_finite(session, material):
    """Balls show every angle, the grazing ones too."""
    ball = scenes.Thing(scenes.sphere("Ball", 1.0, 24), material)
    scene = scenes.scene(ball, scenes.Thing(scenes.floor(4.0)), camera=CAMERA, world=World((0.5, 0.5, 0.5)))
    found = shot(session, scene, samples=4)
    assert np.isfinite(found).all()
    assert found.min() >= 0
