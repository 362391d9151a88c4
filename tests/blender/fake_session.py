# SPDX-License-Identifier: GPL-3.0-or-later
"""A stand-in for the core's Session that paints where a pixel lies: tests of the host need no GPU."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from svo_engine.errors import Cancelled
from svo_engine.film import Film
from svo_engine.scene.types import Scene, View
from svo_engine.settings import RenderSettings


def gradient(width: int, height: int, n_samples: int = 1, alpha: float = 1.0) -> np.ndarray:
    """(height, width, 4) f4: R and G grow from 0 to 1 with x and y, B tells the sample; premultiplied."""
    y, x = np.mgrid[0:height, 0:width]
    planes = [(x + 0.5) / width, (y + 0.5) / height, np.full(x.shape, float(n_samples)), np.ones(x.shape)]
    return (np.stack(planes, 2) * alpha).astype("f4")


class FakeSession:
    """Notes each call in `calls` as (scene, view, settings); `error`: raised after `n_before_error` films.

    Its clients, viewports and final renders, all paint here.
    """

    status = ""

    def __init__(self) -> None:
        self.calls: list[tuple[Scene, View, RenderSettings]] = []
        self.error: Exception | None = None
        self.n_before_error = 0
        self.is_closed = False

    def films(self, scene, view, settings, should_stop=lambda: False, interval=0.0, is_draft=False):  # noqa: ARG002
        self.calls.append((scene, view, settings))
        alpha = 0.5 if scene.film_transparent else 1.0
        for n in range(1, settings.samples + 1):
            if self.error is not None and n > self.n_before_error:
                raise self.error
            if should_stop():
                raise Cancelled("Cancelled")
            stats = {"device": "none", "times_ms": {"paint": 0.0}, "counts": {"interval": interval}}
            width, height = view.size
            yield Film({"Combined": gradient(width, height, n, alpha)}, n, stats)

    def client(self):
        return SimpleNamespace(films=self.films, close=lambda: None)

    def compile_all(self):
        """There is nothing to compile."""

    def close(self):
        self.is_closed = True
