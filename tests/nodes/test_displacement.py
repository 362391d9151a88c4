# SPDX-License-Identifier: GPL-3.0-or-later
"""Displacement as a bump of all normals beside Cycles: what nodes give as Normal is bumped."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from tests.nodes import cards
from tests.nodes.test_normals import shape, waves


def displaced(kind, **settings):
    """A maker: the normal of a material whose displacement is made by a node of that kind."""

    def maker(nodes):
        inputs = {"Height": waves(nodes)} if kind == "Displacement" else {"Vector": waves(nodes)}
        node = nodes.new(kind, Scale=0.2, Midlevel=0.3, **inputs)
        for setting, value in settings.items():
            setattr(node, setting, value)
        nodes.show(node, "Displacement")
        return nodes.new("NewGeometry").outputs["Normal"]

    return maker


GIVEN = {**{f"height {space}": displaced("Displacement", space=space) for space in ("OBJECT", "WORLD")},
         **{f"vector {space}": displaced("VectorDisplacement", space=space)
            for space in ("OBJECT", "WORLD", "TANGENT")}}


@pytest.mark.parametrize("kind", ["card", "smooth"])
def test_bumps(session, kind):
    cards.make_cards(list(GIVEN.values()))
    for i in range(len(GIVEN)):
        owner = bpy.data.objects[f"Card {i}"]
        shape(owner, kind)
        owner.active_material.displacement_method = "BUMP"
    ours, theirs = cards.cards_by_us(session, list(GIVEN.values())), cards.cards_by_cycles(list(GIVEN.values()))
    errors = {name: float(np.quantile(np.abs(a - b).max(-1), 0.95)) for name, a, b in
              zip(GIVEN, ours, theirs, strict=True)}
    # Tangents, which lean where a bump looks beside the point, are laid into the plane of the normal there
    assert max(errors.values()) < 3e-3, errors


def moved(output, kind="Displacement", **settings):
    """A maker: an output of a Texture Coordinate node on what is moved."""

    def maker(nodes):
        displaced(kind, **settings)(nodes)
        return nodes.new("TexCoord").outputs[output]

    return maker


MOVED = {"place": moved("Object"), "normal": moved("Normal"), "generated": moved("Generated"),
         "by a vector": moved("Normal", "VectorDisplacement", space="OBJECT"),
         "along tangents": moved("Object", "VectorDisplacement", space="TANGENT"),
         "in the world": moved("Object", space="WORLD")}


@pytest.mark.parametrize("method", ["DISPLACEMENT", "BOTH"])
@pytest.mark.parametrize("kind", ["smooth", "flat"])
def test_vertices_move(session, kind, method):
    """Scaled alike along all axes, for Cycles takes means of normals in world space. Silhouettes are left out."""
    cards.make_cards(list(MOVED.values()))
    for i in range(len(MOVED)):
        owner = bpy.data.objects[f"Card {i}"]
        shape(owner, kind)
        owner.scale = 0.7, 0.7, 0.7
        owner.active_material.displacement_method = method
    ours, theirs = cards.cards_by_us(session, list(MOVED.values())), cards.cards_by_cycles(list(MOVED.values()))
    errors = {name: float(np.quantile(np.abs(a - b).max(-1), 0.93)) for name, a, b in
              zip(MOVED, ours, theirs, strict=True)}
    if kind == "flat":
        del errors["along tangents"]  # flat faces of four corners have one tangent in Cycles, not those of triangles
    assert max(errors.values()) < 1e-3, errors
