# SPDX-License-Identifier: GPL-3.0-or-later
"""The Vector Transform node beside Cycles, of cards that are turned and scaled, through a camera that is turned."""

from __future__ import annotations

import bpy
import numpy as np

from tests.nodes import cards
from tests.nodes.makers import inputs, modes, set_up


def all_ways(what):
    """A Maker of all transforms of a kind, each with a share of its own, so that they are one program."""

    def make(nodes):
        spaces, total = modes("VectorTransform", "convert_from"), nodes.new("CombineXYZ")
        given = inputs(nodes)["a"]
        for i, (start, end) in enumerate((start, end) for start in spaces for end in spaces):
            made = set_up(nodes.new("VectorTransform", Vector=given), vector_type=what, convert_from=start,
                          convert_to=end)
            share = 0.2 + 0.1 * i, 1 - 0.1 * i, 0.5
            total = nodes.new("VectorMath", Vector=made, Vector_001=share, Vector_002=total)
            total.operation = "MULTIPLY_ADD"
        return total

    return make


def test_vector_transform(session):
    makers = [all_ways(what) for what in modes("VectorTransform", "vector_type")]
    cards.make_cards(makers)
    for i in range(len(makers)):
        owner = bpy.data.objects[f"Card {i}"]
        owner.rotation_euler, owner.scale = (0.3, -0.2, 0.4), (0.9, 0.6, 1.3)
    bpy.context.scene.camera.rotation_euler = 0, 0, 0.2
    ours, theirs = cards.cards_by_us(session, makers), cards.cards_by_cycles(makers)
    # At edges of cards the two may see different things
    error = np.quantile(np.abs(ours - theirs).max(-1).reshape(len(makers), -1), 0.97, axis=1)
    span = np.ptp(theirs.reshape(len(makers), -1), axis=1)
    assert (span > 1).all()
    assert (error / span < 1e-3).all(), error / span
