# SPDX-License-Identifier: GPL-3.0-or-later
"""Buffers and pictures that were given back, for whoever asks for the same next: frames do so again and again, and a
driver takes milliseconds to find new memory.
"""

from __future__ import annotations

from collections import OrderedDict, defaultdict
from itertools import count
from typing import Any

LIMIT = 2**29  # bytes kept; the oldest go first


class Pool:
    """Idle OpenGL objects by `key`, which says all that they were made by."""

    def __init__(self, limit: int = LIMIT) -> None:
        self.limit = limit
        self.n_bytes = 0
        self._ages = count()
        self._idle: OrderedDict[int, tuple[Any, int, Any]] = OrderedDict()
        self._by_key: defaultdict[Any, list[int]] = defaultdict(list)

    def give(self, key: Any, n_bytes: int, made: Any) -> None:
        """Keep `made`, of n_bytes, or release it if it is larger than all that may be kept."""
        if n_bytes > self.limit:
            made.release()
            return
        age = next(self._ages)
        self._idle[age] = key, n_bytes, made
        self._by_key[key].append(age)
        self.n_bytes += n_bytes
        while self.n_bytes > self.limit:
            self._take(next(iter(self._idle))).release()

    def take(self, key: Any) -> Any | None:
        """The object that was given last under `key`, holding whatever it held, or None."""
        ages = self._by_key.get(key)
        return self._take(ages[-1]) if ages else None

    def clear(self) -> None:
        """Release everything."""
        while self._idle:
            self._take(next(iter(self._idle))).release()

    def _take(self, age: int) -> Any:
        key, n_bytes, made = self._idle.pop(age)
        self._by_key[key].remove(age)
        if not self._by_key[key]:
            del self._by_key[key]
        self.n_bytes -= n_bytes
        return made
