# SPDX-License-Identifier: GPL-3.0-or-later
"""What a frame took and what it did: GPU milliseconds a pass by timer queries, host milliseconds a step, counters."""

from __future__ import annotations

import ctypes
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from .calls import Calls, delete, generate

COMPILED = "programs compiled"
_TIME_ELAPSED, _QUERY_RESULT = 0x88BF, 0x8866
_MOST = 256  # queries that are not read yet


@dataclass(eq=False)
class Sums:
    """Of one frame: GPU milliseconds a pass, host milliseconds a step, counts. Compiling is named even without any."""

    gpu_ms: defaultdict[str, float] = field(default_factory=lambda: defaultdict(float))
    host_ms: defaultdict[str, float] = field(default_factory=lambda: defaultdict(float, {"compile": 0.0}))
    counts: Counter[str] = field(default_factory=lambda: Counter({COMPILED: 0}))


class Timer:
    """`with profiler.gpu(name)`. A class, since that takes a third of what a generator does."""

    __slots__ = ("_begun", "_name", "_profiler")

    def __init__(self, profiler: Profiler, name: str) -> None:
        self._profiler, self._name = profiler, name

    def __enter__(self) -> None:
        self._begun = self._profiler.begin()

    def __exit__(self, *exception: object) -> None:
        self._profiler.end(self._name, self._begun)


class Profiler:
    """Adds to the sums of the frame that has its turn. Queries are used again, and read when the numbers are asked for.

    Mesa's software renderer runs compute in the calling thread and its queries do not see it, so there the clock on the
    wall is read, with all work finished before and after.
    """

    def __init__(self, calls: Calls, is_software: bool) -> None:
        self._calls, self.is_software = calls, is_software
        self._idle: list[int] = []
        self._pending: list[tuple[Sums, str, int]] = []
        self.sums = Sums()

    @property
    def counts(self) -> Counter[str]:
        """Of the frame that has its turn."""
        return self.sums.counts

    def gpu(self, name: str) -> Timer:
        """Times the OpenGL commands issued inside, under `name`; not nestable. Counts one `name` in `counts`."""
        self.sums.counts[name] += 1
        return Timer(self, name)

    def begin(self) -> float | int:
        """Start the clock, or a query."""
        if self.is_software:
            self._calls["glFinish"]()
            return time.perf_counter()
        if len(self._pending) > _MOST:
            self._collect()
        query = self._idle.pop() if self._idle else generate(self._calls, "Queries")
        self._calls["glBeginQuery"](_TIME_ELAPSED, query)
        return query

    def end(self, name: str, begun: float) -> None:
        """Stop what `begin` started."""
        if self.is_software:
            self._calls["glFinish"]()
            self.sums.gpu_ms[name] += (time.perf_counter() - begun) * 1e3
        else:
            self._calls["glEndQuery"](_TIME_ELAPSED)
            self._pending.append((self.sums, name, int(begun)))

    @contextmanager
    def host(self, name: str) -> Iterator[None]:
        """Time the host's work inside, under `name`."""
        start = time.perf_counter()
        try:
            yield
        finally:
            self.sums.host_ms[name] += (time.perf_counter() - start) * 1e3

    def issued(self, seconds: float) -> None:
        """Add to the host's time for telling the device what to do; a software renderer does it at once."""
        if not self.is_software:
            self.sums.host_ms["dispatch"] += seconds * 1e3

    def times_ms(self) -> dict[str, float]:
        """Milliseconds by name; GPU passes as `stage/entry`, host steps as plain words."""
        self._collect()
        return {**self.sums.host_ms, **self.sums.gpu_ms}

    def reset(self) -> Sums:
        """Start a new frame's sums and return them: the frame sets `sums` to them again after others had a turn."""
        self.sums = Sums()
        return self.sums

    def release(self) -> None:
        """Give the queries up."""
        self._collect()
        for query in self._idle:
            delete(self._calls, "Queries", query)
        self._idle.clear()

    def _collect(self) -> None:
        nanoseconds = ctypes.c_uint64()
        for sums, name, query in self._pending:
            self._calls["glGetQueryObjectui64v"](query, _QUERY_RESULT, ctypes.byref(nanoseconds))
            sums.gpu_ms[name] += nanoseconds.value / 1e6
            self._idle.append(query)
        self._pending.clear()
