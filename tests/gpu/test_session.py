# SPDX-License-Identifier: GPL-3.0-or-later
"""Sessions: no leak, no quarrel, closing and using again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine import render
from svo_engine.errors import Cancelled, GpuError
from svo_engine.gpu.compiler import Compiler
from svo_engine.render import Session
from svo_engine.scene.types import Scene
from tests import scenes


def held(session) -> tuple[int, int]:
    """Bytes and scopes that the session's device holds."""
    return session.opened().thread.call(lambda device: (device.n_bytes, len(device.scopes)))


def picture(session, scene, **settings) -> np.ndarray:
    return list(session.films(scene, scenes.view(scene), replace(scenes.SMALL, **settings)))[-1].planes["Combined"]


def room(number: int) -> Scene:
    """Another number moves the lamp, darkens the walls and shrinks the block by a hair: nothing of the last one serves,
    and all takes as many bytes.
    """
    scene = scenes.cornell(scenes.lamp("POINT", (0.02 * number, -0.3, 1.7), emitted=5.0))
    (*meshes, block), (white, *materials) = scene.meshes, scene.materials
    block = replace(block, positions=block.positions * np.float32(1 - 1e-6 * number))
    return replace(scene, meshes=(*meshes, block), materials=(
        replace(white, base_color=(0.8 - 0.01 * number,) * 3), *materials))


def test_twenty_renders_of_changing_scenes_hold_what_the_first_held(session):
    session.forget()
    picture(session, room(0))
    first = held(session)
    for i in range(1, 21):
        picture(session, room(i))
    assert held(session) == first


def test_films_say_what_was_compiled_for_them(session):
    first = next(session.films(room(30), scenes.view(room(30)), scenes.SMALL))
    again = next(session.films(room(31), scenes.view(room(31)), scenes.SMALL))
    assert first.stats["counts"]["programs compiled"] >= 0 <= first.stats["times_ms"]["compile"]
    assert (again.stats["counts"]["programs compiled"], again.stats["times_ms"]["compile"]) == (0, 0.0)


def test_a_session_says_that_it_compiles_and_then_nothing(monkeypatch):
    """Here nothing is done before its caller has looked."""
    made, told, is_done = Session(), set[str](), Compiler.is_done
    monkeypatch.setattr(Compiler, "is_done", lambda *its: any(told) and is_done(*its))
    assert made.status == ""
    first = list(made.films(room(0), scenes.view(room(0)), scenes.SMALL, lambda: told.add(made.status) is not None))
    assert any(status.startswith("Compiling shaders, 1 of ") for status in told)
    assert first[0].stats["counts"]["programs compiled"] > 0 < first[0].stats["times_ms"]["compile"]
    assert made.status == ""
    made.close()


def test_every_view_releases_its_own(session):
    session.forget()
    for view in ("combined", "voxel_albedo", "voxel_normal", "voxel_radiance", "voxel_coverage", "combined"):
        picture(session, room(0), view=view)
    first = held(session)
    for number, view in enumerate(("voxel_albedo", "voxel_normal", "combined"), 1):
        picture(session, room(number), view=view)
    assert held(session) == first


def test_cancelling_at_any_moment_leaks_nothing(session):
    scene = scenes.cornell()
    session.forget()
    picture(session, scene, resolution="64")
    first = held(session)
    for patience in range(8):
        session.forget()
        asked = iter([False] * patience)
        films = session.films(scene, scenes.view(scene), replace(scenes.SMALL, resolution="64", samples=50),
                              lambda asked=asked: next(asked, True))
        with pytest.raises(Cancelled):
            list(films)
    picture(session, scene, resolution="64")
    assert held(session) == first


