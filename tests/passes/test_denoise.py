# SPDX-License-Identifier: GPL-3.0-or-later
"""The noise filter: what it must smooth and what it must leave."""

from __future__ import annotations

import numpy as np

from svo_engine.scene.types import World
from tests import scenes
from tests.on_gpu import picture_of

RAYS = {"method": "rays", "cache_resolution": "32", "gather_rays": 1}


def test_pixels_without_a_surface_are_the_worlds(session):
    scene = scenes.cornell(world=World((0.25, 0.5, 1.0)))
    plain, smooth = (picture_of(session, scene, denoise=denoise, **RAYS) for denoise in (False, True))
    sky = np.isclose(plain, (0.25, 0.5, 1.0, 1.0)).all(2)
    assert sky.sum() > 100
    assert np.array_equal(plain[sky], smooth[sky])


def test_constant_light_passes_unchanged(session):
    """A floor that sees nothing but the world gets E = pi L in every ray."""
    scene = scenes.scene(scenes.Thing(scenes.floor(10.0)), world=World((0.5, 0.5, 0.5)),
                         camera=scenes.cornell().camera)
    plain, smooth = (picture_of(session, scene, denoise=denoise, **RAYS) for denoise in (False, True))
    assert np.allclose(plain, smooth, rtol=1e-5)
