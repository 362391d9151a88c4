# SPDX-License-Identifier: GPL-3.0-or-later
"""Idle OpenGL objects: given to whoever asks for the same, bounded, released at the end."""

from __future__ import annotations

import numpy as np
import pytest

from svo_engine.errors import GpuError
from svo_engine.gpu.pool import Pool

OUT_OF_MEMORY = 0x0505


class Thing:
    """Something that can be released once."""

    is_released = False

    def release(self) -> None:
        assert not self.is_released
        self.is_released = True


def test_what_was_given_is_taken_once_and_only_by_its_key():
    pool, thing = Pool(), Thing()
    pool.give(("buffer", 16), 16, thing)
    assert pool.take(("buffer", 32)) is None
    assert pool.take(("buffer", 16)) is thing
    assert pool.take(("buffer", 16)) is None
    assert (pool.n_bytes, thing.is_released) == (0, False)


def test_the_oldest_go_when_there_is_too_much():
    pool, things = Pool(limit=100), [Thing() for _ in range(4)]
    for i, thing in enumerate(things):
        pool.give(i % 2, 40, thing)
    assert [thing.is_released for thing in things] == [True, True, False, False]
    assert pool.n_bytes == 80
    pool.clear()
    assert pool.n_bytes == 0 and all(thing.is_released for thing in things)


def test_what_is_larger_than_all_that_may_be_kept_is_not_kept():
    pool, small, large = Pool(limit=100), Thing(), Thing()
    pool.give("small", 50, small)
    pool.give("large", 101, large)
    assert (small.is_released, large.is_released) == (False, True)


def test_a_closed_scope_hands_its_buffers_to_the_next_one(device):
    with device.scope() as scope:
        first = scope.buffer("a", 12345)
    with device.scope() as scope:
        assert scope.buffer("b", 12345) is first
        assert scope.buffer("c", 12345) is not first
        assert scope.n_bytes == 2 * 12345


def test_cleared_means_cleared_however_often_it_was_used(device):
    for _ in range(2):
        with device.scope() as scope:
            buffer, layers = scope.buffer("a", 4444, clear=True), scope.layers("b", (5, 3), 2)
            assert buffer.read() == bytes(4444) and not layers.read().any()
            buffer.write(b"\1" * 4444)
            layers.write(np.ones((2, 3, 5, 4), "f4"))


def test_without_memory_the_idle_go_first(device, monkeypatch):
    """The device fails while anything is idle, then succeeds; and fails for good with a sentence."""
    with device.scope() as scope:
        scope.buffer("idle", 7777)
    real = device.calls["glGetError"]
    monkeypatch.setitem(device.calls, "glGetError", lambda: OUT_OF_MEMORY if device.pool.n_bytes else real())
    with device.scope() as scope:
        assert scope.buffer("wanted", 6543).size == 6543
        monkeypatch.setitem(device.calls, "glGetError", lambda: OUT_OF_MEMORY)
        with pytest.raises(GpuError, match=r"'more' of 0\.0 MiB: out of memory"):
            scope.buffer("more", 4321)
