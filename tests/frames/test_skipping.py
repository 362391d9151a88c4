# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene does not need is not done, and no picture shows it."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.needs import needs_of
from svo_engine.scene.types import Scene
from svo_engine.settings import PASSES, RenderSettings
from tests import scenes, variety
from tests.on_gpu import film_of

RAYS = {"method": "rays", "cache_resolution": "32", "cache_rays": 4, "adaptive_sampling": False}


def same_without_skipping(session, scene: Scene, **settings) -> None:
    """Assert that all planes are the same to the bit."""
    films = [film_of(session, scene, skip_unneeded=skips, **settings) for skips in (True, False)]
    assert films[0].planes.keys() == films[1].planes.keys()
    differing = [name for name, plane in films[0].planes.items()
                 if not np.array_equal(plane, films[1].planes[name], equal_nan=True)]
    assert differing == []


@pytest.mark.parametrize("name", variety.SCENES)
def test_pictures_do_not_depend_on_skipping(session, name):
    same_without_skipping(session, variety.SCENES[name](), **RAYS, samples=2, passes=tuple(PASSES))


@pytest.mark.parametrize("name", ["plain", "emissive", "alpha", "metal", "world image"])
def test_pictures_by_cones_do_not_depend_on_skipping(session, name):
    same_without_skipping(session, variety.SCENES[name](), samples=2, passes=tuple(PASSES))


@pytest.mark.parametrize("name", ["plain", "emissive", "glass", "everything"])
def test_adaptive_pictures_do_not_depend_on_skipping(session, name):
    same_without_skipping(session, variety.SCENES[name](), **{**RAYS, "adaptive_sampling": True}, samples=16,
                          noise_threshold=0.1, min_samples=8)


UNNEEDED = ("evaluate/principled", "path/step", "lights/draw", "lights/weigh", "gather/found", "cache/found",
            "albedo/integrate")


def test_a_diffuse_room_runs_nothing_for_what_it_has_not(session):
    session.forget()
    counts = film_of(session, scenes.cornell(), **RAYS).stats["counts"]
    assert [name for name in UNNEEDED if counts.get(name)] == []
    assert counts["gather/rays"] > 0 < counts["evaluate/matte"]


def test_without_skipping_it_runs(session):
    """But for what depends on emissive triangles and on paths themselves, of which there are none."""
    session.forget()
    counts = film_of(session, scenes.cornell(), skip_unneeded=False, **RAYS).stats["counts"]
    assert {name for name in UNNEEDED if not counts.get(name)} == {"lights/weigh", "cache/found"}


def test_a_scene_that_needs_all_of_it_runs_it(session):
    session.forget()
    counts = film_of(session, variety.SCENES["glowing metal"](), **RAYS).stats["counts"]
    assert [name for name in UNNEEDED if not counts.get(name)] == []


def test_films_say_what_was_skipped(session):
    scene = variety.alcove()
    assert film_of(session, scene, **RAYS).stats["skipped"] == needs_of(scene, RenderSettings()).told()
    assert film_of(session, scene, skip_unneeded=False, **RAYS).stats["skipped"] == {}
