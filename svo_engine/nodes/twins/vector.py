# SPDX-License-Identifier: GPL-3.0-or-later
"""As shaders/nodes/vector_math.glsl, vector_geometry.glsl, vector_functions.glsl, parts.glsl and rotation.glsl."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import math
from .bounded import bounded, divided, length_of, unit_of
from .registry import twin_f4

ONE, TWO, ZERO = np.float32(1), np.float32(2), np.float32(0)


@twin_f4
def vector_add(a: Any, b: Any) -> Any:
    return bounded(a + b)


@twin_f4
def vector_subtract(a: Any, b: Any) -> Any:
    return bounded(a - b)


@twin_f4
def vector_multiply(a: Any, b: Any) -> Any:
    return bounded(a * b)


@twin_f4
def vector_divide(a: Any, b: Any) -> Any:
    return divided(a, b)


@twin_f4
def vector_multiply_add(a: Any, b: Any, c: Any) -> Any:
    return bounded(a * b + c)


@twin_f4
def vector_scale(a: Any, scale: Any) -> Any:
    return bounded(a * scale)


@twin_f4
def vector_absolute(a: Any) -> Any:
    return np.abs(a)


@twin_f4
def vector_sign(a: Any) -> Any:
    return np.sign(a)


@twin_f4
def vector_minimum(a: Any, b: Any) -> Any:
    return np.minimum(a, b)


@twin_f4
def vector_maximum(a: Any, b: Any) -> Any:
    return np.maximum(a, b)


@twin_f4
def vector_floor(a: Any) -> Any:
    return np.floor(a)


@twin_f4
def vector_ceil(a: Any) -> Any:
    return np.ceil(a)


@twin_f4
def vector_fraction(a: Any) -> Any:
    return a - np.floor(a)


@twin_f4
def vector_snap(a: Any, b: Any) -> Any:
    return math.math_snap(a, b)


@twin_f4
def vector_modulo(a: Any, b: Any) -> Any:
    return math.math_modulo(a, b)


@twin_f4
def vector_wrap(a: Any, high: Any, low: Any) -> Any:
    return math.math_wrap(a, high, low)


@twin_f4
def vector_power(a: Any, b: Any) -> Any:
    return math.math_power(a, b)


@twin_f4
def vector_sine(a: Any) -> Any:
    return np.sin(a)


@twin_f4
def vector_cosine(a: Any) -> Any:
    return np.cos(a)


@twin_f4
def vector_tangent(a: Any) -> Any:
    return math.math_tangent(a)


@twin_f4
def vector_dot(a: Any, b: Any) -> Any:
    return bounded((a * b).sum())


@twin_f4
def vector_cross(a: Any, b: Any) -> Any:
    return bounded(np.cross(a, b))


@twin_f4
def vector_length(a: Any) -> Any:
    return length_of(a)


@twin_f4
def vector_distance(a: Any, b: Any) -> Any:
    return length_of(bounded(a - b))


@twin_f4
def vector_normalize(a: Any) -> Any:
    return unit_of(a)


@twin_f4
def vector_project(a: Any, b: Any) -> Any:
    along = unit_of(b)
    return bounded((a * along).sum() * along)


@twin_f4
def vector_reflect(a: Any, normal: Any) -> Any:
    n = unit_of(normal)
    return bounded(a - TWO * (a * n).sum() * n)


@twin_f4
def vector_refract(a: Any, normal: Any, eta: Any) -> Any:
    n = unit_of(normal)
    cosine = (a * n).sum()
    k = ONE - eta * eta * (ONE - cosine * cosine)
    return np.zeros(3, "f4") if k < 0 else bounded(eta * a - (eta * cosine + np.sqrt(k)) * n)


@twin_f4
def vector_faceforward(a: Any, incident: Any, reference: Any) -> Any:
    return a if bounded((reference * incident).sum()) < 0 else -a


@twin_f4
def cosine_between(a: Any, b: Any) -> Any:
    return (unit_of(a) * unit_of(b)).sum()


@twin_f4
def combined(x: Any, y: Any, z: Any) -> Any:
    return np.array([x, y, z])


@twin_f4
def first_of(v: Any) -> Any:
    return v[0]


@twin_f4
def second_of(v: Any) -> Any:
    return v[1]


@twin_f4
def third_of(v: Any) -> Any:
    return v[2]


def _euler(r: Any) -> Any:
    """The rotation about x, then y, then z by the angles r: (3, 3), rows."""
    (sx, sy, sz), (cx, cy, cz) = np.sin(r), np.cos(r)
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


@twin_f4
def euler_x(r: Any) -> Any:
    return _euler(r)[:, 0]


@twin_f4
def euler_y(r: Any) -> Any:
    return _euler(r)[:, 1]


@twin_f4
def euler_z(r: Any) -> Any:
    return _euler(r)[:, 2]


@twin_f4
def rotated_by_angle(v: Any, center: Any, axis: Any, angle: Any) -> Any:
    about, start = unit_of(axis), v - center
    s, c = np.sin(angle), np.cos(angle)
    turned = c * start + s * np.cross(about, start) + (ONE - c) * (about * start).sum() * about
    return bounded(turned + center) if about.any() else v


@twin_f4
def rotated_by_columns(v: Any, center: Any, x: Any, y: Any, z: Any) -> Any:
    return bounded(np.stack([x, y, z], 1) @ (v - center) + center)


@twin_f4
def rotated_back_by_columns(v: Any, center: Any, x: Any, y: Any, z: Any) -> Any:
    return bounded(np.stack([x, y, z]) @ (v - center) + center)


@twin_f4
def mapping_point(v: Any, location: Any, scale: Any, x: Any, y: Any, z: Any) -> Any:
    return bounded(np.stack([x, y, z], 1) @ bounded(v * scale) + location)


@twin_f4
def mapping_texture(v: Any, location: Any, scale: Any, x: Any, y: Any, z: Any) -> Any:
    return divided(bounded(np.stack([x, y, z]) @ (v - location)), scale)


@twin_f4
def mapping_vector(v: Any, scale: Any, x: Any, y: Any, z: Any) -> Any:
    return bounded(np.stack([x, y, z], 1) @ bounded(v * scale))


@twin_f4
def mapping_normal(v: Any, scale: Any, x: Any, y: Any, z: Any) -> Any:
    return unit_of(bounded(np.stack([x, y, z], 1) @ unit_of(divided(v, scale))))
