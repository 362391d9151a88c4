# SPDX-License-Identifier: GPL-3.0-or-later
"""Which edits of a material need another program: none that only changes a value does."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from svo_engine.nodes.compile import compiled_tree
from tests.blender.build import image, material, place, plane
from tests.blender.following import Followed


def tree(name="Material"):
    """A material with something of everything: an image, a ramp, a curve, noise, an object's coordinates."""
    nodes = material(name)
    picture = nodes.new("TexImage")
    picture.image = bpy.data.images.get("First") or image(np.full((2, 2, 4), 0.5), "First")
    at = nodes.new("TexCoord")
    at.object = bpy.data.objects.get("Guide") or place(None, "Guide")
    noise = nodes.new("TexNoise", Vector=at.outputs["Object"], Scale=3.0)
    ramp = nodes.new("ValToRGB", Fac=noise)
    curve = nodes.new("RGBCurve", Color=ramp)
    curve.mapping.curves[3].points.new(0.4, 0.6)
    both = nodes.new("Mix", Factor_Float=0.3)
    both.data_type = "RGBA"
    for name_of, value in (("A Color", picture), ("B Color", curve)):
        nodes.set(both, name_of, value)
    nodes.show(nodes.new("Emission", Color=both.outputs["Result"] if "Result" in both.outputs else both.outputs[2]))
    return nodes.owner


def text_of(found):
    return compiled_tree(found.graph).text


def add_stop():
    node("ValToRGB").color_ramp.elements.new(0.5)
    bpy.data.materials["Material"].node_tree.update_tag()  # as Blender's editor does


def bend():
    node("RGBCurve").mapping.curves[3].points[1].location = (0.5, 0.7)
    bpy.data.materials["Material"].node_tree.update_tag()


def node(kind):
    return next(n for n in bpy.data.materials["Material"].node_tree.nodes if n.bl_idname == f"ShaderNode{kind}")


VALUES = {
    "number": lambda: setattr(node("TexNoise").inputs["Scale"], "default_value", 4.0),
    "colour": lambda: setattr(node("Emission").inputs["Strength"], "default_value", 0.5),
    "factor": lambda: setattr(node("Mix").inputs[0], "default_value", 0.7),
    "ramp": lambda: setattr(node("ValToRGB").color_ramp.elements[0], "position", 0.2),
    "ramp's colour": lambda: setattr(node("ValToRGB").color_ramp.elements[0], "color", (1, 0, 0, 1)),
    "ramp's stops": add_stop,
    "curve": bend,
    "image": lambda: setattr(node("TexImage"), "image", image(np.full((4, 4, 4), 0.25), "Second")),
    "object": lambda: setattr(bpy.data.objects["Guide"], "location", (1, 2, 3)),
}

TREES = {
    "link": lambda: bpy.data.materials["Material"].node_tree.links.remove(node("ValToRGB").inputs["Fac"].links[0]),
    "operation": lambda: setattr(node("TexNoise"), "noise_type", "RIDGED_MULTIFRACTAL"),
    "mute": lambda: setattr(node("RGBCurve"), "mute", True),
}


@pytest.fixture
def followed(empty):
    plane(tree(), name="Shown")
    plane(tree("Other"), name="Shown too", at=(3, 0, 0))
    return Followed()


@pytest.mark.parametrize("edit", VALUES)
def test_edits_of_values_keep_the_structure(followed, edit):
    before, counts = followed.scene.materials, followed.counts()
    after = followed.after(VALUES[edit]).materials
    both = edit in ("object", "image")  # at which both look; of which the numbers are others
    assert [a is not b for a, b in zip(before, after, strict=True)] == [True, both]
    assert [text_of(m) for m in after] == [text_of(m) for m in before]
    assert followed.counts()["materials"] - counts["materials"] == (2 if edit == "object" else 1)
    assert followed.counts()["walks"] - counts["walks"] == both  # what moves may show other things


@pytest.mark.parametrize("edit", TREES)
def test_edits_of_trees_change_one_structure(followed, edit):
    before = followed.scene.materials
    n_walks = followed.counts()["walks"]
    after = followed.after(TREES[edit]).materials
    assert after[1] is before[1]
    assert text_of(after[0]) != text_of(before[0])
    assert followed.counts()["walks"] == n_walks


def test_materials_that_differ_in_values_share_a_structure(followed):
    for change in VALUES.values():
        change()
    first, second = followed.after(lambda: None).materials
    assert first.graph != second.graph
    assert text_of(first) == text_of(second)
