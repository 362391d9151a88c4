# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes of numbers and vectors, in all their modes, beside Cycles."""

from __future__ import annotations

import bpy
import pytest

from tests.nodes.makers import check, maker, modes


def test_math(session):
    check(session, {
        f"{operation} {c} {clamp}": maker("Math", {"Value": "x", "Value_001": "y", "Value_002": c}, operation=operation,
                                          use_clamp=clamp)
        for operation in modes("Math", "operation") for c, clamp in ((0.5, False), (-0.3, True))})


def test_vector_math(session):
    given = {"Vector": "a", "Vector_001": "b", "Scale": "x"}
    check(session, {f"{operation} {c}": maker("VectorMath", {**given, "Vector_002": c}, operation=operation)
                    for operation in modes("VectorMath", "operation") for c in ((0.43, -0.71, 0.02), (1, 1, 1))})


def test_mix(session):
    given = {"Factor_Float": "x", "Factor_Vector": "b", "A_Float": "x", "B_Float": "y", "A_Vector": "a",
             "B_Vector": "b"}
    check(session, {f"{what} {way} {clamp}": maker("Mix", given, data_type=what, factor_mode=way, clamp_factor=clamp)
                    for what in ("FLOAT", "VECTOR") for way in ("UNIFORM", "NON_UNIFORM") for clamp in (False, True)})


def test_map_range(session):
    def mapped(what, way, clamp, ends):
        names = ("From_Min", "From_Max", "To_Min", "To_Max")
        given = {"Value": "x", "Vector": "a", "Steps": 3.5, "Steps_FLOAT3": (2, 0, 3.0)}
        for name, end in zip(names, ends, strict=True):
            given |= {name.replace("_", " "): end, f"{name}_FLOAT3": (end, end / 2, 0.5 - end)}
        return maker("MapRange", given, data_type=what, interpolation_type=way, clamp=clamp)

    check(session, {
        f"{what} {way} {clamp} {ends}": mapped(what, way, clamp, ends)
        for what in ("FLOAT", "FLOAT_VECTOR") for way in modes("MapRange", "interpolation_type")
        for clamp in (False, True) for ends in ((-1, 1, 3, 0.5), (1, -1.5, 0, 2), (0.5, 0.5, 1, 2))})


def test_clamp(session):
    check(session, {f"{way} {low} {high}": maker("Clamp", {"Value": "x", "Min": low, "Max": high}, clamp_type=way)
                    for way in modes("Clamp", "clamp_type") for low, high in ((-0.5, 1), (1, -0.5), ("y", 0.3))})


def test_mapping(session):
    constant = {"Vector": "a", "Location": (0.1, 0.2, -0.3), "Rotation": (0.5, -1.2, 2.5), "Scale": (2, 0.5, -1)}
    varying = {"Vector": "a", "Location": "b", "Rotation": "b", "Scale": "a"}
    check(session, {f"{way} {given}": maker("Mapping", given, vector_type=way)
                    for way in modes("Mapping", "vector_type")
                    for given in (constant, varying, constant | {"Scale": (0, 1, 2)})})


def test_vector_rotate(session):
    def rotated(way, invert, axis, angle, rotation):
        given = {"Vector": "a", "Center": (0.1, 0.5, -0.2), "Axis": axis, "Angle": angle, "Rotation": rotation}
        return maker("VectorRotate", given, rotation_type=way, invert=invert)

    angles = ((0.7, (0.3, 1, -2)), ("x", "b"))
    check(session, {
        "about none": rotated("AXIS_ANGLE", False, (0, 0, 0), "x", "b"),
        **{f"{way} {invert} {given}": rotated(way, invert, (1, 2, -1), *given)
           for way in modes("VectorRotate", "rotation_type") for invert in (False, True) for given in angles}})


def test_normal(session):
    def turn(node):
        node.outputs[0].default_value = (0.6, 0.48, 0.64)

    check(session, {output: maker("Normal", {"Normal": "a"}, output, turn) for output in ("Normal", "Dot")})


def test_xyz(session):
    parts = {output: maker("SeparateXYZ", {"Vector": "a"}, output) for output in "XYZ"}
    check(session, {**parts, "combined": maker("CombineXYZ", {"X": "x", "Y": 0.4, "Z": "y"})})


def test_radial_tiling(session):
    if not hasattr(bpy.types, "ShaderNodeRadialTiling"):
        pytest.skip("this Blender has no such node")
    given = [(sides, roundness) for sides in (3, 5) for roundness in (0, 0.3, 1)] + [(2, 0), (2, 1), (4.6, 0), (2.3, 0)]
    outputs = "Segment Coordinates", "Segment ID", "Segment Width", "Segment Rotation"
    check(session, {
        f"{output} {sides} {roundness} {normalize}": maker(
            "RadialTiling", {"Vector": "a", "Sides": sides, "Roundness": roundness}, output, normalize=normalize)
        for sides, roundness in given for normalize in (False, True) for output in outputs})
