# SPDX-License-Identifier: GPL-3.0-or-later
"""The sky by Preetham's fit to clear days [Preetham99], as parameters that a shader puts into its formula."""

from __future__ import annotations

import numpy as np

STRENGTH = 0.06  # of luminance: what Cycles makes of kilocandelas

# Perez' five parameters of Y, x and y: by turbidity, and without it
_BY_TURBIDITY = np.array(((0.1787, -0.3554, -0.0227, 0.1206, -0.0670), (-0.0193, -0.0665, -0.0004, -0.0641, -0.0033),
                          (-0.0167, -0.0950, -0.0079, -0.0441, -0.0109)))
_ALONE = np.array(((-1.4630, 0.4275, 5.3251, -2.5771, 0.3703), (-0.2592, 0.0008, 0.2125, -0.8989, 0.0452),
                   (-0.2608, 0.0092, 0.2102, -1.6537, 0.0529)))
# x and y of the zenith: rows are powers 2, 1, 0 of turbidity, columns powers 3 to 0 of the sun's zenith angle
_ZENITH = np.array((((0.00166, -0.00375, 0.00209, 0.0), (-0.02903, 0.06377, -0.03202, 0.00394),
                     (0.11693, -0.21196, 0.06052, 0.25886)),
                    ((0.00275, -0.00610, 0.00317, 0.0), (-0.04214, 0.08970, -0.04153, 0.00516),
                     (0.15346, -0.26756, 0.06670, 0.26688))))


def preetham(sun: tuple[float, float, float], turbidity: float) -> np.ndarray:
    """(21,) f8: a unit vector to the sun, and for Y, x and y the scale and Perez' five parameters.

    sun  the node's direction; one below the horizon is taken as it is, as Cycles does
    """
    direction = np.asarray(sun) / max(np.linalg.norm(sun), 1e-8)
    angle = np.arccos(np.clip(direction[2], -1, 1))
    perez = _BY_TURBIDITY * turbidity + _ALONE
    tangent = np.tan((4 / 9 - turbidity / 120) * (np.pi - 2 * angle))
    luminance = STRENGTH * ((4.0453 * turbidity - 4.9710) * tangent - 0.2155 * turbidity + 2.4192)
    xy = _ZENITH @ angle ** np.arange(3, -1, -1) @ turbidity ** np.arange(2, -1, -1)
    scale = np.array((luminance, *xy)) / [_perez(row, 1.0, angle) for row in perez]
    return np.concatenate([direction, np.column_stack([scale, perez]).ravel()])


def _perez(p: np.ndarray, cosine: float, gamma: float) -> float:
    return (1 + p[0] * np.exp(p[1] / cosine)) * (1 + p[2] * np.exp(p[3] * gamma) + p[4] * np.cos(gamma) ** 2)
