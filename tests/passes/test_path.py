# SPDX-License-Identifier: GPL-3.0-or-later
"""Paths: as many mirrors as they have vertices, no more rounds than there is something to follow."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.needs import LONGEST_PATH
from svo_engine.passes import parts
from svo_engine.scene.types import Camera, Material, Scene
from svo_engine.settings import PASSES
from tests import scenes, variety
from tests.on_gpu import film_of
from tests.rays import RAYS, directions, glow, shot

F0 = np.array([0.9, 0.6, 0.3])
MIRROR = Material("Mirror", (0.9, 0.6, 0.3), roughness=0.0, metallic=1.0)
LENGTH, RADIANCE = 54.0, 5.0
CAMERA = Camera("Camera", scenes.look((0.1, 0, 0), (0.1, 1, 0)), (192, 8), lens=18.0)
MOST = LONGEST_PATH - 1  # bounces

D = directions(CAMERA)
END = 0.1 + D[..., 0] / D[..., 1] * LENGTH  # where rays would reach the corridor's end if there were no mirrors
BOUNCES = np.floor((np.abs(END) + 1) / 2)
INSIDE = np.abs((np.abs(END) + 1) / 2 - np.round((np.abs(END) + 1) / 2)) > 0.02  # not at the emitter's edge
FRESNEL = F0 + (1 - F0) * (1 - np.abs(D[..., :1])) ** 5


def corridor() -> Scene:
    """Two mirrors along y, 2 m apart, and a glowing wall at their end."""
    left = scenes.quad("Left", (-1, -1, -4), (0, LENGTH + 1, 0), (0, 0, 8))
    right = scenes.quad("Right", (1, -1, -4), (0, 0, 8), (0, LENGTH + 1, 0))
    end = scenes.quad("End", (-1, LENGTH, -4), (2, 0, 0), (0, 0, 8))
    return scenes.scene(scenes.Thing(left, MIRROR), scenes.Thing(right, MIRROR), scenes.Thing(end, glow(RADIANCE)),
                        camera=CAMERA)


@pytest.fixture(scope="module")
def shown(session):
    """What the camera sees of the corridor, as a share of what shines at its end."""
    return shot(session, corridor()) / RADIANCE


@pytest.mark.parametrize("n", range(MOST + 1))
def test_an_emitter_is_seen_in_so_many_mirrors(shown, n):
    seen = INSIDE & (n == BOUNCES)
    assert seen.sum() >= 8
    assert np.allclose(shown[seen], FRESNEL[seen] ** n, rtol=2e-4 * (n + 1), atol=1e-7)


def test_paths_end_after_the_most_bounces(shown):
    """What is met last is lit by the light cache alone, which is no mirror."""
    beyond = INSIDE & (BOUNCES > MOST)
    assert beyond.sum() >= 8
    assert not np.isclose(shown[beyond], FRESNEL[beyond] ** BOUNCES[beyond][:, None], rtol=1e-2).all(1).any()


def rounds(session, scene: Scene, **settings) -> int:
    settings = {**RAYS, "adaptive_sampling": False, **settings}
    return film_of(session, scene, **settings).stats["counts"].get("path rounds", 0)


def test_there_are_as_many_rounds_as_the_longest_path_has_legs(session):
    assert rounds(session, corridor()) == MOST


@pytest.mark.parametrize("skips", [True, False])
@pytest.mark.parametrize("fields", [{"metallic": 1.0}, {"specular_level": 0.5}])
def test_what_is_rough_takes_one_round(session, fields, skips):
    rough = Material("Rough", (0.8, 0.8, 0.8), roughness=1.0, **{"specular_level": 0.0, **fields})
    assert rounds(session, variety.alcove(rough), skip_unneeded=skips) == 1


@pytest.mark.parametrize("skips", [True, False])
def test_without_mirrors_there_are_no_rounds(session, skips):
    assert rounds(session, variety.alcove(), skip_unneeded=skips) == 0


def test_glass_that_does_not_bend_light_is_not_seen(session):
    """A slab in front of glowing tiles, with all of it in its own shadowless light."""
    tiles = [scenes.Thing(scenes.quad(f"Tile {i}", (-1 + 0.5 * i, 1, -1), (0.5, 0, 0), (0, 0, 2)), glow(1.0 + i))
             for i in range(4)]
    slab = scenes.Thing(scenes.box("Slab", (-0.6, 0, -0.4), (0.5, 0.3, 0.5)),
                        Material("Air", (1, 1, 1), roughness=0.0, ior=1.0, transmission=1.0, specular_level=0.0))
    camera = Camera("Camera", scenes.look((0, -2, 0), (0, 0, 0)), (32, 24), lens=40.0)
    with_it, without = (shot(session, scenes.scene(*things, camera=camera)) for things in ([*tiles, slab], tiles))
    assert len(np.unique(without.round(3))) >= 4
    assert np.allclose(with_it, without, rtol=1e-5)


@pytest.mark.parametrize("name", ["plain", "emissive", "alpha", "many lamps on metal", "glowing metal", "glass",
                                  "world image"])
def test_a_picture_in_parts_is_the_same_picture(session, monkeypatch, name):
    scene, settings = variety.SCENES[name](), {**RAYS, "samples": 2, "passes": tuple(PASSES)}
    session.forget("parts")
    whole = film_of(session, scene, **settings)
    with monkeypatch.context() as patch:
        patch.setattr(parts, "MOST_SLOTS_OF_SOFTWARE", 64)
        session.forget("parts")
        in_parts = film_of(session, scene, **settings)
    session.forget("parts")
    n = {film: film.stats["counts"]["evaluate/matte"] for film in (whole, in_parts)}
    assert (n[whole], n[in_parts]) == (2, 2 * 6)
    assert [name for name, plane in whole.planes.items()
            if not np.array_equal(plane, in_parts.planes[name], equal_nan=True)] == []
