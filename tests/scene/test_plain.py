# SPDX-License-Identifier: GPL-3.0-or-later
"""What pictures do not depend on makes nothing anew."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from svo_engine.gpu.kept import _same
from svo_engine.scene.graph import Graph, Node
from svo_engine.scene.types import Attribute
from tests import scenes


def with_all(scene, kind):
    """The scene with something in all places that no picture depends on."""
    graph, n = Graph((Node(kind, {"size": (1.0, 2.0)}, {"Color": 0.5}),)), len(scene.instances)
    heat = Attribute("heat", "POINT", np.ones((len(scene.meshes[0].positions), 1), "f4"))
    named = replace(scene.meshes[0], name=kind, attributes=(*scene.meshes[0].attributes, heat), color="heat",
                    generated_low=(1.0, 2.0, 3.0))
    return replace(
        scene, meshes=(named, *scene.meshes[1:]), materials=tuple(
            replace(m, name=kind, graph=graph, pass_index=3) for m in scene.materials),
        lights=tuple(replace(light, graph=graph) for light in scene.lights), world=replace(scene.world, graph=graph),
        instances=replace(scene.instances, names=(kind,) * n, color=np.zeros((n, 4), "f4"), ids=np.arange(n)))


def test_plain_scenes_are_the_same():
    scene = scenes.rich()
    one, other = with_all(scene, "One"), with_all(scene, "Other")
    assert not _same(one, other)
    assert _same(one.plain, other.plain)
    assert _same(one.plain, scene.plain)


def test_what_pictures_depend_on_stays():
    quad = scenes.quad("Quad", (0, 0, 0), (1, 0, 0), (0, 1, 0), uvs=True)
    scene = with_all(scenes.scene(scenes.Thing(quad)), "One")
    plain = scene.plain
    np.testing.assert_array_equal(plain.meshes[0].corner_uvs, quad.corner_uvs)
    assert plain.meshes[0].corner_uvs.any()
    for name in ("mesh", "world_from_object", "first_slot", "slot_materials"):
        assert getattr(plain.instances, name) is getattr(scene.instances, name)
    assert len(plain.instances) == 1


@pytest.mark.parametrize("inexact", [0, 1])
def test_where_a_tree_says_more_it_stays_with_what_it_may_ask_for(inexact):
    """Two quads of a material each; the first one has an attribute."""
    quads = [scenes.quad(name, (0, 0, 0), (1, 0, 0), (0, 1, 0), uvs=True) for name in "AB"]
    scene = with_all(scenes.scene(scenes.Thing(quads[0], scenes.RED), scenes.Thing(quads[1], scenes.GREEN)), "One")
    materials = tuple(replace(m, is_exact=i != inexact) for i, m in enumerate(scene.materials))
    plain = replace(scene, materials=materials).plain
    for i, material in enumerate(materials):
        said = (None, 0) if i != inexact else (material.graph, 3)
        assert (plain.materials[i].graph, plain.materials[i].pass_index) == said
    assert len(plain.meshes[0].attributes) == (2 if inexact == 0 else 1)
    assert plain.instances.color is scene.instances.color
    assert not plain.instances.ids.any()


def test_it_is_made_once_for_each_record():
    scene = scenes.rich()
    moved = replace(scene, film_transparent=True)
    assert scene.plain is scene.plain
    for name in ("meshes", "materials", "lights"):
        for a, b in zip(getattr(scene.plain, name), getattr(moved.plain, name), strict=True):
            assert a is b
    assert scene.plain.instances is moved.plain.instances


def test_equal_graphs_are_equal_and_hash_so():
    a, b = (Graph((Node("Kind", {"size": (1.0,)}, {"Color": 0.5}),)) for _ in range(2))
    assert a == b
    assert hash(a) == hash(b)
    assert a != Graph((Node("Kind", {"size": (1.0,)}, {"Color": 0.6}),))
