# SPDX-License-Identifier: GPL-3.0-or-later
"""Where in a pixel a sample lies: Blackman and Harris's window, as in Cycles, so that edges look alike [Harris78].

Positions are drawn from the filter itself, so every sample has the same weight.
"""

from __future__ import annotations

from functools import cache

import numpy as np

_TERMS = (0.35875, -0.48829, 0.14128, -0.01168)

# Irrational steps, golden ratio and root of 3: as even as Halton's sequence, whatever the number of samples.
_STEPS = np.array([0.6180339887498949, 0.7320508075688772])


def blackman_harris(x: np.ndarray) -> np.ndarray:
    """The window at x in [-1/2, 1/2], 1 in the middle."""
    phase = 2 * np.pi * (np.asarray(x) + 0.5)
    return sum(term * np.cos(k * phase) for k, term in enumerate(_TERMS))


@cache
def _inverse_cdf() -> tuple[np.ndarray, np.ndarray]:
    x = np.linspace(-0.5, 0.5, 4097)
    mass = np.concatenate([[0.0], np.cumsum(blackman_harris((x[1:] + x[:-1]) / 2))])
    return mass / mass[-1], x


def jitter(sample: int, seed: int, width: float) -> tuple[float, float]:
    """Offset (x, y) in pixels from the pixel's centre of sample number `sample`.

    width  as in Cycles: the window reaches that far to either side, so that it is twice as wide in all

    The first sample of seed 0 lies in the centre.
    """
    start = np.random.default_rng(seed).random(2) if seed else np.array([0.5, 0.5])
    u = (start + sample * _STEPS) % 1.0
    x, y = np.interp(u, *_inverse_cdf()) * (2 * width)
    return float(x), float(y)
