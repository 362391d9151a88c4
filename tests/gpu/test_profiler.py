# SPDX-License-Identifier: GPL-3.0-or-later
"""Sums of times and counts; the clock and the queries are the test's own."""

from __future__ import annotations

from itertools import count
from typing import Any

import pytest

from svo_engine.gpu import profiler as module
from svo_engine.gpu.profiler import Profiler


class FakeQuery:
    """A timer query that took 2 ms."""

    elapsed = 2_000_000

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass


class FakeContext:
    """A context that counts its queries."""

    def __init__(self, renderer: str) -> None:
        self.info = {"GL_RENDERER": renderer}
        self.n_queries = 0

    def finish(self) -> None:
        pass

    def query(self, time: bool) -> FakeQuery:
        assert time
        self.n_queries += 1
        return FakeQuery()


def profiler_of(context: Any) -> Profiler:
    return Profiler(context)


@pytest.fixture(autouse=True)
def _one_millisecond_a_look(monkeypatch):
    ticks = count()
    monkeypatch.setattr(module.time, "perf_counter", lambda: next(ticks) * 1e-3)


@pytest.mark.parametrize(("renderer", "ms"), [("llvmpipe (LLVM)", 1.0), ("A graphics card", 2.0)])
def test_times_are_summed_by_name(renderer, ms):
    profiler = profiler_of(FakeContext(renderer))
    for name in ("a/one", "a/two", "a/one"):
        with profiler.gpu(name):
            pass
    for _ in range(3):
        with profiler.host("upload"):
            pass
    assert profiler.times_ms() == pytest.approx({"upload": 3.0, "a/one": 2 * ms, "a/two": ms})
    assert profiler.counts == {"a/one": 2, "a/two": 1}


def test_reset_starts_anew():
    profiler = profiler_of(FakeContext("A graphics card"))
    with profiler.gpu("a/one"):
        pass
    profiler.reset()
    assert (profiler.times_ms(), dict(profiler.counts)) == ({}, {})


def test_queries_are_used_again():
    context = FakeContext("A graphics card")
    profiler = profiler_of(context)
    for _ in range(1000):
        with profiler.gpu("a/one"):
            pass
    assert profiler.times_ms() == pytest.approx({"a/one": 2000.0})
    assert context.n_queries < 300


def test_a_real_pass_takes_time_and_is_counted(device):
    device.profiler.reset()
    with device.profiler.gpu("clear"), device.scope() as scope:
        device.clear(scope.framebuffer("x", [scope.texture("x", (256, 256), 4, "f4")], with_depth=True))
    assert device.profiler.times_ms()["clear"] > 0
    assert device.profiler.counts["clear"] == 1
