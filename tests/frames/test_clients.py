# SPDX-License-Identifier: GPL-3.0-or-later
"""Clients of one session: what one renders costs another one nothing that it has."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.film import Film
from svo_engine.render import Session
from svo_engine.scene.types import Scene
from tests import scenes, variety

STAGES = ("bvh/nearest", "octree/accumulate", "cache/link", "cache/direct", "cache/bounce", "voxelize/count",
          "albedo/integrate", "light/inject")


def film(of, scene: Scene, size: tuple[int, int] = variety.SIZE, **settings) -> Film:
    settings = {"method": "rays", "cache_resolution": "32", "cache_rays": 2, "adaptive_sampling": False, **settings}
    return list(of.films(scene, scenes.view(scene, size=size), replace(scenes.SMALL, **settings)))[-1]


def made(of: Film) -> set[str]:
    """The stages that were made anew."""
    return {name for name in STAGES if of.stats["counts"].get(name)}


def other_room() -> Scene:
    """Nothing in common with the first one's."""
    return scenes.cornell(variety.bulb(0.5), things=(scenes.Thing(scenes.sphere("Ball", 0.2, 5), variety.METAL),))


@pytest.fixture
def clients(session):
    """Two of one session, which has nothing of its own."""
    session.forget()
    both = session.client(), session.client()
    yield both
    for client in both:
        client.close()


def test_clients_with_other_scenes_do_not_evict_each_other(clients):
    one, other = clients
    assert made(film(one, variety.alcove(variety.METAL)))
    assert made(film(other, other_room()))
    assert made(film(one, variety.alcove(variety.METAL))) == set()
    assert made(film(other, other_room())) == set()


def test_one_client_has_the_last_scene_alone(clients):
    one, _ = clients
    film(one, variety.alcove())
    film(one, other_room())
    assert {"bvh/nearest", "octree/accumulate", "cache/link"} <= made(film(one, variety.alcove()))


def test_a_second_client_has_what_the_first_one_made(clients):
    one, other = clients
    first = film(one, variety.alcove(variety.METAL))
    second = film(other, variety.alcove(variety.METAL))
    assert made(second) == set()
    assert np.array_equal(first.planes["Combined"], second.planes["Combined"])


def test_methods_of_two_clients_do_not_evict_each_other(clients):
    one, other = clients
    film(one, variety.alcove())
    film(other, variety.alcove(), method="cones")
    assert made(film(one, variety.alcove())) == set()
    assert made(film(other, variety.alcove(), method="cones")) == set()


@pytest.mark.parametrize("leave", [lambda client: client.close(), lambda client: client.forget()])
def test_a_client_that_leaves_takes_nothing_from_the_other(clients, leave):
    one, other = clients
    film(one, variety.alcove())
    film(other, variety.alcove())
    leave(one)
    assert made(film(other, variety.alcove())) == set()


def test_a_closed_client_may_render_again(clients):
    one, _ = clients
    first = film(one, variety.alcove()).planes["Combined"]
    one.close()
    one.close()
    assert np.array_equal(film(one, variety.alcove()).planes["Combined"], first)


def test_clients_that_leave_hold_nothing(session):
    def held() -> int:
        return session.opened().thread.call(lambda device: device.n_bytes)

    session.forget()
    before, client = held(), session.client()
    film(client, variety.alcove(variety.GLASS))
    assert held() > before
    client.close()
    assert held() == before


def test_a_client_outlives_its_session_being_closed_and_used_again():
    session = Session()
    client = session.client()
    first = film(client, variety.alcove()).planes["Combined"]
    session.close()
    assert np.array_equal(film(client, variety.alcove()).planes["Combined"], first)
    session.close()
