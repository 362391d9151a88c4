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
