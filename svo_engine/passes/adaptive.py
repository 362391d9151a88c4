# SPDX-License-Identifier: GPL-3.0-or-later
"""GpuFilm -> Progress: tiles of 8 by 8 pixels get no more samples once their noise is below the threshold.

The measure is that of Cycles, so that its users' thresholds mean the same here: half of a pixel's samples against all
of them [Dammertz10b].
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

import numpy as np

from ..gpu.buffer import Buffer
from ..gpu.device import Device
from ..gpu.passes import Pass
from ..gpu.scope import GpuScope
from ..settings import RenderSettings
from .resolve import TILE, GpuFilm

MEASURE = Pass("adaptive/measure.comp.glsl")
DECIDE = Pass("adaptive/decide.comp.glsl")

EVERY = 8  # fewest samples between two looks, each of which waits for the device


@dataclass(eq=False)
class Progress:
    """Of one picture. n_running: tiles that are not done."""

    film: GpuFilm
    threshold: float
    min_samples: int
    errors: Buffer
    running: Buffer
    n_running: int

    def is_due(self, n_samples: int) -> bool:
        """Whether to look again after so many samples: at steps of an eighth to a sixteenth of them.

        Noise falls with their square root. A step is a multiple of 4, so that the halves are equal.
        """
        step = max(EVERY, 1 << max(n_samples // 8, 1).bit_length() - 1)
        return n_samples >= self.min_samples and n_samples % step == 0

    def n_saved(self, n_asked: int) -> int:
        """Samples of pixels that were not taken, of `n_asked` a pixel."""
        done = self.film.tiles.read().astype("i8")[..., 0]
        columns, rows = (np.minimum(TILE, n - TILE * np.arange(-(-n // TILE))) for n in self.film.size)
        return int(((n_asked - done) * (done > 0) * rows[:, None] * columns).sum())


def limits(settings: RenderSettings) -> tuple[float, int]:
    """The threshold and the least number of samples, where 0 leaves them to us by the rules of Cycles."""
    threshold = settings.noise_threshold or max(0.001, 1 / settings.samples)
    return threshold, settings.min_samples or max(4, ceil(16 / threshold**0.3))


def is_adaptive(settings: RenderSettings) -> bool:
    """Whether any tile could be done before the last sample."""
    return settings.adaptive_sampling and settings.view == "combined" and limits(settings)[1] < settings.samples


def make_progress(scope: GpuScope, film: GpuFilm, settings: RenderSettings) -> Progress | None:
    """The start of a picture; None unless `is_adaptive`."""
    if not is_adaptive(settings):
        return None
    n = film.tiles.size[0] * film.tiles.size[1]
    return Progress(film, *limits(settings), scope.buffer("tile errors", 4 * n), scope.buffer("running tiles", 4), n)


def is_done(device: Device, progress: Progress | None) -> bool:
    """Whether all tiles are done; looks which ones are where that is due, and then waits for the device."""
    if progress is None or not progress.is_due(progress.film.n_samples):
        return False
    _look(device, progress.film, progress)
    return progress.n_running == 0


def _look(device: Device, film: GpuFilm, progress: Progress) -> None:
    n_tiles = film.tiles.size
    n = n_tiles[0] * n_tiles[1]
    device.dispatch(MEASURE, n * TILE * TILE, **film.layers(), u_film=film.sums, u_tiles=film.tiles,
                    Errors=progress.errors, u_size=film.size, u_n_samples=float(film.n_samples))
    progress.running.write(bytes(4))
    device.dispatch(DECIDE, n, u_done=film.tiles, Errors=progress.errors, Running=progress.running,
                    u_n_tiles=n_tiles, u_n_samples=film.n_samples, u_threshold=progress.threshold)
    progress.n_running = int(np.frombuffer(progress.running.read(4), "u4")[0])
