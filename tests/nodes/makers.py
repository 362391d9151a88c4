# SPDX-License-Identifier: GPL-3.0-or-later
"""Short ways to make trees for the tests of nodes, and their comparison with Cycles."""

from __future__ import annotations

import bpy
import numpy as np

from tests.nodes.trees import compare


def inputs(nodes):
    """Vectors a and b and numbers x and y that differ over a card, between -2 and 2."""
    parts = nodes.new("SeparateXYZ", Vector=nodes.new("TexCoord").outputs["UV"])
    x = math(nodes, "MULTIPLY_ADD", parts.outputs["X"], 4.0, -2.0)
    y = math(nodes, "MULTIPLY_ADD", parts.outputs["Y"], 3.7, -1.9)
    a = nodes.new("CombineXYZ", X=x, Y=y, Z=math(nodes, "ADD", x, y))
    b = nodes.new("CombineXYZ", X=y, Y=0.75, Z=x)
    return {"a": a, "b": b, "x": x, "y": y, "u": math(nodes, "FRACT", x), "v": math(nodes, "FRACT", y)}


def math(nodes, operation, *values, clamp=False):
    """A Math node."""
    made = set_up(nodes.new("Math"), operation=operation, use_clamp=clamp)
    for name, value in zip(("Value", "Value_001", "Value_002"), values, strict=False):
        nodes.set(made, name, value)
    return made


def set_up(node, **values):
    """The node, with its settings changed."""
    for name, value in values.items():
        setattr(node, name, value)
    return node


def modes(kind, name):
    """All values of an enumeration."""
    return [item.identifier for item in getattr(bpy.types, f"ShaderNode{kind}").bl_rna.properties[name].enum_items]


def maker(kind, given, output=None, prepare=None, **values):
    """A Maker of a node with settings and inputs. Inputs that are names of `inputs` are those, and links then.

    output   the name of the one to look at, the first that is in use if None
    prepare  changes the node further
    """

    def make(nodes):
        known = inputs(nodes)
        made = set_up(nodes.new(kind), **values)
        for name, value in given.items():
            nodes.set(made, name, known.get(value, value) if isinstance(value, str) else value)
        if prepare:
            prepare(made)
        return made.outputs[output] if output else next(s for s in made.outputs if not s.is_unavailable)

    return make


def check(session, makers, bound=1e-3):
    """Assert that the trees, by names to tell, are as Cycles has them, up to `bound` of the range of their values."""
    ours, theirs, error = compare(session, list(makers.values()))
    assert np.isfinite(ours).all()
    wrong = {name: (e, *_worst(us, they)) for name, e, us, they in zip(makers, error, ours, theirs, strict=True)
             if not e <= bound}
    assert not wrong, "\n".join(f"{name}: {found}" for name, found in wrong.items())


def _worst(us, they):
    """Where two cards differ most, and what they are there."""
    at = np.unravel_index(np.nanargmax(np.abs(us - they)), us.shape)[:2]
    return at, us[at].tolist(), they[at].tolist()
