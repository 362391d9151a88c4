# SPDX-License-Identifier: GPL-3.0-or-later
"""What a frame took and what it did: GPU milliseconds a pass by timer queries, host milliseconds a step, counters."""

from __future__ import annotations

import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import moderngl


@dataclass(eq=False)
class Sums:
    """Of one frame: GPU milliseconds a pass, host milliseconds a step, counts."""

    gpu_ms: defaultdict[str, float] = field(default_factory=lambda: defaultdict(float))
    host_ms: defaultdict[str, float] = field(default_factory=lambda: defaultdict(float))
    counts: Counter[str] = field(default_factory=Counter)


class Profiler:
    """Adds to the sums of the frame that has its turn. Queries are used again, and read when the numbers are asked for.

    Mesa's software renderer runs compute in the calling thread and its queries do not see it, so there the clock on the
    wall is read, with all work finished before and after.
    """

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self.is_software = "llvmpipe" in str(ctx.info["GL_RENDERER"])
        self._idle: list[Any] = []
        self._pending: list[tuple[Sums, str, Any]] = []
        self.sums = Sums()

    @property
    def counts(self) -> Counter[str]:
        """Of the frame that has its turn."""
        return self.sums.counts

    @contextmanager
    def gpu(self, name: str) -> Iterator[None]:
        """Time the OpenGL commands issued inside, under `name`; not nestable. Counts one `name` in `counts`."""
        sums = self.sums
        sums.counts[name] += 1
        if self.is_software:
            self._ctx.finish()
            start = time.perf_counter()
            yield
            self._ctx.finish()
            sums.gpu_ms[name] += (time.perf_counter() - start) * 1e3
            return
        if len(self._pending) > 256:
            self._collect()
        query = self._idle.pop() if self._idle else self._ctx.query(time=True)
        with query:
            yield
        self._pending.append((sums, name, query))

    @contextmanager
    def host(self, name: str) -> Iterator[None]:
        """Time the host's work inside, under `name`."""
        start = time.perf_counter()
        yield
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
        self._idle.clear()

    def _collect(self) -> None:
        for sums, name, query in self._pending:
            sums.gpu_ms[name] += query.elapsed / 1e6
            self._idle.append(query)
        self._pending.clear()
