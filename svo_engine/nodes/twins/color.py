# SPDX-License-Identifier: GPL-3.0-or-later
"""As shaders/nodes/color_models.glsl and color.glsl."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import math
from .bounded import bounded, divided
from .registry import twin_f4

ONE, TWO, SIX, ZERO, HALF = np.float32(1), np.float32(2), np.float32(6), np.float32(0), np.float32(0.5)


@twin_f4
def hsv_of_rgb(c: Any) -> Any:
    high = c.max()
    span = bounded(high - c.min())
    saturation = divided(span, high)
    if saturation == 0:
        return np.array([ZERO, ZERO, high])
    d = divided(high - c, span)
    sixths = d[2] - d[1] if c[0] == high else TWO + d[0] - d[2] if c[1] == high else np.float32(4) + d[1] - d[0]
    return np.array([sixths / SIX + (ONE if sixths < 0 else ZERO), saturation, high])


@twin_f4
def rgb_of_hsv(hsv: Any) -> Any:
    h, s, v = hsv
    sixths = ZERO if h == 1 else bounded(h * SIX)
    f = sixths - np.floor(sixths)
    p, falling, rising = (bounded(v * (ONE - x)) for x in (s, s * f, s * (ONE - f)))
    sides = [(v, rising, p), (falling, v, p), (p, v, rising), (p, falling, v), (rising, p, v)]
    side = int(np.floor(sixths))
    return np.array([v, v, v] if s == 0 else sides[side] if 0 <= side < 5 else (v, p, falling))


@twin_f4
def hsl_of_rgb(c: Any) -> Any:
    high, low = c.max(), c.min()
    span, lightness = bounded(high - low), np.minimum(ONE, bounded((high + low) * HALF))
    if span == 0:
        return np.array([ZERO, ZERO, lightness])
    saturation = divided(span, bounded(TWO - high - low) if lightness > HALF else bounded(high + low))
    if c[0] == high:
        sixths = divided(c[1] - c[2], span) + (SIX if c[1] < c[2] else ZERO)
    else:
        sixths = divided(c[2] - c[0], span) + TWO if c[1] == high else divided(c[0] - c[1], span) + np.float32(4)
    return np.array([sixths / SIX, saturation, lightness])


@twin_f4
def rgb_of_hsl(hsl: Any) -> Any:
    h, s, lightness = hsl
    sixths = bounded(h * SIX)
    tint = np.array([np.abs(sixths - np.float32(3)) - ONE, TWO - np.abs(sixths - TWO),
                     TWO - np.abs(sixths - np.float32(4))])
    chroma = bounded((ONE - np.abs(TWO * lightness - ONE)) * s)
    return bounded((np.clip(tint, ZERO, ONE) - HALF) * chroma + lightness)


@twin_f4
def luminance_of(c: Any) -> Any:
    return bounded((c * np.array([0.2126391, 0.7151691, 0.0721928], "f4")).sum())


@twin_f4
def bright_contrast(c: Any, brightness: Any, contrast: Any) -> Any:
    return np.maximum(bounded(c * (ONE + contrast) + (brightness - HALF * contrast)), ZERO)


@twin_f4
def color_to_power(c: Any, gamma: Any) -> Any:
    return np.ones(3, "f4") if gamma == 0 else np.where(c > 0, math.math_power(c, gamma), c)


@twin_f4
def hue_saturation_value(hue: Any, saturation: Any, value: Any, factor: Any, c: Any) -> Any:
    h, s, v = hsv_of_rgb(c)
    turned = h + hue + HALF
    hsv = np.array([turned - np.floor(turned), np.clip(s * saturation, ZERO, ONE), bounded(v * value)])
    return np.maximum(bounded(factor * rgb_of_hsv(hsv) + (ONE - factor) * c), ZERO)


@twin_f4
def inverted(factor: Any, c: Any) -> Any:
    return bounded(factor * (ONE - c) + (ONE - factor) * c)
