# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes that are hard on numbers: far away, flat, mirrored, bright, with lamps and materials at their limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from svo_engine.scene.types import Camera, Image, Light, Material, Scene, World
from tests import scenes
from tests.on_gpu import picture_of

CAMERA = Camera("Camera", scenes.look((0, -4, 1)), (64, 48))


def placed_anew(scene: Scene, instances: np.ndarray, place: Callable[[np.ndarray], np.ndarray]) -> Scene:
    """The scene with other matrices of instances, and its lamps and camera where `place` puts them."""
    assert scene.camera
    lights = tuple(replace(light, world_from_light=place(light.world_from_light)) for light in scene.lights)
    return replace(scene, instances=replace(scene.instances, world_from_object=instances), lights=lights,
                   camera=replace(scene.camera, world_from_camera=place(scene.camera.world_from_camera)))


def moved_scene(scene: Scene, offset: np.ndarray) -> Scene:
    """The whole scene with lamps and camera elsewhere."""
    instances = scene.instances.world_from_object.copy()
    instances[:, :3, 3] += offset
    return placed_anew(scene, instances, lambda m: scenes.moved(*offset) @ m)


def test_far_from_the_origin_is_as_near(session):
    """Doubles keep 1e-10 m at 1e6 m, and all f4 numbers are relative to the scene's centre: they differ in the last bit
    where rounding falls otherwise. A pixel that sees an edge may see the other side of it.
    """
    scene = scenes.cornell(scenes.lamp("POINT", (0.2, -0.3, 1.7), emitted=5.0), world=World((0.1, 0.2, 0.3)))
    near = picture_of(session, scene, samples=2)
    far = picture_of(session, moved_scene(scene, np.array([1e6, -2e6, 5e5])), samples=2)
    same = np.isclose(near, far, rtol=2e-3, atol=2e-4).all(2)
    assert same.mean() > 0.99


def mirrored_x(scene: Scene) -> Scene:
    """Everything at -x: instances with a negative scale, lamps and camera turned round."""
    flip = np.diag([-1.0, 1, 1, 1])
    return placed_anew(scene, flip @ scene.instances.world_from_object, lambda m: flip @ m @ flip)


@pytest.mark.parametrize("material", [scenes.WHITE, scenes.GLOSSY], ids=["diffuse", "glossy"])
def test_a_mirrored_scene_gives_the_mirrored_picture(session, material):
    """Normals of an instance with a negative scale point outwards too."""
    ball = scenes.Thing(scenes.sphere("Ball", 0.8, 12), material, (scenes.moved(-0.3, 0, 0),))
    scene = scenes.scene(ball, camera=replace(CAMERA, world_from_camera=scenes.look((0, -4, 0))),
                         lights=(scenes.lamp("SUN", (2, -3, 2), emitted=3.0, casts_shadow=False),))
    picture, mirror = picture_of(session, scene), picture_of(session, mirrored_x(scene))
    assert np.isclose(picture[:, ::-1], mirror, rtol=0.05, atol=0.01).all(2).mean() > 0.97


NOTHING = np.diag([0.0, 0, 0, 1])
HARD = {
    "flat": (scenes.Thing(scenes.floor()),),
    "a point of a mesh": (scenes.Thing(scenes.floor(1e-6)),),
    "1000 to 1": (scenes.Thing(scenes.floor(1000.0)), scenes.Thing(scenes.box("Box", (-0.5, -0.5, 0), (0.5, 0.5, 1)))),
    "a needle": (scenes.Thing(scenes.box("Needle", (-500, -0.01, 0), (500, 0.01, 0.02))),),
    "scaled flat": (scenes.Thing(scenes.box("Box", (-1, -1, 0), (1, 1, 1)), places=(np.diag([1.0, 1, 0, 1]),)),),
    "scaled to nothing": (scenes.Thing(scenes.floor()), scenes.Thing(scenes.sphere("Ball"), places=(NOTHING,))),
}


@pytest.mark.parametrize("things", HARD.values(), ids=HARD.keys())
def test_scenes_of_odd_shape_are_finite(session, things):
    scene = scenes.scene(*things, camera=CAMERA, world=World((0.2, 0.2, 0.2)),
                         lights=(scenes.lamp("POINT", (1, -1, 3), emitted=10.0),))
    for view in ("combined", "voxel_normal", "voxel_radiance"):
        picture = picture_of(session, scene, view=view)
        assert np.isfinite(picture).all()
        assert picture.min() >= 0


