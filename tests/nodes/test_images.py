# SPDX-License-Identifier: GPL-3.0-or-later
"""Image and environment textures beside Cycles: projections, filters, extensions, alpha."""

from __future__ import annotations

import bpy
import numpy as np

from tests.blender.build import image
from tests.nodes import cards


def picture(name="Picture", size=(6, 9), **options):
    """An image, made once a file, with alpha."""
    known = bpy.data.images.get(name)
    if known is None:
        pixels = np.random.default_rng(1).uniform(0.05, 1, (*size, 4)).astype("f4")
        known = image(pixels, name, **options)
        known.pack()
    return known


def texture(output="Color", coordinates="UV", stretch=2.3, kind="TexImage", made=picture, **settings):
    """A maker: the texture at coordinates that go beyond the image."""

    def maker(nodes):
        node = nodes.new(kind)
        node.image = made() if made else None
        for setting, value in settings.items():
            setattr(node, setting, value)
        mapping = nodes.new("Mapping", Vector=nodes.new("TexCoord").outputs[coordinates], Location=(-0.6, -0.55, -0.31),
                            Rotation=(0.1, 0.2, 0.3), Scale=(stretch, stretch * 1.1, stretch * 0.7))
        nodes.set(node, "Vector", mapping)
        return node.outputs[output]

    return maker


def both(node_of):
    """A maker that uses alpha too, which changes what the colour is."""

    def maker(nodes):
        color = node_of(nodes)
        return nodes.new("MixRGB", Fac=color.node.outputs["Alpha"], Color1=color, Color2=(0, 0, 0, 1))

    return maker


def unlinked(nodes):
    node = nodes.new("TexImage")
    node.image = picture()
    return node


GIVEN = {
    **{f"{i} {e}": texture(interpolation=i, extension=e) for i, e in (
        ("Linear", "REPEAT"), ("Linear", "EXTEND"), ("Linear", "CLIP"), ("Linear", "MIRROR"), ("Closest", "CLIP"),
        ("Cubic", "REPEAT"), ("Cubic", "CLIP"), ("Smart", "MIRROR"))},
    **{f"box {b}": texture(projection="BOX", projection_blend=b, coordinates="Object") for b in (0.0, 0.3, 1.0)},
    "sphere": texture(projection="SPHERE", coordinates="Generated", interpolation="Cubic"),
    "tube": texture(projection="TUBE", coordinates="Generated"),
    "alpha": texture("Alpha"), "straight": both(texture()),
    "straight float": both(texture(made=lambda: picture("Float", is_float=True, alpha_mode="PREMUL"))),
    "packed": both(texture(made=lambda: picture("Channels", alpha_mode="CHANNEL_PACKED"))),
    "data": texture(made=lambda: picture("Data", space="Non-Color")),
    "missing": texture(made=None), "missing alpha": texture("Alpha", made=None),
    "unlinked": unlinked,
    "equirectangular": texture(kind="TexEnvironment", coordinates="Normal"),
    "mirror ball": texture(kind="TexEnvironment", coordinates="Normal", projection="MIRROR_BALL",
                           interpolation="Cubic"),
}


def test_images(session):
    """Borders between closest texels, where rounding decides, and the silhouette are left out."""
    cards.make_cards(list(GIVEN.values()))
    for i in range(len(GIVEN)):
        owner = bpy.data.objects[f"Card {i}"]
        if i > 7:
            material = owner.active_material
            bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24)
            made = bpy.context.object
            owner.data = made.data
            bpy.data.objects.remove(made)
            owner.data.materials.append(material)
            owner.data.polygons.foreach_set("use_smooth", [True] * len(owner.data.polygons))
        owner.rotation_euler = 0.3, -0.2, 0.4
        owner.scale = 0.7, 0.6, 0.9
    ours, theirs = cards.cards_by_us(session, list(GIVEN.values())), cards.cards_by_cycles(list(GIVEN.values()))
    bad = {}
    for name, a, b in zip(GIVEN, ours, theirs, strict=True):
        error = np.quantile(np.abs(a - b).max(-1), 0.97)
        if not error <= 1e-3:
            bad[name] = float(error)
    assert not bad, bad
