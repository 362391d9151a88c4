# SPDX-License-Identifier: GPL-3.0-or-later
"""As shaders/nodes/bounded.glsl, for f4, numbers and arrays alike."""

from __future__ import annotations

from typing import Any

import numpy as np

from .registry import twin_f4

LARGEST = np.float32(3.4e38)


def bounded(x: Any) -> Any:
    """Overflow as the largest number, 0 for what is none."""
    return np.nan_to_num(np.clip(x, -LARGEST, LARGEST))


def divided(a: Any, b: Any) -> Any:
    """a / b, 0 where b is."""
    return np.where(np.equal(b, 0), np.float32(0), bounded(np.float32(1) * a / b))


@twin_f4
def length_of(v: Any) -> Any:
    """The length of any finite vector."""
    largest = np.abs(v).max()
    return bounded(largest * np.sqrt((divided(v, largest) ** 2).sum()))


@twin_f4
def unit_of(v: Any) -> Any:
    """The unit vector, 0 of 0."""
    scaled = divided(v, np.abs(v).max())
    return divided(scaled, np.sqrt((scaled**2).sum()))
