# SPDX-License-Identifier: GPL-3.0-or-later
"""Sums of times and counts; the clock and the queries are the test's own."""

from __future__ import annotations

from itertools import count
from typing import Any

import pytest

from svo_engine.gpu import profiler as module
from svo_engine.gpu.profiler import Profiler


class FakeCalls(dict[str, Any]):
    """OpenGL whose queries all take 2 ms, and are counted."""

    def __init__(self) -> None:
        self.n_queries = 0
        super().__init__(dict.fromkeys(("glFinish", "glBeginQuery", "glEndQuery"), lambda *_: None))
        self["glGenQueries"], self["glGetQueryObjectui64v"] = self.make, self.answer

    def make(self, n: int, _names: Any) -> None:
        self.n_queries += n

    def answer(self, _query: int, _what: int, nanoseconds: Any) -> None:
        nanoseconds._obj.value = 2_000_000


@pytest.fixture(autouse=True)
def _one_millisecond_a_look(monkeypatch):
    ticks = count()
    monkeypatch.setattr(module.time, "perf_counter", lambda: next(ticks) * 1e-3)


@pytest.mark.parametrize(("is_software", "ms"), [(True, 1.0), (False, 2.0)])
def test_times_are_summed_by_name(is_software, ms):
    profiler = Profiler(FakeCalls(), is_software)
    for name in ("a/one", "a/two", "a/one"):
        with profiler.gpu(name):
            pass
    for _ in range(3):
        with profiler.host("upload"):
            pass
    assert profiler.times_ms() == pytest.approx({"compile": 0.0, "upload": 3.0, "a/one": 2 * ms, "a/two": ms})
    assert profiler.counts == {"programs compiled": 0, "a/one": 2, "a/two": 1}


def test_reset_starts_anew():
    profiler = Profiler(FakeCalls(), is_software=False)
    with profiler.gpu("a/one"):
        pass
    profiler.reset()
    assert (profiler.times_ms(), dict(profiler.counts)) == ({"compile": 0.0}, {"programs compiled": 0})


def test_queries_are_used_again():
    calls = FakeCalls()
    profiler = Profiler(calls, is_software=False)
    for _ in range(1000):
        with profiler.gpu("a/one"):
            pass
    assert profiler.times_ms() == pytest.approx({"compile": 0.0, "a/one": 2000.0})
    assert calls.n_queries < 300


def test_a_real_pass_takes_time_and_is_counted(device):
    device.profiler.reset()
    with device.profiler.gpu("clear"), device.scope() as scope:
        scope.framebuffer("x", scope.texture("x", (256, 256), 4, "f4")).clear()
    assert device.profiler.times_ms()["clear"] > 0
    assert device.profiler.counts["clear"] == 1
