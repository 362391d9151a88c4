# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays in scenes that are hard on numbers: huge, bright, of odd shape. `figures.py` has those far away and scaled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.gpu import device as device_module
from svo_engine.scene.types import Camera, Material, World
from tests import scenes
from tests.passes.test_hard_scenes import HARD, lamps_in_odd_places
from tests.rays import shot


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


def test_work_that_is_cut_otherwise_gives_the_same_bits(session, monkeypatch):
    first = shot(session, scenes.rich(), samples=2)
    assert np.isfinite(first).all() and first.min() >= 0
    monkeypatch.setattr(device_module, "FIRST_SLICE", 512)
    monkeypatch.setattr(device_module, "SLICE_SECONDS", 1e-9)
    monkeypatch.setattr(session.opened().thread.call(lambda device: device), "_per_second", {})
    session.forget()
    assert np.array_equal(first, shot(session, scenes.rich(), samples=2))


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
