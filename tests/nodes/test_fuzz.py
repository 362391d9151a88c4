# SPDX-License-Identifier: GPL-3.0-or-later
"""Random trees of all kinds of nodes that compute values: they compile, and what they give is finite for any input."""

from __future__ import annotations

from contextlib import suppress

import bpy
import numpy as np
import pytest

from svo_engine.nodes.kinds import kinds
from tests.blender import build
from tests.nodes import trees
from tests.nodes.closures import all_finite, of_closures
from tests.nodes.makers import set_up

N_TREES, N_NODES = 8, 10
HOSTILE = (0.0, -0.0, 1.0, -1.0, 0.5, 1e-7, -1e-7, 1e-20, 1e20, -1e20, 3e38, -3e38, 255.0, -100.0, 1e6)
USUAL = (0.0, 1.0, 0.5, -0.3, 2.5, 10.0)


def value_kinds() -> list[str]:
    """Kinds that this Blender has, and that give no shader."""
    material = bpy.data.materials.new("Kinds")
    nodes = build.tree_of(material).nodes
    made = [nodes.new(kind) for kind in sorted(kinds()) if hasattr(bpy.types, kind)]
    found = [n.bl_idname.removeprefix("ShaderNode") for n in made if all(s.type != "SHADER" for s in n.outputs)]
    bpy.data.materials.remove(material)
    return found


def shaken(node, random, numbers):
    """The node with random settings and constants."""
    for prop in type(node).bl_rna.properties:
        if prop.identifier in bpy.types.ShaderNode.bl_rna.properties or prop.is_readonly:
            continue
        if prop.type == "ENUM":
            with suppress(TypeError):  # not all are for shaders
                set_up(node, **{prop.identifier: str(random.choice([item.identifier for item in prop.enum_items]))})
        elif prop.type == "BOOLEAN":
            set_up(node, **{prop.identifier: bool(random.integers(2))})
    for socket in node.inputs:
        if hasattr(socket, "default_value") and socket.type in ("VALUE", "VECTOR", "RGBA"):
            width = 0 if socket.type == "VALUE" else len(socket.default_value)
            socket.default_value = random.choice(numbers) if width == 0 else random.choice(numbers, width)
    return node


def random_tree(seed, found, numbers):
    """A Maker: each node is fed by some before it, the first one by coordinates."""

    def make(nodes):
        random = np.random.default_rng(seed)
        made = [[nodes.new("TexCoord").outputs["UV"]]]
        for _ in range(N_NODES):
            node = shaken(nodes.new(str(random.choice(found))), random, numbers)
            for socket in node.inputs:
                before = made[random.integers(len(made))]
                if not socket.is_unavailable and (socket.hide_value or random.random() < 0.6):
                    nodes.tree.links.new(before[random.integers(len(before))], socket)
            outputs = [s for s in node.outputs if not s.is_unavailable]
            made += [outputs] if outputs else []
        return made[-1][random.integers(len(made[-1]))]

    return make


@pytest.mark.parametrize("seed", range(4))
def test_random_trees_are_finite(session, seed):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    found = value_kinds()
    makers = [random_tree(100 * seed + i, found, HOSTILE if i % 2 else USUAL) for i in range(N_TREES)]
    trees.make_cards(makers)
    random = np.random.default_rng(seed)
    shape = N_TREES, trees.SIZE, trees.SIZE, 2
    uv = np.where(random.random(shape) < 0.5, random.uniform(-2, 2, shape), random.choice(HOSTILE, shape)).astype("f4")
    graphs = trees.graphs()
    made = trees.by_us(session, graphs, uv)
    bad = [i for i in range(N_TREES) if not np.isfinite(made[i]).all()]
    assert not bad, [(100 * seed + i, [node.kind for node in graphs[i].nodes]) for i in bad]


def shader_kinds() -> list[str]:
    """Kinds of closures that this Blender has."""
    material = bpy.data.materials.new("Kinds")
    nodes = build.tree_of(material).nodes
    made = [nodes.new(kind) for kind in sorted(kinds()) if hasattr(bpy.types, kind)]
    found = [n.bl_idname.removeprefix("ShaderNode") for n in made if [s.type for s in n.outputs] == ["SHADER"]
             and all(s.type != "SHADER" for s in n.inputs)]
    bpy.data.materials.remove(material)
    return found


def random_shader(seed, found, shaders, numbers):
    """A Maker: closures fed by random values, mixed and added."""

    def make(nodes):
        random = np.random.default_rng(seed)
        values = [random_tree(seed + i, found, numbers)(nodes) for i in range(2)]
        made = []
        for _ in range(3):
            node = shaken(nodes.new(str(random.choice(shaders))), random, numbers)
            for socket in node.inputs:
                if not socket.is_unavailable and not socket.hide_value and random.random() < 0.5:
                    nodes.tree.links.new(values[random.integers(2)], socket)
            made.append(node.outputs[0])
        added = nodes.new("AddShader", Shader=made[0], Shader_001=made[1])
        return nodes.new("MixShader", Fac=values[0], Shader=added, Shader_001=made[2]).outputs[0]

    return make


@pytest.mark.parametrize("seed", range(2))
def test_random_closures_are_finite(session, seed):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    found, shaders = [k for k in value_kinds() if not k.startswith("Tex")], shader_kinds()
    makers = [random_shader(100 * seed + i, found, shaders, HOSTILE if i % 2 else USUAL) for i in range(N_TREES)]
    trees.make_cards(makers)
    random = np.random.default_rng(seed)
    shape = N_TREES, trees.SIZE, trees.SIZE, 2
    uv = np.where(random.random(shape) < 0.5, random.uniform(-2, 2, shape), random.choice(HOSTILE, shape)).astype("f4")
    graphs = trees.graphs()
    finite = of_closures(session, graphs, uv, all_finite())
    bad = [i for i in range(N_TREES) if not finite[i].all()]
    assert not bad, [(100 * seed + i, [node.kind for node in graphs[i].nodes]) for i in bad]


# Shares of light: of what light sees that was spread, and of what the eye sees
SHARES = """
vec3 seen(Closures c)
{
    vec3 all_of_it = c.ground + c.lobes.glossy + c.lobes.transmission + c.behind + c.transparency;
    return vec3(max(c.mean.r, max(c.mean.g, c.mean.b)), dot(all_of_it, vec3(1.0 / 3.0)) + c.holdout, 0.0);
}
"""


def test_no_closure_sends_back_more_than_it_gets(session):
    """White ones of random roughness, metalness and all else. The table of microfacets' albedos is right to .3 %."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    shaders = [kind for kind in shader_kinds() if kind not in ("Emission", "Background")]

    def white(kind, seed):
        def make(nodes):
            node = shaken(nodes.new(kind), np.random.default_rng(seed), (0.0, 0.3, 0.7, 1.0))
            for socket in node.inputs:
                if socket.type == "RGBA":
                    socket.default_value = 1, 1, 1, 1
                elif "IOR" in socket.identifier and socket.type == "VALUE":
                    socket.default_value = 1 + socket.default_value
            return node.outputs[0]
        return make

    cases = [(kind, seed) for seed in range(2) for kind in shaders]
    trees.make_cards([white(*case) for case in cases])
    shares = of_closures(session, trees.graphs(), np.zeros((len(cases), trees.SIZE, trees.SIZE, 2), "f4"), SHARES)
    worst = shares.reshape(len(cases), -1, 3).max(1)
    bad = {case: share[:2] for case, share in zip(cases, worst, strict=True) if not (share <= 1.003).all()}
    assert not bad
