# SPDX-License-Identifier: GPL-3.0-or-later
"""The one core Session of this process, shared by final renders, previews, viewports and comparisons."""

from __future__ import annotations

from typing import Any

from ..film import Film
from ..render import Client, Session

# Nothing is made on the GPU before its first use, nor after `close` before the next one
current = Session()

# `Film.stats` of the last final render, with its "n_samples"
last_stats: dict[str, Any] = {}

# Of "final" renders and "preview"s; a viewport has one of its own for as long as it is there
_clients: dict[tuple[str, Session], Client] = {}


def client(name: str) -> Client:
    """Who renders for that purpose: its frames drop nothing that a viewport needs."""
    key = name, current
    if key not in _clients:
        _clients[key] = current.client()
    return _clients[key]


def keep_stats(film: Film, times_ms: dict[str, float]) -> None:
    """Make the stats of `film` the last ones, with what Blender's side took."""
    last_stats.clear()
    last_stats.update(film.stats, n_samples=film.n_samples, times_ms={**film.stats["times_ms"], **times_ms})


def close() -> None:
    """Free the GPU."""
    last_stats.clear()
    _clients.clear()
    current.close()
