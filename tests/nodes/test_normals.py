# SPDX-License-Identifier: GPL-3.0-or-later
"""Normal maps, bumps and tangents beside Cycles, on spheres and cards."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from tests.blender.build import image
from tests.nodes import cards


def normal_map(space, strength=1.0, uv_map=""):
    """A maker: normals of an image, in that space."""

    def maker(nodes):
        node = nodes.new("NormalMap", Strength=strength, Color=texture(nodes))
        node.space, node.uv_map = space, uv_map
        return node

    return maker


def texture(nodes):
    node = nodes.new("TexImage")
    known = bpy.data.images.get("Map")
    if known is None:
        pixels = np.random.default_rng(2).uniform(0.2, 0.8, (4, 5, 4)).astype("f4")
        pixels[..., 2] = 0.9
        known = image(pixels, "Map", space="Non-Color", alpha_mode="NONE")
        known.pack()
    node.image, node.interpolation = known, "Cubic"
    return node


def bump(height, invert=False, **inputs):
    """A maker: a bump of a height that `height` makes of the nodes."""

    def maker(nodes):
        node = nodes.new("Bump", Height=height(nodes), **inputs)
        node.invert = invert
        return node

    return maker


def waves(nodes):
    """Of the place, smooth over pixels."""
    sine = nodes.new("VectorMath", Vector=nodes.new("VectorMath", Vector=nodes.new("TexCoord").outputs["Object"],
                                                    Vector_001=(5, 4, 3)))
    sine.inputs[0].links[0].from_node.operation, sine.operation = "MULTIPLY", "SINE"
    return sine


GIVEN = {
    "tangent": normal_map("TANGENT"), "weak": normal_map("TANGENT", 0.4), "strong": normal_map("TANGENT", 1.7),
    "other uv map": normal_map("TANGENT", uv_map="Second"), "no such uv map": normal_map("TANGENT", uv_map="None"),
    **{space.lower(): normal_map(space, 0.6) for space in ("OBJECT", "WORLD", "BLENDER_OBJECT", "BLENDER_WORLD")},
    "bump": bump(waves, Distance=0.1), "inverted": bump(waves, invert=True, Distance=0.05, Strength=0.5),
    "of an image": bump(texture, Distance=0.1),
    "on a map": lambda nodes: nodes.new("Bump", Height=waves(nodes), Distance=0.05,
                                        Normal=normal_map("TANGENT")(nodes)),
    "wide": bump(waves, Distance=0.1, Filter_Width=1.0), "nothing linked": lambda nodes: nodes.new("Bump"),
    "a step": bump(lambda nodes: nodes.new("Fresnel"), Distance=0.2),
}

# Faces of four corners have one tangent each in Cycles, not the mean of those of their triangles
ERRORS = {("other uv map", "flat"): 1e-2}


def shape(owner, kind):
    if kind != "card":
        material = owner.active_material
        bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12)
        made = bpy.context.object
        owner.data = made.data
        bpy.data.objects.remove(made)
        owner.data.materials.append(material)
        owner.data.polygons.foreach_set("use_smooth", [kind == "smooth"] * len(owner.data.polygons))
    owner.rotation_euler = 0.3, -0.2, 0.4
    owner.scale = 0.7, 0.6, 0.9
    second = owner.data.uv_layers.new(name="Second")
    first = owner.data.uv_layers[0]
    for a, b in zip(first.uv, second.uv, strict=True):
        b.vector = a.vector.y * 2, a.vector.x + 0.3 * a.vector.y


@pytest.mark.parametrize("kind", ["card", "smooth", "flat"])
def test_normals(session, kind):
    """Silhouettes and edges between flat faces are left out."""
    cards.make_cards(list(GIVEN.values()))
    for i in range(len(GIVEN)):
        shape(bpy.data.objects[f"Card {i}"], kind)
    ours, theirs = cards.cards_by_us(session, list(GIVEN.values())), cards.cards_by_cycles(list(GIVEN.values()))
    bad = {}
    for name, a, b in zip(GIVEN, ours, theirs, strict=True):
        error = float(np.quantile(np.abs(a - b).max(-1), 0.95))
        if not error <= ERRORS.get((name, kind), 2e-3):
            bad[name] = error
    assert not bad, bad
