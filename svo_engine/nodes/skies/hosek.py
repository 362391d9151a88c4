# SPDX-License-Identifier: GPL-3.0-or-later
"""The sky by Hosek and Wilkie [Hosek12], as a table of all directions.

hosek.npz has the parameters of their formula, fitted to skies that Cycles shows: for turbidities 1 to 10, grounds of
albedo 0, 1/2 and 1, suns at 12 heights and each of CIE XYZ nine numbers, which give those skies to 1e-5 or better.
Between them the skies themselves are interpolated: linearly by turbidity, where parameters and a scale are linear; by
parabolas of the albedo; and by cubics of the root of the sun's height.
"""

from __future__ import annotations

from functools import cache, lru_cache
from pathlib import Path

import numpy as np

LOWEST = np.pi / 2 - 0.001  # zenith angle from which the sky goes on unchanged


@lru_cache(maxsize=8)
def hosek(elevation: float, turbidity: float, albedo: float, rows: tuple[float, ...],
          azimuths: tuple[float, ...]) -> np.ndarray:
    """CIE XYZ (n_rows, n_azimuths, 3) f4, radians: rows above the horizon, azimuths from the sun's."""
    zenith, azimuth = np.pi / 2 - np.array(rows)[:, None], np.array(azimuths)
    sun = min(max(elevation, 0.0), np.pi / 2)
    cosine = np.clip(np.cos(zenith) * np.sin(elevation) + np.sin(zenith) * np.cos(elevation) * np.cos(azimuth), -1, 1)
    up = np.broadcast_to(np.cos(np.minimum(zenith, LOWEST)), cosine.shape)
    total = np.zeros((*cosine.shape, 3))
    for i, share in _between(min(max(turbidity, 1.0), 10.0) - 1, 10, 2):
        for k, part in _between(min(max(albedo, 0.0), 1.0) * 2, 3, 3):
            for j, weight in _between(float(np.cbrt(sun / (np.pi / 2))) * 11, 12, 4):
                total += share * part * weight * _sky(_parameters()[i, k, j], up, cosine)
    return np.maximum(total, 0.0).astype("f4")


def _sky(parameters: np.ndarray, up: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """Parameters (3, 9): XYZ where `up` is the cosine of the zenith angle and `cosine` that of the angle to the sun."""
    gamma, up, cosine = np.arccos(cosine)[..., None], up[..., None], cosine[..., None]
    a, b, c, d, e, f, g, h, i = parameters.T.astype("f8")
    halo = (1 + cosine**2) / np.maximum(1 + h * h - 2 * h * cosine, 1e-9) ** 1.5
    return (1 + a * np.exp(b / (up + 0.01))) * (c + d * np.exp(e * gamma) + f * cosine**2 + g * halo + i * np.sqrt(up))


@cache
def _parameters() -> np.ndarray:
    """(10, 3, 12, 3, 9) f4."""
    with np.load(Path(__file__).with_suffix(".npz")) as file:
        parameters: np.ndarray = file["parameters"]
    return parameters


def _between(x: float, n: int, of: int) -> list[tuple[int, float]]:
    """Lagrange's weights at x of the nearest `of` of n points."""
    first = min(max(int(x) - (of // 2 - 1), 0), n - of)
    points = range(first, first + of)
    return [(i, float(np.prod([(x - j) / (i - j) for j in points if j != i]))) for i in points]
