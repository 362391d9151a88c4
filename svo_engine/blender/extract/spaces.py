# SPDX-License-Identifier: GPL-3.0-or-later
"""Colour spaces of images by their names in Blender's configuration, to linear light of Rec. 709."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

ENCODED, LINEAR = ("sRGB",), ("Linear Rec.709", "scene_linear", "Working Space")

# Chromaticities (x, y) of red, green, blue and white, as their standards have them
_D65, _E = (0.3127, 0.3290), (1 / 3, 1 / 3)
_ACES_WHITE = (0.32168, 0.33767)
_REC709 = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06), _D65)
_REC2020 = ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046), _D65)
_P3 = ((0.680, 0.320), (0.265, 0.690), (0.150, 0.060), _D65)
_AP0 = ((0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.0770), _ACES_WHITE)
_AP1 = ((0.713, 0.293), (0.165, 0.830), (0.128, 0.044), _ACES_WHITE)
_E_GAMUT = ((0.8, 0.3177), (0.18, 0.9), (0.065, -0.0805), _D65)
_XYZ = ((1.0, 0.0), (0.0, 1.0), (0.0, 0.0))

_BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])

Curve = Callable[[np.ndarray], np.ndarray]


def _same(encoded: np.ndarray) -> np.ndarray:
    return encoded


def srgb_decoded(encoded: np.ndarray) -> np.ndarray:
    """Linear light of sRGB-encoded values."""
    return np.where(encoded <= 0.04045, encoded / 12.92, ((np.maximum(encoded, 0) + 0.055) / 1.055) ** 2.4)


def _power24(encoded: np.ndarray) -> np.ndarray:
    return np.maximum(encoded, 0) ** 2.4


_SPACES: dict[str, tuple[tuple[tuple[float, float], ...], Curve]] = {
    "Linear Rec.2020": (_REC2020, _same), "Linear DCI-P3 D65": (_P3, _same), "ACEScg": (_AP1, _same),
    "ACES2065-1": (_AP0, _same), "Linear FilmLight E-Gamut": (_E_GAMUT, _same),
    "Linear CIE-XYZ D65": ((*_XYZ, _D65), _same), "Linear CIE-XYZ E": ((*_XYZ, _E), _same),
    "Display P3": (_P3, srgb_decoded), "Rec.1886": (_REC709, _power24), "Rec.2020": (_REC2020, _power24)}


def linear_of(colors: np.ndarray, space: str) -> np.ndarray | None:
    """`colors` (..., 3) in the named space, in linear light of Rec. 709; None for a space that is not known here."""
    if space not in _SPACES:
        return None
    primaries, decoded = _SPACES[space]
    matrix = np.linalg.inv(_xyz_from(_REC709)) @ _xyz_from(primaries)
    return (decoded(colors) @ matrix.T).astype("f4")


def _xyz_from(primaries: tuple[tuple[float, float], ...]) -> np.ndarray:
    """(3, 3) f8: to CIE XYZ of white D65, from light of these primaries and white."""
    *colors, white = (np.array((x, y, 1 - x - y)) for x, y in primaries)
    columns, white = np.array(colors).T, white / white[1]
    if primaries[:3] != _XYZ:  # of XYZ itself white is told for adaptation alone
        columns = columns * np.linalg.solve(columns, white)
    wanted = np.array((_D65[0], _D65[1], 1 - sum(_D65))) / _D65[1]
    scale = (_BRADFORD @ wanted) / (_BRADFORD @ white)
    return np.linalg.inv(_BRADFORD) @ (scale[:, None] * _BRADFORD) @ columns
