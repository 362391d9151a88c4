# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a direction lies in an equirectangular image, as Blender's Environment Texture node has it."""

from __future__ import annotations

import numpy as np


def direction_to_uv(direction: np.ndarray) -> np.ndarray:
    """Image coordinates (..., 2) of directions (..., 3), of any length but 0: u to the right, v upwards, both 0 to 1.

    u = 1/2 - azimuth / (2 pi): the middle column looks along +X, a quarter to the left of it +Y, the edges meet at -X.
    v = 1/2 + elevation / pi: the lowest row looks down, the highest one up.
    """
    x, y, z = np.moveaxis(np.asarray(direction), -1, 0)
    return np.stack([0.5 - np.arctan2(y, x) / (2 * np.pi), 0.5 + np.arctan2(z, np.hypot(x, y)) / np.pi], -1)
