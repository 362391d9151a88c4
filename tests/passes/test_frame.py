# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame as a whole: the same bits every time, nothing done twice, and scenes that are hard on numbers."""

from __future__ import annotations

import copy
from dataclasses import replace

import numpy as np
import pytest

from svo_engine.gpu import device as device_module
from svo_engine.render import Session
from svo_engine.scene.types import Camera, World
from svo_engine.settings import VIEWS
from tests import scenes
from tests.on_gpu import film_of, picture_of


def test_two_renders_are_equal_to_the_bit(session):
    scene = scenes.rich()
    first = picture_of(session, scene, samples=3)
    session.forget()
    assert np.array_equal(first, picture_of(session, scene, samples=3))


def test_a_fresh_session_and_a_fresh_scene_give_the_same_bits(session):
    first = picture_of(session, scenes.rich(), samples=2)
    other = Session()
    second = picture_of(other, scenes.rich(), samples=2)
    other.close()
    assert np.array_equal(first, second)


def test_other_slices_give_the_same_bits(session, monkeypatch):
    first = picture_of(session, scenes.rich(), samples=1)
    device = session.opened().thread.call(lambda device: device)
    monkeypatch.setattr(device_module, "FIRST_SLICE", 512)
    monkeypatch.setattr(device_module, "SLICE_SECONDS", 1e-9)
    monkeypatch.setattr(device, "_per_second", {})
    session.forget()
    film = film_of(session, scenes.rich(), samples=1)
    assert film.stats["counts"]["gather/cones"] > 2
    assert np.array_equal(first, film.planes["Combined"])


def test_another_seed_gives_another_picture(session):
    scene = scenes.rich()
    assert not np.array_equal(picture_of(session, scene), picture_of(session, scene, seed=1))


VOXELIZE, LIGHT, GATHER = "voxelize/accumulate", "light/inject", "gather/cones"


def stages_run(film) -> set[str]:
    return {stage for stage in (VOXELIZE, LIGHT, GATHER) if film.stats["counts"].get(stage)}


@pytest.fixture
def rendered(session):
    """A scene that the session has just rendered."""
    scene = scenes.cornell()
    session.forget()
    assert stages_run(film_of(session, scene)) == {VOXELIZE, LIGHT, GATHER}
    return scene


def test_an_unchanged_scene_is_not_voxelized_again(session, rendered):
    film = film_of(session, rendered)
    assert stages_run(film) == {GATHER}
    assert not any(name.startswith("voxelize/") for name in film.stats["times_ms"])


def test_a_moved_camera_needs_no_new_light(session, rendered):
    view = scenes.view(replace(rendered, camera=replace(rendered.camera, lens=60.0)))
    assert stages_run(film_of(session, rendered, view)) == {GATHER}


def test_a_moved_camera_needs_new_light_if_highlights_are_stored(session, rendered):
    film_of(session, rendered, injection_specular=0.5)
    moved = replace(rendered.camera, world_from_camera=scenes.look((1, -4, 1), (0, 0, 1)))
    film = film_of(session, rendered, scenes.view(replace(rendered, camera=moved)), injection_specular=0.5)
    assert stages_run(film) == {LIGHT, GATHER}


LIT = {"cache/direct", "gather/rays"}
ALL = {"bvh/nearest", "octree/accumulate", "octree/paint", "cache/link", *LIT}


def made(session, scene) -> set[str]:
    """The stages of which anything ran on the way to the picture of `scene` by rays."""
    counts = film_of(session, scene, method="rays", cache_resolution="32", cache_rays=1).stats["counts"]
    return {name for name in ALL if counts.get(name)}


@pytest.mark.parametrize(("edit", "expected"), [
    (lambda s: replace(s, lights=(replace(s.lights[0], emitted=(9, 8, 7)),)), LIT),
    (lambda s: replace(s, world=World((1, 1, 0))), LIT),
    (lambda s: replace(s, materials=(replace(s.materials[0], base_color=(0.1, 0.2, 0.3)), *s.materials[1:])),
     {"octree/paint", "gather/rays"}),
    (copy.deepcopy, {"gather/rays"}),
], ids=["a lamp's power", "the world", "a colour", "nothing, loaded again"])
def test_an_edit_costs_its_own_part(session, edit, expected):
    """And gives what a session gives that has seen nothing else."""
    scene = scenes.cornell()
    session.forget()
    assert made(session, scene) == ALL
    assert made(session, edit(scene)) == expected
    settings = {"method": "rays", "cache_resolution": "32", "cache_rays": 1}
    after = picture_of(session, edit(scene), **settings)
    session.forget()
    assert np.array_equal(after, picture_of(session, edit(scene), **settings))


