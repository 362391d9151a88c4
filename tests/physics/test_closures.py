# SPDX-License-Identifier: GPL-3.0-or-later
"""Closures of node trees in a world that is white everywhere: what sends all light back cannot be seen."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from svo_engine.scene.graph import Graph, Link, Node
from svo_engine.scene.types import Camera, Material, Scene, World
from tests import scenes
from tests.on_gpu import picture_of
from tests.rays import RAYS

CAMERA = Camera("Camera", scenes.look((0, -4, 1)), (16, 12))
SETTINGS: dict[str, Any] = {**RAYS, "samples": 64, "bounces": 40}
WHITE = (1.0, 1.0, 1.0, 1.0)
PRINCIPLED = {"Base Color": WHITE, "Roughness": 0.4, "IOR": 1.5, "Alpha": 1.0, "Specular IOR Level": 0.5,
              "Specular Tint": WHITE}


def node(kind: str, settings: dict[str, Any] | None = None, **inputs: Any) -> Node:
    return Node(f"ShaderNode{kind}", settings or {}, {name.replace("_", " "): v for name, v in inputs.items()})


def mixed(first: Node, second: Node, factor: float = 0.5) -> Graph:
    mix = Node("ShaderNodeMixShader", inputs={"Fac": factor, "Shader": Link(0, "BSDF"), "Shader_001": Link(1, "BSDF")})
    return Graph((first, second, mix), Link(2, "Shader"))


def ball(graph: Graph) -> Scene:
    tree = Material("Tree", (0, 0, 0), specular_level=0, graph=graph, is_exact=False)
    return scenes.scene(scenes.Thing(scenes.sphere("Ball", 1.0, 24), tree), camera=CAMERA, world=World((1, 1, 1)))


def middle(session, graph: Graph) -> np.ndarray:
    """(3,): mean of the pixels in the middle of the ball."""
    return picture_of(session, ball(graph), **SETTINGS)[4:8, 6:10, :3].mean((0, 1))


ALL_BACK = {
    "coat": Graph((Node("ShaderNodeBsdfPrincipled", {}, {**PRINCIPLED, "Coat Weight": 1.0, "Coat IOR": 1.5}),),
                  Link(0, "BSDF")),
    "sheen": Graph((Node("ShaderNodeBsdfPrincipled", {}, {**PRINCIPLED, "Sheen Weight": 1.0, "Sheen Tint": WHITE}),),
                   Link(0, "BSDF")),
    "rough ground": Graph((node("BsdfDiffuse", Color=WHITE, Roughness=0.9),), Link(0, "BSDF")),
    "two mirrors": mixed(node("BsdfGlossy", Color=WHITE, Roughness=0.1),
                         node("BsdfGlossy", Color=WHITE, Roughness=0.4)),
    "glass": Graph((node("BsdfGlass", Color=WHITE, Roughness=0.1, IOR=1.3),), Link(0, "BSDF")),
    "mirror and ground": mixed(node("BsdfGlossy", Color=WHITE, Roughness=0.0), node("BsdfDiffuse", Color=WHITE)),
    "grain": Graph((node("BsdfMetallic", Base_Color=WHITE, Edge_Tint=WHITE, Roughness=0.3, Anisotropy=0.5),),
                   Link(0, "BSDF")),
    "pane": mixed(node("BsdfTransparent", Color=WHITE), node("BsdfDiffuse", Color=WHITE), 0.3),
}


@pytest.mark.parametrize("name", ALL_BACK)
def test_what_sends_all_light_back_is_not_seen(session, name):
    """Surfels reflect .9999 at most, tables are right to 1 %, and 64 samples of 16 pixels to about as much."""
    assert middle(session, ALL_BACK[name]) == pytest.approx(1, abs=0.025)


def test_light_shines_through_both_sides_of_a_ball(session):
    """Of light 1 from everywhere, 0.8 comes in, and 0.8 of that out again."""
    graph = Graph((node("BsdfTranslucent", Color=(0.8, 0.8, 0.8, 1.0)),), Link(0, "BSDF"))
    assert middle(session, graph) == pytest.approx(0.64, abs=0.02)


def test_a_coloured_pane_colours_what_is_behind_it_twice(session):
    """Once at each side of the ball, by chance what all colours have in common, and as a pane what they have not."""
    graph = Graph((node("BsdfTransparent", Color=(0.9, 0.5, 0.2, 1.0)),), Link(0, "BSDF"))
    assert middle(session, graph) == pytest.approx(np.array([0.81, 0.25, 0.04]), abs=0.03)


def test_a_film_takes_nothing_from_white(session):
    """What the film does not reflect, the white ground does."""
    inputs = {**PRINCIPLED, "Thin Film Thickness": 400.0, "Thin Film IOR": 1.4}
    graph = Graph((Node("ShaderNodeBsdfPrincipled", {}, inputs),), Link(0, "BSDF"))
    found = middle(session, graph)
    assert found.max() < 1.02
    assert found.min() > 0.9
