# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions of shaders/nodes once more in Python, for constants: a chain of constants costs no shader."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np

TWINS: dict[str, Callable[..., Any]] = {}


def twin(function: Callable[..., Any]) -> Callable[..., Any]:
    """Let `function` stand for the function of its name: numbers as floats, vectors as tuples, in and out."""
    TWINS[function.__name__] = function
    return function


def number_type(n: int) -> str:
    """The type of GLSL of n numbers."""
    return "float" if n == 1 else f"vec{n}"


def twin_f4(function: Callable[..., Any]) -> Callable[..., Any]:
    """As `twin`, for a function of numpy's f4: numbers are scalars, vectors arrays. It returns either."""

    @wraps(function)
    def of_numbers(*arguments: Any) -> Any:
        with np.errstate(all="ignore"):
            made = function(*(np.asarray(a, "f4") if isinstance(a, tuple) else np.float32(a) for a in arguments))
        made = np.asarray(made, "f4")
        return tuple(made.tolist()) if made.ndim else float(made)

    twin(of_numbers)
    return function
