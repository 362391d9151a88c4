# SPDX-License-Identifier: GPL-3.0-or-later
"""As shaders/nodes/mix.glsl and mix_models.glsl."""

from __future__ import annotations

from typing import Any

import numpy as np

from .bounded import bounded, divided
from .color import hsv_of_rgb, rgb_of_hsv
from .registry import twin_f4

ONE, TWO, ZERO = np.float32(1), np.float32(2), np.float32(0)


@twin_f4
def mix_number(t: Any, a: Any, b: Any) -> Any:
    return bounded(a * (ONE - t) + b * t)


@twin_f4
def mix_vector(t: Any, a: Any, b: Any) -> Any:
    return bounded(a * (ONE - t) + b * t)


@twin_f4
def mix_vector_by_parts(t: Any, a: Any, b: Any) -> Any:
    return bounded(a * (ONE - t) + b * t)


@twin_f4
def factors_clamped(t: Any) -> Any:
    return np.clip(t, ZERO, ONE)


@twin_f4
def color_clamped(c: Any) -> Any:
    return np.clip(c, ZERO, ONE)


@twin_f4
def mix_blend(t: Any, a: Any, b: Any) -> Any:
    return bounded(a + t * (b - a))


@twin_f4
def mix_add(t: Any, a: Any, b: Any) -> Any:
    return bounded(a + t * b)


@twin_f4
def mix_subtract(t: Any, a: Any, b: Any) -> Any:
    return bounded(a - t * b)


@twin_f4
def mix_multiply(t: Any, a: Any, b: Any) -> Any:
    return bounded(a * (ONE - t + t * b))


@twin_f4
def mix_divide(t: Any, a: Any, b: Any) -> Any:
    return np.where(np.equal(b, 0), a, bounded((ONE - t) * a + t * divided(a, b)))


@twin_f4
def mix_screen(t: Any, a: Any, b: Any) -> Any:
    return bounded(ONE - (ONE - t + t * (ONE - b)) * (ONE - a))


@twin_f4
def mix_difference(t: Any, a: Any, b: Any) -> Any:
    return mix_blend(t, a, np.abs(a - b))


@twin_f4
def mix_exclusion(t: Any, a: Any, b: Any) -> Any:
    return np.maximum(mix_blend(t, a, bounded(a + b - TWO * a * b)), ZERO)


@twin_f4
def mix_darken(t: Any, a: Any, b: Any) -> Any:
    return mix_blend(t, a, np.minimum(a, b))


@twin_f4
def mix_lighten(t: Any, a: Any, b: Any) -> Any:
    return mix_blend(t, a, np.maximum(a, b))


@twin_f4
def mix_overlay(t: Any, a: Any, b: Any) -> Any:
    dark = a * (ONE - t + TWO * t * b)
    bright = ONE - (ONE - t + TWO * t * (ONE - b)) * (ONE - a)
    return bounded(np.where(a < np.float32(0.5), dark, bright))


@twin_f4
def mix_soft_light(t: Any, a: Any, b: Any) -> Any:
    screen = ONE - (ONE - b) * (ONE - a)
    return bounded((ONE - t) * a + t * ((ONE - a) * b * a + a * screen))


@twin_f4
def mix_linear_light(t: Any, a: Any, b: Any) -> Any:
    return bounded(a + t * (TWO * b - ONE))


@twin_f4
def mix_dodge(t: Any, a: Any, b: Any) -> Any:
    rest = ONE - t * b
    return np.where(a == 0, ZERO, np.where(rest <= 0, ONE, np.minimum(divided(a, rest), ONE)))


@twin_f4
def mix_burn(t: Any, a: Any, b: Any) -> Any:
    rest = ONE - t + t * b
    return np.where(rest <= 0, ZERO, np.clip(ONE - divided(ONE - a, rest), ZERO, ONE))


@twin_f4
def mix_hue(t: Any, a: Any, b: Any) -> Any:
    other, own = hsv_of_rgb(b), hsv_of_rgb(a)
    return a if other[1] == 0 else mix_blend(t, a, rgb_of_hsv(np.array([other[0], own[1], own[2]])))


@twin_f4
def mix_saturation(t: Any, a: Any, b: Any) -> Any:
    own = hsv_of_rgb(a)
    return a if own[1] == 0 else rgb_of_hsv(np.array([own[0], mix_number(t, own[1], hsv_of_rgb(b)[1]), own[2]]))


@twin_f4
def mix_value(t: Any, a: Any, b: Any) -> Any:
    own = hsv_of_rgb(a)
    return rgb_of_hsv(np.array([own[0], own[1], mix_number(t, own[2], hsv_of_rgb(b)[2])]))


@twin_f4
def mix_color(t: Any, a: Any, b: Any) -> Any:
    other = hsv_of_rgb(b)
    return a if other[1] == 0 else mix_blend(t, a, rgb_of_hsv(np.array([other[0], other[1], hsv_of_rgb(a)[2]])))
