# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled node trees in a frame: what stands in for them, what edits compile, what lights others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from svo_engine.scene.graph import Graph, Link, Node
from svo_engine.scene.types import Camera, Material, Scene
from tests import scenes, variety
from tests.on_gpu import film_of, picture_of
from tests.rays import RAYS

CAMERA = Camera("Camera", scenes.look((0, -4, 2)), (16, 12))
OPEN = {**RAYS, "samples": 1, "bounces": 0}


def emission(color: tuple[float, ...], strength: float = 1.0, more: tuple[Node, ...] = ()) -> Graph:
    """An Emission node that nothing feeds; `more` are nodes that are of no use."""
    node = Node("ShaderNodeEmission", inputs={"Color": (*color, 1.0), "Strength": strength})
    return Graph((node, *more), Link(0, "Emission"))


def glowing(graph: Graph) -> Scene:
    """A floor of that tree, black where plain values stand in."""
    tree = Material("Tree", (0, 0, 0), specular_level=0, graph=graph, is_exact=False)
    return scenes.scene(scenes.Thing(scenes.floor(), tree), camera=CAMERA)


def test_a_tree_is_what_is_seen(session):
    picture = picture_of(session, glowing(emission((0.2, 0.4, 0.8), 3.0)), **OPEN)
    assert np.allclose(picture[6, 8, :3], [0.6, 1.2, 2.4], rtol=1e-6)
    assert picture[0, 0, :3].max() == 0


def test_an_edit_of_a_value_compiles_nothing(session):
    film_of(session, glowing(emission((0.2, 0.4, 0.8))), **OPEN)
    film = film_of(session, glowing(emission((0.9, 0.1, 0.3), 7.0)), **OPEN)
    assert film.stats["counts"]["programs compiled"] == 0


def test_a_draft_shows_plain_values_until_the_tree_is_compiled(session):
    """A structure that no other test has: three emissions added."""
    nodes = [*(emission((1, 1, 1)).nodes[0] for _ in range(3)),
             Node("ShaderNodeAddShader", inputs={"Shader": Link(0, "Emission"), "Shader_001": Link(1, "Emission")}),
             Node("ShaderNodeAddShader", inputs={"Shader": Link(3, "Shader"), "Shader_001": Link(2, "Emission")})]
    both = Graph(tuple(nodes), Link(4, "Shader"))
    scene = glowing(both)
    view, settings = scenes.view(scene), replace(scenes.SMALL, **OPEN)
    draft = list(session.client().films(scene, view, settings, is_draft=True))[-1].planes["Combined"]
    assert draft[..., 3].max() == 1
    assert draft[..., :3].max() == 0
    assert picture_of(session, scene, **OPEN)[..., :3].max() == 3
    again = list(session.client().films(scene, view, settings, is_draft=True))[-1].planes["Combined"]
    assert again[..., :3].max() == 3


def test_emitting_trees_light_others(session):
    """A panel over a floor, once as a tree and once in the table of materials: cells hold radiance to 2^-16."""
    panel = scenes.quad("Panel", (-0.5, -0.5, 1), (1, 0, 0), (0, 1, 0))
    plain = Material("Lamp", (0, 0, 0), specular_level=0, emission=(5, 3, 1))
    tree = Material("Tree", (0, 0, 0), specular_level=0, graph=emission((5, 3, 1)), is_exact=False)
    pictures = [picture_of(session, scenes.scene(scenes.Thing(scenes.floor()), scenes.Thing(panel, m), camera=CAMERA),
                           **{**RAYS, "samples": 4}) for m in (plain, tree)]
    assert pictures[0][..., :3].max() > 0.01
    assert np.abs(pictures[0] - pictures[1]).max() < 1e-3


def test_an_edit_of_another_material_bakes_no_tree(session):
    panel = scenes.quad("Panel", (-0.5, -0.5, 1), (1, 0, 0), (0, 1, 0))
    tree = Material("Tree", (0, 0, 0), specular_level=0, graph=emission((5, 3, 1)), is_exact=False)

    def passes(floor, lamp):
        """Those of baking and of the light cache that a frame runs."""
        things = scenes.Thing(scenes.floor(), floor), scenes.Thing(panel, lamp)
        counts = film_of(session, scenes.scene(*things, camera=CAMERA), **{**RAYS, "samples": 1}).stats["counts"]
        return {name for name in counts if name.startswith(("bake/", "cache/")) and " " not in name}

    session.forget()
    assert "bake/hits" in passes(scenes.WHITE, tree)
    assert passes(scenes.RED, tree) == {"cache/start", "cache/bounce", "cache/finish"}
    edited = passes(scenes.RED, replace(tree, graph=emission((5, 3, 2))))
    assert "bake/hits" in edited and "cache/found" in edited and "cache/link" not in edited


