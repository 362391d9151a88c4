# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes of colours, ramps and curves, in all their modes, beside Cycles."""

from __future__ import annotations

import numpy as np
import pytest

from tests.nodes.makers import check, inputs, maker, math, modes


@pytest.mark.parametrize("kind", ["Mix", "MixRGB"])
def test_mix(session, kind):
    """Of all modes; with factors and colours beyond 0 and 1 too, clamped or not."""
    names = ("Factor_Float", "A_Color", "B_Color") if kind == "Mix" else ("Fac", "Color1", "Color2")

    def mixed(blend, clamp, factor, a, b):
        own = {"use_clamp": clamp}
        if kind == "Mix":
            own = {"data_type": "RGBA", "clamp_factor": clamp, "clamp_result": clamp}
        return maker(kind, dict(zip(names, (factor, a, b), strict=True)), blend_type=blend, **own)

    check(session, {
        f"{blend} {clamp} {given}": mixed(blend, clamp, *given) for blend in modes(kind, "blend_type")
        for clamp, given in ((True, ("x", "a", "b")), (False, ("x", "a", "b")), (False, ("u", "v", "b")),
                             (True, (0.7, "b", (0.2, 0.9, 0.4, 1))))})


def test_adjustments(session):
    given = {
        "BrightContrast": ({"Color": "a", "Bright": 0.3, "Contrast": 0.5},
                           {"Color": "b", "Bright": "x", "Contrast": "y"}),
        "Gamma": [{"Color": "a", "Gamma": gamma} for gamma in (2.2, 0.0, -0.5, "x")],
        "HueSaturation": ({"Color": "a"}, {"Color": "a", "Hue": 0.3, "Saturation": 1.5, "Value": 0.8, "Fac": 0.9},
                          {"Color": "b", "Hue": "x", "Saturation": "y", "Value": "u", "Fac": "v"}),
        "Invert": ({"Color": "a", "Fac": "x"}, {"Color": "b", "Fac": 0.3}),
        "RGBToBW": ({"Color": "a"},)}
    check(session, {f"{kind} {one}": maker(kind, one) for kind, all_ in given.items() for one in all_})


def test_parts(session):
    numbers = (("u", "v", 0.7), (0.3, "u", "v"), ("x", "y", 1.5), ("v", 0.4, "u"))
    names = "Red", "Green", "Blue"
    check(session, {
        **{f"{mode} {name}": maker("SeparateColor", {"Color": "a"}, name, mode=mode)
           for mode in modes("SeparateColor", "mode") for name in names},
        **{f"{mode} {values}": maker("CombineColor", dict(zip(names, values, strict=True)), mode=mode)
           for mode in modes("CombineColor", "mode") for values in numbers}})


def test_light(session):
    def of(kind, name, half, middle):
        return lambda nodes: nodes.new(kind, **{name: math(nodes, "MULTIPLY_ADD", inputs(nodes)["x"], half, middle)})

    check(session, {
        "hot": of("Blackbody", "Temperature", 3500.0, 6500.0), "cold": of("Blackbody", "Temperature", 500.0, 1500.0),
        "wavelength": of("Wavelength", "Wavelength", 120.0, 560.0),
        "one temperature": maker("Blackbody", {"Temperature": 3000.0}),
        "one wavelength": maker("Wavelength", {"Wavelength": 612.0}),
        **{f"falloff {name} {smooth}": maker("LightFalloff", {"Strength": "x", "Smooth": smooth}, name)
           for name in ("Quadratic", "Linear", "Constant") for smooth in (0.0, 0.7)}})


def random_stops(ramp, n):
    random = np.random.default_rng(n)
    while len(ramp.elements) < n:
        ramp.elements.new(0.5)
    while len(ramp.elements) > n:
        ramp.elements.remove(ramp.elements[0])
    for element, at in zip(ramp.elements, np.sort(random.uniform(0.05, 0.95, n)), strict=True):
        element.position, element.color = at, random.uniform(0, 1, 4)


def test_ramps(session):
    def ramp(output, mode, way, hue, n):
        def make(nodes):
            node = nodes.new("ValToRGB", Fac=math(nodes, "MULTIPLY_ADD", inputs(nodes)["x"], 0.3, 0.5))
            random_stops(node.color_ramp, n)
            node.color_ramp.color_mode = mode
            if mode == "RGB":
                node.color_ramp.interpolation = way
            node.color_ramp.hue_interpolation = hue
            return node.outputs[output]
        return make

    ways = [("RGB", way, "NEAR") for way in ("LINEAR", "CONSTANT", "EASE", "CARDINAL", "B_SPLINE")]
    ways += [(mode, "LINEAR", hue) for mode in ("HSV", "HSL") for hue in ("NEAR", "FAR", "CW", "CCW")]
    check(session, {f"{output} {way} {n}": ramp(output, *way, n) for way in ways for n in (1, 2, 4)
                    for output in ("Color", "Alpha")})


def test_curves(session):
    def bend(extend, n):
        def bent(node):
            node.mapping.extend = extend
            random = np.random.default_rng(n)
            for curve in node.mapping.curves:
                for _ in range(n):
                    curve.points.new(*random.uniform(0.1, 0.9, 2))
                if n:
                    curve.points[0].location = random.uniform(-0.2, 0.1), random.uniform(0, 0.3)
                    curve.points[-1].handle_type = ("AUTO", "VECTOR", "AUTO_CLAMPED")[n % 3]
            node.mapping.update()
        return bent

    names = {"RGBCurve": ("Fac", "Color", "a"), "VectorCurve": ("Fac", "Vector", "a"),
             "FloatCurve": ("Factor", "Value", "x")}
    check(session, {
        f"{kind} {extend} {n} {factor}": maker(kind, {name: factor, value: what}, None, bend(extend, n))
        for kind, (name, value, what) in names.items() for extend in ("EXTRAPOLATED", "HORIZONTAL") for n in range(4)
        for factor in (1.0, "y")})


def test_curves_of_constants(session):
    """Which both sides fold, with values beyond the ends of the curves."""
    given = [("FloatCurve", {"Factor": 0.7, "Value": value}) for value in (2.5, -0.5, 0.3)]
    given += [("RGBCurve", {"Fac": 0.7, "Color": (2.5, 0.1, 0.4, 1)}),
              ("VectorCurve", {"Fac": 2.0, "Vector": (2.5, -3, 0.4)})]
    given += [("ValToRGB", {"Fac": value}) for value in (2.5, -0.5, 0.3)]
    check(session, {f"{kind} {one}": maker(kind, one) for kind, one in given})
