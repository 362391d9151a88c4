# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes that put colours and vectors together from numbers, and take them apart."""

from __future__ import annotations

from ..expr import Expr, as_vector
from ..reader import Reader
from . import Outputs, kind


@kind("ShaderNodeCombineXYZ")
def combine_xyz(n: Reader) -> Outputs:
    """A vector of three numbers."""
    return {"Vector": as_vector(_combined(n, "X", "Y", "Z"))}


@kind("ShaderNodeSeparateXYZ")
def separate_xyz(n: Reader) -> Outputs:
    """The parts of a vector."""
    return _parts(n, n.vector("Vector"), "X", "Y", "Z")


@kind("ShaderNodeCombineColor")
def combine_color(n: Reader) -> Outputs:
    """A colour of three numbers, of any model."""
    made, mode = _combined(n, "Red", "Green", "Blue"), n.setting("mode", "RGB")
    return {"Color": made if mode == "RGB" else n.call(f"rgb_of_{mode.lower()}", made)}


@kind("ShaderNodeSeparateColor")
def separate_color(n: Reader) -> Outputs:
    """The parts of a colour, of any model."""
    color, mode = n.color("Color"), n.setting("mode", "RGB")
    return _parts(n, color if mode == "RGB" else n.call(f"{mode.lower()}_of_rgb", color), "Red", "Green", "Blue")


@kind("ShaderNodeCombineRGB")
def combine_rgb(n: Reader) -> Outputs:
    """As in older files."""
    return {"Image": _combined(n, "R", "G", "B")}


@kind("ShaderNodeSeparateRGB")
def separate_rgb(n: Reader) -> Outputs:
    """As in older files."""
    return _parts(n, n.color("Image"), "R", "G", "B")


@kind("ShaderNodeCombineHSV")
def combine_hsv(n: Reader) -> Outputs:
    """As in older files."""
    return {"Color": n.call("rgb_of_hsv", _combined(n, "H", "S", "V"))}


@kind("ShaderNodeSeparateHSV")
def separate_hsv(n: Reader) -> Outputs:
    """As in older files."""
    return _parts(n, n.call("hsv_of_rgb", n.color("Color")), "H", "S", "V")


def _combined(n: Reader, *names: str) -> Expr:
    return n.call("combined", *map(n.number, names))


def _parts(n: Reader, whole: Expr, *names: str) -> Outputs:
    return dict(zip(names, (n.call(f"{place}_of", whole) for place in ("first", "second", "third")), strict=True))
