# SPDX-License-Identifier: GPL-3.0-or-later
"""As shaders/nodes/map_range.glsl and map_range_vector.glsl."""

from __future__ import annotations

from typing import Any

import numpy as np

from .bounded import bounded, divided
from .registry import twin_f4

ONE, ZERO = np.float32(1), np.float32(0)


def _mapped(factor: Any, to_first: Any, to_last: Any) -> Any:
    return bounded(to_first + factor * (to_last - to_first))


def _linear(x: Any, first: Any, last: Any) -> Any:
    return divided(x - first, last - first)


def _stepped(x: Any, first: Any, last: Any, steps: Any) -> Any:
    stepped = divided(np.floor(bounded(_linear(x, first, last) * (steps + ONE))), steps)
    return np.where(steps > 0, stepped, ZERO)


def _smooth(x: Any, first: Any, last: Any) -> Any:
    t = np.clip(_linear(x, first, last), ZERO, ONE)
    return (np.float32(3) - np.float32(2) * t) * t * t


def _smoother(x: Any, first: Any, last: Any) -> Any:
    t = np.clip(_linear(x, first, last), ZERO, ONE)
    return t * t * t * (t * (t * np.float32(6) - np.float32(15)) + np.float32(10))


@twin_f4
def map_linear(x: Any, first: Any, last: Any, to_first: Any, to_last: Any) -> Any:
    return _mapped(_linear(x, first, last), to_first, to_last) if first != last else ZERO


@twin_f4
def map_stepped(x: Any, first: Any, last: Any, to_first: Any, to_last: Any, steps: Any) -> Any:
    return _mapped(_stepped(x, first, last, steps), to_first, to_last) if first != last else ZERO


@twin_f4
def map_smooth(x: Any, first: Any, last: Any, to_first: Any, to_last: Any) -> Any:
    return _mapped(_smooth(x, first, last), to_first, to_last) if first != last else ZERO


@twin_f4
def map_smoother(x: Any, first: Any, last: Any, to_first: Any, to_last: Any) -> Any:
    return _mapped(_smoother(x, first, last), to_first, to_last) if first != last else ZERO


@twin_f4
def clamp_between(x: Any, low: Any, high: Any) -> Any:
    return np.minimum(np.maximum(x, low), high)


@twin_f4
def clamp_in_range(x: Any, a: Any, b: Any) -> Any:
    return np.minimum(np.maximum(x, np.minimum(a, b)), np.maximum(a, b))


@twin_f4
def map_vector_linear(v: Any, first: Any, last: Any, to_first: Any, to_last: Any) -> Any:
    return _mapped(_linear(v, first, last), to_first, to_last)


@twin_f4
def map_vector_stepped(v: Any, first: Any, last: Any, to_first: Any, to_last: Any, steps: Any) -> Any:
    return _mapped(_stepped(v, first, last, steps), to_first, to_last)


@twin_f4
def map_vector_smooth(v: Any, first: Any, last: Any, to_first: Any, to_last: Any) -> Any:
    return _mapped(_smooth(v, first, last), to_first, to_last)


@twin_f4
def map_vector_smoother(v: Any, first: Any, last: Any, to_first: Any, to_last: Any) -> Any:
    return _mapped(_smoother(v, first, last), to_first, to_last)


@twin_f4
def clamp_vector_in_range(v: Any, a: Any, b: Any) -> Any:
    return np.minimum(np.maximum(v, np.minimum(a, b)), np.maximum(a, b))
