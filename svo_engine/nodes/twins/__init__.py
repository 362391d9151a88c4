# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions of shaders/nodes once more in Python, for constants: a chain of constants costs no shader."""

from . import color, convert, math, mix, ranges, vector
from .registry import TWINS, number_type, twin, twin_f4

__all__ = ["TWINS", "color", "convert", "math", "mix", "number_type", "ranges", "twin", "twin_f4", "vector"]