def test_a_moved_object_keeps_the_trees_of_meshes(session):
    scene = scenes.cornell()
    session.forget()
    made(session, scene)
    matrices = scene.instances.world_from_object.copy()
    matrices[-1, 0, 3] += 0.01
    counts = film_of(session, replace(scene, instances=replace(scene.instances, world_from_object=matrices)),
                     method="rays", cache_resolution="32", cache_rays=1).stats["counts"]
    assert counts["octree/accumulate"] and counts["bvh/nearest invocations"] < scene.n_triangles


@pytest.mark.parametrize("changed", [{"injection_ambient": 0.1}, {"injection_samples": 7}, {"injection_specular": 0.1}])
def test_settings_of_injection_need_new_light_but_no_new_voxels(session, rendered, changed):
    assert stages_run(film_of(session, rendered, **changed)) == {LIGHT, GATHER}


@pytest.mark.parametrize("changed", [{"samples": 2}, {"cone_step": 1.0}, {"seed": 5}, {"filter_width": 1.0}])
def test_settings_of_the_picture_need_nothing_anew(session, rendered, changed):
    assert stages_run(film_of(session, rendered, **changed)) == {GATHER}


def test_another_resolution_needs_new_voxels(session, rendered):
    assert stages_run(film_of(session, rendered, resolution="64")) == {VOXELIZE, LIGHT, GATHER}


def test_counts(session):
    scene = scenes.rich()
    counts = film_of(session, scene, samples=2).stats["counts"]
    assert (counts["triangles"], counts["lights"], counts["samples"]) == (scene.n_triangles, 4, 2)
    assert counts["voxels"] > 1000
    assert counts["gather/cones invocations"] == 2 * 64 * 48
    assert counts["device bytes"] > 0


def test_dark_scenes_gather_no_indirect_light(session, monkeypatch):
    """Nothing sends out light: the cones are told so, and the picture is black."""
    device, seen = session.opened().thread.call(lambda device: device), []
    dispatch = device.dispatch

    def spy(pass_, n, constants=None, **resources):
        if pass_.name == GATHER:
            seen.append(resources["u_has_light"])
        dispatch(pass_, n, constants, **resources)

    monkeypatch.setattr(device, "dispatch", spy)
    dark = picture_of(session, replace(scenes.cornell(), lights=()))
    assert not dark[..., :3].any()
    picture_of(session, replace(scenes.cornell(), lights=(), world=World((1, 1, 1))))
    picture_of(session, scenes.cornell())
    assert seen == [False, True, True]


@pytest.mark.parametrize("n_lights", [0, 1, 5])
def test_any_number_of_lights(session, n_lights):
    lights = tuple(scenes.lamp("POINT", (0.1 * i, -0.3, 1.7)) for i in range(n_lights))
    film = film_of(session, replace(scenes.cornell(), lights=lights))
    assert film.stats["counts"]["lights"] == n_lights
    assert (film.planes["Combined"][..., :3].max() > 0) == (n_lights > 0)


CAMERA = Camera("Camera", scenes.look((0, -4, 1)), (64, 48))


def test_an_empty_scene_shows_its_world(session):
    picture = picture_of(session, scenes.scene(camera=CAMERA, world=World((0.25, 0.5, 1.0))))
    assert np.allclose(picture, (0.25, 0.5, 1.0, 1.0))


def test_an_empty_scene_without_world_is_black_or_clear(session):
    assert np.allclose(picture_of(session, scenes.scene(camera=CAMERA)), (0, 0, 0, 1))
    assert not picture_of(session, scenes.scene(camera=CAMERA, film_transparent=True)).any()


@pytest.mark.parametrize("view", [name for name, *_ in VIEWS if name != "combined"])
def test_every_view_of_an_empty_scene(session, view):
    assert not picture_of(session, scenes.scene(camera=CAMERA), view=view)[..., :3].any()
