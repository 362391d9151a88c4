# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes that look values up: ramps, curves, and the colours of light."""

from __future__ import annotations

import numpy as np

from ..expr import Constant, Expr
from ..ramps import Curves, is_stepped, ramp_at, ramp_table
from ..reader import Reader
from ..spectra import blackbody_at, blackbody_table, wavelength_at, wavelength_table
from . import Outputs, kind

_BLACK_TO_WHITE = "RGB", "LINEAR", "NEAR", ((0.0, 0.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0, 1.0, 1.0))


@kind("ShaderNodeValToRGB")
def color_ramp(n: Reader) -> Outputs:
    """A colour, and alpha, for each number from 0 to 1."""
    ramp, factor = n.setting("color_ramp", _BLACK_TO_WHITE), n.number("Fac", 0.5)
    if isinstance(factor, Constant):
        *color, alpha = map(float, ramp_at(ramp, factor.value[0]))
        return {"Color": n.value(tuple(color)), "Alpha": n.value(alpha)}
    table, way = n.table(ramp_table(ramp).tolist()), "_stepped" if is_stepped(ramp) else ""
    return {"Color": n.call(f"ramp_color{way}", table, factor), "Alpha": n.call(f"ramp_alpha{way}", table, factor)}


@kind("ShaderNodeRGBCurve")
def color_curves(n: Reader) -> Outputs:
    """A curve for each part of a colour, after one for all of them."""
    return {"Color": curved(n, n.number("Fac", 1.0), n.color("Color"), 3)}


@kind("ShaderNodeFloatCurve")
def number_curve(n: Reader) -> Outputs:
    """A curve."""
    return {"Value": curved(n, n.number("Factor", 1.0), n.number("Value", 1.0), 1)}


def curved(n: Reader, factor: Expr, value: Expr, n_curves: int) -> Expr:
    """The value, a number for one curve or a vec3 for three, by a node's curves, and by `factor` alone."""
    mapping = n.setting("mapping")
    if mapping is None:
        return value
    curves = Curves(mapping, n.setting("mapping.samples", ()))
    if isinstance(factor, Constant) and isinstance(value, Constant):
        made = curves.at(factor.value[0], np.array(value.value))
        return n.value(tuple(map(float, made)) if n_curves > 1 else float(made[0]))
    function = "curve_of_number" if n_curves == 1 else "curves_of_parts"
    return n.call(function, n.table(curves.table().tolist()), factor, value)


@kind("ShaderNodeBlackbody")
def blackbody(n: Reader) -> Outputs:
    """The colour of a glowing body [K], of luminance 1."""
    temperature = n.number("Temperature", 1500.0)
    if isinstance(temperature, Constant):
        return {"Color": n.value(blackbody_at(temperature.value[0]))}
    return {"Color": n.call("blackbody_color", n.table(blackbody_table().tolist()), temperature)}


@kind("ShaderNodeWavelength")
def wavelength(n: Reader) -> Outputs:
    """The colour of light of one wavelength [nm]."""
    length = n.number("Wavelength", 500.0)
    if isinstance(length, Constant):
        return {"Color": n.value(wavelength_at(length.value[0]))}
    return {"Color": n.call("wavelength_color", n.table(wavelength_table().tolist()), length)}
