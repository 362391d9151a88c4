# SPDX-License-Identifier: GPL-3.0-or-later
"""Input nodes beside Cycles, on tilted planes, spheres and other things of many triangles."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from tests.nodes import cards


def output(kind, name, **settings):
    """A maker: an output of a node with these settings."""

    def maker(nodes):
        node = nodes.new(kind)
        for setting, value in settings.items():
            setattr(node, setting, value)
        return node.outputs[name]

    return maker


GIVEN = {
    "generated": output("TexCoord", "Generated"), "normal": output("TexCoord", "Normal"),
    "uv": output("TexCoord", "UV"), "object": output("TexCoord", "Object"), "camera": output("TexCoord", "Camera"),
    "window": output("TexCoord", "Window"), "reflection": output("TexCoord", "Reflection"),
    "uv map": output("UVMap", "UV"), "second uv map": output("UVMap", "UV", uv_map="Second"),
    "missing uv map": output("UVMap", "UV", uv_map="None"),
    "attribute vector": output("Attribute", "Vector", attribute_name="Three"),
    "attribute factor": output("Attribute", "Fac", attribute_name="Three"),
    "attribute factor of two": output("Attribute", "Fac", attribute_name="Second"),
    "attribute of faces": output("Attribute", "Color", attribute_name="Face"),
    "attribute alpha": output("Attribute", "Alpha", attribute_name="Color"),
    "attribute colour": output("Attribute", "Color", attribute_name="Color"),
    "missing": output("Attribute", "Color", attribute_name="None"),
    "missing alpha": output("Attribute", "Alpha", attribute_name="None"),
    "property": output("Attribute", "Color", attribute_type="OBJECT", attribute_name="tint"),
    "property's factor": output("Attribute", "Fac", attribute_type="OBJECT", attribute_name="tint"),
    "property of the view layer": output("Attribute", "Fac", attribute_type="VIEW_LAYER",
                                         attribute_name="frame_current"),
    "bytes": output("VertexColor", "Color", layer_name="Bytes"),
    "active colour": output("VertexColor", "Color"), "active alpha": output("VertexColor", "Alpha"),
    "missing colour alpha": output("VertexColor", "Alpha", layer_name="None"),
    "view vector": output("CameraData", "View Vector"), "view depth": output("CameraData", "View Z Depth"),
    "view distance": output("CameraData", "View Distance"),
    "position": output("NewGeometry", "Position"), "geometry normal": output("NewGeometry", "Normal"),
    "true normal": output("NewGeometry", "True Normal"), "tangent": output("NewGeometry", "Tangent"),
    "incoming": output("NewGeometry", "Incoming"), "parametric": output("NewGeometry", "Parametric"),
    "backfacing": output("NewGeometry", "Backfacing"),
    "location": output("ObjectInfo", "Location"), "object colour": output("ObjectInfo", "Color"),
    "object alpha": output("ObjectInfo", "Alpha"), "object index": output("ObjectInfo", "Object Index"),
    "material index": output("ObjectInfo", "Material Index"), "random": output("ObjectInfo", "Random"),
    "radial x": output("Tangent", "Tangent", axis="X"), "radial y": output("Tangent", "Tangent", axis="Y"),
    "along u": output("Tangent", "Tangent", direction_type="UV_MAP", uv_map="UVMap"),
    "fresnel": output("Fresnel", "Fac"), "layer": output("LayerWeight", "Fresnel"),
    "facing": output("LayerWeight", "Facing"),
    "is camera ray": output("LightPath", "Is Camera Ray"), "is diffuse ray": output("LightPath", "Is Diffuse Ray"),
    "ray length": output("LightPath", "Ray Length"), "ray depth": output("LightPath", "Ray Depth"),
    "index": output("ParticleInfo", "Index"), "strand": output("HairInfo", "Is Strand"),
    "radius": output("PointInfo", "Radius"), "density": output("VolumeInfo", "Density"),
}
for blend in (0.0, 0.3, 0.8, 1.0):
    for name in ("Fresnel", "Facing"):
        GIVEN[f"{name} at {blend}"] = lambda nodes, name=name, blend=blend: nodes.new(
            "LayerWeight", Blend=blend).outputs[name]


def change(i, owner):
    """Turn the card, give it attributes, numbers and a colour."""
    owner.rotation_euler = 0.3, -0.2, 0.4
    owner.scale = 0.7, 0.6, 0.9
    owner.pass_index, owner.color = i + 1, (0.1, 0.3, 0.5, 0.7)
    owner.active_material.pass_index = 2 * i
    owner["tint"] = 0.2, 0.4, 0.9
    mesh, rng = owner.data, np.random.default_rng(0)
    for attribute, kind, domain, width, field in (
            ("Three", "FLOAT_VECTOR", "POINT", 3, "vector"), ("Face", "FLOAT", "FACE", 1, "value"),
            ("Color", "FLOAT_COLOR", "CORNER", 4, "color"), ("Bytes", "BYTE_COLOR", "POINT", 4, "color"),
            ("Second", "FLOAT2", "CORNER", 2, "vector")):
        made = mesh.attributes.new(attribute, kind, domain)
        made.data.foreach_set(field, rng.uniform(size=len(made.data) * width).astype("f4"))
    mesh.attributes.render_color_index = mesh.color_attributes.find("Color")
    mesh.attributes.active_color_index = mesh.color_attributes.find("Color")


def spheres(i, owner):
    """A smooth sphere in place of the card."""
    material = owner.active_material
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12)
    made = bpy.context.object
    owner.data = made.data
    bpy.data.objects.remove(made)
    owner.data.materials.append(material)
    owner.data.polygons.foreach_set("use_smooth", [True] * len(owner.data.polygons))


# Normals have 16 bits; what lies beyond the silhouette in one of the pictures is left out
ERRORS = {"card": 1e-3, "sphere": 3e-3}

# On a flat card they run along its normal, and what is left of them is noise
NOT_ON_CARDS = "radial x", "radial y"


@pytest.mark.parametrize("shape", ERRORS)
def test_inputs(session, shape):
    cards.make_cards(list(GIVEN.values()))
    for i in range(len(GIVEN)):
        owner = bpy.data.objects[f"Card {i}"]
        if shape == "sphere":
            spheres(i, owner)
        change(i, owner)
    ours, theirs = cards.cards_by_us(session, list(GIVEN.values())), cards.cards_by_cycles(list(GIVEN.values()))
    worst = {}
    for name, a, b in zip(GIVEN, ours, theirs, strict=True):
        error = np.abs(a - b).max(-1) / max(float(np.ptp(b)), 1.0)
        worst[name] = float(np.quantile(error, 1 if shape == "card" else 0.97))
    if shape == "card":
        worst = {name: error for name, error in worst.items() if name not in NOT_ON_CARDS}
    bad = {name: error for name, error in worst.items() if not error <= ERRORS[shape]}
    assert not bad, bad


OF_TRIANGLES = {"pointiness": output("NewGeometry", "Pointiness"),
                "wires": lambda nodes: nodes.new("Wireframe", Size=0.05),
                "thin wires": output("Wireframe", "Fac", use_pixel_size=True)}


def test_what_depends_on_triangles(session):
    """On a dented sphere of triangles. A border between wires and faces is the pixel's in which it lies."""
    cards.make_cards(list(OF_TRIANGLES.values()))
    for i in range(len(OF_TRIANGLES)):
        owner = bpy.data.objects[f"Card {i}"]
        material = owner.active_material
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2)
        made = bpy.context.object
        owner.data = made.data
        bpy.data.objects.remove(made)
        owner.data.materials.append(material)
        owner.data.polygons.foreach_set("use_smooth", [True] * len(owner.data.polygons))
        for vertex in owner.data.vertices:
            vertex.co *= 0.8 + 0.2 * np.sin(9 * vertex.index)
    ours, theirs = cards.cards_by_us(session, list(OF_TRIANGLES.values())), cards.cards_by_cycles(
        list(OF_TRIANGLES.values()))
    for name, a, b in zip(OF_TRIANGLES, ours, theirs, strict=True):
        error = np.abs(a - b).max(-1)
        assert np.quantile(error, 0.95) < 5e-3, (name, error.max(), float(np.quantile(error, 0.9)))
