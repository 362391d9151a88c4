# SPDX-License-Identifier: GPL-3.0-or-later
"""As shaders/nodes/math.glsl, math_rounding.glsl and math_functions.glsl."""

from __future__ import annotations

from typing import Any

import numpy as np

from .bounded import LARGEST, bounded, divided
from .registry import twin_f4

ONE, ZERO = np.float32(1), np.float32(0)


@twin_f4
def math_add(a: Any, b: Any) -> Any:
    return bounded(a + b)


@twin_f4
def math_subtract(a: Any, b: Any) -> Any:
    return bounded(a - b)


@twin_f4
def math_multiply(a: Any, b: Any) -> Any:
    return bounded(a * b)


@twin_f4
def math_divide(a: Any, b: Any) -> Any:
    return divided(a, b)


@twin_f4
def math_multiply_add(a: Any, b: Any, c: Any) -> Any:
    return bounded(a * b + c)


@twin_f4
def math_absolute(a: Any) -> Any:
    return np.abs(a)


@twin_f4
def math_sign(a: Any) -> Any:
    return np.sign(a)


@twin_f4
def math_minimum(a: Any, b: Any) -> Any:
    return np.minimum(a, b)


@twin_f4
def math_maximum(a: Any, b: Any) -> Any:
    return np.maximum(a, b)


@twin_f4
def math_less_than(a: Any, b: Any) -> Any:
    return a < b


@twin_f4
def math_greater_than(a: Any, b: Any) -> Any:
    return a > b


@twin_f4
def math_compare(a: Any, b: Any, c: Any) -> Any:
    return a == b or np.abs(a - b) <= np.maximum(c, np.finfo("f4").eps)


@twin_f4
def math_smooth_minimum(a: Any, b: Any, k: Any) -> Any:
    h = divided(np.maximum(k - np.abs(a - b), ZERO), k)
    return bounded(np.minimum(a, b) - h * h * h * k / np.float32(6))


@twin_f4
def math_smooth_maximum(a: Any, b: Any, k: Any) -> Any:
    return -math_smooth_minimum(-a, -b, k)


@twin_f4
def math_clamped(a: Any) -> Any:
    return np.clip(a, ZERO, ONE)


@twin_f4
def math_radians(a: Any) -> Any:
    return a * np.float32(np.pi / 180)


@twin_f4
def math_degrees(a: Any) -> Any:
    return bounded(a * np.float32(180 / np.pi))


@twin_f4
def math_round(a: Any) -> Any:
    return np.floor(a + np.float32(0.5))


@twin_f4
def math_floor(a: Any) -> Any:
    return np.floor(a)


@twin_f4
def math_ceil(a: Any) -> Any:
    return np.ceil(a)


@twin_f4
def math_truncate(a: Any) -> Any:
    return np.trunc(a)


@twin_f4
def math_fraction(a: Any) -> Any:
    return a - np.floor(a)


@twin_f4
def math_modulo(a: Any, b: Any) -> Any:
    return np.where(np.equal(b, 0), ZERO, np.nan_to_num(np.fmod(a, b)))


@twin_f4
def math_floored_modulo(a: Any, b: Any) -> Any:
    return np.where(np.equal(b, 0), ZERO, bounded(a - np.floor(divided(a, b)) * b))


@twin_f4
def math_wrap(a: Any, high: Any, low: Any) -> Any:
    span = high - low
    return np.where(np.equal(span, 0), low, bounded(a - span * np.floor(divided(a - low, span))))


@twin_f4
def math_snap(a: Any, b: Any) -> Any:
    return bounded(np.floor(divided(a, b)) * b)


@twin_f4
def math_pingpong(a: Any, b: Any) -> Any:
    turns = divided(a - b, np.float32(2) * b)
    return bounded(np.abs((turns - np.floor(turns)) * b * np.float32(2) - b))


@twin_f4
def math_power(a: Any, b: Any) -> Any:
    power = bounded(np.power(np.abs(a), b))
    is_odd = (np.abs(b) < 16777216) & (np.floor(b / 2) * 2 != b)
    negative = np.where(np.floor(b) != b, ZERO, np.where(is_odd, -power, power))
    of_zero = np.where(b > 0, ZERO, LARGEST)
    return np.where(b == 0, ONE, np.where(a == 0, of_zero, np.where(a > 0, power, negative)))


@twin_f4
def math_logarithm(a: Any, base: Any) -> Any:
    return divided(np.log(a), np.log(base)) if a > 0 and base > 0 else ZERO


@twin_f4
def math_square_root(a: Any) -> Any:
    return np.sqrt(np.maximum(a, ZERO))


@twin_f4
def math_inverse_square_root(a: Any) -> Any:
    return bounded(ONE / np.sqrt(a)) if a > 0 else ZERO


@twin_f4
def math_exponent(a: Any) -> Any:
    return bounded(np.exp(np.clip(a, np.float32(-88.7), np.float32(88.7))))


@twin_f4
def math_sine(a: Any) -> Any:
    return np.sin(a)


@twin_f4
def math_cosine(a: Any) -> Any:
    return np.cos(a)


@twin_f4
def math_tangent(a: Any) -> Any:
    return bounded(np.tan(a))


@twin_f4
def math_arcsine(a: Any) -> Any:
    return np.arcsin(np.clip(a, -ONE, ONE))


@twin_f4
def math_arccosine(a: Any) -> Any:
    return np.arccos(np.clip(a, -ONE, ONE))


@twin_f4
def math_arctangent(a: Any) -> Any:
    return np.arctan(a)


@twin_f4
def math_arctangent2(y: Any, x: Any) -> Any:
    return ZERO if x == 0 and y == 0 else np.arctan2(y, x)


@twin_f4
def math_hyperbolic_sine(a: Any) -> Any:
    return bounded(np.sinh(np.clip(a, np.float32(-88.7), np.float32(88.7))))


@twin_f4
def math_hyperbolic_cosine(a: Any) -> Any:
    return bounded(np.cosh(np.clip(a, np.float32(-88.7), np.float32(88.7))))


@twin_f4
def math_hyperbolic_tangent(a: Any) -> Any:
    return np.tanh(a)


@twin_f4
def squeezed(a: Any, width: Any, center: Any) -> Any:
    return divided(ONE, ONE + math_exponent(bounded((center - a) * width)))
