# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scene's records make sure of when they are made."""

from __future__ import annotations

import numpy as np

from ..errors import SceneError


def check(owner: str, name: str, array: np.ndarray, dtype: str, shape: tuple[int | None, ...]) -> None:
    """Raise SceneError unless `array` has `dtype` and `shape` (None: any length) and holds finite numbers only."""
    matches = array.ndim == len(shape) and all(w is None or w == s for w, s in zip(shape, array.shape, strict=True))
    if array.dtype != np.dtype(dtype) or not matches:
        wanted = "x".join("n" if s is None else str(s) for s in shape)
        raise SceneError(f"{owner}: {name} must be {wanted} of {dtype}, not {array.shape} of {array.dtype}")
    if array.dtype.kind == "f" and not np.isfinite(array).all():
        raise SceneError(f"{owner}: {name} holds a number that is not finite")
