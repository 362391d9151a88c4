# SPDX-License-Identifier: GPL-3.0-or-later
"""The world's image as a light of which directions are drawn: where it is bright, often."""

from __future__ import annotations

import numpy as np

from ...scene.types import Image, World
from ..upload.sky import linear_pixels

LARGEST = 4096, 2048  # texels of the table: 32 MiB
EVEN = 0.25  # of the squared mean: a variance of radiance below which rays do as well without draws


def sky_table(image: Image | None, world: World) -> np.ndarray | None:
    """Cumulative probabilities (height, width + 1) f4: in column 0 of the rows, in the others of a row's texels.

    Proportional to the radiance that bilinear interpolation makes of each texel, times its solid angle. None where
    there is nothing to choose: no image, a black or an even one, or a mapping that has no inverse.
    """
    if image is None or abs(np.linalg.det(world.env_from_world)) < 1e-12:
        return None
    weights = np.array(world.radiance, "f4") / 3
    light = _reduced(np.maximum(linear_pixels(image)[..., :3] @ weights, 0))
    light = _interpolated(light.astype("f8"))
    latitude = np.pi * ((np.arange(len(light)) + 0.5) / len(light) - 0.5)
    share = np.broadcast_to(np.cos(latitude)[:, None], light.shape)
    mean = np.average(light, weights=share)
    if mean <= 0.0 or np.average(light**2, weights=share) / mean**2 - 1.0 < EVEN:
        return None
    rows = np.cumsum((light * share).sum(1))
    columns = np.cumsum(light, 1)
    columns /= np.where(columns[:, -1:] > 0, columns[:, -1:], 1.0)
    return np.concatenate([(rows / rows[-1])[:, None], columns], 1).astype("f4")


def _reduced(light: np.ndarray) -> np.ndarray:
    """Means (h', w') of blocks, so that there are not too many."""
    while light.shape[1] > LARGEST[0] or light.shape[0] > LARGEST[1]:
        for axis, most in enumerate(reversed(LARGEST)):
            if light.shape[axis] > most:
                even = light.shape[axis] // 2 * 2
                a, b = (np.take(light, range(k, even, 2), axis) for k in (0, 1))
                light = (a + b) / 2
    return light


def _interpolated(light: np.ndarray) -> np.ndarray:
    """Means (h, w) over texels of what bilinear interpolation makes of them; columns go round, rows end at poles."""
    sides = np.roll(light, 1, 1) + np.roll(light, -1, 1)
    light = (6 * light + sides) / 8
    return (6 * light + np.vstack([light[:1], light[:-1]]) + np.vstack([light[1:], light[-1:]])) / 8
