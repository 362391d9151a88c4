# SPDX-License-Identifier: GPL-3.0-or-later
"""What a frame took and what it did: GPU milliseconds a pass by timer queries, host milliseconds a step, counters."""

from __future__ import annotations

import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import moderngl


class Profiler:
    """Sums until `reset()`. Queries are kept and used again; they are read only when the numbers are asked for.

    Mesa's software renderer runs compute in the calling thread and its queries do not see it, so there the clock on the
    wall is read, with all work finished before and after.
    """

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._is_software = "llvmpipe" in str(ctx.info["GL_RENDERER"])
        self._idle: list[Any] = []
        self._pending: list[tuple[str, Any]] = []
        self._gpu_ms: defaultdict[str, float] = defaultdict(float)
        self._host_ms: defaultdict[str, float] = defaultdict(float)
        self.counts: Counter[str] = Counter()

    @contextmanager
    def gpu(self, name: str) -> Iterator[None]:
        """Time the OpenGL commands issued inside, under `name`; not nestable. Counts one `name` in `counts`."""
        self.counts[name] += 1
        if self._is_software:
            self._ctx.finish()
            start = time.perf_counter()
            yield
            self._ctx.finish()
            self._gpu_ms[name] += (time.perf_counter() - start) * 1e3
            return
        if len(self._pending) > 256:
            self._collect()
        query = self._idle.pop() if self._idle else self._ctx.query(time=True)
        with query:
            yield
        self._pending.append((name, query))

    @contextmanager
    def host(self, name: str) -> Iterator[None]:
        """Time the host's work inside, under `name`."""
        start = time.perf_counter()
        yield
        self._host_ms[name] += (time.perf_counter() - start) * 1e3

    def times_ms(self) -> dict[str, float]:
        """Milliseconds by name since `reset()`; GPU passes as `stage/entry`, host steps as plain words."""
        self._collect()
        return {**self._host_ms, **self._gpu_ms}

    def reset(self) -> None:
        """Start a new frame's sums."""
        self._collect()
        for sums in (self._gpu_ms, self._host_ms, self.counts):
            sums.clear()

    def release(self) -> None:
        """Give the queries up."""
        self._collect()
        self._idle.clear()

    def _collect(self) -> None:
        for name, query in self._pending:
            self._gpu_ms[name] += query.elapsed / 1e6
            self._idle.append(query)
        self._pending.clear()
