# SPDX-License-Identifier: GPL-3.0-or-later
"""A device that is too small for what was asked: the light cache falls, a sentence says so, the picture is made."""

from __future__ import annotations

import pytest

from svo_engine.errors import GpuError
from tests import scenes
from tests.on_gpu import film_of

LIMIT = "GL_MAX_SHADER_STORAGE_BLOCK_SIZE"
SETTINGS = {"method": "rays", "samples": 1, "cache_rays": 1, "bounces": 1, "cache_resolution": "64"}


def limited(session, monkeypatch, n_bytes):
    device = session.opened().thread.call(lambda device: device)
    monkeypatch.setattr(device, "limits", {**device.limits, LIMIT: n_bytes})


def test_the_cache_falls_to_what_fits(session, monkeypatch):
    whole = film_of(session, scenes.cornell(), **SETTINGS)
    assert whole.stats["limits"] == []
    largest = 64 * 2 * whole.stats["counts"]["surfels"]  # four vec4 for each of two sides
    limited(session, monkeypatch, largest - 1)
    session.forget()
    film = film_of(session, scenes.cornell(), **SETTINGS)
    assert len(film.stats["limits"]) == 1
    assert film.stats["limits"][0].startswith("The light cache has 32 voxels a side instead of 64: ")
    assert LIMIT in film.stats["limits"][0]
    assert 0 < film.stats["counts"]["surfels"] < whole.stats["counts"]["surfels"]
    assert film.planes["Combined"][..., :3].max() > 0


def test_no_room_at_all_is_an_error(session, monkeypatch):
    limited(session, monkeypatch, 20_000)
    session.forget()
    with pytest.raises(GpuError, match=LIMIT):
        film_of(session, scenes.cornell(), **SETTINGS)