def test_what_a_tree_cannot_say_is_told_by_material_and_node(session):
    graph = Graph((Node("ShaderNodeOfNobody", name="Strange"),), Link(0, "BSDF"))
    (told,) = [s for s in film_of(session, glowing(graph), **OPEN).stats["limits"] if "Strange" in s]
    assert told.startswith("Material 'Tree': node 'Strange'")


def half_clear(color: tuple[float, ...] = (1, 1, 1)) -> Graph:
    """As much of a Transparent BSDF as of an Emission of radiance 1."""
    nodes = (emission((1, 1, 1)).nodes[0], Node("ShaderNodeBsdfTransparent", inputs={"Color": (*color, 1.0)}),
             Node("ShaderNodeMixShader", inputs={"Fac": 0.5, "Shader": Link(0, "Emission"),
                                                 "Shader_001": Link(1, "BSDF")}))
    return Graph(nodes, Link(2, "Shader"))


def test_light_behind_what_lets_it_pass_is_seen(session):
    """Three panes that send out 1/2 and let 1/2 pass, one before the other, before a floor of radiance 8: 1/2 + 1/4 +
    1/8 + 1. By chance, so the mean over all pixels is within four deviations of one sample's spread."""
    pane = Material("Pane", (0, 0, 0), specular_level=0, graph=half_clear(), is_exact=False)
    panes = [scenes.Thing(scenes.quad(f"Pane {z}", (-3, -3, z), (6, 0, 0), (0, 6, 0)), pane) for z in (1, 2, 3)]
    floor = Material("Floor", (0, 0, 0), specular_level=0, emission=(8, 8, 8))
    scene = scenes.scene(scenes.Thing(scenes.quad("Floor", (-9, -9, 0), (18, 0, 0), (0, 18, 0)), floor), *panes,
                         camera=Camera("Camera", scenes.look((0, 0, 5), up=(0, 1, 0)), (16, 16), lens=80))
    film = film_of(session, scene, **{**OPEN, "samples": 32})
    seen = film.planes["Combined"][..., :3]
    assert abs(seen.mean() - 1.875) < 4 * 2.5 / np.sqrt(32 * 256)


def test_light_as_a_colour_is_the_light_that_the_point_sends(session):
    """Shader to RGB of a Diffuse BSDF, sent out again: the picture of the Diffuse BSDF itself, whose means are the same
    numbers in another order. Twice as strong, twice the picture."""
    diffuse = Node("ShaderNodeBsdfDiffuse", inputs={"Color": (0.8, 0.4, 0.2, 1.0), "Roughness": 0.0, "Normal": None})
    lit = Node("ShaderNodeShaderToRGB", inputs={"Shader": Link(0, "BSDF")})
    sent = [Node("ShaderNodeEmission", inputs={"Color": Link(1, "Color"), "Strength": k}) for k in (1.0, 2.0)]
    graphs = [Graph((diffuse,), Link(0, "BSDF")), *(Graph((diffuse, lit, s), Link(2, "Emission")) for s in sent)]
    pictures = [picture_of(session, replace(glowing(graph), lights=(variety.bulb(),)), **OPEN)[..., :3]
                for graph in graphs]
    assert pictures[0].max() > 0.01
    assert np.allclose(pictures[1], pictures[0], rtol=1e-5)
    assert np.allclose(pictures[2], 2 * pictures[0], rtol=1e-5)


def test_light_is_a_colour_once(session):
    """A second Shader to RGB is told of."""
    first, second = emission((1, 1, 1)).nodes[0], emission((1, 0, 0)).nodes[0]
    asked = [Node("ShaderNodeShaderToRGB", inputs={"Shader": Link(i, "Emission")}) for i in (0, 1)]
    sent = [Node("ShaderNodeEmission", inputs={"Color": Link(i, "Color"), "Strength": 1.0}) for i in (2, 3)]
    both = Node("ShaderNodeAddShader", inputs={"Shader": Link(4, "Emission"), "Shader_001": Link(5, "Emission")})
    graph = Graph((first, second, *asked, *sent, both), Link(6, "Shader"))
    assert any("more than once" in s for s in film_of(session, glowing(graph), **OPEN).stats["limits"])
