# SPDX-License-Identifier: GPL-3.0-or-later
"""Photometric files by IESNA's LM-63: what a lamp sends into each direction. Read as Cycles reads them."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

# What Blender's watts make of candelas: 4 pi / 177.83, the efficacy of daylight D65 [lm W^-1]
WATTS = 0.0706650768394
TYPE_C, TYPE_B = 1, 2


@dataclass(frozen=True, eq=False)
class Photometry:
    """across, down  (n,), (m,) f8, ascending, radians: around the lamp, 0 to 2 pi, and from straight down
    strength      (n, m) f8
    """

    across: np.ndarray
    down: np.ndarray
    strength: np.ndarray


def read_ies(text: str) -> Photometry | None:
    """What the text of a file says; None if it is none that Cycles reads."""
    try:
        return _read(text)
    except (ValueError, IndexError):
        return None


def _read(text: str) -> Photometry | None:
    begin = text.index("\nTILT=")
    line, _, rest = text[begin + 1:].partition("\n")
    numbers = [float(word) for word in re.split(r"[\s,]+", rest.strip()) if word]
    if line.startswith("TILT=INCLUDE"):
        numbers = numbers[2 + 2 * int(numbers[1]):]
    n_down, n_across, kind = int(numbers[3]), int(numbers[4]), int(numbers[5])
    factor = numbers[2] * numbers[10] * numbers[11] * WATTS
    body = np.array(numbers[13:])
    down, across = body[:n_down], body[n_down:n_down + n_across]
    strength = body[n_down + n_across:n_down + n_across + n_down * n_across].reshape(n_across, n_down) * factor
    if not (n_down and n_across):
        return None
    if kind == TYPE_B:
        return _of_type_b(down, across, strength)
    return _of_type_c(across, down, strength) if kind == TYPE_C else None


def _of_type_b(across: np.ndarray, down: np.ndarray, strength: np.ndarray) -> Photometry | None:
    """Angles about another axis, from -90 or 0 to 90 degrees both; what is missing mirrors what is there."""
    strength = strength.T
    if across[-1] != 90 or down[-1] != 90:
        return None
    if across[0] == 0:
        across, strength = np.concatenate([-across[:0:-1], across]), np.concatenate([strength[:0:-1], strength])
    if down[0] == 0:
        strength = np.concatenate([strength[:, -2::-1], strength], 1)  # not quite a mirror image, but Cycles' own
        down = np.concatenate([-down[:0:-1], down])
    across = across + 90
    return _in_radians(np.append(across, 360.0), down + 90, np.concatenate([strength, strength[:1]]))


def _of_type_c(across: np.ndarray, down: np.ndarray, strength: np.ndarray) -> Photometry | None:
    """A quarter or a half turn is mirrored, one plane is taken all around."""
    if across[0] == 90:
        across = across - 90
    if across[0] != 0 or not (down[0] == 0 or (down[0] == 90 and down[-1] == 180)):
        return None
    if len(across) == 1:
        across, strength = np.append(across, 360.0), np.concatenate([strength, strength])
    for end in (90.0, 180.0):
        if across[-1] == end:
            across = np.concatenate([across, 2 * end - across[-2::-1]])
            strength = np.concatenate([strength, strength[-2::-1]])
    if across[-1] != 360:
        if 360 - across[-1] not in (across[-1] - across[-2], across[1] - across[0]):
            return None
        across, strength = np.append(across, 360.0), np.concatenate([strength, strength[:1]])
    return _in_radians(across, down, strength)


def _in_radians(across: np.ndarray, down: np.ndarray, strength: np.ndarray) -> Photometry:
    return Photometry(np.radians(across), np.radians(down), strength)
