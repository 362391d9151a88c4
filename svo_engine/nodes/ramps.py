# SPDX-License-Identifier: GPL-3.0-or-later
"""Colour ramps and curves as tables, sampled where Cycles samples them.

A ramp is the "color_ramp" of scene/graph.py, curves are its "mapping" and "mapping.samples".
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .twins.color import hsl_of_rgb, hsv_of_rgb, rgb_of_hsl, rgb_of_hsv

SIZE = 257  # entries of a table, as in Cycles and shaders/nodes/ramp.glsl

_MODELS = {"HSV": (hsv_of_rgb, rgb_of_hsv), "HSL": (hsl_of_rgb, rgb_of_hsl)}

# Weights of four stops at t between the middle two: rows times (t^3, t^2, t, 1)
_SPLINES = {
    "CARDINAL": np.array([[-0.71, 1.42, -0.71, 0], [1.29, -2.29, 0, 1], [-1.29, 1.58, 0.71, 0], [0.71, -0.71, 0, 0]]),
    "B_SPLINE": np.array([[-1, 3, -3, 1], [3, -6, 0, 4], [-3, 3, 3, 1], [1, 0, 0, 0]]) / 6}


def ramp_values(ramp: Any, x: np.ndarray) -> np.ndarray:
    """The ramp's colours at x, (n, 4) f4: linear RGBA. Stops stay in their order, whatever their positions are."""
    mode, interpolation, hue, stops = ramp
    rows = np.array(stops, "f4").reshape(-1, 5)
    at, colors = rows[:, 0], rows[:, 1:]
    if len(rows) < 2:
        return np.tile(colors if len(rows) else np.zeros((1, 4), "f4"), (len(x), 1))
    beyond = at[None, :] > x[:, None]
    after = np.where(beyond.any(1), beyond.argmax(1), len(at))  # the first stop beyond x
    if mode == "RGB" and interpolation in _SPLINES:
        return _splined(at, colors, x, after, _SPLINES[interpolation])
    right = after.clip(1, len(at) - 1)
    t = _between(x, at[right - 1], at[right])
    if mode == "RGB" and interpolation == "CONSTANT":
        t = np.zeros_like(t)
    elif mode == "RGB" and interpolation == "EASE":
        t = t * t * (3 - 2 * t)
    first, second = colors[right - 1], colors[right]
    mixed = (1 - t) * first + t * second
    if mode in _MODELS:
        pairs = zip(t[:, 0], first[:, :3], second[:, :3], strict=True)
        mixed[:, :3] = [_mixed_hue(mode, hue, *pair) for pair in pairs]
    ended = np.where((after == len(at))[:, None], colors[-1], mixed)
    return np.where((x <= at[0])[:, None], colors[0], ended).astype("f4")


def _between(x: np.ndarray, left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """(n, 1): how far x is from left to right; all the way if they are at one place."""
    span = right - left
    return np.where(span != 0, (x - left) / np.where(span != 0, span, 1), 1)[:, None]


def _splined(at: np.ndarray, colors: np.ndarray, x: np.ndarray, after: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Along a spline that begins at 0 and ends at 1 with the colours of the outer stops."""
    ends, last = np.concatenate([[0], at, [1]]).astype("f4"), len(at) - 1
    t = _between(x, ends[after], ends[after + 1])[:, 0].clip(0, 1)
    rows = np.stack([t**3, t**2, t, np.ones_like(t)], 1) @ weights.T
    four = [colors[(after + k).clip(0, last)] for k in (-2, -1, 0, 1)]
    return sum(rows[:, k, None] * four[k] for k in range(4)).clip(0, 1).astype("f4")


def _mixed_hue(mode: str, way: str, t: float, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Between two colours by hue, saturation and value or lightness."""
    into, back = _MODELS[mode]
    with np.errstate(all="ignore"):
        (h1, s1, v1), (h2, s2, v2) = into(a), into(b)
        first, second = _around(way, h1 % 1, h2 % 1)
        hue = ((1 - t) * first + t * second) % 1
        return back(np.array([hue, (1 - t) * s1 + t * s2, (1 - t) * v1 + t * v2], "f4"))


def _around(way: str, first: float, second: float) -> tuple[float, float]:
    """Two hues in [0, 1), one of them a turn farther if the way between them leads through 0."""
    if first == second:
        return first, second + (way == "FAR")
    passes = abs(first - second) > 0.5 if way == "NEAR" else abs(first - second) < 0.5 and way == "FAR"
    if first < second:
        return first + (passes or way == "CCW"), second
    return first, second + (passes or way == "CW")


def ramp_table(ramp: Any) -> np.ndarray:
    """(4 * SIZE) f4: colours, and then alphas."""
    values = ramp_values(ramp, np.arange(SIZE, dtype="f4") / np.float32(SIZE - 1))
    return np.concatenate([values[:, :3].ravel(), values[:, 3]])


def is_stepped(ramp: Any) -> bool:
    """Whether the entries of the ramp's table stand for themselves alone."""
    return ramp[1] == "CONSTANT"


def ramp_at(ramp: Any, x: float) -> np.ndarray:
    """(4,) f4: what the ramp's table gives at x."""
    table = ramp_table(ramp)
    at = np.clip(np.float32(x), 0, 1) * np.float32(SIZE - 1)
    values = np.concatenate([table[:3 * SIZE].reshape(SIZE, 3), table[3 * SIZE:, None]], 1)
    first = int(at)
    t = np.float32(0) if is_stepped(ramp) else at - np.float32(first)
    return (1 - t) * values[first] + t * values[min(first + 1, SIZE - 1)]


class Curves:
    """The curves of a node."""

    def __init__(self, mapping: Any, samples: Any) -> None:
        extend, _, _, _, points = mapping
        self._goes_on = extend == "EXTRAPOLATED"
        self._first, self._last = min(p[0][0] for p in points), max(p[-1][0] for p in points)
        plain = self._first + np.arange(SIZE) / (SIZE - 1) * (self._last - self._first)
        curves = samples or ((),) * min(len(points), 3)
        self._values = np.array([values if len(values) == SIZE else plain for values in curves], "f4")

    def table(self) -> np.ndarray:
        """(3 + n_curves * SIZE) f4: the first x, the span of x, whether it goes on outside, and the curves' values."""
        head = [self._first, self._last - self._first, self._goes_on]
        return np.concatenate([head, self._values.ravel()]).astype("f4")

    def at(self, factor: float, values: np.ndarray) -> np.ndarray:
        """What the table makes of a value for each curve. Outside, a single curve is level: Cycles folds it so."""
        goes_on = self._goes_on and len(self._values) > 1
        span = self._last - self._first
        x = (values - self._first) / span if span else np.zeros_like(values)
        inside = np.clip(x, 0, 1) * (SIZE - 1)
        low = np.minimum(inside.astype(int), SIZE - 2)
        curves = np.arange(len(self._values))
        a, b = self._values[curves, low], self._values[curves, low + 1]
        bent = a + (inside - low) * (b - a) + goes_on * (x - np.clip(x, 0, 1)) * (SIZE - 1) * (b - a)
        return (1 - factor) * values + factor * bent