def test_a_kilometre_lit_by_a_megawatt_is_finite(session):
    """Radiance in the voxels is kept in half floats: what lies beside the lamp is cut off, and nothing overflows."""
    lights = (scenes.lamp("POINT", (0, 0, 1), emitted=1e6 / (4 * np.pi)), scenes.lamp("SUN", (1, 0, 3), emitted=1e6))
    camera = Camera("Camera", scenes.look((0, -900, 300)), (64, 48), clip_end=5000.0)
    tower = scenes.Thing(scenes.box("Tower", (-50, -50, 0), (50, 50, 80)))
    scene = scenes.scene(scenes.Thing(scenes.floor(1000.0)), tower, lights=lights, camera=camera)
    picture = picture_of(session, scene)
    assert np.isfinite(picture).all()
    assert picture.max() > 1e4


def lamps_in_odd_places() -> list[Light]:
    """On a surface, in a corner, along an axis, inside things, without size, without brightness."""
    return [scenes.lamp("POINT", (0, 0, 0)), scenes.lamp("POINT", (-1, -1, 0), radius=0.5),
            scenes.lamp("SPOT", (0, 0, 2), (0, 0, 3), spot_angle=0.0, spot_blend=0.0),
            scenes.lamp("SPOT", (0.5, 0, 1), spot_angle=np.pi, spot_blend=1.0, radius=0.3),
            scenes.lamp("AREA", (0, 0, 1), size=(0.0, 0.0)), scenes.lamp("AREA", (0, 0, 0), size=(5, 5), spread=0.0),
            scenes.lamp("SUN", (0, 0, 1), angle=np.pi), scenes.lamp("SUN", (0, 1, 0), emitted=0.0),
            scenes.lamp("POINT", (0.3, 0.3, 1), radius=10.0), scenes.lamp("POINT", (0, 0, 0), soft_falloff=True)]


@pytest.mark.parametrize("lamp", lamps_in_odd_places(), ids=lambda lamp: lamp.kind)
def test_no_lamp_gives_nan(session, lamp):
    shiny = Material("Shiny", (0.8, 0.8, 0.8), roughness=0.0, metallic=1.0)
    scene = replace(scenes.cornell(lamp), materials=(shiny, *scenes.cornell().materials[1:]))
    picture = picture_of(session, scene)
    assert np.isfinite(picture).all()
    assert picture.min() >= 0


@pytest.mark.parametrize("material", [
    Material("Mirror", (1, 1, 1), roughness=0.0, metallic=1.0),
    Material("Rough metal", (1, 1, 1), roughness=1.0, metallic=1.0),
    Material("Dim and rough", (0, 0, 0), roughness=1.0, specular_level=0.01),
    Material("Diamond", (0.5, 0.5, 0.5), roughness=0.0, ior=9.0, specular_level=1.0),
    Material("No contrast", (1, 1, 1), ior=1.0),
    Material("Glass", (1, 1, 1), transmission=1.0, roughness=0.0),
], ids=lambda material: material.name)
def test_no_material_makes_light_negative_or_not_finite(session, material):
    """Balls show every angle, the grazing ones too."""
    ball = scenes.Thing(scenes.sphere("Ball", 1.0, 24), material)
    scene = scenes.scene(ball, scenes.Thing(scenes.floor(4.0)), camera=CAMERA, world=World((0.5, 0.5, 0.5)),
                         lights=(scenes.lamp("POINT", (2, -2, 3), emitted=20.0),))
    picture = picture_of(session, scene)
    assert np.isfinite(picture).all()
    assert picture.min() >= 0


def test_a_camera_that_sees_from_a_millimetre_to_a_hundred_kilometres(session):
    """The ratio of 1e8 leaves f4 nothing of the far plane; the direction of a ray must not depend on it."""
    sky = Image("Sky", np.random.default_rng(1).uniform(size=(8, 16, 4)).astype("f4"))
    near = replace(CAMERA, world_from_camera=scenes.look((30, -40, 10), (0, 0, 12)), lens=18.0)
    scene = scenes.scene(scenes.Thing(scenes.floor(200.0)), camera=near, images=(sky,), world=World((1, 1, 1), 0))
    usual = picture_of(session, scene)
    wide = picture_of(session, scene, scenes.view(replace(scene, camera=replace(near, clip_start=0.001, clip_end=1e5))))
    assert np.isclose(usual, wide, atol=0.01).all(2).mean() > 0.98