def test_a_scene_too_large_for_the_device_is_an_error_and_leaks_nothing(session):
    thread = session.opened().thread
    session.forget()
    picture(session, scenes.cornell())
    first = held(session)
    limits = thread.call(lambda device: device.limits)
    small = {**limits, "GL_MAX_SHADER_STORAGE_BLOCK_SIZE": 40_000}
    thread.call(lambda device: setattr(device, "limits", small))
    session.forget()
    with pytest.raises(GpuError, match="needs"):
        picture(session, scenes.cornell())
    thread.call(lambda device: setattr(device, "limits", limits))
    session.forget()  # a picture's parts are as large as fits, and no device changes its limits
    picture(session, scenes.cornell())
    assert held(session) == first


def test_frames_that_take_turns_give_what_each_gives_alone(session):
    """Two viewports: other scenes, other sizes, one of them edited while the other is half done."""
    settings = replace(scenes.SMALL, samples=4)
    rooms = [room(number) for number in (0, 20, 40)]
    views = [scenes.view(rooms[0]), scenes.view(rooms[1], size=(40, 40)), scenes.view(rooms[2])]
    alone = [list(session.films(room, view, settings))[-1] for room, view in zip(rooms, views, strict=True)]
    first = held(session)
    running = [session.films(room, view, settings) for room, view in zip(rooms[:2], views[:2], strict=True)]
    for films in running:
        next(films)
    third = list(session.films(rooms[2], views[2], settings))[-1]
    last = [list(films)[-1] for films in running] + [third]
    for one, other in zip(alone, last, strict=True):
        assert np.array_equal(one.planes["Combined"], other.planes["Combined"])
    list(session.films(rooms[2], views[2], settings))
    assert held(session) == first


def test_two_sessions_at_once_and_one_used_again_after_closing(session):
    scene = scenes.cornell()
    other = Session()
    first = picture(other, scene)
    assert np.array_equal(first, picture(session, scene))
    other.close()
    other.close()
    assert np.array_equal(first, picture(other, scene))
    other.close()


def test_closing_while_a_frame_is_half_done_cancels_it():
    session = Session()
    scene = scenes.cornell()
    films = session.films(scene, scenes.view(scene), replace(scenes.SMALL, samples=4))
    next(films)
    session.close()
    with pytest.raises(Cancelled):
        next(films)


@pytest.mark.parametrize(("samples", "time_limit", "n_last"), [(3, 0.0, 3), (10_000, 1e-9, 1)])
def test_the_last_film_always_comes(session, samples, time_limit, n_last):
    """An interval drops films, but never the best one, also when time is up."""
    scene = scenes.cornell()
    settings = replace(scenes.SMALL, samples=samples, time_limit=time_limit)
    numbers = [film.n_samples for film in session.films(scene, scenes.view(scene), settings, interval=1e9)]
    assert numbers[-1] == n_last
    assert len(numbers) <= 2  # the first and the last


def test_films_come_one_a_sample_and_get_better(session):
    scene = scenes.cornell()
    settings = replace(scenes.SMALL, samples=3)
    assert [film.n_samples for film in session.films(scene, scenes.view(scene), settings)] == [1, 2, 3]


def test_stats_say_what_it_took(session):
    scene = scenes.cornell()
    film = next(session.films(scene, scenes.view(scene), scenes.SMALL))
    assert film.stats["device"] == session.device_info()["renderer"]
    assert film.stats["resolution"] == 32
    assert film.stats["counts"]["triangles"] == scene.n_triangles == 22
    assert film.stats["counts"]["lights"] == 1
    assert all(ms >= 0 for ms in film.stats["times_ms"].values())
    assert film.stats["times_ms"]["gather/cones"] > 0


def test_an_error_inside_a_frame_reaches_the_caller_and_the_next_frame_works(session, monkeypatch):
    scene = scenes.cornell()
    picture(session, scene)
    first = held(session)

    def fail(*_):
        raise GpuError("lost")

    with monkeypatch.context() as patch:
        patch.setattr(render, "_read", fail)
        with pytest.raises(GpuError, match="lost"):
            picture(session, scene)
    assert picture(session, scene).shape == (48, 64, 4)
    assert held(session) == first
