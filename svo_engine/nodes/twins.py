# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions of shaders/nodes once more in Python, for constants: a chain of constants costs no shader."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

TWINS: dict[str, Callable[..., Any]] = {}


def twin(function: Callable[..., Any]) -> Callable[..., Any]:
    """Let `function` stand for the function of its name: numbers as floats, vectors as tuples, in and out."""
    TWINS[function.__name__] = function
    return function


def number_type(n: int) -> str:
    """The type of GLSL of n numbers."""
    return "float" if n == 1 else f"vec{n}"


@twin
def number_of_color(c: tuple[float, ...]) -> float:
    """As shaders/nodes/convert.glsl."""
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]


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
