# SPDX-License-Identifier: GPL-3.0-or-later
"""As shaders/nodes/convert.glsl."""

from __future__ import annotations

from .registry import twin


@twin
def number_of_color(c: tuple[float, ...]) -> float:
    """As shaders/nodes/convert.glsl."""
    return 0.2126391 * c[0] + 0.7151691 * c[1] + 0.0721928 * c[2]


@twin
def number_of_vector(v: tuple[float, ...]) -> float:
    """As shaders/nodes/convert.glsl."""
    return (v[0] + v[1] + v[2]) / 3.0


@twin
def splat(x: float) -> tuple[float, ...]:
    """As shaders/nodes/convert.glsl."""
    return x, x, x


@twin
def share_of_first(x: float) -> float:
    """As shaders/nodes/convert.glsl."""
    return 1.0 - min(max(x, 0.0), 1.0)


@twin
def share_of_second(x: float) -> float:
    """As shaders/nodes/convert.glsl."""
    return min(max(x, 0.0), 1.0)


@twin
def product_of_weights(a: float, b: float) -> float:
    """As shaders/nodes/convert.glsl."""
    return a * b


@twin
def sum_of_weights(a: float, b: float) -> float:
    """As shaders/nodes/convert.glsl."""
    return a + b
