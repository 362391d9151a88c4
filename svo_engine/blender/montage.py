# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures side by side under labels of large pixels: Blender 4.2 cannot write text into an image."""

from __future__ import annotations

import numpy as np

_GAP = 4  # pixels between two pictures
_BACKGROUND, _INK = 0.12, 0.9  # sRGB-encoded grey

# Five rows from the top; each octal digit is a row of three pixels
_GLYPHS = {"0": 0o75557, "1": 0o26227, "2": 0o71747, "3": 0o71717, "4": 0o55711, "5": 0o74717, "6": 0o74757,
           "7": 0o71111, "8": 0o75757, "9": 0o75717, ".": 0o00002, "A": 0o25755, "C": 0o74447, "E": 0o74647,
           "F": 0o74644, "I": 0o72227, "L": 0o44447, "M": 0o57755, "N": 0o65555, "O": 0o75557, "R": 0o65655,
           "S": 0o74717, "V": 0o55552, "Y": 0o55222}


def side_by_side(columns: dict[str, np.ndarray]) -> np.ndarray:
    """Label -> picture (h, w, 3), sRGB-encoded 0 to 1, all of one size; row 0 at the bottom. Returns (h', w', 3) f4.

    Labels are of capitals, digits, points and spaces; what is longer than its picture is wide is cut off.
    """
    height, width = next(iter(columns.values())).shape[:2]
    scale = max(1, width // 160)
    canvas = np.full((height + 7 * scale, len(columns) * (width + _GAP) - _GAP, 3), _BACKGROUND, "f4")
    for i, (label, picture) in enumerate(columns.items()):
        column = canvas[:, i * (width + _GAP) :][:, :width]
        column[:height] = picture
        ink = _ink(label, scale)[:, : width - scale]
        column[height + scale :, scale:][: ink.shape[0], : ink.shape[1]][ink] = _INK
    return canvas


def _ink(label: str, scale: int) -> np.ndarray:
    """Where the letters are: (5 scale, 4 scale len(label)) bool, row 0 at the bottom."""
    rows = [[_GLYPHS.get(letter, 0) << 1 >> (3 * row + column) & (column > 0) for letter in label
             for column in (3, 2, 1, 0)] for row in range(5)]
    return np.array(rows, bool).repeat(scale, 0).repeat(scale, 1)
